// An orthonormal basis of the range of a projector.
#pragma once

#include <Eigen/Core>

namespace courant {

// Orthonormal columns (m × n) that span the range of a projector Π (m × m, Π² = Π, of rank n): its columns by Gram and
// Schmidt, each the longest of what the earlier ones leave. That is at least as long as the square root of (n - k)/m
// for an orthogonal projector, so nothing cancels. Zeros that are round-off become zeros: what is computed in the basis
// would see dependences that are not there. Programs in C repeat the loops, to the last bit.
Eigen::MatrixXd range_basis(Eigen::MatrixXd projector, Eigen::Index n);

}  // namespace courant
