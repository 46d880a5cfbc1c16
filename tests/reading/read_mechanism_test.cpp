#include <boost/test/unit_test.hpp>

#include "experiment_problems.hpp"

// Mistakes that these cases have to notice:
//  * a check is left out, or tells another place (reading/mechanism_parts.cpp)
//  * names of one mechanism mean two things (reading/read_mechanism.cpp)
//  * cos(pi/2) of a pose is 6e-17 (reading/mechanism_parts.cpp)
BOOST_AUTO_TEST_SUITE(read_mechanism)

using namespace courant;

namespace {

// A rod on a joint, and what hangs on it.
Json two_bodies() {
  return Json::parse(R"({"system": {"type": "mechanism", "gravity": [0, 0, -9.81],
    "bodies": {"rod": {"mass": 2, "center": [0.1, 0, 0], "inertia": [0.001, 0.01, 0.01, 0, 0, 0], "points": {"tip": [0.2, 0, 0]}},
               "weight": {"mass": 1}},
    "joints": {"A": {"type": "revolute", "parent": "ground", "child": "rod", "axis": [0, 1, 0]},
               "B": {"type": "prismatic", "parent": "rod", "child": "weight", "origin": {"xyz": [0.2, 0, 0]}}}},
    "initial": {"A": 0, "B": 0}, "method": "discretize-first", "time": {"step": 0.1, "end": 1}})");
}

// With another value at a place; what is wrong then.
std::string with(const std::string& pointer, const char* value) {
  Json experiment = two_bodies();
  experiment[Json::json_pointer("/system" + pointer)] = Json::parse(value);
  return problems(experiment);
}

