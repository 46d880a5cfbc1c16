#include "courant/structures/paired_subspace.hpp"

#include <algorithm>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {
namespace {

void require(bool condition, const std::string& function, const std::string& problem) {
  if (!condition) throw std::invalid_argument("PairedSubspace::" + function + ": " + problem);
}

std::string size(const Eigen::Ref<const MatrixXd>& matrix) {
  return size_text(matrix.rows(), matrix.cols());
}

double spectral_norm(const MatrixXd& matrix) {
  return matrix.size() == 0 ? 0.0 : singular_values(matrix)[0];
}

// (v, α) ↦ (α, v), on columns: ≪z, w≫ = zᵀ exchanged(w).
MatrixXd exchanged(const MatrixXd& pairs) {
  const Index n = pairs.rows() / 2;
  MatrixXd result(pairs.rows(), pairs.cols());
  result << pairs.bottomRows(n), pairs.topRows(n);
  return result;
}

RankOptions worse(const RankOptions& first, const RankOptions& second) {
  return first.data_error < second.data_error ? second : first;
}

double largest_pairing(const MatrixXd& basis) {
  return spectral_norm(basis.transpose() * exchanged(basis));
}

}  // namespace

double pairing(const Eigen::Ref<const VectorXd>& v1, const Eigen::Ref<const VectorXd>& alpha1,
               const Eigen::Ref<const VectorXd>& v2, const Eigen::Ref<const VectorXd>& alpha2) {
  return alpha1.dot(v2) + alpha2.dot(v1);
}

PairedSubspace::PairedSubspace(Index n, MatrixXd frame, RankDecision decision, Index dimension,
                               double data_error)
    : n_(n),
      frame_(std::move(frame)),
      decision_(std::move(decision)),
      dimension_(dimension),
      data_error_(std::max(data_error, 1e-13)) {}

PairedSubspace PairedSubspace::image(const Eigen::Ref<const MatrixXd>& X,
                                     const Eigen::Ref<const MatrixXd>& Y,
                                     const RankOptions& options) {
  require(X.rows() == Y.rows() && X.cols() == Y.cols(), "image",
          "X is " + size(X) + " and Y is " + size(Y) + "; expected equal sizes n × k.");
  const FundamentalSubspaces of_generators(above(X, Y), options);
  return PairedSubspace(X.rows(), beside(of_generators.range(), of_generators.left_kernel()),
                        of_generators.decision(), of_generators.rank(), options.data_error);
}

PairedSubspace PairedSubspace::kernel(const Eigen::Ref<const MatrixXd>& F,
                                      const Eigen::Ref<const MatrixXd>& E,
                                      const RankOptions& options) {
  require(F.rows() == E.rows() && F.cols() == E.cols(), "kernel",
          "F is " + size(F) + " and E is " + size(E) + "; expected equal sizes r × n.");
  const FundamentalSubspaces of_equations(beside(F, E), options);
  return PairedSubspace(F.cols(), beside(of_equations.kernel(), of_equations.row_space()),
                        of_equations.decision(), 2 * F.cols() - of_equations.rank(),
                        options.data_error);
}

PairedSubspace PairedSubspace::kernel(const Eigen::Ref<const MatrixXd>& F,
                                      const Eigen::Ref<const MatrixXd>& E,
                                      const Eigen::Ref<const MatrixXd>& P,
                                      const RankOptions& options) {
  require(P.rows() == F.rows(), "kernel",
          "P is " + size(P) + " and F is " + size(F) + "; expected equal numbers of rows.");
  // Orthonormal: what is below the rounding of 1 is rounding, and made equations of nothing but noise.
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  MatrixXd free_of_ports = FundamentalSubspaces(P, options).left_kernel().transpose();
  free_of_ports = (free_of_ports.array().abs() > rounding).select(free_of_ports, 0.0).eval();
  // What cancels to rounding is zero: equations that say the same must not become one of noise.
  const double noise = std::max(1e-13, options.data_error);
  const auto reduced = [&](const MatrixXd& A) {
    const MatrixXd product = free_of_ports * A;
    const MatrixXd terms = free_of_ports.cwiseAbs() * A.cwiseAbs();
    return MatrixXd(
        (product.array().abs() > noise * terms.array()).select(product.array(), 0.0).matrix());
  };
  return kernel(reduced(F), reduced(E), options);
}

