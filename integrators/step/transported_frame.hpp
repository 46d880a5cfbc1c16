// The frame of a chart, transported along a trajectory.
#pragma once

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/step/nearest_orthonormal.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// An orthonormal frame B of T_xM (Ñ × n) that turns as little as possible while x moves: the last
// one projected to the new tangent space, made orthonormal by its polar factor. What was factorised
// or extrapolated in it stays good, which a basis made afresh at every point would spoil. Programs in C
// find the same, to the last bit.
//
// Nothing is computed or stored where n = Ñ: B is the identity. Nothing is allocated by move_to, but for
// points far apart. One object a trajectory.
class TransportedFrame {
 public:
  // (x, B) ↦ Π(x) B, column by column; nothing where B is the identity. To be traced once for all trajectories.
  static Function::Formulas formulas(const Manifold& manifold);
  static Function projection(const Manifold& manifold, Backend backend);
  // The one that a trajectory begins with at x.
  static LinearMap<double> at(const Manifold& manifold, const VectorXd& x);

  TransportedFrame(const Manifold& manifold, Function projection);

  // Whether B went on from the last one; at the first point, and where the new tangent space is at
  // right angles to the old one, it is made afresh, and coordinates in it have nothing to do with
  // those before.
  bool move_to(const VectorXd& x);
  void keep() { kept_ = basis_; }
  void discard() { basis_ = kept_; }  // back to what keep() left
  void forget() { is_set_ = false; }
  // Goes on from where the other one is, of the same manifold: whether its coordinates are those that
  // this had, moved along without being made afresh in between.
  bool take_over(const TransportedFrame& other);
  const LinearMap<double>& map() const { return basis_; }
  // Bᵀv, the coordinates of a tangent vector: `coordinates` = n numbers, `v` = Ñ.
  void coordinates_of(const VectorXd& v, Eigen::Ref<VectorXd> coordinates) const;
  // As an argument of the functions that take basis_parameters.
  const double* data() const { return basis_.entries().data(); }

 private:
  void make_afresh(const VectorXd& x);

  Function projection_;
  LinearMap<double> basis_, kept_;
  MatrixXd projected_;
  bool is_set_ = false;
  long times_made_ = 0;  // afresh, by this one or those that it took over from
  NearestOrthonormal make_orthonormal_;
};

}  // namespace courant
