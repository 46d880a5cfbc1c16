#include "courant/structures/dirac_interconnection.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {
namespace {

// The size that the errors of U, moved along φ, are relative to.
RankOptions options_along(const Eigen::Ref<const MatrixXd>& phi, const PairedSubspace& U) {
  RankOptions options = U.block_options();
  if (phi.size() > 0) options.magnitude = std::max(1.0, phi.cwiseAbs().maxCoeff());
  return options;
}

void require_size(const std::string& function, const std::string& side, Index size,
                  const PairedSubspace& U) {
  if (size == U.space_dimension()) return;
  throw std::invalid_argument(function + ": phi has " + std::to_string(size) + " " + side +
                              "; expected the dimension of the space of U, " +
                              std::to_string(U.space_dimension()) + ".");
}

MatrixXd block_diagonal(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd result = MatrixXd::Zero(A.rows() + B.rows(), A.cols() + B.cols());
  result.topLeftCorner(A.rows(), A.cols()) = A;
  result.bottomRightCorner(B.rows(), B.cols()) = B;
  return result;
}

// The coordinates 0 … n-1 without the ports.
std::vector<Index> inner_coordinates(const std::string& name, std::span<const Index> ports,
                                     Index n) {
  std::vector<bool> is_port(static_cast<std::size_t>(n), false);
  for (const Index port : ports) {
    if (port < 0 || port >= n || is_port[static_cast<std::size_t>(port)]) {
      throw std::invalid_argument(
          "composition: " + name + " has the entry " + std::to_string(port) +
          "; expected different coordinates from 0 to " + std::to_string(n - 1) + ".");
    }
    is_port[static_cast<std::size_t>(port)] = true;
  }
  std::vector<Index> inner;
  for (Index k = 0; k < n; ++k) {
    if (!is_port[static_cast<std::size_t>(k)]) inner.push_back(k);
  }
  return inner;
}

}  // namespace

// U = {(w, β) : Aᵀw + Bᵀβ = 0}, so {(v, β) : Aᵀφv + Bᵀβ = 0} is the kernel to be mapped by (v, β) ↦
// (v, φ*β).
PairedSubspace backward_image(const Eigen::Ref<const MatrixXd>& phi, const PairedSubspace& U) {
  require_size("backward_image", "rows", phi.rows(), U);
  const RankOptions options = options_along(phi, U);
  const MatrixXd A = U.complement().topRows(phi.rows()), B = U.complement().bottomRows(phi.rows());
  const MatrixXd pairs = kernel(beside(A.transpose() * phi, B.transpose()), options);
  return PairedSubspace::image(pairs.topRows(phi.cols()),
                               phi.transpose() * pairs.bottomRows(phi.rows()), options);
}

PairedSubspace forward_image(const Eigen::Ref<const MatrixXd>& phi, const PairedSubspace& U) {
  require_size("forward_image", "columns", phi.cols(), U);
  const RankOptions options = options_along(phi, U);
  const MatrixXd A = U.complement().topRows(phi.cols()), B = U.complement().bottomRows(phi.cols());
  const MatrixXd pairs = kernel(beside(A.transpose(), B.transpose() * phi.transpose()), options);
  return PairedSubspace::image(phi * pairs.topRows(phi.cols()), pairs.bottomRows(phi.rows()),
                               options);
}

LinearDirac backward_image(const Eigen::Ref<const MatrixXd>& phi, const LinearDirac& D) {
  return LinearDirac::nearest(backward_image(phi, static_cast<const PairedSubspace&>(D)));
}

LinearDirac forward_image(const Eigen::Ref<const MatrixXd>& phi, const LinearDirac& D) {
  return LinearDirac::nearest(forward_image(phi, static_cast<const PairedSubspace&>(D)));
}

PairedSubspace product(const PairedSubspace& A, const PairedSubspace& B) {
  RankOptions options = A.block_options();
  options.data_error = std::max(options.data_error, B.block_options().data_error);
  return PairedSubspace::image(block_diagonal(A.vectors(), B.vectors()),
                               block_diagonal(A.covectors(), B.covectors()), options);
}

LinearDirac product(const LinearDirac& A, const LinearDirac& B) {
  return LinearDirac(
      product(static_cast<const PairedSubspace&>(A), static_cast<const PairedSubspace&>(B)));
}

LinearDirac tensor_product(const LinearDirac& A, const LinearDirac& B) {
  const MatrixXd identity = MatrixXd::Identity(A.space_dimension(), A.space_dimension());
  return backward_image(above(identity, identity), product(A, B));
}

// Flows of A and B that fit together are ι(v_A, v_B, f) = (v_A, f; -f, v_B), and ι* of their
// efforts is (α_A, α_B, e_A - e_B). The forward image along (v_A, v_B, f) ↦ (v_A, v_B) asks for e_A
// - e_B = 0.
LinearDirac composition(const LinearDirac& A, std::span<const Index> ports_of_A,
                        const LinearDirac& B, std::span<const Index> ports_of_B) {
  if (ports_of_A.size() != ports_of_B.size()) {
    throw std::invalid_argument("composition: " + std::to_string(ports_of_A.size()) +
                                " ports of A, " + std::to_string(ports_of_B.size()) +
                                " of B; expected as many.");
  }
  const Index n_A = A.space_dimension(), n_B = B.space_dimension();
  const std::vector<Index> inner_A = inner_coordinates("ports_of_A", ports_of_A, n_A);
  const std::vector<Index> inner_B = inner_coordinates("ports_of_B", ports_of_B, n_B);
  const auto a = static_cast<Index>(inner_A.size()), b = static_cast<Index>(inner_B.size());
  const auto shared = static_cast<Index>(ports_of_A.size());

  MatrixXd embedding = MatrixXd::Zero(n_A + n_B, a + b + shared);
  for (Index k = 0; k < a; ++k) embedding(inner_A[static_cast<std::size_t>(k)], k) = 1.0;
  for (Index k = 0; k < b; ++k) embedding(n_A + inner_B[static_cast<std::size_t>(k)], a + k) = 1.0;
  for (Index k = 0; k < shared; ++k) {
    embedding(ports_of_A[static_cast<std::size_t>(k)], a + b + k) = 1.0;
    embedding(n_A + ports_of_B[static_cast<std::size_t>(k)], a + b + k) = -1.0;
  }
  return forward_image(MatrixXd::Identity(a + b, a + b + shared),
                       backward_image(embedding, product(A, B)));
}

}  // namespace courant
