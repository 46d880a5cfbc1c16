#include "courant/manifolds/matrix_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <stdexcept>
#include <utility>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/generalized_eigenvalues.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {
namespace {

// Entries of bases are typed, and what is computed from them is exact but for some round-off.
constexpr double kLaw = 1e-12, kIndependent = 1e-9, kZero = 1e-13;
// Determinants of more rows are too long.
constexpr Index kDeterminantRows = 8;

VectorXd row_major(const MatrixXd& A) { return A.reshaped<Eigen::RowMajor>(); }
MatrixXd square_of(const VectorXd& a, Index m) { return a.reshaped<Eigen::RowMajor>(m, m); }

// The matrices, each as a column.
MatrixXd columns_of(const std::vector<MatrixXd>& matrices) {
  MatrixXd columns(matrices.front().size(), std::ssize(matrices));
  for (Index a = 0; a < columns.cols(); ++a)
    columns.col(a) = row_major(matrices[static_cast<std::size_t>(a)]);
  return columns;
}

MatrixXd without_round_off(const MatrixXd& A) {
  return A.unaryExpr([](double a) {
    const double near = std::round(a);
    return std::abs(a - near) <= kZero ? near : a;
  });
}

// The reduced row echelon form without its zero rows, and the columns of its pivots.
struct Echelon {
  MatrixXd rows;
  std::vector<Index> pivots;
};
Echelon echelon(MatrixXd A) {
  Echelon result;
  const double size = A.size() == 0 ? 0.0 : A.cwiseAbs().maxCoeff();
  Index row = 0;
  for (Index column = 0; column < A.cols() && row < A.rows(); ++column) {
    Index largest = row;
    A.col(column).tail(A.rows() - row).cwiseAbs().maxCoeff(&largest);
    largest += row;
    if (!(std::abs(A(largest, column)) > kIndependent * size)) continue;
    A.row(row).swap(A.row(largest));
    A.row(row) /= A(row, column);
    for (Index i = 0; i < A.rows(); ++i)
      if (i != row) A.row(i) -= A(i, column) * A.row(row).eval();
    result.pivots.push_back(column);
    ++row;
  }
  result.rows = without_round_off(A.topRows(row));
  return result;
}

// A basis of {y : A y = 0}, as rows.
MatrixXd kernel(const MatrixXd& A) {
  const Echelon reduced = echelon(A);
  std::vector<Index> free;
  for (Index j = 0; j < A.cols(); ++j)
    if (!std::ranges::binary_search(reduced.pivots, j)) free.push_back(j);
  MatrixXd result = MatrixXd::Zero(std::ssize(free), A.cols());
  for (Index k = 0; k < result.rows(); ++k) {
    const Index j = free[static_cast<std::size_t>(k)];
    result(k, j) = 1.0;
    for (std::size_t i = 0; i < reduced.pivots.size(); ++i)
      result(k, reduced.pivots[i]) = -reduced.rows(static_cast<Index>(i), j);
  }
  return result;
}

// The coefficients of independent matrices in what they span, read off single entries where that can be done.
MatrixXd coefficients_of(const std::vector<MatrixXd>& matrices) {
  const MatrixXd columns = columns_of(matrices);
  MatrixXd result = MatrixXd::Zero(columns.cols(), columns.rows());
  for (Index a = 0; a < columns.cols(); ++a) {
    Index e = 0;
    while (e < columns.rows() &&
           !(columns(e, a) != 0.0 && (columns.row(e).array() != 0.0).count() == 1))
      ++e;
    if (e == columns.rows())
      return without_round_off(
          CompleteOrthogonalDecomposition(columns, kIndependent).pseudo_inverse());
    result(a, e) = 1.0 / columns(e, a);
  }
  return result;
}

bool are_independent(const std::vector<MatrixXd>& matrices) {
  return CompleteOrthogonalDecomposition(columns_of(matrices), kIndependent).rank() ==
         std::ssize(matrices);
}

std::vector<MatrixXd> units(Index m) {
  std::vector<MatrixXd> result;
  for (Index e = 0; e < m * m; ++e) result.push_back(square_of(VectorXd::Unit(m * m, e), m));
  return result;
}

MatrixXd unit(Index m, Index i, Index j) {
  MatrixXd E = MatrixXd::Zero(m, m);
  E(i, j) = 1.0;
  return E;
}

std::string sized(const char* name, Index n, const char* least, bool is_right) {
  if (!is_right)
    throw std::invalid_argument(std::string("MatrixAlgebra::") + name + ": n is " +
                                std::to_string(n) + "; expected n ≥ " + least + ".");
  return std::string(name) + "(" + std::to_string(n) + ")";
}

}  // namespace

