#include "courant/reading/method_in_units.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/reading/experiment.hpp"

BOOST_AUTO_TEST_SUITE(method_in_units_test)

using namespace courant;

namespace {

// Prepared for a method that this JSON describes, from coordinates that are held.
PreparedMethod prepared(const Json& system_of, const Json& initial, const Json& method, double T) {
  const Experiment experiment = read_experiment(Json{
      {"system", system_of},
      {"initial", initial},
      {"method", method},
      {"time", {{"step", 0.01 * T}, {"end", T}}}}.dump());
  const auto& system = experiment.model.system;
  const ConstraintLadder ladder =
      ConstraintAlgorithm().run(system, {.x = experiment.initial.x.values, .hold_x = {0, 1, 2, 3}});
  return experiment.method->prepare({.system = system,
                                     .ladder = ladder,
                                     .initial = ladder.point,
                                     .step = 0.01 * T,
                                     .backend = Backend::interpreter,
                                     .vocabulary = &experiment.model.vocabulary});
}

// Kepler's problem by momenta.
PreparedMethod orbit(double m, double l, double T, const Json& method) {
  return prepared({{"type", "mechanical"},
                   {"parameters", {{"m", m}, {"k", m * l * l * l / (T * T)}}},
                   {"coordinates", {"x", "y"}},
                   {"metric", "m"},
                   {"potential", "-k/sqrt(x^2 + y^2)"}},
                  {{"x", l}, {"y", 0}, {"p_x", 0}, {"p_y", m * l / T}}, method, T);
}

// A bead on a ring.
PreparedMethod bead(double m, double l, double T, const Json& method) {
  return prepared({{"type", "mechanical"},
                   {"parameters", {{"m", m}, {"l", l}}},
                   {"coordinates", {"x", "y"}},
                   {"metric", "m"},
                   {"holonomic", "(x/l)^2 + (y/l)^2 - 1"}},
                  {{"x", l}, {"y", 0}, {"p_x", 0}, {"p_y", m * l / T}}, method, T);
}

bool is_in_units(const PreparedMethod& method) {
  return dynamic_cast<const IntegratorInUnits*>(method.integrator.get()) != nullptr;
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_electron_is_moved_in_units) {
  for (const char* type : {"discretize-first", "constrain-first", "rk4"}) {
    BOOST_TEST(is_in_units(orbit(9.109e-31, 1e-6, 1e-12, {{"type", type}})), type);
    BOOST_TEST(!is_in_units(orbit(1.0, 1.0, 1.0, {{"type", type}})), type);
  }
  // The initial state is that of the system.
  const PreparedMethod method = orbit(9.109e-31, 1e-6, 1e-12, {{"type", "rk4"}});
  BOOST_TEST(method.initial.x[0] == 1e-6);
}

// Whatever a projector measures by: steps are made in units all the same.
BOOST_AUTO_TEST_CASE(projectors_are_those_of_the_experiment) {
  const Json euclidean = {{"type", "constrain-first"},
                          {"projector", {{"type", "orthogonal"}, {"metric", "euclidean"}}}};
  BOOST_TEST(is_in_units(orbit(9.109e-31, 1e-6, 1e-12, euclidean)));
  const PreparedMethod small = bead(1e-8, 1.0, 1.0, euclidean);
  BOOST_TEST(is_in_units(small));
  BOOST_TEST(small.metric == "euclidean");
  const PreparedMethod usual = bead(1e-8, 1.0, 1.0, {{"type", "constrain-first"}});
  BOOST_TEST(is_in_units(usual));
  BOOST_TEST(usual.metric == "kinetic");
}

BOOST_AUTO_TEST_SUITE_END()
