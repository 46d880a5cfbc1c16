#include "catalogue.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/manifolds/laws.hpp"

using namespace courant;

BOOST_AUTO_TEST_SUITE(manifold_catalogue)

BOOST_AUTO_TEST_CASE(every_manifold_keeps_every_law) {
  for (const auto& manifold : test::manifold_catalogue())
    for (const LawResult& result : check_manifold(*manifold)) BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(every_class_is_in_the_catalogue) {
  const auto classes = test::final_classes(COURANT_SOURCES "/manifolds", "Manifold|VectorBundle");
  BOOST_TEST(classes.size() >= 12U);
  const auto catalogue = test::manifold_catalogue();
  for (const std::string& name : classes)
    BOOST_TEST(
        std::ranges::any_of(catalogue, [&](const auto& m) { return test::is_of_class(*m, name); }),
        name << " is missing from the catalogue of manifolds");
}

BOOST_AUTO_TEST_SUITE_END()
