// Kirchhoff: the Dirac structure of the currents and voltages of a circuit graph.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "courant/structures/circuit_graph.hpp"
#include "courant/structures/dirac_representations.hpp"
#include "courant/structures/linear_dirac.hpp"

namespace courant {

using SparseMatrixXd = Eigen::SparseMatrix<double>;

// The currents i ∈ V = R^m and voltages v ∈ V* of the m elements of a graph with N nodes and c
// components that obey Kirchhoff's laws, A the incidence matrix (+1 at the source of an element, -1
// at its target):
//
//   D = {(i, v) : A i = 0, v = Aᵀφ for some potentials φ} = F ⊕ F°
//
// with F = ker A the space of cycles.
//
// Here the flow is the current, the effort the voltage. That D is Dirac is Tellegen's theorem.
// A spanning forest (N - c elements: the tree) splits the elements; each other element, a link,
// closes one fundamental loop through the forest, and each element of the forest is cut by one
// fundamental cut-set.
//
// Sizes: A has two entries an element, loops and cut-sets as many as the loops are long. Nothing is
// dense: for 10⁵ elements in a grid all is done in less than a second. Immutable.
class Kirchhoff {
 public:
  // The forest is a minimum spanning forest by the weights of the elements. Among equal weights it
  // takes a fixed pseudo-random choice: in order of numbers, the loops of a grid of k × k nodes
  // would have about k elements, so they have a few tens.
  explicit Kirchhoff(const CircuitGraph& graph);

  Index node_count() const { return node_count_; }                             // N
  Index element_count() const { return static_cast<Index>(source_.size()); }   // E
  Index component_count() const { return static_cast<Index>(roots_.size()); }  // c
  const std::vector<Index>& tree() const { return tree_; }    // elements of the forest, increasing
  const std::vector<Index>& links() const { return links_; }  // all others, increasing

  SparseMatrixXd incidence() const;  // A, N × E
  SparseMatrixXd reduced_incidence()
      const;                     // one node of each component left out: (N - c) × E, of full rank
  SparseMatrixXd loops() const;  // fundamental loops, +1 at the link: one a column, E × (E - N + c)
  SparseMatrixXd cut_sets()
      const;  // fundamental cut-sets, +1 at the element of the forest: E × (N - c)
  // The potentials of the nodes from the voltages, along the forest: N × E. That of the first node
  // of each component is 0.
  SparseMatrixXd potentials() const;

  // D as A_r i = 0, Bᵀv = 0; as i = B j, v = A_rᵀφ, loop currents j and potentials φ; as i = B j,
  // Bᵀv = 0; and with the voltages of the tree and the currents of the links as inputs. A_r the
  // reduced incidence, B the loops.
  KernelRepresentation<SparseMatrixXd> kernel_representation() const;
  ImageRepresentation<SparseMatrixXd> image_representation() const;
  ConstrainedRepresentation<SparseMatrixXd> constrained_representation() const;
  HybridRepresentation<SparseMatrixXd> hybrid_representation() const;

  // For a few hundred elements at most.
  LinearDirac to_linear_dirac() const;

 private:
  Index node_count_;
  std::vector<Index> source_, target_;  // of each element
  std::vector<Index> tree_, links_;
  std::vector<Index> roots_;           // one node of each component
  std::vector<Index> parent_, depth_;  // of each node in the forest; a root is its own parent
  std::vector<Index> parent_element_;  // the element that leads to the parent
};

}  // namespace courant
