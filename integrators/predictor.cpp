#include "courant/integrators/predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace courant {
namespace {

constexpr int kStepsBetweenChoices = 32;

}  // namespace

Predictor::Predictor(const Manifold& manifold, Index blocks, Index size)
    : constant_basis_(manifold.dimension() == manifold.tangent_dimension()),
      coordinates_(manifold.dimension()),
      tangents_(manifold.tangent_dimension()),
      blocks_(blocks),
      tangent_(VectorXd::Zero(blocks * tangents_)) {
  vectors_.history.setZero(kKept, blocks * tangents_);
  others_.history.setZero(kKept, size - blocks * coordinates_);
}

Predictor::Predictor(Index size) { others_.history.setZero(kKept, size); }

void Predictor::predict(const MatrixXd& basis, VectorXd& y) {
  if (constant_basis_) {
    predict(vectors_, y.data());
  } else {
    predict(vectors_, tangent_.data());
    y.head(blocks_ * coordinates_).reshaped(coordinates_, blocks_) =
        basis.transpose().lazyProduct(tangent_.reshaped(tangents_, blocks_));
  }
  predict(others_, y.data() + blocks_ * coordinates_);
}

void Predictor::record(const MatrixXd& basis, const VectorXd& y) {
  newest_ = (newest_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
  const double* vectors = y.data();
  if (!constant_basis_) {
    tangent_.reshaped(tangents_, blocks_) =
        basis.lazyProduct(y.head(blocks_ * coordinates_).reshaped(coordinates_, blocks_));
    vectors = tangent_.data();
  }
  record(vectors_, vectors);
  record(others_, y.data() + blocks_ * coordinates_);
  if (--steps_to_choice_ > 0) return;
  choose_degrees();
  steps_to_choice_ = count_ < kKept ? 1 : kStepsBetweenChoices;
}

void Predictor::limit_degree(int degree) {
  if (degree >= limit_) return;
  limit_ = degree;
  if (count_ > 0) choose_degrees();
}

void Predictor::choose_degrees() {
  set_degree(vectors_, std::min(limit_, best_degree(vectors_)));
  set_degree(others_, std::min(limit_, best_degree(others_)));
}

void Predictor::predict(const Block& block, double* values) const {
  const auto weights = block.weights.segment<kKept>(kKept - newest_);
  for (Index i = 0; i < block.history.cols(); ++i) values[i] = block.history.col(i).dot(weights);
}

void Predictor::record(Block& block, const double* values) const {
  for (Index i = 0; i < block.history.cols(); ++i) block.history(newest_, i) = values[i];
}

// The degree that would have been best for the newest unknowns; one higher than those that can be
// judged if the errors have fallen so far.
int Predictor::best_degree(const Block& block) const {
  std::array<double, kMaxDegree + 1> largest = {};           // |∇ᵈ⁺¹| of the newest unknowns
  const int degrees = std::min(count_ - 1, kMaxDegree + 1);  // those that can be judged
  for (Index i = 0; i < block.history.cols(); ++i) {
    std::array<double, kKept> differences;  // ∇ʲ of the unknown that is so many steps old
    for (int age = 0; age < count_; ++age)
      differences[static_cast<std::size_t>(age)] =
          block.history((newest_ + kKept - age) % kKept, i);
    for (int d = 0; d < degrees; ++d) {
      const int remaining = count_ - d - 1;
      for (std::size_t age = 0; age < static_cast<std::size_t>(remaining); ++age)
        differences[age] -= differences[age + 1];
      double& error = largest[static_cast<std::size_t>(d)];
      for (std::size_t age = 0; age < static_cast<std::size_t>(std::min(remaining, kJudged)); ++age)
        error = std::max(error, std::fabs(differences[age]));
    }
  }
  if (degrees == 0) return 0;
  const auto best = static_cast<int>(std::min_element(largest.begin(), largest.begin() + degrees) -
                                     largest.begin());
  return best == degrees - 1 ? std::min(best + 1, kMaxDegree) : best;
}

void Predictor::set_degree(Block& block, int degree) {
  block.weights.setZero();
  double binomial = 1.0;
  for (int age = 0; age <= degree; ++age) {
    binomial *= static_cast<double>(degree + 1 - age) / (age + 1);
    const double weight = age % 2 == 0 ? binomial : -binomial;
    block.weights[kKept - age] = weight;
    block.weights[(2 * kKept - age) % (2 * kKept)] = weight;
  }
}

}  // namespace courant
