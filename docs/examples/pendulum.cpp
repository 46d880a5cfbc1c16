// A pendulum, step by step: how a space, a structure and an energy become a trajectory.
//
// The pendulum has length 1 and mass 1, gravity is 1, q is its angle from below. Released at rest
// at the angle 2 it is back after the period 4 K(sin 1) = 8.3498..., K an elliptic integral.
#include <cmath>
#include <courant/courant.hpp>
#include <cstdio>
#include <memory>

using namespace courant;

int main() {
  // 1. Where the system lives. Angles are real numbers here, so the configurations are Q = R; other
  //    spaces, such as Sphere and SpecialOrthogonal3, stand in manifolds/. The phase space T*Q has
  //    points x = (q, p).
  const auto Q = std::make_shared<Euclidean>(1);
  const auto phase_space = std::make_shared<CotangentBundle>(Q);

  // 2. Its geometry: a Dirac structure D, which says what velocity an energy leads to. The canonical
  //    structure of T*Q makes Hamilton's equations of it.
  const auto structure = std::make_shared<CanonicalSymplectic>(phase_space);

  // 3. Its energy, a formula on expressions. It is written once; all derivatives are exact and come
  //    from it.
  const auto energy = std::make_shared<Hamiltonian>(
      phase_space, [](const ExprVector& x, const Expr&) { return square(x[1]) / 2.0 - cos(x[0]); });

  // 4. The equations: S = {v : (v, dH) ∈ D}, an implicit differential equation.
  const auto system = std::make_shared<DiracSystem>(structure, energy);

  // 5. The certificate. From a guess of the initial state the constraint algorithm finds a
  //    consistent one, and says whether there is a solution through it, and only one. Here nothing
  //    is hidden, and it stops at once.
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = VectorXd{{2.0, 0.0}}});
  std::printf("verdict: %s, degrees of freedom: %d\n", to_string(ladder.verdict).c_str(),
              static_cast<int>(ladder.degrees_of_freedom));
  if (ladder.verdict != Verdict::regular) return 1;

  // 6. The discretization. A discretization map takes a velocity to a pair of points: here the
  //    midpoint rule on Q, lifted to T*Q so that the steps are symplectic.
  const auto map = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(Q));

  // 7. The method: Method 1 of the paper, which asks for (x_k, x_{k+1}) with R_d^{-1} in S. It is
  //    made ready once, and may then be started from many states.
  const DiscretizeFirst method(system, map);

  // 8. The trajectory: 100 steps a period, for ten periods.
  const double period = 8.349752926918493;
  const auto stepper = method.start(ladder.point, period / 100.0);
  double drift = 0.0;
  const auto H = [](const VectorXd& x) { return x[1] * x[1] / 2.0 - std::cos(x[0]); };
  std::printf("%8s %12s %12s %14s\n", "t", "q", "p", "H - H(0)");
  for (int k = 1; k <= 1000; ++k) {
    stepper->step();
    const State& state = stepper->state();
    const double change = H(state.x) - H(ladder.point.x);
    drift = std::max(drift, std::abs(change));
    if (k % 100 == 0)
      std::printf("%8.3f %12.6f %12.6f %14.2e\n", state.t, state.x[0], state.x[1], change);
  }

  // 9. Does it keep what it should? The energy of a symplectic method moves within bounds and does
  //    not drift; the angle is behind by an error of the second order in the step.
  const double angle = stepper->state().x[0];
  std::printf("energy within %.0e, angle after ten periods %.3f\n", drift, angle);
  return drift < 1e-3 && std::abs(angle - 2.0) < 0.1 ? 0 : 1;
}
