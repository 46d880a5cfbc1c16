// C code compiled and loaded at run time.
#pragma once

#include <memory>
#include <string>

namespace courant {

// Whether there is a C compiler: the program that $COURANT_CC names, else cc.
bool native_compiler_available();

// What hinders native code, in one line: no compiler, or one that fails. Empty if nothing does.
std::string native_compiler_defect();

// A shared object made from C source by the machine's C compiler; unloaded with the last owner.
//
// Arithmetic in it gives the bits that this program gives: no contraction, no fast math.
// Objects are kept in the NativeCache; where there is none, the object is made in a temporary
// directory and forgotten.
class NativeLibrary {
 public:
  // Throws std::runtime_error, with what the compiler said, if there is no compiler or it fails.
  static std::shared_ptr<const NativeLibrary> compile(const std::string& c_source);

  ~NativeLibrary();
  NativeLibrary(const NativeLibrary&) = delete;
  NativeLibrary& operator=(const NativeLibrary&) = delete;

  using Evaluate = void (*)(const double* const* in, double* out);
  Evaluate function(const std::string& symbol) const;  // throws std::runtime_error if absent

 private:
  explicit NativeLibrary(void* handle) : handle_(handle) {}
  void* handle_;
};

}  // namespace courant
