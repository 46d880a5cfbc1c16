// IntegratorAdaptor: a method whose steps are made of those of another one.
#pragma once

#include "courant/integrators/step/integrator.hpp"

namespace courant {

// What it is called and what it promises are those of the other method, and so are its formulas, unless a
// subclass says otherwise.
class IntegratorAdaptor : public Integrator {
 public:
  const std::shared_ptr<const Integrator>& wrapped() const { return wrapped_; }

  std::string name() const override { return wrapped_->name(); }
  int order() const override { return wrapped_->order(); }
  bool is_symmetric() const override { return wrapped_->is_symmetric(); }
  std::optional<bool> is_symplectic() const override { return wrapped_->is_symplectic(); }
  bool has_exact_energy() const override { return wrapped_->has_exact_energy(); }
  bool is_native() const override { return wrapped_->is_native(); }
  const Units* units() const override { return wrapped_->units(); }

 protected:
  // A method of `system` by one of `wrapped_system`. Throws std::invalid_argument, which begins with
  // `name`, if something is null or `wrapped` is a method of another system.
  IntegratorAdaptor(const char* name, std::shared_ptr<const ImplicitSystem> system,
                    const std::shared_ptr<const ImplicitSystem>& wrapped_system,
                    std::shared_ptr<const Integrator> wrapped);

  std::vector<StepFormulas> do_formulas() const override { return wrapped_->formulas(); }

 private:
  std::shared_ptr<const Integrator> wrapped_;
};

}  // namespace courant
