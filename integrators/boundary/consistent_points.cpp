#include "courant/integrators/boundary/consistent_points.hpp"

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"

namespace courant {

ConsistentPoints::ConsistentPoints(std::shared_ptr<const ImplicitSystem> system,
                                   const ConstraintLadder& ladder)
    : system_(std::move(system)),
      dimension_(ladder.degrees_of_freedom),
      codimension_(ladder.conormals().rows()),
      field_(system_, ladder, Backend::interpreter),
      differential_(field_.formulas()) {
  if (codimension_ > 0)
    projection_ = std::make_shared<ConstrainFirst>(
        system_, ladder, std::make_shared<Theta>(system_->manifold(), 0.5),
        usual_projector(system_, ladder), ConstrainFirst::Options{Backend::interpreter});
}

MatrixXd ConsistentPoints::directions(const State& at) const {
  const Manifold& M = *system_->manifold();
  if (codimension_ == 0 && M.has_identity_frame())
    return MatrixXd::Identity(at.x.size(), at.x.size());
  if (codimension_ == 0) return orthonormalized((M.frame(at.x) * M.tangent_basis(at.x)).matrix());
  VectorField::Evaluation evaluation(field_);
  VectorXd rate(at.x.size());
  evaluation(at, rate);
  const MatrixXd inside = differential_.constrained_directions(
      {at.x, at.t, evaluation.unknowns(), evaluation.basis()}, codimension_);
  return orthonormalized((M.frame(at.x) * evaluation.basis()).matrix() * inside);
}

State ConsistentPoints::moved(const State& from, const VectorXd& w) const {
  const Manifold& M = *system_->manifold();
  State to = from;
  to.x = M.retract(from.x, (M.coframe(from.x) * w).eval());
  if (!M.has_identity_frame()) to.x = M.project(to.x);
  return nearest(to);
}

State ConsistentPoints::nearest(const State& state) const {
  if (!projection_) return state;
  State there = state;
  projection_->stepper()->prepare(there, 1e-3);
  return there;
}

VectorXd ConsistentPoints::way(const VectorXd& from, const VectorXd& to) const {
  const Manifold& M = *system_->manifold();
  if (M.has_identity_frame()) return M.inverse_retract(from, to);
  return to - from;
}

ConsistentPoints::Rates ConsistentPoints::rates(const State& at, const MatrixXd& V) const {
  VectorField::Evaluation evaluation(field_);
  VectorXd rate(at.x.size());
  evaluation(at, rate);
  auto images = differential_({at.x, at.t, evaluation.unknowns(), evaluation.basis()}, V);
  return {evaluation.v(), evaluation.z(), std::move(images.v), std::move(images.z)};
}

}  // namespace courant
