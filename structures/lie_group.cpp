#include "courant/structures/lie_group.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

namespace courant {

bool is_group_of(const std::shared_ptr<const Manifold>& G, const LieAlgebra& g) {
  const auto unit = G->unit();
  const Index n = g.dimension();
  if (!unit || G->tangent_dimension() != n) return false;
  const CotangentBundle T(G);
  const ExprVector e = constants(*unit);
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i) {
      const VectorXd torsion = values(T.torsion(e, ExprVector::Unit(n, k), ExprVector::Unit(n, i)));
      const VectorXd bracket = g.constants()[static_cast<std::size_t>(k)].row(i);
      if (!((torsion + bracket).cwiseAbs().maxCoeff() <= 1e-12)) return false;
    }
  return true;
}

namespace {

// ad(e_i): the matrix of [e_i, ·].
std::vector<MatrixXd> adjoint_matrices(const LieAlgebra& g) {
  const Index n = g.dimension();
  std::vector<MatrixXd> basis(static_cast<std::size_t>(n), MatrixXd(n, n));
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < n; ++k)
      basis[static_cast<std::size_t>(i)].row(k) = g.constants()[static_cast<std::size_t>(k)].row(i);
  return basis;
}

// Null where the matrices are dependent (those of an algebra with a centre), or equations of the group are not found.
std::shared_ptr<const Manifold> matrix_group(const LieAlgebra& g) {
  try {
    return std::make_shared<MatrixGroup>(
        g.matrices() ? *g.matrices() : MatrixAlgebra("ad " + g.name(), adjoint_matrices(g)));
  } catch (const std::logic_error&) {  // domain_error, or invalid_argument for n = 0
    return nullptr;
  }
}

}  // namespace

std::shared_ptr<const Manifold> group_of(const LieAlgebra& g) {
  if (g.matrices()) return matrix_group(g);
  std::vector<std::shared_ptr<const Manifold>> groups = {
      std::make_shared<SpecialOrthogonal3>(), std::make_shared<SpecialEuclidean3>(),
      std::make_shared<Euclidean>(g.dimension())};
  for (Index n = 2; n * (n - 1) / 2 <= g.dimension(); ++n)
    groups.push_back(std::make_shared<SpecialOrthogonal>(n));
  const auto found =
      std::ranges::find_if(groups, [&](const auto& group) { return is_group_of(group, g); });
  return found == groups.end() ? matrix_group(g) : *found;
}

