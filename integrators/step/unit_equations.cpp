#include "courant/integrators/step/unit_equations.hpp"

#include <cmath>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {
namespace {

// Parts of vectors of length 1 below this are rounding errors of their decomposition.
constexpr double kNoPart = 1e-9;

}  // namespace

UnitEquations::UnitEquations(const UnitNumbering& numbering, Index rows, Index columns)
    : rows_(rows) {
  const Index n = std::ssize(numbering), own = Manifold::ScalingSymmetries::after(numbering);
  const Index unknowns = rows + own + columns - 2 * n + 1;  // logarithms of r, units of ξ, z, T
  C_ = MatrixXd::Zero(columns, unknowns);
  for (Index j = 0; j < n; ++j) {
    const Index unit = numbering[static_cast<std::size_t>(j)];
    if (unit != Manifold::ScalingSymmetries::none)
      C_(j, rows + unit) = C_(n + j, rows + unit) = 1.0;
    C_(n + j, unknowns - 1) = -1.0;
  }
  for (Index j = 2 * n; j < columns; ++j) C_(j, rows + own + j - 2 * n) = 1.0;
  A_ = MatrixXd::Zero(unknowns, unknowns);
  b_ = VectorXd::Zero(unknowns);
}

// (Σ parts + log size)², for a few of the unknowns s.
void UnitEquations::add_term(const std::vector<Part>& parts, double size) {
  for (const Part& a : parts) {
    for (const Part& b : parts) A_(a.unknown, b.unknown) += a.factor * b.factor;
    b_[a.unknown] -= std::log(size) * a.factor;
  }
}

std::vector<UnitEquations::Part> UnitEquations::column_parts(Index column) const {
  std::vector<Part> parts;
  for (Index k = rows_; k < C_.cols(); ++k)
    if (C_(column, k) != 0.0) parts.push_back({k, C_(column, k)});
  return parts;
}

void UnitEquations::add_entry(Index row, Index column, double size) {
  std::vector<Part> parts = column_parts(column);
  parts.push_back({row, 1.0});
  add_term(parts, size);
}

void UnitEquations::add_constant(Index row, double size) {
  A_(row, row) += 1.0;
  b_[row] -= std::log(size);
}

void UnitEquations::add_slope(Index column, double size) {
  add_term(column < C_.rows() ? column_parts(column) : std::vector<Part>{{C_.cols() - 1, 1.0}},
           size);
}

VectorXd UnitEquations::columns(const VectorXd& sizes) const {
  const CompleteOrthogonalDecomposition normal(A_, 1e-12);
  VectorXd s = normal.solve(b_);
  const MatrixXd open = normal.Q().rightCols(A_.cols() - normal.rank());
  std::vector<Index> known;
  for (Index j = 0; j < sizes.size(); ++j)
    if (sizes[j] > 0.0) known.push_back(j);
  if (open.cols() > 0 && !known.empty()) {
    const VectorXd size = sizes(known).array().log();
    const MatrixXd K = C_(known, Eigen::all);
    // Next to columns of length 1: what is open may have nothing to do with what is known.
    const MatrixXd seen =
        (K * open).unaryExpr([](double part) { return std::fabs(part) > kNoPart ? part : 0.0; });
    s += open * CompleteOrthogonalDecomposition(seen, 1e-12).solve(size - K * s);
  }
  return (C_ * s).array().exp();
}

}  // namespace courant
