// Starting points that people really use: at rest, on an axis, with terms that cancel, in SI units.
// What is right is derived beside each.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(certificate_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

void check(const std::string& name, const SystemPointer& system, const InitialGuess& guess,
           Verdict verdict, const Dimensions& expected) {
  const ConstraintLadder ladder = certificate(system, guess);
  BOOST_TEST_CONTEXT(name << ": " << ladder.reason) {
    BOOST_TEST(to_string(ladder.verdict) == to_string(verdict));
    BOOST_TEST((dimensions(ladder) == expected));
    BOOST_TEST(!ladder.is_ambiguous());
  }
}

// x' = v, y' = w, m v' = λ x, m w' = λ y - m g, x² + y² = l². `planted` is added to the first.
SystemPointer pendulum(double m, double g, double l, const std::function<Expr(V x)>& planted) {
  return flat(4, 1, 5, [=](V x, V v, V z, T) {
    return equations({v[0] - x[2] + planted(x), v[1] - x[3], m * v[2] - z[0] * x[0],
                      m * v[3] - z[0] * x[1] + m * g, square(x[0]) + square(x[1]) - l * l});
  });
}
SystemPointer pendulum() {
  return pendulum(1, 1, 1, [](V) { return Expr(0.0); });
}

const Dimensions index_2 = {{4, 3}, {3, 2}, {2, 2}, {2, 2}};

}  // namespace

// Wherever a pendulum is, and however fast: (4,3), (3,2), (2,2).
BOOST_AUTO_TEST_CASE(pendulum_from_rest_and_from_the_axes) {
  for (const auto& x : {std::array{1.0, 0.0, 0.0, 0.0}, std::array{0.0, -1.0, 0.0, 0.0},
                        std::array{0.0, 1.0, 0.0, 0.0}, std::array{-1.0, 0.0, 0.0, 0.0},
                        std::array{0.0, -1.0, 2.0, 0.0}, std::array{0.6, -0.8, 0.0, 0.0}})
    check("pendulum", pendulum(), at({x[0], x[1], x[2], x[3]}), Verdict::regular, index_2);
}

// The order of the equations does not matter either: all 120 of them, released from the horizontal.
BOOST_AUTO_TEST_CASE(pendulum_in_every_order_of_its_equations) {
  std::array<Index, 5> order = {0, 1, 2, 3, 4};
  do {
    const auto system = flat(4, 1, 5, [order](V x, V v, V z, T) {
      const ExprVector F = equations({v[0] - x[2], v[1] - x[3], v[2] - z[0] * x[0],
                                      v[3] - z[0] * x[1] + 1, square(x[0]) + square(x[1]) - 1});
      return ExprVector(F(std::vector<Index>(order.begin(), order.end())));
    });
    check("permuted", system, at({1, 0, 0, 0}), Verdict::regular, index_2);
  } while (std::next_permutation(order.begin(), order.end()));
}

// sin² + cos² - 1 is zero to round-off, and nothing more.
BOOST_AUTO_TEST_CASE(terms_that_cancel) {
  const auto planted = [](V x) {
    return (square(sin(x[0] + 0.3)) + square(cos(x[0] + 0.3)) - 1) * x[3];
  };
  check("generic", pendulum(1, 1, 1, planted), at({0.6, -0.8, 0.4, 0.3}), Verdict::regular,
        index_2);
  check("horizontal", pendulum(1, 1, 1, planted), at({1, 0, 0, 0}), Verdict::regular, index_2);
}

BOOST_AUTO_TEST_CASE(grams_and_millimetres) {
  check("pendulum", pendulum(2.3e-3, 9.81, 1e-3, [](V) { return Expr(0.0); }), at({1e-3, 0, 0, 0}),
        Verdict::regular, index_2);
}

// x' = λ x, y' = w, w' = λ y - 1 on the circle: x² λ + y w = 0 determines λ where x ≠ 0.
BOOST_AUTO_TEST_CASE(a_multiplier_that_no_gauge_is) {
  const auto system = flat(3, 1, 4, [](V x, V v, V z, T) {
    return equations(
        {v[0] - z[0] * x[0], v[1] - x[2], v[2] - z[0] * x[1] + 1, square(x[0]) + square(x[1]) - 1});
  });
  check("silent gauge", system, at({1, 0, 0}), Verdict::regular, {{3, 2}, {2, 2}, {2, 2}});
}

