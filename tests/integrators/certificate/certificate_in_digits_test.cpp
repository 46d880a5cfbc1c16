// The certificate that decides in two precisions: the catalogue, in other orders, coordinates and units that are
// far apart, and what bounds of errors in doubles get wrong.
#include "courant/integrators/certificate/certificate_in_digits.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/certificate.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * numbers that are held are held to digits that a double does not have (integrators/certificate/nearest_jet.cpp)
//  * what nobody gave moves where it need not (integrators/certificate/nearest_jet.cpp)
//  * a switch is doubted whose sides are the same (integrators/certificate/certificate_in_digits.cpp)
//  * a switch is doubted whose sides differ in what no ladder reads, or none whose sides have other ladders
//    (integrators/certificate/certificate_in_digits.cpp)
//  * an unknown that rounding left decides a rank without a word (integrators/certificate/binary_scales.cpp)
BOOST_AUTO_TEST_SUITE(certificate_in_digits_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

Certificate in_digits(const Problem& problem) {
  return certificate_in_digits(JetEquations(problem.system), problem.guess,
                               {.metric = problem.metric.sparseView()});
}

void check_known(const KnownLadder& known, const Certificate& found) {
  BOOST_TEST_CONTEXT(known.name << ": " << found.reason) {
    BOOST_TEST(to_string(found.verdict) == to_string(known.verdict));
    BOOST_TEST(!found.is_ambiguous());
    if (known.dimensions.empty()) return;
    BOOST_TEST((dimensions(found) == known.dimensions));
    BOOST_TEST(found.index == known.index);
  }
}

// Equations, unknowns and time in units of their own, up to 10³⁰ apart; on Rⁿ.
Problem in_far_units(const Problem& problem, std::mt19937& generator) {
  std::uniform_int_distribution<int> exponent(-30, 30);
  // 10^e as it is written.
  const auto units = [&](Index size) {
    return VectorXd(VectorXd::NullaryExpr(
        size, [&] { return std::stod("1e" + std::to_string(exponent(generator))); }));
  };
  // The decimal number / unit, as a person would write it.
  const auto quotient = [](const VectorXd& numbers, const VectorXd& unit) {
    return VectorXd(VectorXd::NullaryExpr(numbers.size(), [&](Index i) {
      const int e = static_cast<int>(std::lround(-std::log10(unit[i])));
      return std::stod(exact_text(numbers[i]) + "e" + std::to_string(e));
    }));
  };
  const SystemPointer& system = problem.system;
  const VectorXd rows = units(system->equation_count()), x_unit = units(problem.guess.x.size()),
                 z_unit = units(system->auxiliary_size());
  const double time_unit = units(1)[0];
  Problem result = problem;
  result.guess.x = quotient(problem.guess.x, x_unit);
  const MatrixXd metric = problem.metric.size() > 0
                              ? problem.metric
                              : MatrixXd(MatrixXd::Identity(x_unit.size(), x_unit.size()));
  result.metric = x_unit.asDiagonal() * metric * x_unit.asDiagonal();
  result.system = std::make_shared<FormulaSystem>(
      system->manifold(), system->auxiliary_size(), system->equation_count(),
      [=](V x, V v, V z, T t) {
        const ExprVector velocity = constants(x_unit).cwiseProduct(v) / time_unit;
        const ExprVector F =
            system->residual(ExprVector(constants(x_unit).cwiseProduct(x)), velocity,
                             ExprVector(constants(z_unit).cwiseProduct(z)), time_unit * t);
        return ExprVector(constants(rows).cwiseProduct(F));
      });
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_catalogue_is_right_and_undoubted) {
  for (const KnownLadder& known : catalogue()) check_known(known, in_digits(known.problem));
}

BOOST_AUTO_TEST_CASE(order_units_and_coordinates_do_not_matter) {
  std::mt19937 generator(41);
  for (const KnownLadder& known : catalogue()) {
    check_known(known, in_digits(permuted(known.problem, generator)));
    check_known(known, in_digits(scaled(known.problem, generator)));
    check_known(known, in_digits(transformed(known.problem, generator)));
  }
}

// At a consistent point, where no search in doubles is needed.
BOOST_AUTO_TEST_CASE(units_that_are_far_apart_do_not_matter) {
  std::mt19937 generator(30);
  const auto pendulum = cartesian_pendulum();
  for (int i = 0; i < 10; ++i) {
    Problem problem{pendulum, at({0.6, -0.8, 0.4, 0.3})};
    check_known({"pendulum", {}, {{4, 3}, {3, 2}, {2, 2}, {2, 2}}, Verdict::regular, 2},
                in_digits(in_far_units(problem, generator)));
  }
}

// A gauge system of a molecule in SI units, and an electron in a cylinder: from C++ as from an experiment.
BOOST_AUTO_TEST_CASE(molecules_in_si_units) {
  const auto christ_lee = flat(6, 1, 7, [](V x, V v, V z, T) {
    const double M = 1e-27, k = 50;
    return equations({v[0] - x[3] / M + x[2] * x[1], v[1] - x[4] / M - x[2] * x[0], v[2] - z[0],
                      v[3] + k * x[0] + x[2] * x[4], v[4] + k * x[1] - x[2] * x[3],
                      v[5] - (x[3] * x[1] - x[4] * x[0]), x[5]});
  });
  check_known({"Christ-Lee", {}, {{6, 5}, {5, 4}, {5, 4}}, Verdict::gauge, 1},
              certificate(christ_lee, at({7e-11, 3e-11, 1e13, 3.5e-24, 1.5e-24, 0})));
  const auto cylinder = flat(6, 1, 7, [](V x, V v, V z, T) {
    const double M = 9.1e-31, k = 1e-3;
    return equations({v[0] - x[3] / M, v[1] - x[4] / M, v[2] - x[5] / M, v[3] - z[0] * x[0],
                      v[4] - z[0] * x[1], v[5] + k * x[2], square(x[0]) + square(x[1]) - 1e-18});
  });
  check_known({"cylinder", {}, {{6, 5}, {5, 4}, {4, 4}, {4, 4}}, Verdict::regular, 2},
              certificate(cylinder, at({1e-9, 0, 0, 0, 0, 0})));
}

// x = t gives y = x' = 1, then y' = 0 = -t, which holds at t = 0 only.
BOOST_AUTO_TEST_CASE(what_holds_at_an_instant_only_is_inconsistent) {
  const auto system = flat(2, 0, 3, [](V x, V v, V, T t) {
    return equations({v[0] - x[1], v[1] + x[0], x[0] - t});
  });
  const Certificate found = certificate(system, at({0, 1}));
  BOOST_TEST(to_string(found.verdict) == "inconsistent");
  BOOST_TEST(!found.is_ambiguous());
  BOOST_TEST(found.reason.find("at this instant") != std::string::npos, found.reason);
  BOOST_TEST(found.levels.back().is_empty);
}

BOOST_AUTO_TEST_CASE(a_residual_that_stays_is_inconsistent) {
  const auto sphere = flat(3, 0, 1, [](V x, V, V, T) {
    return equations({square(x[0]) + square(x[1]) + square(x[2]) + 1});
  });
  BOOST_TEST(to_string(certificate(sphere, at({0, 0, 0})).verdict) == "inconsistent");
  const auto rods = flat(2, 0, 2, [](V x, V, V, T) {
    const Expr square_length = square(x[0]) + square(x[1]);
    return equations({square_length - 1, square_length - 1.0000000001});
  });
  const Certificate contradiction = certificate(rods, at({0.6, -0.8}));
  BOOST_TEST((contradiction.verdict == Verdict::inconsistent || contradiction.is_ambiguous()));
}

BOOST_AUTO_TEST_CASE(a_switch_at_its_edge_is_doubted_and_says_both_sides) {
  const auto friction = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + sign(x[1]) - 0.5});
  });
  const Certificate at_rest = certificate(friction, at({0, 0}));
  BOOST_TEST_REQUIRE(at_rest.doubts.size() == 1u);
  BOOST_TEST(to_string(at_rest.doubts[0].kind) == "switch");
  BOOST_TEST(at_rest.doubts[0].text.find("above the edge") != std::string::npos);
  BOOST_TEST(!certificate(friction, at({0, 1})).is_ambiguous());
}

