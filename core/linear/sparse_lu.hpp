// L U = P S Q of sparse square matrices of one pattern. Not installed API: SparseSolver is.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace courant {

// The ordering Q is made once, for the pattern; the pivots that P chose are kept as long as they are not
// small. Holds workspace: not shared between threads.
//
// Written twice: by KLU, which is made for circuits, and LGPL; and by Eigen's SparseLU, which is slower
// for them and MPL. The option COURANT_WITH_SUITESPARSE chooses, and the tests are the same.
class SparseLu {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  // S is compressed; its entries do not matter. Throws std::runtime_error if no ordering is found.
  explicit SparseLu(const Matrix& S);
  ~SparseLu();

  // For S (n × n) of the pattern. False: a pivot is zero, and there are no factors.
  bool factorize(const Matrix& S);
  // The next factors are those of a new object: pivots that earlier factors kept are sought anew.
  void forget();

  // After factorize() has succeeded:
  double pivot_ratio() const;   // min |u_ii| / max |u_ii|; 1 for n = 0
  int orientation() const;      // the sign of det S
  void solve(double* b) const;  // b ← S⁻¹ b, b: n numbers

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace courant
