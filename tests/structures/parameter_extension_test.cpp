#include "courant/structures/parameter_extension.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * the rates of the parameters stand among the equations of a tangent block
//  * the extended energy has no slope by the parameters
//  * the parameters are those of the values that the extension was made with
BOOST_AUTO_TEST_SUITE(parameter_extension)

using namespace courant;

namespace {

constexpr double kMass = 0.7, kStiffness = 3.0;

// H = p²/(2m) + k q⁴/4 on T*R.
std::shared_ptr<const ImplicitSystem> quartic() {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(bundle, [](const ExprVector& x, const Expr&) {
        return x[1] * x[1] / (2.0 * Parameter{"m", kMass}.at(x)) +
               Parameter{"k", kStiffness}.at(x) * pow(x[0], 4) / 4.0;
      }));
}

VectorXd vector(std::initializer_list<double> entries) {
  return Eigen::Map<const VectorXd>(entries.begin(), static_cast<Index>(entries.size()));
}

}  // namespace

// q' - p/m, p' + k q³, m', k' at other values of m and k than those of the system.
BOOST_AUTO_TEST_CASE(equations_are_those_at_the_parameters_of_the_point) {
  const ParameterExtension with(quartic(), {{"m", kMass}, {"k", kStiffness}});
  const double q = 1.1, p = -0.4, m = 2.0, k = 5.0;
  const VectorXd F = with.extended()->residual(vector({q, p, m, k}), vector({0.3, 0.2, 0.01, 0.02}),
                                               VectorXd(), 0.0);
  VectorXd sorted = F.cwiseAbs();
  std::sort(sorted.begin(), sorted.end());
  VectorXd expected = vector({std::abs(0.3 - p / m), std::abs(0.2 + k * q * q * q), 0.01, 0.02});
  std::sort(expected.begin(), expected.end());
  BOOST_TEST((sorted - expected).norm() < 1e-14);
  // The system itself is as it was.
  const VectorXd own = with.system()->residual(vector({q, p}), vector({0.3, 0.2}), VectorXd(), 0.0);
  BOOST_TEST(std::abs(own.cwiseAbs().maxCoeff() - (0.2 + kStiffness * q * q * q)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_extended_energy_has_slopes_by_its_parameters) {
  const ParameterExtension with(quartic(), {{"m", kMass}, {"k", kStiffness}});
  const auto energy = std::dynamic_pointer_cast<const EnergySystem>(with.extended());
  BOOST_REQUIRE(energy);
  const double q = 1.1, p = -0.4, m = 2.0, k = 5.0;
  const VectorXd alpha =
      values(energy->effort(constants(vector({q, p, m, k})), ExprVector(0), Expr(0.0)));
  const VectorXd expected =
      vector({k * q * q * q, p / m, -p * p / (2.0 * m * m), q * q * q * q / 4.0});
  BOOST_TEST((alpha - expected).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(states_go_there_and_back) {
  const ParameterExtension with(quartic(), {{"k", kStiffness}});
  const State own{.t = 2.0, .x = vector({1, 2}), .v = vector({3, 4})};
  const State all = with.to_extended(own);
  BOOST_TEST((all.x == vector({1, 2, kStiffness})));
  BOOST_TEST((all.v == vector({3, 4, 0})));
  BOOST_TEST((with.from_extended(all) == own));
}

BOOST_AUTO_TEST_CASE(what_makes_no_extension_is_refused) {
  BOOST_CHECK_THROW(ParameterExtension(nullptr, {{"k", 1.0}}), std::invalid_argument);
  BOOST_CHECK_THROW(ParameterExtension(quartic(), {}), std::invalid_argument);
  BOOST_CHECK_THROW(ParameterExtension(quartic(), {{"k", 1.0}, {"k", 2.0}}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
