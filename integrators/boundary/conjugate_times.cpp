#include "courant/integrators/boundary/conjugate_times.hpp"

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

// One unit for all conditions: what is round-off in one, as that of a sphere at its pole, is not scaled up.
RankOptions one_unit(const MatrixXd& A) {
  constexpr double error = 1e-9;
  return {.data_error = error, .magnitude = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0};
}

}  // namespace

std::optional<std::vector<double>> conjugate_times(const Shooting& shooting, const State& start,
                                                   double h, long steps) {
  const VectorXd none(0);
  const ConsistentPoints& points = shooting.points();
  const MatrixXd B = points.directions(start);
  MatrixXd V = B;
  if (shooting.initial_count() > 0) {
    const MatrixXd slopes = shooting.initial_slopes(start, B, none);
    V = B * kernel(slopes, one_unit(slopes));
  }
  const Index k = V.cols();
  if (k == 0) return std::nullopt;
  const DiscreteFlow one = shooting.flow().over(h, 1);
  std::vector<double> times;
  State state = start;
  MatrixXd W;
  double before = 0.0;
  for (long j = 1; j <= steps; ++j) {
    auto image = one.push_forward(state, V);
    state = std::move(image.end);
    state.t = start.t + static_cast<double>(j) * h;
    V = std::move(image.directions);
    const MatrixXd all = shooting.final_slopes(state, points.directions(state), none);
    const MatrixXd span = range(all, one_unit(all));
    if (span.cols() != k) return std::nullopt;
    if (W.size() == 0) {
      W = span;
    } else {  // the orthonormal basis of the span that is nearest to the last one
      const auto [values, U, right] = singular_value_decomposition(span.transpose() * W);
      W = span * U * right.transpose();
    }
    const double now =
        LuDecomposition(W.transpose() * shooting.final_slopes(state, V, none)).determinant();
    if (before * now < 0.0) times.push_back(state.t - h * now / (now - before));
    if (now != 0.0) before = now;
  }
  return times;
}

}  // namespace courant
