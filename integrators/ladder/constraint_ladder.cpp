#include "courant/integrators/ladder/constraint_ladder.hpp"

#include <algorithm>
#include <stdexcept>

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
