#include "integrator_catalogue.hpp"

#include <map>

#include "../example_systems.hpp"
#include "../held_on_sphere.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/adjoint.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/damped_composition.hpp"
#include "courant/integrators/methods/discrete_gradient.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/integrators/methods/reduced_map.hpp"
#include "courant/integrators/methods/substepping_integrator.hpp"
#include "courant/integrators/methods/transformed_integrator.hpp"
#include "courant/integrators/methods/verlet.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/euler_poincare.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

namespace courant::test {
namespace {

using examples::equations;
using V = const ExprVector&;
using T = const Expr&;
using MapPointer = std::shared_ptr<const DiscretizationMap>;

std::shared_ptr<const CotangentBundle> cotangent(std::shared_ptr<const Manifold> Q) {
  return std::make_shared<CotangentBundle>(std::move(Q));
}
MapPointer lift(const std::shared_ptr<const CotangentBundle>& M, MapPointer base) {
  return std::make_shared<CotangentLift>(M, std::move(base));
}
std::shared_ptr<const DiracSystem> hamiltonian(const std::shared_ptr<const CotangentBundle>& M,
                                               Hamiltonian::Formula H) {
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                       std::make_shared<Hamiltonian>(M, std::move(H)));
}

// A setting at the ladder's point.
class Site {
 public:
  Site(std::string name, std::shared_ptr<const ImplicitSystem> system, InitialGuess guess,
       double step, std::vector<IntegratorEntry>& table)
      : name_(std::move(name)),
        system_(std::move(system)),
        ladder_(ConstraintAlgorithm().run(system_, guess)),
        step_(step),
        table_(table) {}
  Site(std::string name, std::shared_ptr<const ImplicitSystem> system, ConstraintLadder ladder,
       double step, std::vector<IntegratorEntry>& table)
      : name_(std::move(name)),
        system_(std::move(system)),
        ladder_(std::move(ladder)),
        step_(step),
        table_(table) {}

  void method_1(const std::string& map_name, const MapPointer& map) const {
    add("discretize-first, " + map_name, std::make_shared<DiscretizeFirst>(system_, map));
  }
  // To higher orders, each with how much longer its steps are: errors are to be far from round-off.
  void composed(const std::string& name, const std::shared_ptr<const Integrator>& method,
                const std::map<int, double>& orders) const {
    for (const auto& [order, longer] : orders)
      add(name + ", order " + std::to_string(order), std::make_shared<Composition>(method, order),
          longer * step_);
  }
  // On the manifold of the system, not lifted.
  void damped_1() const {
    const auto with = [&](std::size_t i) {
      return std::make_shared<DiscretizeFirst>(
          system_, std::make_shared<Theta>(system_->manifold(), DampedComposition::kThetas[i]));
    };
    add("discretize-first, damped", std::make_shared<DampedComposition>(with(0), with(1)));
  }
  void damped_2() const {
    const auto with = [&](std::size_t i) {
      return constrained(
          std::make_shared<Theta>(system_->manifold(), DampedComposition::kThetas[i]),
          std::make_shared<OrthogonalProjector>());
    };
    add("constrain-first, damped", std::make_shared<DampedComposition>(with(0), with(1)));
  }
  void divided(const std::string& name, std::shared_ptr<const Integrator> method,
               SubsteppingIntegrator::Options options) const {
    add(name + ", divided",
        std::make_shared<SubsteppingIntegrator>(std::move(method), std::move(options)));
  }
  void method_2(const std::string& map_name, const MapPointer& map,
                std::shared_ptr<const Projector> projector) const {
    add("constrain-first, " + map_name, constrained(map, std::move(projector)));
  }
  std::shared_ptr<const Integrator> constrained(const MapPointer& map,
                                                std::shared_ptr<const Projector> projector) const {
    return std::make_shared<ConstrainFirst>(system_, ladder_, map, std::move(projector));
  }
  std::shared_ptr<const Integrator> in_halves(const MapPointer& map) const {
    return std::make_shared<Verlet>(system_, ladder_, map);
  }
  void verlet(const std::string& map_name, const MapPointer& map) const {
    add("verlet, " + map_name, in_halves(map));
  }
  void reduced(const std::string& map_name, const MapPointer& map) const {
    add("reduced, " + map_name,
        std::make_shared<ReducedMap>(std::dynamic_pointer_cast<const DiracSystem>(system_), map));
  }
  void discrete_gradients(const std::string& map_name, const MapPointer& map) const {
    for (const std::shared_ptr<const DiscreteDifferential>& differential :
         {std::shared_ptr<const DiscreteDifferential>(std::make_shared<GonzalezDifferential>()),
          std::shared_ptr<const DiscreteDifferential>(std::make_shared<AveragedDifferential>()),
          std::shared_ptr<const DiscreteDifferential>(std::make_shared<ItohAbeDifferential>())})
      add("discrete-gradient, " + differential->name() + ", " + map_name,
          std::make_shared<DiscreteGradient>(system_, map, differential));
  }
  // High orders may want longer steps, whose errors are far from round-off.
  void explicit_methods(double longer = 1.0) const {
    const auto field = std::make_shared<VectorField>(system_, ladder_, Backend::interpreter);
    for (const auto kind :
         {ExplicitRungeKutta::Kind::midpoint, ExplicitRungeKutta::Kind::classical,
          ExplicitRungeKutta::Kind::dormand_prince, ExplicitRungeKutta::Kind::fehlberg}) {
      const auto method = std::make_shared<ExplicitRungeKutta>(field, kind);
      add(method->name(), method, method->order() > 4 ? longer * step_ : step_);
      table_.back().both_ways = method->order() <= 4;
    }
  }

