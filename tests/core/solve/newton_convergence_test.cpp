// When Newton's method ends, and when it must not.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/solve/newton.hpp"
#include "newton_problem.hpp"

BOOST_AUTO_TEST_SUITE(newton_convergence)

using namespace courant;

BOOST_AUTO_TEST_CASE(large_states_stop_at_round_off) {
  // y ≈ 10⁹: the residual cannot be smaller than 10⁻⁷, and the iteration has to see that.
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr& a) {
    return ExprVector(ExprVector::Constant(1, y[0] + 0.3 * sin(y[0] * 1e-9) - 1e9 + a));
  });
  problem.y[0] = 1e9;
  Newton newton(problem.function, {}, {});
  const auto result = problem.solve(newton, 1e9);
  BOOST_TEST((result.status == Newton::Status::converged));
  BOOST_TEST(result.iterations <= 6);
}

// A body at rest at the origin: there is no scale, and noise of 10⁻³⁰ goes to zero in one iteration.
BOOST_AUTO_TEST_CASE(zero_is_reached_from_noise) {
  NewtonProblem problem = newton_problem(
      2, [](const ExprVector& y, const Expr&) { return ExprVector(2.0 * y + 0.0 * y); });
  problem.y = Eigen::Vector2d(3e-30, -1e-30);
  Newton newton(problem.function, {}, {});
  BOOST_TEST((problem.solve(newton, 0.0).status == Newton::Status::converged));
  BOOST_TEST(problem.y.isZero(0.0));
}

// y = 10⁻⁷ would be the solution, but 2 + 10⁻⁹ y has steps of 4·10⁻⁷ in y.
BOOST_AUTO_TEST_CASE(nearly_singular_equations_stop_at_round_off) {
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr&) {
    return ExprVector(ExprVector::Constant(1, (2.0 + 1e-9 * y[0]) - 2.0 - 1e-16));
  });
  Newton newton(problem.function, {}, {});
  const auto result = problem.solve(newton, 1.0);
  BOOST_TEST((result.status == Newton::Status::converged));
  BOOST_TEST(result.iterations <= 6);
  BOOST_TEST(std::abs(problem.y[0]) < 1e-6);
}

// A factorisation that has become old contracts badly: what it leaves is not round-off, however
// small it is.
BOOST_AUTO_TEST_CASE(slow_is_not_round_off) {
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr& a) {
    return ExprVector(ExprVector::Constant(1, (1.0 + a) * (y[0] - 1.0)));
  });
  Newton newton(problem.function, {}, {});
  problem.solve(newton, 1.0);
  for (const double slope : {-0.7, 0.6}) {  // contraction 0.7 and 0.6 with the old one
    problem.parameter = slope;
    problem.y[0] = 1.0 + 5e-15;
    BOOST_TEST((problem.solve(newton, 1.0).status == Newton::Status::converged));
    BOOST_TEST(std::abs(problem.y[0] - 1.0) < 5e-16);
    problem.parameter = 0.0;
    newton.reset();
    problem.solve(newton, 1.0);
  }
}

// With the matrix of the beginning the changes of y₀ contract to 0.3, those of y₁, which are 10⁸ times
// smaller, to 0.8: these are what is left in the end, and no round-off.
BOOST_AUTO_TEST_CASE(a_slow_end_is_not_round_off) {
  NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr&) {
    ExprVector F(2);
    F << y[0] - 0.15 * square(y[0]) - 0.85, exp(-1.6 * y[0]) * (y[1] - 3e-8);
    return F;
  });
  Newton newton(problem.function, {}, {});
  BOOST_REQUIRE(problem.solve(newton).status == Newton::Status::converged);
  BOOST_TEST(std::abs(problem.y[0] - 1.0) < 1e-15);
  BOOST_TEST(std::abs(problem.y[1] - 3e-8) < 1e-15);
}

// Each block has its own scale: next to 10¹², 10⁻⁸ is not yet found when it is 10⁻²⁰ of that.
BOOST_AUTO_TEST_CASE(blocks_of_different_sizes_are_all_found) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  ExprVector F(2);
  F << y[0] - 1e12, square(y[1]) - 2e-16;
  Newton newton(Function("blocks", {{"y", y}}, F, {.differentiate = {"y"}}), {1, 1}, {});
  VectorXd at = VectorXd{{9e11, 3e-8}};
  const Inputs in(at.data(), {});
  const double scales[] = {1e12, 1e-8};
  BOOST_TEST((newton.solve(in, scales).status == Newton::Status::converged));
  BOOST_TEST(at[0] == 1e12, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(at[1] == std::sqrt(2.0) * 1e-8, boost::test_tools::tolerance(1e-14));
}

