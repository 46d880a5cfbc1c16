#include "courant/integrators/methods/verlet.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/step/step_energies.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/tests/integrators/example_systems.hpp"
#include "courant/tests/integrators/kepler.hpp"

using namespace courant;
using examples::equations;
using examples::FormulaSystem;
using examples::Kepler;

BOOST_AUTO_TEST_SUITE(verlet_step)

using V = const ExprVector&;
using T = const Expr&;

namespace {

std::shared_ptr<const Verlet> verlet(const std::shared_ptr<const ImplicitSystem>& system,
                                     const std::shared_ptr<const CotangentBundle>& M,
                                     const InitialGuess& guess) {
  return std::make_shared<Verlet>(
      system, ConstraintAlgorithm().run(system, guess),
      std::make_shared<CotangentLift>(M, std::make_shared<Theta>(M->base(), 0.0)));
}

std::shared_ptr<const Verlet> verlet(const Kepler& kepler) {
  return verlet(kepler.system, kepler.M, {.x = kepler.at(0.0)});
}

// A mass m on a rod of length l under gravity g, by Cartesian coordinates, and RATTLE for it as one writes it by hand.
struct Rod {
  double m = 1.3, l = 1.1, g = 0.9;
  std::shared_ptr<const Euclidean> plane = std::make_shared<Euclidean>(2);
  std::shared_ptr<const CotangentBundle> M = std::make_shared<CotangentBundle>(plane);

  std::shared_ptr<const DiracSystem> system() const {
    const auto free = std::make_shared<Hamiltonian>(
        M, [*this](V x, T) { return (square(x[2]) + square(x[3])) / (2.0 * m) + m * g * x[1]; });
    return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                         std::make_shared<ConstrainedFamily>(
                                             free,
                                             [*this](V x, V, T) {
                                               return ExprVector(ExprVector::Constant(
                                                   1, 0.5 * (square(x[0]) + square(x[1]) - l * l)));
                                             },
                                             1));
  }
  VectorXd start() const {
    const double angle = 0.7, momentum = 0.4;
    return Eigen::Vector4d(l * std::sin(angle), -l * std::cos(angle), momentum * std::cos(angle),
                           momentum * std::sin(angle));
  }
  double energy(const VectorXd& x) const {
    return x.tail(2).squaredNorm() / (2.0 * m) + m * g * x[1];
  }
  // With the multiplier of the first half by the formula for the roots of a quadratic equation.
  VectorXd rattle(const VectorXd& x, double h) const {
    const Eigen::Vector2d q = x.head(2), force(0.0, -m * g);
    const Eigen::Vector2d p = x.tail(2) + 0.5 * h * force, reached = q + h / m * p;
    const double k = 0.5 * h * h / m;  // q₁ = reached - k λ q
    const double a = k * k * l * l, b = k * reached.dot(q), c = reached.squaredNorm() - l * l;
    const double lambda = c / (b + std::sqrt(b * b - a * c));
    const Eigen::Vector2d q1 = reached - k * lambda * q;
    const Eigen::Vector2d p1 = p - 0.5 * h * lambda * q + 0.5 * h * force;
    Eigen::Vector4d result;
    result << q1, p1 - p1.dot(q1) / (l * l) * q1;
    return result;
  }
};

// Slope of the distance from `exact` at the end over so many steps.
double order_to(const Integrator& method, const State& from, double time, const VectorXd& exact,
                const std::vector<long>& counts) {
  std::vector<double> steps, errors;
  for (const long count : counts) {
    const double h = time / static_cast<double>(count);
    steps.push_back(h);
    errors.push_back((method.advance(from, h, count).x - exact).norm());
  }
  return log_log_slope(steps, errors, 1e-13);
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_of_a_separable_energy_are_those_of_stoermer) {
  const Kepler kepler{.eccentricity = 0.6};
  const auto method = verlet(kepler);
  BOOST_TEST(method->is_explicit());
  BOOST_TEST(method->is_symplectic().value());
  const double h = 0.01;
  State state{.x = kepler.at(0.0)};
  Eigen::Vector2d q = state.x.head(2), p = state.x.tail(2);
  const auto force = [&] { return Eigen::Vector2d(-q / std::pow(q.norm(), 3)); };
  const auto stepper = method->stepper();
  for (int k = 0; k < 1000; ++k) {
    stepper->step(state, h);
    p += 0.5 * h * force();
    q += h * p;
    p += 0.5 * h * force();
  }
  BOOST_TEST((state.x.head(2) - q).norm() < 1e-11);
  BOOST_TEST((state.x.tail(2) - p).norm() < 1e-11);
  BOOST_TEST(stepper->statistics().iterations == 0);
  // v at the end: that of the second half.
  BOOST_TEST((stepper->last().stage.v.tail(2) - force()).norm() < 1e-10);
}

