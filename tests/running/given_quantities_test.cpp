#include "courant/running/given_quantities.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/consistent_start.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(given_quantities_test)

namespace {

Json circuit(const Json& initial) {
  return {{"system",
           {{"type", "network"},
            {"nodes", {"0", "a", "b", "c"}},
            {"definitions", {{"twice", "2*q_C"}}},
            {"elements",
             {{{"type", "voltage-source"}, {"name", "V"}, {"from", "a"}, {"to", "0"}, {"value", 1}},
              {{"type", "resistor"}, {"name", "R1"}, {"from", "a"}, {"to", "b"}, {"value", 1}},
              {{"type", "inductor"}, {"name", "L"}, {"from", "b"}, {"to", "c"}, {"value", 0.2}},
              {{"type", "capacitor"}, {"name", "C"}, {"from", "c"}, {"to", "0"}, {"value", 3}}}}}},
          {"initial", initial}};
}

VectorXd start(const Json& initial, const Json& hold = nullptr) {
  Json document = circuit(initial);
  if (!hold.is_null()) document["hold"] = hold;
  return consistent_start(read_experiment_document(document)).point.x;
}

}  // namespace

// phi = L i, q = C v; whatever quantity says it.
BOOST_AUTO_TEST_CASE(a_start_is_given_by_what_can_be_observed) {
  for (const Json& initial :
       {Json{{"v_C", 0.5}, {"i_L", 2}}, Json{{"potential_c", 0.5}, {"i_R1", 2}},
        Json{{"twice", 3}, {"potential_b", -1}}, Json{{"q_C", 1.5}, {"v_R1", 2}}}) {
    const VectorXd x = start(initial);
    BOOST_TEST(std::abs(x[0] - 0.4) < 1e-11, initial.dump());
    BOOST_TEST(std::abs(x[1] - 1.5) < 1e-11, initial.dump());
  }
  BOOST_TEST(std::abs(start({{"v_C", 0.5}}, {"v_C"})[1] - 1.5) < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_quantity_that_is_not_kept_is_told) {
  // Two capacitors side by side have one voltage.
  Json document = circuit({{"v_C", 0.5}, {"v_C2", 1.0}});
  document["system"]["elements"].push_back(
      {{"type", "capacitor"}, {"name", "C2"}, {"from", "c"}, {"to", "0"}, {"value", 1}});
  const auto ladder = consistent_start(read_experiment_document(document));
  std::vector<std::string> moved;
  for (const Movement& move : ladder.moves) moved.push_back(move.name);
  BOOST_TEST((std::ranges::find(moved, "v_C2") != moved.end()));
  document["hold"] = {"v_C2", "v_C"};
  BOOST_CHECK_THROW(consistent_start(read_experiment_document(document)), ExperimentError);
  BOOST_CHECK_THROW(start({{"v_Cc", 1}}), ExperimentError);
}

BOOST_AUTO_TEST_CASE(rest_is_no_velocity) {
  const auto point = [](const char* system, const Json& initial) {
    return consistent_start(
               read_experiment_document({{"system", Json::parse(system)}, {"initial", initial}}))
        .point;
  };
  const char* const mechanical =
      R"json({ "type": "mechanical", "coordinates": ["x", "y"], "potential": "y" })json";
  BOOST_TEST(point(mechanical, {{"x", 1}, {"y", 2}, {"rest", true}}).x == (VectorXd{{1, 2, 0, 0}}));
  BOOST_TEST(point(mechanical, {{"x", 1}, {"y", 2}, {"p_x", 3}, {"rest", true}}).x ==
             (VectorXd{{1, 2, 3, 0}}));
  // A velocity by an equation, x' - v.
  const char* const implicit =
      R"json({ "type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["l"],
    "equations": ["x' - v", "y' - w", "v' + l*x", "w' + l*y + 1", "x^2 + y^2 - 1"] })json";
  const auto pendulum = point(implicit, {{"x", 0.6}, {"y", -0.8}, {"rest", true}});
  BOOST_TEST(pendulum.x == (VectorXd{{0.6, -0.8, 0, 0}}));
  BOOST_CHECK_THROW(
      point(R"json({ "type": "implicit", "coordinates": ["x"], "equations": ["x' + x"] })json",
            "rest"),
      ExperimentError);
  // All of a network that is not given is 0.
  BOOST_TEST(start("rest").isZero(0.0));
  // Of a rotation the velocity has three numbers, and its matrix nine.
  const char* const body =
      R"json({ "type": "mechanical", "coordinates": ["R[3][3]"], "manifold": "so3",
    "metric": [1, 2, 3] })json";
  const Json one = Json::parse("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
  BOOST_TEST(point(body, {{"R", one}, {"rest", true}}).x.tail(3).isZero(0.0));
  BOOST_TEST(point(body, {{"R", one}, {"rest", true}, {"p_R", {1, 2, 3}}}).x.tail(3) ==
             (VectorXd{{1, 2, 3}}));
  BOOST_TEST((point(body, {{"R", one}, {"rest", true}, {"v_R", {1, 1, 1}}}).x.tail(3) -
              VectorXd{{1, 2, 3}})
                 .norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
