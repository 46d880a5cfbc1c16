#include "catalogue.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/manifolds/laws.hpp"

// Mistakes that these cases have to notice:
//  * the inverse of half the length (manifolds/special_orthogonal.cpp)
BOOST_AUTO_TEST_SUITE(manifold_catalogue)

using namespace courant;

BOOST_AUTO_TEST_CASE(every_manifold_keeps_every_law) {
  for (const auto& manifold : test::manifold_catalogue())
    for (const LawResult& result : check_manifold(*manifold)) BOOST_TEST(result.passed(), result);
}

// A manifold made anew is the same, and no other one is. Those that are given by a function can
// only be themselves.
BOOST_AUTO_TEST_CASE(manifolds_are_compared_by_value) {
  const auto one = test::manifold_catalogue(), other = test::manifold_catalogue();
  std::size_t equal_pairs = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < one.size(); ++j) {
      BOOST_TEST((*one[i] == *one[j]) == (i == j), one[i]->name() << ", " << one[j]->name());
      const bool by_function = one[i]->name().find("Ellipsoid") != std::string::npos ||
                               one[i]->name().find("SphericalCircle") != std::string::npos;
      const bool equal = *one[i] == *other[j];
      if (i != j || by_function) BOOST_TEST(!equal, one[i]->name() << ", " << other[j]->name());
      equal_pairs += equal;
    }
  BOOST_TEST(equal_pairs >= 20U);
}

BOOST_AUTO_TEST_CASE(every_class_is_in_the_catalogue) {
  const auto classes = test::final_classes("manifolds", "Manifold|VectorBundle");
  BOOST_TEST(classes.size() >= 12U);
  const auto catalogue = test::manifold_catalogue();
  for (const std::string& name : classes)
    BOOST_TEST(
        std::ranges::any_of(catalogue, [&](const auto& m) { return test::is_of_class(*m, name); }),
        name << " is missing from the catalogue of manifolds");
}

BOOST_AUTO_TEST_SUITE_END()
