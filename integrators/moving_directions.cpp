#include "courant/integrators/moving_directions.hpp"

#include <cmath>

#include "courant/core/lu_decomposition.hpp"
#include "courant/core/qr_decomposition.hpp"

namespace courant {
namespace {

// The sine of the angle between W and T_xM_f is the least singular value of CᵀW, and none is above 1:
// it is at least the determinant. Above this bound nothing else is looked at.
constexpr double kSurelyComplement = 1e-6;

}  // namespace

MovingDirections::MovingDirections(const Projector& projector, Index n, Index d)
    : projector_(projector),
      W_(MatrixXd::Zero(n, d)),
      kept_(W_),
      V_(W_),
      combination_(MatrixXd::Identity(d, d)),
      turned_(n, d),
      next_(d, d),
      make_orthonormal_(d) {}

void MovingDirections::move_to(const VectorXd& x, const LinearMap<double>& basis,
                               const MatrixXd& conormals) {
  if (projector_.is_orthogonal()) {
    W_ = conormals;
    return;
  }
  V_ = projector_.span(x, basis, conormals);
  is_continued_ = is_kept_ && continues(conormals);
  if (is_continued_) return;
  W_ = projector_.directions(x, basis, conormals);
  if (!is_kept_) return;
  turned_.noalias() = W_ * (W_.transpose() * kept_);
  make_orthonormal_(turned_, W_);
}

bool MovingDirections::continues(const MatrixXd& conormals) {
  turned_.noalias() = V_.operator*(combination_);
  if (!make_orthonormal_(turned_, W_)) {
    project_kept();
    if (!make_orthonormal_(turned_, W_)) return false;
  }
  return is_complement(conormals);
}

// V K nearest to the W that was kept, by the normal equations: whatever rounding makes of K, V K is in the span of V.
void MovingDirections::project_kept() {
  next_.noalias() = V_.transpose().operator*(V_);
  gram_.compute(next_);
  next_.noalias() = V_.transpose().operator*(kept_);
  combination_ = gram_.solve(next_);
  turned_.noalias() = V_.operator*(combination_);
}

bool MovingDirections::is_complement(const MatrixXd& conormals) const {
  if (projector_.is_always_complement()) return true;
  return std::fabs(LuDecomposition(conormals.transpose() * W_).determinant()) > kSurelyComplement;
}

void MovingDirections::keep() {
  if (!projector_.is_orthogonal()) {
    if (is_continued_) {
      // W = T R for T = V K and R = (TᵀT)^{-1/2} near 1, so that TᵀW = R⁻¹; of K, so many digits as the
      // next step is long do.
      next_.noalias() = -turned_.transpose() * W_;
      next_.diagonal().array() += 2.0;
      combination_ = (combination_ * next_).eval();
    } else if (!W_.isZero(0.0)) {
      combination_ = QrDecomposition::pivoted(V_).solve(W_);
    }
  }
  kept_ = W_;
  is_kept_ = true;
}

void MovingDirections::discard() { W_ = kept_; }

void MovingDirections::take_over(const MovingDirections& other) {
  W_ = kept_ = other.kept_;
  combination_ = other.combination_;
  is_kept_ = other.is_kept_;
  is_continued_ = false;
}

void MovingDirections::forget() {
  is_kept_ = is_continued_ = false;
  W_.setZero();
  kept_.setZero();
}

}  // namespace courant