MatrixAlgebra::MatrixAlgebra(std::string name, std::vector<MatrixXd> basis,
                             std::optional<Coordinates> coordinates)
    : name_(std::move(name)), basis_(std::move(basis)) {
  const Index m = basis_.empty() ? 0 : basis_.front().rows();
  if (m == 0 || std::ranges::any_of(basis_, [&](const MatrixXd& B) {
        return B.rows() != m || B.cols() != m || !B.allFinite();
      }))
    throw std::invalid_argument("MatrixAlgebra: the basis has " + std::to_string(basis_.size()) +
                                " matrices; expected one or more, square, finite and of one size.");
  if (!are_independent(basis_))
    throw std::domain_error("MatrixAlgebra: the " + std::to_string(basis_.size()) +
                            " matrices of the basis are dependent; expected independent ones.");
  coordinates_ =
      coordinates ? std::move(*coordinates) : Coordinates{MatrixXd::Zero(m, m), units(m)};
  dual_ = coefficients_of(basis_);
  read_ = coefficients_of(coordinates_.directions);
  find_constants();
  find_hull();
  find_power_law();
  find_bounds();
  find_equations();
}

void MatrixAlgebra::find_constants() {
  const Index n = dimension();
  constants_.assign(basis_.size(), MatrixXd::Zero(n, n));
  unimodular_ = true;
  for (std::size_t a = 0; a < basis_.size(); ++a) {
    unimodular_ = unimodular_ && std::abs(basis_[a].trace()) <= kZero * basis_[a].norm();
    for (std::size_t b = 0; b < a; ++b) {
      const MatrixXd commutator = basis_[a] * basis_[b] - basis_[b] * basis_[a];
      const VectorXd parts = without_round_off(dual_ * row_major(commutator));
      MatrixXd rest = commutator;
      for (std::size_t c = 0; c < basis_.size(); ++c)
        rest -= parts[static_cast<Index>(c)] * basis_[c];
      const double size = basis_[a].norm() * basis_[b].norm();
      if (rest.norm() > kLaw * size)
        throw std::domain_error("MatrixAlgebra: the commutator of the matrices " +
                                std::to_string(b) + " and " + std::to_string(a) + " is " +
                                number_text(rest.norm()) +
                                " away from the span of the basis; expected an algebra that is "
                                "closed under brackets.");
      for (std::size_t c = 0; c < basis_.size(); ++c) {
        const auto i = static_cast<Index>(a), j = static_cast<Index>(b);
        constants_[c](i, j) = parts[static_cast<Index>(c)];
        constants_[c](j, i) = -parts[static_cast<Index>(c)];
      }
    }
  }
}

