#include "courant/core/linear/generalized_eigenvalues.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <complex>
#include <vector>

namespace courant {
BOOST_AUTO_TEST_SUITE(generalized_eigenvalues_test)

// y' = 2 z, y + 3 z = 0 with the unknown z: λ = -2/3, and an infinite one.
BOOST_AUTO_TEST_CASE(of_equations_with_an_unknown) {
  Eigen::MatrixXd A(2, 2), B(2, 2);
  A << 0, 2, 1, 3;
  B << 1, 0, 0, 0;
  const auto [alphas, betas] = generalized_eigenvalues(A, B);
  std::vector<std::complex<double>> finite;
  int infinite = 0;
  for (Eigen::Index i = 0; i < 2; ++i)
    if (std::abs(betas[i]) > 1e-15 * std::abs(alphas[i]))
      finite.push_back(alphas[i] / betas[i]);
    else
      ++infinite;
  BOOST_TEST(infinite == 1);
  BOOST_TEST_REQUIRE(finite.size() == 1u);
  BOOST_TEST(std::abs(finite[0] + 2.0 / 3.0) < 1e-15);
}

BOOST_AUTO_TEST_CASE(of_a_rotation_and_of_nothing) {
  Eigen::MatrixXd J(2, 2);
  J << 0, -1, 1, 0;
  const auto [alphas, betas] = generalized_eigenvalues(J, 2.0 * Eigen::MatrixXd::Identity(2, 2));
  const double first = (alphas[0] / betas[0]).imag(), second = (alphas[1] / betas[1]).imag();
  BOOST_TEST(std::abs(std::max(first, second) - 0.5) < 1e-15);
  BOOST_TEST(std::abs(std::min(first, second) + 0.5) < 1e-15);
  const Eigen::MatrixXd none(0, 0), other(1, 1);
  BOOST_TEST(generalized_eigenvalues(none, none).betas.size() == 0);
  BOOST_CHECK_THROW(generalized_eigenvalues(J, other), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
