#include "courant/core/expressions/backend.hpp"

#include <stdexcept>

#include "courant/core/expressions/native_module.hpp"

namespace courant {

Backend Backend::with(std::shared_ptr<const NativeCompiler> compiler) const {
  Backend result(kind_);
  result.compiler_ = std::move(compiler);
  return result;
}

std::shared_ptr<const NativeCompiler> Backend::compiler() const {
  return compiler_ != nullptr ? compiler_ : machine_compiler();
}

Backend Backend::together() const {
  Backend result = *this;
  result.module_ = std::make_shared<NativeModule>();
  return result;
}

void Backend::compile() const {
  if (kind_ == Kind::interpreter || module_ == nullptr) return;
  try {
    module_->compile(*compiler());
  } catch (const std::runtime_error&) {
    if (kind_ == Kind::native) throw;
  }
}

}  // namespace courant
