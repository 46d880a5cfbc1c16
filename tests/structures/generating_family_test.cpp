#include "courant/structures/generating_family.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/euclidean.hpp"

BOOST_AUTO_TEST_SUITE(generating_family)

using namespace courant;

BOOST_AUTO_TEST_CASE(morse_family) {
  // L = ½ m w² e^{q} - k q²: 𝓛 = {(-∂_qL, w) : p = ∂_wL} with P_q = -∂L/∂q (docs/errata.md).
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const Lagrangian family(M, [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return 0.5 * 1.3 * square(w[0]) * exp(q[0]) - 0.6 * square(q[0]);
  });
  const double q = 0.3, p = 0.7, w = -0.4;
  const ExprVector x = constants((VectorXd(2) << q, p).finished());
  const ExprVector lambda = constants(VectorXd::Constant(1, w));
  const VectorXd differential = values(family.differential(x, lambda, 0.0));
  BOOST_TEST(differential[0] == -(0.65 * w * w * std::exp(q) - 1.2 * q),
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(differential[1] == w);
  BOOST_TEST(values(family.stationarity(x, lambda, 0.0))[0] == p - 1.3 * w * std::exp(q),
             boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(energy_of_a_degenerate_lagrangian_is_its_hamiltonian) {
  // L = ⟨α(q), w⟩ - H(q): E_L = H(q) for every w and p, on and off M_0.
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto H = [](const ExprVector& q) { return square(q[0]) + 0.3 * square(square(q[1])); };
  const Lagrangian family(M, [&H](const ExprVector& q, const ExprVector& w, const Expr&) {
    return q[0] * w[1] - H(q);
  });
  const VectorXd x = (VectorXd(4) << 0.2, -0.8, 5.0, 6.0).finished();
  const VectorXd w = (VectorXd(2) << 3.0, -2.0).finished();
  BOOST_TEST(family.energy(constants(x), constants(w), 0.0).value() == H(constants(x)).value(),
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(wrong_sizes_are_refused) {
  const Hamiltonian family(std::make_shared<Euclidean>(2),
                           [](const ExprVector& x, const Expr&) { return x[0]; });
  BOOST_CHECK_THROW(family.value(ExprVector::Zero(3), ExprVector(0), 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
