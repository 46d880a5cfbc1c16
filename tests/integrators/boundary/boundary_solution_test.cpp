#include "courant/integrators/boundary/boundary_solution.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "../example_systems.hpp"
#include "courant/integrators/boundary/conjugate_times.hpp"
#include "courant/integrators/boundary/shooting.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * the derivative by the size of steps forgets that nodes begin later (integrators/boundary/shooting.cpp)
//  * nodes leave the constraint set, or directions are those of another node (consistent_points.cpp)
//  * least squares pass for a solution, a family for an isolated one (boundary_solution.cpp)
//  * the steps of Newton's method are not damped
//  * fields that keep the initial conditions are not alone in the test of second order (conjugate_times.cpp)
BOOST_AUTO_TEST_SUITE(boundary_solution)

using namespace courant;
using Verdict = BoundarySolution::Verdict;

namespace {

constexpr double kPi = std::numbers::pi;

VectorXd vector(std::initializer_list<double> entries) {
  return Eigen::Map<const VectorXd>(entries.begin(), static_cast<Index>(entries.size()));
}

std::shared_ptr<const CotangentBundle> phase_space(Index n) {
  return std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
}

using Energy = std::function<Expr(const ExprVector& x)>;
std::shared_ptr<const ImplicitSystem> hamiltonian(const std::shared_ptr<const CotangentBundle>& M,
                                                  const Energy& H) {
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [H](const ExprVector& x, const Expr&) { return H(x); }));
}

// By the midpoint rule, of a higher order by composition.
std::shared_ptr<const Integrator> midpoint(const std::shared_ptr<const ImplicitSystem>& system,
                                           int order = 2) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system->manifold());
  std::shared_ptr<const DiscretizationMap> map;
  if (bundle)
    map = std::make_shared<CotangentLift>(bundle, std::make_shared<Theta>(bundle->base(), 0.5));
  else
    map = std::make_shared<Theta>(system->manifold(), 0.5);
  std::shared_ptr<const Integrator> method = std::make_shared<DiscretizeFirst>(
      system, map, DiscretizeFirst::Options{Backend::interpreter});
  if (order > 2) method = std::make_shared<Composition>(method, order);
  return method;
}

BoundaryProblem problem_of(const std::shared_ptr<const Integrator>& method, const VectorXd& x,
                           double duration, long steps) {
  BoundaryProblem problem;
  problem.method = method;
  problem.ladder = certificate(method->system(), {.x = x}, {}, Decider::bounds);
  problem.guess = problem.ladder.point;
  problem.h = duration / static_cast<double>(steps);
  problem.steps = steps;
  return problem;
}

// Coordinates i, i+1, … have these values.
EndConditions at(const VectorXd& values, Index first = 0) {
  return {.formula = [=](const EndPoint& end) {
    return ExprVector(end.x.segment(first, values.size()) - values.cast<Expr>());
  }};
}

const std::shared_ptr<const ImplicitSystem>& pendulum() {
  static const auto system = hamiltonian(
      phase_space(1), [](const ExprVector& x) { return x[1] * x[1] / 2.0 - cos(x[0]); });
  return system;
}

// Of the pendulum: 4 K(sin(a/2)), by the arithmetic-geometric mean.
double swing(double a) {
  double x = 1.0, y = std::cos(0.5 * a);
  for (int i = 0; i < 8; ++i) {
    const double mean = 0.5 * (x + y);
    y = std::sqrt(x * y);
    x = mean;
  }
  return 2.0 * kPi / x;
}

// A particle on the unit sphere in R³, with a multiplier: |q|² = 1, q' = v, v' = -λ q - g e_3.
std::shared_ptr<const ImplicitSystem> spherical(double g) {
  return std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(6), 1, 7,
      [g](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return examples::equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + z[0] * x[0],
                                    v[4] + z[0] * x[1], v[5] + z[0] * x[2] + g,
                                    x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1.0});
      });
}

