#include "courant/integrators/step/transported_conormals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "courant/core/algebra/elimination.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/plain_products.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/solver_choice.hpp"

namespace courant {
namespace {

// The ladder decided this rank with a gap; here it only has to be found again. Points of a long run are on
// their manifold up to 1e-14 times the squares of their coordinates, and entries that should be zero are as
// large: they are errors of data too, and choose no units.
constexpr double kDataError = 2e-12;

// What is left of an equation, relative to its largest term, where least squares meet it.
constexpr double kMet = 1e-9;

// Where one of so many, which have nothing to do with each other, is at right angles to the conormals, another is not.
constexpr int kReferences = 3;

// The first m rows of a matrix, and those after them; entries stay in order.
std::pair<MatrixPattern, MatrixPattern> parts(const SparseExprMatrix& matrix, Index m) {
  MatrixPattern first{.rows = m, .columns = matrix.cols, .row = {}, .column = {}}, second = first;
  second.rows = matrix.rows - m;
  for (std::size_t k = 0; k < matrix.row.size(); ++k) {
    MatrixPattern& part = matrix.row[k] < m ? first : second;
    part.row.push_back(matrix.row[k] < m ? matrix.row[k] : matrix.row[k] - m);
    part.column.push_back(matrix.col[k]);
  }
  return {first, second};
}

}  // namespace

TransportedConormals::Functions::Functions(const Formulas& of, Backend backend)
    : constraints("constraints", of.constraints,
                  {.differentiate = {of.constraints.inputs.front().name}}),
      matrices("conormal equations", of.matrices, {.backend = backend}),
      A(of.A),
      P(of.P),
      sizes(of.sizes) {}

TransportedConormals::Formulas TransportedConormals::trace(
    const Graph& graph, const ExprVector& F, const ExprVector& jets, Index n, Index d,
    const std::vector<Function::Input>& parameters, const VectorXd& sizes) {
  Formulas result;
  result.sizes = sizes;
  std::vector<Function::Input> inputs = {{"y", jets}};
  inputs.insert(inputs.end(), parameters.begin(), parameters.end());
  result.constraints = {inputs, F};
  const ExprVector w = graph.variables("w", F.size());
  const ExprVector entries = graph.variables("C", n * d);
  const ExprVector pulled = pull_back(F, jets, w);
  ExprVector conormal = pulled.head(n);
  if (sizes.size() > 0) conormal = conormal.cwiseProduct(constants(sizes.cwiseInverse())).eval();
  std::vector<Expr> equations;
  for (const Expr& component : pulled.tail(pulled.size() - n))
    if (!component.is_constant() || component.value() != 0.0) equations.push_back(component);
  // The last d equations: their coefficients contain C, so that none of them gives an entry of w.
  const ExprVector along =
      Eigen::Map<const ExprMatrix>(entries.data(), n, d).transpose() * conormal;
  equations.insert(equations.end(), along.begin(), along.end());
  const Elimination elimination(Eigen::Map<ExprVector>(equations.data(), std::ssize(equations)), w,
                                {});
  const SparseExprMatrix both =
      jacobian(joined(elimination.equations, substitute(conormal, w, elimination.unknowns)),
               w(elimination.kept));
  std::tie(result.A, result.P) = parts(both, elimination.equations.size());
  inputs.push_back({"C", entries});
  result.matrices = {inputs, both.values};
  return result;
}

std::vector<MatrixXd> TransportedConormals::references(const MatrixXd& at_point) {
  std::vector<MatrixXd> result = {at_point};
  std::mt19937 generator(1);
  // Those of the standard are the same everywhere, distributions are not.
  const auto number = [&] {
    return static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 0.5;
  };
  for (int k = 1; k < kReferences; ++k)
    result.push_back(
        orthonormalized(MatrixXd::NullaryExpr(at_point.rows(), at_point.cols(), number)));
  return result;
}

TransportedConormals::TransportedConormals(Functions functions, Index n, Index d,
                                           std::vector<MatrixXd> references)
    : functions_(std::move(functions)),
      n_(n),
      d_(d),
      solver_(brief_linear_solver(functions_.A)),
      references_(std::move(references)),
      conormals_(MatrixXd::Zero(n, d)),
      kept_(conormals_),
      entries_(functions_.matrices.output_size()),
      given_(functions_.A.rows),
      weights_(functions_.A.columns),
      covectors_(n, d),
      make_orthonormal_(d) {}

void TransportedConormals::move_to(const Point& point) {
  if (d_ == 0) return;
  if (is_found_ ? continue_to(point, kept_) : start_at(point)) return;
  find(point);
}

// From a reference, in the basis at this point.
bool TransportedConormals::start_at(const Point& point) {
  return std::ranges::any_of(references_, [&](const MatrixXd& reference) {
    const Index size = reference.rows();
    if (size == n_) return continue_to(point, reference);
    MatrixXd from(n_, d_);
    multiply_transposed_plainly(Eigen::Map<const MatrixXd>(point.basis, size, n_), reference, from);
    return continue_to(point, from);
  });
}

void TransportedConormals::keep() {
  kept_ = conormals_;
  is_found_ = true;
}

void TransportedConormals::discard() { conormals_ = kept_; }

void TransportedConormals::take_over(const TransportedConormals& other) {
  kept_ = conormals_ = other.kept_;
  is_found_ = other.is_found_;
}

void TransportedConormals::forget() {
  is_found_ = false;
  solver_->forget();
  kept_.setZero();
  conormals_.setZero();
}

bool TransportedConormals::continue_to(const Point& point, const MatrixXd& from) {
  const auto& [constraints, matrices, A, P, sizes] = functions_;
  const double* in[] = {point.jets, point.origin, point.basis, point.t, from.data()};
  matrices.value(in, entries_.data());
  if (!solver_->factorize(entries_.data())) return false;
  const double* const of_P = entries_.data() + A.row.size();
  const bool is_regular = solver_->is_determined() && A.rows == A.columns;
  covectors_.setZero();
  for (Index j = 0; j < d_; ++j) {
    given_.setZero();
    given_[A.rows - d_ + j] = 1.0;
    solver_->solve(given_.data(), weights_.data());
    if (!is_regular && !is_met()) return false;
    double* const covector = covectors_.col(j).data();
    for (std::size_t k = 0; k < P.row.size(); ++k)
      covector[P.row[k]] += of_P[k] * weights_[P.column[k]];
  }
  return make_orthonormal_(covectors_, conormals_) ||  // of C + N with CᵀN = 0
         make_orthonormal_.from_afar(covectors_, conormals_);
}

// Whether least squares for u_j solve its equations.
bool TransportedConormals::is_met() const {
  const MatrixPattern& A = functions_.A;
  VectorXd left = -given_;
  double largest = 1.0;
  for (std::size_t k = 0; k < A.row.size(); ++k) {
    const double term = entries_[static_cast<Index>(k)] * weights_[A.column[k]];
    left[A.row[k]] += term;
    largest = std::max(largest, std::fabs(term));
  }
  return left.lpNorm<Eigen::Infinity>() <= kMet * largest;
}

// Where an unknown besides ξ is in one equation alone, no combination that is free of it contains this
// equation. Without the two the others may have such an unknown in turn. Of the derivative array of a
// network with a loop of capacitors this leaves the equation of the loop alone, whose decomposition is
// small, where that of all equations takes minutes for thousands of them.
TransportedConormals::Core TransportedConormals::core(const VectorXd& all) const {
  const Function& f = functions_.constraints;
  const Index rows = f.output_size();
  std::vector<std::vector<Index>> of_row(static_cast<std::size_t>(rows));
  std::vector<std::vector<Index>> of_column(static_cast<std::size_t>(f.input_size(0)));
  for (std::size_t k = 0; k < f.pattern_row().size(); ++k) {
    const Index i = f.pattern_row()[k], j = f.pattern_col()[k];
    if (j < n_ || all[rows + static_cast<Index>(k)] == 0.0) continue;
    of_row[static_cast<std::size_t>(i)].push_back(j);
    of_column[static_cast<std::size_t>(j)].push_back(i);
  }
  std::vector<bool> is_left(static_cast<std::size_t>(rows), true);
  std::vector<Index> in_rows, alone;
  for (std::size_t j = 0; j < of_column.size(); ++j) {
    in_rows.push_back(std::ssize(of_column[j]));
    if (in_rows.back() == 1) alone.push_back(static_cast<Index>(j));
  }
  while (!alone.empty()) {
    const auto j = static_cast<std::size_t>(alone.back());
    alone.pop_back();
    const auto row = std::ranges::find_if(
        of_column[j], [&](Index i) { return is_left[static_cast<std::size_t>(i)]; });
    if (row == of_column[j].end()) continue;
    is_left[static_cast<std::size_t>(*row)] = false;
    for (const Index other : of_row[static_cast<std::size_t>(*row)])
      if (--in_rows[static_cast<std::size_t>(other)] == 1) alone.push_back(other);
  }
  Core result;
  for (Index i = 0; i < rows; ++i)
    if (is_left[static_cast<std::size_t>(i)]) result.rows.push_back(i);
  for (std::size_t j = 0; j < in_rows.size(); ++j)
    if (in_rows[j] > 0) result.columns.push_back(static_cast<Index>(j));
  return result;
}

void TransportedConormals::find(const Point& point) {
  const double* in[] = {point.jets, point.origin, point.basis, point.t};
  const Function& f = functions_.constraints;
  VectorXd all(f.output_size() + f.nonzeros());
  f.value_and_jacobian(in, all.data());
  if (!all.tail(f.nonzeros()).allFinite()) {
    // The solver that asked for this point will find it no better.
    conormals_.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto [rows, columns] = core(all);
  std::vector<Index> row_place(static_cast<std::size_t>(f.output_size()), -1);
  std::vector<Index> column_place(static_cast<std::size_t>(f.input_size(0)), -1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    row_place[static_cast<std::size_t>(rows[i])] = static_cast<Index>(i);
  for (std::size_t j = 0; j < columns.size(); ++j)
    column_place[static_cast<std::size_t>(columns[j])] = static_cast<Index>(j);
  MatrixXd by_xi = MatrixXd::Zero(std::ssize(rows), n_);
  MatrixXd by_others = MatrixXd::Zero(std::ssize(rows), std::ssize(columns));
  for (std::size_t k = 0; k < f.pattern_row().size(); ++k) {
    const Index i = row_place[static_cast<std::size_t>(f.pattern_row()[k])];
    const Index column = f.pattern_col()[k];
    const Index j = column < n_ ? column : column_place[static_cast<std::size_t>(column)];
    if (i < 0 || j < 0) continue;
    (column < n_ ? by_xi : by_others)(i, j) += all[f.output_size() + static_cast<Index>(k)];
  }
  // Combinations of equations that contain dξ alone do not depend on the units of the other unknowns;
  // equations without those are measured by what they say of ξ.
  const Equilibration<MatrixXd> S = equilibrate(by_others, kDataError);
  VectorXd row = S.row_scale;
  for (Index i = 0; i < by_xi.rows(); ++i) {
    const double size = by_xi.row(i).lpNorm<Eigen::Infinity>();
    if (by_others.row(i).isZero(0.0) && size > 0.0) row[i] = 1.0 / size;
  }
  const CompleteOrthogonalDecomposition others(S.scaled, kDataError);
  const MatrixXd Q = others.Q();
  const MatrixXd gradients =
      (Q.rightCols(by_xi.rows() - others.rank()).transpose() * row.asDiagonal() * by_xi)
          .transpose();
  conormals_ = QrDecomposition::pivoted(
                   functions_.sizes.size() == 0
                       ? gradients
                       : MatrixXd(functions_.sizes.cwiseInverse().asDiagonal() * gradients))
                   .Q(d_);
}

}  // namespace courant
