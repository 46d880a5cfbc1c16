// Elements between the electrical and the mechanical domains.
#pragma once

#include "courant/structures/elements/element.hpp"

namespace courant::elements {

// Terminals: from, to, and what moves against the ground. v = K velocity, force = K i; `domain` is domains::rotation (a
// motor, K in V·s/rad) or domains::translation (a voice coil, K in V·s/m). Winding and rotor are elements besides.
Element motor(double constant, const Domain& domain);

// Terminals: from, to, armature. A flux phi_<name> in Wb and the position x_<name> of the armature in m, with the
// energy phi²/(2 L(x)); L in H, of own[1].
Element electromagnet(StateLaw inductance);

}  // namespace courant::elements
