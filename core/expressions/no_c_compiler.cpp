// What c_compiler.cpp and native_cache.cpp are in a build with COURANT_NATIVE=OFF.
#include <stdexcept>

#include "courant/core/expressions/native.hpp"
#include "courant/core/expressions/native_cache.hpp"

namespace courant {
namespace {

class NoCompiler final : public NativeCompiler {
 public:
  std::shared_ptr<const NativeCode> compile(const std::string&) const override {
    throw std::runtime_error(
        "NativeCompiler::compile: this build of Courant has no native code. Use the interpreter.");
  }
  bool is_available() const override { return false; }
};

}  // namespace

std::shared_ptr<const NativeCompiler> machine_compiler() {
  return std::make_shared<const NoCompiler>();
}

std::optional<NativeCache> NativeCache::open(std::string* defect) {
  if (defect != nullptr) *defect = "this build keeps no compiled code: it has no compiler";
  return std::nullopt;
}

// There is no cache that these could be asked of.
std::vector<NativeCache::Entry> NativeCache::entries() const { return {}; }
void NativeCache::prune(const Limits&) const {}

}  // namespace courant