// x |x| bends at 0 in its second derivative alone.
BOOST_AUTO_TEST_CASE(a_switch_whose_sides_are_the_same_is_none) {
  const auto smooth =
      flat(1, 0, 1, [](V x, V v, V, T) { return equations({v[0] - x[0] * abs(x[0])}); });
  check_known({"smooth", {}, {{1, 1}, {1, 1}}, Verdict::regular, 0}, certificate(smooth, at({0})));
}

// v |v| and max(x, 0)² have second derivatives that jump at 0, which a ladder reads only where it differentiates the
// equation that they are in: that of the pendulum differentiates its length twice, and the drag not at all.
BOOST_AUTO_TEST_CASE(a_switch_that_is_smooth_enough_is_none) {
  const auto fall = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + 9.81 + 0.1 * x[1] * abs(x[1])});
  });
  check_known({"fall", {}, {{2, 2}, {2, 2}}, Verdict::regular, 0}, certificate(fall, at({10, 0})));
  const auto inertance =
      flat(1, 0, 1, [](V x, V v, V, T) { return equations({v[0] + x[0] * abs(x[0]) - 1}); });
  check_known({"inertance", {}, {{1, 1}, {1, 1}}, Verdict::regular, 0},
              certificate(inertance, at({0})));
  const auto contact =
      flat(1, 0, 1, [](V x, V v, V, T) { return equations({v[0] - 1 + square(max(x[0], 0))}); });
  check_known({"contact", {}, {{1, 1}, {1, 1}}, Verdict::regular, 0},
              certificate(contact, at({0})));
  const auto pendulum = flat(4, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0] + 0.1 * x[2] * abs(x[2]),
                      v[3] + z[0] * x[1] + 1 + 0.1 * x[3] * abs(x[3]),
                      square(x[0]) + square(x[1]) - 1});
  });
  check_known({"pendulum", {}, {{4, 3}, {3, 2}, {2, 2}, {2, 2}}, Verdict::regular, 2},
              certificate(pendulum, at({0.6, -0.8, 0, 0})));
}

