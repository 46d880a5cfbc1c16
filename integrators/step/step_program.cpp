#include "courant/integrators/step/step_program.hpp"

#include <stdexcept>

#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"

namespace courant {

StepProgram step_program(const Integrator& method) {
  if (const auto* programmed = dynamic_cast<const Programmed*>(&method))
    return programmed->program();
  throw std::invalid_argument("the steps of " + method.name() +
                              " are not known as formulas alone; expected discretize-first, "
                              "constrain-first, discrete-gradient, rk2, rk4, dopri5 or rkf78");
}

}  // namespace courant
