// The next unknown of a sequence of steps, by extrapolation of the last ones.
#pragma once

#include <vector>

#include "courant/core/expr.hpp"

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
// Nothing is allocated after construction. Coordinates of tangent vectors are to be those in a
// basis that moves smoothly (MovingBasis).
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

  void predict(VectorXd& y) const;  // needs a recorded unknown; writes those at its places
  void record(const VectorXd& y);   // the unknown of a step that was made
  void forget();                    // as if nothing had been recorded
  bool is_empty() const { return count_ == 0; }
  // From now on no degree above `degree`.
  void limit_degree(int degree);

 private:
  static constexpr int kJudged = 3;  // last steps that degrees are judged by
  static constexpr int kKept = kMaxDegree + 1 + kJudged;

  struct Group {
    Index begin, end;  // in places_
    // Of the unknowns that are -m mod kKept steps old, twice over: at kKept - newest_ begin the
    // weights of the rows.
    Eigen::Matrix<double, 2 * kKept, 1> weights = Eigen::Matrix<double, 2 * kKept, 1>::Zero();
  };

  void choose_degrees();
  int best_degree(const Group& group) const;
  static void set_degree(Group& group, int degree);

  std::vector<Group> groups_;  // of places
  std::vector<Index> places_;
  // A ring: a row an unknown, the newest in row newest_.
  Eigen::Matrix<double, kKept, Eigen::Dynamic> history_;
  int newest_ = 0;
  int count_ = 0;  // unknowns in the history
  int steps_to_choice_ = 0;
  int limit_ = kMaxDegree;
};

}  // namespace courant