// 0 equations are left where the step is shown, too.
BOOST_AUTO_TEST_CASE(elimination_leaves_nothing_of_a_separable_energy) {
  const auto formulas = verlet(Kepler{})->formulas();
  BOOST_TEST(formulas.size() == 1u);
  BOOST_TEST(formulas[0].compile(Backend::interpreter).left().output_size() == 0);
}

// What a Composition makes in one go are its substeps one after the other.
BOOST_AUTO_TEST_CASE(compositions_have_the_bits_of_their_substeps) {
  const Kepler kepler{.eccentricity = 0.3};
  const auto method = verlet(kepler);
  for (const int order : {4, 6, 8}) {
    State whole{.x = kepler.at(0.0)}, parts = whole;
    const auto composed = Composition(method, order).stepper(), substep = method->stepper();
    for (int k = 0; k < 20; ++k) {
      composed->step(whole, 0.1);
      for (const double part : Composition::coefficients(order)) substep->step(parts, part * 0.1);
    }
    BOOST_TEST(whole.x == parts.x, boost::test_tools::per_element());
    BOOST_TEST(whole.v == parts.v, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(orders_of_compositions) {
  const Kepler kepler{.eccentricity = 0.3};
  const auto method = verlet(kepler);
  const VectorXd exact = kepler.at(2.0);
  BOOST_TEST(std::abs(order_to(*method, {.x = kepler.at(0.0)}, 2.0, exact, {64, 128, 256, 512}) -
                      2.0) < 0.15);
  const std::vector<std::pair<int, std::vector<long>>> settings = {
      {4, {16, 24, 32, 48, 64}}, {6, {10, 14, 18, 24}}, {8, {8, 10, 12, 14, 16}}};
  for (const auto& [order, counts] : settings) {
    const double measured =
        order_to(Composition(method, order), {.x = kepler.at(0.0)}, 2.0, exact, counts);
    BOOST_TEST(std::abs(measured - order) < 0.35, "order " << order << " shows " << measured);
  }
}

// One evaluation of forces a step: what the end of a step knows is handed on, and nothing else is remembered.
BOOST_AUTO_TEST_CASE(a_fresh_stepper_makes_the_same_step_to_the_bit) {
  const Kepler kepler;
  const auto method = verlet(kepler);
  State state{.x = kepler.at(0.3)};
  const auto stepper = method->stepper();
  for (int k = 0; k < 10; ++k) stepper->step(state, 0.02);
  State afresh = state;
  method->stepper()->step(afresh, 0.02);
  stepper->step(state, 0.02);
  BOOST_TEST(state.x == afresh.x, boost::test_tools::per_element());
}

// With the time at the ends of the step, for which there is a closed form: q' = p, p' = cos t.
BOOST_AUTO_TEST_CASE(time_is_that_of_the_ends) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = std::make_shared<CotangentBundle>(line);
  const auto driven = std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                                    std::make_shared<Hamiltonian>(M, [](V x, T t) {
                                                      return 0.5 * square(x[1]) - x[0] * cos(t);
                                                    }));
  const VectorXd start = Eigen::Vector2d(0.2, 0.1);
  const auto method = verlet(driven, M, {.t = 0.4, .x = start});
  BOOST_TEST(method->is_explicit());
  State state{.t = 0.4, .x = start};
  method->stepper()->step(state, 0.3);
  BOOST_TEST(std::abs(state.x[0] - (0.2 + 0.3 * (0.1 + 0.15 * std::cos(0.4)))) < 1e-15);
  BOOST_TEST(std::abs(state.x[1] - (0.1 + 0.15 * (std::cos(0.4) + std::cos(0.7)))) < 1e-15);
}

// H = p²(1 + q²)/2 + …: implicit, with the same maps.
BOOST_AUTO_TEST_CASE(energies_that_are_not_separable_are_solved_for) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto M = std::make_shared<CotangentBundle>(line);
  const auto coupled = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M), std::make_shared<Hamiltonian>(M, [](V x, T) {
        return 0.5 * square(x[1]) * (1.0 + square(x[0])) - cos(x[0]);
      }));
  const VectorXd start = Eigen::Vector2d(0.7, -0.4);
  const auto method = verlet(coupled, M, {.x = start});
  BOOST_TEST(!method->is_explicit());
  State state{.x = start};
  const double h = 0.1;
  method->stepper()->step(state, h);
  // By iteration of the two implicit half steps.
  const double q0 = start[0], p0 = start[1];
  double p = p0, q = q0;
  for (int i = 0; i < 100; ++i) p = p0 - 0.5 * h * (q0 * p * p + std::sin(q0));
  const double q_middle = q0 + 0.5 * h * p * (1.0 + q0 * q0);
  for (int i = 0; i < 100; ++i) q = q_middle + 0.5 * h * p * (1.0 + q * q);
  BOOST_TEST(std::abs(state.x[0] - q) < 1e-14);
  BOOST_TEST(std::abs(state.x[1] - (p - 0.5 * h * (q * p * p + std::sin(q)))) < 1e-14);
}

