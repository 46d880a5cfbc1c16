#include "courant/core/linear/products.hpp"

namespace courant::products {

// The operator of Eigen is called by its name here: in this namespace A * x is these functions.

Eigen::VectorXd plain(const ConstMatrixRef& A, const ConstVectorRef& x) { return A.operator*(x); }

Eigen::VectorXd transposed(const ConstMatrixRef& A, const ConstVectorRef& x) {
  return A.transpose().operator*(x);
}

Eigen::MatrixXd outer(const ConstVectorRef& x, const ConstVectorRef& y) {
  return x.operator*(y.transpose());
}

Eigen::MatrixXd of(const ConstMatrixRef& A, bool left_transposed, const ConstMatrixRef& B,
                   bool right_transposed) {
  if (!left_transposed)
    return right_transposed ? Eigen::MatrixXd(A.operator*(B.transpose()))
                            : Eigen::MatrixXd(A.operator*(B));
  return right_transposed ? Eigen::MatrixXd(A.transpose().operator*(B.transpose()))
                          : Eigen::MatrixXd(A.transpose().operator*(B));
}

}  // namespace courant::products
