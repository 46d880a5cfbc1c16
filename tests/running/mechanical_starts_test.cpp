// Starts of mechanisms, molecules and orbits with the numbers that people type.
#include <boost/test/unit_test.hpp>

#include "courant/running/consistent_start.hpp"

// Mistakes that these cases have to notice:
//  * an angle of 10⁻¹⁷ beside others of 10⁻¹⁷ counts as a number (integrators/certificate/binary_scales.cpp)
//  * the zero that was meant is compared with what digits find alone
//    (integrators/certificate/certificate_in_digits.cpp)
BOOST_AUTO_TEST_SUITE(mechanical_starts_test)

using namespace courant;

namespace {

ConstraintLadder start(const Json& experiment) {
  return consistent_start(read_experiment(experiment.dump()));
}

// Cranks of length 1 with the angles a and c, a coupler with the angle b and a base of length 2.
Json parallelogram(double a, double b, double c) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", {"a", "b", "c"}},
            {"holonomic", {"cos(a) + 2*cos(b) - cos(c) - 2", "sin(a) + 2*sin(b) - sin(c)"}}}},
          {"initial", {{"a", a}, {"b", b}, {"c", c}, {"a'", 0}, {"b'", 0}, {"c'", 0}}}};
}

}  // namespace

// All bars are on one line: the position is singular, and a way out of it is a rounding error away from these angles.
BOOST_AUTO_TEST_CASE(a_flat_linkage_in_rounded_zeros_is_doubted) {
  const double tiny[][3] = {{1e-17, 0, 1e-17},
                            {1e-17, 0, 0},
                            {0, 1e-17, 1e-17},
                            {1e-17, 1e-17, 1e-17},
                            {1.2246e-16, 1e-17, -3e-17}};
  BOOST_TEST((start(parallelogram(0, 0, 0)).verdict == Verdict::rank_change));
  for (const auto& [a, b, c] : tiny) BOOST_TEST_CONTEXT(a << ", " << b << ", " << c) {
      const ConstraintLadder found = start(parallelogram(a, b, c));
      BOOST_TEST((found.verdict == Verdict::rank_change || found.is_ambiguous()));
    }
  const ConstraintLadder open = start(parallelogram(1e-6, 0, 1e-6));
  BOOST_TEST((open.verdict == Verdict::regular));
  BOOST_TEST(!open.is_ambiguous());
}

BOOST_AUTO_TEST_SUITE_END()
