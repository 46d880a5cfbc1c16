#include "courant/core/newton.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(newton)

using namespace courant;

namespace {

struct Problem {
  Function function;
  VectorXd y;
  double parameter = 0.0;
  Newton::Result solve(Newton& newton, double scale = 0.0) {
    const Inputs in(y.data(), {&parameter});
    return newton.solve(in, &scale);
  }
};

template <class Formula>
Problem make(Index size, const Formula& formula) {
  Graph graph;
  const ExprVector y = graph.variables("y", size);
  const ExprVector a = graph.variables("a", 1);
  return {Function("problem", {{"y", y}, {"a", a}}, formula(y, a[0]), {.differentiate = {"y"}}),
          VectorXd::Zero(size)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(kept_factorisation_follows_a_slow_parameter) {
  Problem problem = make(2, [](const ExprVector& y, const Expr& a) {
    ExprVector F(2);
    F << y[0] + 0.1 * sin(y[1]) - a, y[1] - 0.2 * cos(y[0]);
    return F;
  });
  Newton newton(problem.function, {}, {});
  int factorizations = 0;
  for (int k = 0; k < 100; ++k) {
    problem.parameter = 0.01 * k;
    const auto result = problem.solve(newton);
    BOOST_TEST_REQUIRE((result.status == Newton::Status::converged));
    factorizations += result.factorizations;
    const VectorXd& y = problem.y;
    BOOST_TEST(std::abs(y[0] + 0.1 * std::sin(y[1]) - problem.parameter) < 1e-14);
    BOOST_TEST(std::abs(y[1] - 0.2 * std::cos(y[0])) < 1e-14);
  }
  BOOST_TEST(factorizations < 10);
}

// By the first matrix alone, errors would contract by up to 0.3, and a solve takes 18 iterations on average. Half of
// them are needed with what each solve teaches.
BOOST_AUTO_TEST_CASE(kept_inverse_learns) {
  Problem problem = make(2, [](const ExprVector& y, const Expr& a) {
    ExprVector F(2);
    F << (1.0 + a) * y[0] + 0.1 * a * y[1] - cos(a), (1.0 + a) * y[1] - sin(a) - 1.0;
    return F;
  });
  Newton newton(problem.function, {}, {});
  int iterations = 0, factorizations = 0;
  for (int k = 0; k < 200; ++k) {
    problem.parameter = 0.0015 * k;
    const auto result = problem.solve(newton);
    BOOST_TEST_REQUIRE((result.status == Newton::Status::converged));
    iterations += result.iterations;
    factorizations += result.factorizations;
  }
  BOOST_TEST(factorizations <= 2);
  BOOST_TEST(iterations < 1600);
}

BOOST_AUTO_TEST_CASE(large_states_stop_at_round_off) {
  // y ≈ 10⁹: the residual cannot be smaller than 10⁻⁷, and the iteration has to see that.
  Problem problem = make(1, [](const ExprVector& y, const Expr& a) {
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
  Problem problem =
      make(2, [](const ExprVector& y, const Expr&) { return ExprVector(2.0 * y + 0.0 * y); });
  problem.y = Eigen::Vector2d(3e-30, -1e-30);
  Newton newton(problem.function, {}, {});
  BOOST_TEST((problem.solve(newton, 0.0).status == Newton::Status::converged));
  BOOST_TEST(problem.y.isZero(0.0));
}

// y = 10⁻⁷ would be the solution, but 2 + 10⁻⁹ y has steps of 4·10⁻⁷ in y.
BOOST_AUTO_TEST_CASE(nearly_singular_equations_stop_at_round_off) {
  Problem problem = make(1, [](const ExprVector& y, const Expr&) {
    return ExprVector(ExprVector::Constant(1, (2.0 + 1e-9 * y[0]) - 2.0 - 1e-16));
  });
  Newton newton(problem.function, {}, {});
  const auto result = problem.solve(newton, 1.0);
  BOOST_TEST((result.status == Newton::Status::converged));
  BOOST_TEST(result.iterations <= 6);
  BOOST_TEST(std::abs(problem.y[0]) < 1e-6);
}

BOOST_AUTO_TEST_CASE(redundant_and_undetermined_systems_by_least_squares) {
  // The equation y₀ = 2 twice, y₁ + y₂ = 1: the change of least norm from zero is y₁ = y₂.
  Problem problem = make(3, [](const ExprVector& y, const Expr&) {
    ExprVector F(3);
    F << y[0] - 2.0, 5.0 * y[0] - 10.0, y[1] + y[2] - 1.0;
    return F;
  });
  Newton newton(problem.function, {}, {});
  BOOST_TEST((problem.solve(newton, 1.0).status == Newton::Status::converged));
  BOOST_TEST((problem.y - VectorXd((VectorXd(3) << 2.0, 0.5, 0.5).finished())).norm() < 1e-14);
}

// Matrices of every size that has code of its own, and larger ones.
BOOST_AUTO_TEST_CASE(sizes) {
  for (Index size = 1; size <= 12; ++size) {
    Problem problem = make(size, [&](const ExprVector& y, const Expr& a) {
      ExprVector F = y;
      for (Index i = 0; i < size; ++i)
        F[i] += 0.3 * sin(y[(i + 1) % size]) + 0.1 * square(y[size - 1 - i]) - a;
      return F;
    });
    problem.parameter = 0.5;
    Newton newton(problem.function, {}, {});
    BOOST_TEST((problem.solve(newton, 1.0).status == Newton::Status::converged));
    const VectorXd residual = problem.function({problem.y, VectorXd::Constant(1, 0.5)});
    BOOST_TEST(residual.lpNorm<Eigen::Infinity>() < 1e-15);
    BOOST_TEST(problem.y.norm() > 0.1);
  }
}

BOOST_AUTO_TEST_CASE(no_solution_is_reported) {
  Problem problem = make(1, [](const ExprVector& y, const Expr&) {
    return ExprVector(ExprVector::Constant(1, square(y[0]) + 1.0));
  });
  problem.y[0] = 0.7;
  Newton newton(problem.function, {}, {});
  const auto result = problem.solve(newton, 1.0);
  BOOST_TEST((result.status != Newton::Status::converged));
  BOOST_TEST(!result.residuals.empty());
}

BOOST_AUTO_TEST_CASE(unknowns_that_are_not_contained_stay) {
  // Two equations in y₀, y₂, y₃ of four unknowns, in three groups.
  Problem problem = make(4, [](const ExprVector& y, const Expr& a) {
    ExprVector F(2);
    F << y[0] + 0.1 * sin(y[2]) - a, y[2] - 0.2 * cos(y[0]);
    return F;
  });
  problem.y << 0.5, 7.0, 0.5, -8.0;
  problem.parameter = 1.0;
  Newton newton(problem.function, {1, 1, 2}, {});
  const double scales[] = {1.0, 1.0, 1.0};
  const Inputs in(problem.y.data(), {&problem.parameter});
  BOOST_TEST((newton.solve(in, scales).status == Newton::Status::converged));
  BOOST_TEST(newton.is_determined());
  const VectorXd& y = problem.y;
  BOOST_TEST(std::abs(y[0] + 0.1 * std::sin(y[2]) - 1.0) < 1e-15);
  BOOST_TEST(std::abs(y[2] - 0.2 * std::cos(y[0])) < 1e-15);
  BOOST_TEST(y[1] == 7.0);
  BOOST_TEST(y[3] == -8.0);
}

BOOST_AUTO_TEST_CASE(undetermined_unknowns_are_noticed) {
  // One equation for two unknowns; the same twice; two that are independent.
  for (const auto& [second, determined] : {std::pair(0.0, false), std::pair(1.0, true)}) {
    Problem problem = make(2, [&](const ExprVector& y, const Expr& a) {
      ExprVector F(3);
      F << y[0] + y[1] - a, 2.0 * y[0] + 2.0 * y[1] - 2.0 * a, y[0] + y[1] - a + second * y[0];
      return F;
    });
    Newton newton(problem.function, {}, {});
    BOOST_TEST((problem.solve(newton, 1.0).status == Newton::Status::converged));
    BOOST_TEST(newton.is_determined() == determined);
  }
}

// The difference of the two that only their sum is known of; an unknown in no equation stays.
BOOST_AUTO_TEST_CASE(undetermined_unknowns_are_settled) {
  Problem problem = make(3, [](const ExprVector& y, const Expr& a) {
    return ExprVector(ExprVector::Constant(1, y[0] + y[2] - a));
  });
  Newton newton(problem.function, {}, {});
  const VectorXd predicted = Eigen::Vector3d(3.0, 9.0, 1.0);
  const VectorXd start = Eigen::Vector3d(0.5, 5.0, 1.5);
  VectorXd y = predicted;
  newton.settle(y, start);
  BOOST_TEST((y - predicted).norm() == 0.0);
  BOOST_TEST_REQUIRE((problem.solve(newton, 1.0).status == Newton::Status::converged));
  newton.settle(y, start);
  BOOST_TEST((y - VectorXd(Eigen::Vector3d(1.5, 9.0, 2.5))).norm() < 1e-15);
}

// A factorisation that has become old contracts badly: what it leaves is not round-off, however
// small it is.
BOOST_AUTO_TEST_CASE(slow_is_not_round_off) {
  Problem problem = make(1, [](const ExprVector& y, const Expr& a) {
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

// A solver of one's own gets the pattern of the Jacobian in the unknowns that the equations have.
// With the matrix of the beginning the changes of y₀ contract to 0.3, those of y₁, which are 10⁸ times
// smaller, to 0.8: these are what is left in the end, and no round-off.
BOOST_AUTO_TEST_CASE(a_slow_end_is_not_round_off) {
  Problem problem = make(2, [](const ExprVector& y, const Expr&) {
    ExprVector F(2);
    F << y[0] - 0.15 * square(y[0]) - 0.85, exp(-1.6 * y[0]) * (y[1] - 3e-8);
    return F;
  });
  Newton newton(problem.function, {}, {});
  BOOST_REQUIRE(problem.solve(newton).status == Newton::Status::converged);
  BOOST_TEST(std::abs(problem.y[0] - 1.0) < 1e-15);
  BOOST_TEST(std::abs(problem.y[1] - 3e-8) < 1e-15);
}

BOOST_AUTO_TEST_CASE(solves_with_the_solver_that_it_is_given) {
  class Diagonal final : public LinearSolver {
   public:
    Diagonal(const MatrixPattern& pattern, int& count) : pattern_(pattern), count_(count) {}

   private:
    bool do_factorize(const double* entries) override {
      ++count_;
      diagonal_.assign(entries, entries + pattern_.row.size());
      return true;
    }
    void do_solve(const double* b, double* x) override {
      for (std::size_t k = 0; k < diagonal_.size(); ++k)
        x[pattern_.column[k]] = b[pattern_.row[k]] / diagonal_[k];
    }
    bool do_is_determined() const override { return true; }
    MatrixPattern pattern_;
    int& count_;
    std::vector<double> diagonal_;
  };
  Problem problem = make(3, [](const ExprVector& y, const Expr& a) {
    ExprVector F(2);
    F << exp(y[0]) - a, square(y[2]) - 4.0;  // y[1] is in no equation
    return F;
  });
  problem.y << 0.5, 7.0, 1.5;
  problem.parameter = 3.0;
  int factorizations = 0;
  MatrixPattern seen;
  Newton newton(problem.function, {}, {.solver = [&](const MatrixPattern& pattern) {
                  seen = pattern;
                  return std::make_unique<Diagonal>(pattern, factorizations);
                }});
  const auto result = problem.solve(newton);
  BOOST_TEST((result.status == Newton::Status::converged));
  BOOST_TEST(seen.rows == 2);
  BOOST_TEST(seen.columns == 2);
  BOOST_TEST(factorizations == result.factorizations);
  BOOST_TEST(std::abs(problem.y[0] - std::log(3.0)) < 1e-15);
  BOOST_TEST(problem.y[1] == 7.0);
  BOOST_TEST(std::abs(problem.y[2] - 2.0) < 1e-15);
}

// The second equation is three times the first but for round-off, which must not be scaled up to an
// equation: the unknowns move as little as they can.
BOOST_AUTO_TEST_CASE(a_matrix_that_is_singular_up_to_round_off) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  ExprVector F(2);
  F << 0.1 * y[0] + 0.3 * y[1] - 0.4, 0.3 * y[0] + 0.9 * y[1] - 1.2;
  Newton newton(Function("dependent", {{"y", y}}, F, {.differentiate = {"y"}}), {}, {});
  VectorXd at = VectorXd{{1.5, 1.2}};
  const Inputs in(at.data(), {});
  const double scale = 1.0;
  BOOST_TEST((newton.solve(in, &scale).status == Newton::Status::converged));
  BOOST_TEST(!newton.is_determined());
  // The nearest point of y₀ + 3 y₁ = 4 to (1.5, 1.2) is 1.1/10 (1, 3) away.
  BOOST_TEST(at[0] == 1.39, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(at[1] == 0.87, boost::test_tools::tolerance(1e-9));
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
  Problem problem = make(1, [](const ExprVector& y, const Expr&) {
    return ExprVector::Constant(1, log(y[0])).eval();
  });
  problem.y[0] = 5.0;
  Newton newton(problem.function, {}, {});
  BOOST_TEST((problem.solve(newton, 1.0).status != Newton::Status::converged));
}

// Newton's method goes from 9.95 V to -10²³ V and back to 10 V, which contracts by as much. The step
// on the way back may be a long one, or end near the root and be short.
BOOST_AUTO_TEST_CASE(the_way_back_from_far_away_is_no_convergence) {
  Problem problem = make(1, [](const ExprVector& y, const Expr& a) {
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
  const Problem problem = make(2, [](const ExprVector& y, const Expr&) {
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
  const Problem problem = make(2, [](const ExprVector& y, const Expr& part) {
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
  Problem problem = make(2, [](const ExprVector& y, const Expr& a) {
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

// A diode takes the current from any voltage, by damped steps, whether it is written as one equation or
// as two of which one gives its unknown.
BOOST_AUTO_TEST_CASE(damped_steps_lead_to_where_it_converges) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2), a = graph.variables("a", 1);
  const double saturation = 1e-9, thermal = 0.025852;
  ExprVector F(2);
  F << y[1] - saturation * (exp(y[0] / thermal) - 1.0), y[1] - a[0];
  for (const bool eliminates : {false, true}) {
    Newton newton(EquationSystem("diode", {{"y", y}, {"a", a}}, F, {.eliminates = eliminates}), {},
                  {});
    for (const double current : {1e-3, 0.3, 40.0}) {
      VectorXd at = Eigen::Vector2d(0.0, 1e-12);
      const Inputs in(at.data(), {&current});
      const double scale = 1e-5;
      newton.reset();
      BOOST_TEST((newton.solve(in, &scale).status != Newton::Status::converged));
      at = Eigen::Vector2d(0.0, 1e-12);
      BOOST_TEST_REQUIRE(newton.approach(in, &scale));
      BOOST_TEST((newton.solve(in, &scale).status == Newton::Status::converged));
      BOOST_TEST(std::fabs(at[0] - thermal * std::log1p(current / saturation)) < 1e-13);
    }
  }
}

// Of y₀ = 1 and y₀ = 1.001 there is a least square, and no solution.
BOOST_AUTO_TEST_CASE(least_squares_are_no_solution) {
  for (const double apart : {0.0, 1e-3}) {
    Problem problem = make(1, [&](const ExprVector& y, const Expr&) {
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
