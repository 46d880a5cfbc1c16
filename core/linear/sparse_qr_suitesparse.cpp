#include <SuiteSparseQR.hpp>
#include <stdexcept>
#include <string>

#include "courant/core/linear/sparse_qr.hpp"

namespace courant {

using LongSparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>;

SparseQr sparse_qr(const Eigen::SparseMatrix<double>& A, double tolerance) {
  struct Workspace {
    cholmod_common common;
    cholmod_sparse* R = nullptr;
    SuiteSparse_long* permutation = nullptr;
    std::size_t columns;

    explicit Workspace(std::size_t n) : columns(n) { cholmod_l_start(&common); }
    ~Workspace() {
      cholmod_l_free_sparse(&R, &common);
      cholmod_l_free(columns, sizeof(SuiteSparse_long), permutation, &common);
      cholmod_l_finish(&common);
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
  };

  LongSparseMatrix matrix = A;
  matrix.makeCompressed();
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(matrix.rows());
  view.ncol = static_cast<std::size_t>(matrix.cols());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = matrix.outerIndexPtr();
  view.i = matrix.innerIndexPtr();
  view.x = matrix.valuePtr();
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;

  Workspace workspace(view.ncol);
  const SuiteSparse_long rank =
      SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, tolerance, 0, &view, &workspace.R,
                            &workspace.permutation, &workspace.common);
  if (rank < 0 || workspace.R == nullptr) {
    throw std::runtime_error("sparse_qr: SuiteSparseQR failed on a " + std::to_string(A.rows()) +
                             " × " + std::to_string(A.cols()) + " matrix, status " +
                             std::to_string(workspace.common.status) + ".");
  }
  const auto* offsets = static_cast<const SuiteSparse_long*>(workspace.R->p);
  const Eigen::Map<const LongSparseMatrix> trapezoid(
      static_cast<Eigen::Index>(workspace.R->nrow), A.cols(), offsets[A.cols()], offsets,
      static_cast<const SuiteSparse_long*>(workspace.R->i),
      static_cast<const double*>(workspace.R->x));
  return {LongSparseMatrix(trapezoid.topLeftCorner(rank, rank)).cast<double>(),
          LongSparseMatrix(trapezoid.topRightCorner(rank, A.cols() - rank)).cast<double>(),
          workspace.common.SPQR_norm_E_fro};
}

}  // namespace courant
