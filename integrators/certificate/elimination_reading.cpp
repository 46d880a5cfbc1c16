#include "courant/integrators/certificate/elimination_reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
namespace {

using EliminatedRow = StagedElimination::Row;

// Rows of some stages, of their entries those in columns from `first` up to `end`, with the pivots of the others among
// them eliminated too.
std::vector<EliminatedRow> reduced_rows(const StagedElimination& elimination,
                                        const std::vector<StagedElimination::Stage>& stages,
                                        Index first, Index end) {
  std::vector<EliminatedRow> rows;
  std::vector<std::vector<std::size_t>> rows_with(static_cast<std::size_t>(end - first));
  for (const StagedElimination::Stage stage : stages)
    for (const EliminatedRow& row : elimination.rows()) {
      if (row.stage != stage) continue;
      EliminatedRow part;
      part.level = row.level;
      part.stage = stage;
      part.pivot = row.pivot;
      for (const auto& [column, value] : row.entries) {
        if (column < first || column >= end) continue;
        part.entries.append(column, value);
        rows_with[static_cast<std::size_t>(column - first)].push_back(rows.size());
      }
      rows.push_back(std::move(part));
    }
  for (std::size_t p = rows.size(); p-- > 0;) {
    const Index pivot = rows[p].pivot;
    for (const std::size_t i : rows_with[static_cast<std::size_t>(pivot - first)]) {
      const Digits& entry = rows[i].entries[pivot];
      if (i >= p || entry.is_zero()) continue;
      const Digits factor = entry / rows[p].entries[pivot];
      std::vector<Index> filled;
      rows[i].entries.eliminate(pivot, factor, rows[p].entries, filled);
      for (const Index column : filled)
        rows_with[static_cast<std::size_t>(column - first)].push_back(i);
    }
  }
  return rows;
}

// A normalised_combination with 1 in the term of the highest derivative, and the factor that makes it so.
Combination normalised_combination(const JetEquations& equations,
                                   const StagedElimination& elimination, const EliminatedRow& row,
                                   double& factor) {
  Combination result;
  Digits lead;
  Index highest = -1;
  std::vector<std::pair<Index, Digits>> terms;  // of the equations of the system
  for (const auto& [i, value] : elimination.origin(row)) {
    if (i % equations.row_size() >= equations.system_rows()) continue;
    const Index order = i / equations.row_size();
    const Digits coefficient = value / Digits(std::tgamma(static_cast<double>(order) + 1.0));
    terms.emplace_back(i, coefficient);
    if (order > highest || (order == highest && is_smaller(lead, coefficient))) {
      lead = coefficient;
      highest = order;
    }
  }
  factor = 1.0;
  if (terms.empty()) return result;
  for (const auto& [i, coefficient] : terms)
    result.terms.push_back({i % equations.row_size(), i / equations.row_size(),
                            static_cast<double>(coefficient / lead)});
  factor = static_cast<double>(Digits(1.0) / lead);
  return result;
}

// Of the velocities dx/ds that the equations leave free, a basis as columns.
MatrixXd free_velocities(const JetEquations& equations, const StagedElimination& elimination) {
  const Index N = equations.point_size();
  const std::vector<EliminatedRow> rows =
      reduced_rows(elimination, {StagedElimination::velocities}, N, 2 * N);
  std::vector<bool> is_pivot(static_cast<std::size_t>(N), false);
  for (const EliminatedRow& row : rows) is_pivot[static_cast<std::size_t>(row.pivot - N)] = true;
  MatrixXd directions(N, 0);
  for (Index f = 0; f < N; ++f) {
    if (is_pivot[static_cast<std::size_t>(f)]) continue;
    directions.conservativeResize(Eigen::NoChange, directions.cols() + 1);
    directions.rightCols(1).setZero();
    directions(f, directions.cols() - 1) = 1.0;
    for (const EliminatedRow& row : rows) {
      const Digits& entry = row.entries[N + f];
      if (entry.is_zero()) continue;
      directions(row.pivot - N, directions.cols() - 1) =
          -static_cast<double>(entry / row.entries[row.pivot]);
    }
  }
  return directions;
}

std::vector<bool> determined_unknowns(const JetEquations& equations,
                                      const StagedElimination& elimination) {
  const Index N = equations.point_size(), m = equations.auxiliary_size();
  const std::vector<EliminatedRow> rows = reduced_rows(
      elimination, {StagedElimination::unknowns, StagedElimination::velocities}, N, 2 * N + m);
  std::vector<bool> determined(static_cast<std::size_t>(m), false);
  for (const EliminatedRow& row : rows) {
    if (row.stage != StagedElimination::unknowns) continue;
    determined[static_cast<std::size_t>(row.pivot - 2 * N)] =
        std::none_of(row.entries.begin(), row.entries.end(),
                     [&](const auto& entry) { return entry.column != row.pivot; });
  }
  return determined;
}

}  // namespace

