// Indices of Eigen, which are signed, for the containers of the standard library.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace courant {

inline std::size_t as_size(Eigen::Index index) { return static_cast<std::size_t>(index); }

}  // namespace courant
