// Backend: how the instructions of functions are carried out.
#pragma once

#include <memory>
#include <utility>

#include "courant/core/expressions/native.hpp"

namespace courant {

class NativeModule;

// The results of all back ends are the same to the last bit.
//
//   interpreter   always there
//   native        printed as C and compiled; throws std::runtime_error without a compiler
//   automatic     native where a compiler works and the program is neither trivial nor huge (the
//                 value alone, if the Jacobian is), else the interpreter
//
// A compiler takes longer to start than for a small function. So the functions of one object are
// compiled together:
//
//   const Backend together = backend.together();
//   f_ = Function("f", …, {.backend = together});
//   g_ = Function("g", …, {.backend = together});
//   together.compile();
class Backend {
 public:
  enum class Kind { interpreter, native, automatic };
  static const Backend interpreter, native, automatic;

  constexpr Backend(Kind kind) : kind_(kind) {}  // NOLINT: a kind is a back end of this machine

  Kind kind() const { return kind_; }
  // The same with a compiler of the caller's.
  Backend with(std::shared_ptr<const NativeCompiler> compiler) const;
  // The caller's compiler, or else that of the machine.
  std::shared_ptr<const NativeCompiler> compiler() const;

  // The same for functions that belong together: they are interpreted until compile().
  Backend together() const;
  // Compiles the functions that were made with this object and its copies. Throws std::runtime_error
  // if the kind is native and the compiler fails.
  void compile() const;
  // Of together(), else null.
  NativeModule* module() const { return module_.get(); }

  bool operator==(const Backend&) const = default;

 private:
  Kind kind_;
  std::shared_ptr<const NativeCompiler> compiler_;
  std::shared_ptr<NativeModule> module_;
};

inline constinit const Backend Backend::interpreter(Backend::Kind::interpreter);
inline constinit const Backend Backend::native(Backend::Kind::native);
inline constinit const Backend Backend::automatic(Backend::Kind::automatic);

}  // namespace courant
