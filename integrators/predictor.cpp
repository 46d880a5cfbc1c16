#include "courant/integrators/predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "courant/core/unknown_selection.hpp"

namespace courant {
namespace {

constexpr int kStepsBetweenChoices = 32;

// Two unknowns, or one.
using Two = Eigen::Array2d;
void read(const double* from, Two& to) { to = Eigen::Map<const Two>(from); }
void read(const double* from, double& to) { to = *from; }
void enlarge(Two& size, const Two& by) { size = size.max(by.abs()); }
void enlarge(double& size, double by) { size = std::max(size, std::fabs(by)); }

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
  is_contiguous_ = !places_.empty() && places_.back() - places_.front() + 1 == std::ssize(places_);
  history_.setZero(2 * kKept, std::ssize(places_));
  extrapolated_.setZero(std::ssize(places_));
}

Predictor::Predictor(const std::vector<Index>& groups) : Predictor(groups, all_of(groups)) {}

void Predictor::learn_from(const Predictor& other, const VectorXd& times) {
  companions_.push_back({.predictor = &other, .times = times(places_)});
  corrections_ = errors_ = before_ = VectorXd::Zero(std::ssize(places_));
}

// Σ_j w_j (what was recorded j steps before that of this age), in ascending order of j for each unknown,
// so that steps in C give the same bits; two unknowns at a time.
void Predictor::extrapolate(const Group& group, int age, double* result) const {
  const double* const rows = recorded(age);
  const Index stride = history_.cols();
  Index i = group.begin;
  for (; i + 1 < group.end; i += 2) {
    const double* row = rows + i;
    Two sum = group.weights[0] * Eigen::Map<const Two>(row);
    for (int j = 1; j <= group.degree; ++j) {
      row -= stride;
      sum += group.weights[static_cast<std::size_t>(j)] * Eigen::Map<const Two>(row);
    }
    Eigen::Map<Two>(result + i) = sum;
  }
  if (i == group.end) return;
  const double* row = rows + i;
  double sum = group.weights[0] * *row;
  for (int j = 1; j <= group.degree; ++j) {
    row -= stride;
    sum += group.weights[static_cast<std::size_t>(j)] * *row;
  }
  result[i] = sum;
}

void Predictor::predict(VectorXd& y) {
  const bool is_corrected = !companions_.empty();
  double* const result =
      is_contiguous_ && !is_corrected ? y.data() + places_.front() : extrapolated_.data();
  for (const Group& group : groups_) extrapolate(group, 0, result);
  if (result != extrapolated_.data()) return;
  for (std::size_t i = 0; i < places_.size(); ++i)
    y[places_[i]] = extrapolated_[static_cast<Index>(i)];
  if (!is_corrected) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    correct(g);
    const Group& group = groups_[g];
    if (!group.is_corrected) continue;
    for (Index i = group.begin; i < group.end; ++i)
      y[places_[static_cast<std::size_t>(i)]] += corrections_[i];
  }
  has_predicted_ = true;
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
    if (of->groups_[g].judged_degree == group.degree) {
      for (Index i = group.begin; i < group.end; ++i) corrections_[i] += times[i] * of->errors_[i];
      continue;
    }
    of->extrapolate(group, 1, before_.data());
    const double* const newest = of->recorded(0);
    for (Index i = group.begin; i < group.end; ++i)
      corrections_[i] += times[i] * (newest[i] - before_[i]);
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
  double* const newest = history_.data() + newest_ * history_.cols();
  double* const again = newest + kKept * history_.cols();
  const double* const from = is_contiguous_ ? y.data() + places_.front() : extrapolated_.data();
  if (!is_contiguous_)
    for (std::size_t i = 0; i < places_.size(); ++i)
      extrapolated_[static_cast<Index>(i)] = y[places_[i]];
  std::copy_n(from, places_.size(), newest);
  std::copy_n(from, places_.size(), again);
  if (count_ == 0) steps_to_choice_ = 0;
  count_ = std::min(count_ + 1, kKept);
  if (--steps_to_choice_ > 0) return;
  choose_degrees();
  steps_to_choice_ = count_ < kKept ? 1 : kStepsBetweenChoices;
}

void Predictor::forget() {
  for (Group& group : groups_) {
    group.weights = {};
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
  const int degrees = std::min(count_ - 1, kMaxDegree + 1);  // those that can be judged
  if (degrees == 0) return 0;
  std::array<Two, kMaxDegree + 1> of_two;  // |∇ᵈ⁺¹| of the newest unknowns
  std::array<double, kMaxDegree + 1> largest = {};
  of_two.fill(Two::Zero());
  Index i = group.begin;
  for (; i + 1 < group.end; i += 2) judge_degrees(i, degrees, of_two.data());
  if (i < group.end) judge_degrees(i, degrees, largest.data());
  for (std::size_t d = 0; d < largest.size(); ++d)
    largest[d] = std::max(largest[d], of_two[d].maxCoeff());
  const auto best = static_cast<int>(std::min_element(largest.begin(), largest.begin() + degrees) -
                                     largest.begin());
  return best == degrees - 1 ? std::min(best + 1, kMaxDegree) : best;
}

// Of the unknown i, or of i and i + 1.
template <class Numbers>
void Predictor::judge_degrees(Index i, int degrees, Numbers* largest) const {
  Numbers differences[kKept];  // ∇ʲ of the unknown that is so many steps old
  for (int age = 0; age < count_; ++age) read(recorded(age) + i, differences[age]);
  for (int d = 0; d < degrees; ++d) {
    const int remaining = count_ - d - 1;
    for (int age = 0; age < remaining; ++age) differences[age] -= differences[age + 1];
    for (int age = 0; age < std::min(remaining, kJudged); ++age)
      enlarge(largest[d], differences[age]);
  }
}

void Predictor::set_degree(Group& group, int degree) {
  group.degree = degree;
  group.weights = {};
  double binomial = 1.0;
  for (int age = 0; age <= degree; ++age) {
    binomial *= static_cast<double>(degree + 1 - age) / (age + 1);
    group.weights[static_cast<std::size_t>(age)] = age % 2 == 0 ? binomial : -binomial;
  }
}

}  // namespace courant