// (y - 1)² + 1.5·10⁻⁸ has no zero. Its least value is 10⁻⁸ of the terms of the equation that it
// stands in, and steps near it are 10⁻⁴: neither is round-off.
BOOST_AUTO_TEST_CASE(a_small_residual_is_no_zero) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  ExprVector F(2);
  F << y[0] - y[1], y[0] - y[1] + square(y[1] - 1.0) + 1.5e-8;
  Newton newton(Function("no zero", {{"y", y}}, F, {.differentiate = {"y"}}), {}, {});
  for (const double start : {1.01, 0.997, 1.0005, 0.99981}) {
    newton.reset();
    VectorXd at = VectorXd::Constant(2, start);
    const Inputs in(at.data(), {});
    const double scale = 1.0;
    BOOST_TEST((newton.solve(in, &scale).status != Newton::Status::converged));
  }
}

// From 5 Newton's method for log y = 0 goes to -3, where there is no number to go on with.
BOOST_AUTO_TEST_CASE(an_iterate_that_is_no_number_is_no_zero) {
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr&) {
    return ExprVector::Constant(1, log(y[0])).eval();
  });
  problem.y[0] = 5.0;
  Newton newton(problem.function, {}, {});
  BOOST_TEST((problem.solve(newton, 1.0).status != Newton::Status::converged));
}

// Newton's method goes from 9.95 V to -10²³ V and back to 10 V, which contracts by as much. The step
// on the way back may be a long one, or end near the root and be short.
BOOST_AUTO_TEST_CASE(the_way_back_from_far_away_is_no_convergence) {
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr& a) {
    const Expr v = 10.0 - y[0];
    return ExprVector::Constant(1, 1e-9 * (exp(v / 0.025852) - 1.0) + 1e-4 * v - a).eval();
  });
  const double given = 9.664e-4;
  std::vector<double> starts = {9.663, 9.9, 11.0, 60.0, 1e20};
  for (int i = 0; i <= 400; ++i) starts.push_back(8.0 + 0.01 * i);
  for (const double scale : {1e-3, 1.0})
    for (const double start : starts) {
      problem.y[0] = start;
      problem.parameter = given;
      Newton newton(problem.function, {}, {});
      if (problem.solve(newton, scale).status != Newton::Status::converged) continue;
      const VectorXd residual = problem.function({problem.y, VectorXd::Constant(1, given)});
      BOOST_TEST(std::fabs(residual[0]) < 1e-12, "start " << start << " ends at " << problem.y[0]);
    }
}

// u is known after one step, and its block does not move any more; what z still moves by is nothing beside
// its scale. The matrix was made where u was 0.009 away: z u comes closer by that only.
BOOST_AUTO_TEST_CASE(an_accidental_contraction_is_no_convergence) {
  const NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr&) {
    ExprVector F(2);
    F << y[0] - 1.009, y[1] * y[0] - 0.2;
    return F;
  });
  Newton newton(problem.function, {1, 1}, {});
  VectorXd y = Eigen::Vector2d(1.0, 0.21);
  const double parameter = 0.0;
  const double scales[] = {1.0, 2e6};
  const Inputs in(y.data(), {&parameter});
  BOOST_TEST((newton.solve(in, scales).status == Newton::Status::converged));
  BOOST_TEST(std::abs(y[1] - 0.2 / 1.009) < 1e-10);
}

// y = A(h) y + b: a short change by the matrix of this h is the only one. That of another h, and a jump that no
// derivative shows, take more.
BOOST_AUTO_TEST_CASE(affine_equations_are_solved_by_one_short_change) {
  for (const Index n : {3, 12}) {  // in a loop of its own, and not
    const Graph graph;
    const ExprVector y = graph.variables("y", n), h = graph.variables("h", 1),
                     b = graph.variables("b", 1);
    const auto solver = [&](const Expr& jump) {
      ExprVector F(n);
      for (Index i = 0; i < n; ++i)
        F[i] = y[i] - b[0] * (1.0 + 0.1 * static_cast<double>(i)) + 0.3 * h[0] * y[(i + 1) % n];
      F[0] += jump;
      const EquationSystem system("affine", {{"y", y}, {"h", h}, {"b", b}}, F,
                                  {.eliminates = false});
      return Newton(system, {n}, {});
    };
    VectorXd at = VectorXd::Zero(n);
    double step = 1.0, right = 1.0;
    const double scale = 1.0;
    const Inputs in(at.data(), {&step, &right});
    const auto defect = [&] {
      double result = 0.0;
      for (Index i = 0; i < n; ++i)
        result = std::max(result, std::fabs(at[i] - right * (1.0 + 0.1 * static_cast<double>(i)) +
                                            0.3 * step * at[(i + 1) % n]));
      return result;
    };
    const auto iterations = [&](Newton& newton) {
      BOOST_TEST((newton.solve(in, &scale).status == Newton::Status::converged));
      return newton.result().iterations;
    };
    Newton newton = solver(0.0);
    iterations(newton);
    right += 1e-7;
    BOOST_TEST(iterations(newton) == 1);
    BOOST_TEST(defect() < 2e-15);
    right += 5e-3;
    BOOST_TEST(iterations(newton) == 2);
    step += 1e-7;
    BOOST_TEST(iterations(newton) > 1);
    BOOST_TEST(defect() < 2e-15);

    // From just below the jump of y₀ to behind it.
    step = 1.0, right = 1.0;
    at.setZero();
    Newton plain = solver(0.0);
    iterations(plain);
    const double place = at[0] + 1e-8;
    Newton jumping = solver(1e-3 * select(y[0] < place, Expr(0.0), Expr(1.0)));
    iterations(jumping);
    right += 1e-7;
    jumping.solve(in, &scale);
    BOOST_TEST(jumping.result().iterations > 1);
  }
}