void MatrixAlgebra::find_hull() {
  const Index m = size();
  std::vector<MatrixXd> spanned = basis_;
  Echelon reduced;
  for (Index dimension_before = -1; std::ssize(reduced.pivots) != dimension_before;) {
    dimension_before = std::ssize(reduced.pivots);
    std::vector<MatrixXd> more = spanned;
    if (dimension_before > 0)
      for (const MatrixXd& A : spanned)
        for (const MatrixXd& B : basis_) more.push_back(A * B);
    reduced = echelon(columns_of(more).transpose());
    spanned.clear();
    for (Index k = 0; k < reduced.rows.rows(); ++k)
      spanned.push_back(square_of(reduced.rows.row(k), m));
  }
  pivots_ = reduced.pivots;
  hull_ = spanned;

  const MatrixXd A = columns_of(coordinates_.directions);
  const VectorXd origin = row_major(coordinates_.origin), one = row_major(MatrixXd::Identity(m, m));
  MatrixXd to_reach(m * m, std::ssize(hull_) + 1);
  to_reach.col(0) = one - origin;
  for (std::size_t p = 0; p < hull_.size(); ++p)
    to_reach.col(static_cast<Index>(p) + 1) = row_major(hull_[p]);
  if ((A * (read_ * to_reach) - to_reach).norm() > kLaw * (1.0 + to_reach.norm()))
    throw std::domain_error(name_ +
                            ": the coordinates of points do not reach the whole group; "
                            "expected matrices that span 1 and the products of the basis.");
  from_point_ = MatrixXd::Zero(m * m, A.cols());
  from_origin_ = one;
  for (std::size_t p = 0; p < hull_.size(); ++p) {
    const VectorXd D = row_major(hull_[p]);
    from_point_ += D * A.row(pivots_[p]);
    from_origin_ += D * (origin[pivots_[p]] - one[pivots_[p]]);
  }
  MatrixXd beside(m * m, A.cols() + 1);
  beside << A - from_point_, origin - from_origin_;
  affine_ = echelon(beside).rows;
}

void MatrixAlgebra::find_equations() {
  const Index m = size(), N = ambient_dimension();
  const Index wanted = N - dimension();
  MatrixXd gradients(wanted + 1, N);  // orthonormal rows
  Index found = 0;
  const auto is_new = [&](VectorXd gradient) {
    const double length = gradient.norm();
    for (int twice = 0; twice < 2; ++twice)
      gradient -= gradients.topRows(found).transpose() * (gradients.topRows(found) * gradient);
    if (!(gradient.norm() > kIndependent * length)) return false;
    gradients.row(found++) = gradient.normalized().transpose();
    return true;
  };
  for (Index k = 0; k < affine_.rows(); ++k) is_new(affine_.row(k).head(N));

  std::vector<MatrixXd> along;
  for (Index k = 0; k < N; ++k) along.push_back(square_of(from_point_.col(k), m));
  for (const bool covariant : {true, false})
    for (const double symmetry : {1.0, -1.0}) {
      std::vector<MatrixXd> trial;
      for (Index i = 0; i < m; ++i)
        for (Index j = i; j < m; ++j)
          if (i != j || symmetry > 0.0)
            trial.push_back(i == j ? unit(m, i, i)
                                   : (unit(m, i, j) + symmetry * unit(m, j, i)).eval());
      if (trial.empty()) continue;
      MatrixXd defect(dimension() * m * m, std::ssize(trial));
      for (Index k = 0; k < defect.cols(); ++k)
        for (Index a = 0; a < dimension(); ++a) {
          const MatrixXd& J = trial[static_cast<std::size_t>(k)];
          const MatrixXd& B = basis_[static_cast<std::size_t>(a)];
          defect.col(k).segment(a * m * m, m * m) = row_major(
              covariant ? (B.transpose() * J + J * B).eval() : (B * J + J * B.transpose()).eval());
        }
      const MatrixXd invariant = kernel(defect);
      for (Index k = 0; k < invariant.rows(); ++k) {
        Form form{MatrixXd::Zero(m, m), covariant};
        for (Index l = 0; l < defect.cols(); ++l)
          form.J += invariant(k, l) * trial[static_cast<std::size_t>(l)];
        if (covariant && !regular_form_ && LuDecomposition(form.J).pivot_ratio() > kIndependent)
          regular_form_ = form.J;
        forms_.push_back(form);
        for (Index i = 0; i < m; ++i)
          for (Index j = i; j < m && found < wanted; ++j) {
            VectorXd gradient(N);
            for (Index l = 0; l < N; ++l) {
              const MatrixXd& A = along[static_cast<std::size_t>(l)];
              gradient[l] = covariant ? (A.transpose() * form.J + form.J * A)(i, j)
                                      : (A * form.J + form.J * A.transpose())(i, j);
            }
            if (is_new(gradient)) kept_.push_back({std::ssize(forms_) - 1, i, j});
          }
      }
    }
  if (unimodular_ && found < wanted && m <= kDeterminantRows) {
    VectorXd gradient(N);
    for (Index l = 0; l < N; ++l) gradient[l] = along[static_cast<std::size_t>(l)].trace();
    if (is_new(gradient)) kept_.push_back({-1});
  }
  missing_ = wanted - found;
}

