#include "courant/structures/joint_reactions.hpp"

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

// Momenta of all bodies in the world, (m v of the centre, J ω about it), as linear maps of w: 6 × Ñ each.
std::vector<ExprMatrix> momentum_maps(const Mechanism& mechanism, const Mechanism::Motion& motion) {
  std::vector<ExprMatrix> maps;
  for (std::size_t b = 0; b < mechanism.parts().bodies.size(); ++b) {
    const Mechanism::Body& body = mechanism.parts().bodies[b];
    const auto index = static_cast<Index>(b);
    const ExprMatrix& R = motion.body[b].R;
    ExprMatrix map(6, motion.angular[b].cols());
    map.topRows(3) =
        body.mass * mechanism.velocity_of(motion, index, mechanism.center_of(motion, index));
    map.bottomRows(3) = R * (body.inertia * (R.transpose() * motion.angular[b]));
    maps.push_back(std::move(map));
  }
  return maps;
}

// M (Ñ × Ñ), from T = ½ ⟨w, M w⟩.
ExprMatrix mass_matrix(const Mechanism& mechanism, const Mechanism::Motion& motion,
                       const std::vector<ExprMatrix>& momenta) {
  const Index size = mechanism.manifold()->tangent_dimension();
  ExprMatrix M = ExprMatrix::Zero(size, size);
  for (std::size_t b = 0; b < momenta.size(); ++b) {
    const auto index = static_cast<Index>(b);
    M += mechanism.velocity_of(motion, index, mechanism.center_of(motion, index)).transpose() *
         momenta[b].topRows(3);
    M += motion.angular[b].transpose() * momenta[b].bottomRows(3);
  }
  return M;
}

// d/dt of the momenta, 6 for each body, along (q̇, ẇ).
ExprVector momentum_rates(const Mechanism& mechanism, const ExprVector& q, const ExprVector& w,
                          const ExprVector& p_rate) {
  const Manifold& Q = *mechanism.manifold();
  const Index N = Q.ambient_dimension(), n = Q.tangent_dimension();
  const Graph graph = fresh_graph({q, w, p_rate});
  const ExprVector at = graph.variables("q", N), moving = graph.variables("w", n),
                   rate = graph.variables("r", n);
  const Mechanism::Motion motion = mechanism.motion(at);
  const std::vector<ExprMatrix> maps = momentum_maps(mechanism, motion);
  const ExprMatrix M = mass_matrix(mechanism, motion, maps);
  const ExprVector flow = Q.frame(at) * moving, p = M * moving;
  ExprVector momenta(6 * std::ssize(maps));
  for (std::size_t b = 0; b < maps.size(); ++b)
    momenta.segment(6 * static_cast<Index>(b), 6) = maps[b] * moving;
  // Where nothing heavy moves, any ẇ will do: no momentum has it in it.
  const ExprVector acceleration = solve_semidefinite(M, ExprMatrix(rate - tangent(p, at, flow)));
  return substitute(tangent(momenta, joined(at, moving), joined(flow, acceleration)),
                    joined(at, moving, rate), joined(q, w, p_rate));
}

}  // namespace

std::vector<Wrench> joint_reactions(const Mechanism& mechanism, const ExprVector& q,
                                    const ExprVector& w, const ExprVector& p_rate,
                                    const ExprVector& lambda,
                                    const std::vector<Mechanism::Load>& loads,
                                    const std::vector<ExprVector>& effort) {
  const Mechanism::Parts& parts = mechanism.parts();
  const Mechanism::Motion motion = mechanism.motion(q);
  std::vector<Wrench> reactions(parts.joints.size());
  // What the bodies have to get from the joints that carry them, with a torque about the centre.
  std::vector<Wrench> needed(parts.bodies.size());
  const auto give = [&](Index body, const ExprVector& at, const ExprVector& force,
                        const ExprVector& torque, const Expr& factor) {
    if (body == Mechanism::ground) return;
    Wrench& sum = needed[as_size(body)];
    sum.force -= factor * force;
    sum.torque -= factor * (torque + cross_product(at - mechanism.center_of(motion, body), force));
  };

  Index first = 0;
  for (const Index loop : mechanism.loops()) {
    Wrench& reaction = reactions[as_size(loop)];
    for (const JointCondition& condition : mechanism.conditions(motion, loop))
      reaction = reaction + -lambda[first++] * condition.gradient;
    if (const ExprVector& own = effort[as_size(loop)]; own.size() > 0) {
      Index k = 0;
      for (const Wrench& direction : joint_directions(mechanism.place_of(motion, loop)))
        reaction = reaction + own[k++] * direction;
    }
    for (const Mechanism::Load& load : mechanism.joint_loads(motion, loop, reaction))
      give(load.body, load.at, load.force, load.torque, 1.0);
  }
  const auto& branches = mechanism.branches();
  bool has_tree = false;
  for (const Mechanism::Branch& branch : branches) has_tree = has_tree || branch.joint >= 0;
  if (!has_tree) return reactions;

  const ExprVector rates = momentum_rates(mechanism, q, w, p_rate);
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    needed[b].force += rates.segment(6 * static_cast<Index>(b), 3);
    needed[b].torque += rates.segment(6 * static_cast<Index>(b) + 3, 3);
    needed[b].force -= parts.bodies[b].mass * parts.gravity;
  }
  for (const Mechanism::Load& load : loads) give(load.body, load.at, load.force, load.torque, 1.0);
  for (auto branch = branches.rbegin(); branch != branches.rend(); ++branch) {
    if (branch->joint < 0) continue;
    const ExprVector at = mechanism.place_of(motion, branch->joint).C.r;
    const Wrench& own = needed[as_size(branch->body)];
    Wrench& reaction = reactions[as_size(branch->joint)];
    reaction.force = own.force;
    reaction.torque =
        own.torque + cross_product(mechanism.center_of(motion, branch->body) - at, own.force);
    give(parts.joints[as_size(branch->joint)].parent, at, reaction.force, reaction.torque, -1.0);
  }
  return reactions;
}

}  // namespace courant
