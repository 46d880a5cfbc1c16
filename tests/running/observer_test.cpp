#include "courant/running/observer.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * what H is made of leaves out the errors of unknowns
//  * small coordinates are rounded next to themselves
//  * terms that cancel are no terms of H
BOOST_AUTO_TEST_SUITE(observer_test)

namespace {

// The largest |constraint[i]| that the row of a state has.
double violation(Observer& observer, const State& state) {
  const VectorXd& row = observer.row(state);
  return row
      .segment(static_cast<Index>(observer.first_constraint()),
               static_cast<Index>(observer.constraint_count()))
      .lpNorm<Eigen::Infinity>();
}

}  // namespace

// The two rolling constraints of a snakeboard are seen through the velocity alone. They give x' and y'
// as well as the momenta do, but not where the axles are parallel, phi = 0: there, too, a state that
// meets the constraints is reported to, and one that does not is not.
BOOST_AUTO_TEST_CASE(constraints_seen_through_velocities_where_axles_are_parallel) {
  const Problem snakeboard = problem(experiment_file("snakeboard"));
  Observer observer(snakeboard.experiment, snakeboard.ladder, Backend::interpreter);
  BOOST_TEST_REQUIRE(observer.constraint_count() == 2u);
  // At theta = 0 the constraints say y' = 0 and theta' = -tan(phi) x'/r.
  for (const double phi : {0.3, 1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 0.0, -1e-9}) {
    const double m = 4.0, r = 0.3, J = 0.04, J0 = 0.02, J1 = 0.008;
    const double speed = 0.5, turn = -std::tan(phi) * speed / r, rotor = 4.0, steer = -0.2;
    State state = snakeboard.ladder.point;
    state.x << 0.1, -0.2, 0.0, 0.7, phi, m * speed, 0.0, (J + J0 + 2.0 * J1) * turn + J0 * rotor,
        J0 * (turn + rotor), 2.0 * J1 * steer;
    BOOST_TEST(violation(observer, state) < 1e-14, phi << ": " << violation(observer, state));
    state.x[6] += 1e-6;
    BOOST_TEST(violation(observer, state) > 1e-7, phi << ": " << violation(observer, state));
    BOOST_TEST(violation(observer, state) < 1e-5, phi << ": " << violation(observer, state));
  }
}

// H contains the unknown z, whose errors count too; v it does not contain, and the field it is not asked for.
// H = 0.125 - 1 - 6; its terms count once for each factor, and an error of x or y is one of the largest, 2.
BOOST_AUTO_TEST_CASE(what_an_energy_is_made_of) {
  const Problem given = problem(Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "y"], "unknowns": ["z"],
      "equations": ["x' - y", "y' + z", "z - 3*x"], "energy": "x^3 + x*y + 2*y*z" },
    "initial": { "x": 0.5, "y": -2 }
  })json"));
  Observer observer(given.experiment, given.ladder, Backend::interpreter);
  const auto [terms, round_off] = observer.energy_sizes(given.ladder.point);
  const double by_factors = 3 * 0.125 + 2 * 1.0 + 2 * 6.0;
  BOOST_TEST(terms > by_factors);
  BOOST_TEST(terms < 1.3 * by_factors);
  // |∂H/∂x| and |∂H/∂y| without cancellation, and ∂H/∂z.
  const double slopes = (0.75 + 2.0) * 2.0 + (0.5 + 3.0) * 2.0 + 4.0 * 1.5;
  constexpr double rounding = 4 * 2.220446049250313e-16;
  BOOST_TEST(round_off > rounding * slopes);
  BOOST_TEST(round_off < 1.3 * rounding * slopes);
}

// E = Σ v ∂L/∂v - L of a Lagrangian of the first degree in v is 0, as all its slopes are: its terms are not.
BOOST_AUTO_TEST_CASE(an_energy_that_cancels_is_made_of_terms_all_the_same) {
  const Problem given = problem(Json::parse(R"json({
    "system": { "type": "lagrangian", "coordinates": ["s", "x"], "lagrangian": "x'^2/(2*s') - s'*x^2/2" },
    "initial": { "s": 0, "x": 1, "s'": 1, "x'": 0.3 }
  })json"));
  Observer observer(given.experiment, given.ladder, Backend::interpreter);
  const auto [terms, round_off] = observer.energy_sizes(given.ladder.point);
  BOOST_TEST(terms > 0.5);
  BOOST_TEST(terms < 10.0);
  BOOST_TEST(round_off > 1e-16);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
