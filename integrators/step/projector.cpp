#include "courant/integrators/step/projector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"

namespace courant {
namespace {

// The sine of the angle between the directions and T_xM_f below which they count as no complement:
// projecting would lose more than half of the digits.
constexpr double kTransversality = 1e-8;
// Columns that span directions are fewer than they seem below this.
constexpr double kIndependent = 1e-13;

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

}  // namespace

Projector::Projector(std::string name, VectorXd units)
    : name_(std::move(name)), units_(std::move(units)) {
  for (const double unit : units_)
    if (!(unit > 0.0) || !std::isfinite(unit))
      throw std::invalid_argument("Projector(" + name_ + ")::Projector: a unit is " +
                                  number_text(unit) + "; expected positive numbers.");
}

ExprMatrix Projector::span(const ExprVector& x, const Expr& t, const LinearMap<Expr>& basis,
                           const ExprMatrix& conormals) const {
  const ExprMatrix covectors = basis * conormals;
  const ExprMatrix V = do_directions(x, t, basis * basis.transpose(), covectors);
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
  const ExprVector t = graph.variables("t", 1);
  ExprMatrix conormals = C.reshaped(n, codimension);
  if (const VectorXd sizes = conormal_sizes(); sizes.size() > 0)
    conormals = (constants(sizes).asDiagonal() * conormals).eval();
  const ExprMatrix V = span(x, t[0], basis, conormals);
  return {{{"x", x}, {"basis", basis_parameters(basis)}, {"C", C}, {"t", t}}, V.reshaped()};
}

MatrixXd Projector::directions(const VectorXd& x, const LinearMap<double>& basis,
                               const MatrixXd& conormals, double t) const {
  return orthonormal_directions(
      values(span(constants(x), Expr(t), constants(basis), constants(conormals))), basis,
      conormals);
}

MatrixXd Projector::orthonormal_directions(const MatrixXd& V, const LinearMap<double>& basis,
                                           const MatrixXd& conormals) const {
  const Index d = conormals.cols();
  if (d == 0) return conormals;
  const auto vectors = QrDecomposition::pivoted(V.colwise().normalized());
  const auto refuse = [this](double sine) {
    throw std::domain_error("Projector(" + name_ +
                            ")::directions: the directions of the projector \"" + name_ +
                            "\" meet T_xM_f, sine of the angle " + number_text(sine) +
                            "; expected a complement of it. " + do_advice());
  };
  if (is_always_complement()) {
    if (const double least = vectors.diagonal().cwiseAbs().minCoeff(); !(least > kIndependent))
      refuse(least);
    return vectors.Q(d);
  }
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
  if (!(sine > kTransversality)) refuse(sine);
  return vectors.Q(d);
}

OrthogonalProjector::OrthogonalProjector(const Manifold& manifold, const MatrixFormula& metric)
    : Projector("orthogonal"),
      metric_(checked("OrthogonalProjector::OrthogonalProjector", manifold, metric,
                      manifold.tangent_dimension())) {}

ExprMatrix OrthogonalProjector::do_directions(const ExprVector& x, const Expr&,
                                              const LinearMap<Expr>& tangents,
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

// Π g β for the momentum parts β of the conormals.
ExprMatrix MomentumProjector::do_directions(const ExprVector& x, const Expr&,
                                            const LinearMap<Expr>& tangents,
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
