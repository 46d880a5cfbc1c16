#include "courant/core/expressions/native.hpp"

#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {

std::string NativeCompiler::defect() const {
  try {
    compile("int courant_nothing;\n");
    return "";
  } catch (const std::runtime_error& error) {
    const std::string what = without_place(error.what());
    return what.substr(0, what.find('\n'));
  }
}

}  // namespace courant
