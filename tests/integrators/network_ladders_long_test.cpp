#include <boost/test/unit_test.hpp>

#include "courant/integrators/ladder/constraint_algorithm.hpp"
#include "random_circuits.hpp"

namespace courant::test {

BOOST_AUTO_TEST_SUITE(network_ladders_long)

// As network_ladders, of up to 200 nodes. Some ladders are right and not certain: the smallest
// singular values of so many equations and their derivatives come near the bounds of errors.
BOOST_AUTO_TEST_CASE(of_a_thousand_random_circuits_are_their_topological_counts) {
  std::mt19937 generator(11);
  int uncertain = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const RandomCircuit circuit = random_circuit(generator, 200);
    const Index n = circuit.states, dependent = circuit.capacitor_loops + circuit.inductor_cut_sets;
    const ConstraintLadder ladder =
        ConstraintAlgorithm().run(circuit.network, {.x = VectorXd::Zero(n)});
    BOOST_TEST_CONTEXT(circuit.description) {
      BOOST_TEST(to_string(ladder.verdict) == "regular");
      BOOST_TEST(ladder.index == (dependent > 0 ? 1 : 0));
      BOOST_TEST(ladder.degrees_of_freedom == circuit.degrees_of_freedom());
    }
    uncertain += ladder.is_ambiguous();
  }
  BOOST_TEST_MESSAGE(uncertain << " of 1000 are uncertain");
  BOOST_TEST(uncertain < 300);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
