#include "courant/integrators/certificate/refined_obstruction.hpp"

namespace courant {

RefinedObstruction::RefinedObstruction(const ConsistentJet& at,
                                       const std::vector<LadderLevel>& levels,
                                       const SparseMatrixXd& magnitude)
    : at_(at),
      levels_(levels),
      magnitude_(magnitude),
      rough_(at.array(), at.zero().y, at.zero().uncertainty, levels.back().all.rank, magnitude) {}

Obstruction::Answer RefinedObstruction::is_seen_along(const VectorXd& direction) {
  using Answer = Obstruction::Answer;
  constexpr double blurred = 1e-13;
  const Answer answer = rough_.is_seen_along(direction);
  if (answer != Answer::unknown) return answer;
  if (!has_refined_ranks_) {
    array_ = refined_with(at_, levels_);
    has_refined_ranks_ = array_.has_value();
    if (array_)
      refined_.emplace(*array_, at_.zero().y, at_.zero().uncertainty, levels_.back().all.rank,
                       magnitude_, blurred);
  }
  return refined_ && refined_->is_seen_along(direction) == Answer::no ? Answer::no : answer;
}

}  // namespace courant
