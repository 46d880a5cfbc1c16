#include "courant/manifolds/rotation.hpp"

#include <stdexcept>

#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

ExprMatrix hat(const ExprVector& v) {
  ExprMatrix result(3, 3);
  result << 0.0, -v[2], v[1],  //
      v[2], 0.0, -v[0],        //
      -v[1], v[0], 0.0;
  return result;
}

ExprVector vee(const ExprMatrix& A) {
  ExprVector result(3);
  result << A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1);
  return Expr(0.5) * result;
}

ExprMatrix rotation_exponential(const ExprVector& v) {
  const Expr s = v.squaredNorm();
  const ExprMatrix a = hat(v);
  return ExprMatrix::Identity(3, 3) + stumpff(1, s) * a + stumpff(2, s) * (a * a);
}

ExprVector rotation_logarithm(const ExprMatrix& R) {
  const ExprVector q = quaternion(R);
  // φ = 2 arccos c, and the axis is s / sin φ/2.
  return 2.0 * arccos_factor(0, q[0]) * q.tail(3);
}

ExprMatrix rotation_cayley(const ExprVector& v) {
  const ExprMatrix a = hat(v);
  return ExprMatrix::Identity(3, 3) + (a + Expr(0.5) * (a * a)) / (1.0 + 0.25 * v.squaredNorm());
}

ExprVector rotation_inverse_cayley(const ExprMatrix& R) {
  const ExprVector q = quaternion(R);
  return (2.0 / q[0]) * q.tail(3);
}

ExprVector quaternion(const ExprMatrix& R) {
  ExprMatrix Q(4, 4);  // 4 q qᵀ
  Q << 1.0 + R(0, 0) + R(1, 1) + R(2, 2), R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1),
      R(2, 1) - R(1, 2), 1.0 + R(0, 0) - R(1, 1) - R(2, 2), R(0, 1) + R(1, 0), R(0, 2) + R(2, 0),
      R(0, 2) - R(2, 0), R(0, 1) + R(1, 0), 1.0 - R(0, 0) + R(1, 1) - R(2, 2), R(1, 2) + R(2, 1),
      R(1, 0) - R(0, 1), R(0, 2) + R(2, 0), R(1, 2) + R(2, 1), 1.0 - R(0, 0) - R(1, 1) + R(2, 2);
  ExprVector column = Q.col(0);
  Expr largest = Q(0, 0);
  for (Index j = 1; j < 4; ++j) {
    const Expr larger = Q(j, j) > largest;
    for (Index i = 0; i < 4; ++i) column[i] = select(larger, Q(i, j), column[i]);
    largest = select(larger, Q(j, j), largest);
  }
  return select(column[0] < 0.0, -0.5, 0.5) / sqrt(largest) * column;
}

ExprMatrix rotation_of(const ExprVector& quaternion) {
  const ExprMatrix a = hat(quaternion.tail(3));
  return ExprMatrix::Identity(3, 3) + 2.0 * quaternion[0] * a + Expr(2.0) * (a * a);
}

MatrixXd nearest_rotation(const MatrixXd& A) {
  const double determinant = LuDecomposition(A).determinant();
  if (!(determinant > 0.0))
    throw std::domain_error("nearest_rotation: A has determinant " + number_text(determinant) +
                            "; expected one above 0, as near a rotation.");
  const auto [values, U, V] = singular_value_decomposition(A);
  return U * V.transpose();
}

}  // namespace courant
