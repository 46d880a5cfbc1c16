#include "courant/manifolds/group_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {
namespace {

// 2^kHalvings is what an argument of Padé's approximant is divided by. Of degree 6 it is off by
// (6!)²/(12! 13!) θ¹³ = 2e-17 for θ = 1/2.
constexpr int kHalvings = 4, kPadeDegree = 6;

ExprMatrix identity_of(const ExprMatrix& V) { return ExprMatrix::Identity(V.rows(), V.cols()); }

double factorial_of(Index k) {
  double product = 1.0;
  for (Index i = 2; i <= k; ++i) product *= static_cast<double>(i);
  return product;
}

// exp V where V^{k+2} + s V^k = 0.
ExprMatrix exponential_by_law(const ExprMatrix& V, Index k, const Expr& s) {
  ExprMatrix power = identity_of(V), sum = ExprMatrix::Zero(V.rows(), V.cols());
  for (Index j = 0; j < k; ++j) {
    sum += Expr(1.0 / factorial_of(j)) * power;
    power = (power * V).eval();
  }
  sum += stumpff(static_cast<int>(k), s) * power;
  return sum + stumpff(static_cast<int>(k + 1), s) * (power * V).eval();
}

ExprMatrix exponential_by_pade(const ExprMatrix& V) {
  const ExprMatrix A = Expr(std::ldexp(1.0, -kHalvings)) * V, square = A * A;
  ExprMatrix even = ExprMatrix::Zero(V.rows(), V.cols()), odd = even, power = identity_of(V);
  double coefficient = 1.0;
  for (int j = 0; j <= kPadeDegree; ++j) {
    (j % 2 == 0 ? even : odd) += Expr(coefficient) * power;
    if (j % 2 == 1) power = (power * square).eval();
    coefficient *=
        static_cast<double>(kPadeDegree - j) / static_cast<double>((2 * kPadeDegree - j) * (j + 1));
  }
  const ExprMatrix along = A * odd;
  // Near the identity, where elimination needs no pivots.
  ExprMatrix result = solve(even - along, even + along);
  for (int halving = 0; halving < kHalvings; ++halving) result = (result * result).eval();
  return result;
}

Expr quadratic(const MatrixXd& S, const ExprVector& v) {
  Expr sum = 0.0;
  for (Index i = 0; i < S.rows(); ++i)
    for (Index j = 0; j <= i; ++j)
      if (const double entry = i == j ? S(i, i) : S(i, j) + S(j, i); entry != 0.0)
        sum = sum + entry * v[i] * v[j];
  return sum;
}

ExprMatrix exponential_of(const MatrixAlgebra& g, const ExprVector& v) {
  const ExprMatrix V = g.hat(v);
  const auto& law = g.power_law();
  return law ? exponential_by_law(V, law->k, quadratic(law->S, v)) : exponential_by_pade(V);
}

// Σ (-1)^{j+1} (Y - 1)^j / j, finite.
ExprVector nilpotent_logarithm(const MatrixAlgebra& g, const ExprMatrix& Y) {
  const ExprMatrix D = Y - identity_of(Y);
  ExprMatrix power = D, sum = D;
  for (Index j = 2; j < g.size(); ++j) {
    power = (power * D).eval();
    sum += Expr((j % 2 == 0 ? -1.0 : 1.0) / static_cast<double>(j)) * power;
  }
  return g.vee(sum);
}

ExprVector balanced_logarithm(const MatrixAlgebra& g, const ExprMatrix& Y) {
  const auto multiplicity = static_cast<double>(g.power_law()->multiplicity);
  const auto rest = static_cast<double>(g.size()) - multiplicity;
  const Expr c = (Y.trace() - rest) / multiplicity;
  const ExprMatrix S = Expr(0.5) * (Y - g.inverse(Y));
  const ExprMatrix S2 = S * S;
  // φ/sin φ by cos φ; beyond a right angle as π/sin φ - (π - φ)/sin φ, since cos φ says little of sin φ there.
  const Expr sine_square = S2.trace() / -multiplicity;
  const Expr is_wide = c < 0.0;
  const Expr ahead = select(is_wide, -c, c);
  const Expr g0 = arccos_factor(0, ahead), g1 = arccos_factor(1, ahead);
  const Expr wide = std::numbers::pi / sqrt(sine_square) - g0;
  const Expr factor = select(is_wide, wide, g0);
  if (g.power_law()->k <= 1) return g.vee(ExprMatrix(factor * S));
  // (φ/sin φ - 1)/sin² φ, with g' = (c g - 1)/(1 - c²).
  const Expr cubic = select(is_wide, (wide - 1.0) / sine_square, g1 + g0 / (1.0 + ahead));
  return g.vee(ExprMatrix(S - cubic * (S2 * S).eval()));
}

// λ/(e^λ - 1) = (λ/2) coth(λ/2) - λ/2 with e^λ from the trace.
ExprVector one_sided_logarithm(const MatrixAlgebra& g, const ExprMatrix& Y) {
  const auto multiplicity = static_cast<double>(g.power_law()->multiplicity);
  const auto rest = static_cast<double>(g.size()) - multiplicity;
  const Expr half = 0.5 * log((Y.trace() - rest) / multiplicity);
  const Expr s = -square(half);
  const Expr factor = stumpff(0, s) / stumpff(1, s) - half;
  return g.vee(ExprMatrix(factor * (Y - identity_of(Y))));
}

}  // namespace