 private:
  void add(const std::string& method, std::shared_ptr<const Integrator> integrator) const {
    add(method, std::move(integrator), step_);
  }
  void add(const std::string& method, std::shared_ptr<const Integrator> integrator,
           double step) const {
    const auto* dirac = dynamic_cast<const DiracSystem*>(system_.get());
    table_.push_back({method + ": " + name_,
                      std::move(integrator),
                      {.system = system_,
                       .initial = ladder_.point,
                       .step = step,
                       .conormals = ladder_.conormals(),
                       .is_gauge = ladder_.gauge_dimension > 0,
                       .structure = dirac ? dirac->structure() : nullptr}});
  }

  std::string name_;
  std::shared_ptr<const ImplicitSystem> system_;
  ConstraintLadder ladder_;
  double step_;
  std::vector<IntegratorEntry>& table_;
};

void on_vector_spaces(std::vector<IntegratorEntry>& table) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = cotangent(line);
  // q̈ = -sin q - q²/2 - q³/2 + cos 3t: no symmetry in q or in time, and bounded.
  const auto driven = hamiltonian(M, [](V x, T t) {
    const Expr cube = x[0] * square(x[0]);
    return 0.5 * square(x[1]) - cos(x[0]) + cube / 6.0 + cube * x[0] / 8.0 - x[0] * cos(3.0 * t);
  });
  const Site pendulum("driven pendulum", driven, {.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)}, 0.2,
                      table);
  pendulum.method_1("midpoint", lift(M, std::make_shared<Theta>(line)));
  pendulum.method_1("theta = 0", lift(M, std::make_shared<Theta>(line, 0.0)));
  pendulum.method_1("theta = 0.3", lift(M, std::make_shared<Theta>(line, 0.3)));
  pendulum.method_1("midpoint of T*R, no lift", std::make_shared<Theta>(M));
  pendulum.method_1("adjoint of theta = 0",
                    std::make_shared<Adjoint>(lift(M, std::make_shared<Theta>(line, 0.0))));
  pendulum.method_2("midpoint", lift(M, std::make_shared<Theta>(line)),
                    std::make_shared<OrthogonalProjector>());
  pendulum.composed(
      "discretize-first",
      std::make_shared<DiscretizeFirst>(driven, lift(M, std::make_shared<Theta>(line))),
      {{4, 1.0}, {6, 4.0}, {8, 6.0}});
  pendulum.verlet("theta = 0", lift(M, std::make_shared<Theta>(line, 0.0)));
  pendulum.composed("verlet", pendulum.in_halves(lift(M, std::make_shared<Theta>(line, 0.0))),
                    {{4, 1.0}, {6, 4.0}, {8, 6.0}});
  pendulum.explicit_methods(3.0);
  pendulum.damped_1();
  const auto lifted =
      std::make_shared<DiscretizeFirst>(driven, lift(M, std::make_shared<Theta>(line)));
  pendulum.divided("midpoint, halves", lifted, {.halvings = 3});
  pendulum.divided("midpoint, corners and halves", lifted,
                   {.corners = {{0.35, 0.0}, {0.41, 0.33}}, .halvings = 3});

  // With damping: the map is symplectic, the system is not Lagrangian.
  const auto damped = std::make_shared<examples::FormulaSystem>(M, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + sin(x[0]) + 0.3 * x[1]});
  });
  Site("damped pendulum", damped, {.x = Eigen::Vector2d(0.7, -0.4)}, 0.2, table)
      .method_1("midpoint", lift(M, std::make_shared<Theta>(line)));
}

