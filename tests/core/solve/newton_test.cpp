#include "courant/core/solve/newton.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "newton_problem.hpp"

// Mistakes that these cases have to notice:
//  * a matrix that is nearly singular is taken for regular (core/linear/regular_matrix.hpp)
//  * an accidental contraction is taken for that of the matrix (core/solve/contraction.hpp)
//  * the way back from far away is taken for convergence (core/solve/contraction.hpp)
//  * a short step after a long one is taken for convergence (core/solve/contraction.hpp)
//  * a kept inverse never learns (core/solve/contraction.hpp)
//  * an error that passes from one group of unknowns to another and back is not seen
//    (core/solve/contraction.hpp)
//  * a long change by the matrix of affine equations is taken for the last one
//    (core/solve/contraction.hpp)
//  * a stall a thousand times longer is taken for round-off
//  * equal steps down an exponential are taken for round-off
//  * least squares of contradicting equations are a solution
//  * residuals of 1e-8 are taken for round-off
//  * blocks are not measured by their own scale
//  * slow changes with a matrix from far away pass for round-off
//  * unknowns are settled that nothing is known of yet
//  * halfway down an exponential a step by a matrix of a point further up is taken for convergence
//  * what equations hold stays that of the first parameters
//  * a redundant system is called determined (core/linear/dense_solver.cpp)
//  * an iterate that is not finite is accepted (core/solve/unknown_change.hpp)
BOOST_AUTO_TEST_SUITE(newton)

using namespace courant;

BOOST_AUTO_TEST_CASE(kept_factorisation_follows_a_slow_parameter) {
  NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr& a) {
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
  NewtonProblem problem = newton_problem(2, [](const ExprVector& y, const Expr& a) {
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

BOOST_AUTO_TEST_CASE(redundant_and_undetermined_systems_by_least_squares) {
  // The equation y₀ = 2 twice, y₁ + y₂ = 1: the change of least norm from zero is y₁ = y₂.
  NewtonProblem problem = newton_problem(3, [](const ExprVector& y, const Expr&) {
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
    NewtonProblem problem = newton_problem(size, [&](const ExprVector& y, const Expr& a) {
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
  NewtonProblem problem = newton_problem(1, [](const ExprVector& y, const Expr&) {
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
  NewtonProblem problem = newton_problem(4, [](const ExprVector& y, const Expr& a) {
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
  for (const auto& of_second : {std::pair(0.0, false), std::pair(1.0, true)}) {
    const double second = of_second.first;
    const bool determined = of_second.second;
    NewtonProblem problem = newton_problem(2, [&](const ExprVector& y, const Expr& a) {
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
  NewtonProblem problem = newton_problem(3, [](const ExprVector& y, const Expr& a) {
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

// A solver of one's own gets the pattern of the Jacobian in the unknowns that the equations have.
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
  NewtonProblem problem = newton_problem(3, [](const ExprVector& y, const Expr& a) {
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

BOOST_AUTO_TEST_SUITE_END()
