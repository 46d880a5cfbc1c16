#include "courant/integrators/boundary/consistent_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/words/message.hpp"
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
  Graph graph;
  const ExprVector x = graph.variables("x", system_->manifold()->ambient_dimension()),
                   z = graph.variables("z", system_->auxiliary_size()), t = graph.variables("t", 1);
  if (const auto energy = system_->energy(x, z, t[0]))
    energy_ = Function("energy", {{"x", x}, {"z", z}, {"t", t}}, ExprVector{{*energy}});
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
  // Unknowns are followed on the way: far from where they are known an iteration finds those of another branch.
  constexpr double shortest = 1e-3;
  State last = from;
  double length = 1.0;
  for (double part = 0.0; part < 1.0;) {
    const double next = std::min(1.0, part + length);
    State to = last;
    to.x = M.retract(from.x, (M.coframe(from.x) * (next * w)).eval());
    if (!M.has_identity_frame()) to.x = M.project(to.x);
    try {
      last = nearest(to);
      part = next;
    } catch (const std::domain_error&) {
      length *= 0.5;
      if (length < shortest) throw;
    }
  }
  return last;
}

State ConsistentPoints::nearest(const State& state) const {
  State there = state;
  if (projection_) {
    projection_->stepper()->prepare(there, 1e-3);
  } else if (system_->auxiliary_size() > 0) {
    VectorField::Evaluation evaluation(field_);
    VectorXd rate(there.x.size());
    evaluation(state, rate);
    there.v = evaluation.v();
    there.z = evaluation.z();
  }
  require_energy(there);
  return there;
}

void ConsistentPoints::require_energy(const State& at) const {
  if (energy_.input_count() == 0) return;
  if (!std::isfinite(energy_({at.x, at.z, VectorXd::Constant(1, at.t)})[0]))
    throw std::domain_error("the energy is not finite at t = " + number_text(at.t));
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
