#include <algorithm>

#include "courant/tests/extensions/robots/robots.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the inertia is not turned from the frame of <inertial> to that of the link
//  * links that are fixed to each other are summed without their distance
//  * an axis keeps its length
//  * a circle of joints is not seen, and the import does not end
BOOST_AUTO_TEST_SUITE(urdf_test)

namespace {

std::string link_text(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
         "iyz='0'/></inertial></link>\n";
}
std::string joint_text(const std::string& name, const std::string& parent, const std::string& child,
                       const std::string& inside = "", const std::string& type = "continuous") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>\n";
}
std::string robot_text(const std::string& inside) {
  return "<robot name='r'>\n" + inside + "</robot>\n";
}

void refused(const std::string& inside, const std::string& expected) {
  BOOST_TEST(problem_of_robot(robot_text(inside)) == expected);
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_rods) {
  const Json system = robot_in("two_rods.urdf").at("system");
  BOOST_TEST(system.at("type") == "mechanism");
  require_entries(system.at("gravity"), {0.0, 0.0, -9.81});
  const Json& fore = system.at("bodies").at("fore");
  BOOST_TEST(system.at("bodies").size() == 2u);
  BOOST_TEST(fore.at("mass") == 2.0);
  require_entries(fore.at("center"), {0.5, 0.0, 0.0});
  require_entries(fore.at("inertia"), {0.001, 1.0 / 6.0, 1.0 / 6.0, 0.0, 0.0, 0.0});
  require_entries(fore.at("points").at("tip"), {1.0, 0.0, 0.0});
  const Json& elbow = system.at("joints").at("elbow");
  BOOST_TEST(elbow.at("type") == "revolute");
  BOOST_TEST(elbow.at("parent") == "upper");
  BOOST_TEST(elbow.at("child") == "fore");
  BOOST_TEST(elbow.at("damping") == 0.1);
  require_entries(elbow.at("origin").at("xyz"), {1.0, 0.0, 0.0});
  require_entries(elbow.at("axis"), {0.0, 1.0, 0.0});
  BOOST_TEST(!elbow.contains("child_origin"));
  BOOST_TEST(system.at("joints").at("shoulder").at("parent") == "ground");
}

