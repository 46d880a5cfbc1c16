// Singular Lagrangians, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
