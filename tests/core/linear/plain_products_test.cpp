#include "courant/core/linear/plain_products.hpp"

#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * the last of the columns is taken for the longest
//  * products leave out their first terms
BOOST_AUTO_TEST_SUITE(plain_products)

using namespace courant;

// Numbers whose products are exact, for all sizes up to where loops of known length end, and beyond.
BOOST_AUTO_TEST_CASE(are_products) {
  const auto numbers = [](Index rows, Index columns, int first) {
    MatrixXd A(rows, columns);
    for (Index k = 0; k < A.size(); ++k)
      A.data()[k] = static_cast<double>((first + 7 * k) % 11 - 5);
    return A;
  };
  for (Index rows = 1; rows <= 10; ++rows)
    for (Index inner = 0; inner <= 10; ++inner)
      for (const Index columns : {1, 3, 9}) {
        const MatrixXd A = numbers(rows, inner, 1), B = numbers(inner, columns, 2);
        MatrixXd C = MatrixXd::Constant(rows, columns, 99.0);
        multiply_plainly(A, B, C);
        BOOST_TEST((C == A * B), rows << " × " << inner << " × " << columns);
        const MatrixXd D = numbers(rows, columns, 3);
        MatrixXd E = MatrixXd::Constant(inner, columns, 99.0);
        multiply_transposed_plainly(A, D, E);
        BOOST_TEST((E == A.transpose() * D), rows << " × " << inner << " × " << columns);
      }
  const MatrixXd A = numbers(3, 3, 4), B = numbers(3, 3, 5);
  MatrixXd C(3, 3);
  plain_product<3>(A.data(), 3, B.data(), 3, 3, C.data());
  BOOST_TEST((C == A * B));
  BOOST_TEST(plain_distance(A.data(), B.data(), 9) == (A - B).norm(),
             boost::test_tools::tolerance(1e-15));
}

// In the order of their terms: (1 + 1e16) - 1e16 is 0; the product of two vectors in two parts.
BOOST_AUTO_TEST_CASE(add_terms_in_their_order) {
  const double ones[] = {1.0, 1.0, 1.0, 1.0, 1.0}, up[] = {1.0, 1e16, -1e16};
  double c = 1.0;
  plain_product(ones, 1, up, 3, 1, &c);
  BOOST_TEST(c == 0.0);
  const double parts[] = {1.0, 3.0, 1e16, 0.5, -1e16};
  BOOST_TEST(plain_product(ones, parts, 5) == 3.5);
}

BOOST_AUTO_TEST_CASE(the_longest_column_is_the_first_of_equals) {
  const double A[] = {1.0, 2.0, 3.0, 4.0, -4.0, 3.0, 0.0, 0.0};
  BOOST_TEST(longest_column(A, 2, 4).index == 1);
  BOOST_TEST(longest_column(A, 2, 4).square == 25.0);
  BOOST_TEST(longest_column(A + 6, 2, 1).square == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
