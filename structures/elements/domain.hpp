// Domain: of what kind the flows and efforts of an element are.
#pragma once

#include <string>

namespace courant::elements {

// A pair of a through and an across variable whose product is a power, and the first letters of names: of these two,
// and of the across variable of a node against the ground.
struct Domain {
  std::string name;
  std::string through, across, node;
};

namespace domains {
extern const Domain electrical;   // i_R1 in A, v_R1 in V, potential_a
extern const Domain translation;  // F_K1 in N, v_K1 in m/s, velocity_a
extern const Domain rotation;     // tau_K1 in N·m, omega_K1 in rad/s, speed_a
extern const Domain hydraulic;    // Q_P1 in m³/s, P_P1 in Pa, pressure_a
extern const Domain thermal;      // s_G1 in W/K, T_G1 in K, temperature_a
}  // namespace domains

}  // namespace courant::elements
