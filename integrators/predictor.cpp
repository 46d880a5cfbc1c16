#include "courant/integrators/predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "courant/core/unknown_selection.hpp"

namespace courant {
namespace {

constexpr int kStepsBetweenChoices = 32;

// Σ a_j b_j, the even places and the odd ones apart: two sums at a time, in an order that does not
// depend on the machine, so that steps in C give the same bits.
template <int size>
double sum_of_products(const double* a, const double* b) {
  static_assert(size % 2 == 0);
  using Two = Eigen::Map<const Eigen::Array2d>;
  Eigen::Array2d sums = Two(a) * Two(b);
  for (int j = 2; j < size; j += 2) sums += Two(a + j) * Two(b + j);
  return sums[0] + sums[1];
}

std::vector<Index> all_of(const std::vector<Index>& groups) {
  std::vector<Index> places(
      static_cast<std::size_t>(std::accumulate(groups.begin(), groups.end(), Index{0})));
  std::iota(places.begin(), places.end(), Index{0});
  return places;
}

}  // namespace

Predictor::Predictor(const std::vector<Index>& groups, std::vector<Index> places)
    : places_(std::move(places)) {
  Index begin = 0;
  for (const Index end : group_ends(groups, places_)) {
    groups_.push_back({.begin = begin, .end = end});
    begin = end;
  }
  history_.setZero(kKept, std::ssize(places_));
}

Predictor::Predictor(const std::vector<Index>& groups) : Predictor(groups, all_of(groups)) {}

void Predictor::learn_from(const Predictor& other, const VectorXd& times) {
  companions_.push_back({.predictor = &other, .times = times(places_)});
  extrapolated_.setZero(std::ssize(places_));
  corrections_ = errors_ = extrapolated_;
}

void Predictor::predict(VectorXd& y) {
  for (const Group& group : groups_) {
    const double* weights = group.weights.data() + (kKept - newest_);
    for (Index i = group.begin; i < group.end; ++i)
      y[places_[static_cast<std::size_t>(i)]] =
          sum_of_products<kKept>(history_.col(i).data(), weights);
  }
  if (companions_.empty()) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    correct(g);
    for (Index i = group.begin; i < group.end; ++i) {
      double& predicted = y[places_[static_cast<std::size_t>(i)]];
      extrapolated_[i] = predicted;
      if (group.is_corrected) predicted += corrections_[i];
    }
  }
  has_predicted_ = true;
}

// ∇ᵈ⁺¹ of the newest unknown.
double Predictor::newest_error(const Group& group, Index i) const {
  const double* weights = group.weights.data() + (kKept - (newest_ + kKept - 1) % kKept);
  return history_(newest_, i) - sum_of_products<kKept>(history_.col(i).data(), weights);
}

// Zero where a companion cannot tell yet, and where something is left open: no equation would stop
// what corrections do there from growing.
void Predictor::correct(std::size_t g) {
  const Group& group = groups_[g];
  corrections_.segment(group.begin, group.end - group.begin).setZero();
  if (limit_ <= kUndetermined) return;
  for (const auto& [of, times] : companions_)
    if (of->count_ < group.degree + 2) return;
  for (const auto& [of, times] : companions_) {
    const bool is_known = of->groups_[g].judged_degree == group.degree;
    for (Index i = group.begin; i < group.end; ++i)
      corrections_[i] += times[i] * (is_known ? of->errors_[i] : of->newest_error(group, i));
  }
}

void Predictor::judge(const VectorXd& y) {
  for (Group& group : groups_) {
    double plain = 0.0, corrected = 0.0;
    for (Index i = group.begin; i < group.end; ++i) {
      errors_[i] = y[places_[static_cast<std::size_t>(i)]] - extrapolated_[i];
      plain = std::max(plain, std::fabs(errors_[i]));
      corrected = std::max(corrected, std::fabs(errors_[i] - corrections_[i]));
    }
    group.is_corrected = corrected <= plain;
    group.judged_degree = group.degree;
  }
}

void Predictor::record(const VectorXd& y) {
  for (Group& group : groups_) group.judged_degree = -1;
  if (has_predicted_) judge(y);
  has_predicted_ = false;
  newest_ = (newest_ + 1) % kKept;
  for (Index i = 0; i < history_.cols(); ++i)
    history_(newest_, i) = y[places_[static_cast<std::size_t>(i)]];
  if (count_ == 0) steps_to_choice_ = 0;
  count_ = std::min(count_ + 1, kKept);
  if (--steps_to_choice_ > 0) return;
  choose_degrees();
  steps_to_choice_ = count_ < kKept ? 1 : kStepsBetweenChoices;
}

void Predictor::forget() {
  for (Group& group : groups_) {
    group.weights.setZero();
    group.degree = 0;
    group.is_corrected = true;
    group.judged_degree = -1;
  }
  has_predicted_ = false;
  history_.setZero();
  newest_ = count_ = steps_to_choice_ = 0;
  limit_ = kMaxDegree;
}

void Predictor::limit_degree(int degree) {
  if (degree >= limit_) return;
  limit_ = degree;
  if (count_ > 0) choose_degrees();
}

void Predictor::choose_degrees() {
  for (Group& group : groups_) set_degree(group, std::min(limit_, best_degree(group)));
}

// The degree that would have been best for the newest unknowns; one higher than those that can be
// judged if the errors have fallen so far.
int Predictor::best_degree(const Group& group) const {
  std::array<double, kMaxDegree + 1> largest = {};           // |∇ᵈ⁺¹| of the newest unknowns
  const int degrees = std::min(count_ - 1, kMaxDegree + 1);  // those that can be judged
  for (Index i = group.begin; i < group.end; ++i) {
    std::array<double, kKept> differences;  // ∇ʲ of the unknown that is so many steps old
    for (int age = 0; age < count_; ++age)
      differences[static_cast<std::size_t>(age)] = history_((newest_ + kKept - age) % kKept, i);
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

void Predictor::set_degree(Group& group, int degree) {
  group.degree = degree;
  group.weights.setZero();
  double binomial = 1.0;
  for (int age = 0; age <= degree; ++age) {
    binomial *= static_cast<double>(degree + 1 - age) / (age + 1);
    const double weight = age % 2 == 0 ? binomial : -binomial;
    group.weights[kKept - age] = weight;
    group.weights[(2 * kKept - age) % (2 * kKept)] = weight;
  }
}

}  // namespace courant
