// Problems of the literature, from the starts that they are given with, at rest and in SI units. What
// is right is derived beside each by reducing the index by hand.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * no zero is looked for beyond the sizes that are given
//    (integrators/certificate/consistent_point.cpp)
//  * numbers near a point are taken for noise of the search
//    (integrators/certificate/consistent_point.cpp)
//  * derivatives are counted at one moment only (integrators/certificate/constraint_algorithm.cpp)
//  * ranks are compared at one moment only (integrators/certificate/singularity.cpp)
//  * the ranks at the given values are not compared with those of the point next to them
//    (integrators/certificate/singularity.cpp)
//  * the damping that exponentials need is stepped over (integrators/certificate/nearest_zero.cpp)
BOOST_AUTO_TEST_SUITE(literature_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

bool is_right(const ConstraintLadder& ladder, Verdict verdict, const Dimensions& expected) {
  return ladder.verdict == verdict && (expected.empty() || dimensions(ladder) == expected);
}

void check(const std::string& name, const SystemPointer& system, const InitialGuess& guess,
           Verdict verdict, const Dimensions& expected) {
  const ConstraintLadder ladder = certificate(system, guess);
  BOOST_TEST_CONTEXT(name << ": " << ladder.reason) {
    BOOST_TEST(to_string(ladder.verdict) == to_string(verdict));
    BOOST_TEST(is_right(ladder, verdict, expected));
    BOOST_TEST(!ladder.is_ambiguous());
  }
}

InitialGuess zeros(Index n) { return {.x = VectorXd::Zero(n)}; }

}  // namespace

// A robot arm with two links whose end follows a path (Campbell, Griepentrog 1995): x₁, x₃ from the
// path, x₄, x₆ from its derivative; the second derivative has both x₄' and x₆' in u₁ - u₂ and x₂, which
// gives u₁ - u₂ and a constraint for x₂; then x₅, then u₂.
BOOST_AUTO_TEST_CASE(robot_arm) {
  const auto arm = flat(6, 2, 8, [](V x, V v, V u, T t) {
    const Expr d0 = 2 - square(cos(x[2])), a = 2 / d0, b = cos(x[2]) / d0, c = sin(x[2]) / d0,
               d = sin(x[2]) * cos(x[2]) / d0, both = square(x[3] + x[5]), spring = 2 * x[2] - x[1];
    return equations(
        {v[0] - x[3], v[1] - x[4], v[2] - x[5],
         v[3] - (2 * c * both + square(x[3]) * d + spring * (a + 2 * b) + a * (u[0] - u[1])),
         v[4] - (-2 * c * both - square(x[3]) * d + spring * (1 - 3 * a - 2 * b) - a * u[0] +
                 (a + 1) * u[1]),
         v[5] - (-2 * c * both - square(x[3]) * d + spring * (a - 9 * b) - 2 * square(x[3]) * c -
                 d * both - (a + b) * (u[0] - u[1])),
         cos(x[0]) + cos(x[0] + x[2]) - cos(exp(t) - 1) - cos(t - 1),
         sin(x[0]) + sin(x[0] + x[2]) - sin(1 - exp(t)) - sin(1 - t)});
  });
  check("robot arm", arm, at({0, 0, 1, -1, 0, 0}), Verdict::regular,
        {{6, 4}, {4, 2}, {2, 1}, {1, 0}, {0, 0}, {0, 0}});
}

