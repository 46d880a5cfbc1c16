#include "courant/integrators/step/kinetic_projector.hpp"

#include <stdexcept>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
namespace {

// The equations of the system that say something of q and t alone.
std::vector<Index> conditions_on_positions(const ImplicitSystem& system,
                                           const CotangentBundle& bundle) {
  Graph graph;
  const ExprVector x = graph.variables("x", bundle.ambient_dimension());
  const ExprVector v = graph.variables("v", bundle.tangent_dimension());
  const ExprVector z = graph.variables("z", system.auxiliary_size());
  const ExprVector F = system.residual(x, v, z, graph.variable("t"));
  const ExprVector q = bundle.position(x), others = joined({ExprVector(bundle.momentum(x)), v, z});
  std::vector<Index> result;
  for (Index i = 0; i < F.size(); ++i) {
    const ExprVector one = ExprVector::Constant(1, F[i]);
    if (depends(one, q) && !depends(one, others)) result.push_back(i);
  }
  return result;
}

// The matrix next to its size.
ExprMatrix measured(const ExprMatrix& A) { return A * (1.0 / sqrt(A.squaredNorm())); }

// Its rows next to these sizes, or to 1.
ExprMatrix next_to(const VectorXd& sizes, const ExprMatrix& A) {
  if (sizes.size() == 0) return measured(A);
  return constants(sizes).asDiagonal() *
         measured(constants(VectorXd(sizes.cwiseInverse())).asDiagonal() * A);
}

}  // namespace

KineticProjector::KineticProjector(std::shared_ptr<const CotangentBundle> bundle,
                                   KineticMetric metric, Differentials conditions, Index count)
    : Projector("orthogonal"),
      bundle_(std::move(bundle)),
      metric_(std::move(metric)),
      conditions_(std::move(conditions)),
      count_(count) {}

std::shared_ptr<const KineticProjector> KineticProjector::of(
    const std::shared_ptr<const ImplicitSystem>& system, const ConstraintLadder& ladder) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system->manifold());
  const VectorXd& x = ladder.point.x;
  if (!bundle || x.size() == 0 || ladder.constraints.empty()) return nullptr;
  auto metric = kinetic_metric(system, MomentumProjector::momenta_of(*bundle), x);
  if (!metric) return nullptr;
  const std::vector<Index> rows = conditions_on_positions(*system, *bundle);
  const auto conditions = [system, bundle, rows](const ExprVector& at,
                                                 const Expr& t) -> ExprMatrix {
    const Graph graph = fresh_graph({at});
    const ExprVector y = graph.variables("x", at.size());
    const ExprVector v = graph.variables("v", bundle->tangent_dimension());
    const ExprVector z = graph.variables("z", system->auxiliary_size());
    const Expr time = graph.variable("t");
    const ExprVector q = bundle->position(y);
    const ExprVector phi = system->residual(y, v, z, time)(rows);
    const ExprMatrix J = jacobian(phi, q).dense() * bundle->base()->frame(q);
    const ExprVector entries = J.reshaped();
    return substitute(entries, joined({y, ExprVector::Constant(1, time)}),
                      joined({at, ExprVector::Constant(1, t)}))
        .reshaped(J.rows(), J.cols());
  };
  const std::shared_ptr<KineticProjector> projector(new KineticProjector(
      bundle, std::move(*metric), conditions, static_cast<Index>(rows.size())));
  if (bundle->dimension() == bundle->tangent_dimension()) {
    const VectorXd root = values(projector->metric_.lower(constants(x))).diagonal().cwiseSqrt();
    projector->sizes_.resize(2 * root.size());
    projector->sizes_ << root, root.cwiseInverse();
  }
  const LinearMap<double> basis = bundle->tangent_basis(x);
  MatrixXd C = basis.transpose() * ladder.conormals().transpose();
  if (const VectorXd& sizes = projector->sizes_; sizes.size() > 0)
    C = sizes.asDiagonal() * orthonormalized(sizes.cwiseInverse().asDiagonal() * C);
  else
    C = orthonormalized(C);
  try {
    projector->directions(x, basis, C, ladder.point.t);
  } catch (const std::domain_error&) {
    return nullptr;
  }
  return projector;
}

std::shared_ptr<const Projector> KineticProjector::balanced(const VectorXd& sizes) const {
  const auto result = std::make_shared<KineticProjector>(*this);
  result->balance_ = sizes;
  return result;
}

ExprMatrix KineticProjector::do_directions(const ExprVector& x, const Expr& t,
                                           const LinearMap<Expr>& tangents,
                                           const ExprMatrix& conormals) const {
  const Index n = conormals.rows() / 2;
  const ExprMatrix C_q = conormals.topRows(n), C_p = conormals.bottomRows(n);
  ExprMatrix V = ExprMatrix::Zero(2 * n, conormals.cols());
  if (count_ > 0) {
    constexpr double none = 1e-300;  // 0 / none for a differential that vanishes
    const ExprMatrix J = conditions_(x, t), raised = metric_.raise(x) * J.transpose();
    ExprMatrix seen = raised.transpose() * C_q;
    for (Index i = 0; i < seen.rows(); ++i) {
      const Expr square = ExprMatrix(J.row(i) * raised.col(i))(0, 0);
      seen.row(i) /= square + Expr(none);
    }
    V.topRows(n) = next_to(balance_.head(balance_.size() / 2), raised * seen);
  }
  V.bottomRows(n) = next_to(balance_.tail(balance_.size() / 2), metric_.lower(x) * C_p);
  return tangents * V;
}

std::shared_ptr<const Projector> usual_projector(
    const std::shared_ptr<const ImplicitSystem>& system, const ConstraintLadder& ladder) {
  if (auto kinetic = KineticProjector::of(system, ladder)) return kinetic;
  return std::make_shared<OrthogonalProjector>();
}

}  // namespace courant
