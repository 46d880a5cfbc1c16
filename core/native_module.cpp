#include "courant/core/native_module.hpp"

#include <utility>

#include "courant/core/special_functions.hpp"

namespace courant {
namespace {

constexpr const char* kValue = "courant_value_";
constexpr const char* kAll = "courant_value_and_jacobian_";

// CCompiler takes longer sources for long.
constexpr std::size_t kLong = 50'000;

// What the functions of programs call.
std::string c_prelude() {
  std::string source = "#include <math.h>\n";
  source += special_functions_source();
  source +=
      "\nstatic double courant_power(int k, double base) {\n"
      "  unsigned exponent = k < 0 ? 0u - (unsigned)k : (unsigned)k;\n"
      "  double result = 1.0;\n  int first = 1;\n"
      "  while (exponent) {\n"
      "    if (exponent & 1u) { result = first ? base : result * base; first = 0; }\n"
      "    exponent >>= 1;\n    if (exponent) base = base * base;\n  }\n"
      "  return k < 0 ? 1.0 / result : result;\n}\n";
  return source;
}

}  // namespace

std::shared_ptr<const NativeModule::Entry> NativeModule::add(const Program& value,
                                                             const Program* value_and_jacobian) {
  Added added{std::make_shared<Entry>(), value_and_jacobian != nullptr,
              std::to_string(added_.size()), ""};
  added.source = value.c_source(kValue + added.number);
  if (added.has_jacobian) added.source += value_and_jacobian->c_source(kAll + added.number);
  added_.push_back(std::move(added));
  return added_.back().entry;
}

void NativeModule::compile(const NativeCompiler& compiler) {
  std::vector<const Added*> together;
  std::size_t size = 0;
  const auto added = std::exchange(added_, {});
  for (const Added& function : added) {
    if (function.source.size() > kLong) {
      compile(compiler, {&function});
      continue;
    }
    if (size + function.source.size() > kLong) {
      compile(compiler, std::exchange(together, {}));
      size = 0;
    }
    together.push_back(&function);
    size += function.source.size();
  }
  if (!together.empty()) compile(compiler, together);
}

void NativeModule::compile(const NativeCompiler& compiler,
                           const std::vector<const Added*>& functions) {
  std::string source = c_prelude();
  for (const Added* function : functions) source += function->source;
  const auto code = compiler.compile(source);
  for (const Added* function : functions) {
    Entry& entry = *function->entry;
    entry.owner = code;
    if (function->has_jacobian) entry.value_and_jacobian = code->function(kAll + function->number);
    entry.value = code->function(kValue + function->number);
  }
}

}  // namespace courant
