// Expressions whose formulas share their parts, so that few nodes have very many paths: every walk
// over them visits a node once, or never ends.
#include <boost/test/unit_test.hpp>

#include "courant/core/algebra/affine_parts.hpp"
#include "courant/core/algebra/collected_terms.hpp"
#include "courant/core/algebra/divided_difference.hpp"
#include "courant/core/algebra/elimination.hpp"
#include "courant/core/algebra/normal_form.hpp"
#include "courant/core/algebra/simplified.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/held_part.hpp"
#include "courant/core/expressions/series_function.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/expressions/taylor.hpp"
#include "courant/core/expressions/undefined.hpp"
#include "courant/core/solve/exponentials.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(shared_graph_test)

namespace {

constexpr int kLevels = 60;

// 2⁶⁰ paths: each level uses the one before twice.
struct Shared {
  explicit Shared(Expr (*level)(const Expr&)) {
    value = x[0];
    for (int k = 0; k < kLevels; ++k) value = level(value);
  }

  Graph graph;
  ExprVector x = graph.variables("x", 2);
  Expr value;
};

Expr product_of_functions(const Expr& a) { return sin(a) * cos(a); }
Expr sum_of_functions(const Expr& a) { return sin(a) + cos(a); }
Expr quotient(const Expr& a) { return a / (1.0 + a); }
Expr square_and_itself(const Expr& a) { return a * a - a; }
Expr of_two_arguments(const Expr& a) { return atan2(a, sqrt(1.0 + a)); }
Expr choice(const Expr& a) { return select(a < 1.0, sin(a), exp(-a)); }
Expr power(const Expr& a) { return pow(a, 0.5 * a); }
Expr product_with_its_root(const Expr& a) { return a * sqrt(a); }
Expr quotient_of_powers(const Expr& a) { return pow(a, 3) / square(a); }

}  // namespace

BOOST_AUTO_TEST_CASE(every_walk_visits_a_node_once) {
  for (const auto level :
       {product_of_functions, sum_of_functions, quotient, square_and_itself, of_two_arguments,
        choice, power, product_with_its_root, quotient_of_powers}) {
    const Shared shared(level);
    const ExprVector& x = shared.x;
    const ExprVector y = ExprVector::Constant(1, shared.value);
    BOOST_TEST(to_string(shared.value, 100).size() < 200u);
    // What it is worth to the reader is known beforehand: nothing of this size.
    simplified(shared.value);
    simplified_equation(shared.value, {.relations = {x[0] * x[0] + x[1] * x[1] - 1.0}});
    NormalForm normal(x, {x[0] * x[0] + x[1] * x[1] - 1.0});
    normal(shared.value);
    normal.factors(shared.value);
    normal.without_factors(shared.value, [](const Expr&) { return false; });
    normal.eliminated({shared.value}, x.head(1));
    normal.consequences({shared.value}, x.head(1));
    with_affine_parts(y, x);
    collected(y);
    collected(y, x.head(1));
    divided_difference(y, x, x, 1.0);
    const Elimination elimination(ExprVector::Constant(1, x[1] - shared.value), x, {});
    BOOST_TEST(elimination.pivots.size() <= 1u);
    Elimination(ExprVector::Constant(1, shared.value * x[1] - 1.0), x.tail(1),
                {.never_zero = x.head(1)});
    held_part(y, x.tail(1));
    exponential_arguments(y, x);
    find_undefined(y, x, VectorXd::Constant(2, 0.5));
    const ExprVector slope = gradient(shared.value, x);
    gradient(slope[0], x);
    pull_back(y, x, ExprVector::Ones(1));
    tangent(y, x, ExprVector::Ones(2));
    jacobian(y, x);
    is_affine(y, x);
    contained_groups(y, {x.head(1), x.tail(1)});
    substitute(y, x, ExprVector::Constant(2, x[0] + x[1]));
    const Function function("f", {{"x", x}}, y, {.differentiate = {"x"}});
    function.jacobian({VectorXd::Constant(2, 0.5)});
    const SeriesFunction series({x}, y);
    const VectorXd at = VectorXd::Constant(2, 0.5);
    const double* const in[] = {at.data()};
    double out = 0.0;
    series.run(in, 0, &out);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