BOOST_AUTO_TEST_CASE(with_a_rod_it_is_rattle) {
  const Rod rod;
  const auto method = verlet(rod.system(), rod.M, {.x = rod.start()});
  BOOST_TEST(method->name() == "rattle");
  State state{.x = rod.start()};
  VectorXd by_hand = state.x;
  const auto stepper = method->stepper();
  for (int k = 0; k < 300; ++k) {
    stepper->step(state, 0.05);
    by_hand = rod.rattle(by_hand, 0.05);
  }
  BOOST_TEST((state.x - by_hand).norm() < 1e-12);
  BOOST_TEST(std::abs(state.x.head(2).norm() - rod.l) < 1e-14);
  BOOST_TEST(std::abs(state.x.head(2).dot(state.x.tail(2))) < 1e-14);
  // v and z at the end are those of S_f: the tension m (v² + g y)/l² at q.
  const double tension =
      (state.x.tail(2).squaredNorm() / rod.m - rod.m * rod.g * state.x[1]) / (rod.l * rod.l);
  BOOST_TEST(std::abs(std::abs(state.z[0]) - std::abs(tension)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(rattle_of_order_8) {
  const Rod rod;
  const auto method = verlet(rod.system(), rod.M, {.x = rod.start()});
  const State from{.x = rod.start()};
  const VectorXd exact = Composition(method, 8).advance(from, 2.0 / 100, 100).x;
  BOOST_TEST(std::abs(order_to(Composition(method, 4), from, 2.0, exact, {12, 16, 24, 32}) - 4.0) <
             0.15);
  BOOST_TEST(std::abs(order_to(Composition(method, 8), from, 2.0, exact, {5, 6, 7, 8}) - 8.0) <
             0.5);
  // Bounded, without a slope: the last tenth is no worse than the first.
  State state = from;
  const auto stepper = Composition(method, 8).stepper();
  double first = 0.0, last = 0.0;
  const double H = rod.energy(state.x);
  for (int k = 0; k < 2000; ++k) {
    stepper->step(state, 0.2);
    const double error = std::abs(rod.energy(state.x) - H);
    if (k < 200) first = std::max(first, error);
    if (k >= 1800) last = std::max(last, error);
  }
  BOOST_TEST(last < 2.0 * first + 1e-13);
  BOOST_TEST(last < 1e-7);
}

// From rest at the horizontal, where the multiplier is 0, with steps of any size.
BOOST_AUTO_TEST_CASE(rattle_from_rest) {
  const Rod rod;
  const VectorXd start = Eigen::Vector4d(rod.l, 0.0, 0.0, 0.0);
  const auto method = verlet(rod.system(), rod.M, {.x = start});
  for (const double h : {0.1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    State state{.x = start};
    VectorXd by_hand = start;
    const auto stepper = method->stepper();
    for (int k = 0; k < 20; ++k) {
      stepper->step(state, k % 2 == 0 ? h : -0.4 * h);
      by_hand = rod.rattle(by_hand, k % 2 == 0 ? h : -0.4 * h);
    }
    BOOST_TEST((state.x - by_hand).norm() < 1e-13, "h = " << h);
  }
}

namespace {

// Two masses in the plane under gravity, q = (a, b), and RATTLE for them with multipliers by Newton's method.
struct TwoMasses {
  bool hangs_together;  // b from a, or both from fixed points
  double g = 0.8;
  Eigen::Vector4d inverse_mass = Eigen::Vector4d(1.0 / 1.3, 1.0 / 1.3, 1.0 / 0.6, 1.0 / 0.6);
  std::shared_ptr<const Euclidean> plane = std::make_shared<Euclidean>(4);
  std::shared_ptr<const CotangentBundle> M = std::make_shared<CotangentBundle>(plane);

  template <class Number>
  Eigen::Matrix<Number, Eigen::Dynamic, 1> constraint(
      const Eigen::Matrix<Number, Eigen::Dynamic, 1>& q) const {
    Number c = hangs_together ? q[2] - q[0] : q[2], d = hangs_together ? q[3] - q[1] : q[3];
    Eigen::Matrix<Number, Eigen::Dynamic, 1> both(2);
    both << 0.5 * (q[0] * q[0] + q[1] * q[1] - 1.0), 0.5 * (c * c + d * d - 0.49);
    return both;
  }
  Eigen::Matrix<double, 2, 4> gradients(const VectorXd& q) const {
    Eigen::Matrix<double, 2, 4> C;
    if (hangs_together)
      C << q[0], q[1], 0, 0, q[0] - q[2], q[1] - q[3], q[2] - q[0], q[3] - q[1];
    else
      C << q[0], q[1], 0, 0, 0, 0, q[2], q[3];
    return C;
  }
  Eigen::Vector4d weight() const { return {0.0, g / inverse_mass[1], 0.0, g / inverse_mass[3]}; }
  std::shared_ptr<const DiracSystem> system() const {
    const auto free = std::make_shared<Hamiltonian>(M, [*this](V x, T) {
      Expr H = 0.0;
      for (Index i = 0; i < 4; ++i)
        H += 0.5 * inverse_mass[i] * square(x[4 + i]) + weight()[i] * x[i];
      return H;
    });
    return std::make_shared<DiracSystem>(
        std::make_shared<CanonicalSymplectic>(M),
        std::make_shared<ConstrainedFamily>(
            free, [*this](V x, V, T) { return constraint<Expr>(x.head(4)); }, 2));
  }
  VectorXd start() const {
    VectorXd x(8);
    x << std::sin(0.7), -std::cos(0.7), 0.7 * std::sin(1.9), -0.7 * std::cos(1.9), 0, 0, 0, 0;
    if (hangs_together) x.segment(2, 2) += x.head(2);
    return x;
  }
  VectorXd rattle(const VectorXd& x, double h) const {
    const Eigen::Vector4d q = x.head(4), p = x.tail(4);
    const Eigen::Matrix<double, 2, 4> C = gradients(q);
    const auto K = inverse_mass.asDiagonal();
    Eigen::Vector2d lambda = Eigen::Vector2d::Zero();
    Eigen::Vector4d middle = p, q1 = q;
    for (int i = 0; i < 50; ++i) {
      middle = p - 0.5 * h * (weight() + C.transpose() * lambda);
      q1 = q + h * (K * middle);
      const Eigen::Matrix2d J = -0.5 * h * h * gradients(q1) * K * C.transpose();
      lambda -= J.inverse() * constraint<double>(q1);
    }
    const Eigen::Matrix<double, 2, 4> D = gradients(q1);
    const Eigen::Vector4d p1 = middle - 0.5 * h * weight();
    VectorXd result(8);
    result << q1, p1 - D.transpose() * (D * K * D.transpose()).inverse() * (D * (K * p1));
    return result;
  }
};

}  // namespace

// Multipliers that one equation gives after the other, and two that belong together.
BOOST_AUTO_TEST_CASE(several_multipliers_are_found_block_by_block) {
  for (const bool hangs_together : {false, true}) {
    const TwoMasses masses{.hangs_together = hangs_together};
    const auto method = verlet(masses.system(), masses.M, {.x = masses.start()});
    State state{.x = masses.start()}, composed = state;
    VectorXd by_hand = state.x, composed_by_hand = state.x;
    const auto stepper = method->stepper(), of_order_4 = Composition(method, 4).stepper();
    for (int k = 0; k < 100; ++k) {
      stepper->step(state, 0.04);
      by_hand = masses.rattle(by_hand, 0.04);
      of_order_4->step(composed, 0.04);
      for (const double part : Composition::coefficients(4))
        composed_by_hand = masses.rattle(composed_by_hand, part * 0.04);
    }
    BOOST_TEST((state.x - by_hand).norm() < 1e-11, "together: " << hangs_together);
    BOOST_TEST((composed.x - composed_by_hand).norm() < 1e-11, "together: " << hangs_together);
    BOOST_TEST(masses.constraint<double>(state.x.head(4)).norm() < 1e-14);
  }
}

// An energy that is not separable, so that momenta are solved for as well.
BOOST_AUTO_TEST_CASE(rattle_of_an_energy_that_is_not_separable) {
  const auto plane = std::make_shared<Euclidean>(2);
  const auto M = std::make_shared<CotangentBundle>(plane);
  const auto free = std::make_shared<Hamiltonian>(
      M, [](V x, T) { return 0.5 * (square(x[2]) + square(x[3])) * (1.0 + 0.2 * x[1]) + x[1]; });
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<ConstrainedFamily>(
          free,
          [](V x, V, T) {
            return ExprVector(ExprVector::Constant(1, 0.5 * (square(x[0]) + square(x[1]) - 1.0)));
          },
          1));
  const VectorXd start =
      Eigen::Vector4d(std::sin(0.6), -std::cos(0.6), 0.3 * std::cos(0.6), 0.3 * std::sin(0.6));
  State state{.x = start};
  const double h = 0.05;
  const auto method = verlet(system, M, {.x = start});
  method->stepper()->step(state, h);
  // By fixed points within a secant method for the multiplier.
  const Eigen::Vector2d q = start.head(2), p = start.tail(2);
  const auto force = [](const Eigen::Vector2d&, const Eigen::Vector2d& m) {
    return Eigen::Vector2d(0.0, -1.0 - 0.1 * m.squaredNorm());
  };
  Eigen::Vector2d middle, q1;
  const auto defect = [&](double lambda) {
    middle = p;
    for (int i = 0; i < 100; ++i) middle = p + 0.5 * h * (force(q, middle) - lambda * q);
    q1 = q;
    for (int i = 0; i < 100; ++i)
      q1 = q + 0.5 * h * ((1.0 + 0.2 * q[1]) + (1.0 + 0.2 * q1[1])) * middle;
    return 0.5 * (q1.squaredNorm() - 1.0);
  };
  double a = 0.0, b = 1.0, at_a = defect(a), at_b = defect(b);
  for (int i = 0; i < 30 && at_b != at_a; ++i) {
    const double c = b - at_b * (b - a) / (at_b - at_a);
    a = b, at_a = at_b, b = c, at_b = defect(c);
  }
  const Eigen::Vector2d free_p1 = middle + 0.5 * h * force(q1, middle);
  BOOST_TEST((state.x.head(2) - q1).norm() < 1e-13);
  BOOST_TEST((state.x.tail(2) - (free_p1 - q1.dot(free_p1) * q1)).norm() < 1e-12);
}

// Two iterations for the multiplier of the first half do, from what is predicted for it.
BOOST_AUTO_TEST_CASE(multipliers_of_steps_along_a_curve_take_two_iterations) {
  const Rod rod;
  const auto method = verlet(rod.system(), rod.M, {.x = rod.start()});
  const auto stepper = method->stepper();
  State state{.x = rod.start()};
  for (int k = 0; k < 50; ++k) stepper->step(state, 0.01);
  const long before = stepper->statistics().iterations;
  for (int k = 0; k < 50; ++k) stepper->step(state, 0.01);
  BOOST_TEST(stepper->statistics().iterations - before == 100);
  BOOST_TEST(stepper->statistics().factorizations == 0);
}

BOOST_AUTO_TEST_CASE(constraints_on_velocities_are_refused) {
  const auto space = std::make_shared<Euclidean>(3);
  const auto M = std::make_shared<CotangentBundle>(space);
  const auto knife = std::make_shared<FormulaSystem>(M, 1, 7, [](V x, V v, V z, T) {
    return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + z[0] * x[1], v[4] + x[1],
                      v[5] - z[0], x[5] - x[1] * x[3]});
  });
  const InitialGuess guess{.x = (VectorXd(6) << 0.3, 0.7, 0.2, 1.0, 0.4, 0.7).finished()};
  BOOST_CHECK_EXCEPTION(
      verlet(knife, M, guess), std::invalid_argument, [](const std::exception& error) {
        return std::string(error.what()).find("on positions alone") != std::string::npos;
      });
}

// The parts of a step, as the account of power wants them: each half has its stage.
BOOST_AUTO_TEST_CASE(parts_are_the_halves) {
  const Kepler kepler{.eccentricity = 0.3};
  const auto method = verlet(kepler);
  for (const bool composed : {false, true}) {
    const auto stepper = composed ? Composition(method, 4).stepper() : method->stepper();
    stepper->tell_parts();
    State state{.x = kepler.at(0.0)};
    stepper->step(state, 0.1);
    stepper->step(state, 0.1);
    const Step& step = stepper->last();
    BOOST_TEST(step.parts.size() == (composed ? 5u : 2u));
    const Step& whole = composed ? step.parts.front() : step;
    BOOST_TEST(whole.parts.size() == 2u);
    const Step &first = whole.parts[0], &second = whole.parts[1];
    BOOST_TEST((first.before.x + first.h * first.stage.v - first.after.x).norm() < 1e-15);
    BOOST_TEST((second.before.x + second.h * second.stage.v - second.after.x).norm() < 1e-15);
    BOOST_TEST((whole.after.x - second.after.x).norm() == 0.0);
    BOOST_TEST((step.parts.back().after.x - step.after.x).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
