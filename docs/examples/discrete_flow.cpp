// A parameter that is fitted to a trajectory: the gradient of a sum over all steps, by the adjoint.
#include <cmath>
#include <courant/courant.hpp>
#include <iostream>

using namespace courant;

// H = p²/2 - k cos q on T*R, where k is a parameter.
std::shared_ptr<const ImplicitSystem> pendulum(double k) {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(bundle, [k](const ExprVector& x, const Expr&) {
        return x[1] * x[1] / 2.0 - Parameter{"k", k}.at(x) * cos(x[0]);
      }));
}

int main() {
  constexpr double h = 0.1;
  constexpr long steps = 100;
  // Made for all k: its value is the last coordinate of the start.
  const ParameterExtension with(pendulum(1.0), {{"k", 1.0}});
  const auto method = std::make_shared<DiscretizeFirst>(
      with.extended(), std::make_shared<Theta>(with.extended()->manifold(), 0.5));
  const DiscreteFlow flow(method, h, steps);
  const auto start = [](double k) {
    State state;
    state.x.resize(3);
    state.x << 0.5, 0.0, k;
    return state;
  };
  // What was seen: the trajectory of k = 1.3.
  const auto seen = [&](long j) { return method->advance(start(1.3), h, j).x[0]; };
  std::vector<double> observed;
  for (long j = 0; j <= steps; ++j) observed.push_back(seen(j));

  // Gauss–Newton on Σ_j (q_j - seen_j)², whose gradient the adjoint gives; here with its curvature by the tangent map.
  double k = 1.2;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto gradient = flow.pull_back(start(k), [&](long j, const State& at) {
      MatrixXd slope = MatrixXd::Zero(3, 1);
      slope(0, 0) = at.x[0] - observed[static_cast<std::size_t>(j)];
      return slope;
    });
    double curvature = 0.0;
    MatrixXd V = MatrixXd::Zero(3, 1);
    V(2, 0) = 1.0;
    State state = start(k);
    const DiscreteFlow one(method, h, 1);
    for (long j = 0; j < steps; ++j) {
      const auto image = one.push_forward(state, V);
      state = image.end;
      V = image.directions;
      curvature += V(0, 0) * V(0, 0);
    }
    const double change = -gradient.covectors(2, 0) / curvature;
    k += change;
    if (std::fabs(change) < 1e-13) break;
  }
  std::cout << "k = " << k << '\n';
  return std::fabs(k - 1.3) < 1e-10 ? 0 : 1;
}
