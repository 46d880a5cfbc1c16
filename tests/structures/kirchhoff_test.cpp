#include "courant/structures/kirchhoff.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/sparse_rank_decision.hpp"
#include "courant/structures/dirac_interconnection.hpp"
#include "courant/structures/kirchhoff_laws.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * loops of the forest against their orientation
//  * K3 never fails (structures/kirchhoff_laws.cpp)
BOOST_AUTO_TEST_SUITE(kirchhoff_test)

namespace {

// Any graph: components, isolated nodes, self-loops and parallel elements come out.
CircuitGraph random_graph(std::mt19937& generator) {
  const std::size_t nodes = generator() % 8;
  CircuitGraph graph(nodes);
  const std::size_t elements = nodes == 0 ? 0 : generator() % 11;
  for (std::size_t k = 0; k < elements; ++k) {
    add_edge(generator() % nodes, generator() % nodes, graph);
  }
  return graph;
}

CircuitGraph grid(std::size_t rows, std::size_t columns) {
  CircuitGraph graph(rows * columns);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (i + 1 < rows) add_edge(i * columns + j, (i + 1) * columns + j, graph);
      if (j + 1 < columns) add_edge(i * columns + j, i * columns + j + 1, graph);
    }
  }
  return graph;
}

// F ⊕ F° with F = ker A, A made from the graph without Kirchhoff's help.
LinearDirac dense_structure(const CircuitGraph& graph) {
  MatrixXd A = MatrixXd::Zero(static_cast<Index>(graph.node_count), std::ssize(graph.edges));
  Index column = 0;
  for (const auto& [source, target, element] : graph.edges) {
    A(static_cast<Index>(source), column) += 1.0;
    A(static_cast<Index>(target), column++) -= 1.0;
  }
  return LinearDirac::annihilator_sum(kernel(A));
}

bool all_exact(const std::vector<LawResult>& results) {
  for (const LawResult& result : results) {
    if (result.bound != 0.0) return false;
  }
  return all_passed(results);
}

}  // namespace

BOOST_AUTO_TEST_CASE(all_representations_of_random_graphs) {
  std::mt19937 generator(1);
  int disconnected = 0, with_self_loops = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const CircuitGraph graph = random_graph(generator);
    const Kirchhoff structure(graph);
    const Index n = structure.element_count();
    const Index nodes = structure.node_count() - structure.component_count();
    BOOST_TEST(static_cast<Index>(structure.tree().size()) == nodes);
    BOOST_TEST(static_cast<Index>(structure.links().size()) == n - nodes);
    BOOST_TEST(decide_rank(structure.incidence()).rank == nodes);
    BOOST_TEST(decide_rank(structure.reduced_incidence()).rank == nodes);
    BOOST_TEST(structure.reduced_incidence().rows() == nodes);
    // Dense: Eigen refuses the norm of a sparse matrix that has no entries at all.
    BOOST_TEST(MatrixXd(structure.incidence() * structure.loops()).norm() == 0.0);
    BOOST_TEST(MatrixXd(structure.cut_sets().transpose() * structure.loops()).norm() == 0.0);
    BOOST_TEST(decide_rank(structure.cut_sets()).rank == nodes);
    BOOST_TEST(all_exact(check_kirchhoff(structure)));
    disconnected += structure.component_count() > 1;
    with_self_loops +=
        (structure.incidence().toDense().colwise().squaredNorm().array() == 0.0).any();

    const LinearDirac expected = dense_structure(graph);
    BOOST_TEST(distance(structure.to_linear_dirac(), expected) < 1e-12);
    const auto kernel = structure.kernel_representation();
    BOOST_TEST(distance(LinearDirac(KernelRepresentation<MatrixXd>{kernel.F, kernel.E}), expected) <
               1e-12);
    const auto image = structure.image_representation();
    BOOST_TEST(distance(LinearDirac(ImageRepresentation<MatrixXd>{image.F, image.E}), expected) <
               1e-12);
    const auto constrained = structure.constrained_representation();
    BOOST_TEST(
        distance(LinearDirac(ConstrainedRepresentation<MatrixXd>{constrained.J, constrained.G}),
                 expected) < 1e-12);
    const auto hybrid = structure.hybrid_representation();
    BOOST_TEST(distance(LinearDirac(HybridRepresentation<MatrixXd>{hybrid.effort_driven,
                                                                   hybrid.flow_driven, hybrid.M}),
                        expected) < 1e-12);
  }
  BOOST_TEST(disconnected > 50);
  BOOST_TEST(with_self_loops > 50);
}

