#include "courant/integrators/step/round_off_projection.hpp"

#include <cmath>
#include <limits>

#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/plain_products.hpp"

namespace courant {
namespace {

// Equations of bundles repeat each other up to round-off: what is left of a gradient is no direction to move in
// where it is shorter than this part of the longest one.
constexpr double kNoDirection = 1e-8;

}  // namespace

Function::Formulas RoundOffProjection::formulas(const Manifold& manifold) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  return {{{"x", x}}, manifold.constraint(x)};
}

Function RoundOffProjection::constraint(const Manifold& manifold, Backend backend) {
  return Function("constraint", formulas(manifold), {.differentiate = {"x"}, .backend = backend});
}

RoundOffProjection::RoundOffProjection(Function constraint) : constraint_(std::move(constraint)) {
  all_.resize(constraint_.output_size() + constraint_.nonzeros());
  gradients_.resize(constraint_.input_size(0), constraint_.output_size());
}

void RoundOffProjection::apply(VectorXd& x) {
  const Index count = constraint_.output_size(), size = x.size();
  if (count == 0) return;
  const double* in[] = {x.data()};
  constraint_.value(in, all_.data());
  const double negligible = 32.0 * std::numeric_limits<double>::epsilon() *
                            std::max(1.0, plain_product(x.data(), x.data(), size));
  if (all_.head(count).lpNorm<Eigen::Infinity>() <= negligible) return;
  constraint_.value_and_jacobian(in, all_.data());
  if (!are_finite(all_.data(), all_.size())) return;  // who made this x reports it
  gradients_.setZero();
  for (std::size_t k = 0; k < constraint_.pattern_row().size(); ++k)
    gradients_(constraint_.pattern_col()[k], constraint_.pattern_row()[k]) =
        all_[count + static_cast<Index>(k)];
  double first = 0.0;  // the length of the longest
  for (Index turn = 0; turn < count; ++turn) {
    const auto [longest, square] = longest_column(gradients_.data(), size, count);
    const double length = std::sqrt(square);
    if (turn == 0) first = length;
    if (!(length > kNoDirection * first)) return;
    double* const direction = gradients_.data() + longest * size;
    for (Index j = 0; j < size; ++j) direction[j] /= length;
    const double distance = all_[longest] / length;
    for (Index j = 0; j < size; ++j) x[j] -= distance * direction[j];
    for (Index i = 0; i < count; ++i) {
      if (i == longest) continue;
      double* const gradient = gradients_.data() + i * size;
      const double part = plain_product(direction, gradient, size);
      for (Index j = 0; j < size; ++j) gradient[j] -= part * direction[j];
      all_[i] -= part * distance;
    }
    for (Index j = 0; j < size; ++j) direction[j] = 0.0;
  }
}

}  // namespace courant
