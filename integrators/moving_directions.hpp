// The directions of a projector along a trajectory.
#pragma once

#include "courant/core/lu_decomposition.hpp"
#include "courant/integrators/nearest_orthonormal.hpp"
#include "courant/integrators/projector.hpp"

namespace courant {

// An orthonormal basis W (n × d) of the directions of a projector that turns little while x moves:
// with V(x) what the projector gives and W = V K at the last point, the orthonormal basis nearest to
// V K at the next. Where that is far from orthonormal, and at the first point, W is that of
// Projector::directions(). One object a trajectory.
class MovingDirections {
 public:
  // `projector` outlives this object. d = 0 is allowed.
  MovingDirections(const Projector& projector, Index n, Index d);

  // W at x, near that of the last keep(), so that this can be repeated while a point is sought.
  // Arguments and errors as of Projector::directions().
  void move_to(const VectorXd& x, const LinearMap<double>& basis, const MatrixXd& conormals);
  void keep();
  void discard();  // back to what keep() left
  void forget();
  // Goes on from where the other one was at its last keep().
  void take_over(const MovingDirections& other);

  const MatrixXd& matrix() const { return W_; }
  bool is_kept() const { return is_kept_; }
  const MatrixXd& kept() const { return kept_; }  // the W of keep()

 private:
  bool continues(const MatrixXd& conormals);
  void project_kept();
  bool is_complement(const MatrixXd& conormals) const;

  const Projector& projector_;
  bool is_kept_ = false, is_continued_ = false;
  MatrixXd W_, kept_;
  MatrixXd V_, combination_;  // K
  MatrixXd turned_;           // V K, nearly orthonormal
  MatrixXd next_;
  LuDecomposition gram_;  // of VᵀV
  NearestOrthonormal make_orthonormal_;
};

}  // namespace courant