// Two nodes, elements 0, 1: a → b, 2: b → a, and 3 from b to itself; a node c alone.
BOOST_AUTO_TEST_CASE(currents_and_voltages_of_a_small_circuit) {
  CircuitGraph graph(3);
  add_edge(0, 1, CircuitElement{"C", -1.0}, graph);
  add_edge(0, 1, CircuitElement{"R", 0.0}, graph);
  add_edge(1, 0, CircuitElement{"L", 1.0}, graph);
  add_edge(1, 1, CircuitElement{"short", 0.0}, graph);
  const Kirchhoff structure(graph);
  BOOST_TEST(structure.component_count() == 2);
  BOOST_TEST(structure.tree() == (std::vector<Index>{0}));  // of least weight
  BOOST_TEST(structure.links() == (std::vector<Index>{1, 2, 3}));
  const LinearDirac D = structure.to_linear_dirac();
  // 5 A through C, 2 A through R, so 7 A through L; 3 V on C and R, -3 V on L, none on the short
  // circuit.
  BOOST_TEST(D.distance(VectorXd{{5, 2, 7, 11}}, VectorXd{{3, 3, -3, 0}}) < 1e-14);
  BOOST_TEST(D.distance(VectorXd{{5, 2, -7, 11}}, VectorXd{{3, 3, -3, 0}}) > 1.0);
  BOOST_TEST(D.distance(VectorXd{{5, 2, 7, 11}}, VectorXd{{3, 3, -3, 1}}) > 0.5);
  const MatrixXd loops = structure.loops();
  BOOST_TEST((loops - MatrixXd{{-1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).norm() == 0.0);
  const MatrixXd cut_sets = structure.cut_sets();
  BOOST_TEST((cut_sets - MatrixXd{{1}, {1}, {-1}, {0}}).norm() == 0.0);
}

// A chain of 11000 elements with one from each node to the first: loops of more than 6·10⁷ elements in all.
BOOST_AUTO_TEST_CASE(loops_that_would_take_all_memory_are_refused) {
  constexpr std::size_t nodes = 11001;
  CircuitGraph graph(nodes);
  for (std::size_t k = 1; k < nodes; ++k) {
    add_edge(k - 1, k, CircuitElement{"", 0.0}, graph);
    add_edge(k, 0, CircuitElement{"", 1.0}, graph);
  }
  const Kirchhoff structure(graph);
  for (const auto& ask : {+[](const Kirchhoff& K) { return K.loops(); },
                          +[](const Kirchhoff& K) { return K.cut_sets(); },
                          +[](const Kirchhoff& K) { return K.potentials(); }})
    BOOST_CHECK_EXCEPTION(ask(structure), std::length_error, [](const std::length_error& error) {
      return std::string(error.what()).find("more than 60000000 elements") != std::string::npos;
    });
}

BOOST_AUTO_TEST_CASE(the_tree_takes_small_weights_first) {
  // A triangle with the weights in every order: the heaviest element is the link.
  for (int heaviest = 0; heaviest < 3; ++heaviest) {
    CircuitGraph graph(3);
    for (int k = 0; k < 3; ++k) {
      add_edge(static_cast<std::size_t>(k), static_cast<std::size_t>((k + 1) % 3),
               CircuitElement{"", k == heaviest ? 1.0 : 0.0}, graph);
    }
    BOOST_TEST(Kirchhoff(graph).links() == (std::vector<Index>{heaviest}));
  }
}

BOOST_AUTO_TEST_CASE(empty_graphs) {
  for (const std::size_t nodes : {0U, 1U, 5U}) {
    const Kirchhoff structure{CircuitGraph(nodes)};
    BOOST_TEST(structure.component_count() == static_cast<Index>(nodes));
    BOOST_TEST(structure.to_linear_dirac().dimension() == 0);
    BOOST_TEST(all_exact(check_kirchhoff(structure)));
  }
}

// Joining two graphs element by element is composition of their Dirac structures: two triangles
// that share an element, which is then inside, are a square.
BOOST_AUTO_TEST_CASE(composition_removes_a_shared_element) {
  CircuitGraph first(3), second(3), square(4);
  add_edge(0, 1, first);
  add_edge(1, 2, first);
  add_edge(2, 0, first);  // the shared one
  add_edge(2, 0,
           second);  // the same nodes: its current is the other's reversed, its voltage the same
  add_edge(2, 1, second);
  add_edge(1, 0, second);
  add_edge(0, 1, square);
  add_edge(1, 2, square);
  add_edge(2, 3, square);
  add_edge(3, 0, square);
  const LinearDirac joint = composition(Kirchhoff(first).to_linear_dirac(), std::vector<Index>{2},
                                        Kirchhoff(second).to_linear_dirac(), std::vector<Index>{0});
  BOOST_TEST(distance(joint, Kirchhoff(square).to_linear_dirac()) < 1e-12);
}

// Of about 6·10⁴ elements: exact products, combinatorial rank.
BOOST_AUTO_TEST_CASE(a_large_grid) {
  const Kirchhoff structure(grid(170, 180));
  BOOST_TEST(structure.component_count() == 1);
  BOOST_TEST(static_cast<Index>(structure.tree().size()) == 170 * 180 - 1);
  BOOST_TEST(static_cast<Index>(structure.links().size()) == 169 * 179);  // one a mesh
  BOOST_TEST(all_exact(check_kirchhoff(structure)));
  // The fixed pseudo-random choice keeps loops short.
  BOOST_TEST(structure.loops().nonZeros() < 100 * 169 * 179);
}

BOOST_AUTO_TEST_CASE(the_laws_reject_what_is_wrong) {
  const Kirchhoff structure(grid(3, 4));
  const auto kernel = structure.kernel_representation();
  const auto hybrid = structure.hybrid_representation();
  const auto failed = [&](const KernelRepresentation<SparseMatrixXd>& wrong_kernel,
                          const HybridRepresentation<SparseMatrixXd>& wrong_hybrid) {
    std::vector<bool> result;
    for (const LawResult& law : check_sparse_dirac("planted", wrong_kernel, wrong_hybrid)) {
      result.push_back(!law.passed());
    }
    return result;
  };
  BOOST_TEST((failed(kernel, hybrid) == std::vector<bool>{false, false, false, false}));

  // A loop that turns round at one element.
  auto wrong_kernel = kernel;
  wrong_kernel.E.coeffRef(kernel.E.rows() - 1, structure.tree()[0]) += 1.0;
  BOOST_TEST(failed(wrong_kernel, hybrid)[0]);

  // An equation twice.
  wrong_kernel = kernel;
  wrong_kernel.F = SparseMatrixXd(kernel.F.rows(), kernel.F.cols());
  for (Index j = 0; j < kernel.F.cols(); ++j) {
    for (SparseMatrixXd::InnerIterator it(kernel.F, j); it; ++it) {
      if (it.row() == 0) continue;
      wrong_kernel.F.coeffRef(it.row(), j) = it.value();
      if (it.row() == 1) wrong_kernel.F.coeffRef(0, j) = it.value();
    }
  }
  BOOST_TEST(failed(wrong_kernel, hybrid)[1]);

  // A sign in M, and M that is skew but of another structure.
  auto wrong_hybrid = hybrid;
  wrong_hybrid.M = hybrid.M.cwiseAbs();
  BOOST_TEST(failed(kernel, wrong_hybrid)[2]);
  wrong_hybrid.M = -hybrid.M;
  BOOST_TEST((failed(kernel, wrong_hybrid) == std::vector<bool>{false, false, false, true}));

  // A "tree" that is not one: its elements close a loop.
  wrong_hybrid = hybrid;
  const Index link = structure.links()[0];
  Index outside = 0;
  while (structure.loops().coeff(structure.tree()[static_cast<std::size_t>(outside)], 0) != 0.0)
    ++outside;
  wrong_hybrid.effort_driven[static_cast<std::size_t>(outside)] = link;
  wrong_hybrid.flow_driven[0] = structure.tree()[static_cast<std::size_t>(outside)];
  BOOST_TEST(failed(kernel, wrong_hybrid)[1]);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
