#include "courant/core/linear/uncertain_matrix.hpp"

namespace courant {

UncertainMatrix UncertainMatrix::block(Index row, Index column, Index rows, Index columns) const {
  return {value.block(row, column, rows, columns), error.block(row, column, rows, columns)};
}

}  // namespace courant
