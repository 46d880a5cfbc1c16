#include "courant/integrators/step/solve_error.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

// Mistakes that these cases have to notice:
//  * a step that would do is as long as one that would not
BOOST_AUTO_TEST_SUITE(solve_error)

using namespace courant;

namespace {

std::string text(const SolveError& error) { return error.what(); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_is_named_by_method_size_and_time) {
  const SolveError error(SolveError::Reason::diverged, "rk4", 0.125, 1e-3, "did not converge.",
                         {2.0, 3.0});
  BOOST_TEST(text(error) == "rk4: the step of 0.001 from t = 0.125 did not converge.");
  BOOST_TEST(error.residuals().back() == 3.0);
  BOOST_TEST(!error.reach().has_value());
}

BOOST_AUTO_TEST_CASE(a_shorter_step_is_advised_in_two_digits) {
  for (const auto& [reach, advice] : {std::pair(0.030854, "0.027"), std::pair(-0.5, "-0.45"),
                                      std::pair(123.4, "110"), std::pair(4.2e-13, "3.7e-13")}) {
    const SolveError error(SolveError::Reason::disconnected, "rk4", 0.0, 1.0, "has no solution", {},
                           SolveError::Reach{.h = reach, .remedy = ""});
    BOOST_TEST(text(error).ends_with(std::string(" A step of ") + advice + " would do."),
               text(error));
  }
}

BOOST_AUTO_TEST_CASE(a_remedy_stands_in_the_place_of_a_shorter_step) {
  const SolveError error(SolveError::Reason::disconnected, "rk4", 0.0, 1.0, "has no solution", {},
                         SolveError::Reach{.h = 0.5, .remedy = "Take another method."});
  BOOST_TEST(
      text(error) ==
      "rk4: the step of 1 from t = 0 has no solution: the one that is ends at a step of 0.5. "
      "Take another method.");
}

// Of a method that has its steps made by another one, in another unit of time.
BOOST_AUTO_TEST_CASE(the_step_of_another_method) {
  const SolveError inner(SolveError::Reason::disconnected, "inner", 8.0, 4.0, "has no solution",
                         {1.0}, SolveError::Reach{.h = 2.0, .remedy = ""});
  const SolveError outer = inner.of_step("outer", 1.0, 0.5, 0.125);
  BOOST_TEST(text(outer) ==
             "outer: the step of 0.5 from t = 1 has no solution: the one that is ends at a step of "
             "0.25. A step of 0.22 would do.");
  BOOST_TEST((outer.reason() == SolveError::Reason::disconnected));
  BOOST_TEST(outer.time() == 1.0);
  BOOST_TEST(outer.step_size() == 0.5);
  BOOST_TEST(outer.residuals().size() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