// The ring modulator (Horneber 1985) without its small capacitors, from zeros: four equations for
// U₃ … U₆ of rank 3, so that I₃ + I₄ + I₅ + I₆ = 0; its derivative is the fourth.
BOOST_AUTO_TEST_CASE(ring_modulator) {
  const auto modulator = [](double small) {
    return flat(15, 0, 15, [small](V x, V v, V, T t) {
      const auto U = [&](int i) { return x[i - 1]; };
      const auto I = [&](int i) { return x[i + 6]; };
      const auto dU = [&](int i) { return v[i - 1]; };
      const auto dI = [&](int i) { return v[i + 6]; };
      const auto diode = [](const Expr& u) { return 40.67286402e-9 * (exp(17.7493332 * u) - 1); };
      const Expr in1 = 0.5 * sin(2e3 * std::numbers::pi * t),
                 in2 = 2 * sin(2e4 * std::numbers::pi * t);
      const Expr q1 = diode(U(3) - U(5) - U(7) - in2), q2 = diode(-U(4) + U(6) - U(7) - in2),
                 q3 = diode(U(4) + U(5) + U(7) + in2), q4 = diode(-U(3) - U(6) + U(7) + in2);
      return equations({1.6e-8 * dU(1) - (I(1) - 0.5 * I(3) + 0.5 * I(4) + I(7) - U(1) / 25e3),
                        1.6e-8 * dU(2) - (I(2) - 0.5 * I(5) + 0.5 * I(6) + I(8) - U(2) / 25e3),
                        small * dU(3) - (I(3) - q1 + q4), small * dU(4) - (-I(4) + q2 - q3),
                        small * dU(5) - (I(5) + q1 - q3), small * dU(6) - (-I(6) - q2 + q4),
                        1e-8 * dU(7) - (-U(7) / 50 + q1 + q2 - q3 - q4), 4.45 * dI(1) + U(1),
                        4.45 * dI(2) + U(2), 5e-4 * dI(3) - (0.5 * U(1) - U(3) - 17.3 * I(3)),
                        5e-4 * dI(4) - (-0.5 * U(1) + U(4) - 17.3 * I(4)),
                        5e-4 * dI(5) - (0.5 * U(2) - U(5) - 17.3 * I(5)),
                        5e-4 * dI(6) - (-0.5 * U(2) + U(6) - 17.3 * I(6)),
                        2e-3 * dI(7) - (-U(1) + in1 - 86.3 * I(7)),
                        2e-3 * dI(8) - (-U(2) - 636.3 * I(8))});
    });
  };
  check("index 2", modulator(0.0), zeros(15), Verdict::regular,
        {{15, 11}, {11, 10}, {10, 10}, {10, 10}});
  check("with capacitors", modulator(1e-9), zeros(15), Verdict::regular, {{15, 15}, {15, 15}});
}

// The transistor amplifier (Rentrop 1989): three of eight equations are algebraic. From zeros the
// search meets exponentials of 100 and ends far off; what it finds there must not be called certain.
BOOST_AUTO_TEST_CASE(transistor_amplifier) {
  const auto amplifier = flat(8, 0, 8, [](V x, V v, V, T t) {
    const auto f = [](const Expr& u) { return 1e-6 * (exp(u / 0.026) - 1); };
    const Expr one = f(x[1] - x[2]), two = f(x[4] - x[5]);
    return equations(
        {(0.4 * sin(200 * std::numbers::pi * t) - x[0]) / 1000 + 1e-6 * (v[1] - v[0]),
         (6 - 2 * x[1]) / 9000 - 0.01 * one + 1e-6 * (v[0] - v[1]), one - x[2] / 9000 - 2e-6 * v[2],
         (6 - x[3]) / 9000 - 0.99 * one + 3e-6 * (v[4] - v[3]),
         (6 - 2 * x[4]) / 9000 - 0.01 * two + 3e-6 * (v[3] - v[4]), two - x[5] / 9000 - 4e-6 * v[5],
         (6 - x[6]) / 9000 - 0.99 * two + 5e-6 * (v[7] - v[6]),
         -x[7] / 9000 + 5e-6 * (v[6] - v[7])});
  });
  const Dimensions expected = {{8, 5}, {5, 5}, {5, 5}};
  check("as published", amplifier, at({0, 3, 3, 6, 3, 3, 6, 0}), Verdict::regular, expected);
  const ConstraintLadder far = certificate(amplifier, zeros(8));
  BOOST_TEST((is_right(far, Verdict::regular, expected) || far.is_ambiguous()));
}

// p_y = 0, then a power of what should vanish: L = ½ e^y x'² gives p_x² = 0 (Henneaux, Teitelboim
// 1992), L = x' z' + y z³/3 gives z³ = 0.
BOOST_AUTO_TEST_CASE(constraints_that_are_powers) {
  check("square", lagrangian(2, [](V q, V w, T) { return 0.5 * exp(q[1]) * square(w[0]); }),
        at({0.3, 0.2, 0, 0}), Verdict::rank_change, {});
  check("cube",
        lagrangian(3, [](V q, V w, T) { return w[0] * w[2] + q[1] * q[2] * square(q[2]) / 3.0; }),
        at({0.3, 0.2, 0, 0.4, 0, 0.5}), Verdict::rank_change, {});
}

