#include "courant/integrators/methods/integrator_in_units.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/integrator_laws.hpp"
#include "courant/integrators/step/natural_units.hpp"
#include "courant/integrators/step/step_differential.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * the stage of a step is told in the units of its making
//  * the images of the tangent map are told in the units of its making
//  * no units are needed for numbers that are far apart
//  * a message recommends a step in another unit of time
//  * small entries are no units of small numbers (integrators/step/natural_units.cpp)
//  * what is at rest and connected with nothing has units of nothing
//    (integrators/step/natural_units.cpp)
//  * angles have units (integrators/step/natural_units.cpp)
//  * differences are as long for all numbers of a state
//    (integrators/methods/measured_differential.cpp)
//  * what round-off leaves of a zero asks for units
//  * units of what nothing tells are quotients of rounding errors
//    (integrators/step/unit_equations.cpp)
BOOST_AUTO_TEST_SUITE(integrator_in_units)

using namespace courant;

namespace {

using Pointer = std::shared_ptr<const Integrator>;

const auto kPhaseSpace = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));

// H = p²/2m + E (q/L)⁴/4: with E = m L²/T² the motion of H = p²/2 + q⁴/4 in units m, L, T.
std::shared_ptr<const DiracSystem> quartic(double m, double L, double T) {
  const double E = m * L * L / (T * T);
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(kPhaseSpace),
      std::make_shared<Hamiltonian>(kPhaseSpace, [=](const ExprVector& x, const Expr&) {
        return square(x[1]) / (2.0 * m) + 0.25 * E * square(square(x[0] / L));
      }));
}
State start(double m, double L, double T) {
  return {.x = Eigen::Vector2d(L, 0.5 * m * L / T), .v = VectorXd::Zero(2)};
}

Pointer midpoint(const std::shared_ptr<const ImplicitSystem>& system) {
  return std::make_shared<DiscretizeFirst>(
      system,
      std::make_shared<CotangentLift>(kPhaseSpace, std::make_shared<Theta>(kPhaseSpace->base())));
}
std::shared_ptr<const SystemInUnits> measured(const std::shared_ptr<const ImplicitSystem>& system,
                                              double q, double p, double T) {
  return std::make_shared<SystemInUnits>(
      system, Units{.coordinates = Eigen::Vector2d(q, p),
                    .tangent = Eigen::Vector2d(q, p),
                    .auxiliary = VectorXd::Ones(system->auxiliary_size()),
                    .equations = VectorXd::Ones(system->equation_count()),
                    .time = T});
}
Pointer in_units(const std::shared_ptr<const ImplicitSystem>& system, double q, double p, double T,
                 int order = 2) {
  const auto there = measured(system, q, p, T);
  Pointer method = midpoint(there);
  if (order > 2) method = std::make_shared<Composition>(method, order);
  return std::make_shared<IntegratorInUnits>(there, method);
}

}  // namespace

// The same steps as without units, of numbers that need none.
BOOST_AUTO_TEST_CASE(units_do_not_change_steps) {
  const auto system = quartic(1.0, 1.0, 1.0);
  const State from = start(1.0, 1.0, 1.0);
  const State expected = midpoint(system)->advance(from, 0.1, 20);
  const State found = in_units(system, 16.0, 0.25, 0.125)->advance(from, 0.1, 20);
  BOOST_TEST((found.x - expected.x).norm() < 1e-13);
  BOOST_TEST((found.v - expected.v).norm() < 1e-12);
  BOOST_TEST(found.t == expected.t);
}

// An electron in a trap of a micrometre, with p 10¹⁸ times smaller than q. Where steps are measured by the
// larger of the two, the iteration ends with q alone.
BOOST_AUTO_TEST_CASE(an_electron) {
  const double m = 9.109e-31, L = 1e-6, T = 1e-12;
  const State expected = midpoint(quartic(1.0, 1.0, 1.0))->advance(start(1.0, 1.0, 1.0), 0.1, 50);
  const auto trap = quartic(m, L, T);
  const State from = start(m, L, T);
  const State found =
      in_units(trap, std::exp2(-20.0), std::exp2(-80.0), 1.0)->advance(from, 0.1 * T, 50);
  BOOST_TEST(std::fabs(found.x[0] / L - expected.x[0]) < 1e-12);
  BOOST_TEST(std::fabs(found.x[1] * T / (m * L) - expected.x[1]) < 1e-12);
}

