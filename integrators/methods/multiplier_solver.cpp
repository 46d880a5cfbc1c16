#include "courant/integrators/methods/multiplier_solver.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/solve/unknown_selection.hpp"

namespace courant {
namespace {

// A change of Newton's iteration of this relative length leaves an error of about its square, which is none. Iterations
// that do not get there in so many attempts are left to a solver that knows what to do.
constexpr double kShort = 1e-9;
constexpr int kAttempts = 3;

// The places of multipliers of the first half, which are extrapolated, among the unknowns of all substeps.
std::vector<Index> extrapolated(const MultiplierFunctions& functions, Index parts) {
  std::vector<Index> places;
  for (Index i = 0; i < parts; ++i)
    for (const MultiplierFunctions::Block& block : functions.blocks)
      for (Index k = 0; k < block.equations.size() && !block.is_affine; ++k)
        places.push_back(i * functions.unknowns + block.first + k);
  return places;
}

}  // namespace

MultiplierFunctions::MultiplierFunctions(const VerletMultipliers& formulas, const Backend& backend)
    : moving(formulas.moving),
      unknowns(formulas.unknowns),
      middle("middle", formulas.middle, {.differentiate = {"u"}, .backend = backend}),
      iterated("substep", formulas.iterated, {.backend = backend}) {
  Index first = 0;
  for (const VerletMultipliers::Block& block : formulas.blocks) {
    blocks.push_back(
        {.equations = EquationSystem("multipliers", block.formulas.inputs, block.formulas.outputs,
                                     {.backend = backend, .eliminates = false}),
         .is_affine = block.is_affine,
         .begins = block.begins,
         .first = first});
    first += block.size();
  }
}

MultiplierSolver::MultiplierSolver(const MultiplierFunctions& functions, Index parts,
                                   const std::string& method)
    : functions_(functions),
      method_(method),
      parts_(static_cast<std::size_t>(parts)),
      iterated_(functions.iterated.output_size() == 0
                    ? 0
                    : functions.iterated.output_size() - functions.middle.output_size()),
      u_(VectorXd::Zero(parts * functions.unknowns)),
      kept_(u_),
      predictor_({u_.size()}, extrapolated(functions, parts)),
      affine_(functions.blocks.size()),
      middle_(functions.middle.output_size() + functions.middle.nonzeros()),
      scales_(VectorXd::Zero(std::ssize(functions.blocks))) {
  for (std::size_t b = 0; b < functions.blocks.size(); ++b) {
    const MultiplierFunctions::Block& block = functions.blocks[b];
    solver_.push_back(solvers_a_part_);
    if (!block.is_affine) {
      ++solvers_a_part_;
      continue;
    }
    const Function& equations = block.equations.left();
    affine_[b] = {.solver = brief_linear_solver(ContainedUnknowns(equations).pattern),
                  .none = VectorXd::Zero(block.equations.size()),
                  .all = VectorXd(equations.output_size() + equations.nonzeros()),
                  .solution = VectorXd(block.equations.size())};
  }
  if (iterated_ == 0) make_solvers();
}

void MultiplierSolver::make_solvers() {
  const std::size_t count = parts_ * solvers_a_part_;
  if (solvers_.size() == count) return;
  solvers_.reserve(count);
  for (std::size_t i = 0; i < parts_; ++i)
    for (const MultiplierFunctions::Block& block : functions_.blocks)
      if (!block.is_affine)
        solvers_.emplace_back(block.equations, std::vector<Index>{block.equations.size()}, method_);
}

void MultiplierSolver::begin(const State& before, double h) {
  multipliers_ = before.z;
  if (!predictor_.is_empty())
    predictor_.predict(u_);
  else
    for (Index i = 0; i * functions_.unknowns < u_.size(); ++i)
      for (const MultiplierFunctions::Block& block : functions_.blocks)
        begun(block, unknowns(i) + block.first);
  const double size = coordinate_scale(before, h);
  // A multiplier is known as well as the point is that it moves, which goes with h.
  const double* in[] = {before.x.data(), &h, &before.t, u_.data()};
  functions_.middle.value_and_jacobian(in, middle_.data());
  const std::vector<Index>& column = functions_.middle.pattern_col();
  const double* const entries = middle_.data() + functions_.middle.output_size();
  for (std::size_t b = 0; b < functions_.moving; ++b) {
    const MultiplierFunctions::Block& block = functions_.blocks[b];
    double effect = 0.0;
    for (std::size_t k = 0; k < column.size(); ++k)
      if (column[k] >= block.first && column[k] < block.first + block.equations.size())
        effect = std::max(effect, std::fabs(entries[k]));
    scales_[static_cast<Index>(b)] = std::fabs(h) * size / (effect > 0.0 ? effect : 1.0);
  }
}

// The multipliers of the state.
void MultiplierSolver::begun(const MultiplierFunctions::Block& block, double* u) const {
  for (std::size_t k = 0; k < block.begins.size(); ++k) u[k] = multipliers_[block.begins[k]];
}

bool MultiplierSolver::moves(Index i, const double* x0, double h, double t, double* x1,
                             SolverStatistics& statistics) {
  double* const u = unknowns(i);
  const Index count = iterated_ / 2;
  const double* const values = x1 + functions_.middle.output_size();
  const double* const changes = values + count;
  const double part = kShort / std::fabs(h);
  const double* in[] = {x0, &h, &t, u};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    functions_.iterated.value(in, x1);
    statistics.iterations += VerletMultipliers::kIterations;
    bool are_short = true;
    for (Index b = 0; b < count; ++b) {
      u[b] = values[b];
      are_short &= std::fabs(changes[b]) <= part * scales_[b];
    }
    if (are_short) return true;
  }
  for (std::size_t b = 0; b < functions_.moving; ++b) begun(functions_.blocks[b], u + b);
  return false;
}

