// The conormals of M_f along a trajectory.
#pragma once

#include <vector>

#include "courant/core/newton.hpp"
#include "courant/integrators/nearest_orthonormal.hpp"
#include "courant/integrators/predictor.hpp"

namespace courant {

// An orthonormal basis N (n × d) of the annihilator of T_xM_f that turns as little as possible
// while x moves. Where S_f is F(ξ, ξ', …, z, …) = 0 in the chart at x, the conormals are the
// combinations of dF that contain dξ alone:
//
//   c = (∂F/∂ξ)ᵀ w,   (∂F/∂(ξ', …, z, …))ᵀ w = 0
//
// Those at the next point are the solutions with Nᵀ c = e_1, …, e_d for the last N, found by
// Newton's method with a kept factorisation from an extrapolation of the last w, and made
// orthonormal. Where that fails, and at the first point, by QR decomposition. One object a
// trajectory; nothing is allocated but by QR decompositions.
class MovingConormals {
 public:
  // Traced once for all trajectories.
  struct Functions {
    // (ξ, ξ', …, z, …); x₀, basis, t  ↦  F, with Jacobian.
    Function constraints;
    // w; e, (ξ, …), x₀, basis, t, C  ↦  (∂F/∂(ξ', …))ᵀ w, Cᵀ (∂F/∂ξ)ᵀ w - e, with Jacobian by w.
    EquationSystem equations;
    Function conormal;  // the same ↦ (∂F/∂ξ)ᵀ w
  };
  // `jets`: the variables (ξ, ξ', …, z, …), the first n of them ξ; `parameters`: x₀, basis, t.
  static Functions trace(const Graph& graph, const ExprVector& F, const ExprVector& jets, Index n,
                         Index d, const std::vector<Function::Input>& parameters, Backend backend);

  MovingConormals(Functions functions, Index n, Index d);

  // Where the inputs of Functions::constraints are.
  struct Point {
    const double *jets, *origin, *basis, *t;
  };
  // The last C is that of the last keep(), so that this can be repeated while a point is sought.
  void move_to(const Point& point);
  void keep();
  void discard();  // back to what keep() left
  void forget();
  // Goes on from where the other one was at its last keep().
  void take_over(const MovingConormals& other);
  // As of Predictor.
  void learn_from(const MovingConormals& other, double times) {
    predictor_.learn_from(other.predictor_, VectorXd::Constant(weights_.size(), times));
  }
  const MatrixXd& matrix() const { return conormals_; }

 private:
  // The equations, and of the unknowns besides ξ those, that decide which combinations contain dξ
  // alone, where F and its Jacobian's entries are `all`.
  struct Core {
    std::vector<Index> rows, columns;
  };
  Core core(const VectorXd& all) const;
  bool continue_to(const Point& point);
  void find(const Point& point);

  Functions functions_;
  Index n_, d_;
  Newton newton_;
  Predictor predictor_;
  bool is_found_ = false, is_continued_ = false, is_moving_ = false;
  MatrixXd conormals_, kept_;
  MatrixXd units_;    // e_1, …, e_d
  VectorXd weights_;  // w_1, …, w_d
  MatrixXd covectors_;
  NearestOrthonormal make_orthonormal_;
};

}  // namespace courant
