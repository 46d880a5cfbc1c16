#include "example_systems.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "courant/core/derivative.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace courant::examples {
namespace {

double power_of_ten(std::mt19937& generator) {
  return std::uniform_int_distribution<int>(0, 1)(generator) == 0 ? 1e-6 : 1e6;
}

VectorXd powers_of_ten(Index size, std::mt19937& generator) {
  return VectorXd::NullaryExpr(size, [&] { return power_of_ten(generator); });
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
  std::vector<Index> order(static_cast<std::size_t>(system->equation_count()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), generator);
  Problem result = problem;
  result.system = std::make_shared<FormulaSystem>(
      system->manifold(), system->auxiliary_size(), system->equation_count(),
      [system, order](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                      const Expr& t) {
        const ExprVector F = system->residual(x, v, z, t);
        ExprVector shuffled(F.size());
        for (std::size_t i = 0; i < order.size(); ++i)
          shuffled[static_cast<Index>(i)] = F[order[i]];
        return shuffled;
      });
  return result;
}

Problem scaled(const Problem& problem, std::mt19937& generator) {
  const SystemPointer& system = problem.system;
  Problem result = problem;
  InitialGuess& guess = result.guess;
  const bool flat = system->manifold()->dimension() == system->manifold()->ambient_dimension();
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
    const MatrixXd Q =
        Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(size, size);
    return MatrixXd(Q * VectorXd::NullaryExpr(size, [&] {
                          return std::exp(0.5 * normal(generator));
                        }).asDiagonal());
  };
  const Index n = guess.x.size(), m = system->auxiliary_size();
  // x = x_0 + A (u + ⅕ (u_1², u_2², …, shifted)),  u = x' - x'_0: near u = 0 the derivative is A.
  const MatrixXd A = random_matrix(n), B = random_matrix(m);
  const VectorXd x0 = guess.x;
  const auto change = [A, x0, n](const ExprVector& y) {
    ExprVector u(n);
    for (Index i = 0; i < n; ++i)
      u[i] = y[i] - 0.5 + 0.2 * square(y[(i + 1) % n] - 0.5) +
             0.1 * (y[i] - 0.5) * (y[(i + 1) % n] - 0.5);
    return ExprVector(constants(x0) + constants(A) * u);
  };
  guess.x = VectorXd::Constant(n, 0.5);
  if (guess.v.size() > 0) guess.v = A.colPivHouseholderQr().solve(guess.v);
  if (guess.z.size() > 0) guess.z = B.colPivHouseholderQr().solve(guess.z);
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
