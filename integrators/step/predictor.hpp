// The next unknown of a sequence of steps, by extrapolation of the last ones.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/linear/pairs.hpp"

namespace courant {

// Extrapolates the unknowns of steps by the polynomial of degree d through the last d + 1 of them:
//
//   y_{k+1} ≈ Σ_{j=0}^{d} (-1)ʲ (d+1 choose j+1) y_{k-j},   wrong by ∇ᵈ⁺¹ y_{k+1}
//
// What each degree would have been wrong by in the last steps says which is best: a high one while
// steps are short and the motion is smooth, a low one where it is rough or round-off is all that is
// left. It is chosen for each of some consecutive groups of unknowns apart, in every step at first,
// later now and then.
//
// Symmetric methods carry what is infinitely fast on with the other sign in each step, as multipliers and
// momenta of Method 1 under constraints. Where that is much better, every second unknown is extrapolated,
//
//   y_{k+1} ≈ Σ_{j=0}^{d} (-1)ʲ (d+1 choose j+1) y_{k-1-2j},
//
// which is exact for p(k) + (-1)ᵏ q(k) with polynomials p, q of degree d.
//
// The stages of a composition are near each other in time, and each is extrapolated from as many steps
// before: what the prediction of one was wrong by, the next one's will be wrong by too, but for the
// time between them. Predictions are corrected by that, as long as it would have made the last one
// better.
//
// Nothing is allocated after construction. Coordinates of tangent vectors are to be those in a
// basis that moves smoothly (TransportedFrame).
class Predictor {
 public:
  static constexpr int kMaxDegree = 8;
  // The limit where equations leave something undetermined: what is predicted there stays, so that
  // its round-off grows like steps^{d + 1/2}.
  static constexpr int kUndetermined = 1;

  // `groups`: their sizes. Only the unknowns at these places, ascending, are looked at.
  Predictor(const std::vector<Index>& groups, std::vector<Index> places);
  // All of them.
  explicit Predictor(const std::vector<Index>& groups);

  // Predictions are corrected by so many times, for each unknown, what that of the newest unknown of
  // `other`, by the same extrapolation, would have been wrong by. `other` looks at the same places, and
  // lives as long.
  void learn_from(const Predictor& other, const VectorXd& times);

  void predict(VectorXd& y);       // needs a recorded unknown; writes those at its places
  void record(const VectorXd& y);  // the unknown of a step that was made
  void forget();                   // as if nothing had been recorded
  bool is_empty() const { return count_ == 0; }
  // From now on no degree above `degree`.
  void limit_degree(int degree);

 private:
  static constexpr int kJudged = 3;  // last steps that degrees are judged by
  static constexpr int kKept = kMaxDegree + 1 + kJudged;

  // Σ_{j<order} (-1)ʲ (order choose j+1) y_{k+1-(j+1) spacing}: a polynomial of degree order - 1.
  struct Rule {
    int order = 1, spacing = 1;
    bool operator==(const Rule&) const = default;
    int reach() const { return order * spacing; }  // so many of the last unknowns
  };
  using Errors = std::array<double, kMaxDegree + 1>;  // of each order

  struct Group {
    Index begin, end;  // in places_
    Rule rule = {};
    bool is_corrected = true;         // the last prediction would have been better for it
    std::optional<Rule> judged = {};  // that of errors_
    std::array<double, kMaxDegree + 1> weights = {};  // of the rule, for each j
  };

  struct Companion {
    const Predictor* predictor;
    VectorXd times;  // for each place
  };

  // Those that were recorded so many steps ago.
  const double* recorded(int age) const {
    return history_.data() + (newest_ + kKept - age) * history_.cols();
  }
  void extrapolate(const Group& group, int age, double* result) const;
  void correct(std::size_t group);
  void judge(const VectorXd& y);
  void choose_rules();
  Rule best_rule(const Group& group) const;
  Errors errors(const Group& group, int spacing, int most) const;
  template <class Numbers, class Spacing, class Count, class Most>
  void judge_orders(Index i, Spacing spacing, Count count, Most most, PairMaximum* largest) const;
  static void set_rule(Group& group, const Rule& rule);

  std::vector<Group> groups_;  // of places
  std::vector<Index> places_;
  bool is_contiguous_ = false;  // places_, without gaps
  // A ring, twice over: the newest unknowns are in the rows newest_ and newest_ + kKept.
  Eigen::Matrix<double, 2 * kKept, Eigen::Dynamic, Eigen::RowMajor> history_;
  std::vector<Companion> companions_;
  VectorXd extrapolated_, corrections_;  // of the prediction that was made last
  VectorXd errors_;                      // of the extrapolation of the newest unknown
  VectorXd before_;             // workspace: what would have been predicted for a companion's
  bool has_predicted_ = false;  // since the last record()
  int newest_ = 0;
  int count_ = 0;  // unknowns in the history
  int steps_to_choice_ = 0;
  int limit_ = kMaxDegree;
};

}  // namespace courant
