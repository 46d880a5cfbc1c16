#include "courant/reporting/energy_figures.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * H itself is drawn beside what was supplied since the start
BOOST_AUTO_TEST_SUITE(energy_figures_test)

using namespace courant;
using courant::test::labels;
using courant::test::table;
using courant::test::Texts;
using courant::test::vortices;

namespace {

std::vector<Run> three_methods(int steps) {
  return {vortices("a", "rk2", test::rk2_path(steps)),
          vortices("b", "discretize-first", test::two_step_path(steps)),
          vortices("c", "constrain-first", test::one_step_path(steps))};
}

bool is_linear(const plot::Panel& panel) {
  return std::dynamic_pointer_cast<const plot::LinearScale>(panel.y.scale) != nullptr;
}

}  // namespace

// One under the other and by the same axis, so that none hides another.
BOOST_AUTO_TEST_CASE(each_run_has_its_panel) {
  const auto figures = energy_figures(three_methods(300));
  // 4.1e-4 is less than a decade above 1.9e-4: there is nothing to zoom into, and a linear axis will do.
  BOOST_TEST_REQUIRE(figures.size() == 1);
  BOOST_TEST(figures[0].name == "energy");
  BOOST_TEST_REQUIRE(figures[0].panels.size() == 3);
  const char* const methods[] = {"rk2", "discretize-first", "constrain-first"};
  for (std::size_t i = 0; i < 3; ++i) {
    const plot::Panel& panel = figures[0].panels[i];
    BOOST_CHECK(labels(panel.series) == (Texts{methods[i]}));
    BOOST_TEST(panel.heading == methods[i]);
    BOOST_TEST(panel.series[0].colour == i);
    BOOST_TEST(panel.series[0].y.front() == 0);
    BOOST_TEST(is_linear(panel));
    BOOST_TEST(panel.y.interval.upper == figures[0].panels[0].y.interval.upper);
    BOOST_TEST(panel.y.interval.lower == figures[0].panels[0].y.interval.lower);
  }
  BOOST_TEST(std::abs(*std::ranges::max_element(figures[0].panels[0].series[0].y) - 4.117e-4) <
             1e-7);
}

BOOST_AUTO_TEST_CASE(the_caption_tells_growing_from_bounded) {
  const std::string caption = energy_figures(three_methods(3000))[0].caption;
  BOOST_TEST(caption.find("rk2: growing, at most") != std::string::npos, caption);
  for (const char* kept :
       {"discretize-first: bounded, at most", "constrain-first: bounded, at most"})
    BOOST_TEST(caption.find(kept) != std::string::npos, caption);
}

BOOST_AUTO_TEST_CASE(methods_that_keep_the_energy_are_shown_again_without_those_that_do_not) {
  const auto figures = energy_figures(three_methods(10'000));
  BOOST_TEST_REQUIRE(figures.size() == 2);
  BOOST_TEST(figures[0].panels.size() == 3);
  BOOST_TEST(!is_linear(figures[0].panels[0]));
  BOOST_TEST(figures[1].name == "energy-detail");
  // For each of the two its beginning, and the whole.
  BOOST_TEST_REQUIRE(figures[1].panels.size() == 4);
  BOOST_TEST(figures[1].legend.size() == 2);
  for (std::size_t i = 0; i < 4; ++i) {
    const plot::Panel& panel = figures[1].panels[i];
    BOOST_CHECK(labels(panel.series) == (Texts{i < 2 ? "discretize-first" : "constrain-first"}));
    BOOST_TEST(panel.series[0].colour == (i < 2 ? 1u : 2u));
    BOOST_TEST(panel.series[0].x.back() == (i % 2 == 0 ? 500 : 10'000));
    BOOST_TEST(is_linear(panel));
  }
}

BOOST_AUTO_TEST_CASE(many_runs_share_a_panel) {
  std::vector<Run> runs;
  for (int i = 0; i < 9; ++i) {
    runs.push_back(table({"t", "H"}, 50, [](std::size_t, double t) { return std::cos(t); }));
    runs.back().name = std::to_string(i);
  }
  const auto figures = energy_figures(runs);
  BOOST_TEST(figures[0].panels.size() == 1u);
  BOOST_TEST(figures[0].panels[0].series.size() == 9u);
  BOOST_TEST(figures[0].legend.size() == 9u);
  BOOST_TEST(energy_figures(std::vector<Run>{table({"t", "q"}, 5, [](std::size_t, double t) {
               return t;
             })}).empty());
}

// A damped oscillator: its energy goes where it should.
BOOST_AUTO_TEST_CASE(what_is_dissipated_is_shown_beside_what_is_stored) {
  const std::vector<Run> runs = {
      table({"t", "H", "supplied", "dissipated"}, 400, [](std::size_t column, double t) {
        const double lost = 1 - std::exp(-t), error = 1e-6 * std::sin(5 * t);
        return column == 1 ? 2 - lost + error : column == 2 ? 0.0 : lost;
      })};
  const auto figures = energy_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 2);
  BOOST_TEST(figures[0].name == "energy-balance");
  BOOST_TEST_REQUIRE(figures[0].panels.size() == 1);
  BOOST_CHECK(labels(figures[0].panels[0].series) == (Texts{"H − H(0)", "supplied", "dissipated"}));
  BOOST_TEST(figures[0].legend.size() == 3);
  BOOST_TEST(figures[0].panels[0].series[0].y.front() == 0.0);
  BOOST_TEST(std::abs(figures[0].panels[0].series[0].y.back() + 1) < 1e-5);
  BOOST_TEST(std::abs(figures[0].panels[0].series[2].y.back() - 1) < 1e-5);
  BOOST_TEST(figures[1].name == "energy");
  BOOST_TEST(figures[1].panels[0].y.label == "H − H(0) − supplied + dissipated");
  BOOST_TEST(figures[1].caption.find("It is bounded, at most 1 × 10⁻⁶") != std::string::npos,
             figures[1].caption);
}

BOOST_AUTO_TEST_CASE(the_linear_zone_holds_the_smallest_curve) {
  const auto threshold = [](const std::vector<double>& sizes) {
    std::vector<plot::Series> series;
    for (const double size : sizes) series.push_back({"", {0, 1}, {0, -size}, 0});
    return symmetric_log_threshold(series);
  };
  const auto tolerance = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(threshold({4e-4, 1.6e-4}) == 1e-4, tolerance);
  BOOST_TEST(threshold({1e-4}) == 1e-4, tolerance);
  BOOST_TEST(threshold({1e-1, 3e-15}) == 1e-13, tolerance);
  BOOST_TEST(threshold({1e-1, 0}) == 1e-1, tolerance);
  BOOST_TEST(threshold({0}) == 1e-16, tolerance);
  BOOST_TEST(threshold({}) == 1e-16, tolerance);
  // A single outlier does not move it.
  plot::Series spike{"", {}, {}, 0};
  for (int i = 0; i < 100; ++i) {
    spike.x.push_back(i);
    spike.y.push_back(i == 50 ? 1e-3 : 2e-9 * std::sin(i));
  }
  BOOST_TEST(symmetric_log_threshold(std::vector<plot::Series>{spike}) == 1e-9, tolerance);
}

BOOST_AUTO_TEST_SUITE_END()
