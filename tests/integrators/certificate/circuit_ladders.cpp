// Ports and circuits, with their ladders.
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

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

}  // namespace courant::examples
