#include "courant/integrators/step/projector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {
namespace {

// The sine of the angle between the directions and T_xM_f below which they count as no complement:
// projecting would lose more than half of the digits.
constexpr double kTransversality = 1e-8;

// The formula, if it gives a matrix of that size.
Projector::MatrixFormula checked(const char* name, const Manifold& manifold,
                                 const Projector::MatrixFormula& formula, Index size) {
  if (!formula) return {};
  Graph graph;
  const ExprMatrix matrix = formula(graph.variables("x", manifold.ambient_dimension()));
  if (matrix.rows() != size || matrix.cols() != size)
    throw std::invalid_argument(std::string(name) + ": metric is " +
                                size_text(matrix.rows(), matrix.cols()) + "; expected " +
                                size_text(size, size) + ".");
  return formula;
}

// The w with wᵀ G v = α v for all tangent v, for the columns α: tangent vectors, since the equations across T_xM are those
// of 1 - Π alone, next to `across`, which is of the size of G.
ExprMatrix raised(const ExprMatrix& G, const ExprMatrix& across, const LinearMap<Expr>& tangents,
                  const ExprMatrix& covectors) {
  if (tangents.is_identity()) return solve(G, covectors);
  const ExprMatrix& P = tangents.entries();
  const ExprMatrix Q = ExprMatrix::Identity(P.rows(), P.cols()) - P;
  return solve(ExprMatrix(P.transpose() * G * P + Q.transpose() * across * Q), covectors);
}

// How much two subspaces of the same dimension, one of vectors and one of covectors, see of each
// other: 0 if some vector is annihilated, 1 if they are the same. Columns span them.
double least_pairing(const MatrixXd& vectors, const MatrixXd& covectors) {
  const Index d = covectors.cols();
  const auto orthonormal = [d](const MatrixXd& A, double least) -> MatrixXd {
    const auto qr = QrDecomposition::pivoted(A.colwise().normalized());
    const VectorXd pivots = qr.diagonal().cwiseAbs();
    if (pivots.size() < d || !(pivots[d - 1] > least)) return MatrixXd();
    return qr.Q(d);
  };
  // Covectors are known to be independent, however small some of them look in their units.
  const MatrixXd V = orthonormal(vectors, kTransversality), C = orthonormal(covectors, 1e-13);
  if (V.size() == 0 || C.size() == 0) return 0.0;
  return singular_values(C.transpose() * V).minCoeff();
}

const CotangentBundle& checked(const std::shared_ptr<const CotangentBundle>& phase_space) {
  if (!phase_space)
    throw std::invalid_argument("MomentumProjector::MomentumProjector: phase_space is null.");
  return *phase_space;
}

// (∂²H/∂p²)⁻¹, or empty.
Projector::MatrixFormula metric_of_energy(const std::shared_ptr<const ImplicitSystem>& system,
                                          const std::vector<Index>& momenta, const VectorXd& x) {
  // ∂²H/∂p² along the frame, with 1 across M, where there is nothing to be moved.
  const auto inverse_metric = [system, momenta](const ExprVector& at) -> ExprMatrix {
    const Manifold& M = *system->manifold();
    Graph graph;
    const ExprVector y = graph.variables("x", at.size());
    const ExprVector z = graph.variables("z", system->auxiliary_size());
    const Expr t = graph.variable("t");
    const auto energy = system->energy(y, z, t);
    if (!energy) return {};
    const ExprMatrix E = M.frame(y);
    const auto k = static_cast<Index>(momenta.size());
    const ExprVector slope = E.transpose() * gradient(*energy, y);
    ExprVector selected(k);
    for (Index i = 0; i < k; ++i) selected[i] = slope[momenta[static_cast<std::size_t>(i)]];
    const ExprMatrix along = jacobian(selected, y).dense() * E;
    const ExprMatrix projector = M.tangent_projector(y);
    ExprMatrix result(k, k);
    for (Index i = 0; i < k; ++i)
      for (Index j = 0; j < k; ++j) {
        const Index row = momenta[static_cast<std::size_t>(i)],
                    column = momenta[static_cast<std::size_t>(j)];
        result(i, j) = along(i, column) + Expr(i == j ? 1.0 : 0.0) - projector(row, column);
      }
    ExprVector other(z.size() + 1);
    other << z, t;
    const ExprVector entries = result.reshaped();
    if (jacobian(entries, other).values.size() > 0) return {};
    const ExprVector moved = substitute(entries, y, at);
    return moved.reshaped(k, k);
  };
  const auto metric = [inverse_metric](const ExprVector& at) -> ExprMatrix {
    const ExprMatrix inverse = inverse_metric(at);
    return solve(inverse, ExprMatrix::Identity(inverse.rows(), inverse.cols()));
  };
  const auto k = static_cast<Index>(momenta.size());
  const ExprMatrix inverse = inverse_metric(constants(x));
  if (k == 0 || inverse.rows() != k) return {};
  try {
    const MatrixXd g = values(metric(constants(x))), G = values(inverse);
    if (!g.allFinite() || !G.allFinite()) return {};
    if (!((G * g - MatrixXd::Identity(k, k)).norm() < 1e-8)) return {};
  } catch (const std::domain_error&) {
    return {};
  }
  return metric;
}

// ∂²L/∂w² of E = ⟨p, w⟩ - L(q, w) and what constraints add to it, where the w are the parameters
// with ∂E/∂p_i = w_i; or empty.
Projector::MatrixFormula metric_of_lagrangian(const std::shared_ptr<const ImplicitSystem>& system,
                                              const std::vector<Index>& momenta,
                                              const VectorXd& x) {
  const auto* dirac = dynamic_cast<const DiracSystem*>(system.get());
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system->manifold());
  if (!dirac || !bundle || momenta != MomentumProjector::momenta_of(*bundle)) return {};
  const auto metric = [family = dirac->family(), bundle](const ExprVector& at) -> ExprMatrix {
    Graph graph;
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
    ExprVector other(p.size() + lambda.size() + 1);
    other << p, lambda, t;
    const ExprVector entries = g.reshaped();
    if (depends(entries, other)) return {};
    return substitute(entries, y, at).reshaped(p.size(), p.size());
  };
  const auto k = static_cast<Index>(momenta.size());
  const ExprMatrix here = metric(constants(x));
  if (k == 0 || here.rows() != k) return {};
  try {
    const MatrixXd g = values(here);
    if (!g.allFinite() || !CholeskyDecomposition(g).is_positive_definite()) return {};
  } catch (const std::domain_error&) {
    return {};
  }
  return metric;
}

}  // namespace

