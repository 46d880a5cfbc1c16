// Closed loops with dampers, released from rest, in SI units: a table of linkages that Method 2 runs as it is by default.
//
// The same start up to round-off leads to the same run up to round-off, whatever was guessed; momenta of a body at rest
// are zero or round-off and tell no unit; and a run in millimetres and grams is that in metres and kilograms.
//
// Expected angles were computed by another way: the equations for accelerations and multipliers, solved at each point,
// by SciPy's DOP853 with a relative tolerance of 10⁻¹² (constraints kept to 10⁻¹⁵).
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <random>

#include "../core/campaign.hpp"
#include "problems.hpp"

BOOST_AUTO_TEST_SUITE(closed_loops_long)

using namespace courant;

namespace {

struct Rod {
  double length, mass;
  double x, y, angle;  // guessed
};
// An end of a rod, ahead of its centre (+1) or behind it (-1); rod 0 is the ground, at (x, y), and -1 a block that
// slides along y = 0.
struct End {
  int rod, side;
  const char *x = "0", *y = "0";
};
struct Linkage {
  std::string name;
  std::vector<Rod> rods;
  std::vector<std::pair<End, End>> pins;
  std::vector<int> held;       // angles of these rods
  std::string spring, torque;  // an energy of angles; on rod 1
  std::string damping;         // of each angle
  double angle;                // of rod 1, after 0.2 s from rest
  double block = 0.0;          // its mass, if there is one
};

const End kGround{0, 0};

const std::vector<Linkage>& linkages() {
  static const std::vector<Linkage> all = {
      {"four-bar",
       {{0.2, 0.5, 0.0362, 0.0932, 1.2}, {0.5, 1.2, 0.3, 0.29, 0.45}, {0.4, 1.0, 0.51, 0.2, 1.5}},
       {{{1, -1}, kGround}, {{1, 1}, {2, -1}}, {{3, -1}, {0, 0, "0.5"}}, {{2, 1}, {3, 1}}},
       {1},
       "50*(a3 - 1.2)^2/2",
       "0",
       "0.05",
       0.051497640295193825},
      {"parallelogram",
       {{0.3, 0.5, 0.08, 0.126, 1.0}, {0.5, 1.2, 0.41, 0.25, 0.02}, {0.3, 1.0, 0.58, 0.126, 1.01}},
       {{{1, -1}, kGround}, {{1, 1}, {2, -1}}, {{3, -1}, {0, 0, "0.5"}}, {{2, 1}, {3, 1}}},
       {1},
       "0",
       "0",
       "0.05",
       0.5721482819988951},
      {"slider-crank",
       {{0.1, 0.5, 0.03, 0.04, 0.9}, {0.35, 1.2, 0.23, 0.04, -0.22}},
       {{{1, -1}, kGround}, {{1, 1}, {2, -1}}, {{2, 1}, {-1, 0}}},
       {1},
       "0",
       "0",
       "0.02",
       0.1280295119759616,
       0.8},
      {"five-bar",
       {{0.25, 0.5, -0.04, 0.12, 1.9},
        {0.4, 1.2, 0.04, 0.4, 0.9},
        {0.25, 1.0, 0.34, 0.12, 1.2},
        {0.4, 0.9, 0.27, 0.4, 2.2}},
       {{{1, -1}, kGround},
        {{1, 1}, {2, -1}},
        {{3, -1}, {0, 0, "0.3"}},
        {{3, 1}, {4, -1}},
        {{2, 1}, {4, 1}}},
       {1, 3},
       "5*(a1 - 1.8)^2/2",
       "0",
       "0.05",
       2.2220797585170664},
      {"six-bar",
       {{0.1, 0.5, 0.04, 0.03, 0.6},
        {0.35, 1.5, 0.23, 0.15, 0.53},
        {0.25, 1.0, 0.34, 0.12, 1.24},
        {0.4, 2.0, 0.57, 0.29, 0.27},
        {0.3, 1.2, 0.73, 0.2, 1.34}},
       {{{1, -1}, kGround},
        {{1, 1}, {2, -1}},
        {{3, -1}, {0, 0, "0.3"}},
        {{2, 1}, {3, 1}},
        {{2, 1}, {4, -1}},
        {{5, -1}, {0, 0, "0.7", "0.05"}},
        {{4, 1}, {5, 1}}},
       {1},
       "20*a5^2/2",
       "0.8",
       "0.02",
       0.5328009523778339}};
  return all;
}

std::string numbered(const char* letter, int i) { return letter + std::to_string(i); }

// One coordinate of an end, in units of length of L metres.
std::string place(const End& end, bool is_x, const std::vector<Rod>& rods) {
  if (end.rod == 0) return std::string("(") + (is_x ? end.x : end.y) + ")/L";
  if (end.rod < 0) return is_x ? "s" : "0";
  const std::string half = std::to_string(rods[static_cast<std::size_t>(end.rod - 1)].length / 2);
  return numbered(is_x ? "x" : "y", end.rod) + (end.side > 0 ? " + " : " - ") + half + "/L*" +
         (is_x ? "cos(" : "sin(") + numbered("a", end.rod) + ")";
}

struct Setting {
  bool is_damped = true;
  double speed = 0.0;               // of the first angle
  double length = 1.0, mass = 1.0;  // what counts as 1, in metres and kilograms
};

Json system_of(const Linkage& of, const Setting& setting) {
  Json coordinates = Json::array(), metric = Json::array(), damping = Json::array();
  std::string potential = "(" + of.spring + ")/(M*L^2)";
  int i = 0;
  for (const Rod& rod : of.rods) {
    ++i;
    const std::string m = std::to_string(rod.mass) + "/M";
    for (const char* letter : {"x", "y", "a"}) coordinates.push_back(numbered(letter, i));
    for (const std::string& entry : {m, m, m + "*(" + std::to_string(rod.length) + "/L)^2/12"})
      metric.push_back(entry);
    for (const std::string& entry :
         {std::string("0"), std::string("0"),
          setting.is_damped ? of.damping + "/(M*L^2)" : std::string("0")})
      damping.push_back(entry);
    potential += " + 9.81/L*" + m + "*" + numbered("y", i);
  }
  if (of.block > 0.0) {
    coordinates.push_back("s");
    metric.push_back(std::to_string(of.block) + "/M");
    damping.push_back(setting.is_damped ? of.damping + "/M" : "0");
  }
  Json holonomic = Json::array();
  for (const auto& [one, other] : of.pins)
    for (const bool is_x : {true, false})
      holonomic.push_back(place(one, is_x, of.rods) + " - (" + place(other, is_x, of.rods) + ")");
  return {{"type", "mechanical"},
          {"parameters", {{"L", setting.length}, {"M", setting.mass}}},
          {"coordinates", coordinates},
          {"metric", metric},
          {"potential", potential},
          {"damping", damping},
          {"forces", {{"a1", of.torque + "/(M*L^2)"}}},
          {"holonomic", holonomic}};
}

// By how much the guess of each number is off.
using Guess = std::vector<double>;

test::Problem linkage(const Linkage& of, const Setting& setting, const Guess& guess) {
  std::size_t number = 0;
  const auto guessed = [&](double value) {
    return guess.empty() ? value : value + guess.at(number++);
  };
  Json initial, hold = Json::array();
  int i = 0;
  for (const Rod& rod : of.rods) {
    ++i;
    const bool is_held = std::ranges::find(of.held, i) != of.held.end();
    initial[numbered("x", i)] = guessed(rod.x) / setting.length;
    initial[numbered("y", i)] = guessed(rod.y) / setting.length;
    initial[numbered("a", i)] = is_held ? rod.angle : guessed(rod.angle);
    if (is_held) hold.push_back(numbered("a", i));
    if (setting.speed == 0.0)
      for (const char* letter : {"x", "y", "a"}) initial[numbered(letter, i) + "'"] = 0;
  }
  if (of.block > 0.0) {
    initial["s"] = guessed(0.4) / setting.length;
    if (setting.speed == 0.0) initial["s'"] = 0;
  }
  if (setting.speed != 0.0)
    for (const int rod : of.held) initial[numbered("a", rod) + "'"] = setting.speed;
  return test::problem({{"system", system_of(of, setting)}, {"initial", initial}, {"hold", hold}});
}

constexpr double kTime = 0.2;

// The state at the end, lengths in metres.
VectorXd end(const Linkage& of, const Setting& setting, long steps, const Guess& guess = {}) {
  const test::Problem motion = linkage(of, setting, guess);
  VectorXd x = motion.end("constrain-first", kTime, steps);
  const Index n = x.size() / 2;
  for (Index i = 0; i < n; ++i) {
    const bool is_angle = i % 3 == 2 && i < 3 * std::ssize(of.rods);
    const double length = is_angle ? 1.0 : setting.length;
    x[i] *= length;
    x[n + i] *= setting.mass * setting.length * setting.length / length;
  }
  return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(from_rest_to_what_another_way_finds) {
  for (const Linkage& of : linkages()) {
    const double coarse = end(of, {}, 100)[2] - of.angle, fine = end(of, {}, 200)[2] - of.angle;
    BOOST_TEST(std::abs(fine) < 2e-3, of.name << " is off by " << fine);
    BOOST_TEST(coarse / fine == 4.0, boost::test_tools::tolerance(0.1));
  }
}

// Twenty guesses each, with dampers and without, from rest.
BOOST_AUTO_TEST_CASE(whatever_was_guessed) {
  const test::Campaign campaign = test::Campaign::of_environment();
  std::uniform_real_distribution<double> off(-0.01, 0.01);
  for (const Linkage& of : linkages())
    for (const bool is_damped : {true, false}) {
      std::mt19937 generator(17);
      const Setting setting{.is_damped = is_damped};
      const VectorXd first = end(of, setting, 20);
      for (int guess = 0; guess < 20; ++guess) {
        Guess by(3 * of.rods.size() - of.held.size() + (of.block > 0.0 ? 1 : 0));
        for (double& number : by) number = off(generator);
        if (!campaign.has(guess)) continue;
        const double difference = (end(of, setting, 20, by) - first).norm();
        BOOST_TEST(difference < 1e-9, of.name << (is_damped ? " with" : " without")
                                              << " dampers, guess " << guess << ": " << difference);
      }
    }
}

// From rest and in motion: what is 1 does not matter.
BOOST_AUTO_TEST_CASE(whatever_the_units) {
  for (const Linkage& of : linkages())
    for (const double speed : {0.0, 3.0}) {
      const VectorXd expected = end(of, {.speed = speed}, 40);
      for (const auto& [length, mass] :
           {std::pair{1e-3, 1e-3}, std::pair{1e-3, 1.0}, std::pair{1.0, 1e3}, std::pair{10.0, 1e3},
            std::pair{1e3, 1.0}}) {
        const Setting setting{.speed = speed, .length = length, .mass = mass};
        BOOST_TEST_CONTEXT(of.name << " at " << speed << " in " << length << " m and " << mass
                                   << " kg") {
          BOOST_CHECK_NO_THROW(BOOST_TEST((end(of, setting, 40) - expected).norm() < 1e-9));
        }
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()
