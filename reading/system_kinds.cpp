#include "courant/reading/system_kinds.hpp"

#include "courant/reading/catalogue_system.hpp"
#include "courant/reading/complex_keys.hpp"
#include "courant/reading/lie_algebra_keys.hpp"
#include "courant/reading/mechanics_keys.hpp"
#include "courant/reading/mechanism_keys.hpp"
#include "courant/reading/system_examples.hpp"

namespace courant {
namespace {

std::vector<Key> together(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

// With an example each, and the systems of the catalogue that are data.
std::vector<Registry<Model>::Kind> completed(std::vector<Registry<Model>::Kind> kinds) {
  for (auto& kind : kinds) kind.description.example = system_example(kind.description.type);
  for (const CatalogueSystem& entry : catalogue_systems())
    kinds.push_back({entry.description(), [&entry](ObjectReader& system) {
                       return entry.read(system, system_kinds());
                     }});
  return kinds;
}

}  // namespace

std::vector<Key> system_keys(std::vector<Key> keys) {
  keys.push_back(optional_key("parameters", takes::parameters(),
                              "constants: numbers, arrays, matrices, or formulas of earlier ones"));
  keys.push_back(optional_key("tables", takes::tables(), "functions of t by tables of numbers"));
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
  const Key configurations = coordinates("of the configurations; points of the system are (q, p)");
  const Key metric = optional_key("metric", takes::formulas(),
                                  "g(q): a matrix, its diagonal or a number, on velocities (v_R of "
                                  "R[3][3]); by default the identity");
  const Key potential =
      optional_key("potential", takes::formula(), "V, in coordinates and t; by default 0");
  const Key inputs = optional_key("inputs", takes::formulas(),
                                  "added to the rates of the momenta: n formulas in momenta, "
                                  "velocities, advected parameters and t");
  static Registry<Model> kinds(completed({
      {{"hamiltonian", "(v, dH) ∈ D: a Dirac structure and a Hamiltonian in formulas",
        system_keys(together(
            {coordinates("of the manifold; on a cotangent bundle of its base, the momentum "
                         "of x is p_x"),
             required_key("hamiltonian", takes::formula(), "H, in coordinates, momenta and t"),
             default_key("structure", takes::kind("structure"), "canonical", "D"),
             optional_key("manifold", takes::kind("manifold"),
                          "by default the cotangent bundle of Rⁿ for the canonical "
                          "structure, Rⁿ otherwise")},
            mechanics_keys()))},
       read_hamiltonian},
      {{"lagrangian", "a Lagrangian in formulas, singular or not, on T*Q",
        system_keys(together(
            {configurations,
             required_key("lagrangian", takes::formula(), "L, in coordinates, velocities and t"),
             manifold("Q, of the configurations"),
             default_key("structure", takes::kind("structure"), "canonical", "D, on T*Q")},
            mechanics_keys()))},
       read_lagrangian},
      {{"mechanical", "L = g(q', q')/2 - V on T*Q",
        system_keys(
            together({configurations, manifold("Q, of the configurations"), metric, potential},
                     mechanics_keys()))},
       read_mechanical},
      {{"vakonomic",
        "the data of a nonholonomic system, with its constraints in the variational principle: "
        "L + lambda g",
        system_keys(together({configurations, manifold("Q, of the configurations"),
                              optional_key("lagrangian", takes::formula(),
                                           "L, in coordinates, velocities and t; instead of a "
                                           "metric and a potential"),
                              metric, potential},
                             mechanics_keys()))},
       read_vakonomic},
      {{"morse-family", "(v, α) ∈ D, α ∈ 𝓛 = {∂E/∂x : ∂E/∂λ = 0}",
        system_keys(
            {coordinates("of the manifold; on a cotangent bundle of its base, the momentum "
                         "of x is p_x"),
             optional_key("multipliers", takes::names(), "λ, which have no derivative"),
             required_key("family", takes::formula(), "E, in coordinates, multipliers and t"),
             default_key("structure", takes::kind("structure"), "canonical", "D"),
             optional_key("manifold", takes::kind("manifold"),
                          "by default the cotangent bundle of Rⁿ for the canonical "
                          "structure, Rⁿ otherwise")})},
       read_morse_family},
      {{"optimal-control",
        "x' = f(x, u, t), least integral of a cost, by Pontryagin's E = p f - cost",
        system_keys({required_key("states", takes::coordinates(),
                                  "x; points of the system are (x, p), the momentum of x is p_x"),
                     required_key("controls", takes::names(), "u, which have no derivative"),
                     required_key("dynamics", takes::formulas(),
                                  "f: a formula in states, controls and t for each velocity"),
                     required_key("cost", takes::formula(), "in states, controls and t"),
                     optional_key("final_cost", takes::formula(),
                                  "in states and t, at the end of a `boundary`"),
                     default_key("extremals", takes::word({"normal", "abnormal"}), "normal",
                                 "abnormal: E = p f, without the cost"),
                     manifold("of the states")})},
       read_optimal_control},
      {{"euler-poincare",
        "a reduced Lagrangian or Hamiltonian on the dual of a Lie algebra",
        system_keys(together(
            lie_algebra_keys(),
            {optional_key("lagrangian", takes::formula(),
                          "l, in velocities, advected parameters and t"),
             optional_key("hamiltonian", takes::formula(),
                          "h, in momenta, advected parameters and t"),
             default_key("momentum", takes::text(), "mu", "the name of the momenta, n of them"),
             default_key("velocity", takes::text(), "xi", "the name of the velocities"),
             optional_key("advected", takes::names(),
                          "parameters that the group acts on: \"Gamma[3]\""),
             optional_key(
                 "representation",
                 takes::representation({"vectors", "symmetric-matrices", "two-forms", "adjoint"}),
                 "how: by a word, or a matrix for each e_i; so3 and so(n) know that of "
                 "vectors"),
             optional_key("attitude", takes::names(),
                          "points of the group as part of the state: \"R[3][3]\" for so3, of "
                          "matrices all entries"),
             inputs,
             optional_key("nonholonomic", takes::formulas(),
                          "constraints: one-forms in velocities that are zero, with reactions "
                          "along them; multipliers lambda"),
             default_key("sign", takes::word({"minus", "plus"}), "minus",
                         "minus in body coordinates")})),
        {lie_algebra_choice(), {"lagrangian", "hamiltonian"}}},
       read_euler_poincare},
      {{"port-hamiltonian", "x' = (J - R) dH + B u, y = Bᵀ dH with open or closed ports",
        system_keys(
            {coordinates("of the manifold"), manifold("of the states"),
             required_key("hamiltonian", takes::formula(), "H, in coordinates and t"),
             required_key("J", takes::form_matrix(), "n × n, skew-symmetric"),
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
      {{"stokes-dirac",
        "two conservation laws on a cell complex, dp/dt + d e_q = 0 and dq/dt + d e_p = 0: waves, "
        "lines, Maxwell's equations; with a conductivity one law",
        system_keys(
            {required_key("complex", takes::one(complex_keys()), "the cells"),
             default_key("degree", takes::integer(0), 0,
                         "k, of e_p: p has a number for each k-cell, q for each (k+1)-cell"),
             required_key("states", takes::names(),
                          "of p and q; of p alone where there is a conductivity"),
             required_key("efforts", takes::names(), "of e_p and e_q"),
             required_key("energy", takes::definitions(),
                          "densities by state, in the densities of the states, x, y, z and t"),
             optional_key("resistance", takes::definitions(),
                          "r by state: r times the square of the component of its effort is lost"),
             optional_key("conductivity", takes::formula(),
                          "of e_q = -conductivity grad e_p, which dissipates"),
             optional_key("heat_conductivity", takes::formula(),
                          "the same for the temperature e_p of the entropy p: energy is conserved"),
             optional_key("regions", takes::definitions(),
                          "more parts of the boundary: by name a condition on x, y, z"),
             optional_key("boundary", takes::boundary_conditions(),
                          "by region: an effort, an impedance, or a port; by default nothing flows "
                          "in")})},
       read_stokes_dirac},
      {{"interconnection", "systems that are joined at their ports",
        system_keys({required_key("systems", takes::systems(),
                                  "by name: of type port-hamiltonian, stokes-dirac, network or "
                                  "interconnection"),
                     required_key("joints", takes::array_of(takes::joint()),
                                  "what ports have in common")})},
       read_interconnection},
      {{"implicit", "equations in coordinates, velocities, unknowns and t",
        system_keys({coordinates("of the manifold"), manifold("of the states"),
                     optional_key("unknowns", takes::names(),
                                  "names of the z, which have no derivative: multipliers, forces"),
                     required_key("equations", takes::formula_vector(), "each of them zero"),
                     optional_key("energy", takes::formula(),
                                  "in coordinates, unknowns and t; becomes H")})},
       read_implicit},
      {{"network", "elements between nodes: circuits, mechanisms, hydraulic and thermal networks",
        system_keys({required_key("nodes", takes::nodes(), "their names, the ground first"),
                     required_key("elements", takes::array_of(takes::kind("element"), 1),
                                  "what connects them")})},
       read_network},
      {{"mechanism", "rigid bodies, joints and springs, in SI units",
        system_keys(mechanism_keys())},
       read_mechanism},
      {{"point-vortices", "n point vortices in the plane, with coordinates x[n], y[n]",
        system_keys({strengths,
                     default_key("form", takes::word({"lagrangian", "hamiltonian"}), "lagrangian",
                                 "the singular Lagrangian (7) on T*R²ⁿ, with momenta p_x, p_y, or "
                                 "the Hamiltonian with its bivector on R²ⁿ")})},
       read_point_vortices},
      {{"spherical-vortices", "n point vortices on the unit sphere, with coordinates x[n][3]",
        system_keys({strengths})},
       read_spherical_vortices},
  }));
  return kinds;
}

}  // namespace courant
