// What integrators call immutable, or allow any number of threads to ask at once, is asked by eight. Of the point vortices in
// both forms and of Kepler's problem, by methods of each kind, interpreted and compiled: one integrator, whose steppers are
// made and make steps at once; methods that are made at once of one system; the constraint algorithm of one system; one flow
// with its tangent map. All threads must find the same numbers.
#include <memory>

#include "../integrators/kepler.hpp"
#include "../integrators/vortices.hpp"
#include "by_all.hpp"
#include "courant/integrators/certificate/certificate.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/discrete_flow.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/verlet.hpp"

namespace courant {
namespace {

// A method, and how it is made again.
struct Case {
  std::string name;
  std::function<std::shared_ptr<const Integrator>()> make;
  InitialGuess start;
  double h;
};

std::vector<Case> cases(const Backend& backend) {
  const std::string how = backend == Backend::native ? ", native" : ", interpreted";
  const auto plain = vortices::regular_form();
  const auto degenerate = std::make_shared<vortices::Degenerate>(vortices::lagrangian_form());
  const VectorXd q = vortices::positions();
  const auto map = std::make_shared<Theta>(plain->manifold(), 0.5);
  const auto method_1 = [=] {
    return std::make_shared<DiscretizeFirst>(plain, map,
                                             DiscretizeFirst::Options{.backend = backend});
  };
  const auto ladder = std::make_shared<ConstraintLadder>(
      certificate(degenerate->system, {.x = degenerate->over(q)}));
  const examples::Kepler kepler{.eccentricity = 0.3};
  const auto of_kepler =
      std::make_shared<ConstraintLadder>(certificate(kepler.system, {.x = kepler.at(0.0)}));
  const auto lift =
      std::make_shared<CotangentLift>(kepler.M, std::make_shared<Theta>(kepler.space, 0.0));
  return {{"Method 1" + how, method_1, {.x = q}, 0.3},
          {"Method 1, order 4" + how,
           [=] { return std::make_shared<Composition>(method_1(), 4); },
           {.x = q},
           0.3},
          {"Method 2" + how,
           [=] {
             return std::make_shared<ConstrainFirst>(
                 degenerate->system, *ladder, degenerate->theta(0.5),
                 std::make_shared<MomentumProjector>(degenerate->phase_space),
                 ConstrainFirst::Options{.backend = backend});
           },
           {.x = degenerate->over(q)},
           0.3},
          {"Verlet" + how,
           [=] {
             return std::make_shared<Verlet>(kepler.system, *of_kepler, lift,
                                             Verlet::Options{.backend = backend});
           },
           {.x = kepler.at(0.0)},
           0.05},
          {"a Runge–Kutta method" + how,
           [=] {
             return std::make_shared<ExplicitRungeKutta>(
                 std::make_shared<VectorField>(kepler.system, *of_kepler, backend),
                 ExplicitRungeKutta::Kind::classical);
           },
           {.x = kepler.at(0.0)},
           0.05}};
}

void ask_at_once(const Case& one) {
  const std::shared_ptr<const Integrator> method = one.make();
  State start{.x = one.start.x};
  method->stepper()->prepare(start, one.h);
  require_one_answer(one.name + ": steppers of one integrator",
                     [&] { return method->advance(start, one.h, 50).x; });
  require_one_answer(one.name + ": made at once",
                     [&] { return one.make()->advance(start, one.h, 3).x; });
  require_one_answer(one.name + ": the constraint algorithm",
                     [&] { return certificate(method->system(), one.start).point.x; });
  // Along constraints directions would have to be found first.
  if (method->differential() == nullptr ||
      certificate(method->system(), one.start).conormals().rows() > 0)
    return;
  const DiscreteFlow flow(method, one.h, 5);
  const MatrixXd V = MatrixXd::Identity(start.x.size(), 1);
  require_one_answer(one.name + ": one flow",
                     [&] { return VectorXd(flow.push_forward(start, V).directions.col(0)); });
}

}  // namespace
}  // namespace courant

int main() {
  using namespace courant;
  for (const Backend& backend : {Backend::interpreter, Backend::native})
    for (const Case& one : cases(backend)) ask_at_once(one);
  return differences > 0 ? 1 : 0;
}
