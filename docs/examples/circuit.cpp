// A motor on a battery: a network of two domains from its elements, its certificate, and its motion.
//
// v = K omega and tau = K i in the motor. In the end V = R i + K omega and K i = d omega, so that
// omega = K V/(K² + R d).
#include <cmath>
#include <courant/courant.hpp>
#include <cstdio>
#include <memory>

using namespace courant;
using namespace courant::elements;

int main() {
  const double V = 24.0, R = 1.0, K = 0.1, d = 1e-3;

  // 1. Elements between nodes. 0 is the ground, of the circuit and of the shaft.
  enum Node : Index { ground, battery, winding, brush, shaft };
  NetworkAssembly drive;
  drive.add("V", voltage_source(V), {battery, ground});
  drive.add("R", resistor(R), {battery, winding});
  drive.add("L", inductor(1e-3), {winding, brush});
  drive.add("M", motor(K, domains::rotation), {brush, ground, shaft});
  drive.add("J", inertia(1e-3), {shaft});
  drive.add("d", damper(domains::rotation, constant(d)), {shaft, ground});

  // 2. The system: a coordinate for each store, here phi_L and l_J, an unknown for each other branch.
  const std::shared_ptr<const Network> system = drive.network();

  // 3. Its certificate, from rest.
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = VectorXd::Zero(2)});
  std::printf("verdict: %s, degrees of freedom: %d\n", to_string(ladder.verdict).c_str(),
              static_cast<int>(ladder.degrees_of_freedom));
  if (ladder.verdict != Verdict::regular) return 1;

  // 4. Its motion, by the midpoint rule.
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state = ladder.point;
  std::printf("%8s %12s %12s\n", "t", "current", "omega");
  for (int k = 1; k <= 4000; ++k) {
    stepper->step(state, 5e-4);
    if (k % 500 == 0)
      std::printf("%8.3f %12.6f %12.6f\n", state.t, state.x[0] / 1e-3, state.x[1] / 1e-3);
  }
  const double omega = state.x[1] / 1e-3, expected = K * V / (K * K + R * d);
  std::printf("omega is %.6f; expected %.6f\n", omega, expected);
  return std::abs(omega - expected) < 1e-6 * expected ? 0 : 1;
}
