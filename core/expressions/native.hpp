// Machine code, made of C source while the program runs.
#pragma once

#include <memory>
#include <string>

namespace courant {

// Code that a NativeCompiler made; valid as long as this object.
class NativeCode {
 public:
  // `constants`: of the formulas, which are no part of the code (Program::c_source).
  using Evaluate = void (*)(const double* const* in, const double* constants, double* out);

  virtual ~NativeCode() = default;
  // Throws std::runtime_error if there is no such symbol.
  virtual Evaluate function(const std::string& symbol) const = 0;
};

// What makes code of C source. Where there is no C compiler, as in a browser, a host may bring its
// own: one for WebAssembly, or one that knows the code of certain sources, compiled beforehand. The
// arithmetic of the code is that of the source: no contraction, no fast math, so that its bits are
// those of the interpreter.
//
// To subclass, override compile; is_available where compile may be known to fail.
class NativeCompiler {
 public:
  virtual ~NativeCompiler() = default;
  // Throws std::runtime_error, with what the compiler said, if it fails. May be called by several
  // threads.
  virtual std::shared_ptr<const NativeCode> compile(const std::string& c_source) const = 0;
  // A quick look, without compiling anything.
  virtual bool is_available() const { return true; }

  // What hinders native code, in one line; empty if nothing does.
  std::string defect() const;
};

// The C compiler of this machine with the cache of this user, as the environment says now, see
// CCompiler. In a build without (COURANT_NATIVE=OFF) one that is never available.
std::shared_ptr<const NativeCompiler> machine_compiler();

}  // namespace courant