// Hamiltonians that are no sums of functions of one coordinate each: for these Itoh and Abe's
// differential would be symmetric.
void of_energies(std::vector<IntegratorEntry>& table) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = cotangent(line);
  const auto driven = hamiltonian(M, [](V x, T t) {
    return 0.5 * square(x[1]) * (1.0 + 0.3 * square(x[0])) - cos(x[0]) + x[0] * x[1] / 3.0 +
           0.2 * exp(0.5 * x[0]) * cos(3.0 * t);
  });
  const Site coupled("driven, coupled", driven, {.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)}, 0.2,
                     table);
  coupled.discrete_gradients("midpoint", lift(M, std::make_shared<Theta>(line)));
  coupled.discrete_gradients("theta = 0", std::make_shared<Theta>(M, 0.0));
  coupled.verlet("theta = 0", lift(M, std::make_shared<Theta>(line, 0.0)));

  // Ports: resistance that depends on the point, an input of time and output, feedthrough.
  const auto plane = std::make_shared<Euclidean>(2);
  const auto J = [](V x) {
    ExprMatrix matrix = ExprMatrix::Zero(2, 2);
    matrix(0, 1) = 1.0 + 0.2 * square(x[0]);
    matrix(1, 0) = -matrix(0, 1);
    return matrix;
  };
  const auto resistance = [](V x) {
    ExprMatrix matrix = ExprMatrix::Zero(2, 2);
    matrix(1, 1) = 0.1 + 0.1 * square(x[0]);
    return matrix;
  };
  const auto B = [](V x) {
    ExprMatrix column(2, 1);
    column << Expr(0.2), 1.0 + 0.5 * x[0];
    return column;
  };
  const auto D = [](V) { return ExprMatrix(ExprMatrix::Constant(1, 1, Expr(0.3))); };
  const auto energy = std::make_shared<Hamiltonian>(plane, [](V x, T) {
    return square(x[1]) / 2.0 + square(x[0]) / 2.0 + square(square(x[0])) / 4.0 +
           x[0] * square(x[1]) / 3.0;
  });
  const auto open = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{J, resistance, B, 1, D}, energy,
      [](T t, V y) { return ExprVector(ExprVector::Constant(1, sin(2.0 * t) - 0.5 * y[0])); });
  Site("open port", open, {.t = 0.2, .x = Eigen::Vector2d(0.4, -0.6)}, 0.2, table)
      .discrete_gradients("midpoint", std::make_shared<Theta>(plane));

  // A rod: the constraint holds at both ends, and its force does no work.
  const auto N = cotangent(plane);
  const auto free = std::make_shared<Hamiltonian>(N, [](V x, T) {
    return 0.5 * (square(x[2]) + square(x[3])) + x[1] + 0.3 * square(x[0]) * x[2];
  });
  const auto rod = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(N),
      std::make_shared<ConstrainedFamily>(
          free,
          [](V x, V, T) {
            return ExprVector(ExprVector::Constant(1, square(x[0]) + square(x[1]) - 1.0));
          },
          1));
  Site("rod", rod, {.x = Eigen::Vector4d(0.6, -0.8, 0.24, 0.18)}, 0.1, table)
      .discrete_gradients("midpoint", lift(N, std::make_shared<Theta>(plane)));
  Site("rod", rod, {.x = Eigen::Vector4d(0.6, -0.8, 0.24, 0.18)}, 0.1, table)
      .verlet("theta = 0", lift(N, std::make_shared<Theta>(plane, 0.0)));
}

