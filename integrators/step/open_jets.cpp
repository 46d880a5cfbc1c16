#include "courant/integrators/step/open_jets.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/matching.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/regular_matrix.hpp"

namespace courant {
namespace {

using regular_matrix::kNoise;

// Of a vector of the kernel, next to its length: what is below is no component.
constexpr double kNoComponent = 1e-9;
// What is held has to move as much as that with the vectors of the kernel, next to what moves most.
constexpr double kSurelyOpen = 1e-3;

// Which rows and columns of a matrix have an entry in common.
class Incidence {
 public:
  explicit Incidence(const Function& F) : rows_of_(places(F)) {
    std::vector<PatternEntry> entries;
    for (std::size_t k = 0; k < F.pattern_row().size(); ++k) {
      const Index row = F.pattern_row()[k], column = F.pattern_col()[k];
      rows_of_[static_cast<std::size_t>(column)].push_back(row);
      entries.push_back({row, column});
    }
    column_of_ = largest_matching(F.output_size(), F.input_size(0), entries);
    std::vector<bool> is_matched(rows_of_.size(), false);
    for (const Index column : column_of_)
      if (column >= 0) is_matched[static_cast<std::size_t>(column)] = true;
    for (std::size_t column = 0; column < rows_of_.size(); ++column)
      if (!is_matched[column]) alone_.push_back(static_cast<Index>(column));
  }

  // Columns of a largest matching that no row is left for.
  const std::vector<Index>& alone() const { return alone_; }

  // The rows of these columns, the columns that these rows are matched with, and so on, from a column
  // that is alone.
  void follow(Index column, std::vector<bool>& rows, std::vector<bool>& columns) const {
    std::vector<Index> waiting = {column};
    while (!waiting.empty()) {
      const auto next = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      if (columns[next]) continue;
      columns[next] = true;
      for (const Index row : rows_of_[next]) {
        rows[static_cast<std::size_t>(row)] = true;
        // All these rows are matched: else the matching would be no largest one.
        waiting.push_back(column_of_[static_cast<std::size_t>(row)]);
      }
    }
  }

 private:
  static std::vector<std::vector<Index>> places(const Function& F) {
    return std::vector<std::vector<Index>>(static_cast<std::size_t>(F.input_size(0)));
  }

  std::vector<std::vector<Index>> rows_of_;
  std::vector<Index> alone_, column_of_;
};

std::vector<Index> chosen(const std::vector<bool>& choice) {
  std::vector<Index> result;
  for (std::size_t i = 0; i < choice.size(); ++i)
    if (choice[i]) result.push_back(static_cast<Index>(i));
  return result;
}

bool has_full_row_rank(const MatrixXd& A) {
  const RankDecision decision = decide_rank(A);
  return decision.rank == A.rows() && !decision.ambiguous();
}

}  // namespace

OpenJets open_jets(const Function& F, const std::vector<VectorXd>& at,
                   const std::vector<JetRole>& roles) {
  OpenJets open;
  if (F.input_size(0) == 0 || F.output_size() == 0) return open;
  const MatrixXd J = F.jacobian(at);
  if (!J.allFinite()) return open;
  const auto has_role = [&](Index column, JetRole role) {
    return roles[static_cast<std::size_t>(column)] == role;
  };
  const auto is_asked_for = [&](Index column) { return has_role(column, JetRole::asked_for); };
  const auto is_wanted = [&](Index column) {
    return is_asked_for(column) || has_role(column, JetRole::held_where_open);
  };

  std::vector<bool> is_left_out(static_cast<std::size_t>(J.rows()), false);
  const Incidence incidence(F);
  for (const Index column : incidence.alone()) {
    std::vector<bool> rows(is_left_out.size(), false), columns(roles.size(), false);
    incidence.follow(column, rows, columns);
    const std::vector<Index> equations = chosen(rows), unknowns = chosen(columns);
    if (equations.empty() || std::ranges::any_of(unknowns, is_wanted)) continue;
    if (!has_full_row_rank(J(equations, unknowns))) continue;
    for (const Index equation : equations) is_left_out[static_cast<std::size_t>(equation)] = true;
  }
  open.equations = chosen(is_left_out);

  std::vector<bool> is_right = is_left_out;
  is_right.flip();
  const MatrixXd left = J(chosen(is_right), Eigen::all);
  std::vector<bool> is_contained(roles.size());
  for (std::size_t k = 0; k < F.pattern_row().size(); ++k)
    if (!is_left_out[static_cast<std::size_t>(F.pattern_row()[k])])
      is_contained[static_cast<std::size_t>(F.pattern_col()[k])] = true;
  std::vector<Index> columns = chosen(is_contained);
  const auto first_open = std::stable_partition(columns.begin(), columns.end(), is_asked_for);
  const Index asked = first_open - columns.begin();
  const auto first_carried = std::stable_partition(
      first_open, columns.end(), [&](Index column) { return !has_role(column, JetRole::carried); });
  const Index holdable = first_carried - first_open;
  if (left.size() == 0 || holdable == 0) return open;

  const Equilibration<MatrixXd> S = equilibrate(left(Eigen::all, columns), kNoise);
  const FundamentalSubspaces spaces(S.scaled);
  if (spaces.decision().ambiguous()) return open;
  MatrixXd moves = spaces.kernel();
  if (moves.topRows(asked).norm() > kNoComponent)
    moves = moves * kernel(moves.topRows(asked), {.data_error = kNoComponent});
  if (moves.cols() == 0 || moves.cols() > holdable) return open;
  const QrDecomposition by_size =
      QrDecomposition::pivoted(moves.middleRows(asked, holdable).transpose());
  const VectorXd sizes = by_size.diagonal().cwiseAbs();
  if (!(sizes.minCoeff() > kSurelyOpen * sizes.maxCoeff())) return open;
  for (Index k = 0; k < moves.cols(); ++k)
    open.unknowns.push_back(
        columns[static_cast<std::size_t>(asked + by_size.order()[static_cast<std::size_t>(k)])]);
  std::ranges::sort(open.unknowns);
  return open;
}

}  // namespace courant
