#include "courant/tests/extensions/robots/robots.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a pose is taken relative to the model where it says another frame
//  * an axis of SDF 1.4 is taken in the frame of the joint
//  * the frame of a body is that of its link, not that of the joint it hangs on
//  * a link that hangs on nothing is fixed
BOOST_AUTO_TEST_SUITE(sdf_test)

namespace {

std::string sdf_text(const std::string& inside, const std::string& version = "1.7") {
  return "<sdf version='" + version + "'><model name='m'>\n" + inside + "</model></sdf>\n";
}
std::string sdf_link(const std::string& name, const std::string& inside = "") {
  return "<link name='" + name + "'>" + inside + "<inertial><mass>1</mass></inertial></link>\n";
}
std::string sdf_joint(const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& inside, const std::string& type = "revolute") {
  return "<joint name='" + name + "' type='" + type + "'>" + inside + "<parent>" + parent +
         "</parent><child>" + child + "</child></joint>\n";
}

}  // namespace

// The loop closes where the coupler meets the rocker, which hangs on the ground by D.
BOOST_AUTO_TEST_CASE(four_bars) {
  const Json experiment = robot_in("four_bar.sdf"), system = experiment.at("system");
  BOOST_TEST(experiment.at("time").at("step") == 0.002);
  require_entries(system.at("gravity"), {0.0, 0.0, -9.81});
  std::vector<std::string> joints;
  for (const auto& [name, entry] : system.at("joints").items()) joints.push_back(name);
  BOOST_TEST((joints == std::vector<std::string>{"A", "D", "B", "C"}));
  const Json& D = system.at("joints").at("D");
  require_entries(D.at("origin").at("xyz"), {2.0, 0.0, 0.0});
  BOOST_TEST(!D.contains("child_origin"));
  require_entries(system.at("bodies").at("rocker").at("center"), {0.3, 0.0, 0.4});
  const Json& C = system.at("joints").at("C");
  require_entries(C.at("origin").at("xyz"), {2.0, 0.0, 0.0});
  require_entries(C.at("child_origin").at("xyz"), {0.6, 0.0, 0.8});
}

BOOST_AUTO_TEST_CASE(a_body_that_hangs_on_nothing_is_free) {
  const Json system = robot_in("free_body.sdf").at("system");
  require_entries(system.at("gravity"), {0.0, 0.0, 0.0});
  const Json& joint = system.at("joints").at("brick_joint");
  BOOST_TEST(joint.at("type") == "floating");
  require_entries(joint.at("origin").at("xyz"), {1.0, 2.0, 4.0});
  require_entries(joint.at("origin").at("rpy"), {0.0, 0.0, "pi/2"});
}

// The link is turned by a quarter about x, so that the y axis of the model is its -z axis.
BOOST_AUTO_TEST_CASE(frames_of_axes) {
  const auto axis = [](const std::string& inside, const std::string& version) {
    const Json system =
        import_robot(sdf_text(sdf_link("a", "<pose degrees='true'>0 0 0 90 0 0</pose>") +
                                  sdf_joint("j", "world", "a", "<axis>" + inside + "</axis>"),
                              version))
            .at("system");
    return system.at("joints").at("j").at("axis");
  };
  require_entries(axis("<xyz>0 1 0</xyz>", "1.7"), {0.0, 1.0, 0.0});
  require_entries(axis("<xyz expressed_in='__model__'>0 1 0</xyz>", "1.7"), {0.0, 0.0, -1.0});
  require_entries(axis("<xyz>0 1 0</xyz>", "1.4"), {0.0, 0.0, -1.0});
  require_entries(axis("<xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame>", "1.5"),
                  {0.0, 0.0, -1.0});
}

BOOST_AUTO_TEST_CASE(frames_given_in_each_other) {
  const std::string text = "<frame name='f' attached_to='a'><pose>0 0 1 0 0 0</pose></frame>\n" +
                           sdf_link("a", "<pose>1 0 0 0 0 0</pose>") +
                           sdf_link("b", "<pose relative_to='f'>0 1 0 0 0 0</pose>") +
                           sdf_joint("j", "world", "f", "<axis><xyz>0 1 0</xyz></axis>") +
                           sdf_joint("k", "a", "b", "<axis><xyz>0 1 0</xyz></axis>");
  const Json system = import_robot(sdf_text(text)).at("system");
  // j is at f, which moves with a: the frame of the body is there.
  require_entries(system.at("joints").at("j").at("origin").at("xyz"), {1.0, 0.0, 1.0});
  require_entries(system.at("bodies").at("a").at("center"), {0.0, 0.0, -1.0});
  require_entries(system.at("joints").at("k").at("origin").at("xyz"), {0.0, 1.0, 0.0});
}

