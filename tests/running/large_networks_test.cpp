// Networks of 10⁴ states and more: what is done with n × n numbers takes gigabytes there.
#include <boost/test/unit_test.hpp>

#include "lc_line.hpp"
#include "problems.hpp"

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(large_networks)

BOOST_AUTO_TEST_CASE(a_line_of_many_cells_swings_in_its_mode) {
  const test::LcLine line{.cells = 10000, .mode = 3300};
  const test::Problem problem = test::problem(line.experiment());
  BOOST_TEST((problem.ladder.verdict == Verdict::regular));
  BOOST_TEST(problem.ladder.degrees_of_freedom == 2 * line.cells + 1);
  BOOST_TEST(!problem.ladder.is_ambiguous());

  const double h = 0.4;
  const long steps = 20;
  const VectorXd x = problem.end(test::method_1("midpoint"), h * static_cast<double>(steps), steps);
  // The midpoint rule turns every mode by 2 arctan(ω h/2) a step.
  const double amplitude =
      std::cos(2.0 * static_cast<double>(steps) * std::atan(0.5 * h * line.frequency()));
  double worst = 0.0;
  for (int i = 0; i <= line.cells; ++i)
    worst = std::max(worst,
                     std::fabs(x[i] - line.capacitance(i) * amplitude * line.voltage_at_start(i)));
  BOOST_TEST(worst < 1e-11);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