std::shared_ptr<const Integrator> method_2(const std::shared_ptr<const ImplicitSystem>& system,
                                           const ConstraintLadder& ladder) {
  return std::make_shared<ConstrainFirst>(
      system, ladder, std::make_shared<Theta>(system->manifold(), 0.5),
      std::make_shared<OrthogonalProjector>(), ConstrainFirst::Options{Backend::interpreter});
}

BoundaryProblem spherical_problem(double g, const VectorXd& x, double duration, long steps) {
  const auto system = spherical(g);
  BoundaryProblem problem;
  problem.ladder = certificate(system, {.x = x}, {}, Decider::bounds);
  problem.method = method_2(system, problem.ladder);
  problem.guess = problem.ladder.point;
  problem.h = duration / static_cast<double>(steps);
  problem.steps = steps;
  return problem;
}

}  // namespace

// q'' = -q with q(0) = a, q(T) = b: p(0) = (b - a cos T)/sin T, of the midpoint rule with nθ for T, tan(θ/2) = h/2.
BOOST_AUTO_TEST_CASE(an_oscillator_between_two_places_has_the_momentum_of_the_discrete_flow) {
  const auto system = hamiltonian(
      phase_space(1), [](const ExprVector& x) { return (x[1] * x[1] + x[0] * x[0]) / 2.0; });
  const double a = 0.3, b = -0.7, T = 2.0;
  const long n = 40;
  BoundaryProblem problem = problem_of(midpoint(system), vector({a, 0}), T, n);
  problem.initial = at(vector({a}));
  problem.final = at(vector({b}));
  for (const long segments : {1L, 4L, 40L}) {
    problem.segments = segments;
    const auto solution = solve_boundary_problem(problem);
    BOOST_TEST((solution.verdict == Verdict::isolated), solution.reason);
    const double angle = 2.0 * std::atan(0.5 * problem.h) * static_cast<double>(n);
    BOOST_TEST(std::abs(solution.start.x[1] - (b - a * std::cos(angle)) / std::sin(angle)) < 1e-12);
    BOOST_TEST(solution.iterations <= 3);  // it is linear
    BOOST_TEST(solution.conditions.size() == 2u);
    for (const auto& condition : solution.conditions)
      BOOST_TEST(std::abs(condition.residual) < 1e-12, condition.name);
    BOOST_TEST_REQUIRE(solution.conjugate_times.has_value());
    BOOST_TEST(solution.conjugate_times->empty());
  }
}

// The same with T beyond π: one conjugate point, where sin(nθ t/T) = 0.
BOOST_AUTO_TEST_CASE(an_oscillator_has_a_conjugate_point_after_half_its_period) {
  const auto system = hamiltonian(
      phase_space(1), [](const ExprVector& x) { return (x[1] * x[1] + x[0] * x[0]) / 2.0; });
  BoundaryProblem problem = problem_of(midpoint(system), vector({0.3, 0}), 7.0, 700);
  problem.initial = at(vector({0.3}));
  problem.final = at(vector({-0.7}));
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE(solution.conjugate_times.has_value());
  BOOST_TEST_REQUIRE(solution.conjugate_times->size() == 2u);
  const double half = kPi / (2.0 * std::atan(0.5 * problem.h)) * problem.h;
  BOOST_TEST(std::abs((*solution.conjugate_times)[0] - half) < 1e-5);
  BOOST_TEST(std::abs((*solution.conjugate_times)[1] - 2.0 * half) < 1e-5);
}

