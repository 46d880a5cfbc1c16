#include "courant/extensions/petsc/petsc_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "courant/core/solve/contraction.hpp"
#include "courant/extensions/petsc/equation_rows.hpp"
#include "courant/extensions/petsc/petsc_call.hpp"

namespace courant {
namespace {

// As in Newton: relative error that is accepted, contraction above which a new matrix is worth its price, changes
// that are round-off where they do not become smaller, and those that are round-off everywhere.
constexpr double kAccepted = 1e-17, kSlow = 0.2, kStalled = 0.5, kRoundOff = 1e-9;
constexpr double kLeast = 2.0 * std::numeric_limits<double>::epsilon();
constexpr PetscInt kMostIterations = 60;

}  // namespace

PetscPart::PetscPart(MPI_Comm team, Message& message) : team_(team) {
  const std::string name = message.take_text();
  const auto kind = static_cast<Backend::Kind>(message.take_one<std::int32_t>());
  const auto offset = static_cast<PetscInt>(message.take_one<std::int64_t>());
  owned_ = static_cast<std::size_t>(message.take_one<std::int64_t>());
  const auto ghosts = message.take<PetscInt>();
  const EquationRows rows = EquationRows::taken_from(message);
  rows_ = rows.compile(name, Backend(kind));
  parameters_.resize(static_cast<std::size_t>(rows.parameters));
  all_.resize(static_cast<std::size_t>(rows_.output_size() + rows_.nonzeros()));
  make_matrix(team, offset, ghosts);
  make_solver(team);
}

PetscPart::~PetscPart() {
  SNESDestroy(&snes_);
  MatDestroy(&matrix_);
  VecDestroy(&residual_);
  VecDestroy(&u_);
}

void PetscPart::make_matrix(MPI_Comm team, PetscInt offset, const std::vector<PetscInt>& ghosts) {
  const auto own = static_cast<PetscInt>(owned_);
  require_petsc(VecCreateGhost(team, own, PETSC_DETERMINE, static_cast<PetscInt>(ghosts.size()),
                               ghosts.data(), &u_));
  require_petsc(VecDuplicate(u_, &residual_));
  std::vector<PetscInt> row, column;
  for (const Index i : rows_.pattern_row()) row.push_back(offset + static_cast<PetscInt>(i));
  for (const Index j : rows_.pattern_col())
    column.push_back(j < own ? offset + static_cast<PetscInt>(j)
                             : ghosts[static_cast<std::size_t>(j - own)]);
  require_petsc(MatCreate(team, &matrix_));
  require_petsc(MatSetSizes(matrix_, own, own, PETSC_DETERMINE, PETSC_DETERMINE));
  require_petsc(MatSetType(matrix_, MATAIJ));
  require_petsc(MatSetFromOptions(matrix_));
  require_petsc(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(row.size()), row.data(),
                                       column.data()));
}

void PetscPart::make_solver(MPI_Comm team) {
  require_petsc(SNESCreate(team, &snes_));
  require_petsc(SNESSetFunction(snes_, residual_, evaluate, this));
  require_petsc(SNESSetJacobian(snes_, matrix_, matrix_, linearize, this));
  require_petsc(SNESSetTolerances(snes_, 0.0, 0.0, 0.0, kMostIterations, PETSC_MAX_INT));
  require_petsc(SNESSetConvergenceTest(snes_, look, this, nullptr));
  SNESLineSearch search = nullptr;
  require_petsc(SNESGetLineSearch(snes_, &search));
  require_petsc(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  KSP linear = nullptr;
  PC factors = nullptr;
  require_petsc(SNESGetKSP(snes_, &linear));
  require_petsc(KSPSetType(linear, KSPPREONLY));
  require_petsc(KSPGetPC(linear, &factors));
  require_petsc(PCSetType(factors, PCLU));
#ifdef PETSC_HAVE_MUMPS
  require_petsc(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS));
#endif
  require_petsc(SNESSetFromOptions(snes_));
}

// Calls with the numbers of the unknowns that the rows read, and of the parameters.
template <class Evaluate>
void PetscPart::at(Vec u, const Evaluate& evaluate) {
  Vec local = nullptr;
  const PetscScalar* numbers = nullptr;
  require_petsc(VecGhostUpdateBegin(u, INSERT_VALUES, SCATTER_FORWARD));
  require_petsc(VecGhostUpdateEnd(u, INSERT_VALUES, SCATTER_FORWARD));
  require_petsc(VecGhostGetLocalForm(u, &local));
  require_petsc(VecGetArrayRead(local, &numbers));
  const double* const in[] = {numbers, parameters_.data()};
  evaluate(in);
  require_petsc(VecRestoreArrayRead(local, &numbers));
  require_petsc(VecGhostRestoreLocalForm(u, &local));
}

