// The forces that joints carry.
#pragma once

#include <vector>

#include "courant/structures/mechanism.hpp"

namespace courant {

// What the parent of each joint gives its child, in the world: the force, and the torque about the joint (the origin of
// its frame on the child). Of joints that close loops, and of all joints in absolute coordinates, it is what their
// multipliers λ say, -Σ λ_a (f_a, m_a) of the conditions (JointCondition), with what drives, turns back or damps the
// joint itself. Of joints in a tree it is what the balance of momentum leaves for them (Newton-Euler, from the tips to
// the root): of all bodies that they carry,
//
//   force = Σ (m a - loads),   torque = Σ (dL/dt + (c - o) × m a - moments of the loads about o)
//
// Accelerations are those of ṗ: M(q) ẇ = ṗ - Ṁ w, where p = M w are the momenta. Where M is singular, since something
// moves without mass, ẇ is one of many, and momenta do not differ by which.
//
//   q, w, p_rate   configuration (N), its velocity (Ñ), dp/dt (Ñ)
//   lambda         of the conditions of mechanism.loops(), in their order
//   loads          of all that acts from outside and of springs, without gravity
//   effort         of each joint, generalised components (n) of what acts in it; empty: nothing
std::vector<Wrench> joint_reactions(const Mechanism& mechanism, const ExprVector& q,
                                    const ExprVector& w, const ExprVector& p_rate,
                                    const ExprVector& lambda,
                                    const std::vector<Mechanism::Load>& loads,
                                    const std::vector<ExprVector>& effort);

}  // namespace courant
