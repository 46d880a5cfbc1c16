#include <numbers>

#include "courant/running/consistent_start.hpp"
#include "courant/tests/extensions/robots/robots.hpp"
#include "courant/tests/running/run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * an axis is taken in the frame of the parent (extensions/robots/mechanism_of_robot.cpp)
//  * the frame on the child of a loop is that of its link
//  * the inertia of a part is left at its own centre
BOOST_AUTO_TEST_SUITE(robot_runs)

namespace {

Json with(Json experiment, const Json& changes) {
  experiment.merge_patch(changes);
  return experiment;
}

RunOutcome completed_run(const TemporaryFolder& folder, const Json& experiment) {
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
  return outcome;
}

double observed(const RunOutcome& outcome, const std::string& quantity) {
  for (const auto& [name, record] : outcome.summary.observables)
    if (name == quantity) return record.final;
  return RunSummary::kUnknown;
}

}  // namespace

// One robot in three formats. The numbers at t = 1 are those of MuJoCo 2.2.2 for the same file, by Runge and Kutta's method
// with steps of 1e-4, at which halving the step moves no digit.
BOOST_AUTO_TEST_CASE(three_formats_are_one_robot) {
  for (const char* file : {"two_rods.urdf", "two_rods.sdf", "two_rods.xml"}) {
    const TemporaryFolder folder;
    const Json experiment = with(robot_in(file), {{"system", {{"gravity", {0.0, 0.0, -9.81}}}},
                                                  {"method", {{"order", 4}}},
                                                  {"time", {{"step", 1e-3}, {"end", 1.0}}}});
    const RunOutcome outcome = completed_run(folder, experiment);
    BOOST_TEST(std::abs(final_value(outcome, "shoulder") - 2.74045160307) <= 1e-9, file);
    BOOST_TEST(std::abs(final_value(outcome, "elbow") + 0.305472379779) <= 1e-9, file);
  }
}

// A leg with a hip of two hinges, a spring in the knee and masses of geoms: MuJoCo likewise. Its knee is 15° at rest.
BOOST_AUTO_TEST_CASE(a_leg_moves_as_in_mujoco) {
  const TemporaryFolder folder;
  const Json experiment =
      with(robot_in("leg_with_defaults.xml"),
           {{"method", {{"order", 4}}}, {"time", {{"step", 1e-3}, {"end", 1.0}}}});
  const RunOutcome outcome = completed_run(folder, experiment);
  BOOST_TEST(std::abs(final_value(outcome, "hip_x")) <= 1e-9);
  BOOST_TEST(std::abs(final_value(outcome, "hip_y") + 0.0186821329001) <= 1e-9);
  BOOST_TEST(std::abs(final_value(outcome, "knee") - (0.544234240552 - std::numbers::pi / 12.0)) <=
             1e-9);
}

// Of small swings: ω² = (M + m) m g l / ((M + m)(J + m l²) - m² l²).
BOOST_AUTO_TEST_CASE(a_cart_with_a_pole_swings_with_its_period) {
  const double M = 1.0, m = 0.3, l = 0.5, J = 0.025, g = 9.81;
  const double omega = std::sqrt((M + m) * m * g * l / ((M + m) * (J + m * l * l) - m * m * l * l));
  const TemporaryFolder folder;
  const Json experiment =
      with(robot_in("cart_pole.urdf"), {{"initial", {{"swing", 1e-4}, {"rest", true}}},
                                        {"method", {{"order", 4}}},
                                        {"time", {{"step", 1e-2}, {"end", 2.0}}}});
  const RunOutcome outcome = completed_run(folder, experiment);
  BOOST_TEST(std::abs(final_value(outcome, "swing") / 1e-4 - std::cos(2.0 * omega)) <= 1e-6);
}

