#include "courant/reading/system_kinds.hpp"

namespace courant {

std::vector<Key> system_keys(std::vector<Key> keys) {
  keys.push_back(optional_key("parameters", takes::parameters(),
                              "constants: numbers, arrays, matrices, or formulas of earlier ones"));
  keys.push_back(
      optional_key("definitions", takes::definitions(), "named formulas for use in later ones"));
  return keys;
}

Registry<Model>& system_kinds() {
  const auto coordinates = [](const char* summary) {
    return required_key("coordinates", takes::coordinates(), summary);
  };
  const auto manifold = [](const char* summary) {
    return default_key("manifold", takes::kind("manifold"), "euclidean", summary);
  };
  const Key strengths =
      required_key("strengths", takes::array_of(takes::formula(), 1), "n numbers other than 0");
  static Registry<Model> kinds({
      {{"hamiltonian", "(v, dH) ∈ D: a Dirac structure and a Hamiltonian in formulas",
        system_keys(
            {coordinates("of the manifold; on a cotangent bundle of its base, the momentum "
                         "of x is p_x"),
             required_key("hamiltonian", takes::formula(), "H, in coordinates, momenta and t"),
             default_key("structure", takes::kind("structure"), "canonical", "D"),
             optional_key("manifold", takes::kind("manifold"),
                          "by default the cotangent bundle of Rⁿ for the canonical "
                          "structure, Rⁿ otherwise")})},
       read_hamiltonian},
      {{"lagrangian", "a Lagrangian in formulas, singular or not, on T*Q",
        system_keys(
            {coordinates("of the configurations; points of the system are (q, p)"),
             required_key("lagrangian", takes::formula(), "L, in coordinates, velocities and t"),
             manifold("Q, of the configurations")})},
       read_lagrangian},
      {{"port-hamiltonian", "x' = (J - R) dH + B u, y = Bᵀ dH with open or closed ports",
        system_keys(
            {coordinates("of the manifold"), manifold("of the states"),
             required_key("hamiltonian", takes::formula(), "H, in coordinates and t"),
             required_key("J", takes::formula_matrix(), "n × n, skew-symmetric"),
             optional_key("R", takes::formula_matrix(),
                          "n × n, symmetric, positive semidefinite; by default 0"),
             optional_key("B", takes::field_rows(),
                          "n × m, a column for each port; by default none; with one port a vector "
                          "will do"),
             optional_key("D", takes::formula_matrix(),
                          "m × m, the feedthrough in y = Bᵀ dH + D u; by default 0"),
             default_key("ports", takes::word({"closed", "open"}), "closed",
                         "closed: 0 = y, and u is an unknown; open: u is that of inputs"),
             optional_key("port_names", takes::names(),
                          "m names: u_<name> and y_<name> instead of u[0], y[0], …"),
             optional_key("inputs", takes::formula_vector(),
                          "of open ports: m formulas in t, the parameters and the outputs y (with "
                          "several ports y[0], …)")})},
       read_port_hamiltonian},
      {{"implicit", "equations in coordinates, velocities, unknowns and t",
        system_keys({coordinates("of the manifold"), manifold("of the states"),
                     optional_key("unknowns", takes::names(),
                                  "names of the z, which have no derivative: multipliers, forces"),
                     required_key("equations", takes::formula_vector(), "each of them zero"),
                     optional_key("energy", takes::formula(),
                                  "in coordinates, unknowns and t; becomes H")})},
       read_implicit},
      {{"network", "elements between nodes: circuits, mechanisms, hydraulic and thermal networks",
        system_keys({required_key("nodes", takes::names(), "their names, the ground first"),
                     required_key("elements", takes::array_of(takes::kind("element"), 1),
                                  "what connects them")})},
       read_network},
      {{"point-vortices", "n point vortices in the plane, with coordinates x[n], y[n]",
        system_keys({strengths,
                     default_key("form", takes::word({"lagrangian", "hamiltonian"}), "lagrangian",
                                 "the singular Lagrangian (7) on T*R²ⁿ, with momenta p_x, p_y, or "
                                 "the Hamiltonian with its bivector on R²ⁿ")})},
       read_point_vortices},
      {{"spherical-vortices", "n point vortices on the unit sphere, with coordinates x[n][3]",
        system_keys({strengths})},
       read_spherical_vortices},
  });
  return kinds;
}

}  // namespace courant
