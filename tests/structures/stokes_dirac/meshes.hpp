// Cell complexes for tests.
#pragma once

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "courant/structures/stokes_dirac/cell_complex.hpp"

namespace courant::test {

// Lines of a grid that are not equally far from each other.
inline VectorXd random_lines(Index cells, std::mt19937& generator) {
  std::uniform_real_distribution<double> step(0.5, 1.5);
  VectorXd lines(cells + 1);
  lines[0] = -0.3;
  for (Index i = 0; i < cells; ++i) lines[i + 1] = lines[i] + step(generator);
  return lines;
}

// An equilateral triangle with side 1, each side in `parts`; vertices inside are moved by up to `jitter` of a part.
inline CellComplex triangle(Index parts, double jitter = 0.0) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double side = 1.0 / static_cast<double>(parts), height = std::sqrt(0.75);
  const auto number = [&](Index i, Index j) { return j * (parts + 1) - j * (j - 1) / 2 + i; };
  MatrixXd vertices = MatrixXd::Zero((parts + 1) * (parts + 2) / 2, 3);
  std::vector<std::vector<Index>> simplices, bottom;
  for (Index j = 0; j <= parts; ++j)
    for (Index i = 0; i + j <= parts; ++i) {
      const bool inside = i > 0 && j > 0 && i + j < parts;
      const double x = static_cast<double>(i) + static_cast<double>(j) / 2.0,
                   y = height * static_cast<double>(j);
      vertices(number(i, j), 0) = side * (x + (inside ? shift(generator) : 0.0));
      vertices(number(i, j), 1) = side * (y + (inside ? shift(generator) : 0.0));
      if (i + j == parts) continue;
      simplices.push_back({number(i, j), number(i + 1, j), number(i, j + 1)});
      // The other way round: orientations must not depend on how a table lists vertices.
      if (i + j + 1 < parts)
        simplices.push_back({number(i + 1, j + 1), number(i, j + 1), number(i + 1, j)});
      if (j == 0) bottom.push_back({number(i, 0), number(i + 1, 0)});
    }
  return CellComplex::simplicial(vertices, simplices, {{"bottom", bottom}});
}

// Two regular tetrahedra with a face in common.
inline CellComplex two_tetrahedra() {
  MatrixXd vertices(5, 3);
  vertices << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1, 0, 0, 0;
  // The last one is the mirror image of the first in the plane of the others, x + y + z = -1.
  vertices.row(4) = vertices.row(0) - Eigen::RowVector3d::Constant(8.0 / 3.0);
  return CellComplex::simplicial(vertices, {{0, 1, 2, 3}, {4, 3, 2, 1}});
}

}  // namespace courant::test
