#include "map_catalogue.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/laws.hpp"

BOOST_AUTO_TEST_SUITE(map_catalogue)

using namespace courant;

BOOST_AUTO_TEST_CASE(every_map_keeps_every_law) {
  for (const auto& map : test::base_map_catalogue())
    for (const LawResult& result : check_discretization_map(*map))
      BOOST_TEST(result.passed(), result);
  for (const auto& map : test::other_map_catalogue())
    for (const LawResult& result : check_discretization_map(*map))
      BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(every_lift_keeps_every_law) {
  for (const auto& map : test::base_map_catalogue())
    for (const LawResult& result : check_cotangent_lift(*test::lift(map), {.points = 1}))
      BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(every_class_is_in_the_catalogue) {
  const auto classes = test::final_classes("integrators/maps", "DiscretizationMap");
  BOOST_TEST(classes.size() >= 6U);
  auto catalogue = test::base_map_catalogue();
  catalogue.push_back(test::lift(catalogue.front()));
  for (const std::string& name : classes)
    BOOST_TEST(std::ranges::any_of(catalogue,
                                   [&](const auto& map) { return test::is_of_class(*map, name); }),
               name << " is missing from the catalogue of discretization maps");
}

BOOST_AUTO_TEST_SUITE_END()
