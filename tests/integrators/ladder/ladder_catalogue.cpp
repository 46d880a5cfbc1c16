#include "ladder_catalogue.hpp"

#include <numbers>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"

// In the derivations λ is a multiplier, ' the velocity; "fibre" is what is left of the velocity at
// a point of M_k. Where nothing else is said the sequence follows from one differentiation a level.
namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

std::shared_ptr<const Euclidean> space(Index n) { return std::make_shared<Euclidean>(n); }

// Dimensions of a Hessenberg chain: each level takes one from both until (last, last).
Dimensions falling(Index dim_S, Index dim_M, Index steps) {
  Dimensions result;
  for (Index k = 0; k < steps; ++k) result.emplace_back(dim_S - k, dim_M - k);
  result.emplace_back(dim_M - steps + 1, dim_M - steps + 1);
  result.push_back(result.back());
  return result;
}

void ordinary(std::vector<KnownLadder>& table) {
  // A vector field: S_0 is its graph.
  table.push_back({"Van der Pol oscillator",
                   {flat(2, 0, 2,
                         [](V x, V v, V, T) {
                           return equations({v[0] - x[1], v[1] - (1 - square(x[0])) * x[1] + x[0]});
                         }),
                    at({0.7, -0.4})},
                   {{2, 2}, {2, 2}},
                   Verdict::regular,
                   0});
  // The same with time in it and a mass matrix that depends on x, regular everywhere.
  table.push_back({"forced oscillator with a mass matrix",
                   {flat(2, 0, 2,
                         [](V x, V v, V, T t) {
                           return equations(
                               {(2 + square(x[1])) * v[0] + x[0] * v[1] - x[1],
                                x[0] * v[0] + (1 + square(x[0])) * v[1] + x[0] - sin(2 * t)});
                         }),
                    at({0.7, -0.4})},
                   {{2, 2}, {2, 2}},
                   Verdict::regular,
                   0});
  // Six equations of which two are independent: x' = y, y' = -x, their sum, …
  table.push_back(
      {"oscillator written three times",
       {flat(2, 0, 6,
             [](V x, V v, V, T) {
               const Expr a = v[0] - x[1], b = v[1] + x[0];
               return equations({a, b, a + b, a - 2 * b, 3 * b, a * (1 + square(x[0]))});
             }),
        at({0.7, -0.4})},
       {{2, 2}, {2, 2}},
       Verdict::regular,
       0,
       4});
  // 0 = y + y³ - x gives y(x), differentiated once it gives y'. S_0: y' free.
  table.push_back(
      {"index 1, semi-explicit",
       {flat(2, 0, 2,
             [](V x, V v, V, T) {
               return equations({v[0] + x[0] - x[1], x[1] + x[1] * square(x[1]) - x[0]});
             }),
        at({0.7, 0.2})},
       {{2, 1}, {1, 1}, {1, 1}},
       Verdict::regular,
       1});
  // Robertson's kinetics with the conservation law in place of the third rate; rates 0.04, 1e4,
  // 3e7.
  table.push_back(
      {"Robertson's reaction",
       {flat(3, 0, 3,
             [](V x, V v, V, T) {
               const Expr a = 0.04 * x[0] - 1e4 * x[1] * x[2];
               return equations({v[0] + a, v[1] - a + 3e7 * square(x[1]), x[0] + x[1] + x[2] - 1});
             }),
        at({0.99, 3e-5, 0.01})},
       {{3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       1});
  // Hessenberg form of index 2, multiplier z as a state: g, ġ (gives z), g̈ (gives z').
  table.push_back({"Hessenberg form of index 2",
                   {flat(3, 0, 3,
                         [](V x, V v, V, T) {
                           return equations({v[0] - x[0] * x[1] - x[2], v[1] + x[1] - x[0],
                                             square(x[0]) + square(x[1]) - 1});
                         }),
                    at({0.7, 0.6, 0.1})},
                   falling(3, 2, 2),
                   Verdict::regular,
                   2});
  // Hessenberg form of index 3: the pendulum with λ as a state; λ' is free until the end.
  table.push_back({"Hessenberg form of index 3",
                   {flat(5, 0, 5,
                         [](V x, V v, V, T) {
                           return equations({v[0] - x[2], v[1] - x[3], v[2] + x[4] * x[0],
                                             v[3] + x[4] * x[1] + 9.81,
                                             square(x[0]) + square(x[1]) - 1});
                         }),
                    at({0.6, -0.9, 0.1, 0.3, 8.0})},
                   falling(5, 4, 3),
                   Verdict::regular,
                   3});
  // N x' + x = f(t) with N nilpotent of degree 4: x_4 = f_4, x_3 = f_3 - f_4', …
  table.push_back({"nilpotent of degree 4",
                   {flat(4, 0, 4,
                         [](V x, V v, V, T t) {
                           return equations({v[1] + x[0] - sin(t), v[2] + x[1] - cos(t),
                                             v[3] + x[2] - exp(t), x[3] - sin(2 * t)});
                         }),
                    at({8.9, 0.1, -0.9, 0.1})},
                   falling(4, 3, 4),
                   Verdict::regular,
                   4});
  // x_1 = sin t prescribed, x_i' = x_{i+1} + x_i²/10, x_5' = z the force that achieves it: five
  // differentiations of the constraint until z appears.
  table.push_back({"prescribed trajectory of a chain of five",
                   {flat(5, 1, 6,
                         [](V x, V v, V z, T t) {
                           ExprVector F(6);
                           for (Index i = 0; i < 5; ++i)
                             F[i] = v[i] - (i < 4 ? x[i + 1] : z[0]) - 0.1 * square(x[i]);
                           F[5] = x[0] - sin(t);
                           return F;
                         }),
                    at({0.05, 0.95, -0.05, -1.15, 0.1})},
                   falling(5, 4, 5),
                   Verdict::regular,
                   5});
}

void singular_lagrangians(std::vector<KnownLadder>& table) {
  // First class. p_e = 0, then the mass shell ẋ²/e² = -m², which is conserved; e' stays free.
  table.push_back(
      {"relativistic particle with einbein",
       {lagrangian(
            3, [](V q, V w, T) { return (square(w[1]) - square(w[0])) / (2 * q[2]) - 0.5 * q[2]; }),
        {.x = (VectorXd(6) << 0.1, 0.2, 0.8, -1.2, 0.5, 0.1).finished(),
         .v = (VectorXd(6) << 1.0, 0.4, 0, 0, 0, 0).finished(),
         .z = (VectorXd(3) << 1.0, 0.4, 0).finished()}},
       {{6, 5}, {5, 4}, {5, 4}},
       Verdict::gauge,
       1});
  // p = ∂L/∂q' is homogeneous of degree 0 in q': the mass shell at once, speed along it free.
  table.push_back(
      {"relativistic particle",
       {lagrangian(3, [](V, V w, T) { return -sqrt(square(w[0]) - square(w[1]) - square(w[2])); }),
        {.x = (VectorXd(6) << 0.1, 0.2, 0.3, -1.2, 0.5, 0.4).finished(),
         .v = (VectorXd(6) << 1.3, 0.5, 0.4, 0, 0, 0).finished(),
         .z = (VectorXd(3) << 1.3, 0.5, 0.4).finished()}},
       {{6, 5}, {6, 5}},
       Verdict::gauge,
       0});
  // Free electromagnetism on a triangle: potentials a on sites, A on edges,
  // L = ½ Σ (A' - da)² - ½ (ΣA)². p_a = 0, then Gauss' law, whose three equations add up to 0.
  table.push_back({"Maxwell on a triangle",
                   {lagrangian(6,
                               [](V q, V w, T) {
                                 Expr L = -0.5 * square(q[3] + q[4] + q[5]);
                                 for (Index e = 0; e < 3; ++e)
                                   L += 0.5 * square(w[3 + e] - q[(e + 1) % 3] + q[e]);
                                 return L;
                               }),
                    at({0.3, -0.2, 0.5, 0.1, 0.7, -0.3, 0, 0.1, 0, 0.4, 0.5, 0.2})},
                   {{12, 9}, {10, 7}, {10, 7}},
                   Verdict::gauge,
                   1});
  // L = ½ (x' - y)²: p_y = 0, then p_x = 0; y is arbitrary.
  table.push_back({"Lagrangian of a square",
                   {lagrangian(2, [](V q, V w, T) { return 0.5 * square(w[0] - q[1]); }),
                    at({0.3, 0.2, 0.4, 0.1})},
                   {{4, 3}, {3, 2}, {3, 2}},
                   Verdict::gauge,
                   1});
  // Second class. p_x = y, p_y = 0: two constraints that do not commute, no more of them.
  table.push_back(
      {"first-order Lagrangian",
       {lagrangian(2,
                   [](V q, V w, T) { return q[1] * w[0] - 0.5 * (square(q[0]) + square(q[1])); }),
        at({0.3, 0.2, 0.1, 0.1})},
       {{4, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       1});
  // Lotka and Volterra: the same with α = log y / x dx.
  table.push_back({"Lotka-Volterra Lagrangian",
                   {lagrangian(2,
                               [](V q, V w, T) {
                                 return log(q[1]) / q[0] * w[0] -
                                        (q[0] - log(q[0]) + q[1] - 2 * log(q[1]));
                               }),
                    at({1.3, 0.8, 0, 0})},
                   {{4, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   1});
  // L = ½ x'² + y x: p_y = 0, x = 0, p_x = 0, y = 0; then y' = 0.
  table.push_back({"multiplier as a coordinate",
                   {lagrangian(2, [](V q, V w, T) { return 0.5 * square(w[0]) + q[1] * q[0]; }),
                    at({0.3, 0.2, 0.4, 0.1})},
                   falling(4, 3, 4),
                   Verdict::regular,
                   4});
  // Cawley: L = x' z' + ½ y z². After p_y = 0 the constraint is z² = 0, which has no linear part:
  // not a level set of constant rank (Cawley 1979, the counterexample to Dirac's conjecture).
  table.push_back(
      {"Cawley",
       {lagrangian(3, [](V q, V w, T) { return w[0] * w[2] + 0.5 * q[1] * square(q[2]); }),
        at({0.3, 0.2, 0.0, 0.4, 0.0, 0.5})},
       {},
       Verdict::rank_change,
       -1});
  // L = x' z' + y z, its cure: p_y = 0, z = 0, p_x = z' = 0; y remains free.
  table.push_back({"Cawley with z in place of z²",
                   {lagrangian(3, [](V q, V w, T) { return w[0] * w[2] + q[1] * q[2]; }),
                    at({0.3, 0.2, 0.1, 0.4, 0.1, 0.5})},
                   {{6, 5}, {5, 4}, {4, 3}, {4, 3}},
                   Verdict::gauge,
                   2});
  // q' = ∂H/∂p from ½ q'² - V: the Legendre transform inside, nothing else.
  table.push_back(
      {"regular Lagrangian",
       {lagrangian(1, [](V q, V w, T) { return 0.5 * square(w[0]) + cos(q[0]); }), at({0.3, 0.2})},
       {{2, 2}, {2, 2}},
       Verdict::regular,
       0});
}

void mechanics(std::vector<KnownLadder>& table) {
  // n = 6, x sin θ' …: one multiplier, determined when the constraint is differentiated once.
  table.push_back({"Chaplygin's skate",
                   {flat(6, 1, 7,
                         [](V x, V v, V z, T) {
                           const Expr s = sin(x[2]), c = cos(x[2]);
                           return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5],
                                             v[3] - z[0] * s - 0.3, v[4] + z[0] * c, v[5],
                                             s * v[0] - c * v[1]});
                         }),
                    at({0.1, 0.2, 0.7, 1.0, 0.9, 0.5})},
                   {{6, 5}, {5, 5}, {5, 5}},
                   Verdict::regular,
                   1});
  // x' = cos φ θ', y' = sin φ θ': two constraints on T*R⁴.
  table.push_back({"rolling disk",
                   {flat(8, 2, 10,
                         [](V x, V v, V z, T) {
                           const Expr c = cos(x[3]), s = sin(x[3]);
                           return equations({v[0] - x[4], v[1] - x[5], v[2] - x[6], v[3] - x[7],
                                             v[4] - z[0] - 0.2, v[5] - z[1],
                                             v[6] + c * z[0] + s * z[1], v[7], x[4] - c * x[6],
                                             x[5] - s * x[6]});
                         }),
                    at({0.1, 0.2, 0.3, 0.7, 0.6, 0.5, 1.0, 0.4})},
                   {{8, 6}, {6, 6}, {6, 6}},
                   Verdict::regular,
                   1});
  // g and 2g + g²: two multipliers, of which only λ_1 + 2 λ_2 is determined.
  table.push_back({"pendulum with its rod twice",
                   {flat(4, 2, 6,
                         [](V x, V v, V z, T) {
                           const Expr g = square(x[0]) + square(x[1]) - 1;
                           const Expr force = z[0] + 2 * z[1];
                           return equations({v[0] - x[2], v[1] - x[3], v[2] + force * x[0],
                                             v[3] + force * x[1] + 9.81, g, 2 * g + square(g)});
                         }),
                    at({0.6, -0.8, 0.1, 0.3})},
                   {{4, 3}, {3, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   2,
                   1});
  // Two joints with masses, three bars: 3 constraints on R⁴.
  const auto four_bar = [](V x, V v, V z, T) {
    const ExprVector a = x.head(2), b = x.segment(2, 2);
    const Eigen::Vector2d ground(2.0, 0.0);
    const ExprVector ab = b - a, bc = b - constants(ground);
    ExprVector F(11);
    F.head(4) = v.head(4) - x.tail(4);
    F.segment(4, 2) = v.segment(4, 2) + z[0] * a - z[1] * ab;
    F.segment(6, 2) = v.segment(6, 2) + z[1] * ab + z[2] * bc;
    F[5] += 9.81;
    F[7] += 9.81;
    F[8] = a.squaredNorm() - 1.0;
    F[9] = ab.squaredNorm() - 3.24;
    F[10] = bc.squaredNorm() - 2.25;
    return F;
  };
  table.push_back({"four-bar linkage",
                   {flat(8, 3, 11, four_bar), at({0.2, 1.0, 1.9, 1.5, 0.1, 0.2, 0.3, 0.1})},
                   {{8, 5}, {5, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   2});
  // Three parallel cranks of length 1, joined by bars: θ_1 = θ_2 = θ_3 by two loops of two
  // equations each, of rank 1 each wherever they hold.
  const auto cranks = [](V x, V v, V z, T) {
    ExprVector F(10);
    F.head(3) = v.head(3) - x.tail(3);
    ExprVector loops(4);
    loops << cos(x[0]) - cos(x[1]), sin(x[0]) - sin(x[1]), cos(x[1]) - cos(x[2]),
        sin(x[1]) - sin(x[2]);
    F[3] = v[3] + cos(x[0]) - z[0] * sin(x[0]) + z[1] * cos(x[0]);
    F[4] = v[4] + (z[0] - z[2]) * sin(x[1]) + (z[3] - z[1]) * cos(x[1]);
    F[5] = v[5] + z[2] * sin(x[2]) - z[3] * cos(x[2]);
    F.tail(4) = loops;
    return F;
  };
  table.push_back({"three parallel cranks",
                   {flat(6, 4, 10, cranks), at({0.7, 0.7, 0.7, 0.3, 0.3, 0.3})},
                   {{6, 4}, {4, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   2,
                   2});
  // Cranks θ_1, θ_2 of length 1 and a coupler φ of length 2 over a base of length 2: two loop
  // equations in three angles, of rank 1 where all bars lie on one line.
  const auto parallelogram = [](V x, V v, V z, T) {
    ExprVector F(8);
    F.head(3) = v.head(3) - x.tail(3);
    F[3] = v[3] + cos(x[0]) - z[0] * sin(x[0]) + z[1] * cos(x[0]);
    F[4] = v[4] - 2 * z[0] * sin(x[1]) + 2 * z[1] * cos(x[1]);
    F[5] = v[5] + z[0] * sin(x[2]) - z[1] * cos(x[2]);
    F[6] = cos(x[0]) + 2 * cos(x[1]) - cos(x[2]) - 2;
    F[7] = sin(x[0]) + 2 * sin(x[1]) - sin(x[2]);
    return F;
  };
  table.push_back({"parallelogram linkage",
                   {flat(6, 2, 8, parallelogram), at({0.7, 0.0, 0.7, 0.3, 0.0, 0.3})},
                   {{6, 4}, {4, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   2});
  table.push_back({"parallelogram linkage, flat",
                   {flat(6, 2, 8, parallelogram), at({0, 0, 0, 0, 0, 0})},
                   {},
                   Verdict::rank_change,
                   -1});
  // Two pendula, one hanging from the other: 2 constraints on R⁴.
  table.push_back({"double pendulum",
                   {flat(8, 2, 10,
                         [](V x, V v, V z, T) {
                           const ExprVector a = x.head(2), d = x.segment(2, 2) - a;
                           ExprVector F(10);
                           F.head(4) = v.head(4) - x.tail(4);
                           F.segment(4, 2) = v.segment(4, 2) + z[0] * a - z[1] * d;
                           F.segment(6, 2) = v.segment(6, 2) + z[1] * d;
                           F[5] += 9.81;
                           F[7] += 9.81;
                           F[8] = a.squaredNorm() - 1.0;
                           F[9] = d.squaredNorm() - 1.0;
                           return F;
                         }),
                    at({0.6, -0.9, 1.5, -1.2, 0.1, 0.3, 0.2, 0.1})},
                   {{8, 6}, {6, 4}, {4, 4}, {4, 4}},
                   Verdict::regular,
                   2});
  // A particle on y² = x² - x⁴, at the node: the gradient of the constraint vanishes there.
  table.push_back({"lemniscate at its node",
                   {flat(4, 1, 5,
                         [](V x, V v, V z, T) {
                           return equations({v[0] - x[2], v[1] - x[3],
                                             v[2] + z[0] * (2 * x[0] - 4 * square(x[0]) * x[0]),
                                             v[3] - 2 * z[0] * x[1],
                                             square(x[0]) - square(square(x[0])) - square(x[1])});
                         }),
                    at({0, 0, 0, 0})},
                   {},
                   Verdict::rank_change,
                   -1});
}

void ports_and_circuits(std::vector<KnownLadder>& table) {
  // Inductors alone at a node: their currents are equal, the voltage e there follows from the
  // derivative. Charge q, fluxes φ_1, φ_2.
  table.push_back({"inductor cut-set",
                   {flat(3, 1, 4,
                         [](V x, V v, V z, T) {
                           return equations({v[0] + x[1] / 2.0, v[1] - x[0] + z[0],
                                             v[2] - z[0] + 0.1 * x[2], x[1] / 2.0 - x[2] / 3.0});
                         }),
                    at({0.5, 0.4, 0.2})},
                   {{3, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   1});
  // The same with e as a state, as circuit simulators have it.
  table.push_back({"inductor cut-set with the node voltage as a state",
                   {flat(4, 0, 4,
                         [](V x, V v, V, T) {
                           return equations({v[0] + x[1] / 2.0, v[1] - x[0] + x[3],
                                             v[2] - x[3] + 0.1 * x[2], x[1] / 2.0 - x[2] / 3.0});
                         }),
                    at({0.5, 0.4, 0.2, 0.1})},
                   falling(4, 3, 2),
                   Verdict::regular,
                   2});
  // A voltage source across a capacitor (its current z is a derivative), which charges another
  // through a resistor.
  table.push_back({"loop of a source and a capacitor",
                   {flat(2, 1, 3,
                         [](V x, V v, V z, T t) {
                           return equations({x[0] / 0.5 - sin(2 * t), v[1] - (x[0] - x[1]) / 0.8,
                                             z[0] - v[0] - v[1]});
                         }),
                    {.t = 0.3, .x = Eigen::Vector2d(0.4, 0.2)}},
                   {{2, 1}, {1, 1}, {1, 1}},
                   Verdict::regular,
                   1});
  // Closed port-Hamiltonian system x' = J∇H + B u, Bᵀ∇H = 0 (Remark 7.2): u from the derivative.
  table.push_back({"closed port-Hamiltonian system",
                   {closed_port_hamiltonian(), at({0.3, 0.4, 0.2, 0.1})},
                   {{4, 3}, {3, 3}, {3, 3}},
                   Verdict::regular,
                   1});
  // v' = -v + Bᵀp, B v = 0 with the constants in the kernel of Bᵀ: p up to a constant.
  table.push_back({"Stokes flow on a loop",
                   {flat(4, 3, 7,
                         [](V x, V v, V z, T t) {
                           Eigen::MatrixXd B(3, 4);
                           B << 1, -1, 0, 0.5, 0, 1, -1, 0.5, -1, 0, 1, -1;
                           ExprVector F(7);
                           F.head(4) = v + x - constants(MatrixXd(B.transpose())) * z;
                           F[3] -= sin(t);
                           F.tail(3) = constants(B) * x;
                           return F;
                         }),
                    at({0.3, 0.2, 0.1, 0.4})},
                   {{4, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   1,
                   1});
}

void optimal_control(std::vector<KnownLadder>& table) {
  // min ∫ ½ (q² + u²), q' = u: u = p.
  table.push_back({"regular control",
                   {flat(2, 1, 3,
                         [](V x, V v, V z, T) {
                           return equations({v[0] - z[0], v[1] - x[0], x[1] - z[0]});
                         }),
                    at({0.3, 0.4})},
                   {{2, 2}, {2, 2}},
                   Verdict::regular,
                   0});
  // min ∫ ½ q², q' = u: p = 0, p' = q = 0, u = 0.
  table.push_back({"singular arc that is a point",
                   {flat(2, 1, 3,
                         [](V x, V v, V z, T) {
                           return equations({v[0] - z[0], v[1] - x[0], x[1]});
                         }),
                    at({0.3, 0.4})},
                   falling(2, 1, 2),
                   Verdict::regular,
                   2});
  // min ∫ ½ (x² + y²), x' = y, y' = u: p_y = 0, p_x = y, u = x.
  table.push_back(
      {"singular arc of order one",
       {flat(4, 1, 5,
             [](V x, V v, V z, T) {
               return equations({v[0] - x[1], v[1] - z[0], v[2] - x[0], v[3] + x[2] - x[1], x[3]});
             }),
        at({0.3, 0.4, 0.1, 0.2})},
       falling(4, 3, 2),
       Verdict::regular,
       2});
  // min ∫ ½ x², x' = y, y' = u: p_y = 0, p_x = 0, x = 0, y = 0, u = 0.
  table.push_back(
      {"singular arc of order two",
       {flat(4, 1, 5,
             [](V x, V v, V z, T) {
               return equations({v[0] - x[1], v[1] - z[0], v[2] - x[0], v[3] + x[2], x[3]});
             }),
        at({0.3, 0.4, 0.1, 0.2})},
       falling(4, 3, 4),
       Verdict::regular,
       4});
}

void on_manifolds(std::vector<KnownLadder>& table) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  // x' = a × x: a vector field; of its three equations two are independent.
  table.push_back({"rotation of S²",
                   {std::make_shared<FormulaSystem>(sphere, 0, 3,
                                                    [](V x, V v, V, T) {
                                                      return equations(
                                                          {v[0] - 0.3 * x[2] + 1.1 * x[1],
                                                           v[1] - 1.1 * x[0] + 0.2 * x[2],
                                                           v[2] - 0.2 * x[1] + 0.3 * x[0]});
                                                    }),
                    at({0.6, 0.0, 0.8})},
                   {{2, 2}, {2, 2}},
                   Verdict::regular,
                   0,
                   1});
  // x' = a × x + λ (e_3 - x_3 x), x_3 = c: a circle of latitude, λ from the derivative.
  table.push_back({"constraint on S²",
                   {std::make_shared<FormulaSystem>(
                        sphere, 1, 4,
                        [](V x, V v, V z, T) {
                          return equations(
                              {v[0] - 0.3 * x[2] + 1.1 * x[1] + z[0] * x[2] * x[0],
                               v[1] - 1.1 * x[0] + 0.2 * x[2] + z[0] * x[2] * x[1],
                               v[2] - 0.2 * x[1] + 0.3 * x[0] - z[0] * (1 - square(x[2])),
                               x[2] - 0.5});
                        }),
                    at({0.6, 0.0, 0.8})},
                   {{2, 1}, {1, 1}, {1, 1}},
                   Verdict::regular,
                   1,
                   1});
  // Ω = (0.2, z, 0.1) with the third component of R e_1 fixed.
  table.push_back({"constraint on SO(3)",
                   {std::make_shared<FormulaSystem>(
                        rotations, 1, 4,
                        [](V x, V v, V z, T) {
                          return equations({v[0] - 0.2, v[1] - z[0], v[2] - 0.1, x[6] - 0.3});
                        }),
                    at({0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8})},
                   {{3, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   1});
  // Suslov's problem: Π' = Π × Ω + λ a, ⟨a, Ω⟩ = 0, on SO(3) × R³.
  table.push_back({"Suslov's problem",
                   {std::make_shared<FormulaSystem>(
                        std::make_shared<Product>(
                            std::vector<std::shared_ptr<const Manifold>>{rotations, space(3)}),
                        1, 7,
                        [](V x, V v, V z, T) {
                          const ExprVector P = x.tail(3);
                          ExprVector W(3), F(7);
                          W << P[0] + 0.2 * P[2], P[1] / 2.0, P[2] / 3.0 + 0.2 * P[0];
                          F.head(3) = v.head(3) - W;
                          F[3] = v[3] - P[1] * W[2] + P[2] * W[1];
                          F[4] = v[4] - P[2] * W[0] + P[0] * W[2];
                          F[5] = v[5] - P[0] * W[1] + P[1] * W[0] - z[0];
                          F[6] = W[2];
                          return F;
                        }),
                    at({0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8, 0.5, 0.4, 0.1})},
                   {{6, 5}, {5, 5}, {5, 5}},
                   Verdict::regular,
                   1});
  // H = ½|p|² + x_3 on T*S²: canonical, regular.
  const auto phase_space = std::make_shared<CotangentBundle>(sphere);
  table.push_back(
      {"spherical pendulum on T*S²",
       {std::make_shared<DiracSystem>(
            std::make_shared<CanonicalSymplectic>(phase_space),
            std::make_shared<Hamiltonian>(
                phase_space, [](V x, T) { return 0.5 * x.tail(3).squaredNorm() + x[2]; })),
        at({0.6, 0.0, -0.8, 0.4, 0.5, 0.3})},
       {{4, 4}, {4, 4}},
       Verdict::regular,
       0,
       2});
}

void without_answers(std::vector<KnownLadder>& table) {
  // No point at all.
  table.push_back({"x = 0 and x = 1",
                   {flat(1, 0, 3,
                         [](V x, V v, V, T) {
                           return equations({v[0] - 1, x[0], x[0] - 1});
                         }),
                    at({0.3})},
                   {{-1, -1}},
                   Verdict::inconsistent,
                   -1});
  // x = 2 is a point, and x' = 0 ≠ 1 a contradiction.
  table.push_back({"constraint violated when it is differentiated",
                   {flat(1, 0, 2,
                         [](V x, V v, V, T) {
                           return equations({v[0] - 1, x[0] - 2});
                         }),
                    at({0.3})},
                   {{0, 0}, {-1, -1}},
                   Verdict::inconsistent,
                   -1});
  // L = q' + q: p = 1 and p' = 1.
  table.push_back({"L = q' + q",
                   {lagrangian(1, [](V q, V w, T) { return w[0] + q[0]; }), at({0.3, 0.2})},
                   {{2, 1}, {-1, -1}},
                   Verdict::inconsistent,
                   -1});
  // x = 0, y = x' = 0, 1 = y' = 0.
  table.push_back({"contradiction of the second derivative",
                   {flat(2, 0, 3,
                         [](V x, V v, V, T) {
                           return equations({v[0] - x[1], v[1] - 1, x[0]});
                         }),
                    at({0.1, 0.1})},
                   {{1, 1}, {0, 0}, {-1, -1}},
                   Verdict::inconsistent,
                   -1});
  // x' = y and nothing on y.
  table.push_back(
      {"one equation for two unknowns",
       {flat(2, 0, 1, [](V x, V v, V, T) { return equations({v[0] - x[1]}); }), at({0.3, 0.2})},
       {{3, 2}, {3, 2}},
       Verdict::gauge,
       0});
  // A control that nothing determines: the fibre is its line.
  table.push_back({"free control",
                   {flat(3, 1, 3,
                         [](V x, V v, V z, T) {
                           return equations({v[0] - x[1], v[1] - z[0] * cos(x[0]),
                                             v[2] - z[0] * (1 + square(x[0])) + x[2]});
                         }),
                    at({0.3, 0.2, 0.1})},
                   {{4, 3}, {4, 3}},
                   Verdict::gauge,
                   0});
  // x x' = x² at 0: rank 0 there, 1 elsewhere.
  table.push_back(
      {"x x' = x² at the origin",
       {flat(1, 0, 1, [](V x, V v, V, T) { return equations({x[0] * v[0] - square(x[0])}); }),
        at({0.0})},
       {},
       Verdict::rank_change,
       -1});
}

}  // namespace

Dimensions dimensions(const ConstraintLadder& ladder) {
  Dimensions result;
  for (const LadderLevel& level : ladder.levels) result.emplace_back(level.dim_S, level.dim_M);
  return result;
}

SystemPointer lagrangian(Index n, Lagrangian::Formula L, ImplicitSystem::Names names) {
  const auto phase_space = std::make_shared<CotangentBundle>(space(n));
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                       std::make_shared<Lagrangian>(phase_space, std::move(L)),
                                       std::move(names));
}

SystemPointer flat(Index n, Index m, Index equation_count, FormulaSystem::Formula formula,
                   ImplicitSystem::Names names) {
  return std::make_shared<FormulaSystem>(space(n), m, equation_count, std::move(formula),
                                         std::move(names));
}

InitialGuess at(std::initializer_list<double> x) {
  InitialGuess guess;
  guess.x = Eigen::Map<const VectorXd>(x.begin(), static_cast<Index>(x.size()));
  return guess;
}

// L = ⟨α(q), q'⟩ - H(q), strengths Γ (Section 6 of the paper).
SystemPointer vortices() {
  const Eigen::Vector4d strength(1, 1, -1, -1);
  return lagrangian(8, [strength](V q, V w, T) {
    Expr kinetic = 0.0, H = 0.0;
    for (Index j = 0; j < 4; ++j) {
      kinetic += 0.5 * strength[j] * (q[j] * w[4 + j] - q[4 + j] * w[j]);
      for (Index k = 0; k < j; ++k)
        H += strength[j] * strength[k] / (4 * std::numbers::pi) *
             log(square(q[j] - q[k]) + square(q[4 + j] - q[4 + k]));
    }
    return kinetic - H;
  });
}

InitialGuess vortex_guess() {
  return {.x = (VectorXd(16) << -1, 1, -1, 1, 2, 2, -2, -2, VectorXd::Zero(8)).finished()};
}

SystemPointer closed_port_hamiltonian() {
  const auto M = std::make_shared<Euclidean>(4);
  const auto J = [](V) {
    ExprMatrix matrix = ExprMatrix::Zero(4, 4);
    matrix(0, 2) = matrix(1, 3) = 1.0;
    matrix(2, 0) = matrix(3, 1) = -1.0;
    return matrix;
  };
  const auto B = [](V) {
    ExprMatrix column = ExprMatrix::Zero(4, 1);
    column(1, 0) = 0.5;
    column(3, 0) = 1.0;
    return column;
  };
  const auto H = [](V x, T) {
    return (square(x[2]) + square(x[3])) / 2.0 + square(x[0]) / 2.0 + square(square(x[0])) / 4.0 +
           square(x[1]);
  };
  return std::make_shared<DiracSystem>(std::make_shared<ClosedPortHamiltonian>(M, J, 1, B),
                                       std::make_shared<Hamiltonian>(M, H));
}

SystemPointer cartesian_pendulum() {
  return flat(
      4, 1, 5,
      [](V x, V v, V z, T) {
        return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 9.81,
                          square(x[0]) + square(x[1]) - 1});
      },
      {{"x", "y", "p_x", "p_y"}, {"lambda"}, {"x' = p_x", "y' = p_y", "p_x'", "p_y'", "length"}});
}

std::vector<KnownLadder> errata() {
  return {
      {"four vortices",
       {vortices(), vortex_guess()},
       {{16, 8}, {8, 8}, {8, 8}},
       Verdict::regular,
       1},
      {"Cartesian pendulum",
       {cartesian_pendulum(), at({0.6, -0.9, 0.1, 0.3})},
       {{4, 3}, {3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       2},
      // x' = p, p' = -∇V + λ (-y, 0, 1), z' = y x'
      {"nonholonomic particle",
       {flat(6, 1, 7,
             [](V x, V v, V z, T) {
               return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + x[0] + z[0] * x[1],
                                 v[4] + x[1], v[5] - z[0], x[5] - x[1] * x[3]});
             }),
        at({0.3, 0.7, 0.2, 1.0, 0.4, 0.5})},
       {{6, 5}, {5, 5}, {5, 5}},
       Verdict::regular,
       1},
      // Charges of two capacitors in parallel, flux of an inductor; z: currents of the capacitors.
      {"parallel capacitors",
       {flat(3, 2, 5,
             [](V x, V v, V z, T) {
               return equations({v[0] - z[0], v[1] - z[1], z[0] + z[1] + x[2] / 3.0,
                                 x[0] / 2.0 - x[1], v[2] - x[0] / 2.0});
             }),
        at({1.0, 0.3, 0.2})},
       {{3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       1},
      // L = ½ (r'² + r² (θ' - a)²) - V(r).
      {"Christ-Lee",
       {lagrangian(3,
                   [](V q, V w, T) {
                     return 0.5 * (square(w[0]) + square(q[0]) * square(w[1] - q[2])) -
                            0.5 * square(q[0]);
                   }),
        at({1.2, 0.4, 0.3, 0.2, 0.5, 0.1})},
       {{6, 5}, {5, 4}, {5, 4}},
       Verdict::gauge,
       1},
  };
}

std::vector<KnownLadder> catalogue() {
  std::vector<KnownLadder> table = errata();
  ordinary(table);
  singular_lagrangians(table);
  mechanics(table);
  ports_and_circuits(table);
  optimal_control(table);
  on_manifolds(table);
  without_answers(table);
  return table;
}

}  // namespace courant::examples
