#include "courant/integrators/step/transported_directions.hpp"

#include <cmath>
#include <utility>

#include "courant/core/linear/plain_products.hpp"
#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
namespace {

// The sine of the angle between W and T_xM_f is the least singular value of CᵀW, and none is above 1:
// it is at least the determinant. Above this bound nothing else is looked at.
constexpr double kSurelyComplement = 1e-6;

}  // namespace

TransportedDirections::TransportedDirections(const Projector& projector, Function span, Index n,
                                             Index d)
    : projector_(projector),
      span_(std::move(span)),
      W_(MatrixXd::Zero(n, d)),
      kept_(W_),
      V_(W_),
      combination_(MatrixXd::Identity(d, d)),
      turned_(n, d),
      before_(d, d),
      next_(d, d),
      make_orthonormal_(d) {}

void TransportedDirections::move_to(const VectorXd& x, double t, const LinearMap<double>& basis,
                                    const MatrixXd& conormals) {
  if (projector_.is_orthogonal() || conormals.cols() == 0) {
    W_ = conormals;
    return;
  }
  const double* const in[] = {x.data(), basis.entries().data(), conormals.data(), &t};
  span_.value(in, V_.data());
  is_continued_ = continues(conormals);
  if (is_continued_) return;
  W_ = projector_.orthonormal_directions(V_, basis, conormals);
  if (!is_kept_) return;
  multiply_transposed_plainly(W_, kept_, next_);
  multiply_plainly(W_, next_, turned_);
  make_orthonormal_(turned_, W_);
}

bool TransportedDirections::continues(const MatrixXd& conormals) {
  if (is_kept_) multiply_plainly(V_, combination_, turned_);
  if (!(is_kept_ && make_orthonormal_(turned_, W_)) && !is_nearest_to(is_kept_ ? kept_ : conormals))
    return false;
  return is_complement(conormals);
}

// Whether there is such a W.
bool TransportedDirections::is_nearest_to(const MatrixXd& matrix) {
  project(matrix);
  if (make_orthonormal_(turned_, W_)) return true;
  if (!make_orthonormal_.from_afar(turned_, W_)) return false;
  project(W_);
  return make_orthonormal_(turned_, W_);
}

// V K nearest to the matrix, by the normal equations: whatever rounding makes of K, V K is in the span of V.
void TransportedDirections::project(const MatrixXd& matrix) {
  multiply_transposed_plainly(V_, V_, next_);
  factors_.compute(next_);
  multiply_transposed_plainly(V_, matrix, combination_);
  for (Index j = 0; j < combination_.cols(); ++j) factors_.solve(combination_.col(j).data());
  multiply_plainly(V_, combination_, turned_);
}

bool TransportedDirections::is_complement(const MatrixXd& conormals) {
  if (projector_.is_always_complement()) return true;
  multiply_transposed_plainly(conormals, W_, next_);
  factors_.compute(next_);
  return std::fabs(factors_.determinant()) > kSurelyComplement;
}

void TransportedDirections::keep() {
  if (!projector_.is_orthogonal() && W_.cols() > 0) {
    if (is_continued_) {
      // W = T R for T = V K and R = (TᵀT)^{-1/2} near 1, so that TᵀW = R⁻¹; of K, so many digits as the
      // next step is long do.
      multiply_transposed_plainly(turned_, W_, next_);
      for (double& entry : next_.reshaped()) entry = -entry;
      for (Index j = 0; j < next_.cols(); ++j) next_(j, j) += 2.0;
      before_ = combination_;
      multiply_plainly(before_, next_, combination_);
    } else if (!W_.isZero(0.0)) {
      combination_ = QrDecomposition::pivoted(V_).solve(W_);
    }
  }
  kept_ = W_;
  is_kept_ = true;
}

void TransportedDirections::discard() { W_ = kept_; }

void TransportedDirections::take_over(const TransportedDirections& other) {
  W_ = kept_ = other.kept_;
  combination_ = other.combination_;
  is_kept_ = other.is_kept_;
  is_continued_ = false;
}

void TransportedDirections::forget() {
  is_kept_ = is_continued_ = false;
  W_.setZero();
  kept_.setZero();
}

}  // namespace courant
