#include "courant/integrators/ladder/constraint_ladder.hpp"

#include <algorithm>
#include <stdexcept>

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

MatrixXd ConstraintLadder::conormals() const {
  const Index size = constraints.empty() ? point.v.size() : constraints.front().gradient.size();
  MatrixXd rows(static_cast<Index>(constraints.size()), size);
  for (std::size_t i = 0; i < constraints.size(); ++i)
    rows.row(static_cast<Index>(i)) = constraints[i].gradient.transpose();
  return rows;
}

bool ConstraintLadder::is_ambiguous() const {
  return std::any_of(levels.begin(), levels.end(), [](const LadderLevel& level) {
    return !level.is_empty && level.is_ambiguous();
  });
}

}  // namespace courant
