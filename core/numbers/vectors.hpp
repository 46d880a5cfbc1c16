// Names of Eigen's that are used everywhere.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace courant
