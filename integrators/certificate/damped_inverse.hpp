// Steps of Levenberg and Marquardt.
#pragma once

#include <optional>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/certificate/saddle_point.hpp"

namespace courant {

// g ↦ argmin ‖S δ + g‖² + μ ‖cost ∘ δ‖², for μ = 0 the least one in this norm of those that
// minimise ‖S δ + g‖. Small ones by orthogonal factorisations, which square nothing: for μ = 0
// singular values down to about 10⁻⁹ count, and there is no step at all in the directions of
// others.
class DampedInverse {
 public:
  // Data error of a dense Jacobian: what is next to it above about 10⁻⁹ is divided by.
  static constexpr double kNegligible = 2e-12;

  DampedInverse(const SparseMatrixXd& S, const VectorXd& cost, double mu);

  // Empty if the matrix is not finite or the factorisation broke down.
  VectorXd step(const VectorXd& g) const;

 private:
  Index m_;
  VectorXd cost_;
  bool is_finite_ = true;
  std::optional<SaddlePoint> saddle_;
  std::optional<CompleteOrthogonalDecomposition> least_norm_;
  std::optional<QrDecomposition> damped_;
};

// The part of `direction` in the kernel of S, orthogonal to the rest.
VectorXd kernel_part(const SparseMatrixXd& S, const VectorXd& direction);

}  // namespace courant