void with_constraints(std::vector<IntegratorEntry>& table) {
  // The pendulum in Cartesian coordinates, with a spring: index 2.
  const auto space = std::make_shared<Euclidean>(4);
  const auto rod = std::make_shared<examples::FormulaSystem>(space, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0] + square(x[0]),
                      v[3] + z[0] * x[1] + 1.0, square(x[0]) + square(x[1]) - 1.0});
  });
  const Site pendulum("Cartesian pendulum", rod, {.x = Eigen::Vector4d(0.6, -0.8, 0.24, 0.18)}, 0.1,
                      table);
  pendulum.method_2("midpoint", std::make_shared<Theta>(space),
                    std::make_shared<OrthogonalProjector>());
  pendulum.method_2("theta = 0.3", std::make_shared<Theta>(space, 0.3),
                    std::make_shared<OrthogonalProjector>());
  pendulum.method_2("midpoint, in units", std::make_shared<Theta>(space),
                    std::make_shared<OrthogonalProjector>(Eigen::Vector4d(1.0, 1.0, 3.0, 3.0)));
  pendulum.explicit_methods(4.0);
  pendulum.damped_2();

  // x' = p, p' = -∇V + λ (-y, 0, 1), z' = y x'
  const auto M = std::make_shared<Euclidean>(6);
  const auto particle = std::make_shared<examples::FormulaSystem>(M, 1, 7, [](V x, V v, V z, T) {
    return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + x[0] + z[0] * x[1],
                      v[4] + x[1] + square(x[0]), v[5] - z[0], x[5] - x[1] * x[3]});
  });
  const Site nonholonomic("nonholonomic particle", particle,
                          {.x = (VectorXd(6) << 0.3, 0.7, 0.2, 1.0, 0.4, 0.7).finished()}, 0.1,
                          table);
  nonholonomic.method_1("midpoint", std::make_shared<Theta>(M));
  nonholonomic.damped_1();
  nonholonomic.damped_2();
  nonholonomic.method_2("midpoint, momentum", std::make_shared<Theta>(M),
                        std::make_shared<MomentumProjector>(*M, std::vector<Index>{3, 4, 5}));
  nonholonomic.composed(
      "constrain-first, momentum",
      nonholonomic.constrained(std::make_shared<Theta>(M), std::make_shared<MomentumProjector>(
                                                               *M, std::vector<Index>{3, 4, 5})),
      {{4, 10.0}, {6, 10.0}});
}

