#include "courant/integrators/step_program.hpp"

#include <stdexcept>

#include "courant/integrators/integrator.hpp"

namespace courant {

StepProgram step_program(const Integrator& method) {
  if (const auto* programmed = dynamic_cast<const Programmed*>(&method))
    return programmed->program();
  throw std::invalid_argument("the steps of " + method.name() +
                              " are not known as formulas alone; expected discretize-first, "
                              "constrain-first, discrete-gradient, rk2, rk4, dopri5 or rkf78");
}

void check_program_space(const std::string& method, const Manifold& M) {
  Graph graph;
  const bool has_equations = M.constraint(graph.variables("x", M.ambient_dimension())).size() > 0;
  if (!has_equations && M.dimension() == M.tangent_dimension()) return;
  throw std::invalid_argument(method + " on " + M.name() +
                              " keeps its points there and turns a basis along, which is not "
                              "among the formulas of a step; expected a system on Rⁿ or a torus");
}

}  // namespace courant