PairedSubspace PairedSubspace::orthogonal() const {
  const MatrixXd exchanged_frame = exchanged(frame_);
  return PairedSubspace(
      n_,
      beside(exchanged_frame.rightCols(2 * n_ - dimension_), exchanged_frame.leftCols(dimension_)),
      decision_, 2 * n_ - dimension_, data_error_);
}

double PairedSubspace::isotropy_defect() const { return largest_pairing(basis()); }

double PairedSubspace::coisotropy_defect() const { return largest_pairing(complement()); }

double PairedSubspace::distance(const Eigen::Ref<const VectorXd>& v,
                                const Eigen::Ref<const VectorXd>& alpha) const {
  require(v.size() == n_ && alpha.size() == n_, "distance",
          "v has " + std::to_string(v.size()) + " and alpha " + std::to_string(alpha.size()) +
              " entries; expected space_dimension() = " + std::to_string(n_) + ".");
  VectorXd pair(2 * n_);
  pair << v, alpha;
  return (complement().transpose() * pair).norm();
}

MatrixXd PairedSubspace::vector_range() const { return range(vectors(), block_options()); }

MatrixXd PairedSubspace::covector_range() const { return range(covectors(), block_options()); }

// Of U = {(v, α) : Aᵀv + Bᵀα = 0}: the v with Aᵀv = 0, the α with Bᵀα = 0.
MatrixXd PairedSubspace::vector_kernel() const {
  return courant::kernel(complement().topRows(n_).transpose(), block_options());
}

MatrixXd PairedSubspace::covector_kernel() const {
  return courant::kernel(complement().bottomRows(n_).transpose(), block_options());
}

PairedSubspace intersection(const PairedSubspace& U, const PairedSubspace& W) {
  require(U.space_dimension() == W.space_dimension(), "intersection", "the spaces V differ.");
  const Index n = U.space_dimension();
  const MatrixXd equations = beside(U.complement(), W.complement()).transpose();
  return PairedSubspace::kernel(equations.leftCols(n), equations.rightCols(n),
                                worse(U.block_options(), W.block_options()));
}

PairedSubspace sum(const PairedSubspace& U, const PairedSubspace& W) {
  require(U.space_dimension() == W.space_dimension(), "sum", "the spaces V differ.");
  return PairedSubspace::image(beside(U.vectors(), W.vectors()),
                               beside(U.covectors(), W.covectors()),
                               worse(U.block_options(), W.block_options()));
}

double distance(const PairedSubspace& U, const PairedSubspace& W) {
  require(U.space_dimension() == W.space_dimension(), "distance", "the spaces V differ.");
  if (U.dimension() != W.dimension()) return 1.0;
  return spectral_norm(U.complement().transpose() * W.basis());
}

std::ostream& operator<<(std::ostream& out, const PairedSubspace& U) {
  std::ostringstream text;
  text << "subspace of V ⊕ V*, dim V = " << U.space_dimension() << ", dimension " << U.dimension()
       << ": " << (U.is_isotropic() ? "" : "not ") << "isotropic, "
       << (U.is_coisotropic() ? "" : "not ") << "coisotropic";
  if (U.decision().ambiguous()) text << "\n  the dimension is doubtful: " << U.decision();
  for (Index k = 0; k < U.dimension(); ++k) {
    const auto print = [&](const auto& column) {
      for (const double entry : column) {
        const std::string number = number_text(std::abs(entry) < 5e-13 ? 0.0 : entry, 4);
        text << std::string(9 - std::min<std::size_t>(number.size(), 8), ' ') << number;
      }
    };
    text << "\n ";
    print(U.vectors().col(k));
    text << "  |";
    print(U.covectors().col(k));
  }
  return out << text.str() << '\n';
}

}  // namespace courant
