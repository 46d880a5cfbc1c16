#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "courant/core/expressions/program.hpp"

namespace courant {
namespace {

std::string exact(double value) {
  if (std::isnan(value)) return "(0.0/0.0)";
  if (std::isinf(value)) return value > 0 ? "(1.0/0.0)" : "(-1.0/0.0)";
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::hex).ptr;
  const std::string digits(buffer, end);
  return digits.front() == '-' ? "(-0x" + digits.substr(1) + ")" : "0x" + digits;
}

// Compilers turn a division by these into a product.
bool is_small_power_of_two(double value) {
  constexpr int largest = 5;
  int exponent = 0;
  return value == 0.0 ||
         (std::fabs(std::frexp(value, &exponent)) == 0.5 && std::abs(exponent) <= largest);
}

// The operation in C; what it means is said by evaluate() in operation.hpp.
std::string expression(Op op, std::int32_t k, const std::string& a, const std::string& b,
                       const std::string& c) {
  const auto infix = [&](const char* sign) { return a + sign + b; };
  const auto truth = [](const std::string& condition) { return condition + " ? 1.0 : 0.0"; };
  const auto call = [&](const char* name) { return name + ("(" + a + ")"); };
  const auto call_with_k = [&](const char* name) {
    return name + ("(" + std::to_string(k) + ", " + a + ")");
  };
  switch (op) {
    case Op::negate:
      return "-" + a;
    case Op::add:
      return infix(" + ");
    case Op::subtract:
      return infix(" - ");
    case Op::multiply:
      return infix(" * ");
    case Op::divide:
      return infix(" / ");
    case Op::sqrt:
      return call("sqrt");
    case Op::exp:
      return call("exp");
    case Op::log:
      return call("log");
    case Op::sin:
      return call("sin");
    case Op::cos:
      return call("cos");
    case Op::tan:
      return call("tan");
    case Op::asin:
      return call("asin");
    case Op::acos:
      return call("acos");
    case Op::atan:
      return call("atan");
    case Op::sinh:
      return call("sinh");
    case Op::cosh:
      return call("cosh");
    case Op::tanh:
      return call("tanh");
    case Op::abs:
      return call("fabs");
    case Op::sign:
      return a + " > 0 ? 1.0 : (" + a + " < 0 ? -1.0 : " + a + ")";
    case Op::power:
      return call_with_k("courant_power");
    case Op::pow:
      return "pow(" + a + ", " + b + ")";
    case Op::atan2:
      return "atan2(" + a + ", " + b + ")";
    case Op::min:
      return b + " < " + a + " ? " + b + " : " + a;
    case Op::max:
      return a + " < " + b + " ? " + b + " : " + a;
    case Op::less:
      return truth(infix(" < "));
    case Op::less_equal:
      return truth(infix(" <= "));
    case Op::equal:
      return truth(infix(" == "));
    case Op::logical_and:
      return truth(a + " != 0 && " + b + " != 0");
    case Op::logical_or:
      return truth(a + " != 0 || " + b + " != 0");
    case Op::logical_not:
      return truth(a + " == 0");
    case Op::select:
      return a + " != 0 ? " + b + " : " + c;
    case Op::stumpff:
      return call_with_k("courant_stumpff");
    case Op::arccos_factor:
      return call_with_k("courant_arccos_factor");
    case Op::constant:
    case Op::variable:
      break;
  }
  return "0.0/0.0";
}

}  // namespace

