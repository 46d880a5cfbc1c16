#include "courant/systems/point_vortices.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "courant/core/derivative.hpp"
#include "courant/systems/experiment.hpp"

namespace courant {
namespace {

VectorXd random(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

// Equation (6) of the paper.
VectorXd velocities(const VectorXd& strengths, const VectorXd& q) {
  const Index n = strengths.size();
  VectorXd v = VectorXd::Zero(2 * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i == j) continue;
      const double dx = q[i] - q[j], dy = q[n + i] - q[n + j];
      v[i] -= strengths[j] * dy / (dx * dx + dy * dy) / (2.0 * std::numbers::pi);
      v[n + i] += strengths[j] * dx / (dx * dx + dy * dy) / (2.0 * std::numbers::pi);
    }
  return v;
}

const char* in_formulas = R"json({
  "system": {
    "type": "lagrangian",
    "parameters": { "n": 3, "Gamma": [1.5, -0.5, 2] },
    "coordinates": ["x[n]", "y[n]"],
    "lagrangian": "sum(i, 0, n-1, Gamma[i]*(x[i]*y[i]' - y[i]*x[i]'))/2 - sum(i, 0, n-2, sum(j, i+1, n-1, Gamma[i]*Gamma[j]*log((x[i]-x[j])^2 + (y[i]-y[j])^2)))/(4*pi)"
  },
  "initial": { "x": [0, 1, 2], "y": [0, 1, 3] }
})json";

}  // namespace

BOOST_AUTO_TEST_SUITE(point_vortices)

// The value in the errata: each pair of vortices once.
BOOST_AUTO_TEST_CASE(energy_of_the_four_vortices_of_the_paper) {
  const PointVortices vortices((VectorXd(4) << 1, 1, -1, -1).finished());
  const VectorXd q = (VectorXd(8) << -1, 1, -1, 1, 2, 2, -2, -2).finished();
  BOOST_TEST(vortices.hamiltonian(constants(q)).value() == -0.697421199668691,
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(both_forms_move_by_equation_6) {
  std::mt19937 generator(3);
  const VectorXd strengths = (VectorXd(3) << 1.5, -0.5, 2.0).finished();
  const PointVortices vortices(strengths);
  const auto hamiltonian = vortices.hamiltonian_form(), lagrangian = vortices.lagrangian_form();
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd q = random(6, generator);
    const VectorXd v = velocities(strengths, q);
    BOOST_TEST(hamiltonian->residual(q, v, VectorXd(0), 0.0).norm() < 1e-13 * (1.0 + v.norm()));
    BOOST_TEST(hamiltonian->residual(q, v + random(6, generator), VectorXd(0), 0.0).norm() > 1e-3);
    // On T*Q: p = α(q), and ṗ = α(q̇) since α is linear.
    VectorXd x(12), w(12);
    x << q, values(vortices.alpha(constants(q)));
    w << v, values(vortices.alpha(constants(v)));
    BOOST_TEST(lagrangian->residual(x, w, v, 0.0).norm() < 1e-13 * (1.0 + v.norm()));
    x[7] += 1e-3;
    BOOST_TEST(lagrangian->residual(x, w, v, 0.0).norm() > 1e-4);
  }
}

// Written as a formula in an experiment it is the same system.
BOOST_AUTO_TEST_CASE(the_catalogue_and_the_formulas_agree) {
  std::mt19937 generator(4);
  const auto formulas = read_experiment(in_formulas).model.system;
  const auto catalogue =
      PointVortices((VectorXd(3) << 1.5, -0.5, 2.0).finished()).lagrangian_form();
  BOOST_TEST(formulas->names().coordinates == catalogue->names().coordinates);
  BOOST_TEST(formulas->names().equations == catalogue->names().equations);
  for (int trial = 0; trial < 20; ++trial) {
    const VectorXd x = random(12, generator), v = random(12, generator), z = random(6, generator);
    const VectorXd a = formulas->residual(x, v, z, 0.0), b = catalogue->residual(x, v, z, 0.0);
    BOOST_TEST((a - b).norm() < 1e-12 * (1.0 + b.norm()));
  }
}

BOOST_AUTO_TEST_CASE(finds_coinciding_vortices) {
  const PointVortices vortices((VectorXd(3) << 1, 1, 1).finished());
  BOOST_TEST(!vortices.coinciding((VectorXd(6) << 0, 1, 0, 0, 0, 1).finished()));
  const auto pair = vortices.coinciding((VectorXd(6) << 0, 1, 1, 0, 2, 2).finished());
  BOOST_REQUIRE(pair.has_value());
  BOOST_TEST(pair->first == 1);
  BOOST_TEST(pair->second == 2);
}

BOOST_AUTO_TEST_CASE(refuses_strengths_that_are_zero) {
  BOOST_CHECK_THROW(PointVortices((VectorXd(2) << 1, 0).finished()), std::invalid_argument);
  BOOST_CHECK_THROW(PointVortices((VectorXd(1) << NAN).finished()), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
