// Orthonormal matrices near given ones.
#pragma once

#include <array>

#include "courant/core/expr.hpp"

namespace courant {

// B = P (PᵀP)^{-1/2}, the nearest of the matrices with BᵀB = 1 (rows × columns, rows ≥ columns),
// for P that are nearly orthonormal themselves: by the power series of (1 - E)^{-1/2} in E = 1 -
// PᵀP, to round-off. What bases that are carried along a trajectory need at every step: loops of
// known length for up to 8 columns, and no allocation. Programs in C repeat them, to the last bit. Holds
// workspace; not shared between threads.
class NearestOrthonormal {
 public:
  explicit NearestOrthonormal(Index columns);

  // B has the size of P, and is another matrix. False, and B as it was, if ‖E‖ ≥ 1/2 or P is not
  // finite.
  bool operator()(const MatrixXd& P, MatrixXd& B) { return find_(P, B, workspace_); }

  // The same for P far from orthonormal: first P ← P (1 + E/2) (Newton and Schulz), from ‖P‖ = 1 on, until it is near.
  // False if that does not end, as where a singular value is below 1e-4 of ‖P‖ (then B is of no use).
  bool from_afar(MatrixXd P, MatrixXd& B);

 private:
  using Workspace = std::array<MatrixXd, 4>;
  template <int n>
  static bool find(const MatrixXd& P, MatrixXd& B, Workspace& workspace);

  bool (*find_)(const MatrixXd& P, MatrixXd& B, Workspace& workspace);  // for the columns
  Workspace workspace_;
};

}  // namespace courant
