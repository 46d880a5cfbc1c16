#include "courant/structures/explicit_energy.hpp"

#include <random>
#include <stdexcept>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

// A⁻¹ b; nothing where a pivot is the constant 0.
std::optional<ExprVector> solved(const ExprMatrix& A, const ExprVector& b) {
  try {
    return ExprVector(solve(A, b));
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

// Whether numbers are a matrix of rank 1 less, or worse: masses of components that no tangent vector has.
bool is_singular(const MatrixXd& masses) {
  constexpr double round_off = 1e-12;
  if (!masses.allFinite()) return false;  // at this point
  const VectorXd sizes = singular_values(masses);
  return !(sizes.minCoeff() > round_off * sizes.maxCoeff());
}

}  // namespace

std::optional<Expr> explicit_energy(const EnergySystem& system, const ExprVector& x,
                                    const ExprVector& z, const Expr& t) {
  if (system.has_explicit_energy()) return system.generator(x, z, t);
  const ExprVector time = z[0].graph().variables("time", 1);
  const Expr E = system.generator(x, z, time[0]);
  const ExprVector slopes = jacobian(ExprVector::Constant(1, E), z).dense().row(0);
  const ExprMatrix curvature = jacobian(slopes, z).dense();
  std::vector<Index> velocities;
  for (Index i = 0; i < z.size(); ++i)
    for (Index j = 0; j < z.size(); ++j)
      if (!curvature(i, j).is_constant(0.0)) {
        velocities.push_back(i);
        break;
      }
  if (velocities.empty()) return std::nullopt;
  const ExprVector w = z(velocities);
  const ExprMatrix masses = curvature(velocities, velocities);
  if (depends(masses.reshaped(), z)) return std::nullopt;
  if (depends(ExprVector(slopes(velocities)), time)) return std::nullopt;
  std::mt19937 generator(1);
  const VectorXd somewhere = system.manifold()->random_point(generator);
  const Expr there = system.generator(constants(somewhere), z, Expr(0.0));
  const ExprMatrix of_all =
      jacobian(ExprVector(jacobian(ExprVector::Constant(1, there), z).dense().row(0)), z).dense();
  const ExprMatrix of_velocities = of_all(velocities, velocities);
  if (is_singular(values(of_velocities))) return std::nullopt;
  const auto at_rest =
      substitute(ExprVector(slopes(velocities)), w, ExprVector(ExprVector::Zero(w.size())));
  const auto against = solved(masses, at_rest);
  if (!against) return std::nullopt;
  const ExprVector on_M = substitute(ExprVector::Constant(1, E), w, ExprVector(-*against));
  return substitute(on_M, time, ExprVector::Constant(1, t))[0];
}

}  // namespace courant
