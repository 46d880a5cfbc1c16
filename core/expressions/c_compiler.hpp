// The C compiler of a machine with POSIX. Not part of a build with COURANT_NATIVE=OFF.
#pragma once

#include <optional>
#include <string>

#include "courant/core/expressions/native.hpp"
#include "courant/core/expressions/native_cache.hpp"

namespace courant {

// Runs a C compiler, no shell between, and loads the shared object that it makes. Objects are kept
// in the cache; without one an object is made in a temporary folder and forgotten.
class CCompiler final : public NativeCompiler {
 public:
  // `program`: a name that is looked for in $PATH, or a path.
  explicit CCompiler(std::string program, std::optional<NativeCache> cache = std::nullopt);

  // The program that $COURANT_CC names, else cc, with NativeCache::open().
  static CCompiler from_environment();

  std::shared_ptr<const NativeCode> compile(const std::string& c_source) const override;
  bool is_available() const override;

 private:
  std::string program_;
  std::optional<NativeCache> cache_;
};

}  // namespace courant