// From one end of the horizontal to the other in half a swing: what the period says of the amplitude, to the order of the method.
BOOST_AUTO_TEST_CASE(a_pendulum_between_turning_points_converges_with_the_order_of_its_method) {
  const double a = 2.0;
  std::vector<double> errors;
  for (const long n : {20L, 40L, 80L, 160L}) {
    BoundaryProblem problem = problem_of(midpoint(pendulum()), vector({1.5, 0}), swing(a) / 2, n);
    problem.initial = at(vector({0.0}), 1);
    problem.final = at(vector({0.0}), 1);
    const auto solution = solve_boundary_problem(problem);
    BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
    errors.push_back(std::abs(std::abs(solution.start.x[0]) - a));
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    BOOST_TEST(std::abs(std::log2(errors[i - 1] / errors[i]) - 2.0) < 0.15,
               errors[i - 1] << " " << errors[i]);
}

// The period of a swing that is released at rest at a given angle: 4 K(sin(a/2)). Order 4.
BOOST_AUTO_TEST_CASE(a_free_period_is_the_elliptic_integral_and_its_multipliers_are_one) {
  const double a = 2.0;
  std::vector<double> errors;
  for (const long n : {40L, 80L, 160L, 320L}) {
    BoundaryProblem problem = problem_of(midpoint(pendulum(), 4), vector({1.9, 0.5}), 8.0, n);
    problem.initial = at(vector({a}));
    problem.is_periodic = true;
    problem.has_free_time = true;
    const auto solution = solve_boundary_problem(problem);
    BOOST_TEST_REQUIRE((solution.verdict != Verdict::unsolved), solution.reason);
    // Where it is given, but not that it is at rest there, the amplitude is free.
    BOOST_TEST(solution.family_dimension == 1);
    problem.initial = at(vector({a, 0}));
    const auto isolated = solve_boundary_problem(problem);
    BOOST_TEST_REQUIRE((isolated.verdict == Verdict::isolated), isolated.reason);
    BOOST_TEST(isolated.rank.rank == isolated.rank.columns);
    errors.push_back(std::abs(isolated.duration() - swing(a)));
    BOOST_TEST_REQUIRE(isolated.floquet.size() == 2);
    for (const auto& multiplier : isolated.floquet) BOOST_TEST(std::abs(multiplier - 1.0) < 1e-4);
    BOOST_TEST(*isolated.closure < 1e-11);
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    BOOST_TEST(std::abs(std::log2(errors[i - 1] / errors[i]) - 4.0) < 0.3,
               errors[i - 1] << " " << errors[i]);
}

// Van der Pol's cycle is the only one, and may begin anywhere. Its period at μ = 1 is 6.6632868593231301896996820305 (J. Guckenheimer,
// B. Meloon, SIAM J. Sci. Comput. 22 (2000) 951; periods of AUTO); one multiplier is 1, the other exp(∮ div) < 1.
BOOST_AUTO_TEST_CASE(a_limit_cycle_is_isolated_up_to_its_phase) {
  const auto system = std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(2), 0, 2,
      [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return examples::equations({v[0] - x[1], v[1] - (1.0 - x[0] * x[0]) * x[1] + x[0]});
      });
  BoundaryProblem problem = problem_of(midpoint(system, 4), vector({1.5, 0}), 6.0, 200);
  problem.is_periodic = true;
  problem.has_free_time = true;
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  BOOST_TEST(solution.has_phase);
  BOOST_TEST(std::abs(solution.duration() - 6.66328685932) < 2e-5);
  BOOST_TEST(std::abs(solution.floquet[0] - 1.0) < 1e-5);
  BOOST_TEST(std::abs(solution.floquet[1]) < 0.01);
}

// On the torus a pendulum that turns over closes after 2π.
BOOST_AUTO_TEST_CASE(angles_close_modulo_their_turn) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Torus>(1));
  const auto system =
      hamiltonian(M, [](const ExprVector& x) { return x[1] * x[1] / 2.0 - cos(x[0]); });
  BoundaryProblem problem = problem_of(midpoint(system, 4), vector({0, 2.5}), 3.0, 100);
  problem.initial = at(vector({0, 2.5}));
  problem.is_periodic = true;
  problem.has_free_time = true;
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  // T = 2 k K(k), k = 2/p(0), k K(k) = (π/2) k / agm(1, √(1 - k²)).
  double x = 1.0, y = std::sqrt(1.0 - 0.64);
  for (int i = 0; i < 8; ++i) std::tie(x, y) = std::pair(0.5 * (x + y), std::sqrt(x * y));
  BOOST_TEST(std::abs(solution.duration() - 0.8 * kPi / x) < 1e-5);
}

