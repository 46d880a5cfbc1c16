#include "courant/integrators/methods/transformed_integrator.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/product_map.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discrete_gradient.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/integrator_laws.hpp"
#include "courant/integrators/methods/projector_laws.hpp"
#include "courant/integrators/step/fixed_time_projector.hpp"
#include "courant/integrators/step/step_energies.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/tests/integrators/example_systems.hpp"
#include "courant/tests/integrators/held_on_sphere.hpp"
#include "courant/tests/integrators/kepler.hpp"

using namespace courant;
using examples::Kepler;

// Mistakes that these cases have to notice:
//  * a step may go back in time
//  * the rate of a step is not told
//  * the parts of a step are told as if time were theirs
//  * the state before the last step stays
//  * the extended space is moved in from its other end (integrators/step/fixed_time_projector.cpp)
//  * times within a step are told by its ends alone (integrators/step/stepper.cpp)
BOOST_AUTO_TEST_SUITE(transformed_integrator)

namespace {

using Pointer = std::shared_ptr<const Integrator>;
using TimePointer = std::shared_ptr<const TimeTransformation>;

TimePointer symplectic(const std::shared_ptr<const ImplicitSystem>& system, TimeRate rate) {
  return std::make_shared<TimeTransformation>(
      TimeTransformation::symplectic(system, std::move(rate)));
}
TimePointer plain(std::shared_ptr<const ImplicitSystem> system, TimeRate rate) {
  return std::make_shared<TimeTransformation>(
      TimeTransformation::plain(std::move(system), std::move(rate)));
}

// Method 1 with the midpoint map lifted to T*(Q × R), or on M × R.
Pointer extended_method_1(const TimePointer& time) {
  const auto& M = time->places().manifold;
  std::shared_ptr<const DiscretizationMap> map;
  if (const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(M))
    map = std::make_shared<CotangentLift>(bundle, std::make_shared<Theta>(bundle->base()));
  else
    map = std::make_shared<Theta>(M);
  return std::make_shared<DiscretizeFirst>(time->extended(), map);
}
Pointer method_1(const TimePointer& time, int order = 2) {
  Pointer method = extended_method_1(time);
  if (order > 2) method = std::make_shared<Composition>(method, order);
  return std::make_shared<TransformedIntegrator>(time, method);
}

// The state at the time t on the curve of the step that goes beyond it, and how many steps lead there.
std::pair<State, long> state_at(const Integrator& method, State state, double h, double end) {
  const auto stepper = method.stepper();
  while (state.t < end) stepper->step(state, h);
  return {stepper->between(stepper->share_at(end)), stepper->statistics().steps};
}

Expr to_sun(const ExprVector& x, const Expr&) { return Kepler::radius(x); }

double error_of(const Kepler& kepler, const Integrator& method, double h, double end) {
  const State found = state_at(method, {.x = kepler.at(0.0)}, h, end).first;
  BOOST_TEST(std::abs(found.t - end) < 1e-13);
  return (found.x - kepler.at(end)).norm();
}

}  // namespace

// In t, against Kepler's equation.
BOOST_AUTO_TEST_CASE(orders_in_physical_time) {
  const Kepler kepler;
  for (const int order : {2, 4}) {
    const Pointer method = method_1(symplectic(kepler.system, to_sun), order);
    BOOST_TEST(method->order() == order);
    std::vector<double> steps, errors;
    for (const double count : {200.0, 300.0, 400.0, 600.0}) {
      steps.push_back((order == 2 ? 1.0 : 4.0) * 2.0 * M_PI / count);
      errors.push_back(error_of(kepler, *method, steps.back(), 7.0));
    }
    const double slope = log_log_slope(steps, errors, 1e-12);
    BOOST_TEST(std::abs(slope - order) < 0.15, "order " << order << " shows " << slope);
  }
}

