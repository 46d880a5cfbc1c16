#include "courant/integrators/step/kinetic_metric.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {
namespace {

using MatrixFormula = Projector::MatrixFormula;

MatrixFormula inverse_of(const MatrixFormula& matrix) {
  return [matrix](const ExprVector& x) -> ExprMatrix {
    const ExprMatrix A = matrix(x);
    return solve(A, ExprMatrix::Identity(A.rows(), A.cols()));
  };
}

// A formula, if its matrix is k × k and positive definite at x.
bool is_metric(const MatrixFormula& formula, Index k, const VectorXd& x) {
  const ExprMatrix here = formula(constants(x));
  if (k == 0 || here.rows() != k) return false;
  try {
    const MatrixXd A = values(here);
    // On T*S² a part that is zero is left with round-off.
    return A.allFinite() && decide_rank(A).rank == k &&
           CholeskyDecomposition(A).is_positive_definite();
  } catch (const std::domain_error&) {
    return false;
  }
}

// ∂²H/∂p² along the frame, with 1 across M, where there is nothing to be moved; an empty matrix where it depends on more
// than positions.
MatrixFormula of_energy(const std::shared_ptr<const ImplicitSystem>& system,
                        const std::vector<Index>& momenta) {
  return [system, momenta](const ExprVector& at) -> ExprMatrix {
    const Manifold& M = *system->manifold();
    const Graph graph = fresh_graph({at});
    const ExprVector y = graph.variables("x", at.size());
    const ExprVector z = graph.variables("z", system->auxiliary_size());
    const Expr t = graph.variable("t");
    const auto energy = system->energy(y, z, t);
    if (!energy) return {};
    const LinearMap<Expr> frame = M.frame(y);
    // The derivative of f along the momenta. Where the frame is the identity, nothing is multiplied.
    const auto by_momenta = [&](const ExprVector& f) -> ExprMatrix {
      if (frame.is_identity()) return jacobian(f, ExprVector(y(momenta))).dense();
      return jacobian(f, y).dense() * frame.entries()(Eigen::all, momenta);
    };
    const ExprVector slope = by_momenta(ExprVector::Constant(1, *energy)).transpose();
    const auto k = static_cast<Index>(momenta.size());
    ExprMatrix result = by_momenta(slope);
    if (const LinearMap<Expr> tangent = M.tangent_projector(y); !tangent.is_identity())
      result += ExprMatrix::Identity(k, k) - tangent.entries()(momenta, momenta);
    const ExprVector entries = result.reshaped();
    if (depends(entries, joined({z, ExprVector::Constant(1, t)}))) return {};
    ExprVector varying(entries.size());
    const auto end = std::copy_if(entries.begin(), entries.end(), varying.begin(),
                                  [](const Expr& entry) { return !entry.is_constant(); });
    varying.conservativeResize(end - varying.begin());
    const ExprMatrix changes = by_momenta(varying);
    for (const Expr& change : changes.reshaped())
      if (!change.is_constant(0.0)) return {};
    return substitute(entries, y, at).reshaped(k, k);
  };
}

// ∂²L/∂w² of E = ⟨p, w⟩ - L(q, w) and what constraints add to it, where the w are the parameters with ∂E/∂p_i = w_i.
MatrixFormula of_lagrangian(const std::shared_ptr<const ImplicitSystem>& system,
                            const std::vector<Index>& momenta) {
  const auto dirac = std::dynamic_pointer_cast<const DiracSystem>(system);
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system->manifold());
  if (!dirac || !bundle || momenta != MomentumProjector::momenta_of(*bundle)) return {};
  return [family = dirac->family(), bundle](const ExprVector& at) -> ExprMatrix {
    const Graph graph = fresh_graph({at});
    const ExprVector y = graph.variables("x", at.size());
    const ExprVector lambda = graph.variables("lambda", family->parameter_size());
    const Expr t = graph.variable("t");
    const Expr E = family->value(y, lambda, t);
    const ExprVector p = bundle->momentum(y);
    const ExprVector rate = gradient(E, p);
    ExprVector w(p.size());
    for (Index i = 0; i < p.size(); ++i) {
      const auto found = std::find(lambda.begin(), lambda.end(), rate[i]);
      if (found == lambda.end()) return {};
      w[i] = *found;
    }
    const Manifold& Q = *bundle->base();
    ExprMatrix g = -jacobian(gradient(E, w), w).dense();
    // Across Q the family says that w is tangent, where there is nothing to be moved.
    if (Q.dimension() < Q.tangent_dimension()) {
      const ExprMatrix projector = Q.tangent_projector(bundle->position(y)).matrix();
      g = (projector.transpose() * g * projector).eval();
      g += ExprMatrix::Identity(p.size(), p.size()) - projector;
    }
    const ExprVector entries = g.reshaped();
    if (depends(entries, joined({ExprVector(p), lambda, ExprVector::Constant(1, t)}))) return {};
    return substitute(entries, y, at).reshaped(p.size(), p.size());
  };
}

}  // namespace

std::optional<KineticMetric> kinetic_metric(const std::shared_ptr<const ImplicitSystem>& system,
                                            const std::vector<Index>& momenta, const VectorXd& x) {
  const auto k = static_cast<Index>(momenta.size());
  if (const auto raise = of_energy(system, momenta); is_metric(raise, k, x))
    return KineticMetric{.lower = inverse_of(raise), .raise = raise};
  if (const auto lower = of_lagrangian(system, momenta); lower && is_metric(lower, k, x))
    return KineticMetric{.lower = lower, .raise = inverse_of(lower)};
  return std::nullopt;
}

}  // namespace courant
