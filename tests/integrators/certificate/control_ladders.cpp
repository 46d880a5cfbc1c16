// Conditions of optimal control, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