BOOST_AUTO_TEST_CASE(a_switch_whose_sides_differ_to_first_order_is_doubted) {
  const auto is_doubted = [](const auto& formulas, Index size, const InitialGuess& guess) {
    const Certificate found = certificate(flat(size, 0, size, formulas), guess);
    return std::ranges::any_of(
        found.doubts, [](const Doubt& doubt) { return doubt.kind == Doubt::Kind::at_switch; });
  };
  // Slopes jump: |x| + |y| = 1 at a corner, max(x, 2x).
  BOOST_TEST(is_doubted(
      [](V x, V v, V, T) {
        return equations({v[0] - x[1], abs(x[0]) + abs(x[1]) - 1});
      },
      2, at({0, 1})));
  BOOST_TEST(is_doubted([](V x, V v, V, T) { return equations({v[0] - max(x[0], 2 * x[0])}); }, 1,
                        at({0})));
  // y = x |x| with x' = 1, y' = 2x: on the right side it is what these lead to, on the left one it contradicts them.
  const auto one_sided = flat(2, 0, 3, [](V x, V v, V, T) {
    return equations({v[0] - 1, v[1] - 2 * x[0], x[1] - x[0] * abs(x[0])});
  });
  BOOST_TEST(certificate(one_sided, at({0, 0})).is_ambiguous());
  // y = x |x| as a constraint of second order, passed at speed 1: the force jumps from 2 to -2.
  const auto bent = flat(4, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + 2 * z[0] * abs(x[0]), v[3] - z[0] + 1,
                      x[1] - x[0] * abs(x[0])});
  });
  BOOST_TEST(certificate(bent, at({0, 0, 1, 0})).is_ambiguous());
}

