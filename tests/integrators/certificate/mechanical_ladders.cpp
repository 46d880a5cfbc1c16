// Mechanical systems with constraints, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