// One period with e = 0.9, dt/dτ = r: what is reached with steps of one size in t takes ten times as many.
BOOST_AUTO_TEST_CASE(fewer_steps_for_the_same_error) {
  const Kepler kepler;
  const double end = 2.0 * M_PI;
  const Pointer varying = method_1(symplectic(kepler.system, to_sun));
  const auto [found, steps] = state_at(*varying, {.x = kepler.at(0.0)}, end / 400.0, end);
  const double error = (found.x - kepler.at(end)).norm();
  const DiscretizeFirst constant(
      kepler.system,
      std::make_shared<CotangentLift>(kepler.M, std::make_shared<Theta>(kepler.space)));
  const long more = 10 * steps;
  const VectorXd x =
      constant.advance({.x = kepler.at(0.0)}, end / static_cast<double>(more), more).x;
  BOOST_TEST((x - kepler.at(end)).norm() > error);
  BOOST_TEST(steps < 420);
}

// The energy returns: no drift over 150 periods, where the plain transformation of the same method drifts.
BOOST_AUTO_TEST_CASE(energy_stays_where_the_form_is_kept) {
  const Kepler kepler;
  const auto drifts = [&](const TimePointer& time) {
    const Pointer method = method_1(time);
    const auto stepper = method->stepper();
    State state{.x = kepler.at(0.0)};
    std::vector<double> greatest;
    for (int part = 0; part < 5; ++part) {
      double here = 0.0;
      for (int k = 0; k < 2000; ++k) {
        stepper->step(state, 0.1);
        here = std::max(here, std::abs(Kepler::energy(state.x) + 0.5));
      }
      greatest.push_back(here);
    }
    return greatest;
  };
  const auto kept = drifts(symplectic(kepler.system, to_sun));
  for (const double here : kept) BOOST_TEST(std::abs(here / kept.front() - 1.0) < 0.02);
  BOOST_TEST(kept.front() < 0.1);
}

// With g = 1 the steps are those of the method itself, with time and without.
BOOST_AUTO_TEST_CASE(a_rate_of_one_changes_nothing) {
  const Kepler kepler{.eccentricity = 0.3};
  const auto driven = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(kepler.M),
      std::make_shared<Hamiltonian>(kepler.M, [](const ExprVector& x, const Expr& t) {
        return 0.5 * (square(x[2]) + square(x[3])) - 1.0 / Kepler::radius(x) + 0.1 * x[0] * cos(t);
      }));
  const auto one = [](const ExprVector&, const Expr&) { return Expr(1.0); };
  const DiscretizeFirst own(
      driven, std::make_shared<CotangentLift>(kepler.M, std::make_shared<Theta>(kepler.space)));
  const State expected = own.advance({.t = 0.2, .x = kepler.at(0.0)}, 0.05, 100);
  for (const TimePointer& time : {symplectic(driven, one), plain(driven, one)}) {
    const State found = method_1(time)->advance({.t = 0.2, .x = kepler.at(0.0)}, 0.05, 100);
    BOOST_TEST((found.x - expected.x).norm() < 1e-12);
    BOOST_TEST((found.v - expected.v).norm() < 1e-11);
    BOOST_TEST(std::abs(found.t - expected.t) < 1e-13);
  }
}

// A rate of t alone has a time of closed form: dt/dτ = e^-t, t = log(1 + τ).
BOOST_AUTO_TEST_CASE(time_along_the_steps) {
  const Kepler kepler{.eccentricity = 0.3};
  const auto slower = [](const ExprVector&, const Expr& t) { return exp(-t); };
  for (const TimePointer& time :
       {symplectic(kepler.system, slower), plain(kepler.system, slower)}) {
    std::vector<double> steps, errors;
    for (const long count : {20L, 40L, 80L, 160L}) {
      steps.push_back(4.0 / static_cast<double>(count));
      const State state = method_1(time)->advance({.x = kepler.at(0.0)}, steps.back(), count);
      errors.push_back(std::abs(state.t - std::log(5.0)));
    }
    const double slope = log_log_slope(steps, errors, 1e-12);
    BOOST_TEST(std::abs(slope - 2.0) < 0.15, slope);
  }
}