void MatrixAlgebra::find_power_law() {
  const Index m = size(), n = dimension();
  MatrixXd T(n, n);
  double largest = 0.0;
  for (Index a = 0; a < n; ++a) {
    const MatrixXd& A = basis_[static_cast<std::size_t>(a)];
    largest = std::max(largest, A.norm());
    for (Index b = 0; b < n; ++b) T(a, b) = (A * basis_[static_cast<std::size_t>(b)]).trace();
  }
  const bool nilpotent = T.cwiseAbs().maxCoeff() <= kZero * largest * largest;
  if (nilpotent) T.setZero();
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  std::vector<VectorXd> samples;
  for (int sample = 0; sample < 4; ++sample)
    samples.push_back(VectorXd::NullaryExpr(n, [&] { return normal(generator); }));
  const auto hold = [&](const auto& defect, Index power) {
    return std::ranges::all_of(samples, [&](const VectorXd& v) {
      MatrixXd V = MatrixXd::Zero(m, m);
      for (Index a = 0; a < n; ++a) V += v[a] * basis_[static_cast<std::size_t>(a)];
      return defect(V, v).norm() <= kLaw * std::pow(V.norm(), static_cast<double>(power));
    });
  };
  for (Index k = 0; k <= m; ++k)
    for (Index multiplicity = 1; multiplicity <= (nilpotent ? 1 : m); ++multiplicity) {
      const MatrixXd S = T / static_cast<double>(-multiplicity);
      const auto law = [&](const MatrixXd& V, const VectorXd& v) {
        MatrixXd power = MatrixXd::Identity(m, m);
        for (Index i = 0; i < k; ++i) power = power * V;
        return MatrixXd(V * V * power + v.dot(S * v) * power);
      };
      if (!hold(law, k + 2)) continue;
      const auto one_sided = [&](const MatrixXd& V, const VectorXd&) {
        return MatrixXd(V * V - V.trace() / static_cast<double>(multiplicity) * V);
      };
      power_law_ = PowerLaw{.k = k,
                            .S = S,
                            .multiplicity = nilpotent ? 0 : multiplicity,
                            .balanced = nilpotent || (unimodular_ && multiplicity % 2 == 0),
                            .one_sided = !nilpotent && hold(one_sided, 2)};
      return;
    }
}

void MatrixAlgebra::find_bounds() {
  if (power_law_) {
    const VectorXd values = symmetric_eigenvalues(power_law_->S);
    bounds_.imaginary = std::sqrt(std::max(0.0, values.maxCoeff()));
    bounds_.real = std::sqrt(std::max(0.0, -values.minCoeff()));
    bounds_.modulus = std::max(bounds_.imaginary, bounds_.real);
    return;
  }
  // |Im λ| ≤ ‖V - Vᵀ‖/2 and |Re λ| ≤ ‖V + Vᵀ‖/2 (Bendixson), and ‖Σ v_a B_a‖² ≤ ‖v‖² ‖Σ B_a B_aᵀ‖.
  const auto bound = [&](const auto& part) {
    MatrixXd rows = MatrixXd::Zero(size(), size()), columns = rows;
    for (const MatrixXd& B : basis_) {
      const MatrixXd A = part(B);
      rows += A * A.transpose();
      columns += A.transpose() * A;
    }
    return std::sqrt(std::min(symmetric_eigenvalues(rows).maxCoeff(),
                              symmetric_eigenvalues(columns).maxCoeff()));
  };
  bounds_.imaginary = bound([](const MatrixXd& B) { return (0.5 * (B - B.transpose())).eval(); });
  bounds_.real = bound([](const MatrixXd& B) { return (0.5 * (B + B.transpose())).eval(); });
  bounds_.modulus = bound([](const MatrixXd& B) { return B; });
}

