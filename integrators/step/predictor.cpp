#include "courant/integrators/step/predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numeric>
#include <type_traits>

#include "courant/core/solve/unknown_selection.hpp"

namespace courant {
namespace {

constexpr int kStepsBetweenChoices = 64;

// Every second unknown is extrapolated up to this order, where that would have been wrong by less than this
// part of what the best polynomial through all of them would have been.
constexpr int kMaxAlternatingOrder = 4;
constexpr double kMuchBetter = 0.25;

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

// Σ_j w_j (what was recorded `spacing` steps after one another), from that of this age on. The oldest come first, in
// the same order for each unknown, so that steps in C give the same bits: the newest have been found just now, and
// what waits for them should be short.
void Predictor::extrapolate(const Group& group, int age, double* result) const {
  const int order = group.rule.order, spacing = group.rule.spacing;
  const double* const oldest = recorded(age + order * spacing - 1);
  const Index stride = spacing * history_.cols();
  const double* const weights = group.weights.data();
  // Of `count` times one or two unknowns.
  const auto sum = [&]<class Numbers>(Index i, Numbers* sums, int count) {
    constexpr Index width = std::same_as<Numbers, Pair> ? 2 : 1;
    const double* row = oldest + i;
    for (int k = 0; k < count; ++k) sums[k] = weights[order - 1] * read<Numbers>(row + k * width);
    for (int j = order - 2; j >= 0; --j) {
      row += stride;
      for (int k = 0; k < count; ++k) sums[k] += weights[j] * read<Numbers>(row + k * width);
    }
    for (int k = 0; k < count; ++k) write(result + i + k * width, sums[k]);
  };
  Index i = group.begin;
  for (; i + 7 < group.end; i += 8) {
    Pair eight[4];
    sum(i, eight, 4);
  }
  for_each_pair(i, group.end, [&]<class Numbers>(Index k, Numbers one) { sum(k, &one, 1); });
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
    if (of->count_ < group.rule.reach() + 1) return;
  for (const auto& [of, times] : companions_) {
    if (of->groups_[g].judged == group.rule) {
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
    group.judged = group.rule;
  }
}

void Predictor::record(const VectorXd& y) {
  for (Group& group : groups_) group.judged.reset();
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
  choose_rules();
  steps_to_choice_ = count_ < kKept ? 1 : kStepsBetweenChoices;
}

void Predictor::forget() {
  for (Group& group : groups_) {
    group.weights = {};
    group.rule = {};
    group.is_corrected = true;
    group.judged.reset();
  }
  has_predicted_ = false;
  history_.setZero();
  newest_ = count_ = steps_to_choice_ = 0;
  limit_ = kMaxDegree;
}

void Predictor::limit_degree(int degree) {
  if (degree >= limit_) return;
  limit_ = degree;
  if (count_ > 0) choose_rules();
}

void Predictor::choose_rules() {
  for (Group& group : groups_) set_rule(group, best_rule(group));
}

// The rule that would have been best for the newest unknowns; of one order more than those that can be judged
// if the errors of polynomials have fallen so far.
Predictor::Rule Predictor::best_rule(const Group& group) const {
  const int most = std::min(count_ - 1, kMaxDegree + 1);  // orders that can be judged
  if (most == 0) return {};
  const Errors of_all = errors(group, 1, most);
  const auto lowest = std::min_element(of_all.begin(), of_all.begin() + most);
  Rule best{.order = static_cast<int>(lowest - of_all.begin()) + 1};
  const int most_of_second = std::min({kMaxAlternatingOrder, limit_ + 1, (count_ - kJudged) / 2});
  if (most_of_second > 0) {
    const Errors of_second = errors(group, 2, most_of_second);
    const auto second = std::min_element(of_second.begin(), of_second.begin() + most_of_second);
    if (*second < kMuchBetter * *lowest)
      best = {.order = static_cast<int>(second - of_second.begin()) + 1, .spacing = 2};
  }
  if (best.spacing == 1 && best.order == most)
    best.order = std::min(best.order + 1, kMaxDegree + 1);
  best.order = std::min(best.order, limit_ + 1);
  return best;
}

// What the rules of this spacing, of order 1 and so on, would have been wrong by for the newest unknowns.
Predictor::Errors Predictor::errors(const Group& group, int spacing, int most) const {
  Errors result = {};
  const bool is_usual = spacing == 1 && count_ == kKept && most == kMaxDegree + 1;
  std::array<PairMaximum, kMaxDegree + 1> largest;
  for_each_pair(group.begin, group.end, [&]<class Numbers>(Index i, Numbers) {
    if (is_usual)
      judge_orders<Numbers>(i, std::integral_constant<int, 1>(),
                            std::integral_constant<int, kKept>(),
                            std::integral_constant<int, kMaxDegree + 1>(), largest.data());
    else
      judge_orders<Numbers>(i, spacing, count_, most, largest.data());
  });
  std::ranges::transform(largest, result.begin(), &PairMaximum::value);
  return result;
}

// Of the unknown i, or of i and i + 1. Where a history is full the compiler knows all numbers.
template <class Numbers, class Spacing, class Count, class Most>
void Predictor::judge_orders(Index i, Spacing spacing, Count count, Most most,
                             PairMaximum* largest) const {
  Numbers differences[kKept];  // of the unknown that is so many steps old
  for (int age = 0; age < count; ++age) differences[age] = read<Numbers>(recorded(age) + i);
  for (int order = 1; order <= most; ++order) {
    const int remaining = count - order * spacing;
    for (int age = 0; age < remaining; ++age) differences[age] -= differences[age + spacing];
    for (int age = 0; age < std::min(remaining, kJudged); ++age)
      largest[order - 1].add(Numbers(magnitude(differences[age])));
  }
}

void Predictor::set_rule(Group& group, const Rule& rule) {
  group.rule = rule;
  group.weights = {};
  double binomial = 1.0;
  for (int j = 0; j < rule.order; ++j) {
    binomial *= static_cast<double>(rule.order - j) / (j + 1);
    group.weights[static_cast<std::size_t>(j)] = j % 2 == 0 ? binomial : -binomial;
  }
}

}  // namespace courant
