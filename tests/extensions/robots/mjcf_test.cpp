#include <numbers>
#include <stdexcept>

#include "courant/extensions/robots/mjcf_geom.hpp"
#include "courant/tests/extensions/robots/robots.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * angles are in radians where <compiler> says nothing
//  * a class of defaults does not have what the class around it has
//  * a capsule is a cylinder
//  * the spring of a joint is at rest where springref says, not as far from ref
//  * geoms of a body with an <inertial> have a mass too
BOOST_AUTO_TEST_SUITE(mjcf_test)

namespace {

using std::numbers::pi;

std::string body_text(const std::string& inside) {
  return "<mujoco><worldbody><body name='b'>\n" + inside + "</body></worldbody></mujoco>\n";
}

void refused_model(const std::string& text, const std::string& expected,
                   const IncludedText& included = {}) {
  BOOST_TEST(problem_of_robot(text, included) == expected);
}

// Of a round body of density 1 with this radius at z: mass, moments about its own x and z axes, by slices.
struct Slices {
  double mass = 0.0, across = 0.0, along = 0.0;
  template <typename Radius>
  Slices(double half, const Radius& radius) {
    constexpr int count = 200'000;
    const double dz = 2.0 * half / count;
    for (int i = 0; i < count; ++i) {
      const double z = -half + (i + 0.5) * dz, r2 = radius(z) * radius(z), m = pi * r2 * dz;
      mass += m;
      along += 0.5 * m * r2;
      across += m * (0.25 * r2 + z * z);
    }
  }
};

robots::GeomInertia geom(const std::string& attributes) {
  const robots::Element root = robots::parse_xml("<mujoco><geom " + attributes + "/></mujoco>");
  return robots::geom_inertia(root.children.front(), robots::MjcfDocument(root, {}));
}

void require_slices(const robots::GeomInertia& found, const Slices& slices) {
  const robots::Inertia& inertia = found.inertia;
  BOOST_TEST(std::abs(inertia.mass / slices.mass - 1.0) <= 1e-8);
  BOOST_TEST(std::abs(inertia.about_center(0, 0) / slices.across - 1.0) <= 1e-8);
  BOOST_TEST(std::abs(inertia.about_center(1, 1) / slices.across - 1.0) <= 1e-8);
  BOOST_TEST(std::abs(inertia.about_center(2, 2) / slices.along - 1.0) <= 1e-8);
}

}  // namespace

BOOST_AUTO_TEST_CASE(masses_of_geoms_are_those_of_slices) {
  const auto ball = [](double z) { return std::sqrt(0.09 - z * z); };
  require_slices(geom("size='0.3' density='1'"), Slices(0.3, ball));
  require_slices(geom("type='cylinder' size='0.3 0.5' density='1'"),
                 Slices(0.5, [](double) { return 0.3; }));
  require_slices(geom("type='capsule' size='0.3 0.5' density='1'"), Slices(0.8, [&](double z) {
                   return std::abs(z) < 0.5 ? 0.3 : ball(std::abs(z) - 0.5);
                 }));
  require_slices(geom("type='ellipsoid' size='0.3 0.3 0.6' density='1'"),
                 Slices(0.6, [&](double z) { return ball(0.5 * z); }));
  const robots::Inertia box = geom("type='box' size='0.5 1 1.5' mass='12'").inertia;
  BOOST_TEST((box.about_center.diagonal() - Eigen::Vector3d(13.0, 10.0, 5.0)).norm() <= 1e-14);
  const robots::Inertia rod =
      geom("type='capsule' size='0.3' density='1' fromto='1 0 0 2 0 0'").inertia;
  BOOST_TEST(rod.center[0] == 1.5);
  BOOST_TEST(std::abs(rod.about_center(0, 0) - geom("type='capsule' size='0.3 0.5' density='1'")
                                                   .inertia.about_center(2, 2)) <= 1e-16);
}

