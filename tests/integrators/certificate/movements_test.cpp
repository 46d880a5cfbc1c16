#include "courant/integrators/certificate/movements.hpp"

#include <boost/test/unit_test.hpp>

#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * what nobody knew, or what rounding changed, has moved
//  * from and to are exchanged, or a number has the name of another one
BOOST_AUTO_TEST_SUITE(movements_test)

using namespace courant;
using namespace courant::examples;

namespace {

SystemPointer with_two_coordinates_and_one_unknown() {
  return flat(2, 1, 1,
              [](const ExprVector& x, const ExprVector&, const ExprVector& z, const Expr&) {
                return equations({x[0] + z[0]});
              },
              {{"x", "y"}, {"lambda"}, {"sum"}});
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_moved_is_told_by_name) {
  const InitialGuess guess{
      .x = VectorXd{{1.0, 2.0}}, .v = VectorXd{{3.0, 4.0}}, .z = VectorXd{{5.0}}};
  const State point{
      .t = 0.0, .x = VectorXd{{1.0 + 1e-15, 2.5}}, .v = VectorXd{{3.5, 4.0}}, .z = VectorXd{{6.0}}};
  const std::vector<Movement> moves =
      movements(*with_two_coordinates_and_one_unknown(), guess, point);
  BOOST_TEST_REQUIRE(moves.size() == 3u);
  BOOST_TEST(moves[0].name == "y");
  BOOST_TEST(moves[0].from == 2.0);
  BOOST_TEST(moves[0].to == 2.5);
  BOOST_TEST(moves[1].name == "x'");
  BOOST_TEST(moves[1].to == 3.5);
  BOOST_TEST(moves[2].name == "lambda");
  BOOST_TEST(moves[2].from == 5.0);
}

// A search leaves round-off of a zero.
BOOST_AUTO_TEST_CASE(round_off_is_zero) {
  const InitialGuess guess{.x = VectorXd{{1.0, 0.4}}};
  const State point{
      .t = 0.0, .x = VectorXd{{1.0, 6e-19}}, .v = VectorXd{{0.0, 0.0}}, .z = VectorXd{{0.0}}};
  const std::vector<Movement> moves =
      movements(*with_two_coordinates_and_one_unknown(), guess, point);
  BOOST_TEST_REQUIRE(moves.size() == 1u);
  BOOST_TEST(moves[0].to == 0.0);
}

BOOST_AUTO_TEST_CASE(what_nobody_knew_has_not_moved) {
  const InitialGuess guess{.x = VectorXd{{1.0, 0.0}}};
  const State point{
      .t = 0.0, .x = VectorXd{{1.0, 1e-13}}, .v = VectorXd{{7.0, 8.0}}, .z = VectorXd{{9.0}}};
  BOOST_TEST(movements(*with_two_coordinates_and_one_unknown(), guess, point).empty());
}

BOOST_AUTO_TEST_SUITE_END()
