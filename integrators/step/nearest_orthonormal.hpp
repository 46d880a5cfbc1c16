// Orthonormal matrices near given ones.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// B = P (PᵀP)^{-1/2}, the nearest of the matrices with BᵀB = 1 (rows × columns, rows ≥ columns), to round-off. With E =
// 1 - PᵀP,
//
//   P ← P (1 + E/2 + 3/8 E²)   leaves   5/8 E³ + …
//
// of it, so that what is nearly orthonormal is so after one or two of these steps: bases that are carried along a
// trajectory, at each of its steps. Loops of known length for up to 8 columns; for more the first use allocates.
// Programs in C repeat them, to the last bit. Holds workspace; not shared between threads.
class NearestOrthonormal {
 public:
  explicit NearestOrthonormal(Index columns);

  // B has the size of P, and is another matrix. False, and B as it was, if ‖E‖ ≥ 1/2 or P is not
  // finite.
  bool operator()(const MatrixXd& P, MatrixXd& B) { return find_(P, B, 0, workspace_); }

  // The same for P far from orthonormal, by steps from ‖P‖ = 1 on. False, and B of no use, if that does not end, as
  // where a singular value is below 1e-4 of ‖P‖.
  bool from_afar(MatrixXd P, MatrixXd& B);

 private:
  struct Workspace {
    MatrixXd E, square, root, last;
  };
  template <int n>
  static bool find(const MatrixXd& P, MatrixXd& B, int most_from_afar, Workspace& workspace);

  bool (*find_)(const MatrixXd& P, MatrixXd& B, int most_from_afar, Workspace& workspace);
  Workspace workspace_;
};

}  // namespace courant