// What is promised of the extended phase space is measured there, by the laws of all integrators; and
// the form of T*Q alone is not kept.
BOOST_AUTO_TEST_CASE(the_form_of_the_extended_phase_space) {
  const Kepler kepler{.eccentricity = 0.5};
  const auto curved = [](const ExprVector& x, const Expr& t) {
    return Kepler::radius(x) + 0.1 * square(x[2]) + 0.05 * sin(t);
  };
  const TimePointer time = symplectic(kepler.system, curved);
  const Pointer method = method_1(time);
  BOOST_TEST(method->is_symplectic().value_or(false));
  const State state{.x = kepler.at(1.0)};
  const IntegratorReport report =
      check_integrator(*extended_method_1(time), {.system = time->extended(),
                                                  .initial = time->to_extended(state),
                                                  .step = 0.1,
                                                  .structure = time->extended()->structure()});
  for (const LawResult& law : report.laws) BOOST_TEST(law.passed(), law);
  BOOST_TEST(report.symplecticity.value() < 1e-9);
  const IntegratorReport own = check_integrator(*method, {.system = kepler.system,
                                                          .initial = state,
                                                          .step = 0.1,
                                                          .structure = kepler.system->structure()});
  BOOST_TEST(own.symplecticity.value() > 1e-4);
  // The plain transformation claims nothing.
  BOOST_TEST(!method_1(plain(kepler.system, curved))->is_symplectic().has_value());
}

// A motion against the one with steps of one size, ten times as short and of order 4.
BOOST_AUTO_TEST_CASE(a_system_that_depends_on_time) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = std::make_shared<CotangentBundle>(line);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr& t) {
        return 0.5 * square(x[1]) - cos(x[0]) - x[0] * cos(3.0 * t);
      }));
  const State initial{.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)};
  const Composition reference(
      std::make_shared<DiscretizeFirst>(
          system, std::make_shared<CotangentLift>(M, std::make_shared<Theta>(line))),
      8);
  const auto rate = [](const ExprVector& x, const Expr& t) {
    return 1.0 / (1.0 + square(x[1]) + 0.5 * square(cos(t)));
  };
  for (const TimePointer& time : {symplectic(system, rate), plain(system, rate)})
    for (const int order : {2, 4}) {
      const Pointer method = method_1(time, order);
      std::vector<double> steps, errors;
      for (const long count : {60L, 80L, 110L, 150L}) {
        // At one τ: which part of a step leads to one t changes with the step.
        steps.push_back((order == 2 ? 3.0 : 8.0) / static_cast<double>(count));
        const State found = method->advance(initial, steps.back(), count);
        const State exact = reference.advance(initial, (found.t - initial.t) / 200.0, 200);
        errors.push_back((found.x - exact.x).norm());
      }
      const double slope = log_log_slope(steps, errors, 1e-12);
      BOOST_TEST(std::abs(slope - order) < 0.15, order << " shows " << slope);
    }
}

// A bead on a curved set of S³, by Method 2: on M_f at every node, and of order 2 in t.
BOOST_AUTO_TEST_CASE(constraints_of_method_2) {
  const examples::HeldOnSphere held;
  const auto rate = [](const ExprVector& x, const Expr&) {
    return 0.6 + square(x[0]) + 0.3 * square(x[5]);
  };
  const TimePointer time = plain(held.system, rate);
  const State start = time->to_extended(held.ladder.point);
  const ConstraintLadder ladder =
      ConstraintAlgorithm().run(time->extended(), {.x = start.x, .v = start.v, .z = start.z});
  BOOST_TEST(ladder.degrees_of_freedom == held.ladder.degrees_of_freedom + 1);
  const auto product = std::dynamic_pointer_cast<const Product>(time->places().manifold);
  const auto line = product->factors().back();
  const auto map = [&](double theta) {
    return std::make_shared<ProductMap>(
        product,
        std::vector<std::shared_ptr<const DiscretizationMap>>{
            std::make_shared<CotangentLift>(held.M, std::make_shared<Theta>(held.sphere, theta)),
            std::make_shared<Theta>(line, theta)});
  };
  const TransformedIntegrator method(
      time, std::make_shared<ConstrainFirst>(time->extended(), ladder, map(0.5),
                                             std::make_shared<FixedTimeProjector>(
                                                 std::make_shared<OrthogonalProjector>(), held.M)));
  const auto stepper = method.stepper();
  State state = held.ladder.point;
  double greatest = 0.0, shortest = 1.0, longest = 0.0;
  for (int k = 0; k < 500; ++k) {
    stepper->step(state, 0.05);
    greatest = std::max(greatest, examples::HeldOnSphere::violation(state.x));
    const double duration = state.t - stepper->last().before.t;
    BOOST_TEST(stepper->last().duration() == duration, boost::test_tools::tolerance(1e-12));
    shortest = std::min(shortest, duration), longest = std::max(longest, duration);
  }
  BOOST_TEST(greatest < 1e-12);
  BOOST_TEST(longest > 1.5 * shortest);

  const ConstrainFirst own(
      held.system, held.ladder,
      std::make_shared<CotangentLift>(held.M, std::make_shared<Theta>(held.sphere)),
      std::make_shared<OrthogonalProjector>());
  const State exact =
      Composition(std::make_shared<ConstrainFirst>(own), 6).advance(held.ladder.point, 0.0125, 160);
  std::vector<double> steps, errors;
  for (const double h : {0.1, 0.07, 0.05, 0.035}) {
    steps.push_back(h);
    errors.push_back((state_at(method, held.ladder.point, h, 2.0).first.x - exact.x).norm());
  }
  const double slope = log_log_slope(steps, errors, 1e-12);
  BOOST_TEST(std::abs(slope - 2.0) < 0.15, slope);
}