Projector::Projector(std::string name, VectorXd units)
    : name_(std::move(name)), units_(std::move(units)) {
  for (const double unit : units_)
    if (!(unit > 0.0) || !std::isfinite(unit))
      throw std::invalid_argument("Projector(" + name_ + ")::Projector: a unit is " +
                                  number_text(unit) + "; expected positive numbers.");
}

ExprMatrix Projector::span(const ExprVector& x, const LinearMap<Expr>& basis,
                           const ExprMatrix& conormals) const {
  const ExprMatrix covectors = basis * conormals;
  const ExprMatrix V = do_directions(x, basis * basis.transpose(), covectors);
  if (V.rows() != covectors.rows() || V.cols() != covectors.cols())
    throw std::invalid_argument("Projector(" + name_ + ")::do_directions: the result is " +
                                size_text(V.rows(), V.cols()) + "; expected " +
                                size_text(covectors.rows(), covectors.cols()) +
                                ", tangent vectors × (dim M - dim M_f).");
  return basis.transpose() * V;
}

Function::Formulas Projector::span_formulas(const Manifold& manifold, Index codimension) const {
  if (is_orthogonal() || codimension == 0) return {};
  Graph graph;
  const Index n = manifold.dimension();
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, manifold);
  const ExprVector C = graph.variables("C", n * codimension);
  const ExprMatrix V = span(x, basis, C.reshaped(n, codimension));
  return {{{"x", x}, {"basis", basis_parameters(basis)}, {"C", C}}, V.reshaped()};
}

MatrixXd Projector::directions(const VectorXd& x, const LinearMap<double>& basis,
                               const MatrixXd& conormals) const {
  return orthonormal_directions(values(span(constants(x), constants(basis), constants(conormals))),
                                basis, conormals);
}

