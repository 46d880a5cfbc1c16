#include "courant/structures/lie_algebra.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double largest(const std::vector<MatrixXd>& matrices) {
  double result = 0.0;
  for (const MatrixXd& matrix : matrices)
    if (matrix.size() > 0) result = std::max(result, matrix.cwiseAbs().maxCoeff());
  return result;
}

std::vector<MatrixXd> zeros(Index n) {
  return std::vector<MatrixXd>(static_cast<std::size_t>(n), MatrixXd::Zero(n, n));
}

// ad(e_i): the matrix of [e_i, ·].
MatrixXd adjoint(const std::vector<MatrixXd>& constants, Index i) {
  const auto n = static_cast<Index>(constants.size());
  MatrixXd result(n, n);
  for (Index k = 0; k < n; ++k) result.row(k) = constants[static_cast<std::size_t>(k)].row(i);
  return result;
}

}  // namespace

LieAlgebra::LieAlgebra(std::string name, std::vector<MatrixXd> constants,
                       const std::vector<std::string>& basis)
    : name_(std::move(name)), constants_(std::move(constants)) {
  const Index n = dimension();
  for (const MatrixXd& c : constants_)
    if (c.rows() != n || c.cols() != n)
      throw std::invalid_argument("LieAlgebra: a matrix of constants is " +
                                  size_text(c.rows(), c.cols()) + "; expected " + size_text(n, n) +
                                  ".");
  const double size = largest(constants_), bound = 1e-12 * size;
  for (const MatrixXd& c : constants_)
    if (const double defect = largest({c + c.transpose()}); defect > bound)
      throw std::domain_error("LieAlgebra: the constants have a symmetric part, |c + cᵀ| = " +
                              number_text(defect) + "; expected skew matrices.");
  const auto name_of = [&](std::size_t i) {
    return i < basis.size() ? basis[i] : "e_" + std::to_string(i);
  };
  // ad([e_i, e_j]) = [ad(e_i), ad(e_j)] is the Jacobi identity.
  std::vector<MatrixXd> ad;
  for (Index i = 0; i < n; ++i) ad.push_back(adjoint(constants_, i));
  for (std::size_t i = 0; i < ad.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      MatrixXd defect = ad[j] * ad[i] - ad[i] * ad[j];
      for (std::size_t k = 0; k < ad.size(); ++k)
        defect += constants_[k](static_cast<Index>(i), static_cast<Index>(j)) * ad[k];
      if (largest({defect}) > bound * size)
        throw std::domain_error("LieAlgebra: the Jacobi identity fails by " +
                                number_text(largest({defect})) + " for " + name_of(j) + " and " +
                                name_of(i) + "; expected 0.");
    }
}

LieAlgebra::LieAlgebra(const MatrixAlgebra& matrices)
    : LieAlgebra(matrices.name(), matrices.constants()) {
  matrices_ = std::make_shared<MatrixAlgebra>(matrices);
}

Eigen::VectorXd LieAlgebra::bracket(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  if (a.size() != dimension() || b.size() != dimension())
    throw std::invalid_argument("LieAlgebra::bracket: the vectors have " +
                                std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                                " entries; expected dimension() = " + std::to_string(dimension()) +
                                ".");
  Eigen::VectorXd result(dimension());
  for (Index k = 0; k < dimension(); ++k)
    result[k] = a.dot(constants_[static_cast<std::size_t>(k)] * b);
  return result;
}

LieAlgebra LieAlgebra::abelian(Index n) { return {"R^" + std::to_string(n), zeros(n)}; }

LieAlgebra LieAlgebra::so3() {
  auto c = zeros(3);
  for (Index k = 0; k < 3; ++k) {
    c[static_cast<std::size_t>(k)]((k + 1) % 3, (k + 2) % 3) = 1.0;
    c[static_cast<std::size_t>(k)]((k + 2) % 3, (k + 1) % 3) = -1.0;
  }
  return {"so(3)", std::move(c)};
}

LieAlgebra LieAlgebra::so(Index n) {
  if (n < 0)
    throw std::invalid_argument("LieAlgebra::so: n is " + std::to_string(n) + "; expected n ≥ 0.");
  std::vector<MatrixXd> basis;
  std::vector<std::pair<Index, Index>> place;
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j) {
      MatrixXd E = MatrixXd::Zero(n, n);
      E(i, j) = 1.0;
      E(j, i) = -1.0;
      basis.push_back(E);
      place.emplace_back(i, j);
    }
  auto c = zeros(static_cast<Index>(basis.size()));
  for (std::size_t a = 0; a < basis.size(); ++a)
    for (std::size_t b = 0; b < basis.size(); ++b) {
      const MatrixXd commutator = basis[a] * basis[b] - basis[b] * basis[a];
      for (std::size_t k = 0; k < basis.size(); ++k)
        c[k](static_cast<Index>(a), static_cast<Index>(b)) =
            commutator(place[k].first, place[k].second);
    }
  return {"so(" + std::to_string(n) + ")", std::move(c)};
}

LieAlgebra LieAlgebra::semidirect(const LieAlgebra& g, const std::vector<MatrixXd>& rho) {
  const Index n = g.dimension(), d = rho.empty() ? 0 : rho[0].rows();
  const auto wrong_size = [&](const MatrixXd& m) { return m.rows() != d || m.cols() != d; };
  if (static_cast<Index>(rho.size()) != n || std::ranges::any_of(rho, wrong_size))
    throw std::invalid_argument("LieAlgebra::semidirect: rho has " + std::to_string(rho.size()) +
                                " matrices; expected " + std::to_string(n) +
                                " square ones of one size, one for each e_i.");
  const double size = std::max(largest(rho), largest(g.constants()));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j) {
      const MatrixXd &a = rho[static_cast<std::size_t>(j)], &b = rho[static_cast<std::size_t>(i)];
      MatrixXd defect = a * b - b * a;
      for (Index k = 0; k < n; ++k)
        defect -=
            g.constants()[static_cast<std::size_t>(k)](j, i) * rho[static_cast<std::size_t>(k)];
      if (largest({defect}) > 1e-12 * size * size)
        throw std::domain_error(
            "LieAlgebra::semidirect: rho(e_" + std::to_string(j) + ") and rho(e_" +
            std::to_string(i) + ") have a commutator that differs by " +
            number_text(largest({defect})) + " from rho of [e_" + std::to_string(j) + ", e_" +
            std::to_string(i) + "]; expected a representation of " + g.name() + ".");
    }
  auto c = zeros(n + d);
  for (Index k = 0; k < n; ++k)
    c[static_cast<std::size_t>(k)].topLeftCorner(n, n) = g.constants()[static_cast<std::size_t>(k)];
  for (Index k = 0; k < d; ++k)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < d; ++j) {
        const double entry = rho[static_cast<std::size_t>(i)](k, j);
        c[static_cast<std::size_t>(n + k)](i, n + j) = entry;
        c[static_cast<std::size_t>(n + k)](n + j, i) = -entry;
      }
  return {g.name() + " ⋉ R^" + std::to_string(d), std::move(c)};
}

LieAlgebra LieAlgebra::se3() {
  const LieAlgebra rotations = so3();
  std::vector<MatrixXd> rho;
  for (Index i = 0; i < 3; ++i) rho.push_back(adjoint(rotations.constants(), i));
  LieAlgebra result = semidirect(rotations, rho);
  result.name_ = "se(3)";
  return result;
}

}  // namespace courant
