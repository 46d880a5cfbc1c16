#include "courant/core/expressions/expr.hpp"

#include <boost/test/unit_test.hpp>

#include "../numbers/operation_catalogue.hpp"
#include "courant/core/numbers/operation.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the power 2 is the power 1
//  * a select of a known condition takes the other branch
//  * the difference of a number and itself is its negative
BOOST_AUTO_TEST_SUITE(expr_test)

namespace {

template <class T>
concept Conditional = requires(T a) {
  a ? 1 : 0;
};
static_assert(!Conditional<Expr>, "branching on an expression must not compile");
static_assert(Conditional<double>);
static_assert(sizeof(Expr) == 16);

BOOST_AUTO_TEST_CASE(the_catalogue_of_the_tests_has_every_operation) {
  std::vector<bool> found(kOpCount, false);
  found[static_cast<std::size_t>(Op::constant)] = found[static_cast<std::size_t>(Op::variable)] =
      true;
  for (const auto& sample : operation_catalogue()) {
    found[static_cast<std::size_t>(sample.op)] = true;
    for (const VectorXd& point : sample.points) BOOST_TEST(point.size() == arity(sample.op));
  }
  for (std::size_t op = 0; op < kOpCount; ++op)
    BOOST_TEST(found[op], "no sample of operation " << op);
}

BOOST_AUTO_TEST_CASE(operations_on_constants_are_the_operations_on_numbers) {
  for (const auto& sample : operation_catalogue()) {
    for (const VectorXd& point : sample.points) {
      double operand[3] = {0.0, 0.0, 0.0};
      std::copy(point.begin(), point.end(), operand);
      const double number = evaluate(sample.op, sample.k, operand[0], operand[1], operand[2]);
      BOOST_TEST(sample.apply(constants(point)).value() == number, sample.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(operations_on_nodes_are_one_node) {
  for (const auto& sample : operation_catalogue()) {
    Graph graph;
    const ExprVector u = graph.variables("u", arity(sample.op));
    const Expr y = sample.apply(u);
    BOOST_TEST_CONTEXT(sample.name) {
      BOOST_REQUIRE(!y.is_constant());
      BOOST_CHECK(graph.node(y.node()).op == sample.op);
      BOOST_TEST(graph.node(y.node()).k == sample.k);
      BOOST_TEST(graph.size() == u.size() + 1);
      const Expr again = apply(sample.op, sample.k, u[0], u.size() > 1 ? u[1] : Expr(),
                               u.size() > 2 ? u[2] : Expr());
      BOOST_CHECK(again == y);
    }
  }
  BOOST_CHECK_THROW(apply(Op::variable, 0, 1.0, 0.0, 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(neutral_and_absorbing_elements_are_simplified) {
  Graph graph;
  const Expr x = graph.variable("x"), y = graph.variable("y");
  BOOST_CHECK(x + 0.0 == x);
  BOOST_CHECK(0.0 + x == x);
  BOOST_CHECK(x - 0.0 == x);
  BOOST_CHECK(0.0 - x == -x);
  BOOST_CHECK(x - x == Expr(0.0));
  BOOST_CHECK(x * 1.0 == x);
  BOOST_CHECK(1.0 * x == x);
  BOOST_CHECK(x * 0.0 == Expr(0.0));
  BOOST_CHECK(0.0 * x == Expr(0.0));
  BOOST_CHECK(x * -1.0 == -x);
  BOOST_CHECK(x / 1.0 == x);
  BOOST_CHECK(x / -1.0 == -x);
  BOOST_CHECK(0.0 / x == Expr(0.0));
  BOOST_CHECK(pow(x, 0) == Expr(1.0));
  BOOST_CHECK(pow(x, 1) == x);
  BOOST_CHECK(pow(x, 2) == x * x);
  BOOST_CHECK(pow(x, Expr(3.0)) == pow(x, 3));
  BOOST_CHECK(pow(x, Expr(0.5)) == sqrt(x));
  BOOST_CHECK(select(1.0, x, y) == x);
  BOOST_CHECK(select(0.0, x, y) == y);
  BOOST_CHECK(select(x < y, y, y) == y);
  // What changes a rounding is left alone.
  BOOST_CHECK(!((x + 1.0) - 1.0 == x));
  BOOST_CHECK(!(x / y * y == x));
}

BOOST_AUTO_TEST_CASE(signs_move_outwards) {
  Graph graph;
  const Expr x = graph.variable("x"), y = graph.variable("y");
  BOOST_CHECK(-(-x) == x);
  BOOST_CHECK(x + -y == x - y);
  BOOST_CHECK(-x + y == y - x);
  BOOST_CHECK(x - -y == x + y);
  BOOST_CHECK(-x - y == -(x + y));
  BOOST_CHECK(-x * y == -(x * y));
  BOOST_CHECK(x * -y == -(x * y));
  BOOST_CHECK(-x * -y == x * y);
  BOOST_CHECK(-x / y == -(x / y));
  BOOST_CHECK(x / -y == -(x / y));
  BOOST_CHECK(-x / -y == x / y);
}

BOOST_AUTO_TEST_CASE(conditions_are_simplified) {
  Graph graph;
  const Expr x = graph.variable("x"), y = graph.variable("y"), c = x < y;
  BOOST_CHECK(logical_and(1.0, c) == c);
  BOOST_CHECK(logical_and(c, 0.0) == Expr(0.0));
  BOOST_CHECK(logical_or(c, 0.0) == c);
  BOOST_CHECK(logical_or(2.0, c) == Expr(1.0));
  BOOST_CHECK(logical_and(c, c) == c);
  BOOST_CHECK(logical_not(logical_not(c)) == c);
  BOOST_CHECK(!(logical_and(1.0, x) == x));  // x is not 0 or 1
  BOOST_CHECK(logical_not(logical_not(x)) == logical_and(x, x));
  BOOST_CHECK((x > y) == (y < x));
  BOOST_CHECK((x >= y) == (y <= x));
}

BOOST_AUTO_TEST_CASE(a_variable_has_no_value) {
  Graph graph;
  const Expr x = graph.variable("speed");
  BOOST_CHECK_EXCEPTION((2.0 * x).value(), std::logic_error, [](const auto& e) {
    return std::string(e.what()).find("2*speed") != std::string::npos;
  });
  BOOST_CHECK_THROW(values(ExprVector::Constant(2, x)), std::logic_error);
  BOOST_TEST(Expr(2.5).value() == 2.5);
  BOOST_TEST(Expr().value() == 0.0);
}

// The same formula, on numbers and on constants.
template <class Scalar>
auto formula(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A,
             const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x) {
  using std::sin;
  using std::sqrt;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> y = A * x - A.transpose() * x;
  y.head(2) += A.topLeftCorner(2, 3) * x;
  y[2] = sin(x.dot(y)) / sqrt(x.squaredNorm());
  y += A.row(1).transpose() * x[0] - A.diagonal().cwiseProduct(x);
  y += A.template triangularView<Eigen::Lower>().solve(x);
  return y;
}

BOOST_AUTO_TEST_CASE(a_formula_on_constants_is_its_numeric_version) {
  MatrixXd A(3, 3);
  A << 4.0, -1.0, 0.3, 0.7, 3.0, -0.2, 0.1, 0.5, 2.0;
  const VectorXd x = Eigen::Vector3d(0.3, -1.2, 0.8);
  const VectorXd numeric = formula<double>(A, x);
  BOOST_TEST((values(formula<Expr>(constants(A), constants(x))) - numeric).norm() < 1e-15);
  BOOST_TEST((values(constants(A)) - A).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(numbers_and_expressions_stand_in_one_formula) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const ExprMatrix X = x * x.transpose();
  MatrixXd A(2, 2);
  A << 1.0, 2.0, 3.0, 4.0;
  const auto same = [](const auto& a, const auto& b) { return (a.array() == b.array()).all(); };
  BOOST_TEST(same(ExprVector(2.0 * x), ExprVector(Expr(2.0) * x)));
  BOOST_TEST(same(ExprVector(x * 2.0), ExprVector(x * Expr(2.0))));
  BOOST_TEST(same(ExprVector(x / 2.0), ExprVector(x / Expr(2.0))));
  BOOST_TEST(same(ExprMatrix(0.5 * X), ExprMatrix(Expr(0.5) * X)));
  BOOST_TEST(same(ExprVector(A * x), ExprVector(constants(A) * x)));
  BOOST_TEST(same(ExprVector(A.transpose() * x.head(2)), ExprVector(constants(A.transpose()) * x)));
  BOOST_TEST(same(ExprMatrix(A * X), ExprMatrix(constants(A) * X)));
  BOOST_TEST(same(ExprMatrix(X * A), ExprMatrix(X * constants(A))));
  BOOST_TEST(same(ExprVector(x + A.col(0)), ExprVector(x + constants(A.col(0)))));
}

BOOST_AUTO_TEST_CASE(eigen_takes_expressions_as_scalars) {
  Graph graph;
  const ExprVector v = graph.variables("v", 3);
  MatrixXd A(2, 3);
  A << 4.0, -1.0, 0.0, 0.7, 3.0, -0.2;
  const ExprVector image = constants(A) * v;
  BOOST_CHECK(image[0] == 4.0 * v[0] + -1.0 * v[1]);
  BOOST_CHECK(image[1] == 0.7 * v[0] + 3.0 * v[1] + -0.2 * v[2]);
  const ExprMatrix outer = v * v.transpose();
  BOOST_CHECK(outer(0, 2) == outer(2, 0));
  BOOST_CHECK(outer.block(1, 1, 2, 2)(0, 0) == v[1] * v[1]);
  BOOST_CHECK(v.dot(v) == v.squaredNorm());
  ExprMatrix upper = ExprMatrix::Identity(3, 3);
  upper(0, 1) = v[0];
  const ExprVector solution = upper.triangularView<Eigen::Upper>().solve(v);
  BOOST_CHECK(solution[0] == v[0] - v[0] * v[1]);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
