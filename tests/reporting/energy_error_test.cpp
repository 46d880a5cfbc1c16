#include "courant/reporting/energy_error.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * what is dissipated counts as an error
//  * the sign of what is supplied
//  * round-off is measured by what is stored alone
BOOST_AUTO_TEST_SUITE(energy_error_test)

using namespace courant;
using courant::test::table;

// H = 5 + t², 3 t supplied, dissipated what makes the balance lack 0.01 t.
namespace {

Run driven(double factor) {
  Run run = table({"t", "H", "supplied", "dissipated"}, 40, [](std::size_t column, double t) {
    return column == 1 ? 5 + t * t : column == 2 ? 3 * t : 3 * t - t * t - 0.01 * t;
  });
  std::vector<std::vector<double>> columns;
  for (const std::string& name : run.trajectory.names()) {
    const auto values = run.trajectory.column(name);
    columns.emplace_back(values.begin(), values.end());
    if (name == "supplied" || name == "dissipated")
      for (double& value : columns.back()) value *= factor;
  }
  run.trajectory = TrajectoryTable(run.trajectory.names(), columns);
  return run;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_comes_in_and_goes_out_is_no_error) {
  const auto error = energy_error(driven(1.0));
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST(error->is_balance);
  BOOST_TEST(name_of(*error) == "H − H(0) − supplied + dissipated");
  for (std::size_t i = 0; i < 40; ++i)
    BOOST_TEST(std::abs(error->values[i] + 0.01 * 0.05 * static_cast<double>(i)) < 1e-14);
  BOOST_TEST(error->size == 5 + 1.95 * 1.95);
}

BOOST_AUTO_TEST_CASE(energies_that_only_pass_through_have_a_size) {
  BOOST_TEST(energy_error(driven(100.0))->size == 585.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_any_the_energy_is_to_stay) {
  const auto error = energy_error(driven(0.0));
  BOOST_TEST(!error->is_balance);
  BOOST_TEST(name_of(*error) == "H − H(0)");
  BOOST_TEST(error->values.front() == 0.0);
  BOOST_TEST(error->values.back() == 1.95 * 1.95, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_run_without_an_energy_has_none) {
  BOOST_TEST(!energy_error(table({"t", "q"}, 5, [](std::size_t, double t) { return t; })));
}

BOOST_AUTO_TEST_SUITE_END()
