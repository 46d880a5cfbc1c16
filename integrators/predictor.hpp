// The next unknown of a sequence of steps, by extrapolation of the last ones.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// Extrapolates the unknowns of steps by the polynomial of degree d through the last d + 1 of them:
//
//   y_{k+1} ≈ Σ_{j=0}^{d} (-1)ʲ (d+1 choose j+1) y_{k-j},   wrong by ∇ᵈ⁺¹ y_{k+1}
//
// What each degree would have been wrong by in the last steps says which is best: a high one while
// steps are short and the motion is smooth, a low one where it is rough or round-off is all that is
// left. It is chosen for the tangent vectors and for the other unknowns apart, in every step at
// first, later now and then.
//
// The first `blocks` · n entries of an unknown are coordinates of tangent vectors with respect to
// the basis of its step; they are kept in the tangent representation (Ñ each), which outlives the
// basis. Nothing is allocated after construction.
class Predictor {
 public:
  static constexpr int kMaxDegree = 8;
  // The limit where equations leave something undetermined: what is predicted there stays, so that
  // its round-off grows like steps^{d + 1/2}.
  static constexpr int kUndetermined = 1;

  // `size` entries in an unknown, blocks · n of them coordinates.
  Predictor(const Manifold& manifold, Index blocks, Index size);
  // Of unknowns without coordinates.
  explicit Predictor(Index size);

  // `basis` (Ñ × n) is that of the step to come; needs a recorded unknown.
  void predict(const MatrixXd& basis, VectorXd& y);
  void predict(VectorXd& y) { predict(MatrixXd(), y); }
  // The unknown of a step that was made, in the basis of that step.
  void record(const MatrixXd& basis, const VectorXd& y);
  void record(const VectorXd& y) { record(MatrixXd(), y); }
  bool is_empty() const { return count_ == 0; }
  // From now on no degree above `degree`.
  void limit_degree(int degree);

 private:
  static constexpr int kJudged = 3;  // last steps that degrees are judged by
  static constexpr int kKept = kMaxDegree + 1 + kJudged;

  // A part of the unknowns. The history is a ring: a row an unknown, the newest in row newest_.
  struct Block {
    Eigen::Matrix<double, kKept, Eigen::Dynamic> history;
    // Of the unknowns that are -m mod kKept steps old, twice over: at kKept - newest_ begin the
    // weights of the rows.
    Eigen::Matrix<double, 2 * kKept, 1> weights;
  };

  void predict(const Block& block, double* values) const;
  void record(Block& block, const double* values) const;
  void choose_degrees();
  int best_degree(const Block& block) const;
  static void set_degree(Block& block, int degree);

  bool constant_basis_ = true;
  Index coordinates_ = 0, tangents_ = 0, blocks_ = 0;
  Block vectors_, others_;
  VectorXd tangent_;  // the vectors in the tangent representation
  int newest_ = 0;
  int count_ = 0;  // unknowns in the history
  int steps_to_choice_ = 0;
  int limit_ = kMaxDegree;
};

}  // namespace courant