// x' = y with x = y³/3 - y: at the fold y = 1 the motion ends (Rabier, Rheinboldt 2002), since (y² - 1) y' = y. Beside
// it is a point with a velocity of 10⁵, of which nothing is wrong but that it was not meant.
BOOST_AUTO_TEST_CASE(an_impasse_is_not_called_regular) {
  const auto fold = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], x[0] - square(x[1]) * x[1] / 3 + x[1]});
  });
  const ConstraintLadder at_fold = certificate(fold, at({-2.0 / 3, 1}));
  BOOST_TEST((at_fold.verdict != Verdict::regular || at_fold.is_ambiguous()));
  check("before it", fold, at({0, 0.5}), Verdict::regular, {{2, 1}, {1, 1}, {1, 1}});
}

// Linear in x with coefficients of t: the pencil of the matrices at an instant is regular for the first,
// of which every x = c(t) (t, 1) is a solution, and singular for the second, which has one
// (Campbell 1980; Kunkel, Mehrmann 2006, examples 3.1 and 3.2). The third is of index 2
// though its pencil has index 1 (Gear, Petzold 1984).
BOOST_AUTO_TEST_CASE(pencils_that_mislead) {
  check("no solution is the only one",
        flat(2, 0, 2,
             [](V x, V v, V, T t) {
               return equations({t * t * v[1] - t * v[0] + x[0], t * v[1] - v[0] + x[1]});
             }),
        {.t = 1.0, .x = VectorXd::Constant(2, 0.3)}, Verdict::gauge, {{2, 1}, {2, 1}});
  check("one solution",
        flat(2, 0, 2,
             [](V x, V v, V, T t) {
               return equations({t * x[1] - x[0] + sin(t), v[0] - t * v[1] - cos(2 * t)});
             }),
        at({0, 0}), Verdict::regular, {{2, 1}, {1, 0}, {0, 0}, {0, 0}});
  check(
      "index 2",
      flat(2, 0, 2,
           [](V x, V v, V, T t) {
             return equations({x[0] - 0.5 * t * x[1] - sin(t), v[0] - 0.5 * t * v[1] + 0.5 * x[1]});
           }),
      at({0, 0}), Verdict::regular, {{2, 1}, {1, 0}, {0, 0}, {0, 0}});
}

// x² + y² = 1 and its double, from 10⁻⁸: the second has no linear part in any unit that these numbers
// tell, and the zeros are 10⁸ of them away.
BOOST_AUTO_TEST_CASE(a_rod_held_twice_from_small_numbers) {
  const auto pendulum = flat(4, 2, 6, [](V x, V v, V z, T) {
    const Expr g = square(x[0]) + square(x[1]) - 1, force = z[0] + 2 * z[1];
    return equations({v[0] - x[2], v[1] - x[3], v[2] + force * x[0], v[3] + force * x[1] + 9.81, g,
                      2 * g + square(g)});
  });
  check("from 10⁻⁸", pendulum, at({6e-9, -8e-9, 1e-9, 3e-9}), Verdict::regular,
        {{4, 3}, {3, 2}, {2, 2}, {2, 2}});
}

// A slider crank at rest with its crank upright, where the angle π/2 leaves a cosine of 6·10⁻¹⁷ and the
// slider moves with it.
BOOST_AUTO_TEST_CASE(a_slider_crank_released_upright) {
  const auto crank = flat(6, 2, 8, [](V x, V v, V z, T) {
    const double a = 0.15, b = 0.3;
    return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5],
                      0.1 * v[3] + a * sin(x[0]) * z[0] - a * cos(x[0]) * z[1],
                      0.2 * v[4] + b * sin(x[1]) * z[0] + b * cos(x[1]) * z[1], v[5] - z[0],
                      a * cos(x[0]) + b * cos(x[1]) - x[2], a * sin(x[0]) + b * sin(x[1])});
  });
  const double right_angle = std::acos(0.0);
  check("upright", crank, at({right_angle, -0.5, 0.26, 0, 0, 0}), Verdict::regular,
        {{6, 4}, {4, 2}, {2, 2}, {2, 2}});
}

