// The pendulum in Cartesian coordinates (x, y, v, w) by Method 2, implicit midpoint and orthogonal
// projector: the generic step, which knows of five equations and finds what they imply, against a
// hand-written one in the same process.
//
// The competitor is what a careful programmer would write for this one system: the hidden constraint and
// the tension worked out on paper, fixed-size Eigen, derivatives by hand, full Newton from the last
// increment, convergence relative to the scale of the state. One step is
//
//   x̄ - h/2 f(x̄) = x₀ + W(x₀) μ,   g(x̄) = 0,       x̄ + h/2 f(x̄) = x₁ + W(x₁) ν,   g(x₁) = 0,
//
// g = (x² + y² - 1, x v + y w), and the columns of W span its gradients.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <memory>

#include "courant/integrators/constrain_first.hpp"
#include "courant/integrators/ladder/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kStep = 0.01;
constexpr int kSteps = 300;

Vector4d start() { return {std::sin(2.0), -std::cos(2.0), 0.0, 0.0}; }

// f and its Jacobian, with the tension T = (v² + w² - y) / (x² + y²).
void velocity(const Vector4d& at, Vector4d& f, Matrix4& J) {
  const double x = at[0], y = at[1], v = at[2], w = at[3];
  const double r2 = x * x + y * y, T = (v * v + w * w - y) / r2;
  f << v, w, -T * x, -T * y - 1.0;
  const double of_T[4] = {-2.0 * x * T / r2, -(1.0 + 2.0 * y * T) / r2, 2.0 * v / r2, 2.0 * w / r2};
  J.setZero();
  J(0, 2) = J(1, 3) = 1.0;
  for (int j = 0; j < 4; ++j) {
    J(2, j) = -x * of_T[j];
    J(3, j) = -y * of_T[j];
  }
  J(2, 0) -= T;
  J(3, 1) -= T;
}

Eigen::Matrix<double, 4, 2> directions(const Vector4d& x) {
  Eigen::Matrix<double, 4, 2> W;
  W << x[0], x[2], x[1], x[3], 0.0, x[0], 0.0, x[1];
  return W;
}

Vector2d constraint(const Vector4d& x) {
  return {x[0] * x[0] + x[1] * x[1] - 1.0, x[0] * x[2] + x[1] * x[3]};
}

Eigen::Matrix<double, 2, 4> gradient(const Vector4d& x) {
  Eigen::Matrix<double, 2, 4> G;
  G << 2.0 * x[0], 2.0 * x[1], 0.0, 0.0, x[2], x[3], x[0], x[1];
  return G;
}

struct Pendulum {
  Vector4d x = start(), increment = Vector4d::Zero(), correction = Vector4d::Zero();
  Vector2d mu = Vector2d::Zero(), nu = Vector2d::Zero();
};

bool is_converged(const Vector6& change) { return change.lpNorm<Eigen::Infinity>() < 1e-13; }

void step_by_hand(Pendulum& pendulum) {
  auto& [x, increment, correction, mu, nu] = pendulum;
  Vector4d f;
  Matrix4 J;
  Matrix6 A = Matrix6::Zero();
  Vector6 residual;
  const Eigen::Matrix<double, 4, 2> W = directions(x);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Vector4d middle = x + increment;
    velocity(middle, f, J);
    residual << increment - 0.5 * kStep * f - W * mu, constraint(middle);
    A.topLeftCorner<4, 4>() = Matrix4::Identity() - 0.5 * kStep * J;
    A.topRightCorner<4, 2>() = -W;
    A.bottomLeftCorner<2, 4>() = gradient(middle);
    const Vector6 change = A.partialPivLu().solve(residual);
    increment -= change.head<4>();
    mu -= change.tail<2>();
    if (is_converged(change)) break;
  }
  velocity(x + increment, f, J);
  const Vector4d near = x + increment + 0.5 * kStep * f;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Vector4d end = near + correction;
    const Eigen::Matrix<double, 4, 2> V = directions(end);
    residual << correction + V * nu, constraint(end);
    Matrix4 turned = Matrix4::Zero();  // derivative of W(x) ν
    turned.diagonal() << nu[0], nu[0], 0.0, 0.0;
    turned(0, 2) = turned(1, 3) = turned(2, 0) = turned(3, 1) = nu[1];
    A.topLeftCorner<4, 4>() = Matrix4::Identity() + turned;
    A.topRightCorner<4, 2>() = V;
    A.bottomLeftCorner<2, 4>() = gradient(end);
    const Vector6 change = A.partialPivLu().solve(residual);
    correction -= change.head<4>();
    nu -= change.tail<2>();
    if (is_converged(change)) break;
  }
  x = near + correction;
}

void pendulum_by_hand(benchmark::State& state) {
  for (auto _ : state) {
    Pendulum pendulum;
    for (int k = 0; k < kSteps; ++k) step_by_hand(pendulum);
    benchmark::DoNotOptimize(pendulum.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

class CartesianPendulum final : public courant::ImplicitSystem {
 public:
  CartesianPendulum() : ImplicitSystem(std::make_shared<courant::Euclidean>(4), 1, 5, {}) {}

 private:
  courant::ExprVector do_residual(const courant::ExprVector& x, const courant::ExprVector& v,
                                  const courant::ExprVector& z,
                                  const courant::Expr&) const override {
    using courant::square;
    courant::ExprVector F(5);
    F << v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1.0,
        square(x[0]) + square(x[1]) - 1.0;
    return F;
  }
};

courant::ConstrainFirst method(courant::Backend backend) {
  using namespace courant;
  const auto system = std::make_shared<CartesianPendulum>();
  return ConstrainFirst(system, ConstraintAlgorithm().run(system, {.x = start()}),
                        std::make_shared<Theta>(system->manifold()),
                        std::make_shared<OrthogonalProjector>(), {.backend = backend});
}

void pendulum(benchmark::State& state, courant::Backend backend) {
  const courant::ConstrainFirst generic = method(backend);
  for (auto _ : state) {
    const courant::State end = generic.advance({.x = start()}, kStep, kSteps);
    benchmark::DoNotOptimize(end.x.data());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
}

BENCHMARK(pendulum_by_hand);
BENCHMARK_CAPTURE(pendulum, native, courant::Backend::native);
BENCHMARK_CAPTURE(pendulum, interpreter, courant::Backend::interpreter);

// The schemes are the same: both routes end in the same place.
bool agree() {
  Pendulum by_hand;
  for (int k = 0; k < kSteps; ++k) step_by_hand(by_hand);
  const Eigen::VectorXd x =
      method(courant::Backend::interpreter).advance({.x = start()}, kStep, kSteps).x;
  return (x - by_hand.x).norm() < 1e-11;
}

}  // namespace

int main(int argc, char** argv) {
  if (!agree()) {
    std::fputs("bench_constrained: the two routes do not take the same steps.\n", stderr);
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