// Discrete gradients keep the energy in steps of any size.
BOOST_AUTO_TEST_CASE(exact_energy_with_varying_steps) {
  const Kepler kepler{.eccentricity = 0.7};
  const TimePointer time = plain(kepler.system, to_sun);
  const auto map = std::make_shared<Theta>(time->places().manifold);
  VectorXd units = VectorXd::Ones(5);
  units[4] = 1e150;
  const TransformedIntegrator method(
      time, std::make_shared<DiscreteGradient>(time->extended(), map,
                                               std::make_shared<GonzalezDifferential>(),
                                               DiscreteGradient::Options{.units = units}));
  BOOST_TEST(method.has_exact_energy());
  const auto stepper = method.stepper();
  State state{.x = kepler.at(0.0)};
  double greatest = 0.0;
  for (int k = 0; k < 300; ++k) {
    stepper->step(state, 0.1);
    greatest = std::max(greatest, std::abs(Kepler::energy(state.x) + 0.5));
  }
  BOOST_TEST(greatest < 1e-12);
}

// Van der Pol's oscillator with μ = 30, an implicit system by its equations alone: steps that follow
// the speed of the motion, against ten times as many of one size.
BOOST_AUTO_TEST_CASE(fast_phases_of_an_implicit_system) {
  const auto space = std::make_shared<Euclidean>(2);
  const auto system = std::make_shared<examples::FormulaSystem>(
      space, 0, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector{{v[0] - x[1], v[1] - 30.0 * (1.0 - square(x[0])) * x[1] + x[0]}};
      });
  const TimePointer time =
      plain(system, [](const ExprVector& x, const Expr&) { return 1.0 / (1.0 + abs(x[1])); });
  const Pointer method = method_1(time);
  const State initial{.x = Eigen::Vector2d(2.0, 0.0)};
  const auto [found, steps] = state_at(*method, initial, 0.05, 30.0);
  const State exact = state_at(*method, initial, 0.003, 30.0).first;
  // The jump from x = 1 to x = -2 lies in between.
  BOOST_TEST(exact.x[0] < -1.5);
  BOOST_TEST(steps < 750);
  const double error = (found.x - exact.x).norm();
  BOOST_TEST(error < 3e-4);
  const DiscretizeFirst equal(system, std::make_shared<Theta>(space));
  const long more = 9 * steps;
  const State other = equal.advance(initial, 30.0 / static_cast<double>(more), more);
  BOOST_TEST((other.x - exact.x).norm() > 3.0 * error);
}