// Of Method 2 every node is on the constraint set, positions and velocities. Without gravity the shortest way is a great circle of
// this speed; between poles there is a family, beyond them a conjugate point.
BOOST_AUTO_TEST_CASE(nodes_of_method_2_stay_on_the_constraint_set) {
  const double angle = 2.0;
  BoundaryProblem problem = spherical_problem(0.0, vector({1, 0, 0, 0, 0.8, 0.4}), 1.0, 40);
  problem.initial = at(vector({1, 0, 0}));
  problem.final = at(vector({std::cos(angle), std::sin(angle), 0}));
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  BOOST_TEST(solution.nodes.size() > 1u);
  for (const State& node : solution.nodes) {
    BOOST_TEST(std::abs(node.x.head(3).squaredNorm() - 1.0) < 1e-12);
    BOOST_TEST(std::abs(node.x.head(3).dot(node.x.tail(3))) < 1e-12);
  }
  BOOST_TEST((solution.start.x - vector({1, 0, 0, 0, angle, 0})).norm() < 2e-3);
  BOOST_TEST_REQUIRE(solution.conjugate_times.has_value());
  BOOST_TEST(solution.conjugate_times->empty());

  // The other way round: beyond π.
  problem = spherical_problem(0.0, vector({1, 0, 0, 0, -4.0, 0.2}), 1.0, 100);
  problem.initial = at(vector({1, 0, 0}));
  problem.final = at(vector({std::cos(angle), std::sin(angle), 0}));
  const auto longer = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((longer.verdict == Verdict::isolated), longer.reason);
  BOOST_TEST(std::abs(longer.start.x[4] + 2.0 * kPi - angle) < 1e-2);
  BOOST_TEST_REQUIRE(longer.conjugate_times.has_value());
  BOOST_TEST_REQUIRE(longer.conjugate_times->size() == 1u);
  BOOST_TEST(std::abs(longer.conjugate_times->front() - kPi / (2.0 * kPi - angle)) < 1e-2);

  // To the other pole there is a way in each direction.
  problem = spherical_problem(0.0, vector({1, 0, 0, 0, 3.0, 0.3}), 1.0, 40);
  problem.initial = at(vector({1, 0, 0}));
  problem.final = at(vector({-1, 0, 0}));
  const auto all = solve_boundary_problem(problem);
  BOOST_TEST((all.verdict == Verdict::family), all.reason);
  BOOST_TEST(all.family_dimension == 1);
}

