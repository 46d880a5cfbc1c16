// Functions that are compiled together.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "courant/core/expressions/native.hpp"
#include "courant/core/expressions/program.hpp"

namespace courant {

// C source of several functions, for one run of the compiler. What is long goes into a module of its own, because
// compilers are told to optimise that less. Functions that differ in their constants alone, as those of the cases of a
// sweep do, have one source, which a compiler with a cache is given once.
class NativeModule {
 public:
  // The machine code of a function; null before the module is compiled, and of what is not in it.
  struct Entry {
    std::atomic<NativeCode::Evaluate> value = nullptr;
    std::atomic<NativeCode::Evaluate> value_and_jacobian = nullptr;
    std::vector<double> constants, constants_with_jacobian;  // that these are called with
    std::shared_ptr<const NativeCode> owner;
  };

  // A function, with or without (null) its Jacobian. Its entry is filled by the next compile().
  std::shared_ptr<const Entry> add(const Program& value, const Program* value_and_jacobian);

  // Compiles what was added since the last time. Throws std::runtime_error as compilers do; entries
  // are null then. Functions may be called meanwhile.
  void compile(const NativeCompiler& compiler);

 private:
  struct Added {
    std::shared_ptr<Entry> entry;
    bool has_jacobian;
    std::string number;  // its symbols end in this
    std::string source;
  };

  static void compile(const NativeCompiler& compiler, const std::vector<const Added*>& functions);

  std::vector<Added> added_;
};

}  // namespace courant