// A velocity that is measured for its increment, and a multiplier, each with a part of the other that the matrix
// does not know. The multiplier's error of 7e-12 is 1e-12 of the velocity after one change, nothing next to the
// scale, and after another 4e-14 of the multiplier.
BOOST_AUTO_TEST_CASE(an_error_that_changes_groups_is_no_convergence) {
  const NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr& part) {
    ExprVector F(2);
    F << y[0] - 0.14 * part * y[1], y[1] + 0.04 * part * y[0] - 1.0;
    return F;
  });
  Newton newton(problem.function, {1, 1}, {});
  VectorXd y = Eigen::Vector2d(0.0, 1.0);
  double part = 0.0;
  const double scales[] = {400.0, 1.0};
  const Inputs in(y.data(), {&part});
  BOOST_TEST((newton.solve(in, scales).status == Newton::Status::converged));
  part = 1.0;
  const double multiplier = 1.0 / 1.0056;
  y << 0.14 * (multiplier + 7e-12), multiplier + 7e-12;
  BOOST_TEST((newton.solve(in, scales).status == Newton::Status::converged));
  BOOST_TEST(std::abs(y[1] - multiplier) < 2e-15);
}

// Down the flank of an exponential all of Newton's steps are 26 mV. Measured by 10⁸ V they are as small
// as round-off, and as equal.
BOOST_AUTO_TEST_CASE(equal_steps_down_an_exponential_are_no_round_off) {
  NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr& a) {
    ExprVector F(2);
    F << y[0] - 1.0, 1e-12 * (exp(y[1] / 0.025852) - 1.0) - a * y[0];
    return F;
  });
  for (const double given : {1e-9, 1e-3})
    for (const double scale : {1.0, 1e6, 1e8, 1e10}) {
      problem.y << 1.0, 1.4;
      problem.parameter = given;
      Newton newton(problem.function, {1, 1}, {});
      const Inputs in(problem.y.data(), {&problem.parameter});
      const double scales[] = {1.0, scale};
      if (newton.solve(in, scales).status != Newton::Status::converged) continue;
      const double voltage = 0.025852 * std::log1p(given / 1e-12);
      BOOST_TEST(std::fabs(problem.y[1] - voltage) < 1e-9, problem.y[1] << " at scale " << scale);
    }
}

// Of y₀ = 1 and y₀ = 1.001 there is a least square, and no solution.
BOOST_AUTO_TEST_CASE(least_squares_are_no_solution) {
  for (const double apart : {0.0, 1e-3}) {
    NewtonProblem problem = newton_problem(1, [&](const ExprVector& y, const Expr&) {
      ExprVector F(2);
      F << y[0] - 1.0, y[0] + square(y[0] - 1.0) - 1.0 - apart;
      return F;
    });
    Newton newton(problem.function, {}, {});
    BOOST_TEST((problem.solve(newton, 1.0).status == Newton::Status::converged) == (apart == 0.0));
  }
}

// A resistor and a diode, with the scale that voltages of circuits have, 10⁷ times their size: by it all of the
// exponential is round-off, and with the matrix of a point far up no step is long.
BOOST_AUTO_TEST_CASE(a_matrix_far_up_an_exponential_settles_nothing) {
  constexpr double saturation = 1e-14, scale = 0.02585, resistance = 2200.0;
  Graph graph;
  const ExprVector y = graph.variables("y", 1), a = graph.variables("a", 1);
  const EquationSystem system(
      "diode", {{"y", y}, {"a", a}},
      ExprVector::Constant(1, saturation * (exp(y[0] / scale) - 1.0) - (a[0] - y[0]) / resistance),
      {.eliminates = false});
  for (const double first : {0.0, 0.7, 1.4})
    for (const double voltage : {5.0, -5.0, 0.3}) {
      Newton newton(system, {}, {});
      double at = first, before = first < 1.0 ? first : 1e9;
      const Inputs in(&at, {&before});
      const double size = 5e7;
      newton.solve(in, &size);  // keeps a matrix of where it ends
      before = voltage;
      const bool converged = newton.solve(in, &size).status == Newton::Status::converged;
      BOOST_TEST_CONTEXT(voltage << " V after " << first) {
        if (!converged) {
          at = 0.0;
          BOOST_TEST_REQUIRE(newton.approach(in, &size));
          BOOST_TEST_REQUIRE((newton.solve(in, &size).status == Newton::Status::converged));
        }
        const double current = (voltage - at) / resistance;
        BOOST_TEST(std::abs(saturation * std::expm1(at / scale) - current) <
                   1e-12 * (std::abs(current) + std::abs(voltage) / resistance));
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()