GroupMap exponential_map(const MatrixAlgebra& g) {
  const auto& law = g.power_law();
  const bool nilpotent = law && law->S.isZero(0.0);
  GroupMap result{.name = "exponential",
                  .map = [g](const ExprVector& v) { return exponential_of(g, v); },
                  .reciprocal = [g](const ExprVector& v) { return exponential_of(g, -v); },
                  .is_exponential = true};
  if (nilpotent)
    result.inverse = [g](const ExprMatrix& Y) { return nilpotent_logarithm(g, Y); };
  else if (law && law->balanced && law->k <= 3)
    result.inverse = [g](const ExprMatrix& Y) { return balanced_logarithm(g, Y); };
  else if (law && law->one_sided)
    result.inverse = [g](const ExprMatrix& Y) { return one_sided_logarithm(g, Y); };
  if (const double bound = g.spectral_bounds().imaginary; bound > 0.0)
    result.injectivity_radius = result.midpoint_radius = std::numbers::pi / bound;
  // Newton's method, from X - 1, finds the inverse there.
  if (!result.inverse)
    result.injectivity_radius = result.midpoint_radius =
        std::min(result.injectivity_radius, 1.0 / g.spectral_bounds().modulus);
  result.extent = [g](const VectorXd& v) { return g.spectrum(v).imaginary / std::numbers::pi; };
  return result;
}

namespace {

// Of what is not near the identity too.
ExprMatrix inverse_of(const ExprMatrix& A) { return adjugate(A) / determinant(A); }

}  // namespace

GroupMap cayley_map(const MatrixAlgebra& g) {
  const auto map = [g](const ExprVector& v) {
    const ExprMatrix half = Expr(0.5) * g.hat(v), one = identity_of(half);
    return ExprMatrix(inverse_of(one - half) * (one + half).eval());
  };
  GroupMap result{.name = "cayley",
                  .map = map,
                  .reciprocal = [map](const ExprVector& v) { return map(-v); },
                  .inverse =
                      [g](const ExprMatrix& Y) {
                        const ExprMatrix one = identity_of(Y);
                        return g.vee(ExprMatrix(Expr(2.0) * (Y - one) * inverse_of(Y + one)));
                      }};
  // Half of what is true where v̂ has real eigenvalues: there Newton's method finds inverses of maps that are made of it.
  const double imaginary = g.spectral_bounds().imaginary, real = g.spectral_bounds().real;
  result.injectivity_radius = 1.0 / real;
  result.midpoint_radius = std::min(4.0 / imaginary, 1.0 / real);
  result.extent = [g](const VectorXd& v) { return g.spectrum(v).real / 2.0; };

  // The tangent of s ↦ cay s v̂ comes back to g if the curve stays in the group.
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int sample = 0; sample < 4; ++sample) {
    const VectorXd v = VectorXd::NullaryExpr(g.dimension(), [&] { return normal(generator); }) *
                       (0.5 / (1.0 + g.spectral_bounds().modulus));
    const MatrixXd V = values(g.hat(constants(v)));
    const MatrixXd one = MatrixXd::Identity(g.size(), g.size());
    // (cay sV)⁻¹ d/ds cay sV = (1 + V/2)⁻¹ V (1 - V/2)⁻¹ at s = 1.
    const MatrixXd left = values(inverse_of(constants(MatrixXd(one + 0.5 * V))));
    const MatrixXd right = values(inverse_of(constants(MatrixXd(one - 0.5 * V))));
    const MatrixXd tangent = left * V * right;
    const MatrixXd inside = values(g.hat(g.vee(constants(tangent))));
    if ((tangent - inside).norm() > 1e-10 * tangent.norm())
      throw std::domain_error("cayley_map: the Cayley transform of " + g.name() +
                              " leaves the group; expected a group that leaves a form invariant, "
                              "such as so, sp, se2 and su2, or another retraction.");
  }
  return result;
}

GroupMap second_kind_map(const MatrixAlgebra& g) {
  auto factors = std::make_shared<std::vector<MatrixAlgebra>>();
  double square = 0.0, frobenius = 0.0;
  MatrixXd columns(g.size() * g.size(), g.dimension());
  for (Index a = 0; a < g.dimension(); ++a) {
    const MatrixXd& B = g.basis()[static_cast<std::size_t>(a)];
    factors->emplace_back("factor", std::vector<MatrixXd>{B});
    square += std::pow(singular_values(B)[0], 2);
    frobenius += B.squaredNorm();
    columns.col(a) = B.reshaped();
  }
  const double rho = std::sqrt(square), sigma = singular_values(columns)[g.dimension() - 1];
  const auto product = [g, factors](const ExprVector& v, bool reversed) {
    ExprMatrix result = ExprMatrix::Identity(g.size(), g.size());
    for (Index a = 0; a < g.dimension(); ++a) {
      const ExprMatrix factor = exponential_of((*factors)[static_cast<std::size_t>(a)],
                                               ExprVector::Constant(1, reversed ? -v[a] : v[a]));
      result = reversed ? (factor * result).eval() : (result * factor).eval();
    }
    return result;
  };
  GroupMap result{.name = "second-kind",
                  .map = [product](const ExprVector& v) { return product(v, false); },
                  .reciprocal = [product](const ExprVector& v) { return product(v, true); }};
  result.injectivity_radius = result.midpoint_radius =
      std::log1p(sigma / std::sqrt(frobenius)) / rho;
  result.extent = [radius = result.injectivity_radius](const VectorXd& v) {
    return v.norm() / radius;
  };
  return result;
}

}  // namespace courant