// What a step knows is in the units of the system, and its stages too.
BOOST_AUTO_TEST_CASE(steps_tell_restored_states) {
  const auto system = quartic(1.0, 1.0, 1.0);
  for (const int order : {2, 4}) {
    Pointer plain = midpoint(system);
    if (order > 2) plain = std::make_shared<Composition>(plain, order);
    const auto known = plain->stepper(),
               stepper = in_units(system, 16.0, 0.25, 0.125, order)->stepper();
    known->tell_parts();
    stepper->tell_parts();
    State a = start(1.0, 1.0, 1.0), b = a;
    for (int k = 0; k < 3; ++k) {
      known->step(a, 0.1);
      stepper->step(b, 0.1);
      BOOST_TEST((stepper->last().stage.x - known->last().stage.x).norm() < 1e-13);
      BOOST_TEST(stepper->last().stage.t == known->last().stage.t);
      BOOST_TEST_REQUIRE(stepper->last().parts.size() == known->last().parts.size());
      for (std::size_t i = 0; i < known->last().parts.size(); ++i)
        BOOST_TEST((stepper->last().parts[i].after.x - known->last().parts[i].after.x).norm() <
                   1e-13);
      BOOST_TEST((stepper->between(0.5).x - known->between(0.5).x).norm() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_map_is_in_the_units_of_the_system) {
  const auto system = quartic(1.0, 1.0, 1.0);
  const Pointer plain = midpoint(system), other = in_units(system, 16.0, 0.25, 0.125);
  const auto stepper = plain->stepper();
  State state = start(1.0, 1.0, 1.0);
  stepper->step(state, 0.1);
  const MatrixXd V = MatrixXd::Identity(2, 2);
  BOOST_TEST(
      ((*other->differential())(stepper->last(), V) - (*plain->differential())(stepper->last(), V))
          .norm() < 1e-13);
  BOOST_TEST(other->is_symplectic().value_or(false));
}

// Laws are measured in the units of the steps: differences of 10⁻⁹ are none of a momentum of 10⁻²⁴.
BOOST_AUTO_TEST_CASE(an_electron_keeps_every_law) {
  const double m = 9.109e-31, L = 1e-6, T = 1e-12;
  const auto trap = quartic(m, L, T);
  const Pointer method = in_units(trap, std::exp2(-20.0), std::exp2(-80.0), std::exp2(-40.0));
  const auto report = check_integrator(
      *method,
      {.system = trap, .initial = start(m, L, T), .step = 0.05 * T, .structure = trap->structure()},
      {.both_ways = true});
  BOOST_TEST(report.symplecticity.value_or(1.0) < 1e-9);
  for (const LawResult& result : report.laws) BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(units_are_needed_where_numbers_are_far_apart) {
  const auto units = [](double m, double L, double T) {
    const auto system = quartic(m, L, T);
    return needed_units(system, ConstraintAlgorithm().run(system, {.x = start(m, L, T).x}).point);
  };
  BOOST_TEST(!units(1.0, 1.0, 1.0).has_value());
  BOOST_TEST(!units(1.0, 1e-3, 1e-2).has_value());
  const auto electron = units(9.109e-31, 1e-6, 1e-12);
  BOOST_TEST_REQUIRE(electron.has_value());
  // Up to a common factor, within a factor of ten.
  const double ratio = electron->coordinates[1] / electron->coordinates[0];
  BOOST_TEST(std::fabs(std::log10(ratio / (9.109e-31 / 1e-12))) < 1.0);
  BOOST_TEST(std::fabs(std::log10(electron->time / 1e-12)) < 1.0);
  BOOST_TEST(units(6e24, 1.5e11, 3e7).has_value());
}

// Nothing connects a second electron at rest with the first one, but both are of one kind.
BOOST_AUTO_TEST_CASE(what_is_at_rest_has_the_units_of_what_moves) {
  const double m = 9.109e-31, L = 1e-6, T = 1e-12;
  const auto plane = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(plane),
      std::make_shared<Hamiltonian>(plane, [=](const ExprVector& x, const Expr&) {
        return (square(x[2]) + square(x[3])) / (2.0 * m) +
               0.5 * m / (T * T) * (square(x[0]) + square(x[1]));
      }));
  const auto units = needed_units(
      system, ConstraintAlgorithm().run(system, {.x = Eigen::Vector4d(L, 0.0, 0.0, 0.0)}).point);
  BOOST_TEST_REQUIRE(units.has_value());
  for (const Index i : {0, 2})
    BOOST_TEST(std::fabs(std::log2(units->coordinates[i + 1] / units->coordinates[i])) <= 1.0);
}

// What a run left of a zero beside numbers of 1 is still a zero.
BOOST_AUTO_TEST_CASE(what_round_off_leaves_of_a_zero_is_no_unit) {
  const auto plane = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(plane),
      std::make_shared<Hamiltonian>(plane, [](const ExprVector& x, const Expr&) {
        return 0.5 * (square(x[2]) + square(x[3]) + square(x[0]));
      }));
  for (const double left : {0.0, 2e-15, -7e-16, 1e-40})
    BOOST_TEST(!needed_units(system, {.x = Eigen::Vector4d(3.0, 0.0, 4.0, left),
                                      .v = Eigen::Vector4d(4.0, left, -3.0, 0.0)})
                    .has_value());
}

// The gate of an inverter carries no current, and no other equation contains that one: its unit is 1, not a quotient of
// rounding errors.
BOOST_AUTO_TEST_CASE(the_unit_of_what_nothing_tells_is_one) {
  const double C = 1e-13, k = 1e-4, supply = 3.3, threshold = 0.7;
  const auto line = std::make_shared<Euclidean>(1);
  // x the charge at the output; z the currents of the supply and of the gate, the voltages of both channels, the
  // potentials of gate and output.
  const auto inverter = std::make_shared<examples::FormulaSystem>(
      line, 6, 7, [=](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        const Expr below = supply - z[5], open = supply - z[4] - threshold;
        const Expr i = k * select(below < open, 2.0 * open * below - square(below), square(open));
        return ExprVector{{z[0] + i, z[1], v[0] - i, x[0] / C - z[2], x[0] / C + z[3] - supply,
                           z[4], x[0] / C - z[5]}};
      });
  const auto units = needed_units(inverter, {.x = VectorXd::Constant(1, supply * C)});
  BOOST_TEST_REQUIRE(units.has_value());
  BOOST_TEST(units->auxiliary[1] == 1.0);
}

// What sines are of has no unit: q is an angle, and p an angular momentum of 10⁻⁴⁰.
BOOST_AUTO_TEST_CASE(arguments_of_sines_are_numbers) {
  const double inertia = 1e-48, T = 1e-8;
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(kPhaseSpace),
      std::make_shared<Hamiltonian>(kPhaseSpace, [=](const ExprVector& x, const Expr&) {
        return square(x[1]) / (2.0 * inertia) - inertia / (T * T) * cos(x[0]);
      }));
  for (const double angle : {0.0, 1.0}) {
    const auto units = needed_units(
        system, ConstraintAlgorithm().run(system, {.x = Eigen::Vector2d(angle, 0.0)}).point);
    BOOST_TEST_REQUIRE(units.has_value());
    BOOST_TEST(std::fabs(std::log10(units->coordinates[0])) < 0.7);
    BOOST_TEST(std::fabs(std::log10(units->coordinates[1] / (inertia / T))) < 0.7);
    BOOST_TEST(std::fabs(std::log10(units->time / T)) < 0.7);
  }
}

// A step that cannot be made is named by its length and time in the units of the system.
BOOST_AUTO_TEST_CASE(failures_are_told_in_the_units_of_the_system) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto blow_up = std::make_shared<examples::FormulaSystem>(
      line, 0, 1, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(ExprVector::Constant(1, v[0] - square(x[0])));
      });
  const auto there = std::make_shared<SystemInUnits>(
      blow_up, Units{VectorXd::Constant(1, 4.0), VectorXd::Constant(1, 4.0), VectorXd(0),
                     VectorXd::Constant(1, 1.0), 0.125});
  const IntegratorInUnits method(
      there, std::make_shared<DiscretizeFirst>(there, std::make_shared<Theta>(line)));
  try {
    method.advance({.t = 0.5, .x = VectorXd::Constant(1, 1.0)}, 5.0);
    BOOST_TEST(false);
  } catch (const SolveError& error) {
    BOOST_TEST(error.time() == 0.5);
    BOOST_TEST(error.step_size() == 5.0);
    const std::string text = error.what();
    BOOST_TEST(text.find("the step of 5 from t = 0.5 has no solution") != std::string::npos, text);
    // (x₁ - 1)/h = ((1 + x₁)/2)² has no solution beyond h = 1/2.
    BOOST_TEST_REQUIRE(error.reach().has_value());
    BOOST_TEST(error.reach()->h == 0.5, boost::test_tools::tolerance(1e-3));
    BOOST_TEST((text.ends_with("of 0.45 would do.") || text.ends_with("of 0.44 would do.")), text);
  }
}

BOOST_AUTO_TEST_CASE(methods_of_other_systems_are_refused) {
  const auto system = quartic(1.0, 1.0, 1.0);
  const auto there = measured(system, 1.0, 1.0, 1.0);
  BOOST_CHECK_THROW(IntegratorInUnits(there, midpoint(system)), std::invalid_argument);
  BOOST_CHECK_THROW(IntegratorInUnits(there, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(IntegratorInUnits(nullptr, midpoint(system)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
