#include "courant/running/observer.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant::test {
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

// H contains the unknown z, whose slope counts too; v it does not contain, and the field it is not asked for.
BOOST_AUTO_TEST_CASE(what_an_energy_consists_of) {
  const Problem given = problem(Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "y"], "unknowns": ["z"],
      "equations": ["x' - y", "y' + z", "z - 3*x"], "energy": "x^3 + x*y + 2*y*z" },
    "initial": { "x": 0.5, "y": -2 }
  })json"));
  Observer observer(given.experiment, given.ladder, Backend::interpreter);
  const std::vector<EnergyTerms> terms = observer.energy_terms(given.ladder.point);
  BOOST_TEST_REQUIRE(terms.size() == 2u);
  BOOST_TEST((terms[0].numbers == Eigen::Vector2d(0.5, -2.0)));
  BOOST_TEST((terms[0].slopes - Eigen::Vector2d(0.75 - 2.0, 0.5 + 3.0)).norm() < 1e-14);
  BOOST_TEST_REQUIRE(terms[1].numbers.size() == 1);
  BOOST_TEST(std::fabs(terms[1].numbers[0] - 1.5) < 1e-14);
  BOOST_TEST(std::fabs(terms[1].slopes[0] + 4.0) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