// The numbers are worked out beside the file: a capsule of 500 kg/m³ and a box, both with the centre 0.2 m below the hip.
BOOST_AUTO_TEST_CASE(defaults_degrees_and_geoms) {
  std::vector<Problem> notes;
  const Json experiment = robot_in("leg_with_defaults.xml", &notes),
             system = experiment.at("system");
  BOOST_TEST(experiment.at("time").at("step") == 0.005);
  const double cylinder = 500 * pi * 0.0025 * 0.4, balls = 500 * 4.0 / 3.0 * pi * 1.25e-4;
  const double across =
      cylinder * (3 * 0.0025 + 4 * 0.04) / 12 + balls * (0.4 * 0.0025 + 0.04 + 0.75 * 0.05 * 0.2);
  const double along = cylinder * 0.00125 + balls * 0.001;
  const Json& thigh = system.at("bodies").at("thigh");
  BOOST_TEST(std::abs(thigh.at("mass").get<double>() - (24 + cylinder + balls)) <= 1e-13);
  require_entries(thigh.at("center"), {0.0, 0.0, -0.2});
  require_entries(thigh.at("inertia"), {1.04 + across, 0.8 + across, 0.4 + along, 0.0, 0.0, 0.0});
  BOOST_TEST(std::abs(across - 0.03462297) <= 1e-8);
  BOOST_TEST(std::abs(along - 0.00222529) <= 1e-8);
  BOOST_TEST(system.at("bodies").at("thigh_1").at("mass") == 0.0);

  const Json& hip_x = system.at("joints").at("hip_x");
  BOOST_TEST(hip_x.at("child") == "thigh_1");
  BOOST_TEST(hip_x.at("damping") == 0.2);
  require_entries(hip_x.at("origin").at("xyz"), {0.0, 0.0, 2.0});
  require_entries(hip_x.at("origin").at("rpy"), {0.0, 0.0, "pi/2"});
  const Json& hip_y = system.at("joints").at("hip_y");
  BOOST_TEST(hip_y.at("parent") == "thigh_1");
  BOOST_TEST(!hip_y.contains("damping"));
  BOOST_TEST(!hip_y.contains("origin"));
  const Json& knee = system.at("joints").at("knee");
  require_entries(knee.at("origin").at("xyz"), {0.0, 0.0, -0.3});
  require_entries(knee.at("axis"), {0.0, 1.0, 0.0});
  BOOST_TEST(knee.at("stiffness") == 3.0);
  BOOST_TEST(std::abs(knee.at("rest").get<double>() - pi / 6.0) <= 1e-15);
  BOOST_TEST(knee.at("damping") == 0.2);
  const Json& leg = system.at("bodies").at("leg");
  BOOST_TEST(std::abs(leg.at("mass").get<double>() - (cylinder + balls)) <= 1e-14);
  require_entries(leg.at("center"), {0.0, 0.0, -0.2});

  BOOST_TEST(notes.at(0).line() ==
             "line 21: (leg.xml, line 3) limits of joints are left out: they move beyond them");
  BOOST_TEST(notes.at(1).line() == "line 24: <actuator> is left out, with all that is in it");
}

BOOST_AUTO_TEST_CASE(a_body_has_the_mass_of_its_inertial_or_of_its_geoms) {
  const std::string inertial = "<joint/><inertial pos='0 0 0' mass='2' diaginertia='1 1 1'/>";
  const std::string sphere = "<geom size='1' mass='5'/>";
  const auto mass = [](const std::string& compiler, const std::string& inside) {
    const std::string text = "<mujoco>" + compiler + "<worldbody><body name='b'>" + inside +
                             "</body></worldbody></mujoco>";
    return import_robot(text).at("system").at("bodies").at("b").at("mass").get<double>();
  };
  BOOST_TEST(mass("", inertial + sphere) == 2.0);
  BOOST_TEST(mass("<compiler inertiafromgeom='true'/>", inertial + sphere) == 5.0);
  BOOST_TEST(mass("<compiler settotalmass='7'/>", inertial) == 7.0);
  BOOST_TEST(mass("<compiler inertiagrouprange='1 1'/>",
                  "<joint/>" + sphere + "<geom size='1' mass='3' group='1'/>") == 3.0);
}