// On surfaces in space, at rest: (6,5), (5,4), (4,4).
BOOST_AUTO_TEST_CASE(a_particle_at_rest_on_a_surface) {
  const auto particle = [](const std::function<Expr(V x)>& g,
                           const std::function<Expr(V, int)>& dg) {
    return flat(6, 1, 7, [=](V x, V v, V z, T) {
      ExprVector F(7);
      for (int i = 0; i < 3; ++i) {
        F[i] = v[i] - x[3 + i];
        F[3 + i] = v[3 + i] - z[0] * dg(x, i);
      }
      F[6] = g(x);
      return F;
    });
  };
  const Dimensions expected = {{6, 5}, {5, 4}, {4, 4}, {4, 4}};
  check("cylinder",
        particle([](V x) { return square(x[0]) + square(x[1]) - 1; },
                 [](V x, int i) { return i < 2 ? x[i] : Expr(0.0); }),
        at({1, 0, 0, 0, 0, 0}), Verdict::regular, expected);
  check("ellipsoid",
        particle([](V x) { return square(x[0]) + square(x[1]) / 4 + square(x[2]) / 9 - 1; },
                 [](V x, int i) { return x[i] / static_cast<double>((i + 1) * (i + 1)); }),
        at({0, 2, 0, 0, 0, 0}), Verdict::regular, expected);
  const auto distance = [](V x) { return square(x[0]) + square(x[1]) + square(x[2]); };
  check("torus",
        particle([=](V x) { return square(distance(x) + 3) - 16 * (square(x[0]) + square(x[1])); },
                 [=](V x, int i) { return (distance(x) + (i < 2 ? -5.0 : 3.0)) * x[i]; }),
        at({3, 0, 0, 0, 0, 0}), Verdict::regular, expected);
}

// The centre of the circle is no point of it, and the equations have no linear part there.
BOOST_AUTO_TEST_CASE(from_a_point_that_no_step_leads_away_from) {
  const ConstraintLadder ladder = certificate(pendulum(), at({0, 0, 0, 0}));
  BOOST_TEST(to_string(ladder.verdict) == "regular", ladder.reason);
  BOOST_TEST(std::abs(ladder.point.x.head(2).norm() - 1) < 1e-12);
}

// What is true of L = x'²/2 + x^1.5 at 0 is that derivatives are not finite: x = 0 is a solution.
BOOST_AUTO_TEST_CASE(derivatives_that_are_not_finite) {
  const auto system =
      lagrangian(1, [](V q, V w, T) { return 0.5 * square(w[0]) + pow(q[0], Expr(1.5)); });
  const ConstraintLadder ladder = certificate(system, at({0, 0}));
  BOOST_TEST(to_string(ladder.verdict) == "not-reached");
  BOOST_TEST(ladder.reason.find("not finite") != std::string::npos, ladder.reason);
}

BOOST_AUTO_TEST_CASE(numbers_too_small_to_divide) {
  const auto oscillator = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + sin(x[0])});
  });
  check("denormal", oscillator, at({1e-320, 0}), Verdict::regular, {{2, 2}, {2, 2}});
}

// x' = 1, x = 2: every ladder that is certain agrees with itself; one that could not is ambiguous.
BOOST_AUTO_TEST_CASE(levels_that_no_ladder_can_have) {
  LadderLevel first, second;
  first.dim_S = 4;
  first.dim_M = second.dim_M = 3;
  second.k = 1;
  second.dim_S = 5;
  BOOST_TEST(contradictions({first}).empty());
  BOOST_TEST(contradictions({first, second}).size() == 1U);
  second.dim_S = 2;
  BOOST_TEST(contradictions({first, second}).size() == 1U);  // fibre -1
  second.dim_S = 3;
  BOOST_TEST(contradictions({first, second}).empty());
  ConstraintLadder ladder;
  ladder.doubts = {"a doubt"};
  BOOST_TEST(ladder.is_ambiguous());
}

// Christ–Lee and L = x'²/2 - x²/2 on (x, z): x' = p_x is determined, z' is not.
BOOST_AUTO_TEST_CASE(gauge_leaves_some_velocities_alone) {
  const auto system =
      lagrangian(2, [](V q, V w, T) { return 0.5 * square(w[0]) - 0.5 * square(q[0]); });
  const ConstraintLadder ladder = certificate(system, at({0.3, 0.1, 0.7, 0}));
  BOOST_TEST(to_string(ladder.verdict) == "gauge");
  BOOST_TEST(ladder.determined_velocities == (std::vector<bool>{true, false, true, true}),
             boost::test_tools::per_element());
  BOOST_TEST(ladder.determined == (std::vector<bool>{true, false}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
