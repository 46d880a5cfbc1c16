// What balls prove of ladders, and what they do not.
#include "courant/integrators/certificate/ladder_proof.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/certificate.hpp"
#include "courant/integrators/certificate/certificate_in_digits.hpp"
#include "courant/tests/core/says.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * the Jacobian is that of the midpoint alone (integrators/certificate/ladder_proof.cpp)
//  * a ball counts as mapped into itself without a look
//  * what counts as zero is not looked at
BOOST_AUTO_TEST_SUITE(ladder_proof_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

Certificate proved(const SystemPointer& system, const InitialGuess& guess) {
  return certificate(system, guess, {}, Decider::proof);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_pendulum_is_proved_wholly) {
  const Certificate found = proved(cartesian_pendulum(), at({0.6, -0.8, 0.8, 0.6}));
  BOOST_REQUIRE(found.proof.has_value());
  BOOST_TEST(found.proof->missing == "");
  BOOST_TEST(found.proof->has_point);
  BOOST_TEST(found.proof->zero == 0);
  BOOST_TEST(found.proof->is_whole());
  BOOST_TEST(found.proof->radius < 1e-70);
  // The rank of the Jacobian of level 3: 20 equations, none of which follows from others.
  BOOST_TEST(found.proof->not_zero == 20);
}

// Of every ladder that has solutions there is a point, and what is not zero by digits is not zero.
BOOST_AUTO_TEST_CASE(the_catalogue_has_points_and_pivots) {
  int whole = 0, all = 0;
  for (const KnownLadder& known : catalogue()) {
    const ConstraintLadder found =
        certificate_in_digits(JetEquations(known.problem.system), known.problem.guess,
                              {.metric = known.problem.metric.sparseView()}, Decider::proof);
    BOOST_TEST_CONTEXT(known.name) {
      BOOST_REQUIRE(found.proof.has_value());
      const bool has_solutions =
          found.verdict == Verdict::regular || found.verdict == Verdict::gauge;
      BOOST_TEST((found.proof->missing == "") == has_solutions, found.proof->missing);
      if (!has_solutions) continue;
      BOOST_TEST(found.proof->has_point);
      BOOST_TEST(found.proof->radius < 1e-40);
      ++all;
      whole += found.proof->is_whole() ? 1 : 0;
    }
  }
  BOOST_TEST(all > 40);
  BOOST_TEST(2 * whole > all, whole << " of " << all);
}

// (sin² x + cos² x + a - 1) y' = 0 with a = 1e-65: 128 and 256 bits see a zero that 512 do not.
BOOST_AUTO_TEST_CASE(a_zero_that_is_none_is_seen) {
  const auto system = [](double a) {
    return flat(2, 0, 2, [=](V x, V v, V, T) {
      ExprVector F(2);
      const Expr one = sin(x[0]) * sin(x[0]) + cos(x[0]) * cos(x[0]);
      F << v[0], (one + a - 1.0) * v[1];
      return F;
    });
  };
  const Certificate right = proved(system(1e-3), at({1.0, 0.0}));
  BOOST_TEST(to_string(right.verdict) == "regular");
  BOOST_TEST(right.proof->is_whole(), right.proof->missing);
  const Certificate wrong = proved(system(1e-65), at({1.0, 0.0}));
  BOOST_TEST(to_string(wrong.verdict) == "gauge");
  BOOST_TEST(says(wrong.proof->missing, "A number that counts as zero is not"),
             wrong.proof->missing);
}

// Equations that follow from others: where that takes a theorem no ball proves it.
BOOST_AUTO_TEST_CASE(dependences_are_proved_where_nothing_is_rounded) {
  const auto system = [&](bool by_theorem) {
    return flat(1, 0, 2, [=](V x, V v, V, T) {
      const Expr one = by_theorem ? sin(x[0]) * sin(x[0]) + cos(x[0]) * cos(x[0]) : Expr(2.0);
      ExprVector F(2);
      F << v[0] - x[0], one * (v[0] - x[0]);
      return F;
    });
  };
  const Certificate exact = proved(system(false), at({0.7})),
                    rounded = proved(system(true), at({0.7}));
  for (const Certificate& found : {exact, rounded}) {
    BOOST_TEST(to_string(found.verdict) == "regular");
    BOOST_TEST(found.proof->has_point, found.proof->missing);
    BOOST_TEST(found.proof->missing == "");
  }
  BOOST_TEST(exact.proof->is_whole());
  BOOST_TEST(rounded.proof->zero > 0);
  BOOST_TEST(!rounded.proof->is_whole());
}

// A jet that is not consistent, and no zero near.
BOOST_AUTO_TEST_CASE(a_point_that_is_not_consistent_is_not_proved) {
  const SystemPointer circle = flat(2, 0, 2, [](V x, V v, V, T) {
    ExprVector F(2);
    F << v[0] - x[1], x[0] * x[0] + x[1] * x[1] - 1.0;
    return F;
  });
  const JetEquations equations(circle);
  Jet jet{.k = 0, .t = {}, .y = {3.0, 0.001, 0.001, 0.0}};
  const auto look = [&] {
    return proof(equations, StagedElimination(equations, equations.at(jet.t, jet.y, 0), jet), jet);
  };
  BOOST_TEST(!look().has_point);
  BOOST_TEST(look().missing != "");
  jet.y = {0.6, Digits::written(-0.8), Digits::written(-0.8), 0.0};
  jet.y[0] = Digits::written(0.6);
  BOOST_TEST(look().has_point, look().missing);
  // As near as that a ball around it has a zero, and says how far it may be.
  jet.y[0] = Digits::written(0.6001);
  BOOST_TEST(look().has_point, look().missing);
  BOOST_TEST(look().radius > 1e-5);
  BOOST_TEST(look().radius < 1e-2);
}

BOOST_AUTO_TEST_CASE(a_switch_at_its_edge_is_not_proved) {
  const SystemPointer system =
      flat(1, 0, 1, [](V x, V v, V, T) { return ExprVector::Constant(1, v[0] - abs(x[0]) - 1.0); });
  BOOST_TEST(proved(system, at({0.5})).proof->is_whole());
  BOOST_TEST(says(proved(system, at({0.0})).proof->missing, "edge"));
}

BOOST_AUTO_TEST_CASE(only_who_asks_gets_a_proof) {
  const InitialGuess guess = at({0.6, -0.8, 0.8, 0.6});
  BOOST_TEST(!certificate(cartesian_pendulum(), guess).proof);
  BOOST_TEST(!certificate(cartesian_pendulum(), guess, {}, Decider::digits).proof);
}

BOOST_AUTO_TEST_SUITE_END()