void on_manifolds(std::vector<IntegratorEntry>& table) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto M = cotangent(sphere);
  const auto spherical = hamiltonian(M, [](V x, T) {
    return 0.5 * (square(x[3]) + square(x[4]) + square(x[5])) + x[2] + 0.3 * x[0] * x[1];
  });
  const Site pendulum("spherical pendulum", spherical,
                      {.x = (VectorXd(6) << 0.6, 0.0, -0.8, 0.4, 0.5, 0.3).finished()}, 0.1, table);
  pendulum.method_1("chordal", lift(M, std::make_shared<Chordal>(sphere)));
  pendulum.method_1("theta = 1", lift(M, std::make_shared<Theta>(sphere, 1.0)));
  pendulum.verlet("theta = 0", lift(M, std::make_shared<Theta>(sphere, 0.0)));
  pendulum.damped_1();
  pendulum.discrete_gradients("chordal", lift(M, std::make_shared<Chordal>(sphere)));

  // Bases of T(T*S³) turn along the way, and multipliers are found in any of them.
  const examples::HeldOnSphere held;
  const Site curved("held on a curved set in S³", held.system, held.ladder, 0.1, table);
  const auto chordal = lift(held.M, std::make_shared<Chordal>(held.sphere));
  curved.method_2("chordal", chordal, std::make_shared<OrthogonalProjector>());
  curved.composed("constrain-first",
                  curved.constrained(chordal, std::make_shared<OrthogonalProjector>()),
                  {{4, 10.0}, {6, 10.0}});

  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const auto N = cotangent(rotations);
  const auto top = hamiltonian(N, [](V x, T) {
    return 0.5 * (square(x[9]) + square(x[10]) / 2.0 + square(x[11]) / 3.0) + x[8] + 0.2 * x[1];
  });
  VectorXd x(12);
  x << 1, 0, 0, 0, 0.6, -0.8, 0, 0.8, 0.6, 0.3, -0.5, 0.9;
  const Site spinning("heavy top", top, {.x = x}, 0.1, table);
  spinning.verlet("theta = 0", lift(N, std::make_shared<Theta>(rotations, 0.0)));
  spinning.method_1("cayley", lift(N, std::make_shared<CayleyMidpoint>(rotations)));
  spinning.discrete_gradients("cayley", lift(N, std::make_shared<CayleyMidpoint>(rotations)));
}

// A top in the wind, with its attitude, on (so(3) ⋉ R³)* × SO(3); a body in a fluid on se(3)*.
void on_duals_of_algebras(std::vector<IntegratorEntry>& table) {
  EulerPoincare top{.algebra = LieAlgebra::so3(), .group = std::make_shared<SpecialOrthogonal3>()};
  for (Index i = 0; i < 3; ++i) {
    top.representation.push_back(MatrixXd::Zero(3, 3));
    top.representation.back()((i + 2) % 3, (i + 1) % 3) = 1.0;
    top.representation.back()((i + 1) % 3, (i + 2) % 3) = -1.0;
  }
  top.lagrangian = [](V xi, V a, T t) {
    return 0.5 * (square(xi[0]) + 2.0 * square(xi[1]) + 3.0 * square(xi[2])) - a[2] -
           0.2 * a[0] * cos(3.0 * t);
  };
  top.input = [](V, V, V xi, T t) { return ExprVector{{sin(t), -0.2 * xi[1], Expr(0.1)}}; };
  VectorXd x(15);
  x << 0.3, -0.5, 0.9, 0.0, 0.8, 0.6, 1, 0, 0, 0, 0.6, -0.8, 0, 0.8, 0.6;
  Site("heavy top with the attitude", euler_poincare_system(top), {.t = 0.2, .x = x}, 0.1, table)
      .reduced("cayley", std::make_shared<CayleyMidpoint>(std::make_shared<SpecialOrthogonal3>()));

  const EulerPoincare body{.algebra = LieAlgebra::se3(), .hamiltonian = [](V mu, V, T) {
                             return 0.5 * (square(mu[0]) + square(mu[1]) / 2.0 +
                                           square(mu[2]) / 3.0 + square(mu[3]) +
                                           1.5 * square(mu[4]) + 0.8 * square(mu[5])) +
                                    0.2 * mu[0] * mu[4] + 0.1 * square(mu[3] * mu[5]);
                           }};
  VectorXd mu(6);
  mu << 0.3, -0.5, 0.9, 0.7, 0.2, -0.4;
  Site("body in a fluid", euler_poincare_system(body), {.x = mu}, 0.1, table)
      .reduced("exponential", std::make_shared<Theta>(std::make_shared<SpecialEuclidean3>()));
}

