#include <boost/test/unit_test.hpp>

#include "courant/integrators/ladder/constraint_algorithm.hpp"
#include "random_circuits.hpp"

namespace courant::test {

// (n, n - loops - cut-sets), and where there are any (n - …, n - …) after it: whatever the units.
void check_ladder_of(const RandomCircuit& circuit) {
  const Index n = circuit.states, dependent = circuit.capacitor_loops + circuit.inductor_cut_sets;
  BOOST_TEST_CONTEXT(circuit.description) {
    BOOST_TEST(circuit.network->charge_loop_count() == circuit.capacitor_loops);
    BOOST_TEST(circuit.network->flux_cut_set_count() == circuit.inductor_cut_sets);
    const ConstraintLadder ladder =
        ConstraintAlgorithm().run(circuit.network, {.x = VectorXd::Zero(n)});
    BOOST_TEST(to_string(ladder.verdict) == "regular");
    BOOST_TEST(!ladder.is_ambiguous());
    BOOST_TEST(ladder.index == (dependent > 0 ? 1 : 0));
    BOOST_TEST(ladder.degrees_of_freedom == n - dependent);
    BOOST_TEST(ladder.levels[0].dim_S == n);
    BOOST_TEST(ladder.levels[0].dim_M == n - dependent);
  }
}

BOOST_AUTO_TEST_SUITE(network_ladders)

BOOST_AUTO_TEST_CASE(of_random_circuits_are_their_topological_counts) {
  std::mt19937 generator(7);
  int with_loops = 0, with_cut_sets = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RandomCircuit circuit = random_circuit(generator, 30);
    check_ladder_of(circuit);
    with_loops += circuit.capacitor_loops > 0;
    with_cut_sets += circuit.inductor_cut_sets > 0;
  }
  BOOST_TEST(with_loops > 50);
  BOOST_TEST(with_cut_sets > 50);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
