#include "courant/core/expressions/native_module.hpp"

#include <utility>

#include "courant/core/expressions/c_prelude.hpp"

namespace courant {
namespace {

constexpr const char* kValue = "courant_value_";
constexpr const char* kAll = "courant_value_and_jacobian_";

// CCompiler takes longer sources for long.
constexpr std::size_t kLong = 50'000;

}  // namespace

std::shared_ptr<const NativeModule::Entry> NativeModule::add(const Program& value,
                                                             const Program* value_and_jacobian) {
  Added added{std::make_shared<Entry>(), value_and_jacobian != nullptr,
              std::to_string(added_.size()), ""};
  const auto add = [&](const Program& program, const char* symbol, std::vector<double>& constants) {
    added.source += program.c_source(symbol + added.number, Program::Constants::passed);
    constants = program.constants();
  };
  add(value, kValue, added.entry->constants);
  if (added.has_jacobian) add(*value_and_jacobian, kAll, added.entry->constants_with_jacobian);
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
  std::string source;
  for (const Added* function : functions) source += function->source;
  const auto code = compiler.compile(c_prelude(source) + source);
  for (const Added* function : functions) {
    Entry& entry = *function->entry;
    entry.owner = code;
    if (function->has_jacobian) entry.value_and_jacobian = code->function(kAll + function->number);
    entry.value = code->function(kValue + function->number);
  }
}

}  // namespace courant