BOOST_AUTO_TEST_CASE(joints_of_other_types) {
  const std::string axes =
      "<axis><xyz>0 0 1</xyz><dynamics><damping>0.5</damping></dynamics></axis>"
      "<axis2><xyz>1 0 0</xyz><dynamics><damping>0.5</damping></dynamics></axis2>";
  const Json system =
      import_robot(sdf_text(sdf_link("a") + sdf_link("b") + sdf_link("c") +
                            sdf_joint("u", "world", "a", axes, "universal") +
                            sdf_joint("s", "a", "b", "", "ball") +
                            sdf_joint("p", "a", "c",
                                      "<axis><xyz>0 0 2</xyz><dynamics><spring_stiffness>7"
                                      "</spring_stiffness><spring_reference>0.25</spring_reference>"
                                      "</dynamics></axis>",
                                      "prismatic")))
          .at("system");
  const Json& u = system.at("joints").at("u");
  BOOST_TEST(u.at("type") == "universal");
  BOOST_TEST(u.at("damping") == 0.5);
  require_entries(u.at("axis"), {0.0, 0.0, 1.0});
  require_entries(u.at("axis2"), {1.0, 0.0, 0.0});
  BOOST_TEST(system.at("joints").at("s").at("type") == "spherical");
  BOOST_TEST(system.at("joints").at("p").at("stiffness") == 7.0);
  BOOST_TEST(system.at("joints").at("p").at("rest") == 0.25);
}

// A joint that leads to the ground is taken from there, with its axis the other way.
BOOST_AUTO_TEST_CASE(a_joint_whose_child_is_the_ground) {
  const Json system =
      import_robot(sdf_text(sdf_link("a", "<pose>0 0 2 0 0 0</pose>") +
                            sdf_joint("j", "a", "world",
                                      "<pose>0 0 1 0 0 0</pose><axis><xyz>0 1 0</xyz></axis>")))
          .at("system");
  const Json& j = system.at("joints").at("j");
  BOOST_TEST(j.at("parent") == "ground");
  require_entries(j.at("origin").at("xyz"), {0.0, 0.0, 1.0});
  require_entries(j.at("axis"), {0.0, -1.0, 0.0});
  require_entries(system.at("bodies").at("a").at("center"), {0.0, 0.0, 1.0});
}

BOOST_AUTO_TEST_CASE(static_models_are_the_ground) {
  const std::string text =
      "<sdf version='1.7'><world name='w'><model name='wall'><static>true</static>" +
      sdf_link("stone") + "</model><model name='m'>" + sdf_link("a") + "</model>" +
      sdf_joint("j", "wall::stone", "m::a", "<axis><xyz>0 1 0</xyz></axis>") + "</world></sdf>";
  const Json system = import_robot(text).at("system");
  BOOST_TEST(system.at("bodies").size() == 1u);
  BOOST_TEST(system.at("joints").at("j").at("parent") == "ground");
  BOOST_TEST(system.at("joints").at("j").at("child") == "m__a");
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_by_line) {
  const auto refused = [](const std::string& inside, const std::string& expected) {
    BOOST_TEST(problem_of_robot(sdf_text(inside)) == expected);
  };
  refused("", "line 1: <sdf> has no <link> in its models; expected at least one");
  refused(sdf_link("a") + sdf_joint("j", "world", "a", "", "screw"),
          "line 3: <joint name=\"j\"> has the type \"screw\", which is not supported; expected "
          "revolute, continuous, "
          "prismatic, fixed, ball, universal or revolute2");
  refused(sdf_link("a") + sdf_joint("j", "world", "b", "<axis><xyz>0 1 0</xyz></axis>"),
          "line 3: unknown link or frame \"b\"");
  refused(sdf_link("a", "<pose relative_to='b'>0 0 0 0 0 0</pose>") +
              sdf_link("b", "<pose relative_to='a'>0 0 0 0 0 0</pose>"),
          "line 2: the pose of \"a\" is given in a circle of frames; expected an end of it");
  refused(sdf_link("a") + sdf_link("a"),
          "line 3: there is something called \"a\" already; expected another name");
  refused(sdf_link("a", "<gravity>false</gravity>") + sdf_link("b"),
          "line 2: a link without gravity beside others with it is not supported; expected all "
          "links alike");
  refused(
      "<include><uri>model://arm</uri></include>",
      "line 2: <include> is not supported in a model; expected what it includes to be written out");
  refused(sdf_link("a", "<pose>0 0 0</pose>"),
          "line 2: <pose> has 3 numbers in its text; expected 6");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