// Nothing moves: M is a point.
void on_a_point(std::vector<IntegratorEntry>& table) {
  const auto point = std::make_shared<Euclidean>(0);
  const auto nothing = std::make_shared<examples::FormulaSystem>(
      point, 0, 0, [](V, V, V, T) { return ExprVector(0); });
  ConstraintLadder ladder;
  ladder.verdict = Verdict::regular;
  ladder.index = 0;
  ladder.degrees_of_freedom = 0;
  ladder.point = {0.0, VectorXd(0), VectorXd(0), VectorXd(0)};
  const Site site("a point", nothing, ladder, 0.1, table);
  site.method_1("midpoint", std::make_shared<Theta>(point));
  site.method_2("midpoint", std::make_shared<Theta>(point),
                std::make_shared<OrthogonalProjector>());
  site.explicit_methods();
}

// Methods of extended systems are methods as any other; back in the time of the system they are so
// where the rate is 1, and the time after k steps is k h.
void in_transformed_time(std::vector<IntegratorEntry>& table) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = cotangent(line);
  const auto system = hamiltonian(M, [](V x, T t) {
    return 0.5 * square(x[1]) - cos(x[0]) + sin(2.0 * x[0]) / 6.0 - x[0] * cos(3.0 * t);
  });
  const TimeRate rate = [](V x, T t) {
    return 0.5 + 0.15 * square(x[0]) + 0.1 * x[0] * x[1] + 0.05 * sin(t);
  };
  const State start{.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)};
  const auto symplectic = TimeTransformation::symplectic(system, rate);
  const auto plain = TimeTransformation::plain(system, rate);
  for (const auto* time : {&symplectic, &plain}) {
    const State extended = time->to_extended(start);
    const Site site(time->is_symplectic() ? "pendulum in transformed time, symplectic"
                                          : "pendulum in transformed time",
                    time->extended(), {.x = extended.x}, 0.05, table);
    const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(time->places().manifold);
    site.method_1("midpoint", bundle ? lift(bundle, std::make_shared<Theta>(bundle->base()))
                                     : std::make_shared<Theta>(time->places().manifold));
  }
  const auto one = std::make_shared<TimeTransformation>(
      TimeTransformation::symplectic(system, [](V, T) { return Expr(1.0); }));
  const auto T_Q = std::dynamic_pointer_cast<const CotangentBundle>(one->places().manifold);
  table.push_back(
      {"discretize-first, midpoint, at a rate of one: driven pendulum",
       std::make_shared<TransformedIntegrator>(
           one, std::make_shared<DiscretizeFirst>(one->extended(),
                                                  lift(T_Q, std::make_shared<Theta>(T_Q->base())))),
       {.system = system, .initial = start, .step = 0.05, .structure = system->structure()}});
}

void in_other_units(std::vector<IntegratorEntry>& table) {
  const auto M = cotangent(std::make_shared<Euclidean>(1));
  const auto system =
      hamiltonian(M, [](V x, T t) { return 0.5 * square(x[1]) - cos(x[0]) - x[0] * cos(3.0 * t); });
  const auto measured = std::make_shared<SystemInUnits>(
      system, Units{.coordinates = Eigen::Vector2d(8.0, 0.25),
                    .tangent = Eigen::Vector2d(8.0, 0.25),
                    .auxiliary = VectorXd::Ones(system->auxiliary_size()),
                    .equations = VectorXd::Constant(system->equation_count(), 2.0),
                    .time = 0.5});
  table.push_back({"discretize-first, midpoint, in other units: driven pendulum",
                   std::make_shared<IntegratorInUnits>(
                       measured, std::make_shared<DiscretizeFirst>(
                                     measured, lift(M, std::make_shared<Theta>(M->base())))),
                   {.system = system,
                    .initial = {.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)},
                    .step = 0.05,
                    .structure = system->structure()}});
}

}  // namespace

std::vector<IntegratorEntry> integrator_catalogue() {
  std::vector<IntegratorEntry> table;
  on_vector_spaces(table);
  of_energies(table);
  with_constraints(table);
  on_manifolds(table);
  on_duals_of_algebras(table);
  on_a_point(table);
  in_transformed_time(table);
  in_other_units(table);
  return table;
}

}  // namespace courant::test