// dt/dτ = q₀ vanishes where the motion goes: the step there is refused, and the state stays.
BOOST_AUTO_TEST_CASE(a_rate_that_vanishes) {
  const Kepler kepler{.eccentricity = 0.3};
  for (const bool is_plain : {false, true}) {
    const auto rate = [](const ExprVector& x, const Expr&) -> Expr { return x[0]; };
    const TimePointer time =
        is_plain ? plain(kepler.system, rate) : symplectic(kepler.system, rate);
    const auto stepper = method_1(time)->stepper();
    State state{.x = kepler.at(4.0)};
    BOOST_TEST(state.x[0] < 0.0);
    const State before = state;
    BOOST_CHECK_EXCEPTION(stepper->step(state, 0.1), SolveError, [](const SolveError& error) {
      return std::string(error.what()).find("dt/dtau has to be positive") != std::string::npos;
    });
    BOOST_TEST((state == before));
  }
}

// W1 and W2: a state is all there is to know of a run, what it carries included.
BOOST_AUTO_TEST_CASE(a_state_says_all) {
  const Kepler kepler;
  const Pointer method = method_1(symplectic(kepler.system, to_sun), 4);
  const auto stepper = method->stepper();
  State state{.x = kepler.at(0.0)};
  for (int k = 0; k < 20; ++k) stepper->step(state, 0.2);
  BOOST_TEST(state.carried.size() == 1);
  // p_t is that of the start: H(x) there differs from H at the start.
  BOOST_TEST(std::abs(state.carried[0] - 0.5) < 1e-13);
  const State copy = state;
  stepper->forget();
  State one = copy, two = copy;
  stepper->step(one, 0.2);
  method->stepper()->step(two, 0.2);
  BOOST_TEST((one == two));
  // Back again.
  stepper->step(one, -0.2);
  BOOST_TEST((one.x - copy.x).norm() < 1e-12);
  BOOST_TEST(std::abs(one.t - copy.t) < 1e-13);
  // The parts of a step add up to it.
  stepper->tell_parts();
  State three = copy;
  stepper->step(three, 0.2);
  double sum = 0.0;
  for (const Step& part : stepper->last().parts) sum += part.duration();
  BOOST_TEST(stepper->last().parts.size() == 5U);
  BOOST_TEST(std::abs(sum - (three.t - copy.t)) < 1e-14);
  BOOST_CHECK_THROW(stepper->share_at(three.t + 1.0), std::invalid_argument);
}

// x₀² + x₁² = (1 + t)²: points move along their radius, at the same time.
BOOST_AUTO_TEST_CASE(projections_at_one_time) {
  const auto space = std::make_shared<Euclidean>(2);
  const Product product({space, std::make_shared<Euclidean>(1)});
  const FixedTimeProjector projector(std::make_shared<OrthogonalProjector>(), space);
  std::vector<ConstrainedPoint> points;
  for (const double angle : {0.3, 1.8, 4.0}) {
    const Eigen::Vector3d x(1.5 * std::cos(angle), 1.5 * std::sin(angle), 0.5);
    const Eigen::Vector3d conormal = Eigen::Vector3d(x[0], x[1], -1.5).normalized();
    points.push_back({x, conormal.transpose()});
    const MatrixXd W = projector.directions(x, product.tangent_basis(x), conormal);
    BOOST_TEST(W(2, 0) == 0.0);
    BOOST_TEST(std::abs(W(0, 0) * x[1] - W(1, 0) * x[0]) < 1e-15);
  }
  for (const LawResult& law : check_projector(projector, product, points))
    BOOST_TEST(law.passed(), law);
  // t = 0.5 is no constraint of points.
  BOOST_CHECK_THROW(projector.directions(points[0].x, product.tangent_basis(points[0].x),
                                         Eigen::Vector3d(0.0, 0.0, 1.0)),
                    std::domain_error);
  BOOST_CHECK_THROW(FixedTimeProjector(nullptr, space), std::invalid_argument);
  BOOST_CHECK_THROW(FixedTimeProjector(std::make_shared<OrthogonalProjector>(), nullptr),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(what_is_no_method_of_the_extended_system) {
  const Kepler kepler;
  const TimePointer time = symplectic(kepler.system, to_sun);
  const auto own = std::make_shared<DiscretizeFirst>(
      kepler.system,
      std::make_shared<CotangentLift>(kepler.M, std::make_shared<Theta>(kepler.space)));
  BOOST_CHECK_THROW(TransformedIntegrator(time, own), std::invalid_argument);
  BOOST_CHECK_THROW(TransformedIntegrator(time, nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
