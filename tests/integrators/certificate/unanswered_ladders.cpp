// Systems that contradict themselves, leave something open or are singular, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
