#include "courant/core/linear/rank_decision.hpp"

#include <ostream>

#include "courant/core/words/message.hpp"

namespace courant {

std::ostream& operator<<(std::ostream& out, const RankDecision& decision) {
  const auto text = [](double value) { return number_text(value, 2); };
  return out << "rank " << decision.rank << " of " << size_text(decision.rows, decision.columns)
             << ", gap " << text(decision.gap) << " (" << text(decision.above) << " | "
             << text(decision.below) << ", threshold " << text(decision.threshold) << ")"
             << (decision.ambiguous() ? ", ambiguous" : "");
}

}  // namespace courant
