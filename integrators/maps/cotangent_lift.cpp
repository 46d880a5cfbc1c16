#include "courant/integrators/maps/cotangent_lift.hpp"

#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/linear_algebra.hpp"

namespace courant {
namespace {

// The covector (μ, p) on TQ at (q, v) that is the pull-back of (P⁻, P⁺) ∈ (R^N)* × (R^N)* by R_d =
// (R⁻, R⁺), in the frame of Q:
//   ⟨μ, η⟩ + ⟨p, δ⟩ = d(⟨P⁻, R⁻⟩ + ⟨P⁺, R⁺⟩)  along  q̇ = E η,  v̇ = dΠ(E η) v + Π δ  (v stays
//   tangent).
struct PulledBack {
  ExprVector mu, p;
};

PulledBack pull_back_frame(const DiscretizationMap& map, const ExprVector& q, const ExprVector& v,
                           const ExprVector& first, const ExprVector& second) {
  const Manifold& Q = *map.manifold();
  const Index N = Q.ambient_dimension();
  const Index n = Q.tangent_dimension();
  Graph graph;
  ExprVector from(N + n + 2 * N);
  from << graph.variables("q", N), graph.variables("v", n), graph.variables("first", N),
      graph.variables("second", N);
  const ExprVector at = from.head(N);
  const ExprVector velocity = from.segment(N, n);
  const auto image = map.forward(at, velocity);
  const Expr pairing = from.segment(N + n, N).dot(image.first) + from.tail(N).dot(image.second);
  const ExprVector by_velocity = gradient(pairing, velocity);
  ExprVector by_position = gradient(pairing, at);
  const LinearMap<Expr> projector = Q.tangent_projector(at);  // the identity of Rⁿ takes no memory
  if (Q.dimension() < n)
    by_position += pull_back(ExprVector(projector * velocity), at, by_velocity);
  ExprVector covector(2 * n);
  covector << Q.frame(at).transpose() * by_position, projector.transpose() * by_velocity;
  ExprVector to(from.size());
  to << q, v, first, second;
  const ExprVector result = substitute(covector, from, to);
  return {result.head(n), result.tail(n)};
}

}  // namespace

CotangentLift::CotangentLift(std::shared_ptr<const CotangentBundle> phase_space,
                             std::shared_ptr<const DiscretizationMap> base)
    : DiscretizationMap("CotangentLift(" + (base ? base->name() : std::string("null")) + ")",
                        phase_space),
      phase_space_(std::move(phase_space)),
      base_(std::move(base)) {
  if (!base_ || *base_->manifold() != *phase_space_->base())
    throw std::invalid_argument(
        "CotangentLift::CotangentLift: base is not a discretization map on " +
        phase_space_->base()->name() + "; expected one on the base of the phase space.");
}

CotangentLift::Site CotangentLift::site(const ExprVector& q, const ExprVector& v,
                                        const ExprVector& q0, const ExprVector& q1) const {
  const auto unit = base_->is_left_invariant() ? phase_space_->base()->unit() : std::nullopt;
  if (!unit) return {q, q0, q1};
  const ExprVector e = constants(*unit);
  auto [first, second] = base_->forward(e, v);
  return {e, std::move(first), std::move(second)};
}

DiscretizationMap::TangentVector<Expr> CotangentLift::do_inverse(const ExprVector& x0,
                                                                 const ExprVector& x1) const {
  const auto [q, v] = base_->inverse(phase_space_->position(x0), phase_space_->position(x1));
  return lifted(q, v, x0, x1);
}

DiscretizationMap::Displacement CotangentLift::do_from_start(const ExprVector& x0,
                                                             const ExprVector& w) const {
  const Manifold& Q = *phase_space_->base();
  const auto [q, v, q1] =
      base_->from_start(phase_space_->position(x0), phase_space_->horizontal(w));
  const ExprVector momentum = phase_space_->momentum(x0) + phase_space_->vertical(w);
  ExprVector x1(x0.size());
  x1 << q1, Q.tangent_projector(q1).transpose() * momentum;
  auto [x, velocity] = lifted(q, v, x0, x1);
  return {std::move(x), std::move(velocity), x1};
}

DiscretizationMap::TangentVector<Expr> CotangentLift::lifted(const ExprVector& q,
                                                             const ExprVector& v,
                                                             const ExprVector& x0,
                                                             const ExprVector& x1) const {
  const Manifold& Q = *phase_space_->base();
  const Site at = site(q, v, phase_space_->position(x0), phase_space_->position(x1));
  const ExprVector first = -(Q.coframe(at.q0).transpose() * phase_space_->momentum(x0).eval());
  const ExprVector second = Q.coframe(at.q1).transpose() * phase_space_->momentum(x1).eval();
  const PulledBack covector = pull_back_frame(*base_, at.q, v, first, second);
  const ExprVector momentum_rate = covector.mu - phase_space_->torsion(q, covector.p, v);
  TangentVector<Expr> result;
  result.x.resize(x0.size());
  result.x << q, covector.p;
  result.v.resize(phase_space_->tangent_dimension());
  result.v << v, Q.tangent_projector(q).transpose() * momentum_rate;
  return result;
}

DiscretizationMap::PointPair<Expr> CotangentLift::do_forward(
    const ExprVector& x, const ExprVector& tangent_vector) const {
  const Manifold& Q = *phase_space_->base();
  const Index n = Q.tangent_dimension();
  const ExprVector q = phase_space_->position(x);
  const ExprVector p = phase_space_->momentum(x);
  const ExprVector v = phase_space_->horizontal(tangent_vector);
  const auto [q0, q1] = base_->forward(q, v);

  // The pull-back is linear in (p₀, p₁): its matrix, column by column. Where covectors are
  // overcomplete, the normal parts of unknowns and equations are matched with each other, which
  // makes the matrix regular and leaves the tangential part alone.
  const ExprMatrix one = ExprMatrix::Identity(n, n);
  const ExprMatrix P = Q.tangent_projector(q).transpose();
  const ExprMatrix P0 = Q.tangent_projector(q0).transpose();
  const ExprMatrix P1 = Q.tangent_projector(q1).transpose();
  const Site at = site(q, v, q0, q1);
  const ExprMatrix C0 = Q.coframe(at.q0).transpose() * P0;
  const ExprMatrix C1 = Q.coframe(at.q1).transpose() * P1;
  const ExprVector none = ExprVector::Zero(Q.ambient_dimension());
  ExprMatrix A(2 * n, 2 * n);
  for (Index j = 0; j < n; ++j) {
    const PulledBack left = pull_back_frame(*base_, at.q, v, -C0.col(j), none);
    const PulledBack right = pull_back_frame(*base_, at.q, v, none, C1.col(j));
    A.col(j) << P * left.mu, left.p;
    A.col(n + j) << P * right.mu, right.p;
  }
  if (Q.dimension() < n) {
    const ExprMatrix normal = one - P;
    A.topLeftCorner(n, n) -= normal * (one - P0).eval();
    A.bottomRightCorner(n, n) += normal * (one - P1).eval();
  }
  ExprMatrix right_side(2 * n, 1);
  right_side
      << P * (phase_space_->vertical(tangent_vector) + phase_space_->torsion(q, p, v)).eval(),
      p;
  const ExprVector momenta = solve(A, right_side);
  PointPair<Expr> result{ExprVector(x.size()), ExprVector(x.size())};
  result.first << q0, P0 * momenta.head(n).eval();
  result.second << q1, P1 * momenta.tail(n).eval();
  return result;
}

}  // namespace courant
