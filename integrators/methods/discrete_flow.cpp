#include "courant/integrators/methods/discrete_flow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/generalized_eigenvalues.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

void require_rows(const char* place, const MatrixXd& V, const State& at) {
  if (V.rows() != at.x.size())
    throw std::invalid_argument(
        std::string("DiscreteFlow::") + place + ": the matrix is " + size_text(V.rows(), V.cols()) +
        "; expected a row for each of the " + std::to_string(at.x.size()) + " numbers of a point.");
}

}  // namespace

MatrixXd consistent_directions(const Manifold& M, const MatrixXd& conormals, const VectorXd& x) {
  const MatrixXd basis = M.tangent_basis(x);
  const MatrixXd frame = M.frame(x);
  if (conormals.rows() == 0) return frame * basis;
  return frame * basis * kernel(conormals * basis, {.data_error = 1e-9});
}

DiscreteFlow::DiscreteFlow(std::shared_ptr<const Integrator> method, double h, long steps)
    : DiscreteFlow(std::move(method), nullptr, h, steps) {
  differential_ = method_->differential();
  if (!differential_)
    throw std::invalid_argument("DiscreteFlow::DiscreteFlow: " + method_->name() +
                                " does not know the differential of its steps; expected a method "
                                "that does.");
}

DiscreteFlow::DiscreteFlow(std::shared_ptr<const Integrator> method,
                           std::shared_ptr<const StepDifferential> differential, double h,
                           long steps)
    : method_(std::move(method)), differential_(std::move(differential)), h_(h), steps_(steps) {
  if (!method_ || !(std::fabs(h) > 0.0) || !std::isfinite(h) || steps < 0)
    throw std::invalid_argument("DiscreteFlow::DiscreteFlow: the method is null, h is " +
                                number_text(h) + " or steps is " + std::to_string(steps) +
                                "; expected a method, h != 0 and steps >= 0.");
}

void DiscreteFlow::make(Stepper& stepper, State& state, double start, long first, long last,
                        const std::function<void(const Step&)>& tell) const {
  for (long k = first + 1; k <= last; ++k) {
    stepper.step(state, h_, start + static_cast<double>(k) * h_);
    if (tell) tell(stepper.last());
  }
}

DiscreteFlow DiscreteFlow::over(double h, long steps) const {
  return {method_, differential_, h, steps};
}

DiscreteFlow::Image DiscreteFlow::push_forward(const State& start, const MatrixXd& V) const {
  require_rows("push_forward", V, start);
  const auto stepper = method_->stepper();
  stepper->tell_parts();
  Image image{start, V};
  stepper->prepare(image.end, h_);
  make(*stepper, image.end, start.t, 0, steps_,
       [&](const Step& step) { image.directions = (*differential_)(step, image.directions); });
  return image;
}

DiscreteFlow::Gradient DiscreteFlow::pull_back(const State& start, const Slopes& slopes) const {
  const auto stepper = method_->stepper();
  stepper->tell_parts();
  const long between = std::max(1L, std::lround(std::sqrt(static_cast<double>(steps_))));
  State state = start;
  stepper->prepare(state, h_);
  // A stepper that forgets makes the same steps once more, to the last bit.
  std::vector<State> checkpoints;
  for (long first = 0; first < steps_; first += between) {
    checkpoints.push_back(state);
    stepper->forget();
    make(*stepper, state, start.t, first, std::min(first + between, steps_), {});
  }
  Gradient result{state, MatrixXd()};
  const auto add = [&](long j, const State& at) {
    const MatrixXd slope = slopes(j, at);
    if (slope.size() == 0) return;
    require_rows("pull_back", slope, at);
    if (result.covectors.size() == 0)
      result.covectors = slope;
    else
      result.covectors += slope;
  };
  add(steps_, state);
  std::vector<Step> steps;
  for (std::size_t segment = checkpoints.size(); segment-- > 0;) {
    const long first = static_cast<long>(segment) * between;
    steps.clear();
    stepper->forget();
    make(*stepper, checkpoints[segment], start.t, first, std::min(first + between, steps_),
         [&](const Step& step) { steps.push_back(step); });
    for (std::size_t i = steps.size(); i-- > 0;) {
      if (result.covectors.size() > 0)
        result.covectors = differential_->pull_back(steps[i], result.covectors);
      add(first + static_cast<long>(i), steps[i].before);
    }
  }
  if (result.covectors.size() == 0) result.covectors = MatrixXd::Zero(start.x.size(), 0);
  return result;
}

VectorXd DiscreteFlow::lyapunov_exponents(const State& start, const MatrixXd& V, long every) const {
  require_rows("lyapunov_exponents", V, start);
  if (steps_ < 1 || every < 1)
    throw std::invalid_argument("DiscreteFlow::lyapunov_exponents: steps is " +
                                std::to_string(steps_) + ", every is " + std::to_string(every) +
                                "; expected both to be at least 1.");
  const auto stepper = method_->stepper();
  stepper->tell_parts();
  State state = start;
  stepper->prepare(state, h_);
  VectorXd growth = VectorXd::Zero(V.cols());
  MatrixXd directions = orthonormalized(V);
  long k = 0;
  make(*stepper, state, start.t, 0, steps_, [&](const Step& step) {
    directions = (*differential_)(step, directions);
    if (++k % every != 0 && k != steps_) return;
    const MatrixXd orthonormal = orthonormalized(directions);
    const MatrixXd factors = orthonormal.transpose() * directions;
    for (Index i = 0; i < growth.size(); ++i) growth[i] += std::log(std::fabs(factors(i, i)));
    directions = orthonormal;
  });
  growth /= std::fabs(static_cast<double>(steps_) * h_);
  std::sort(growth.begin(), growth.end(), std::greater<>());
  return growth;
}

Eigen::VectorXcd DiscreteFlow::multipliers(const State& start, const MatrixXd& V,
                                           double tolerance) const {
  const auto [end, images] = push_forward(start, V);
  const double gap = method_->system()->manifold()->separation(start.x, end.x);
  if (!(gap <= tolerance))
    throw std::domain_error("DiscreteFlow::multipliers: the orbit ends " + number_text(gap) +
                            " from where it began; expected at most " + number_text(tolerance) +
                            ".");
  const MatrixXd T = LuDecomposition(V.transpose() * V).solve(V.transpose() * images);
  const double outside = (V * T - images).norm();
  if (!(outside <= 10.0 * std::max(tolerance, 1e-12) * images.norm()))
    throw std::domain_error("DiscreteFlow::multipliers: the tangent map leads " +
                            number_text(outside) +
                            " out of the span of the directions; expected one that it keeps.");
  const auto [alphas, betas] = generalized_eigenvalues(T, MatrixXd::Identity(T.rows(), T.cols()));
  Eigen::VectorXcd values = alphas.cwiseQuotient(betas);
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return values;
}

}  // namespace courant