BOOST_AUTO_TEST_CASE(inertias_are_turned_and_fixed_links_are_one_body) {
  std::vector<Problem> notes;
  const Json system = robot_in("turned.urdf", &notes).at("system");
  const Json& shoulder = system.at("bodies").at("shoulder");
  require_entries(shoulder.at("center"), {0.1, 0.2, 0.3});
  // A quarter turn about z: xx and yy change places, and xz becomes yz.
  require_entries(shoulder.at("inertia"), {1.5, 1.0, 2.0, 0.0, 0.0, 0.1});
  // arm: turned by 30° about x, yy = 3 cos² + 4 sin² = 3.25, zz = 3.75, yz = (3 - 4) sin cos. hand: a quarter turn about
  // x, (0.1, 0.25, 0.2). Both: 3 kg and 1 kg at a distance of 0.4 m, 3/4 · 0.16 = 0.12.
  const Json& arm = system.at("bodies").at("arm");
  BOOST_TEST(arm.at("mass") == 4.0);
  require_entries(arm.at("center"), {0.1, 0.0, 0.0});
  require_entries(arm.at("inertia"),
                  {2.1, 3.25 + 0.25 + 0.12, 3.75 + 0.2 + 0.12, 0.0, 0.0, -std::sqrt(3.0) / 4.0});
  require_entries(arm.at("points").at("hand"), {0.4, 0.0, 0.0});
  require_entries(arm.at("points").at("tool"), {0.4, 0.0, 0.2});
  const Json& turn = system.at("joints").at("turn");
  require_entries(turn.at("origin").at("rpy"), {0.0, 0.0, "pi/4"});
  require_entries(turn.at("axis"), {0.0, 0.0, 2.0});
  const Json& lift = system.at("joints").at("lift");
  require_entries(lift.at("origin").at("rpy"), {0.3, -0.2, 0.1});
  require_entries(lift.at("axis"), {0.0, 3.0, 4.0});
  BOOST_TEST(lift.at("damping") == 0.7);

  std::vector<std::string> lines;
  for (const Problem& note : notes) lines.push_back(note.line());
  const std::vector<std::string> expected = {
      "line 35: limits of joints are left out: they move beyond them, with any effort and velocity "
      "(here and 1 more "
      "time)",
      "line 43: dry friction of joints is left out",
      "line 2: the root link \"base_link\" is fixed to the ground; a link \"world\" with a joint "
      "of the type floating "
      "to it would let it move",
      "the robot: no file of a robot says how long to go on: the experiment ends at 1 s, which is "
      "`end` of its `time`"};
  BOOST_TEST(lines == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(names_that_formulas_cannot_have) {
  std::vector<Problem> notes;
  const std::string text = robot_text(
      "<link name='world'/>" + link_text("a-b") + link_text("a_b") + link_text("t") +
      link_text("1") + joint_text("sin", "world", "a-b") + joint_text("j.1", "a-b", "a_b") +
      joint_text("j_1", "a_b", "t") + joint_text("j", "t", "1"));
  const Json system = import_robot(text, &notes).at("system");
  std::vector<std::string> names;
  for (const char* part : {"bodies", "joints"})
    for (const auto& [name, entry] : system.at(part).items()) names.push_back(name);
  const std::vector<std::string> expected = {"a_b_2",     "a_b",   "body_t", "body_1",
                                             "joint_sin", "j_1_2", "j_1",    "j"};
  BOOST_TEST(names == expected, boost::test_tools::per_element());
  BOOST_TEST(notes.front().line() == "line 2: the body \"a-b\" is called a_b_2");
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_by_line) {
  const std::string a = link_text("a"), b = link_text("b");
  refused("", "line 1: <robot name=\"r\"> has no <link>; expected at least one");
  refused(a + a, "line 3: there is a link \"a\" already; expected another name");
  refused(a + b + joint_text("j", "a", "c"), "line 4: unknown link \"c\"");
  refused(a + b,
          "line 3: no joint has the link \"b\" as its child, as it is with \"a\"; expected a tree "
          "with one root");
  refused(a + b + joint_text("j", "a", "b") + joint_text("k", "b", "a"),
          "line 2: every link is the child of a joint: joints form a circle; expected a tree with "
          "one root");
  refused(a + b + link_text("c") + joint_text("j", "c", "b") + joint_text("k", "b", "c"),
          "line 5: the link \"b\" hangs on a circle of joints; expected a tree");
  refused(a + b + joint_text("j", "a", "b") + joint_text("k", "a", "b"),
          "line 5: <joint name=\"k\"> has the child \"b\", which is that of the joint \"j\" "
          "already; expected a tree");
  refused(a + b + joint_text("j", "a", "b", "", "helical"),
          "line 4: <joint name=\"j\"> has the type \"helical\"; expected revolute, continuous, "
          "prismatic, fixed, "
          "floating or planar");
  refused(a + b + joint_text("j", "a", "b", "<axis xyz='0 0 0'/>"),
          "line 4: <axis> is zero; expected a direction");
  refused(a + b + joint_text("j", "a", "b", "<axis xyz='0 nan 0'/>"),
          "line 4: <axis> has \"nan\" in xyz; expected a number of at most 1e15");
  refused(a + b + joint_text("j", "a", "b", "<axis xyz='0 1e300 0'/>"),
          "line 4: <axis> has \"1e300\" in xyz; expected a number of at most 1e15");
  refused(a + b + joint_text("j", "a", "b", "<origin xyz='0 0'/>"),
          "line 4: <origin> has 2 numbers in xyz; expected 3");
  refused(a + b + "<joint name='j' type='fixed'><parent link='a'/></joint>",
          "line 4: <joint name=\"j\"> has no <child>; expected one");
  refused(a + "<link name='b'/>\n" + joint_text("j", "a", "b"),
          "line 3: the link \"b\" moves, and neither it nor what hangs on it has a mass; expected "
          "a mass, or a fixed "
          "joint");
  refused(
      "<link name='a'><inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
      "iyz='0'/></inertial></link>",
      "line 2: the mass of the link \"a\" is -1; expected at least 0");
  refused(
      "<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='2' ixz='0' "
      "iyz='0'/></inertial></link>",
      "line 2: a principal moment of inertia of the link \"a\" is -1; expected at least 0");
  refused(
      "<link name='a'><inertial><mass value='1'/><inertia ixx='0' iyy='1' izz='1' ixy='0' ixz='0' "
      "iyz='0'/></inertial></link>\n<link name='world'/>" +
          joint_text("j", "world", "a"),
      "line 2: the link \"a\" turns about an axis through its centre, and has no inertia about it; "
      "expected one");
  refused("<xacro:property name='x' value='1'/>",
          "line 2: <xacro:property name=\"x\"> is of xacro, the macros of URDF; run `xacro "
          "FILE.xacro > FILE.urdf` "
          "first");
  refused(a + b + link_text("c") + joint_text("j", "a", "b", "", "floating") +
              joint_text("k", "a", "c", "<mimic joint='j' multiplier='2'/>"),
          "line 6: couples the joint \"j\"; expected joints of one degree of freedom that close no "
          "loop");
  refused(a + b + link_text("c") + joint_text("j", "a", "b", "", "fixed") +
              joint_text("k", "a", "c", "<mimic joint='j'/>"),
          "line 6: couples the joint \"j\"; expected joints of one degree of freedom that close no "
          "loop");
}

BOOST_AUTO_TEST_CASE(joints_that_mimic_others) {
  const Json system =
      import_robot(
          robot_text(link_text("a") + link_text("b") + link_text("c") +
                     joint_text("left-finger", "a", "b", "<axis xyz='1 0 0'/>", "prismatic") +
                     joint_text("right-finger", "a", "c",
                                "<axis xyz='1 0 0'/><mimic joint='left-finger' "
                                "multiplier='-1' offset='0.02'/>",
                                "prismatic")))
          .at("system");
  BOOST_TEST(!system.at("joints").at("left_finger").contains("mimic"));
  const Json expected = {{"joint", "left_finger"}, {"multiplier", -1.0}, {"offset", 0.02}};
  BOOST_TEST(system.at("joints").at("right_finger").at("mimic") == expected);
}

BOOST_AUTO_TEST_CASE(what_is_no_robot) {
  BOOST_TEST(problem_of_robot("<svg/>") ==
             "line 1: <svg> is the root; expected <robot> (URDF), <sdf> or <mujoco>");
  BOOST_TEST(problem_of_robot("") == "line 1: is no well-formed XML: no document element found");
  BOOST_TEST(problem_of_robot("<robot>\n<link>\n</robot>") ==
             "line 3: is no well-formed XML: start-end tags mismatch");
  BOOST_TEST(problem_of_robot("<robot name='a' name='b'/>") ==
             "line 1: <robot name=\"a\"> has the attribute \"name\" twice");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  for (int i = 0; i < 100'000; ++i) deep += "</a>";
  BOOST_TEST(problem_of_robot(deep) == "line 1: <a> is nested deeper than 1000 elements");
  // Entities are not opened.
  BOOST_TEST(problem_of_robot(
                 "<!DOCTYPE r [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]>\n<robot name='&b;'/>") ==
             "line 2: <robot name=\"&b;\"> has no <link>; expected at least one");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