// Two wheels on parallel axles, the second by two teeth for each of the first: about the axes J = 2 and 3, so a torque that
// only the first one has, of a weight at 1 m of it, turns 2 + 3 · 2². ω² = m g l / (2 + m l² + 12) of small swings.
BOOST_AUTO_TEST_CASE(gears_turn_together) {
  const auto wheel = [](const char* name, const char* center, const char* inertia) {
    return std::string("<link name='") + name + "'><inertial><origin xyz='" + center +
           "'/><mass value='1'/><inertia ixx='" + inertia + "' iyy='" + inertia + "' izz='" +
           inertia + "' ixy='0' ixz='0' iyz='0'/></inertial></link>";
  };
  const std::string text =
      "<robot name='gears'><link name='world'/>" + wheel("one", "0 0 -1", "2") +
      wheel("two", "0 0 0", "3") +
      "<joint name='A' type='continuous'><parent link='world'/><child link='one'/><axis xyz='0 1 "
      "0'/></joint><joint name='B' type='continuous'><parent link='world'/><child "
      "link='two'/><origin xyz='2 0 0'/><axis xyz='0 1 0'/><mimic joint='A' multiplier='-2' "
      "offset='0.5'/></joint></robot>";
  const TemporaryFolder folder;
  const Json experiment = with(import_robot(text), {{"initial", {{"A", 1e-4}, {"rest", true}}},
                                                    {"observe", {{"torque", "m_B[1]"}}},
                                                    {"time", {{"step", 1e-2}, {"end", 2.0}}}});
  const RunOutcome outcome = completed_run(folder, experiment);
  const double omega = std::sqrt(9.81 / (2.0 + 1.0 + 12.0)), A = 1e-4 * std::cos(2.0 * omega);
  BOOST_TEST(std::abs(final_value(outcome, "A") / 1e-4 - A / 1e-4) <= 1e-5);
  BOOST_TEST(std::abs(final_value(outcome, "B") - (0.5 - 2.0 * final_value(outcome, "A"))) <=
             1e-14);
  // The ground gives the second wheel what turns it: 3 B''.
  BOOST_TEST(std::abs(observed(outcome, "torque") - 3.0 * 2.0 * omega * omega * A) <= 1e-8);
}

// A parallelogram, whose cranks lean by an angle with the sine 0.6 at rest: the coupler does not turn, and with the angle A from
// there ½ (2 · 0.35 + 2) A'² + 3 g (0.8 cos A - 0.6 sin A) stays.
BOOST_AUTO_TEST_CASE(four_bars_fall_with_their_energy) {
  const Json experiment = with(robot_in("four_bar.sdf"), {{"time", {{"step", 1e-3}, {"end", 0.4}}},
                                                          {"observe", {{"speed", "A'"}}}});
  // An angle and its velocity.
  BOOST_TEST(consistent_start(read_experiment(experiment.dump())).degrees_of_freedom == 2);
  const TemporaryFolder folder;
  const RunOutcome outcome = completed_run(folder, experiment);
  const double A = final_value(outcome, "A"), speed = observed(outcome, "speed");
  BOOST_TEST(std::abs(final_value(outcome, "B") + A) <= 1e-9);
  BOOST_TEST(std::abs(final_value(outcome, "D") - A) <= 1e-9);
  BOOST_TEST(A > 0.4);
  BOOST_TEST(std::abs(0.5 * 2.7 * speed * speed -
                      3.0 * 9.81 * (0.8 - 0.8 * std::cos(A) + 0.6 * std::sin(A))) <= 1e-4);
}

// A ball of 2 kg, 1 m below its pivot: it stays there at rest. Pushed about y it swings as a pendulum, ½ J ω² + m g l (1 - cos)
// with J = 2 (1 + 0.4 · 0.01).
BOOST_AUTO_TEST_CASE(a_ball_joint_holds_a_pendulum) {
  const Json hanging = with(robot_in("ball_pendulum.xml"),
                            {{"observe", {{"z", "bob.z"}, {"x", "bob.x"}, {"w", "bob.w[1]"}}},
                             {"time", {{"step", 1e-3}, {"end", 0.5}}}});
  {
    const TemporaryFolder folder;
    const RunOutcome outcome = completed_run(folder, hanging);
    BOOST_TEST(observed(outcome, "z") == -1.0);
    BOOST_TEST(observed(outcome, "x") == 0.0);
  }
  const TemporaryFolder folder;
  const RunOutcome outcome =
      completed_run(folder, with(hanging, {{"initial", {{"v_R_pivot", {0, 2, 0}}}}}));
  const double J = 2.0 * (1.0 + 0.4 * 0.01), z = observed(outcome, "z"), w = observed(outcome, "w");
  BOOST_TEST(z > -0.95);
  BOOST_TEST(std::abs(0.5 * J * (w * w - 4.0) + 2.0 * 10.0 * (z + 1.0)) <= 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