namespace {

// Polynomials of at most so many factors, and at most so many of them, are tried; and so many numbers are
// sought for a row of A(x).
constexpr Index kDegree = 3, kMonomials = 600, kRowUnknowns = 1500;
// Below it, next to 1, is round-off of the equations for coefficients, which are numbers of that size.
constexpr double kFound = 1e-9;
// Coefficients are multiples of 1/24 in all the usual cases: these are what they are within kFound.
constexpr double kFractions = 24.0;

// x_i x_j …, by the i ≤ j ≤ … ; the empty product is 1.
using Monomial = std::vector<Index>;

std::vector<Monomial> monomials(Index N, Index degree) {
  std::vector<Monomial> all{{}};
  std::size_t begin = 0;
  for (Index k = 0; k < degree; ++k) {
    const std::size_t end = all.size();
    for (; begin < end; ++begin)
      for (Index i = all[begin].empty() ? 0 : all[begin].back(); i < N; ++i) {
        all.push_back(all[begin]);
        all.back().push_back(i);
      }
  }
  return all;
}

template <class Vector>
auto value_of(const Monomial& monomial, const Vector& x) {
  typename Vector::Scalar product = 1.0;
  for (const Index i : monomial) product = product * x[i];
  return product;
}

double rate_of(const Monomial& monomial, const VectorXd& x, const VectorXd& rate) {
  double sum = 0.0;
  for (std::size_t k = 0; k < monomial.size(); ++k) {
    double product = rate[monomial[k]];
    for (std::size_t j = 0; j < monomial.size(); ++j)
      if (j != k) product *= x[monomial[j]];
    sum += product;
  }
  return sum;
}

// Monomials that are independent functions on G, and how left-invariant fields act on them:
// X_a m_j = Σ_k m_k L_a(k, j).
struct FunctionsOnGroup {
  std::vector<Monomial> basis;
  std::vector<MatrixXd> L;
};

FunctionsOnGroup functions_on(const Manifold& G, const std::vector<Monomial>& all) {
  constexpr Index kMore = 20;
  const auto count = static_cast<Index>(all.size()), n = G.tangent_dimension();
  std::mt19937 generator(1);
  MatrixXd at_points(count + kMore, count);
  std::vector<MatrixXd> rates(static_cast<std::size_t>(n), at_points);
  for (Index s = 0; s < at_points.rows(); ++s) {
    const VectorXd x = G.random_point(generator);
    const MatrixXd frame = G.frame(x);
    for (Index j = 0; j < count; ++j) {
      const Monomial& monomial = all[static_cast<std::size_t>(j)];
      at_points(s, j) = value_of(monomial, x);
      for (Index a = 0; a < n; ++a)
        rates[static_cast<std::size_t>(a)](s, j) = rate_of(monomial, x, frame.col(a));
    }
  }
  const CompleteOrthogonalDecomposition found(at_points, 1e-12);
  std::vector<Index> chosen(found.order().begin(), found.order().begin() + found.rank());
  std::ranges::sort(chosen);
  const CompleteOrthogonalDecomposition independent(at_points(Eigen::all, chosen));
  FunctionsOnGroup result;
  for (const Index j : chosen) result.basis.push_back(all[static_cast<std::size_t>(j)]);
  for (const MatrixXd& rate : rates)
    result.L.push_back(independent.solve(rate(Eigen::all, chosen)));
  return result;
}

// The coefficients C_k (d × d) of A(x) = Σ_k C_k m_k(x) with X_a A = A ρ_a and A(e) = 1, which determine
// A; none if they are not the functions of a representation. Row i of all C_k, as a matrix c (k, j), is
// the solution of L_a c = c ρ_a, m(e)ᵀ c = e_iᵀ.
std::vector<MatrixXd> action_coefficients(const FunctionsOnGroup& functions, const VectorXd& unit,
                                          const std::vector<MatrixXd>& rho) {
  const auto r = static_cast<Index>(functions.basis.size());
  const Index d = rho.front().rows(), n = std::ssize(rho);
  MatrixXd A = MatrixXd::Zero(n * r * d + d, r * d), B = MatrixXd::Zero(A.rows(), d);
  for (Index a = 0; a < n; ++a)
    for (Index j = 0; j < d; ++j) {
      const auto place = static_cast<std::size_t>(a);
      A.block((a * d + j) * r, j * r, r, r) += functions.L[place];
      for (Index l = 0; l < d; ++l)
        A.block((a * d + j) * r, l * r, r, r).diagonal().array() -= rho[place](l, j);
    }
  for (Index j = 0; j < d; ++j) {
    for (Index k = 0; k < r; ++k)
      A(n * r * d + j, j * r + k) = value_of(functions.basis[static_cast<std::size_t>(k)], unit);
    B(n * r * d + j, j) = 1.0;
  }
  MatrixXd c = CompleteOrthogonalDecomposition(A, 1e-12).solve(B);  // column i: row i of the C_k
  c = c.unaryExpr([](double value) {
    const double near = std::round(kFractions * value) / kFractions;
    return std::abs(value - near) <= kFound ? near : value;
  });
  if (!((A * c - B).cwiseAbs().maxCoeff() <= kFound)) return {};
  std::vector<MatrixXd> result(static_cast<std::size_t>(r), MatrixXd(d, d));
  for (Index k = 0; k < r; ++k)
    for (Index i = 0; i < d; ++i)
      for (Index j = 0; j < d; ++j) result[static_cast<std::size_t>(k)](i, j) = c(j * r + k, i);
  return result;
}

}  // namespace

GroupAction group_action(const Manifold& G, const std::vector<MatrixXd>& rho) {
  const Index d = rho.empty() ? 0 : rho.front().rows();
  if (std::ranges::all_of(rho, [](const MatrixXd& r) { return r.isZero(0.0); }))
    return [d](const ExprVector&) { return ExprMatrix(ExprMatrix::Identity(d, d)); };
  const auto unit = G.unit();
  if (!unit || std::ssize(rho) != G.tangent_dimension()) return {};
  for (Index degree = 1; degree <= kDegree; ++degree) {
    const auto all = monomials(G.ambient_dimension(), degree);
    if (std::ssize(all) > kMonomials) break;
    const FunctionsOnGroup functions = functions_on(G, all);
    if (std::ssize(functions.basis) * d > kRowUnknowns) break;
    const auto C = action_coefficients(functions, *unit, rho);
    if (C.empty()) continue;
    return [d, C, basis = functions.basis](const ExprVector& x) {
      ExprMatrix A = ExprMatrix::Zero(d, d);
      for (std::size_t k = 0; k < C.size(); ++k) {
        const Expr m = value_of(basis[k], x);
        for (Index i = 0; i < d; ++i)
          for (Index j = 0; j < d; ++j)
            if (C[k](i, j) != 0.0) A(i, j) += C[k](i, j) * m;
      }
      return A;
    };
  }
  return {};
}

}  // namespace courant
