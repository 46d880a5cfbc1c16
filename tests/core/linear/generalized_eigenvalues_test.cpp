#include "courant/core/linear/generalized_eigenvalues.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
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

// Eigenvalues do not depend on the units of rows and columns, in which QZ alone may not converge: a ladder of inductors and
// capacitors in SI units is such a pencil.
BOOST_AUTO_TEST_CASE(do_not_depend_on_units) {
  const Eigen::Index n = 10;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n), B = A;
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, i) = -1.0 - static_cast<double>(i);
    if (i > 0) A(i, i - 1) = 0.5;
    if (i % 3 != 2) B(i, i) = 1.0;
  }
  for (int k = 1; k <= 20; ++k) {
    Eigen::MatrixXd P = A, Q = B;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double row = std::pow(10.0, (7 * i * k) % 13 - 6),
                   column = std::pow(10.0, (5 * i * k) % 19 - 9);
      P.row(i) *= row, Q.row(i) *= row;
      P.col(i) *= column, Q.col(i) *= column;
    }
    const auto [alphas, betas] = generalized_eigenvalues(P, Q);
    std::vector<double> finite;
    for (Eigen::Index i = 0; i < n; ++i)
      if (std::abs(betas[i]) > 1e-13 * std::abs(alphas[i]))
        finite.push_back(-(alphas[i] / betas[i]).real());
    std::ranges::sort(finite);
    BOOST_TEST_REQUIRE(finite.size() == 7u);
    const std::vector<double> known = {1, 2, 4, 5, 7, 8, 10};
    for (std::size_t i = 0; i < known.size(); ++i)
      BOOST_TEST(std::abs(finite[i] - known[i]) < 1e-11);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
