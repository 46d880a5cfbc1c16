#include "courant/reading/substepping.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/experiment.hpp"
#include "experiment_problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the number of halvings is not read
BOOST_AUTO_TEST_SUITE(substepping)

namespace {

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "parameters": { "T": 0.25 }, "coordinates": ["q"],
              "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 1 }
})json");

Json with(const char* pointer, const Json& value) {
  Json changed = oscillator;
  changed[Json::json_pointer(pointer)] = value;
  return changed;
}

}  // namespace

BOOST_AUTO_TEST_CASE(corners_and_halvings) {
  Json changed = with("/time/corners", {0.3, "T/2", {{"first", "T"}, {"period", 1}}});
  changed["time"]["halvings"] = 4;
  const auto division = read_experiment(changed.dump()).time->division;
  BOOST_TEST_REQUIRE(division.has_value());
  BOOST_TEST(division->halvings == 4);
  BOOST_TEST_REQUIRE(division->corners.size() == 3u);
  BOOST_TEST(division->corners[1].first == 0.125);
  BOOST_TEST(division->corners[1].period == 0.0);
  BOOST_TEST(division->corners[2].first == 0.25);
  BOOST_TEST(division->corners[2].period == 1.0);
  BOOST_TEST(!read_experiment(oscillator.dump()).time->division.has_value());
  BOOST_TEST(!read_experiment(with("/time/halvings", 0).dump()).time->division.has_value());
}

BOOST_AUTO_TEST_CASE(what_is_wrong) {
  BOOST_TEST(problems(with("/time/halvings", -1)) ==
             "/time/halvings: is -1; expected an integer, at least 0");
  BOOST_TEST(problems(with("/time/halvings", 31)) ==
             "/time/halvings: is 31; expected an integer from 0 to 30");
  BOOST_TEST(problems(with("/time/corners", Json::array({Json{{"first", 1}}}))) ==
             "/time/corners/0/period: is missing");
  BOOST_TEST(problems(with("/time/corners", Json::array({Json{{"first", 1}, {"period", 0}}}))) ==
             "/time/corners/0/period: is 0; expected a number greater than 0");
  BOOST_TEST(problems(with("/time/corners", Json::array({"q"}))).find("/time/corners/0: ") == 0u);
  Json transformed = with("/time/corners", {0.5});
  transformed["time"]["transformation"] = "1 + q^2";
  BOOST_TEST(
      problems(transformed) ==
      "/time/corners: are times, but a step in transformed time does not know where it ends; "
      "expected \"corners\" or \"transformation\"");
}

BOOST_AUTO_TEST_CASE(damping) {
  BOOST_TEST(problems(with("/method/damping", "l-stable")) == "");
  BOOST_TEST(read_experiment(with("/method/damping", "l-stable").dump()).method->description ==
             "discretize-first, midpoint, damped");
  Json other = with("/method/damping", "l-stable");
  other["method"]["discretization"] = {{"type", "theta"}, {"theta", 1}};
  BOOST_TEST(
      problems(other) ==
      "/method/damping: is \"l-stable\", which is made of steps of the theta family, theta = "
      "0.414 and 1; expected the discretization \"midpoint\", which these take the place of");
  Json started = with("/method/damping", "l-stable");
  started["method"]["start"] = "rk2";
  BOOST_TEST(problems(started) ==
             "/method/start: is \"rk2\", which is about one step of the midpoint rule; expected "
             "\"on-manifold\" with damping");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
