#include "courant/integrators/methods/integrator_adaptor.hpp"

#include <utility>

namespace courant {

IntegratorAdaptor::IntegratorAdaptor(const char* name, std::shared_ptr<const ImplicitSystem> system,
                                     const std::shared_ptr<const ImplicitSystem>& wrapped_system,
                                     std::shared_ptr<const Integrator> wrapped)
    : Integrator(std::move(system)), wrapped_(std::move(wrapped)) {
  if (!wrapped_ || wrapped_->system() != wrapped_system)
    throw std::invalid_argument(std::string(name) + "::" + name +
                                ": the method is missing, or it is not one of the system that its "
                                "steps are made for.");
}

}  // namespace courant
