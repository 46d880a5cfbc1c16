#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/reading/experiment.hpp"
#include "courant/systems/point_vortices.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(read_point_vortices_test)

namespace {

VectorXd random(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
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

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
