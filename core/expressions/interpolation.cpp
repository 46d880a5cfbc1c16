#include "courant/core/expressions/interpolation.hpp"

#include <array>
#include <stdexcept>

namespace courant {
namespace {

// Σ_k coefficients(k, i) (t - times_i)ᵏ on the i-th interval.
using Pieces = Eigen::Matrix<double, 4, Eigen::Dynamic>;

// Second derivatives of the natural spline at all points, by Thomas' algorithm: the matrix is diagonally
// dominant.
VectorXd curvatures(const VectorXd& times, const VectorXd& values) {
  const Index n = times.size();
  VectorXd result = VectorXd::Zero(n);
  if (n < 3) return result;
  VectorXd upper = VectorXd::Zero(n), right = VectorXd::Zero(n);
  for (Index i = 1; i + 1 < n; ++i) {
    const double before = times[i] - times[i - 1], after = times[i + 1] - times[i];
    const double bend = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    right[i] = (6.0 * bend - before * right[i - 1]) / pivot;
  }
  for (Index i = n - 2; i > 0; --i) result[i] = right[i] - upper[i] * result[i + 1];
  return result;
}

Pieces pieces(const VectorXd& times, const VectorXd& values, Interpolation kind) {
  const Index n = times.size();
  Pieces result = Pieces::Zero(4, n);
  result.row(0) = values;
  if (kind == Interpolation::steps) return result;
  const VectorXd second =
      kind == Interpolation::cubic ? curvatures(times, values) : VectorXd(VectorXd::Zero(n));
  for (Index i = 0; i + 1 < n; ++i) {
    const double width = times[i + 1] - times[i];
    result(1, i) =
        (values[i + 1] - values[i]) / width - width * (2.0 * second[i] + second[i + 1]) / 6.0;
    result(2, i) = second[i] / 2.0;
    result(3, i) = (second[i + 1] - second[i]) / (6.0 * width);
  }
  return result;
}

// numbers_i for the i of first ≤ i < end whose interval t is in, by bisection.
Expr chosen(const VectorXd& numbers, const VectorXd& times, const Expr& t, Index first, Index end) {
  if ((numbers.segment(first, end - first).array() == numbers[first]).all()) return numbers[first];
  const Index middle = first + (end - first) / 2;
  return select(t < times[middle], chosen(numbers, times, t, first, middle),
                chosen(numbers, times, t, middle, end));
}

}  // namespace

Expr interpolated(const VectorXd& times, const VectorXd& values, Interpolation kind,
                  const Expr& t) {
  const Index n = times.size();
  if (n == 0 || values.size() != n)
    throw std::invalid_argument("interpolated: there are " + std::to_string(n) + " times and " +
                                std::to_string(values.size()) +
                                " values; expected as many, one at least.");
  if (!times.allFinite() || !values.allFinite())
    throw std::invalid_argument("interpolated: a time or a value is not finite; expected numbers.");
  for (Index i = 1; i < n; ++i)
    if (!(times[i] > times[i - 1]))
      throw std::invalid_argument("interpolated: time " + std::to_string(i + 1) +
                                  " is not after the one before; expected increasing times.");
  const Pieces coefficients = pieces(times, values, kind);
  if (!coefficients.allFinite())
    throw std::invalid_argument(
        "interpolated: the curve through the values overflows; expected smaller values or times "
        "that are further apart.");
  const Expr from = chosen(times, times, t, 0, n);
  const Expr within = max(min(t, times[n - 1]), times[0]) - from;
  Expr sum = 0.0;
  for (Index k = 3; k >= 0; --k)
    sum = sum * within + chosen(coefficients.row(k).transpose(), times, t, 0, n);
  return sum;
}

}  // namespace courant
