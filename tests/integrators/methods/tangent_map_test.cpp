#include "courant/integrators/methods/tangent_map.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../example_systems.hpp"
#include "../step/integrator_catalogue.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/structures/canonical_symplectic.hpp"

// Mistakes that these cases have to notice:
//  * the volume is that of the square of the form
//  * the form is that of the first point all along
BOOST_AUTO_TEST_SUITE(tangent_map)

using namespace courant;

namespace {

const std::vector<test::IntegratorEntry>& methods() {
  static const auto table = test::integrator_catalogue();
  return table;
}
const test::IntegratorEntry& method(const std::string& name) {
  const auto found = std::ranges::find_if(methods(), [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE_MESSAGE(found != methods().end(), name);
  return *found;
}

struct Defects {
  std::optional<double> symplecticity, volume;
};

Defects after(const Integrator& integrator, const IntegratorSetting& setting, double h, int steps) {
  TangentMap map(integrator, setting.conormals, setting.structure);
  const auto stepper = integrator.stepper();
  stepper->tell_parts();
  State state = setting.initial;
  stepper->prepare(state, h);
  map.begin(state.x);
  for (int k = 0; k < steps; ++k) {
    stepper->step(state, h);
    map.advance(stepper->last());
  }
  return {map.symplecticity_defect(), map.volume_defect()};
}

// The orders of both defects at a time, from those of `count` steps, twice as many, and so on.
std::pair<double, double> orders(const test::IntegratorEntry& entry, double time, int count,
                                 int times = 4) {
  std::vector<double> steps, symplecticity, volume;
  for (int k = 0; k < times; ++k, count *= 2) {
    const Defects found = after(*entry.integrator, entry.setting, time / count, count);
    steps.push_back(time / count);
    symplecticity.push_back(found.symplecticity.value());
    volume.push_back(std::abs(found.volume.value()));
  }
  return {log_log_slope(steps, symplecticity, 1e-13), log_log_slope(steps, volume, 1e-13)};
}

}  // namespace

// In particular on T*S², T*SO(3), and by compositions.
BOOST_AUTO_TEST_CASE(what_is_symplectic_stays_so_along_a_run) {
  int found = 0;
  for (const auto& [name, integrator, setting, both_ways] : methods()) {
    if (!integrator->is_symplectic().value_or(false) || !integrator->differential()) continue;
    if (setting.system->manifold()->dimension() == 0) continue;
    const Defects defects = after(*integrator, setting, setting.step, 100);
    BOOST_TEST(defects.symplecticity.value() < 1e-10, name);
    BOOST_TEST(std::abs(defects.volume.value()) < 1e-10, name);
    ++found;
  }
  BOOST_TEST(found >= 8);
}

// The reduced map without inputs is a Poisson map.
BOOST_AUTO_TEST_CASE(what_is_a_poisson_map_stays_so_along_a_run) {
  const auto& body = method("reduced, exponential: body in a fluid");
  const Defects defects = after(*body.integrator, body.setting, body.setting.step, 100);
  BOOST_TEST(defects.symplecticity.value() < 1e-10);
  BOOST_TEST(std::abs(defects.volume.value()) < 1e-10);
}

// At a fixed time the defect of a method of order p is O(h^p), or more where its first term is symplectic.
BOOST_AUTO_TEST_CASE(what_is_not_symplectic_has_a_defect_with_an_order) {
  for (const auto& [name, least] :
       {std::pair<std::string, double>{"rk2: driven pendulum", 1.85},
        {"rk4: driven pendulum", 3.85},
        {"discrete-gradient, gonzalez, midpoint: driven, coupled", 1.85},
        {"discrete-gradient, gonzalez, midpoint: rod", 1.85}}) {
    const auto [symplecticity, volume] = orders(method(name), 2.0, 80);
    BOOST_TEST(symplecticity > least, name << ": " << symplecticity);
    BOOST_TEST(symplecticity < least + 1.4, name << ": " << symplecticity);
    // T*R and T*S¹ have two dimensions, where the form is the volume.
    BOOST_TEST(std::abs(symplecticity - volume) < 0.05, name << ": " << volume);
  }
}

BOOST_AUTO_TEST_CASE(a_map_of_the_bundle_that_is_no_lift_is_symplectic_on_a_line_only) {
  const auto& flat = method("discretize-first, midpoint of T*R, no lift: driven pendulum");
  BOOST_TEST(after(*flat.integrator, flat.setting, 0.1, 20).symplecticity.value() < 1e-12);
}

// q'' = -q - c q': volumes contract as exp(-c t), those of the midpoint rule in closed form.
BOOST_AUTO_TEST_CASE(damping_contracts_volumes_as_it_should) {
  const auto plane = std::make_shared<Euclidean>(2);
  const double c = 0.3, h = 0.2;
  const auto system = std::make_shared<examples::FormulaSystem>(
      plane, 0, 2, [c](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return examples::equations({v[0] - x[1], v[1] + x[0] + c * x[1]});
      });
  const DiscretizeFirst midpoint(system, std::make_shared<Theta>(plane));
  const IntegratorSetting setting{.system = system, .initial = {.x = Eigen::Vector2d(0.4, 0.1)}};
  const Defects defects = after(midpoint, setting, h, 10);
  BOOST_TEST(!defects.symplecticity.has_value());
  // det (1 - hA/2)⁻¹ (1 + hA/2) for A = (0, 1; -1, -c).
  const double one = (1.0 - 0.5 * h * c + 0.25 * h * h) / (1.0 + 0.5 * h * c + 0.25 * h * h);
  BOOST_TEST(std::abs(*defects.volume + 1.0 - std::pow(one, 10)) < 1e-13);
}

// A point held on a curved set in S³: M_f is T*N of the set N with its form. Method 2 with the orthogonal
// projection need not keep it (Proposition 6.3): its defect has an order, and is not that of nothing.
BOOST_AUTO_TEST_CASE(on_a_constraint_set_the_form_is_pulled_back) {
  const auto& held = method("constrain-first, chordal: held on a curved set in S³");
  const auto [symplecticity, volume] = orders(held, 0.8, 4, 3);
  BOOST_TEST(symplecticity > 1.8, symplecticity);
  BOOST_TEST(symplecticity < 3.3, symplecticity);
  BOOST_TEST(volume > 1.8, volume);
}

BOOST_AUTO_TEST_CASE(it_goes_on_from_its_memory) {
  const auto& [name, integrator, setting, both_ways] =
      method("discretize-first, chordal: spherical pendulum");
  TangentMap whole(*integrator, setting.conormals, setting.structure);
  TangentMap again(*integrator, setting.conormals, setting.structure);
  const auto stepper = integrator->stepper();
  State state = setting.initial;
  whole.begin(state.x);
  for (int k = 0; k < 6; ++k) {
    if (k == 3) again.recall(whole.memory());
    stepper->step(state, setting.step);
    whole.advance(stepper->last());
    if (k >= 3) again.advance(stepper->last());
  }
  BOOST_TEST((whole.images() - again.images()).norm() == 0.0);
  BOOST_TEST(*whole.symplecticity_defect() == *again.symplecticity_defect());
  BOOST_CHECK_THROW(again.recall({}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