MatrixAlgebra::Spectrum MatrixAlgebra::spectrum(const VectorXd& v) const {
  if (power_law_) {
    const double s = v.dot(power_law_->S * v);
    return {std::sqrt(std::max(0.0, s)), std::sqrt(std::max(0.0, -s))};
  }
  const MatrixXd V = values(hat(courant::constants(v)));
  const auto pencil = generalized_eigenvalues(V, MatrixXd::Identity(size(), size()));
  const Eigen::VectorXcd divisors = pencil.betas.cast<std::complex<double>>();
  const Eigen::VectorXcd lambda = pencil.alphas.cwiseQuotient(divisors);
  return {lambda.imag().cwiseAbs().maxCoeff(), lambda.real().cwiseAbs().maxCoeff()};
}

bool MatrixAlgebra::operator==(const MatrixAlgebra& other) const {
  return name_ == other.name_ && size() == other.size() && dimension() == other.dimension() &&
         ambient_dimension() == other.ambient_dimension() && basis_ == other.basis_ &&
         coordinates_.origin == other.coordinates_.origin &&
         coordinates_.directions == other.coordinates_.directions;
}

namespace {

// A y + b, without the terms that are zero.
ExprVector affine(const MatrixXd& A, const ExprVector& y, const VectorXd& b) {
  ExprVector result(A.rows());
  for (Index i = 0; i < A.rows(); ++i) {
    Expr sum = b[i];
    for (Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != 0.0) sum = sum + A(i, j) * y[j];
    result[i] = sum;
  }
  return result;
}

}  // namespace

ExprMatrix MatrixAlgebra::hat(const ExprVector& v) const {
  ExprMatrix V = ExprMatrix::Zero(size(), size());
  for (Index a = 0; a < dimension(); ++a) {
    const MatrixXd& B = basis_[static_cast<std::size_t>(a)];
    for (Index i = 0; i < size(); ++i)
      for (Index j = 0; j < size(); ++j)
        if (B(i, j) != 0.0) V(i, j) = V(i, j) + B(i, j) * v[a];
  }
  return V;
}

ExprVector MatrixAlgebra::vee(const ExprMatrix& V) const {
  return affine(dual_, vector_of(V), VectorXd::Zero(dimension()));
}

ExprMatrix MatrixAlgebra::matrix(const ExprVector& x) const {
  return matrix_of(affine(from_point_, x, from_origin_), size(), size());
}

ExprVector MatrixAlgebra::point(const ExprMatrix& X) const {
  return affine(read_, vector_of(X), -(read_ * row_major(coordinates_.origin)));
}

ExprVector MatrixAlgebra::velocity(const ExprMatrix& V) const {
  return affine(read_, vector_of(V), VectorXd::Zero(ambient_dimension()));
}

ExprMatrix MatrixAlgebra::inverse(const ExprMatrix& X) const {
  if (regular_form_) {
    const MatrixXd J = *regular_form_, J_inverse = without_round_off(LuDecomposition(J).inverse());
    return courant::constants(J_inverse) * X.transpose() * courant::constants(J);
  }
  return unimodular_ ? adjugate(X) : ExprMatrix(adjugate(X) / determinant(X));
}

ExprVector MatrixAlgebra::equations(const ExprVector& x) const {
  const Index N = ambient_dimension();
  ExprVector result(affine_.rows() + std::ssize(kept_));
  result.head(affine_.rows()) = affine(affine_.leftCols(N), x, affine_.col(N));
  const ExprMatrix X = matrix(x);
  Index row = affine_.rows();
  for (const Equation& equation : kept_) {
    if (equation.form < 0) {
      result[row++] = determinant(X) - 1.0;
      continue;
    }
    const auto& [J, covariant] = forms_[static_cast<std::size_t>(equation.form)];
    Expr sum = -J(equation.i, equation.j);
    for (Index k = 0; k < size(); ++k)
      for (Index l = 0; l < size(); ++l)
        if (J(k, l) != 0.0)
          sum = sum + J(k, l) * (covariant ? X(k, equation.i) * X(l, equation.j)
                                           : X(equation.i, k) * X(equation.j, l));
    result[row++] = sum;
  }
  return result;
}