MatrixXd Projector::orthonormal_directions(const MatrixXd& V, const LinearMap<double>& basis,
                                           const MatrixXd& conormals) const {
  const Index d = conormals.cols();
  if (d == 0) return conormals;
  // Pairings of vectors with covectors do not depend on units, but lengths do: both are looked at
  // as numbers of the order of 1. Of B with n < Ñ the coordinates have the units of its entries.
  double sine;
  if (units_.size() == 0) {
    sine = least_pairing(V, conormals);
  } else {
    const VectorXd size =  // of coordinates
        basis.is_identity()
            ? units_
            : VectorXd((basis.entries().cwiseAbs2().transpose() * units_.cwiseAbs2()).cwiseSqrt());
    sine = least_pairing(size.cwiseInverse().asDiagonal() * V, size.asDiagonal() * conormals);
  }
  if (!(sine > kTransversality)) {
    throw std::domain_error("Projector(" + name_ +
                            ")::directions: the directions of the projector \"" + name_ +
                            "\" meet T_xM_f, sine of the angle " + number_text(sine) +
                            "; expected a complement of it. " + do_advice());
  }
  return QrDecomposition::pivoted(V.colwise().normalized()).Q(d);
}

OrthogonalProjector::OrthogonalProjector(const Manifold& manifold, const MatrixFormula& metric)
    : Projector("orthogonal"),
      metric_(checked("OrthogonalProjector::OrthogonalProjector", manifold, metric,
                      manifold.tangent_dimension())) {}

ExprMatrix OrthogonalProjector::do_directions(const ExprVector& x, const LinearMap<Expr>& tangents,
                                              const ExprMatrix& conormals) const {
  if (metric_) {
    const ExprMatrix G = metric_(x);
    const Index size = G.rows();
    const Expr scale = G.trace() / static_cast<double>(std::max<Index>(size, 1));
    return raised(G, ExprMatrix(ExprMatrix::Identity(size, size) * scale), tangents, conormals);
  }
  if (units().size() == 0) return conormals;
  const VectorXd squares = units().cwiseAbs2();
  if (tangents.is_identity()) return constants(squares).asDiagonal() * conormals;
  const ExprMatrix G = constants(MatrixXd(squares.cwiseInverse().asDiagonal()));
  return raised(G, G, tangents, conormals);
}

MomentumProjector::MomentumProjector(const std::shared_ptr<const CotangentBundle>& phase_space,
                                     const MatrixFormula& metric, VectorXd units)
    : MomentumProjector(checked(phase_space), momenta_of(checked(phase_space)), metric,
                        std::move(units)) {
  momentum_dimension_ = phase_space->base()->dimension();
}

MomentumProjector::MomentumProjector(const Manifold& manifold, std::vector<Index> momenta,
                                     const MatrixFormula& metric, VectorXd units)
    : Projector("momentum", std::move(units)),
      momenta_(std::move(momenta)),
      momentum_dimension_(static_cast<Index>(momenta_.size())),
      metric_(checked("MomentumProjector::MomentumProjector", manifold, metric,
                      static_cast<Index>(momenta_.size()))) {
  for (const Index i : momenta_)
    if (i < 0 || i >= manifold.tangent_dimension())
      throw std::invalid_argument("MomentumProjector::MomentumProjector: a momentum is entry " +
                                  std::to_string(i) + " of tangent vectors; expected 0 to " +
                                  std::to_string(manifold.tangent_dimension() - 1) + ".");
}

std::vector<Index> MomentumProjector::momenta_of(const CotangentBundle& phase_space) {
  const Index n = phase_space.base()->tangent_dimension();
  std::vector<Index> result;
  for (Index i = 0; i < n; ++i) result.push_back(n + i);
  return result;
}

Projector::MatrixFormula MomentumProjector::kinetic_metric(
    const std::shared_ptr<const ImplicitSystem>& system, const std::vector<Index>& momenta,
    const VectorXd& x) {
  const MatrixFormula metric = metric_of_energy(system, momenta, x);
  return metric ? metric : metric_of_lagrangian(system, momenta, x);
}

// Π g β for the momentum parts β of the conormals.
ExprMatrix MomentumProjector::do_directions(const ExprVector& x, const LinearMap<Expr>& tangents,
                                            const ExprMatrix& conormals) const {
  ExprMatrix moved = conormals(momenta_, Eigen::all);
  if (metric_)
    moved = (metric_(x) * moved).eval();
  else if (units().size() > 0)
    moved = (constants(VectorXd(units()(momenta_).cwiseAbs2())).asDiagonal() * moved).eval();
  ExprMatrix vectors = ExprMatrix::Zero(conormals.rows(), conormals.cols());
  vectors(momenta_, Eigen::all) = moved;
  return tangents * vectors;
}

}  // namespace courant