Json in_plane() {
  return Json::parse(R"({"system": {"type": "mechanism", "plane": true, "gravity": [0, -9.81],
    "bodies": {"rod": {"mass": 2, "center": [0.1, 0], "inertia": 0.01}},
    "joints": {"A": {"type": "revolute", "parent": "ground", "child": "rod", "origin": [0, 0, 0.3]}}},
    "initial": {"A": 0}, "method": "discretize-first", "time": {"step": 0.1, "end": 1}})");
}
std::string with_in_plane(const std::string& pointer, const char* value) {
  Json experiment = in_plane();
  experiment[Json::json_pointer("/system" + pointer)] = Json::parse(value);
  return problems(experiment);
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_right_is_read) {
  BOOST_TEST(problems(two_bodies()) == "");
  BOOST_TEST(problems(in_plane()) == "");
  BOOST_TEST(with("/joints/A/torque", R"("0.1*sin(t) - A' + rod.tip.z + rod.w[1]")") == "");
  BOOST_TEST(with("/joints/A/damping", R"([0.1])") == "");
  BOOST_TEST(with("/springs", R"({"s": {"from": "rod.tip", "to": "weight", "stiffness": 3}})") ==
             "");
  BOOST_TEST(with("/springs", R"({"s": {"from": "rod", "to": [1, 0, 0], "stiffness": 3}})") == "");
  BOOST_TEST(with("/forces", R"j([{"at": "rod.tip", "force": ["sin(t)", "A'", "0"]}])j") == "");
  BOOST_TEST(with("/bodies/rod/inertia", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]") == "");
  BOOST_TEST(with("/definitions", R"j({"load": "norm(f_A)"})j") == "");
}

BOOST_AUTO_TEST_CASE(bodies_that_cannot_be_are_told) {
  BOOST_TEST(with("/bodies/rod/mass", "-1") ==
             "/system/bodies/rod/mass: is -1; expected at least 0");
  BOOST_TEST(with("/bodies", "{}")
                 .starts_with("/system/bodies: is an object; expected at least one body"));
  BOOST_TEST(with("/bodies/ground", R"({"mass": 1})") ==
             "/system/bodies/ground: key, column 1: \"ground\" is what does not move; expected "
             "another name");
  BOOST_TEST(with("/bodies/rod/center", "[0, 1]") ==
             "/system/bodies/rod/center: has 2 numbers; expected 3");
  BOOST_TEST(with("/bodies/rod/inertia", "[1, 2, 3]") ==
             "/system/bodies/rod/inertia: is an array; expected [xx, yy, zz, xy, xz, yz], or a 3 "
             "x 3 matrix");
  BOOST_TEST(with("/bodies/rod/inertia", "[1, 1, 3, 0, 0, 0]") ==
             "/system/bodies/rod/inertia: has the principal moments 1, 1 and 3; expected none "
             "that is larger than the "
             "sum of the others");
  BOOST_TEST(with("/bodies/rod/inertia", "[1, 1, 1, 2, 0, 0]") ==
             "/system/bodies/rod/inertia: has the principal moment -1; expected at least 0");
  BOOST_TEST(with("/bodies/rod/inertia", "[[1, 1, 0], [0, 1, 0], [0, 0, 1]]") ==
             "/system/bodies/rod/inertia: is not symmetric; expected a matrix of inertia");
  BOOST_TEST(
      with("/bodies/rod/points/x", "[0, 0, 0]") ==
      "/system/bodies/rod/points/x: key, \"rod.x\" is of the body itself; expected another name");
  BOOST_TEST(with("/bodies/rod/masse", "1") ==
             "/system/bodies/rod/masse: unknown key (did you mean \"mass\"?)");
  BOOST_TEST(with("/bodies/weight", "{}") == "/system/bodies/weight/mass: is missing");
  BOOST_TEST(with("/bodies/rod/mass", R"("mm")") ==
             "/system/bodies/rod/mass: column 1: unknown name \"mm\"");
}

BOOST_AUTO_TEST_CASE(joints_that_cannot_be_are_told) {
  BOOST_TEST(with("/joints/A/axis", "[0, 0, 0]") ==
             "/system/joints/A/axis: is zero; expected a direction");
  BOOST_TEST(with("/joints/A/parent", R"("weigth")") ==
             "/system/joints/A/parent: unknown body \"weigth\" (did you mean \"weight\"?)");
  BOOST_TEST(with("/joints/B/child", R"("rod")") ==
             "/system/joints/B: connects a body with itself; expected two bodies");
  BOOST_TEST(with("/joints/A/type", R"("revolut")") ==
             "/system/joints/A/type: unknown \"revolut\" (did you mean \"revolute\"?)");
  BOOST_TEST(with("/joints/A/child_origin", R"({"xyz": [0, 0, 1]})") ==
             "/system/joints/A/child_origin: is of a joint that closes no loop, whose frame is "
             "that of the child; "
             "expected none");
  BOOST_TEST(with("/joints/A/child_origin", R"({"xyz": [0, 0, 0]})") == "");
  BOOST_TEST(with("/joints/B/torque", R"("1")") ==
             "/system/joints/B/torque: drives a joint of type \"prismatic\"; expected the key "
             "\"force\"");
  BOOST_TEST(
      with("/joints/A/damping", "[1, 2]") ==
      "/system/joints/A/damping: has 2 formulas; expected 1, one for each degree of freedom");
  BOOST_TEST(with("/joints/A/rest", "1") ==
             "/system/joints/A/rest: is there without a stiffness; expected both");
  BOOST_TEST(with("/joints/A/axis2", "[0, 0, 1]") ==
             "/system/joints/A/axis2: is of a joint of type \"revolute\"; expected a second axis "
             "of universal joints "
             "only");
  BOOST_TEST(with("/joints/A",
                  R"({"type": "universal", "parent": "ground", "child": "rod", "axis": [0, 0, 1],
                                   "axis2": [0, 1, 1]})") ==
             "/system/joints/A/axis2: is not perpendicular to the axis; expected a right angle");
  BOOST_TEST(
      with("/joints/A", R"({"type": "ball", "parent": "ground", "child": "rod", "stiffness": 1})")
          .starts_with("/system/joints/A/stiffness: is of a joint of type \"ball\"; expected "
                       "springs between"));
  BOOST_TEST(with("/joints/A/torque", R"("0.1*a")")
                 .starts_with("/system/joints/A/torque: column 5: unknown name \"a\""));
  BOOST_TEST(with("/joints/A/limit", "1").starts_with("/system/joints/A/limit: unknown key"));
}

BOOST_AUTO_TEST_CASE(joints_that_mimic_others) {
  BOOST_TEST(with("/joints/A/mimic", R"({"joint": "B", "multiplier": "2*pi", "offset": 0.1})") ==
             "");
  BOOST_TEST(with("/joints/A/mimic", R"({"joint": "b"})") ==
             "/system/joints/A/mimic/joint: unknown joint \"b\" (did you mean \"B\"?)");
  BOOST_TEST(with("/joints/A/mimic", R"({"joint": "A"})") ==
             "/system/joints/A/mimic/joint: is the joint itself; expected another one of "
             "\"joints\"");
  BOOST_TEST(with("/joints/A/mimic", R"({"multiplier": 2})") ==
             "/system/joints/A/mimic/joint: is missing");
  BOOST_TEST(with("/joints/A/mimic", R"({"joint": "B", "ratio": 2})")
                 .starts_with("/system/joints/A/mimic/ratio: unknown key"));
  BOOST_TEST(with("/joints/A/mimic", R"({"joint": "B", "multiplier": "k"})") ==
             "/system/joints/A/mimic/multiplier: column 1: unknown name \"k\"");
  BOOST_TEST(
      with(
          "/joints",
          R"({"A": {"type": "revolute", "parent": "ground", "child": "rod", "mimic": {"joint": "B"}},
               "B": {"type": "spherical", "parent": "rod", "child": "weight"}})") ==
      "/system/joints/A/mimic: is about \"B\", whose coordinate is not one of the system; expected "
      "revolute or prismatic joints that close no loop");
  Json absolute = two_bodies();
  absolute["system"]["coordinates"] = "absolute";
  absolute["system"]["bodies"]["weight"]["inertia"] = {1, 1, 1, 0, 0, 0};
  absolute["system"]["joints"]["A"]["mimic"] = {{"joint", "B"}};
  BOOST_TEST(
      problems(absolute) ==
      "/system/joints/A/mimic: is about \"A\", and coordinates are those of bodies; expected "
      "joint coordinates");
}

BOOST_AUTO_TEST_CASE(springs_and_forces_that_cannot_be_are_told) {
  BOOST_TEST(with("/springs", R"({"s": {"from": "rod.tipp", "to": "ground"}})") ==
             "/system/springs/s/from: unknown point \"tipp\" of \"rod\" (did you mean \"tip\"?)");
  BOOST_TEST(with("/springs", R"({"s": {"from": "rod.tip", "to": "rod"}})") ==
             "/system/springs/s: is between two points of one body; expected two bodies, or one "
             "and ground");
  BOOST_TEST(with("/springs", R"({"s": {"from": "rod", "to": "ground", "stiffness": -1}})") ==
             "/system/springs/s/stiffness: is -1; expected at least 0");
  BOOST_TEST(with("/forces", R"([{"at": "rod"}])") ==
             "/system/forces/0: is neither a force nor a torque; expected one of the keys "
             "\"force\" and \"torque\"");
  BOOST_TEST(with("/forces", R"([{"at": "ground", "force": [0, 0, 1]}])") ==
             "/system/forces/0/at: is on the ground, which no force moves; expected a body");
}

BOOST_AUTO_TEST_CASE(a_name_has_one_meaning) {
  BOOST_TEST(with("/parameters", R"({"A": 1})").find("second meaning") != std::string::npos);
  BOOST_TEST(with("/parameters", R"({"V": 1})").find("has a meaning already") != std::string::npos);
  BOOST_TEST(with("/bodies/A", R"({"mass": 1})") == "");  // r_A, R_A are others than A
}

BOOST_AUTO_TEST_CASE(in_a_plane_numbers_are_fewer) {
  BOOST_TEST(with_in_plane("/joints/A/axis", "[0, 1, 0]") ==
             "/system/joints/A/axis: is an array; expected [0, 0, z], in a plane");
  BOOST_TEST(with_in_plane("/joints/A/axis", "[0, 0, 0]") ==
             "/system/joints/A/axis: is zero; expected a direction");
  BOOST_TEST(with_in_plane("/joints/A/origin", "[0, 1]") ==
             "/system/joints/A/origin: is an array; expected [x, y, angle], in a plane");
  BOOST_TEST(with_in_plane("/joints/A/origin", R"({"rpy": [0.1, 0, 0]})") ==
             "/system/joints/A/origin/rpy: is an array; expected [0, 0, z], in a plane");
  BOOST_TEST(with_in_plane("/gravity", "[0, 0, -9.81]") ==
             "/system/gravity: leaves the plane; expected 2 numbers, or 0 as the third");
  BOOST_TEST(with_in_plane("/gravity", "[0]") ==
             "/system/gravity: has 1 numbers; expected 2, in a plane");
  BOOST_TEST(with_in_plane("/joints/A/type", R"("ball")")
                 .starts_with("/system/joints/A/type: is \"ball\"; expected revolute"));
  BOOST_TEST(with_in_plane("/bodies/rod/inertia", "[1, 1]") ==
             "/system/bodies/rod/inertia: is an array; expected a number, about the axis of z");
  BOOST_TEST(
      with_in_plane("/plane", "1").starts_with("/system/plane: is 1; expected true or false"));
}

// A mechanism of space whose numbers lie in the plane is the same one.
BOOST_AUTO_TEST_CASE(in_a_plane_numbers_of_space_are_taken) {
  for (const auto& [place, value] :
       {std::pair("/gravity", "[0, -9.81, 0]"),
        {"/joints/A/axis", "[0, 0, 1]"},
        {"/joints/A/origin", R"({"xyz": [1, 2, 0], "rpy": [0, 0, 0.3]})"},
        {"/bodies/rod/center", "[0.5, 0, 0]"},
        {"/bodies/rod/inertia", "[1, 1, 1, 0, 0, 0]"}})
    BOOST_TEST(with_in_plane(place, value) == "", place);
}

BOOST_AUTO_TEST_SUITE_END()
