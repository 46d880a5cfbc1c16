// Equations J y + value = 0 with errors, for the tests of searches for their zeros.
#pragma once

#include <initializer_list>
#include <limits>

#include "courant/integrators/certificate/least_zero.hpp"

namespace courant {

inline constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();

inline Linearization linear(const MatrixXd& J, const VectorXd& value, const VectorXd& value_error) {
  Linearization at;
  at.value = value;
  at.value_error = value_error;
  at.jacobian = J.sparseView();
  at.error = SparseMatrixXd(J.rows(), J.cols());
  return at;
}

inline VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

}  // namespace courant
