#include "courant/core/solve/damped_newton.hpp"

#include <algorithm>
#include <cmath>

namespace courant {
namespace {

// Shorter steps than this part lead nowhere.
constexpr double kShortest = 1e-10;
constexpr double kShrink = 0.1;

// Full steps that shorten the next one by so much are Newton's own. Corrections below kFound, next to
// their block, are at a zero.
constexpr double kContraction = 0.25;
constexpr double kFound = 1e-6;

// ‖change‖ by the sizes of the blocks.
class Norm {
 public:
  Norm(const DampedEquations& equations, const VectorXd& y, const VectorXd& correction)
      : groups_(equations.groups), sizes_(equations.scales) {
    Index begin = 0;
    for (std::size_t g = 0; g < groups_.size(); begin += groups_[g++])
      for (Index i = begin; i < begin + groups_[g]; ++i) {
        double& size = sizes_[static_cast<Index>(g)];
        size = std::max({size, std::fabs(y[i]), std::fabs(correction[i])});
      }
  }

  double operator()(const VectorXd& change) const {
    double result = 0.0;
    Index begin = 0;
    for (std::size_t g = 0; g < groups_.size(); begin += groups_[g++])
      if (groups_[g] > 0 && sizes_[static_cast<Index>(g)] > 0.0)
        result = std::max(result, change.segment(begin, groups_[g]).lpNorm<Eigen::Infinity>() /
                                      sizes_[static_cast<Index>(g)]);
    return result;
  }

 private:
  const std::vector<Index>& groups_;
  VectorXd sizes_;
};

}  // namespace

bool damped_newton(const DampedEquations& equations, VectorXd& y, int iterations) {
  VectorXd correction(y.size()), next(y.size()), before, trial;
  double lambda = 1.0;
  for (int k = 0; k < iterations; ++k) {
    if (!equations.linearize(y) || !equations.correct(y, correction)) return false;
    const Norm norm(equations, y, correction);
    const double length = norm(correction);
    if (length <= kFound) {
      y -= correction;
      return true;
    }
    // What the last step says of this one: by how much `next`, a correction with the former matrix, was
    // wrong.
    if (k > 0) {
      const double wrong = norm(next - correction) * length;
      const double expected = lambda * norm(before) * norm(next);
      lambda = wrong > expected ? std::max(expected / wrong, kShrink * lambda) : 1.0;
    }
    for (;;) {
      if (lambda < kShortest) return false;
      trial = y - lambda * correction;
      double shorter = 0.0;
      if (equations.correct(trial, next)) {
        const double left = norm(next);
        if (left <= (1.0 - 0.25 * lambda) * length) {
          if (lambda == 1.0 && left <= kContraction * length) {
            y = trial;
            return true;
          }
          break;
        }
        shorter = 0.5 * lambda * lambda * length / norm(next - (1.0 - lambda) * correction);
      }
      lambda = std::clamp(shorter, kShrink * lambda, 0.5 * lambda);
    }
    y = trial;
    before = correction;
  }
  return false;
}

}  // namespace courant
