#include "courant/core/expressions/linear_map.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

namespace courant {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index cols, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(generator); });
}

BOOST_AUTO_TEST_SUITE(linear_map)

BOOST_AUTO_TEST_CASE(products_are_those_of_the_matrices) {
  std::mt19937 generator(1);
  const MatrixXd full = random_matrix(4, 4, generator), tall = random_matrix(4, 3, generator);
  const VectorXd x = random_matrix(4, 1, generator);
  const LinearMap<double> A = full, B = tall, one = LinearMap<double>::identity(4);
  BOOST_TEST((A * x).isApprox(full * x, 1e-15));
  BOOST_TEST((B.transpose() * x).isApprox(tall.transpose() * x, 1e-15));
  BOOST_TEST((one * x == x));
  BOOST_TEST((one.transpose() * tall == tall));
  BOOST_TEST((x.transpose() * A).isApprox(x.transpose() * full, 1e-15));
  BOOST_TEST((x.transpose() * one == x.transpose()));
  BOOST_TEST((A * B).matrix().isApprox(full * tall, 1e-15));
  BOOST_TEST(((A * one).matrix() == full));
  BOOST_TEST(((one * B).matrix() == tall));
}

BOOST_AUTO_TEST_CASE(the_identity_has_its_entries_and_stores_none) {
  const auto one = LinearMap<double>::identity(3);
  BOOST_TEST(one.is_identity());
  BOOST_TEST(one.entries().size() == 0);
  BOOST_TEST(one.rows() == 3);
  BOOST_TEST(one.cols() == 3);
  BOOST_TEST(one(1, 1) == 1.0);
  BOOST_TEST(one(1, 2) == 0.0);
  const MatrixXd entries = one;
  BOOST_TEST((entries == MatrixXd::Identity(3, 3)));
  // The identity on 10⁶ numbers would be 8 TB.
  const VectorXd x = VectorXd::LinSpaced(1000000, 0.0, 1.0);
  BOOST_TEST((LinearMap<double>::identity(x.size()) * x == x));
}

BOOST_AUTO_TEST_CASE(the_identity_stays_one_among_numbers_and_expressions) {
  const auto one = LinearMap<double>::identity(2);
  BOOST_TEST(constants(one).is_identity());
  BOOST_TEST(values(constants(one)).is_identity());
  BOOST_TEST(absolute(one).is_identity());
  BOOST_TEST(one.transpose().is_identity());
  BOOST_TEST((one * one).is_identity());
  const MatrixXd turn = (MatrixXd(2, 2) << 0.0, -1.0, 1.0, 0.0).finished();
  const LinearMap<double> R = turn;
  BOOST_TEST(!R.is_identity());
  BOOST_TEST((values(constants(R)).matrix() == turn));
  BOOST_TEST((absolute(R).matrix() == turn.cwiseAbs()));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
