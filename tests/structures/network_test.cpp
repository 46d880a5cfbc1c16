#include "courant/structures/network.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

namespace courant {
// Mistakes that these cases have to notice:
//  * corners of equations are not named (running/undefined_formula.cpp)
BOOST_AUTO_TEST_SUITE(network_test)

namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

NetworkBranch::Law resistance(Index branch, double value) {
  return [=](const NetworkVariables& variables) { return value * variables.current(branch); };
}

// A source of 3 t volts, 5 Ω, 0.5 F and 2 H, all one after the other: nodes 0 (ground), a, b, c.
Network series() {
  return Network(4,
                 {{.name = "V",
                   .from = 1,
                   .to = 0,
                   .role = Role::source,
                   .law = [](const NetworkVariables& variables) { return 3.0 * variables.t(); }},
                  {.name = "R", .from = 1, .to = 2, .law = resistance(1, 5.0)},
                  {.name = "C", .from = 2, .to = 3, .kind = Kind::charge, .role = Role::storage},
                  {.name = "L", .from = 0, .to = 3, .kind = Kind::flux, .role = Role::storage}},
                 [](const ExprVector& x, const Expr&) {
                   return square(x[0]) / (2.0 * 0.5) + square(x[1]) / (2.0 * 2.0);
                 });
}

ExprVector exprs(const VectorXd& x) { return constants(x); }

}  // namespace

// A current i from the source by R and C to L, which is against its direction: q' = i, phi/2 = -i,
// 3 t = 5 i + q/0.5 - phi'.
BOOST_AUTO_TEST_CASE(a_series_circuit) {
  const Network circuit = series();
  BOOST_TEST((circuit.names().coordinates == std::vector<std::string>{"q_C", "phi_L"}));
  BOOST_TEST((circuit.names().auxiliary == std::vector<std::string>{"i_V", "i_R"}));
  BOOST_TEST(circuit.equation_count() == 4);
  const double i = 0.7, q = 0.4, t = 1.1, rate = 5.0 * i + q / 0.5 - 3.0 * t;
  const VectorXd x = VectorXd{{q, -2.0 * i}}, v = VectorXd{{i, rate}}, z = VectorXd{{-i, i}};
  BOOST_TEST(circuit.residual(x, v, z, t).norm() < 1e-14);
  for (Index k = 0; k < 2; ++k) {
    BOOST_TEST(circuit.residual(x + VectorXd::Unit(2, k), v, z, t).norm() > 0.4);
    BOOST_TEST(circuit.residual(x, v + VectorXd::Unit(2, k), z, t).norm() > 0.4);
    BOOST_TEST(circuit.residual(x, v, z + VectorXd::Unit(2, k), t).norm() > 0.4);
  }
  BOOST_TEST(circuit.residual(x, v, z, t + 1.0).norm() > 0.4);

  const Network::Ports ports = circuit.ports(
      exprs(x), exprs(v), circuit.effort(exprs(x), exprs(z), Expr(t)), exprs(z), Expr(t));
  const VectorXd current = values(ports.current), voltage = values(ports.voltage);
  BOOST_TEST((current - VectorXd{{-i, i, i, -i}}).norm() < 1e-14);
  BOOST_TEST((voltage - VectorXd{{3.0 * t, 5.0 * i, q / 0.5, rate}}).norm() < 1e-14);
  const VectorXd potential = values(circuit.potentials(ports.voltage));
  BOOST_TEST((potential - VectorXd{{0.0, 3.0 * t, 3.0 * t - 5.0 * i, -rate}}).norm() < 1e-14);
  // dH/dt = supplied - dissipated.
  const double supplied = circuit.supplied_power(ports).value();
  const double dissipated = circuit.dissipated_power(ports).value();
  BOOST_TEST(std::abs(supplied - 3.0 * t * i) < 1e-14);
  BOOST_TEST(std::abs(dissipated - 5.0 * i * i) < 1e-14);
  const double rate_of_energy = q / 0.5 * v[0] + x[1] / 2.0 * v[1];
  BOOST_TEST(std::abs(rate_of_energy - (supplied - dissipated)) < 1e-13);
}

// Equations say which currents and voltages they are about: the cut-set of the inductor, the loop
// of what is not in the tree.
BOOST_AUTO_TEST_CASE(equations_have_names) {
  const Network circuit = series();
  const auto& equations = circuit.names().equations;
  const auto has = [&](const std::string& text) {
    return std::find(equations.begin(), equations.end(), text) != equations.end();
  };
  BOOST_TEST(has("i_V = i_L"));
  BOOST_TEST(has("i_R = -i_L"));
  BOOST_TEST(has("i_C = -i_L"));
  BOOST_TEST(has("v_L = -v_V + v_R + v_C"));
}

// Three capacitors in a triangle, and an inductor alone at the end of another.
BOOST_AUTO_TEST_CASE(loops_of_charges_and_cut_sets_of_fluxes) {
  const auto energy = [](const ExprVector& x, const Expr&) { return x.squaredNorm(); };
  const auto charge = [](Index a, Index b) {
    return NetworkBranch{.name = "C", .from = a, .to = b, .kind = Kind::charge};
  };
  const auto flux = [](Index a, Index b) {
    return NetworkBranch{.name = "L", .from = a, .to = b, .kind = Kind::flux};
  };
  const Network network(
      5, {flux(2, 3), charge(0, 1), charge(1, 2), charge(2, 0), flux(3, 4), flux(4, 0)}, energy);
  BOOST_TEST(network.charge_loop_count() == 1);
  BOOST_TEST(network.flux_cut_set_count() == 2);
}

// A law may use what another law gives, in whatever order; never its own result.
BOOST_AUTO_TEST_CASE(laws_of_laws) {
  const auto twice = [](Index other) {
    return [=](const NetworkVariables& variables) { return 2.0 * variables.voltage(other); };
  };
  const auto energy = [](const ExprVector& x, const Expr&) { return x.squaredNorm(); };
  const auto chain = [&](Index last) {
    return Network(4,
                   {{.name = "A", .from = 1, .to = 0, .law = twice(1)},
                    {.name = "B", .from = 2, .to = 0, .law = twice(last)},
                    {.name = "C", .from = 3, .to = 0, .kind = Kind::charge},
                    {.name = "R", .from = 1, .to = 3, .law = resistance(3, 1.0)},
                    {.name = "S", .from = 2, .to = 3, .law = resistance(4, 1.0)}},
                   energy);
  };
  const Network network = chain(2);
  const VectorXd one = VectorXd::Ones(1);
  const Network::Ports ports =
      network.ports(exprs(one), exprs(one), network.effort(exprs(one), ExprVector(4), Expr(0.0)),
                    exprs(VectorXd::Ones(4)), Expr(0.0));
  BOOST_TEST(ports.voltage[0].value() == 8.0);  // 2 · 2 · ∂H/∂q
  BOOST_CHECK_EXCEPTION(chain(0), std::invalid_argument, [](const std::invalid_argument& error) {
    return std::string(error.what()).find("in a circle") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(wrong_branches_are_refused) {
  const auto energy = [](const ExprVector&, const Expr&) { return Expr(0.0); };
  BOOST_CHECK_THROW(
      Network(2, {{.name = "R", .from = 0, .to = 2, .law = resistance(0, 1.0)}}, energy),
      std::invalid_argument);
  BOOST_CHECK_THROW(Network(2, {{.name = "R", .from = 0, .to = 1}}, energy), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
