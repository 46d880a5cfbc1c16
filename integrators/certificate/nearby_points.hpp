// Points around one at which constraints hold: they tell what is zero by the constraints.
#pragma once

#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A few random points near one at which functions φ of `variables` vanish, by Newton's method. An analytic function that
// is 0 at all of them is 0 wherever the φ are, near the point: y p_z - z p_y is, by x p_y = y p_x and x p_z = z p_x, though
// it is no sum of multiples of the two.
class NearbyPoints {
 public:
  // The last of the variables, `fixed` of them, have a value of their own at each point that Newton's method does not
  // change; so has time. `parameters`, of which the functions may be made too, keep their values.
  NearbyPoints(const ExprVector& variables, const VectorXd& point, Index fixed,
               const ExprVector& parameters, const VectorXd& of_parameters,
               const std::vector<Expr>& constraints);

  // Whether f is 0 at all points, next to how fast it changes there; false where Newton's method found none.
  bool vanishes(const Expr& f) const;

 private:
  VectorXd values(const ExprVector& functions, const VectorXd& at) const;

  ExprVector variables_;          // with the parameters
  std::vector<VectorXd> points_;  // of these
  Index moving_,
      changing_;  // how many of the variables Newton's method moves, and how many are no parameters
};

}  // namespace courant
