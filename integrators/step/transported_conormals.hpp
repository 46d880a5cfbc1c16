// The conormals of M_f along a trajectory.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/linear_solver.hpp"
#include "courant/integrators/step/nearest_orthonormal.hpp"

namespace courant {

// An orthonormal basis N (n × d) of the annihilator of T_xM_f that turns as little as possible
// while x moves. Where S_f is F(ξ, ξ', …, z, …) = 0 in the chart at x, the conormals are the
// combinations of dF that contain dξ alone:
//
//   c = (∂F/∂ξ)ᵀ w,   (∂F/∂(ξ', …, z, …))ᵀ w = 0
//
// Those at the next point are the solutions with Nᵀ c = e_1, …, e_d for the last N. These are linear equations in w;
// where one gives an entry of w explicitly, with a coefficient that is a number, both are taken out, which leaves
//
//   A u_j = (0, e_j),   c_j = P u_j,   j = 1, …, d
//
// with matrices of the point, and the c_j are made orthonormal. The first N is near a reference, covectors at
// another point, or near any others where that one is at right angles. Where that fails too they are found by QR
// decomposition. Programs in C find the same, to the last bit, where A is small and regular. One object a trajectory;
// nothing is allocated by steps there.
class TransportedConormals {
 public:
  struct Formulas {
    // (ξ, ξ', …, z, …); x₀, basis, t  ↦  F.
    Function::Formulas constraints;
    // (ξ, …), x₀, basis, t, C  ↦  the entries of A and P.
    Function::Formulas matrices;
    MatrixPattern A, P;
    VectorXd sizes;  // s, empty for 1
  };
  // Traced once for all trajectories, the constraints with their Jacobian.
  struct Functions {
    Functions() = default;
    Functions(const Formulas& of, Backend backend);
    Function constraints, matrices;
    MatrixPattern A, P;
    VectorXd sizes;
  };
  // `jets`: the variables (ξ, ξ', …, z, …), the first n of them ξ; `parameters`: x₀, basis, t. `sizes`: s, all that is
  // said here of conormals holds for c / s then, as of Projector::conormal_sizes; empty for 1.
  static Formulas trace(const Graph& graph, const ExprVector& F, const ExprVector& jets, Index n,
                        Index d, const std::vector<Function::Input>& parameters,
                        const VectorXd& sizes = {});

  // `references`: of d covectors (Ñ × d) each, orthonormal; or none.
  TransportedConormals(Functions functions, Index n, Index d,
                       std::vector<MatrixXd> references = {});
  // Those at a point (Ñ × d), and some others that have nothing to do with the system.
  static std::vector<MatrixXd> references(const MatrixXd& at_point);

  // Where the inputs of Functions::constraints are.
  struct Point {
    const double *jets, *origin, *basis, *t;
  };
  // The last C is that of the last keep(), so that this can be repeated while a point is sought.
  void move_to(const Point& point);
  void keep();
  void discard();  // back to what keep() left
  void forget();
  // Goes on from where the other one was at its last keep().
  void take_over(const TransportedConormals& other);
  const MatrixXd& matrix() const { return conormals_; }

 private:
  // The equations, and of the unknowns besides ξ those, that decide which combinations contain dξ
  // alone, where F and its Jacobian's entries are `all`.
  struct Core {
    std::vector<Index> rows, columns;
  };
  Core core(const VectorXd& all) const;
  bool continue_to(const Point& point, const MatrixXd& from);
  bool start_at(const Point& point);
  bool is_met() const;
  void find(const Point& point);

  Functions functions_;
  Index n_, d_;
  std::unique_ptr<LinearSolver> solver_;
  bool is_found_ = false;
  const std::vector<MatrixXd> references_;
  MatrixXd conormals_, kept_;
  VectorXd entries_;  // of the matrices, one after the other
  VectorXd given_;    // (0, e_j)
  VectorXd weights_;  // u_j
  MatrixXd covectors_;
  NearestOrthonormal make_orthonormal_;
};

}  // namespace courant
