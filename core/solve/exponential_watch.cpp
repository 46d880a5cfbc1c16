#include "courant/core/solve/exponential_watch.hpp"

#include <algorithm>

namespace courant {
namespace {

// Arguments below which exponentials are nothing; what an error of arguments is that is round-off; and a change
// that a matrix is of use over.
constexpr double kNothing = -30.0;
constexpr double kStill = 1e-13;
constexpr double kSameSlope = 1.0;

}  // namespace

ExponentialWatch::ExponentialWatch(const Exponentials& exponentials)
    : of_(exponentials.arguments()),
      arguments_(of_.output_size()),
      before_(arguments_),
      at_matrix_(arguments_),
      y_(of_.input_size(0)) {}

void ExponentialWatch::keep(const Inputs& in) { of_.value(in.data(), at_matrix_.data()); }

bool ExponentialWatch::is_settled(const Inputs& in, const std::vector<Index>& places,
                                  const VectorXd& change) {
  y_ = Eigen::Map<const VectorXd>(in[0], y_.size());
  for (std::size_t k = 0; k < places.size(); ++k) y_[places[k]] += change[static_cast<Index>(k)];
  Inputs before = in;
  before.set_unknowns(y_.data());
  of_.value(in.data(), arguments_.data());
  of_.value(before.data(), before_.data());
  const auto distance = [&](const VectorXd& from) {
    return (arguments_.cwiseMax(kNothing) - from.cwiseMax(kNothing)).lpNorm<Eigen::Infinity>();
  };
  const double moved = distance(before_), away = distance(at_matrix_);
  // The matrix is wrong by about the change of the arguments since.
  return away <= kSameSlope && moved * std::max(moved, away) <= kStill;
}

}  // namespace courant