// The shooting matrix beside differences of order 8 of the equations: on a sphere with gravity, with a free time, conditions on
// velocities and explicit times, a multiplier.
BOOST_AUTO_TEST_CASE(the_shooting_matrix_is_that_of_differences) {
  BoundaryProblem problem =
      spherical_problem(1.3, vector({0.6, 0.0, -0.8, 0.4, 0.9, 0.3}), 1.7, 24);
  problem.guess.t = 0.4;
  problem.segments = 3;
  problem.has_free_time = true;
  problem.initial = {.formula = [](const EndPoint& end) {
    return ExprVector{{end.x[0] * end.x[1] - 0.3, end.v[3] * end.x[4] + end.z[0]}};
  }};
  problem.final = {
      .formula =
          [](const EndPoint& end) {
            return ExprVector{{end.x[0] - cos(end.t) + end.multipliers[0],
                               end.v[4] - end.t * end.x[3], end.multipliers[0] * end.x[5] - 1.0}};
          },
      .multipliers = 1};
  const Shooting shooting(problem);
  Shooting::Motion motion = shooting.guess();
  motion.multipliers[0] = 0.7;
  auto bases = shooting.bases(motion);
  VectorXd bump = VectorXd::Zero(3 * 4 + 2);
  bump << 0.1, -0.05, 0.02, 0.1, 0.04, 0.1, -0.1, 0.03, -0.02, 0.06, 0.01, -0.1, 0.05, 0.2;
  motion = shooting.moved(motion, bases, bump);  // with jumps
  bases = shooting.bases(motion);
  const auto linear = shooting.linear(motion, bases);
  BOOST_TEST_REQUIRE(linear.matrix.cols() == 14);
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  for (const double size : {0.02, 0.01})
    for (Index j = 0; j < 14; ++j) {
      VectorXd sum = VectorXd::Zero(linear.residual.size());
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const double s = static_cast<double>(i + 1) * size;
        const auto beside = [&](double along) {
          return shooting.residual(shooting.moved(motion, bases, along * VectorXd::Unit(14, j)),
                                   bases);
        };
        sum += weights[i] / size * (beside(s) - beside(-s));
      }
      BOOST_TEST((sum - linear.matrix.col(j)).norm() < 1e-9 * (1.0 + sum.norm()),
                 "column " << j << ": " << (sum - linear.matrix.col(j)).norm());
    }
}

// x'' = 0, as far as it is from the origin at the beginning: in what time it comes to a point on a moving screen.
BOOST_AUTO_TEST_CASE(a_free_time_meets_an_end_that_moves) {
  const auto system =
      hamiltonian(phase_space(1), [](const ExprVector& x) { return x[1] * x[1] / 2.0; });
  BoundaryProblem problem = problem_of(midpoint(system), vector({0, 1}), 1.0, 10);
  problem.guess.t = 2.0;
  problem.initial = at(vector({0, 1.5}));
  problem.final = {.formula = [](const EndPoint& end) {
    return ExprVector{{end.x[0] - 0.5 - end.t * end.t / 16.0}};
  }};
  problem.has_free_time = true;
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  const double T = solution.duration();
  BOOST_TEST(std::abs(1.5 * T - 0.5 - (2.0 + T) * (2.0 + T) / 16.0) < 1e-10);
}

// Near the separatrix steps of Newton's method are 20 times as long as the way to the solution; limited ones come to it, each
// shorter than half of the one before in the end.
BOOST_AUTO_TEST_CASE(steps_are_limited_by_what_the_linear_model_explains) {
  BoundaryProblem problem = problem_of(midpoint(pendulum()), vector({0.0, 3.0}), 8.0, 100);
  problem.initial = at(vector({0.0}));
  problem.final = at(vector({1.0}));
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  BOOST_TEST(std::abs(solution.start.x[1] - 3.0) < 2.0);
  BOOST_TEST(solution.iterations < 15);
  for (const auto& condition : solution.conditions) BOOST_TEST(std::abs(condition.residual) < 1e-9);
}

// Beyond what is there: on the sphere, no motion meets a point off it, and no run of an oscillator that ends at rest at 0 began elsewhere.
BOOST_AUTO_TEST_CASE(ends_that_nothing_reaches_are_said) {
  BoundaryProblem problem = spherical_problem(0.0, vector({1, 0, 0, 0, 0.8, 0.4}), 1.0, 20);
  problem.initial = at(vector({1, 0, 0}));
  problem.final = at(vector({0, 1.2, 0}));
  const auto solution = solve_boundary_problem(problem);
  BOOST_TEST((solution.verdict == Verdict::unsolved));
  BOOST_TEST(solution.reason.find("condition 2 at the end is off by -0.2") != std::string::npos,
             solution.reason);

  const auto oscillator = hamiltonian(
      phase_space(1), [](const ExprVector& x) { return (x[1] * x[1] + x[0] * x[0]) / 2.0; });
  problem = problem_of(midpoint(oscillator), vector({0.3, 0}), 2.0, 20);
  problem.initial = at(vector({0.3}));
  problem.final = at(vector({0.0, 0.0}));
  BOOST_CHECK_EXCEPTION(
      solve_boundary_problem(problem), std::invalid_argument,
      [](const std::invalid_argument& error) {
        const std::string text = error.what();
        return text.find("1 at the beginning and 2 at the end, than the 2 numbers") !=
               std::string::npos;
      });
  // One condition too few: a family.
  problem.initial = {};
  problem.final = at(vector({0.4}));
  const auto family = solve_boundary_problem(problem);
  BOOST_TEST((family.verdict == Verdict::family));
  BOOST_TEST(family.family_dimension == 1);
  BOOST_TEST(std::abs(family.conditions.front().residual) < 1e-12);
}