// The cosine and the sine of 0.4 are on the circle as far as doubles are, and are held.
BOOST_AUTO_TEST_CASE(doubles_that_are_held_are_as_exact_as_they_are) {
  InitialGuess guess = at({std::cos(0.4), -std::sin(0.4), 0, 0});
  guess.hold_x = {0, 1, 2, 3};
  const Certificate found = certificate_in_digits(JetEquations(cartesian_pendulum()), guess);
  check_known({"pendulum", {}, {{4, 3}, {3, 2}, {2, 2}, {2, 2}}, Verdict::regular, 2}, found);
  BOOST_TEST(found.moves.empty());
}

// Of x' = y, y' = -x only x is given: y stays 0, though x' could give way as well.
BOOST_AUTO_TEST_CASE(what_nobody_gave_stays_if_it_can) {
  const auto oscillator = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + x[0]});
  });
  MatrixXd given = MatrixXd::Zero(2, 2);
  given(0, 0) = 1.0;
  InitialGuess guess = at({1, 0});
  guess.v = VectorXd{{0.3, 0.0}};
  const Certificate found =
      certificate_in_digits(JetEquations(oscillator), guess, {.metric = given.sparseView()});
  BOOST_TEST(found.point.x[0] == 1.0);
  BOOST_TEST(found.point.x[1] == 0.0);
}

// x' + f_1 = 0 with f of a chain of springs sinh(f_i) in 300 pieces: one solution through each x.
BOOST_AUTO_TEST_CASE(long_chains_with_exponentials) {
  constexpr Index n = 300;
  const auto chain = flat(1, n, n + 1, [](V x, V v, V z, T) {
    ExprVector F(n + 1);
    const double stiffness = static_cast<double>(n * n);
    F[n] = v[0] + z[0];
    for (Index i = 0; i < n; ++i) {
      const Expr before = i == 0 ? Expr(0.0) : z[i - 1], after = i == n - 1 ? z[i] : z[i + 1];
      F[i] = (before - 2 * z[i] + after) * stiffness - sinh(z[i]);
    }
    F[0] += x[0];
    return F;
  });
  check_known({"chain", {}, {{1, 1}, {1, 1}}, Verdict::regular, 0},
              certificate(chain, at({1}), {}, Decider::digits));
}

// Twice (sin² + cos² - 1) is no term, and a third of a coordinate is one.
BOOST_AUTO_TEST_CASE(terms_that_are_zero_but_for_rounding_are_none) {
  const auto system = flat(4, 1, 5, [](V x, V v, V z, T) {
    const Expr a = x[0] + 0.3;
    return equations({v[0] - x[2] + (square(sin(a)) + square(cos(a)) - 1) * x[3], v[1] - x[3],
                      v[2] - z[0] * x[0], v[3] - z[0] * x[1] + 1, square(x[0]) + square(x[1]) - 1});
  });
  check_known({"pendulum", {}, {{4, 3}, {3, 2}, {2, 2}, {2, 2}}, Verdict::regular, 2},
              certificate(system, at({0.6, -0.8, 0.4, 0.3})));
  const auto third = flat(2, 0, 2, [](V x, V, V, T) {
    return equations({1.0 / 3 * x[0] - x[1], x[0] - 3 * x[1]});
  });
  BOOST_TEST(certificate(third, at({0, 0})).degrees_of_freedom == 1);
}

BOOST_AUTO_TEST_CASE(what_was_typed_stays_where_it_is_consistent) {
  const Certificate found = certificate(cartesian_pendulum(), at({0.6, -0.8, 0.4, 0.3}));
  BOOST_TEST(found.point.x[0] == 0.6);
  BOOST_TEST(found.point.x[1] == -0.8);
  BOOST_TEST(found.moved == 0.0);
  BOOST_TEST(found.moves.empty());
}

BOOST_AUTO_TEST_SUITE_END()
