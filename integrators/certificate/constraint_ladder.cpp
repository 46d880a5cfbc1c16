#include "courant/integrators/certificate/constraint_ladder.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/words/text_layout.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::regular:
      return "regular";
    case Verdict::gauge:
      return "gauge";
    case Verdict::inconsistent:
      return "inconsistent";
    case Verdict::rank_change:
      return "rank-change";
    case Verdict::not_reached:
      return "not-reached";
  }
  throw std::invalid_argument("to_string: not a Verdict.");
}

std::string to_string(Doubt::Kind kind) {
  switch (kind) {
    case Doubt::Kind::near_singular:
      return "near-singular";
    case Doubt::Kind::neighbours:
      return "neighbours";
    case Doubt::Kind::not_transversal:
      return "not-transversal";
    case Doubt::Kind::search:
      return "search";
    case Doubt::Kind::at_switch:
      return "switch";
  }
  throw std::invalid_argument("to_string: not a kind of doubt.");
}

Doubt::Kind doubt_kind(const std::string& name) {
  using Kind = Doubt::Kind;
  for (const Kind kind : {Kind::near_singular, Kind::neighbours, Kind::not_transversal,
                          Kind::search, Kind::at_switch})
    if (to_string(kind) == name) return kind;
  throw std::invalid_argument("doubt_kind: \"" + name + "\" is no kind of doubt.");
}

std::string in_words(const std::vector<NamedEquation>& equations) {
  std::string text;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    if (i == kMostEquationsInWords) return text + ", …";
    text += (i == 0 ? "" : ", ") + time_derivative(equations[i].name, equations[i].derivative);
  }
  return text;
}

MatrixXd ConstraintLadder::conormals() const {
  const Index size = constraints.empty() ? point.v.size() : constraints.front().gradient.size();
  MatrixXd rows(static_cast<Index>(constraints.size()), size);
  for (std::size_t i = 0; i < constraints.size(); ++i)
    rows.row(static_cast<Index>(i)) = constraints[i].gradient.transpose();
  return rows;
}

bool ConstraintLadder::is_ambiguous() const {
  return !doubts.empty() || std::any_of(levels.begin(), levels.end(), [](const LadderLevel& level) {
    return !level.is_empty && level.is_ambiguous();
  });
}

std::vector<std::string> contradictions(const std::vector<LadderLevel>& levels) {
  std::vector<std::string> found;
  const auto name = [](const char* set, const LadderLevel& level) {
    return std::string("dim ") + set + "_" + std::to_string(level.k);
  };
  const LadderLevel* before = nullptr;
  for (const LadderLevel& level : levels) {
    if (level.is_empty) continue;
    if (level.dim_M < 0 || level.fibre() < 0)
      found.push_back(name("S", level) + " = " + std::to_string(level.dim_S) + " and " +
                      name("M", level) + " = " + std::to_string(level.dim_M) +
                      " are no dimensions of a set of tangent vectors and its points.");
    for (const auto& [set, dimension] :
         {std::pair("S", &LadderLevel::dim_S), std::pair("M", &LadderLevel::dim_M)})
      if (before && level.*dimension > before->*dimension)
        found.push_back(name(set, level) + " = " + std::to_string(level.*dimension) + " exceeds " +
                        name(set, *before) + " = " + std::to_string(before->*dimension) +
                        ", but one set contains the other.");
    before = &level;
  }
  return found;
}

void check_ladder(const std::string& place, const ImplicitSystem& system,
                  const ConstraintLadder& ladder) {
  const auto check = [&](const char* what, std::size_t size, Index expected) {
    if (size != static_cast<std::size_t>(expected))
      throw std::invalid_argument(place + ": the ladder has " + std::to_string(size) + " " + what +
                                  ", the system " + std::to_string(expected) +
                                  "; expected the ladder of this system.");
  };
  check("coordinates", static_cast<std::size_t>(ladder.point.x.size()),
        system.manifold()->ambient_dimension());
  check("auxiliary unknowns", static_cast<std::size_t>(ladder.point.z.size()),
        system.auxiliary_size());
  check("equations", ladder.differentiations.size(), system.equation_count());
}

}  // namespace courant