// The explicit method of Runge and Kutta loses energy: no orbit of it closes but that at rest.
BOOST_AUTO_TEST_CASE(a_method_that_loses_energy_has_no_closed_orbits) {
  const auto system = hamiltonian(
      phase_space(1), [](const ExprVector& x) { return (x[1] * x[1] + x[0] * x[0]) / 2.0; });
  BoundaryProblem problem = problem_of(midpoint(system), vector({1, 0}), 6.0, 30);
  problem.method = std::make_shared<ExplicitRungeKutta>(
      std::make_shared<VectorField>(system, problem.ladder, Backend::interpreter),
      ExplicitRungeKutta::Kind::classical);
  problem.initial = at(vector({1, 0}));
  problem.is_periodic = true;
  problem.has_free_time = true;
  BOOST_TEST((solve_boundary_problem(problem).verdict == Verdict::unsolved));
  problem.method = midpoint(system);
  BOOST_TEST((solve_boundary_problem(problem).verdict == Verdict::isolated));
}

// q'' = -c sin q from 0 to 3.1 in a time in which the pendulum at c = 1 takes a path that a straight line does not lead to.
BOOST_AUTO_TEST_CASE(a_homotopy_leads_to_what_a_guess_does_not) {
  const auto family = [](double c) {
    const auto system = hamiltonian(
        phase_space(1), [c](const ExprVector& x) { return x[1] * x[1] / 2.0 - c * cos(x[0]); });
    BoundaryProblem problem = problem_of(midpoint(system), vector({0, 0.1}), 10.0, 100);
    problem.initial = at(vector({0.0}));
    problem.final = at(vector({3.1}));
    return problem;
  };
  std::vector<double> values;
  const auto solution =
      continue_boundary_problem(family, 0.0, 1.0, {}, [&](double c) { values.push_back(c); });
  BOOST_TEST_REQUIRE((solution.verdict == Verdict::isolated), solution.reason);
  BOOST_TEST(values.size() >= 2u);
  BOOST_TEST(values.front() == 0.0);
  BOOST_TEST(values.back() == 1.0);
  BOOST_TEST(std::abs(solution.conditions.back().residual) < 1e-6);
  // No way leads to where there is no solution: a fold.
  const auto folding = [](double c) {
    const auto free =
        hamiltonian(phase_space(1), [](const ExprVector& x) { return x[1] * x[1] / 2.0; });
    BoundaryProblem problem = problem_of(midpoint(free), vector({0, 1}), 1.0, 10);
    problem.initial = at(vector({0.0}));
    problem.final = {.formula = [c](const EndPoint& end) {
      return ExprVector{{end.x[0] * end.x[0] - 0.5 + c}};
    }};
    return problem;
  };
  const auto none = continue_boundary_problem(folding, 0.0, 1.0);
  BOOST_TEST((none.verdict == Verdict::unsolved));
  BOOST_TEST(none.reason.find("the continuation comes to 0.") != std::string::npos, none.reason);
}

BOOST_AUTO_TEST_SUITE_END()