BOOST_AUTO_TEST_CASE(equalities_close_loops) {
  const std::string rod = "<geom type='capsule' size='0.1' fromto='0 0 0 1 0 0'/>";
  const std::string text =
      "<mujoco><worldbody><body name='a'><joint axis='0 1 0'/>" + rod +
      "<body name='b' pos='1 0 0'><joint axis='0 1 0'/>" + rod +
      "</body></body><body name='c' pos='1 0 1'><joint "
      "axis='0 1 0'/>" +
      rod +
      "</body></worldbody><equality><connect name='loop' body1='b' body2='c' anchor='1 0 0'/>"
      "<weld body1='c'/></equality></mujoco>";
  const Json system = import_robot(text).at("system");
  // c is fixed to the ground by the weld, and b connected to it.
  BOOST_TEST(system.at("bodies").size() == 2u);
  const Json& loop = system.at("joints").at("loop");
  BOOST_TEST(loop.at("type") == "spherical");
  BOOST_TEST(loop.at("parent") == "b");
  BOOST_TEST(loop.at("child") == "ground");
  require_entries(loop.at("origin").at("xyz"), {1.0, 0.0, 0.0});
  require_entries(loop.at("child_origin").at("xyz"), {2.0, 0.0, 0.0});
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_by_line) {
  refused_model("<mujoco/>",
                "line 1: <mujoco> has no <body>; expected at least one in <worldbody>");
  refused_model(body_text(""),
                "line 1: all links are fixed to the ground; expected one that moves");
  refused_model(body_text("<joint type='screw'/>"),
                "line 2: <joint> has the type \"screw\"; expected hinge, slide, ball or free");
  refused_model(body_text("<joint class='x'/>"),
                "line 2: <joint> has the class \"x\", which no <default> is");
  refused_model(body_text("<joint/><geom type='mesh' mesh='m'/>"),
                "line 2: the mass of a mesh is not computed; expected an <inertial> in its body");
  refused_model(body_text("<joint/>"),
                "line 1: the link \"b\" moves, and neither it nor what hangs on it has a mass; "
                "expected a mass, or a "
                "fixed joint");
  refused_model(body_text("<joint/><geom type='capsule' size='0.1'/>"),
                "line 2: <geom> has 1 number in size; expected 2 of a capsule");
  refused_model(body_text("<joint/><geom size='1e31'/>"),
                "line 2: <geom> has \"1e31\" in size; expected a number of at most 1e15");
  refused_model(body_text("<joint/><body><freejoint/></body>"),
                "line 2: <freejoint> is free, but not the only joint of a body of the world; "
                "expected it there");
  refused_model(body_text("<composite/>"),
                "line 2: <composite> is not supported; expected bodies that are written out");
  // A file that includes itself.
  refused_model("<mujoco>\n<include file='a.xml'/></mujoco>",
                "line 2: (a.xml, line 1) <include> includes \"a.xml\" a second time; expected once",
                [](const std::string&) { return "<mujoco><include file='a.xml'/></mujoco>"; });
  refused_model(
      "<mujoco>\n<include file='a.xml'/></mujoco>",
      "line 2: <include> includes \"a.xml\", which is not there",
      [](const std::string&) -> std::string { throw std::runtime_error("is not there"); });
}

// joint1 = a0 + a1 joint2, both from the rest of the file.
BOOST_AUTO_TEST_CASE(coupled_joints) {
  const auto coupled = [](const std::string& inside) {
    const std::string rod = "<inertial pos='0.5 0 0' mass='1' diaginertia='0.01 0.1 0.1'/>";
    return "<mujoco><worldbody><body name='a'><joint name='A' axis='0 1 0'/>" + rod +
           "<body name='b' pos='1 0 0'><joint name='B' axis='0 1 0'/>" + rod +
           "</body></body></worldbody><equality>" + inside + "</equality></mujoco>";
  };
  const Json joints =
      import_robot(coupled("<joint joint1='B' joint2='A' polycoef='0.25 -2 0 0 0'/>"))
          .at("system")
          .at("joints");
  const Json expected = {{"joint", "A"}, {"multiplier", -2.0}, {"offset", 0.25}};
  BOOST_TEST(joints.at("B").at("mimic") == expected);
  BOOST_TEST(problem_of_robot(coupled("<joint joint1='B' joint2='A' polycoef='0 1 1 0 0'/>"))
                 .ends_with("has a polycoef beyond the linear one; expected 0 for the last three"));
  BOOST_TEST(
      problem_of_robot(coupled("<joint joint1='B' joint2='A'/><joint joint1='B' joint2='A'/>"))
          .ends_with("couples the joint \"B\" a second time; expected one joint that it "
                     "follows"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
