#include "courant/running/observer_elsewhere.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * parts of steps begin without what was dissipated before
BOOST_AUTO_TEST_SUITE(observer_elsewhere_test)

namespace {

// x' = -x of a charged capacitor and a resistor: H = x²/2, and dissipated is what H has lost.
Problem discharge() {
  return problem(Json::parse(R"json({
    "system": { "type": "port-hamiltonian", "coordinates": ["x"], "J": [[0]], "R": [[1]],
      "hamiltonian": "x^2/2" },
    "initial": { "x": 2 }, "method": "discretize-first", "time": { "step": 0.25, "end": 1 }
  })json"));
}

Index place(const Observer& observer, const std::string& name) {
  const auto& names = observer.names();
  return std::ranges::find(names, name) - names.begin();
}

}  // namespace

// Half of the third step: dissipated counts from the beginning of the run, and the observer of the run goes on as
// if nobody had asked.
BOOST_AUTO_TEST_CASE(parts_of_steps_begin_with_what_the_run_knows) {
  const Problem given = discharge();
  const PreparedMethod method = given.prepare("discretize-first", 0.25);
  Observer observer(given.experiment, given.ladder, Backend::interpreter);
  Observer undisturbed(given.experiment, given.ladder, Backend::interpreter);
  ObserverElsewhere elsewhere(given.experiment, given.ladder, observer);
  const Index H = place(observer, "H"), dissipated = place(observer, "dissipated");
  const auto stepper = method.integrator->stepper();
  State state = method.initial;
  observer.begin(state);
  undisturbed.begin(state);
  for (int k = 1; k <= 3; ++k) {
    stepper->step(state, 0.25);
    elsewhere.begin_step();
    const VectorXd whole = elsewhere.row_within(stepper->part(1.0));
    const VectorXd row = elsewhere.row_within(stepper->part(0.5));
    // The midpoint rule keeps this balance of a quadratic H exactly, for a part of a step as well.
    BOOST_TEST(std::fabs(row[H] + row[dissipated] - 2.0) < 1e-13, "step " << k);
    BOOST_TEST(row[H] > whole[H]);
    const VectorXd at_end = observer.advance(stepper->last());
    BOOST_TEST((at_end - whole).lpNorm<Eigen::Infinity>() < 1e-14);
    BOOST_TEST((at_end == undisturbed.advance(stepper->last())));
  }
}

BOOST_AUTO_TEST_CASE(a_state_by_itself_has_no_history) {
  const Problem given = discharge();
  Observer observer(given.experiment, given.ladder, Backend::interpreter);
  ObserverElsewhere elsewhere(given.experiment, given.ladder, observer);
  State state = given.ladder.point;
  state.x[0] = 3.0;
  const VectorXd row = elsewhere.row(state);
  BOOST_TEST(row[place(observer, "H")] == 4.5);
  BOOST_TEST(row[place(observer, "dissipated")] == 0.0);
  // x²/2 changes by x δ with δ = x ε: twice as much as it is, next to itself.
  const EnergySizes sizes = elsewhere.energy_sizes(state);
  BOOST_TEST(sizes.terms > 4.5);
  BOOST_TEST(sizes.terms < 18.0);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