void MultiplierSolver::move(Index i, const double* x0, double h, double t,
                            SolverStatistics& statistics) {
  make_solvers();
  double* const u = unknowns(i);
  for (std::size_t b = 0; b < functions_.moving; ++b) {
    const MultiplierFunctions::Block& block = functions_.blocks[b];
    if (block.is_affine) {
      solve_affine(b, u, x0, &h, &t, statistics);
      continue;
    }
    StepSolver& solver = solvers_[static_cast<std::size_t>(i) * solvers_a_part_ + solver_[b]];
    double* const y = solver.unknown().data();
    std::copy_n(u + block.first, block.equations.size(), y);
    const double scale = scales_[static_cast<Index>(b)] / std::fabs(h);
    solver.solve(
        Inputs(y, {u, x0, &h, &t}), &scale, [&] { begun(block, y); }, {t, h}, statistics);
    std::copy_n(y, block.equations.size(), u + block.first);
  }
}

void MultiplierSolver::end(Index i, const double* x0, double h, double t,
                           SolverStatistics& statistics) {
  for (std::size_t b = functions_.moving; b < functions_.blocks.size(); ++b)
    solve_affine(b, unknowns(i), x0, &h, &t, statistics);
}

void MultiplierSolver::solve_affine(std::size_t b, double* u, const double* x0, const double* h,
                                    const double* t, SolverStatistics& statistics) {
  const MultiplierFunctions::Block& block = functions_.blocks[b];
  auto& [solver, none, all, solution] = affine_[b];
  const Function& equations = block.equations.left();
  const double* in[] = {none.data(), u, x0, h, t};
  equations.value_and_jacobian(in, all.data());
  ++statistics.factorizations;
  if (!solver->factorize(all.data() + equations.output_size()))
    throw SolveError(SolveError::Reason::singular, method_, *t, *h,
                     "has a matrix that is not finite; the state is at or near a singular point.");
  solver->solve(all.data(), solution.data());
  Eigen::Map<VectorXd>(u + block.first, solution.size()) = -solution;
}

void MultiplierSolver::keep() {
  kept_.swap(u_);
  predictor_.record(kept_);
}

void MultiplierSolver::forget() {
  predictor_.forget();
  for (StepSolver& solver : solvers_) solver.forget();
  for (const Affine& block : affine_)
    if (block.solver) block.solver->forget();
}

}  // namespace courant