std::vector<LadderLevel> levels_of(const JetEquations& equations,
                                   const StagedElimination& elimination, Index k) {
  using Stage = StagedElimination::Stage;
  // What is zero has shrunk by this much, and what is not has stayed. There are no singular values.
  constexpr double gap = 0x1p64, unknown = std::numeric_limits<double>::quiet_NaN();
  // Ranks are those in a chart, without the equations of M, which have a pivot in each x_i.
  const Manifold& M = *equations.system().manifold();
  const Index codimension = M.ambient_dimension() - M.dimension();
  std::vector<LadderLevel> levels;
  for (Index l = 0; l <= k; ++l) {
    LadderLevel level;
    level.k = l;
    level.dim_S = elimination.dim_S(l);
    level.dim_M = elimination.dim_M(l);
    const auto decided = [&](Index rank, Index coefficients) {
      RankDecision decision;
      decision.rank = rank - coefficients * codimension;
      decision.gap = gap;
      decision.above = decision.below = decision.threshold = unknown;
      decision.is_doubtful = false;
      return decision;
    };
    const Index without_tangent =
        elimination.count(Stage::jets, l) + elimination.count(Stage::unknowns, l);
    const Index without_point = without_tangent + elimination.count(Stage::velocities, l);
    level.without_tangent = decided(without_tangent, l);
    level.without_point = decided(without_point, l + 1);
    level.all = decided(without_point + elimination.count(Stage::point, l), l + 2);
    levels.push_back(level);
  }
  return levels;
}

State state_of(const JetEquations& equations, const Jet& jet) {
  const Index N = equations.point_size(), m = equations.auxiliary_size();
  const Manifold& M = *equations.system().manifold();
  VectorXd y(2 * N + m);
  for (Index j = 0; j < y.size(); ++j)
    y[j] = static_cast<double>(jet.y[static_cast<std::size_t>(j)]);
  State state{.t = static_cast<double>(jet.t), .x = y.head(N)};
  state.v = M.has_identity_frame() ? VectorXd(y.segment(N, N))
                                   : VectorXd(M.coframe(state.x) * y.segment(N, N));
  state.z = y.tail(m);
  return state;
}

VectorXd chart_jet(const JetEquations& equations, const Jet& jet) {
  const Index N = equations.point_size(), m = equations.auxiliary_size(), k = jet.k;
  const Manifold& M = *equations.system().manifold();
  const Index n = M.dimension();
  const auto number = [&](Index j) {
    return static_cast<double>(jet.y[static_cast<std::size_t>(j)]);
  };
  VectorXd y = VectorXd::Zero(n + (k + 1) * (n + m));
  const auto xi_offset = [&](Index i) { return i == 0 ? 0 : n + (i - 1) * (n + m); };
  for (Index i = 0; i <= k; ++i)
    for (Index j = 0; j < m; ++j) y[2 * n + i * (n + m) + j] = number(equations.z_offset(i) + j);
  if (M.has_identity_frame()) {
    for (Index i = 1; i <= k + 1; ++i)
      for (Index j = 0; j < N; ++j) y[xi_offset(i) + j] = number(equations.x_offset(i) + j);
    return y;
  }
  // ξ_i = Bᵀ C(x₀) (x_i - what ξ_1 … ξ_{i-1} make of R(x₀, B ξ)).
  VectorXd x0(N);
  for (Index j = 0; j < N; ++j) x0[j] = number(j);
  const LinearMap<double> basis = M.tangent_basis(x0), coframe = M.coframe(x0);
  const Graph graph;
  const ExprVector xi = graph.variables("xi", n);
  const SeriesFunction chart({xi}, M.chart(constants(x0), constants(basis), xi));
  const Index width = k + 2;
  std::vector<double> in(static_cast<std::size_t>(n * width), 0.0),
      out(static_cast<std::size_t>(N * width));
  for (Index i = 1; i <= k + 1; ++i) {
    const double* group = in.data();
    chart.run(&group, k + 1, out.data());
    VectorXd left(N);
    for (Index j = 0; j < N; ++j)
      left[j] = number(equations.x_offset(i) + j) - out[static_cast<std::size_t>(j * width + i)];
    const VectorXd coefficient = basis.transpose() * VectorXd(coframe * left);
    for (Index j = 0; j < n; ++j) {
      in[static_cast<std::size_t>(j * width + i)] = coefficient[j];
      y[xi_offset(i) + j] = coefficient[j];
    }
  }
  return y;
}

