// The C compiler of a machine with POSIX. Not part of a build with COURANT_NATIVE=OFF.
#pragma once

#include <string>

#include "courant/core/expressions/native.hpp"

namespace courant {

// Runs a C compiler, no shell between, and loads the shared object that it makes. Where objects are
// kept, it is in the cache of this user, which is opened when something is compiled: a compiler that
// is only asked whether it is there leaves no folder behind. Without a cache an object is made in a
// temporary folder and forgotten.
class CCompiler final : public NativeCompiler {
 public:
  // `program`: a name that is looked for in $PATH, or a path.
  explicit CCompiler(std::string program, bool keeps_objects = false);

  // The program that $COURANT_CC names, else cc; it keeps objects in NativeCache::open().
  static CCompiler from_environment();

  std::shared_ptr<const NativeCode> compile(const std::string& c_source) const override;
  bool is_available() const override;

 private:
  std::string program_;
  bool keeps_objects_;
};

}  // namespace courant
