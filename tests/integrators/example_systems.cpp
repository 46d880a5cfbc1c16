#include "example_systems.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace courant::examples {
namespace {

double power_of_ten(std::mt19937& generator) {
  return std::uniform_int_distribution<int>(0, 1)(generator) == 0 ? 1e-6 : 1e6;
}

VectorXd powers_of_ten(Index size, std::mt19937& generator) {
  return VectorXd::NullaryExpr(size, [&] { return power_of_ten(generator); });
}

bool is_flat(const Problem& problem) {
  const Manifold& M = *problem.system->manifold();
  return M.dimension() == M.ambient_dimension();
}

MatrixXd metric_of(const Problem& problem) {
  return problem.metric.size() > 0
             ? problem.metric
             : MatrixXd::Identity(problem.guess.x.size(), problem.guess.x.size());
}

}  // namespace

ExprVector equations(std::initializer_list<Expr> entries) {
  ExprVector result(static_cast<Index>(entries.size()));
  std::copy(entries.begin(), entries.end(), result.begin());
  return result;
}

Problem permuted(const Problem& problem, std::mt19937& generator) {
  const SystemPointer& system = problem.system;
  const bool flat = is_flat(problem);
  const auto random_order = [&](Index size) {
    Eigen::PermutationMatrix<Eigen::Dynamic> order(size);
    order.setIdentity();
    std::shuffle(order.indices().begin(), order.indices().end(), generator);
    return MatrixXd(order);
  };
  const Index n = problem.guess.x.size();
  const MatrixXd rows = random_order(system->equation_count());
  const MatrixXd P = flat ? random_order(n) : MatrixXd(MatrixXd::Identity(n, n));
  const MatrixXd Pz = random_order(system->auxiliary_size());
  Problem result = problem;
  InitialGuess& guess = result.guess;
  guess.x = P.transpose() * guess.x;
  if (guess.v.size() > 0 && flat) guess.v = P.transpose() * guess.v;
  if (guess.z.size() > 0) guess.z = Pz.transpose() * guess.z;
  result.metric = P.transpose() * metric_of(problem) * P;
  result.system = std::make_shared<FormulaSystem>(
      system->manifold(), system->auxiliary_size(), system->equation_count(),
      [system, rows, P, Pz, flat](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                  const Expr& t) {
        const ExprVector velocity = flat ? ExprVector(constants(P) * v) : v;
        return ExprVector(constants(rows) * system->residual(ExprVector(constants(P) * x), velocity,
                                                             ExprVector(constants(Pz) * z), t));
      });
  return result;
}

Problem scaled(const Problem& problem, std::mt19937& generator) {
  const SystemPointer& system = problem.system;
  Problem result = problem;
  InitialGuess& guess = result.guess;
  const bool flat = is_flat(problem);
  const VectorXd rows = powers_of_ten(system->equation_count(), generator);
  const VectorXd s =
      flat ? powers_of_ten(guess.x.size(), generator) : VectorXd::Ones(guess.x.size());
  const VectorXd sz = powers_of_ten(system->auxiliary_size(), generator);
  guess.x = guess.x.cwiseQuotient(s);
  if (guess.v.size() > 0 && flat) guess.v = guess.v.cwiseQuotient(s);
  if (guess.z.size() > 0) guess.z = guess.z.cwiseQuotient(sz);
  result.metric = s.asDiagonal() * metric_of(problem) * s.asDiagonal();
  result.system = std::make_shared<FormulaSystem>(
      system->manifold(), system->auxiliary_size(), system->equation_count(),
      [system, rows, s, sz, flat](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                  const Expr& t) {
        const ExprVector there = constants(s).cwiseProduct(x);
        const ExprVector velocity = flat ? ExprVector(constants(s).cwiseProduct(v)) : v;
        const ExprVector F = system->residual(there, velocity, constants(sz).cwiseProduct(z), t);
        return ExprVector(constants(rows).cwiseProduct(F));
      });
  return result;
}

Problem transformed(const Problem& problem, std::mt19937& generator) {
  const SystemPointer& system = problem.system;
  Problem result = problem;
  InitialGuess& guess = result.guess;
  std::normal_distribution<double> normal;
  const auto random_matrix = [&](Index size) {
    const MatrixXd A = MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
    const MatrixXd Q = orthonormalized(A);
    return MatrixXd(Q * VectorXd::NullaryExpr(size, [&] {
                          return std::exp(0.3 * normal(generator));
                        }).asDiagonal());
  };
  const Index n = guess.x.size(), m = system->auxiliary_size();
  if (!is_flat(problem)) {
    const MatrixXd B = random_matrix(m), C = random_matrix(system->equation_count());
    if (guess.z.size() > 0) guess.z = LuDecomposition(B).solve(guess.z);
    result.system = std::make_shared<FormulaSystem>(
        system->manifold(), m, system->equation_count(),
        [system, B, C](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                       const Expr& t) {
          return ExprVector(constants(C) * system->residual(x, v, ExprVector(constants(B) * z), t));
        });
    return result;
  }
  // x = x_0 + A (u + ⅒ s(u_2) + ½⅒ u_1 u_2 / (1 + u_1² + u_2²), …),  s(w) = w² / (1 + w²),  shifted:
  // near u = y - y_0 = 0 the derivative is A, and what is added to u changes by less than u does, so
  // that these are coordinates wherever a solution is.
  const MatrixXd A = random_matrix(n), B = random_matrix(m);
  const VectorXd x0 = guess.x;
  const auto change = [A, x0, n](const ExprVector& y) {
    ExprVector u(n);
    for (Index i = 0; i < n; ++i) {
      const Expr first = y[i] - 0.5, second = y[(i + 1) % n] - 0.5;
      u[i] = first + 0.1 * square(second) / (1 + square(second)) +
             0.05 * first * second / (1 + square(first) + square(second));
    }
    return ExprVector(constants(x0) + constants(A) * u);
  };
  guess.x = VectorXd::Constant(n, 0.5);
  if (guess.v.size() > 0) guess.v = LuDecomposition(A).solve(guess.v);
  if (guess.z.size() > 0) guess.z = LuDecomposition(B).solve(guess.z);
  result.metric = A.transpose() * metric_of(problem) * A;
  result.system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(n), m, system->equation_count(),
      [system, change, B](const ExprVector& y, const ExprVector& w, const ExprVector& z,
                          const Expr& t) {
        Graph graph;
        const ExprVector at = graph.variables("y", y.size());
        const ExprVector rate = graph.variables("w", y.size());
        const ExprVector image = change(at);
        ExprVector x_and_v(2 * image.size());
        x_and_v << image, tangent(image, at, rate);
        ExprVector from(2 * y.size()), to(2 * y.size());
        from << at, rate;
        to << y, w;
        const ExprVector there = substitute(x_and_v, from, to);
        return system->residual(ExprVector(there.head(y.size())), ExprVector(there.tail(y.size())),
                                ExprVector(constants(B) * z), t);
      });
  return result;
}

}  // namespace courant::examples
