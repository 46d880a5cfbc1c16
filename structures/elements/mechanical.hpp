// Mechanical elements, in translation and in rotation.
#pragma once

#include "courant/structures/elements/element.hpp"

namespace courant::elements {

// Terminals: from, to, nodes that move; velocities are differences, that of `from` less that of `to`. `domain` is
// domains::translation (N, m/s) or domains::rotation (N·m, rad/s).

// One terminal. A state p_<name>, or l_<name> of an inertia.
Element mass(double mass);        // kg
Element inertia(double inertia);  // kg·m²

// A state x_<name>, or theta_<name> of a torsion spring: the elongation.
Element spring(double stiffness);          // N/m
Element spring(StateLaw energy);           // J
Element torsion_spring(double stiffness);  // N·m/rad
Element torsion_spring(StateLaw energy);   // J

Element damper(const Domain& domain, Law coefficient);        // force = coefficient velocity
Element damper_of_velocity(const Domain& domain, Law force);  // of the velocity, voltage(0)
// Dry friction, force tanh (velocity/width): Coulomb's law but for velocities below `width`.
Element friction(const Domain& domain, double force, double width);

// A force (torque) on `to`, and its reaction on `from`; a velocity of `from` less that of `to`.
Element force_source(const Domain& domain, Law force);
Element velocity_source(const Domain& domain, Law velocity);

// Terminals: two shafts. omega₁ = ratio omega₂, tau₂ = -ratio tau₁, against the ground.
Element gear(double ratio);

}  // namespace courant::elements