std::string Program::c_source(const std::string& symbol, Constants how) const {
  // Compilers take more than linear time for a function. So a long one calls parts, which hand on
  // in w the values that later ones need; v are the values within a part.
  constexpr std::size_t kWhole = 1000;
  constexpr std::size_t kPart = 125;
  std::vector<std::uint32_t> outputs;
  for (const auto& [slot, count] : stores_)
    for (std::uint32_t i = 0; i < count; ++i) outputs.push_back(slot + i);
  const bool whole = std::max(instructions_.size(), outputs.size()) <= kWhole;
  const std::size_t size = whole ? kWhole : kPart;
  const std::size_t first_value =
      loads_.empty() ? constants_.size() : std::size_t{loads_.back().slot} + loads_.back().count;
  std::vector<std::string> name(slots_);
  for (std::size_t i = 0; i < constants_.size(); ++i)
    name[i] = how == Constants::written || is_small_power_of_two(constants_[i])
                  ? exact(constants_[i])
                  : "c[" + std::to_string(i) + "]";
  for (const Load& load : loads_)
    for (std::uint32_t i = 0; i < load.count; ++i)
      name[load.slot + i] =
          "in[" + std::to_string(load.group) + "][" + std::to_string(load.index + i) + "]";
  for (std::size_t slot = first_value; slot < slots_; ++slot)
    name[slot] = "v" + std::to_string(slot - first_value);
  const auto kept = [&](std::size_t slot) {
    return "w[" + std::to_string(slot - first_value) + "]";
  };

  std::vector<std::string> parts;  // the last one first
  for (std::size_t end = outputs.size(), begin = 0; end > 0; end = begin) {
    begin = (end - 1) / size * size;
    std::string part;
    for (std::size_t i = begin; i < end; ++i)
      part += "  out[" + std::to_string(i) +
              "] = " + (outputs[i] < first_value ? name[outputs[i]] : kept(outputs[i])) + ";\n";
    parts.push_back(part);
  }

  std::vector<bool> live(slots_, false);  // read after the instruction that is looked at
  for (const std::uint32_t slot : outputs) live[slot] = true;
  auto run = runs_.rbegin();
  for (std::size_t end = instructions_.size(), begin = 0; end > 0; end = begin) {
    begin = (end - 1) / size * size;
    std::vector<std::uint32_t> used;
    for (std::size_t i = begin; i < end; ++i) {
      const Instruction& x = instructions_[i];
      for (const std::uint32_t slot : {x.target, x.a, x.b, x.c})
        if (slot >= first_value) used.push_back(slot);
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());

    std::string store;
    for (const std::uint32_t slot : used)
      if (live[slot]) store += "  " + kept(slot) + " = " + name[slot] + ";\n";
    std::vector<std::string> lines;
    for (std::size_t i = end; i-- > begin;) {
      while (std::next(run) != runs_.rend() && std::next(run)->end > i) ++run;
      const Instruction& x = instructions_[i];
      lines.push_back("  " + name[x.target] + " = " +
                      expression(run->op, run->k, name[x.a], name[x.b], name[x.c]) + ";\n");
      live[x.target] = false;
      const std::uint32_t operand[] = {x.a, x.b, x.c};
      for (int j = 0; j < arity(run->op); ++j) live[operand[j]] = true;
    }
    std::string part;
    for (const std::uint32_t slot : used)
      part += "  double " + name[slot] + (live[slot] ? " = " + kept(slot) : "") + ";\n";
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) part += *line;
    parts.push_back(part + store);
  }

  const bool are_passed = how == Constants::passed;
  const std::string constants = are_passed ? "const double *c, " : "";
  const std::string unused =
      std::string("  (void)in, ") + (are_passed ? "(void)c, " : "") + "(void)w, (void)out;\n}\n";
  std::string source, calls;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string part = symbol + "_" + std::to_string(i);
    source += (whole ? "static void " : "__attribute__((noinline)) static void ") + part +
              "(const double *const *in, " + constants + "double *w, double *out) {\n" +
              parts[parts.size() - 1 - i] + unused;
    calls += "  " + part + (are_passed ? "(in, c, w, out);\n" : "(in, w, out);\n");
  }
  return source + "void " + symbol + "(const double *const *in, " + constants +
         "double *out) {\n  double w[" + std::to_string(slots_ - first_value + 1) + "];\n" + calls +
         unused;
}

}  // namespace courant
