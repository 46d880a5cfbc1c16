#include "courant/extensions/robots/import_robot.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/extensions/importing/line_problems.hpp"
#include "courant/extensions/robots/mechanism_of_robot.hpp"
#include "courant/extensions/robots/mjcf.hpp"
#include "courant/extensions/robots/sdf.hpp"
#include "courant/extensions/robots/urdf.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {
namespace {

using namespace robots;

Robot read_robot(std::string_view text, const IncludedText& included) {
  const Element root = parse_xml(text);
  if (root.name == "robot") return read_urdf(root);
  if (root.name == "sdf") return read_sdf(root);
  if (root.name == "mujoco") return read_mjcf(root, included);
  root.fail("is the root; expected <robot> (URDF), <sdf> or <mujoco>");
}

// What the reader of experiments refuses, at the line of the body or the joint.
ExperimentError at_lines(const ExperimentError& error, const MechanismOfRobot& mechanism) {
  std::vector<Problem> problems;
  for (const Problem& problem : error.problems()) {
    Place place;
    std::string about = problem.where.empty() ? "" : problem.where + ": ";
    for (const auto& [prefix, places] : {std::pair("/system/bodies/", &mechanism.bodies),
                                         std::pair("/system/joints/", &mechanism.joints)}) {
      if (!problem.where.starts_with(prefix)) continue;
      const std::string rest = problem.where.substr(std::string(prefix).size());
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const auto found = places->find(rest.substr(0, end));
      if (found == places->end()) continue;
      place = found->second;
      about = found->first + (end < rest.size() ? ", " + rest.substr(end + 1) : "") + ": ";
    }
    problems.push_back({place.line > 0 ? "line " + std::to_string(place.line) : "the robot",
                        place.origin + about + problem.what});
  }
  return ExperimentError(problems);
}

}  // namespace

bool is_robot_file(std::string_view name, std::string_view text) {
  const std::size_t point = name.rfind('.');
  if (point == std::string_view::npos || name.find('/', point) != std::string_view::npos) {
    const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != std::string_view::npos && text[first] == '<';
  }
  std::string suffix(name.substr(point));
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix == ".urdf" || suffix == ".sdf" || suffix == ".world" || suffix == ".xml" ||
         suffix == ".mjcf" || suffix == ".xacro";
}

Json import_robot(std::string_view text, std::vector<Problem>* notes,
                  const IncludedText& included) {
  constexpr double end = 1.0;  // s
  try {
    Robot robot = read_robot(text, included);
    const MechanismOfRobot mechanism = mechanism_of(robot);
    const Json experiment = {
        {"title", robot.title.empty() ? "A robot" : robot.title},
        {"system", mechanism.system},
        {"initial", "rest"},
        {"method", {{"type", "constrain-first"}, {"discretization", "midpoint"}}},
        {"time", {{"step", robot.step}, {"end", std::max(end, robot.step)}}}};
    try {
      read_experiment_document(experiment);
    } catch (const ExperimentError& error) {
      throw at_lines(error, mechanism);
    }
    if (notes) {
      *notes = robot.notes.problems();
      notes->push_back(
          {"the robot", "no file of a robot says how long to go on: the experiment ends at " +
                            number_text(end) + " s, which is `end` of its `time`"});
    }
    return experiment;
  } catch (const LineError& error) {
    throw ExperimentError("line " + std::to_string(error.line), error.what);
  }
}

}  // namespace courant
