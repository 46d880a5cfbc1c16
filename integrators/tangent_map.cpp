#include "courant/integrators/tangent_map.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/lu_decomposition.hpp"
#include "courant/core/rank_decision.hpp"

namespace courant {
namespace {

// A form is regular where its least pivot is more than this part of the largest.
constexpr double kRegularForm = 1e-10;

// ω_D at x in the orthonormal basis of T_xM, if D_x is the graph of a two-form.
std::optional<MatrixXd> form_at(const DiracStructure& D, const VectorXd& x) {
  const LinearDirac linear = D.linear(x);
  if (linear.vector_range().cols() != D.manifold()->dimension()) return std::nullopt;
  const auto [F, omega] = linear.form();
  return F * omega * F.transpose();
}

// Λ_D likewise, if D_x is the graph of a bivector.
std::optional<MatrixXd> bivector_at(const DiracStructure& D, const VectorXd& x) {
  const LinearDirac linear = D.linear(x);
  if (linear.covector_range().cols() != D.manifold()->dimension()) return std::nullopt;
  const auto [F, lambda] = linear.bivector();
  return F * lambda * F.transpose();
}

}  // namespace

TangentMap::TangentMap(const Integrator& method, const MatrixXd& conormals,
                       std::shared_ptr<const DiracStructure> structure)
    : differential_(method.differential()),
      manifold_(method.system()->manifold()),
      conormals_(conormals),
      structure_(std::move(structure)) {
  if (!differential_)
    throw std::invalid_argument("TangentMap::TangentMap: " + method.name() +
                                " does not know the differential of its steps; expected a method "
                                "that does.");
  if (structure_ && !structure_->is_dirac()) structure_ = nullptr;
}

MatrixXd TangentMap::start(const VectorXd& x) const {
  const MatrixXd basis = manifold_->tangent_basis(x);
  const MatrixXd frame = manifold_->frame(x);
  if (is_whole()) return frame * basis;
  return frame * basis * kernel(conormals_ * basis, {.data_error = 1e-9});
}

MatrixXd TangentMap::coordinates(const VectorXd& x, const MatrixXd& velocities) const {
  return manifold_->tangent_basis(x).matrix().transpose() *
         (manifold_->coframe(x).matrix() * velocities);
}

void TangentMap::begin(const VectorXd& x) { memory_ = {x, x, start(x)}; }

void TangentMap::advance(const Step& step) {
  memory_.images = (*differential_)(step, memory_.images);
  memory_.present = step.after.x;
}

void TangentMap::recall(const Memory& memory) {
  const Index N = manifold_->ambient_dimension();
  if (memory.first.size() != N || memory.present.size() != N || memory.images.rows() != N)
    throw std::invalid_argument("TangentMap::recall: the memory is of points of " +
                                std::to_string(memory.first.size()) + " numbers; expected " +
                                std::to_string(N) + ".");
  memory_ = memory;
}

std::optional<double> TangentMap::symplecticity_defect() const {
  if (!structure_) return std::nullopt;
  const auto& [first, present, images] = memory_;
  const MatrixXd from = coordinates(first, start(first)), to = coordinates(present, images);
  const auto omega = form_at(*structure_, first);
  if (omega) {
    const auto omega_here = form_at(*structure_, present);
    const MatrixXd before = from.transpose() * *omega * from;
    if (!omega_here || before.size() == 0 || before.norm() == 0.0) return std::nullopt;
    return (to.transpose() * *omega_here * to - before).norm() / before.norm();
  }
  const auto lambda = bivector_at(*structure_, first), there = bivector_at(*structure_, present);
  if (!is_whole() || !lambda || !there || there->norm() == 0.0) return std::nullopt;
  const MatrixXd map = to * from.transpose();
  return (map * *lambda * map.transpose() - *there).norm() / there->norm();
}

std::optional<double> TangentMap::volume_defect() const {
  const auto& [first, present, images] = memory_;
  const MatrixXd from = coordinates(first, start(first)), to = coordinates(present, images);
  if (structure_) {
    const auto omega = form_at(*structure_, first), there = form_at(*structure_, present);
    if (omega && there) {
      const LuDecomposition before(from.transpose() * *omega * from);
      if (before.size() > 0 && before.pivot_ratio() > kRegularForm) {
        const LuDecomposition after(to.transpose() * *there * to);
        return std::sqrt(std::fabs(after.determinant() / before.determinant())) - 1.0;
      }
    }
  }
  if (!is_whole() || to.cols() == 0) return std::nullopt;
  return std::fabs(LuDecomposition(to).determinant()) - 1.0;
}

}  // namespace courant