PetscErrorCode PetscPart::evaluate(SNES, Vec u, Vec residual, void* part) {
  auto& self = *static_cast<PetscPart*>(part);
  try {
    PetscScalar* out = nullptr;
    require_petsc(VecGetArrayWrite(residual, &out));
    self.at(u, [&](const double* const* in) { self.rows_.value(in, out); });
    require_petsc(VecRestoreArrayWrite(residual, &out));
    return 0;
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
}

PetscErrorCode PetscPart::linearize(SNES, Vec u, Mat, Mat, void* part) {
  auto& self = *static_cast<PetscPart*>(part);
  if (self.keeps_) return 0;
  try {
    self.at(u,
            [&](const double* const* in) { self.rows_.value_and_jacobian(in, self.all_.data()); });
    require_petsc(
        MatSetValuesCOO(self.matrix_, self.all_.data() + self.rows_.output_size(), INSERT_VALUES));
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  ++self.factorizations_;
  self.is_fresh_ = self.keeps_ = true;
  self.compared_ = 0;
  return 0;
}

PetscErrorCode PetscPart::look(SNES snes, PetscInt iteration, PetscReal, PetscReal,
                               PetscReal residual, SNESConvergedReason* reason, void* part) {
  try {
    *reason = static_cast<PetscPart*>(part)->judge(snes, iteration, residual);
    return 0;
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
}

SNESConvergedReason PetscPart::judge(SNES snes, PetscInt iteration, double residual) {
  if (!std::isfinite(residual)) return SNES_DIVERGED_FNORM_NAN;
  norm_ = residual;
  if (iteration == 0) return residual == 0.0 ? SNES_CONVERGED_FNORM_ABS : SNES_CONVERGED_ITERATING;
  Vec u = nullptr, change = nullptr;
  require_petsc(SNESGetSolution(snes, &u));
  require_petsc(SNESGetSolutionUpdate(snes, &change));
  const PetscScalar *at = nullptr, *by = nullptr;
  require_petsc(VecGetArrayRead(u, &at));
  require_petsc(VecGetArrayRead(change, &by));
  const std::size_t count = scales_.size();
  std::vector<double> largest(2 * count, 0.0);  // sizes, then changes
  for (std::size_t g = 0, k = 0; g < count; ++g)
    for (; k < ends_[g]; ++k) {
      largest[g] = std::max(largest[g], std::fabs(at[k]));
      double& moved = largest[count + g];
      moved = std::isfinite(by[k]) ? std::max(moved, std::fabs(by[k]))
                                   : std::numeric_limits<double>::infinity();
    }
  require_petsc(VecRestoreArrayRead(change, &by));
  require_petsc(VecRestoreArrayRead(u, &at));
  require_mpi(MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()),
                            MPI_DOUBLE, MPI_MAX, team_));
  double moved = 0.0, slowest = 0.0;
  moved_.resize(count);
  for (std::size_t g = 0; g < count; ++g) {
    const double now = contraction::relative(largest[count + g], std::max(scales_[g], largest[g]));
    const double before = std::exchange(moved_[g], now);
    if (now > kLeast) slowest = std::max(slowest, now / before);
    moved = std::max(moved, now);
  }
  if (!std::isfinite(moved)) return SNES_DIVERGED_FNORM_NAN;
  if (moved <= kAccepted) return SNES_CONVERGED_SNORM_RELATIVE;
  ++compared_;
  if (compared_ > 1) {
    if (contraction::has_ended(moved, previous_, kAccepted) &&
        (count == 1 || contraction::has_ended_everywhere(moved, slowest, kAccepted)))
      return SNES_CONVERGED_SNORM_RELATIVE;
    const double part = moved / previous_;
    const bool stalled = part > kStalled;
    if (stalled && moved <= (is_fresh_ ? kRoundOff : kLeast)) return SNES_CONVERGED_SNORM_RELATIVE;
    if (part > kSlow && moved > 1e3 * kAccepted) keeps_ = false;
  }
  previous_ = moved;
  return iteration < kMostIterations ? SNES_CONVERGED_ITERATING : SNES_DIVERGED_MAX_IT;
}

EngineEquations::Answer PetscPart::solve(double* numbers, const std::vector<double>& scales,
                                         bool keeps_matrix, bool is_damped) {
  scales_ = scales;
  keeps_ = keeps_matrix;
  is_fresh_ = false;
  compared_ = factorizations_ = 0;
  SNESLineSearch search = nullptr;
  SNESLineSearchType usual = nullptr;
  if (is_damped) {
    require_petsc(SNESGetLineSearch(snes_, &search));
    require_petsc(SNESLineSearchGetType(search, &usual));
    require_petsc(SNESLineSearchSetType(search, SNESLINESEARCHBT));
  }
  const std::string back = usual == nullptr ? "" : usual;
  PetscScalar* u = nullptr;
  require_petsc(VecGetArrayWrite(u_, &u));
  std::copy_n(numbers, owned_, u);
  require_petsc(VecRestoreArrayWrite(u_, &u));
  std::copy_n(numbers + owned_, parameters_.size(), parameters_.begin());
  ends_.clear();
  for (std::size_t g = 0; g < scales.size(); ++g)
    ends_.push_back(static_cast<std::size_t>(numbers[owned_ + parameters_.size() + g]));
  require_petsc(SNESSolve(snes_, nullptr, u_));
  if (is_damped) require_petsc(SNESLineSearchSetType(search, back.c_str()));
  const PetscScalar* found = nullptr;
  require_petsc(VecGetArrayRead(u_, &found));
  std::copy_n(found, owned_, numbers);
  require_petsc(VecRestoreArrayRead(u_, &found));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  require_petsc(SNESGetConvergedReason(snes_, &reason));
  require_petsc(SNESGetIterationNumber(snes_, &iterations));
  return {.has_converged = reason > 0,
          .is_finite = reason != SNES_DIVERGED_FNORM_NAN && reason != SNES_DIVERGED_LINEAR_SOLVE,
          .iterations = static_cast<int>(iterations),
          .factorizations = factorizations_,
          .residual = norm_};
}

}  // namespace courant
