#include "courant/core/expressions/function_name.hpp"

namespace courant {

const char* function_name(Op op) {
  switch (op) {
    case Op::sqrt:
      return "sqrt";
    case Op::exp:
      return "exp";
    case Op::log:
      return "log";
    case Op::sin:
      return "sin";
    case Op::cos:
      return "cos";
    case Op::tan:
      return "tan";
    case Op::asin:
      return "asin";
    case Op::acos:
      return "acos";
    case Op::atan:
      return "atan";
    case Op::sinh:
      return "sinh";
    case Op::cosh:
      return "cosh";
    case Op::tanh:
      return "tanh";
    case Op::abs:
      return "abs";
    case Op::sign:
      return "sign";
    case Op::atan2:
      return "atan2";
    case Op::min:
      return "min";
    case Op::max:
      return "max";
    case Op::select:
      return "if";
    case Op::stumpff:
      return "stumpff";
    case Op::arccos_factor:
      return "arccos_factor";
    default:
      return nullptr;
  }
}

}  // namespace courant
