#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/linear/jacobi_rotations.hpp"

extern "C" {
// LAPACK: divide and conquer; QR iteration, slower, which converges where the former does not.
// NOLINTBEGIN(readability-identifier-naming): Fortran's names
void dgesdd_(const char* job, const int* m, const int* n, double* a, const int* lda, double* s,
             double* u, const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork,
             int* iwork, int* info);
void dgesvd_(const char* jobu, const char* jobvt, const int* m, const int* n, double* a,
             const int* lda, double* s, double* u, const int* ldu, double* vt, const int* ldvt,
             double* work, const int* lwork, int* info);
// NOLINTEND(readability-identifier-naming)
}

namespace courant {
namespace {

// Smaller matrices are decomposed by rotations, so that a run has the same bytes with any BLAS: kernels of
// OpenBLAS round differently, and a frame or a start would come out in other bits. LAPACK is twice as fast
// at this size.
constexpr Eigen::Index kLeast = 64;

bool is_small(const Eigen::Ref<const MatrixXd>& A) {
  return std::min(A.rows(), A.cols()) <= kLeast;
}

// job 'A': all of U and Vᵀ; 'N': neither. Returns [U, Vᵀ] in U and V.
SingularValueDecomposition decompose(const Eigen::Ref<const MatrixXd>& A, char job) {
  const auto m = static_cast<int>(A.rows()), n = static_cast<int>(A.cols());
  const int least = std::min(m, n);
  SingularValueDecomposition svd{VectorXd(least), MatrixXd(), MatrixXd()};
  if (job == 'A') {
    svd.U.setIdentity(m, m);
    svd.V.setIdentity(n, n);
  }
  if (least == 0) return svd;

  if (!A.allFinite())
    throw std::domain_error(
        "singular_value_decomposition: the matrix has entries that are not finite; expected finite "
        "numbers.");
  const int ld_U = job == 'A' ? m : 1, ld_V = job == 'A' ? n : 1;
  std::vector<int> integers(static_cast<std::size_t>(8 * least));
  int info = 0;
  const auto run = [&](auto call) {
    MatrixXd destroyed = A;
    double best_size = 0.0;
    int size = -1;  // asks for the best size
    call(destroyed.data(), &best_size, &size);
    size = static_cast<int>(best_size);
    std::vector<double> work(static_cast<std::size_t>(size));
    call(destroyed.data(), work.data(), &size);
  };
  run([&](double* a, double* work, const int* size) {
    dgesdd_(&job, &m, &n, a, &m, svd.values.data(), svd.U.data(), &ld_U, svd.V.data(), &ld_V, work,
            size, integers.data(), &info);
  });
  if (info > 0) {
    run([&](double* a, double* work, const int* size) {
      dgesvd_(&job, &job, &m, &n, a, &m, svd.values.data(), svd.U.data(), &ld_U, svd.V.data(),
              &ld_V, work, size, &info);
    });
  }
  if (info != 0) {
    throw std::runtime_error("singular_value_decomposition: LAPACK failed on a " +
                             std::to_string(m) + " × " + std::to_string(n) + " matrix, info " +
                             std::to_string(info) + ".");
  }
  svd.V.transposeInPlace();
  return svd;
}

}  // namespace

SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A) {
  return is_small(A) ? by_rotations(A, true) : decompose(A, 'A');
}

VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A) {
  return (is_small(A) ? by_rotations(A, false) : decompose(A, 'N')).values;
}

}  // namespace courant
