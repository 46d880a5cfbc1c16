// CellForm: coordinates that are the integrals of a form over cells.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A number for each of some cells: the component of a form at the centre of the cell, times its size. The form is a
// scalar, or a vector whose component along the direction of the cell counts.
struct CellForm {
  bool is_vector = false;
  MatrixXd positions, directions;  // cells × 3
  VectorXd sizes;                  // of the cells, or of their duals
  Index first = 0;                 // the first of the coordinates, or of other numbers
};

}  // namespace courant
