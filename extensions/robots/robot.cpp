#include "courant/extensions/robots/robot.hpp"

#include <set>

#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/extensions/importing/line_problems.hpp"

namespace courant::robots {

void Notes::add(const Place& place, const std::string& what) {
  const auto [note, is_new] = notes_.try_emplace(what, Note{place, 0});
  if (is_new) order_.push_back(what);
  ++note->second.count;
}

std::vector<Problem> Notes::problems() const {
  std::vector<Problem> told;
  for (const std::string& what : order_) {
    const auto& [place, count] = notes_.at(what);
    const std::string more = count == 1 ? ""
                                        : " (here and " + std::to_string(count - 1) +
                                              (count == 2 ? " more time)" : " more times)");
    told.push_back({place.line > 0 ? "line " + std::to_string(place.line) : "the robot",
                    place.origin + what + more});
  }
  return told;
}

void fail(const Place& place, const std::string& what) {
  throw LineError{place.line, place.origin + what};
}

void check_inertia(const Inertia& inertia, const Place& place, const std::string& of) {
  if (inertia.mass < 0.0)
    fail(place, "the mass of " + of + " is " + number_text(inertia.mass) + "; expected at least 0");
  const VectorXd moments = symmetric_eigenvalues(inertia.about_center);
  const double round_off = 1e-9 * moments.cwiseAbs().maxCoeff();
  if (moments[0] < -round_off)
    fail(place, "a principal moment of inertia of " + of + " is " + number_text(moments[0]) +
                    "; expected at least 0");
}

void require_different_names(const Robot& robot) {
  constexpr std::size_t most = 1000;
  if (robot.links.size() > most)
    fail(robot.links[most].place, "is one of more than " + std::to_string(most) + " links");
  const auto check = [](const auto& all, const std::string& what) {
    std::set<std::string> names;
    for (const auto& one : all)
      if (!one.name.empty() && !names.insert(one.name).second)
        fail(one.place,
             "there is a " + what + " " + in_quotes(one.name) + " already; expected another name");
  };
  check(robot.links, "link");
  check(robot.joints, "joint");
}

std::size_t link_named(const Robot& robot, const std::string& name, const Place& place) {
  for (std::size_t i = 1; i < robot.links.size(); ++i)
    if (robot.links[i].name == name) return i;
  std::vector<std::string> names;
  for (std::size_t i = 1; i < robot.links.size(); ++i) names.push_back(robot.links[i].name);
  fail(place, "unknown link " + in_quotes(name) + did_you_mean(name, names));
}

}  // namespace courant::robots
