// Ordinary and algebraic equations in Hessenberg form, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