MatrixAlgebra MatrixAlgebra::se2() {
  MatrixXd turn = unit(3, 1, 0) - unit(3, 0, 1);
  return {"se(2)",
          {turn, unit(3, 0, 2), unit(3, 1, 2)},
          Coordinates{unit(3, 2, 2),
                      {unit(3, 0, 0), unit(3, 0, 1), unit(3, 1, 0), unit(3, 1, 1), unit(3, 0, 2),
                       unit(3, 1, 2)}}};
}

MatrixAlgebra MatrixAlgebra::su2() {
  // p ↦ q p for the units q = 1, i, j, k.
  std::vector<MatrixXd> left(4, MatrixXd::Zero(4, 4));
  left[0].setIdentity();
  for (Index a = 0; a < 3; ++a) {
    const Index b = (a + 1) % 3, c = (a + 2) % 3;
    MatrixXd& q = left[static_cast<std::size_t>(a + 1)];
    q(a + 1, 0) = 1.0;
    q(0, a + 1) = -1.0;
    q(c + 1, b + 1) = 1.0;
    q(b + 1, c + 1) = -1.0;
  }
  return {"su(2)",
          {0.5 * left[1], 0.5 * left[2], 0.5 * left[3]},
          Coordinates{MatrixXd::Zero(4, 4), left}};
}

MatrixAlgebra MatrixAlgebra::gl(Index n) {
  const std::string name = sized("gl", n, "1", n >= 1);
  return {name, units(n)};
}

MatrixAlgebra MatrixAlgebra::sl(Index n) {
  const std::string name = sized("sl", n, "2", n >= 2);
  std::vector<MatrixXd> basis;
  for (Index i = 0; i + 1 < n; ++i) basis.push_back(unit(n, i, i) - unit(n, i + 1, i + 1));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      if (i != j) basis.push_back(unit(n, i, j));
  return {name, std::move(basis)};
}

MatrixAlgebra MatrixAlgebra::sp(Index n) {
  sized("sp", n, "1", n >= 1);
  std::vector<MatrixXd> basis;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) basis.push_back(unit(2 * n, i, j) - unit(2 * n, n + j, n + i));
  for (const bool upper : {true, false})
    for (Index i = 0; i < n; ++i)
      for (Index j = i; j < n; ++j) {
        const Index row = upper ? 0 : n, column = n - row;
        MatrixXd S = unit(2 * n, row + i, column + j);
        if (i != j) S += unit(2 * n, row + j, column + i);
        basis.push_back(std::move(S));
      }
  return {"sp(" + std::to_string(2 * n) + ")", std::move(basis)};
}

MatrixAlgebra MatrixAlgebra::heisenberg(Index n) {
  const std::string name = sized("heisenberg", n, "1", n >= 1);
  const Index m = n + 2;
  std::vector<MatrixXd> basis;
  for (Index i = 0; i < n; ++i) basis.push_back(unit(m, 0, i + 1));
  for (Index i = 0; i < n; ++i) basis.push_back(unit(m, i + 1, m - 1));
  basis.push_back(unit(m, 0, m - 1));
  Coordinates coordinates{MatrixXd::Identity(m, m), basis};
  return {name, std::move(basis), std::move(coordinates)};
}

MatrixAlgebra MatrixAlgebra::galilei() {
  std::vector<MatrixXd> basis;
  for (Index a = 0; a < 3; ++a) {
    const Index b = (a + 1) % 3, c = (a + 2) % 3;
    basis.push_back(unit(5, c, b) - unit(5, b, c));
  }
  for (const Index column : {Index{3}, Index{4}})
    for (Index a = 0; a < 3; ++a) basis.push_back(unit(5, a, column));
  basis.push_back(unit(5, 3, 4));
  return {"galilei", std::move(basis)};
}

}  // namespace courant