// A charge and a flux behind a diode, whose current grows like exp (v / 25 mV): the unit of a flux that is chosen for
// 10 V at the diode is 10¹⁶ of what flows, and the flux that is given no round-off.
BOOST_AUTO_TEST_CASE(a_flux_behind_a_diode_stays) {
  const auto circuit = flat(2, 1, 3, [](V x, V v, V z, T) {
    const Expr current = x[1] / 1e-3;
    return equations({v[0] + current, v[1] - x[0] / 1e-6 + z[0],
                      1e-9 * (exp(z[0] / 0.025852) - 1.0) + 1e-4 * z[0] - current});
  });
  const ConstraintLadder ladder = certificate(circuit, at({1e-5, 1e-4}));
  BOOST_TEST(is_right(ladder, Verdict::regular, {{2, 2}, {2, 2}}));
  BOOST_TEST(ladder.point.x[1] == 1e-4);
}

// t x' = x is x = c t: at t = 0 all of these meet in x = 0, where x' is free for this instant only.
// Bessel's equation t v' + v + t x = 0 is singular there too.
BOOST_AUTO_TEST_CASE(instants_at_which_the_rank_changes) {
  const auto line = flat(1, 0, 1, [](V x, V v, V, T t) { return equations({t * v[0] - x[0]}); });
  check("x = c t at 0", line, at({0}), Verdict::rank_change, {});
  const auto bessel = flat(2, 0, 2, [](V x, V v, V, T t) {
    return equations({v[0] - x[1], t * v[1] + x[1] + t * x[0]});
  });
  check("Bessel at 0", bessel, at({1, 0}), Verdict::rank_change, {});
  InitialGuess later = at({0.4});
  later.t = 0.8;
  check("x = c t at 0.8", line, later, Verdict::regular, {{1, 1}, {1, 1}});
  // Where nothing but the time of a source is new, the instant is as any other.
  const auto driven = flat(2, 0, 2, [](V x, V v, V, T t) {
    return equations({v[0] - x[1], x[0] - 0.25 * square(square(t))});
  });
  check("a given path", driven, at({0, 0}), Verdict::regular, {{2, 1}, {1, 0}, {0, 0}, {0, 0}});
}

// A crane whose load follows a path (Blajer, Kołodziejczyk 2004) from rest, where its rope hangs straight:
// z gives the tension, x the place of the trolley, whose derivatives give its velocity and its force. In
// this order F is found after as many derivatives of the tension, which are not seen in x while the
// rope is straight.
BOOST_AUTO_TEST_CASE(a_crane_from_rest) {
  const auto crane = flat(8, 3, 11, [](V x, V v, V u, T t) {
    const Expr &s = x[0], &l = x[6], across = x[2] - s, path = square(square(t)) * (1 - t / 4) / 4;
    return equations({v[0] - x[1], v[2] - x[3], v[4] - x[5], v[6] - x[7],
                      10 * v[1] - u[0] - u[2] * across / l, 100 * v[3] + u[2] * across / l,
                      100 * v[5] - 981 + u[2] * x[4] / l, 10 * v[7] - u[2] + u[1], x[2] - path,
                      x[4] - 4 + square(square(t)) / 10,
                      square(l) - square(across) - square(x[4])});
  });
  const Dimensions expected = {{8, 5}, {5, 2}, {2, 1}, {1, 0}, {0, 0}, {0, 0}};
  check("at rest", crane, at({0, 0, 0, 0, 4, 0, 4, 0}), Verdict::regular, expected);
  InitialGuess moving = at({0.1, 0.6, 0, 0, 4, 0, 4, 0});
  moving.t = 0.3;
  check("moving", crane, moving, Verdict::regular, expected);
  const ConstraintLadder rest = certificate(crane, at({0, 0, 0, 0, 4, 0, 4, 0}));
  const ConstraintLadder later = certificate(crane, moving);
  BOOST_TEST(rest.differentiations[6] == 2);  // of the tension
  BOOST_TEST(rest.differentiations == later.differentiations, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
