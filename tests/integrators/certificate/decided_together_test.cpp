// What bounds of errors and digits say together: each alone is wrong or doubts somewhere here.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/certificate.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * bounds that are sure are never asked about (integrators/certificate/certificate_in_digits.cpp)
//  * what digits settle stays doubted (integrators/certificate/certificate_in_digits.cpp)
//  * the doubt of a switch is lost (integrators/certificate/certificate_in_digits.cpp)
//  * a singular point of digits alone is believed (integrators/certificate/certificate_in_digits.cpp)
BOOST_AUTO_TEST_SUITE(decided_together_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

Certificate by(Decider decider, const SystemPointer& system, const InitialGuess& guess) {
  return certificate(system, guess, {}, decider);
}

}  // namespace

// x = t holds with x' = y, y' = -x at t = 0 alone: bounds are sure of one solution.
BOOST_AUTO_TEST_CASE(what_holds_at_an_instant_only_is_inconsistent) {
  const auto system = flat(2, 0, 3, [](V x, V v, V, T t) {
    return equations({v[0] - x[1], v[1] + x[0], x[0] - t});
  });
  const InitialGuess start = at({0.0, 1.0});
  BOOST_TEST(to_string(by(Decider::bounds, system, start).verdict) == "regular");
  const Certificate found = by(Decider::both, system, start);
  BOOST_TEST(to_string(found.verdict) == "inconsistent");
  BOOST_TEST(!found.is_ambiguous());
}

// Two rods whose squares differ by 10⁻¹⁰.
BOOST_AUTO_TEST_CASE(rods_that_contradict_each_other_by_little_are_inconsistent) {
  const auto system = flat(4, 2, 6, [](V x, V v, V z, T) {
    const Expr square_of_length = square(x[0]) + square(x[1]), force = z[0] + z[1];
    return equations({v[0] - x[2], v[1] - x[3], v[2] + 2 * force * x[0],
                      v[3] + 2 * force * x[1] + 9.81, square_of_length - 1,
                      square_of_length - 1.0000000001});
  });
  const InitialGuess start = at({0.6, -0.8, 0.0, 0.0});
  BOOST_TEST(!by(Decider::bounds, system, start).is_ambiguous());
  BOOST_TEST(to_string(by(Decider::both, system, start).verdict) == "inconsistent");
}

// x² + y² + z² + 1 = 0.
BOOST_AUTO_TEST_CASE(a_sphere_of_imaginary_radius_is_empty) {
  const auto system = flat(3, 0, 3, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] - x[2], square(x[0]) + square(x[1]) + square(x[2]) + 1});
  });
  const Certificate found = by(Decider::both, system, at({0.3, -0.2, 0.5}));
  BOOST_TEST(to_string(found.verdict) == "inconsistent");
  BOOST_TEST(!found.is_ambiguous());
}

// Dry friction at rest.
BOOST_AUTO_TEST_CASE(a_switch_at_its_edge_is_doubted) {
  const auto system = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + sign(x[1]) + x[0]});
  });
  const InitialGuess start = at({0.5, 0.0});
  BOOST_TEST(!by(Decider::bounds, system, start).is_ambiguous());
  const Certificate found = by(Decider::both, system, start);
  BOOST_REQUIRE(found.doubts.size() == 1U);
  BOOST_TEST(to_string(found.doubts[0].kind) == "switch");
  BOOST_TEST(!by(Decider::both, system, at({0.5, 0.1})).is_ambiguous());
}

// The chain of long_chains_with_exponentials in certificate_in_digits_test, in 58 pieces.
BOOST_AUTO_TEST_CASE(digits_settle_what_bounds_doubt) {
  constexpr Index n = 58;
  const auto chain = flat(1, n, n + 1, [](V x, V v, V z, T) {
    ExprVector F(n + 1);
    constexpr double stiffness = 3600.0;
    F[n] = v[0] + z[0];
    for (Index i = 0; i < n; ++i) {
      const Expr before = i == 0 ? Expr(0.0) : z[i - 1], after = i == n - 1 ? Expr(0.0) : z[i + 1];
      F[i] = (before - 2 * z[i] + after) * stiffness - sinh(z[i]);
    }
    F[0] += x[0];
    return F;
  });
  BOOST_TEST(by(Decider::bounds, chain, at({1})).is_ambiguous());
  const Certificate found = by(Decider::both, chain, at({1}));
  BOOST_TEST(to_string(found.verdict) == "regular");
  BOOST_TEST(!found.is_ambiguous());
}

// Cawley's Lagrangian: bounds find the singular point, and say so without help.
BOOST_AUTO_TEST_CASE(singular_points_stay_singular) {
  for (const KnownLadder& known : catalogue()) {
    if (known.verdict != Verdict::rank_change) continue;
    const Certificate found = known.problem.ladder();
    BOOST_TEST(to_string(found.verdict) == "rank-change", known.name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
