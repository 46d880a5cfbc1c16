// Equations that steps need not solve, since they follow from the others.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;

// Rows of the Jacobian J of S_f that can be left out near a point of it, ascending: all that come from one equation of
// the system, itself and its derivatives, wherever the rest has the same rank. `source[i]`: the equation that row i
// comes from; `named`: equations that a ladder found in a dependence. Of the equations of one dependence the one goes
// that has the largest part of it, so that the others stay as far from dependent as they can. None where a rank is in
// doubt. Dense, by some singular value decompositions. Throws std::domain_error where J is not finite.
std::vector<Index> redundant_rows(const MatrixXd& J, const std::vector<Index>& source,
                                  const std::vector<Index>& named);

}  // namespace courant