std::vector<int> differentiations(const JetEquations& equations,
                                  const StagedElimination& elimination, Index index) {
  std::vector<int> result(static_cast<std::size_t>(equations.system_rows()), 0);
  for (const EliminatedRow& row : elimination.rows()) {
    if (row.level > index ||
        (row.stage != StagedElimination::velocities && row.stage != StagedElimination::point))
      continue;
    for (const auto& [i, coefficient] : elimination.origin(row)) {
      const Index equation = i % equations.row_size();
      if (equation >= equations.system_rows()) continue;
      int& count = result[static_cast<std::size_t>(equation)];
      count = std::max(count, static_cast<int>(i / equations.row_size()));
    }
  }
  return result;
}

void describe(ConstraintLadder& ladder, const JetEquations& equations,
              const StagedElimination& elimination, const Jet& /*jet*/) {
  const Index N = equations.point_size();
  const Manifold& M = *equations.system().manifold();
  const LinearMap<double> frame = M.frame(ladder.point.x), coframe = M.coframe(ladder.point.x);
  // Covectors of M: of the rows of a manifold in space nothing is left of its own equations.
  const Index expected = M.dimension() - ladder.degrees_of_freedom;
  MatrixXd independent(M.tangent_dimension(), 0);
  for (const EliminatedRow& row : elimination.rows()) {
    if (row.stage == StagedElimination::dependent) {
      double factor = 1.0;
      Combination dependence = normalised_combination(equations, elimination, row, factor);
      if (!dependence.terms.empty()) ladder.redundancies.push_back(std::move(dependence));
      continue;
    }
    if (row.stage != StagedElimination::point || independent.cols() == expected) continue;
    double factor = 1.0;
    Combination origin = normalised_combination(equations, elimination, row, factor);
    VectorXd differential(N);
    for (Index j = 0; j < N; ++j) differential[j] = factor * static_cast<double>(row.entries[j]);
    const VectorXd covector = frame.transpose() * differential;
    const VectorXd direction = covector.normalized();
    const VectorXd left = direction - independent * (independent.transpose() * direction);
    if (!(left.norm() > 1e-9)) continue;
    independent.conservativeResize(Eigen::NoChange, independent.cols() + 1);
    independent.rightCols(1) = left.normalized();
    ladder.constraints.push_back(
        {row.level, covector, std::move(origin), 1e-15 * VectorXd(covector.cwiseAbs())});
  }
  const MatrixXd directions = free_velocities(equations, elimination);
  const MatrixXd gauge = coframe * directions;
  ladder.gauge_directions = gauge;
  ladder.determined_velocities.resize(static_cast<std::size_t>(gauge.rows()));
  const MatrixXd terms = absolute(coframe) * MatrixXd(directions.cwiseAbs());
  for (Index i = 0; i < gauge.rows(); ++i)
    ladder.determined_velocities[static_cast<std::size_t>(i)] =
        (gauge.row(i).array().abs() <= 1e-12 * terms.row(i).array()).all();
  ladder.determined = determined_unknowns(equations, elimination);
}

std::vector<NamedEquation> equations_of(const JetEquations& equations,
                                        const StagedElimination& elimination,
                                        const EliminatedRow& row) {
  std::vector<NamedEquation> found;
  for (const auto& [i, coefficient] : elimination.origin(row)) {
    const Index e = i % equations.row_size();
    found.push_back({e < equations.system_rows()
                         ? equations.system().names().equations[static_cast<std::size_t>(e)]
                         : "the equations of " + equations.system().manifold()->name(),
                     i / equations.row_size()});
  }
  return found;
}

}  // namespace courant
