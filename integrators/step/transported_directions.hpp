// The directions of a projector along a trajectory.
#pragma once

#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/integrators/step/nearest_orthonormal.hpp"
#include "courant/integrators/step/projector.hpp"

namespace courant {

// An orthonormal basis W (n × d) of the directions of a projector that turns little while x moves:
// with V(x) what the projector spans and W = V K at the last point, the orthonormal basis nearest to
// V K at the next. The first W is the one nearest to the conormals. Where such a basis is far from V K, W is that of
// Projector::directions(). Programs in C find the same, to the last bit. One object a trajectory.
class TransportedDirections {
 public:
  // `projector` outlives this object; `span`: its span_formulas(), traced once for all trajectories. d = 0 is
  // allowed.
  TransportedDirections(const Projector& projector, Function span, Index n, Index d);

  // W at x and t, near that of the last keep(), so that this can be repeated while a point is sought.
  // Arguments and errors as of Projector::directions().
  void move_to(const VectorXd& x, double t, const LinearMap<double>& basis,
               const MatrixXd& conormals);
  void keep();
  void discard();  // back to what keep() left
  void forget();
  // Goes on from where the other one was at its last keep().
  void take_over(const TransportedDirections& other);

  const MatrixXd& matrix() const { return W_; }
  bool is_kept() const { return is_kept_; }
  // Whether the last move_to() needed no Projector::directions().
  bool is_continued() const { return is_continued_; }
  const MatrixXd& kept() const { return kept_; }  // the W of keep()

 private:
  bool continues(const MatrixXd& conormals);
  bool is_nearest_to(const MatrixXd& matrix);
  void project(const MatrixXd& matrix);
  bool is_complement(const MatrixXd& conormals);

  const Projector& projector_;
  Function span_;
  bool is_kept_ = false, is_continued_ = false;
  MatrixXd W_, kept_;
  MatrixXd V_, combination_;  // K
  MatrixXd turned_;           // V K, nearly orthonormal
  MatrixXd before_, next_;
  LuDecomposition factors_;  // of VᵀV, and of CᵀW
  NearestOrthonormal make_orthonormal_;
};

}  // namespace courant
