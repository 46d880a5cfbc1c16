#include "courant/integrators/methods/tangent_map.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/rank_decision.hpp"
#include "courant/integrators/methods/discrete_flow.hpp"

namespace courant {
namespace {

// A form is regular where its least pivot is more than this part of the largest.
constexpr double kRegularForm = 1e-10;

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
  return consistent_directions(*manifold_, conormals_, x);
}

TangentMap::Site TangentMap::site(const VectorXd& x, const MatrixXd& velocities) const {
  Site at{.velocities = manifold_->tangent_basis(x).matrix().transpose() *
                        (manifold_->coframe(x).matrix() * velocities)};
  if (!structure_) return at;
  const LinearDirac linear = structure_->linear(x);
  const Index n = manifold_->dimension();
  if (linear.vector_range().cols() == n) {
    const auto [F, omega] = linear.form();
    at.form = F * omega * F.transpose();
  } else if (linear.covector_range().cols() == n) {
    const auto [F, lambda] = linear.bivector();
    at.bivector = F * lambda * F.transpose();
  }
  return at;
}

void TangentMap::begin(const VectorXd& x) {
  memory_ = {x, x, start(x)};
  first_ = site(x, memory_.images);
}

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
  if (first_.velocities.size() == 0 || memory.first != memory_.first)
    first_ = site(memory.first, start(memory.first));
  memory_ = memory;
}

TangentMap::Defects TangentMap::defects() const {
  const Site here = site(memory_.present, memory_.images);
  return {symplecticity(here), volume(here)};
}

std::optional<double> TangentMap::symplecticity(const Site& here) const {
  const MatrixXd &from = first_.velocities, &to = here.velocities;
  if (first_.form) {
    const MatrixXd before = from.transpose() * *first_.form * from;
    if (!here.form || before.size() == 0 || before.norm() == 0.0) return std::nullopt;
    return (to.transpose() * *here.form * to - before).norm() / before.norm();
  }
  if (!is_whole() || !first_.bivector || !here.bivector || here.bivector->norm() == 0.0)
    return std::nullopt;
  const MatrixXd map = to * from.transpose();
  return (map * *first_.bivector * map.transpose() - *here.bivector).norm() / here.bivector->norm();
}

std::optional<double> TangentMap::volume(const Site& here) const {
  const MatrixXd &from = first_.velocities, &to = here.velocities;
  if (first_.form && here.form) {
    const LuDecomposition before(from.transpose() * *first_.form * from);
    if (before.size() > 0 && before.pivot_ratio() > kRegularForm) {
      const LuDecomposition after(to.transpose() * *here.form * to);
      return std::sqrt(std::fabs(after.determinant() / before.determinant())) - 1.0;
    }
  }
  if (!is_whole() || to.cols() == 0) return std::nullopt;
  return std::fabs(LuDecomposition(to).determinant()) - 1.0;
}

}  // namespace courant
