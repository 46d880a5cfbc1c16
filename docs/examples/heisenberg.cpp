// The code of docs/tutorial-new-manifold.md: the Heisenberg group as a manifold.
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/laws.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

using namespace courant;

// (a, b, c)(a', b', c') = (a + a', b + b', c + c' + (a b' - b a')/2)
ExprVector product_of(const ExprVector& x, const ExprVector& y) {
  ExprVector result = x + y;
  result[2] += (x[0] * y[1] - x[1] * y[0]) / 2.0;
  return result;
}

// R_x(v) = x exp(v), and the rest as if the group were R³.
class FirstAttempt : public Manifold {
 public:
  FirstAttempt() : Manifold("Heisenberg", 3, 3, 3) {}

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return product_of(x, v);
  }
  ExprMatrix do_frame(const ExprVector&) const override { return ExprMatrix::Identity(3, 3); }
  ExprMatrix do_coframe(const ExprVector&) const override { return ExprMatrix::Identity(3, 3); }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return y - x;
  }
};

class SecondAttempt : public FirstAttempt {
  ExprMatrix do_frame(const ExprVector& x) const override {
    ExprMatrix E = ExprMatrix::Identity(3, 3);
    E.row(2) << -x[1] / 2.0, x[0] / 2.0, 1.0;
    return E;
  }
};

class ThirdAttempt : public SecondAttempt {
  ExprMatrix do_coframe(const ExprVector& x) const override {
    ExprMatrix C = ExprMatrix::Identity(3, 3);
    C.row(2) << x[1] / 2.0, -x[0] / 2.0, 1.0;
    return C;
  }
};

class Heisenberg final : public Manifold {
 public:
  Heisenberg() : Manifold("Heisenberg", 3, 3, 3) {}
  bool is_geodesic() const override { return true; }

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return product_of(x, v);
  }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return product_of(-x, y);
  }
  ExprMatrix do_frame(const ExprVector& x) const override {
    ExprMatrix E = ExprMatrix::Identity(3, 3);
    E.row(2) << -x[1] / 2.0, x[0] / 2.0, 1.0;
    return E;
  }
  ExprMatrix do_coframe(const ExprVector& x) const override {
    ExprMatrix C = ExprMatrix::Identity(3, 3);
    C.row(2) << x[1] / 2.0, -x[0] / 2.0, 1.0;
    return C;
  }
};

// Prints the laws that fail; returns how many.
int report(const std::string& title, const std::vector<LawResult>& results) {
  int failed = 0;
  std::cout << title << ":\n";
  for (const LawResult& result : results) {
    if (result.passed()) continue;
    ++failed;
    std::cout << "  broken: " << result.law << '\n';
  }
  if (failed == 0) std::cout << "  every law holds\n";
  return failed;
}

// How far the plane curve of a geodesic is from closing after one turn, and its height from the
// area that it encloses.
double geodesic_error(double step_count) {
  const auto group = std::make_shared<Heisenberg>();
  const auto phase_space = std::make_shared<CotangentBundle>(group);
  const auto energy = [](const ExprVector& x, const Expr&) {
    return (square(x[3]) + square(x[4])) / 2.0;  // x = (a, b, c, p_0, p_1, p_2)
  };
  const auto system =
      std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                    std::make_shared<Hamiltonian>(phase_space, energy));
  const auto map = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(group));
  const DiscretizeFirst method(system, map);

  const double period = 2.0 * std::numbers::pi;  // p_2 = 1: the plane curve is a circle of radius 1
  const VectorXd start = (VectorXd(6) << 0, 0, 0, 1, 0, 1).finished();
  const VectorXd end = method.advance({.x = start}, period / step_count, step_count).x;
  return std::hypot(end[0], end[1]) + std::abs(std::abs(end[2]) - std::numbers::pi);
}

int main() {
  const int first = report("first attempt", check_manifold(FirstAttempt()));
  const int second = report("with its frame", check_manifold(SecondAttempt()));
  const int third = report("with its coframe", check_manifold(ThirdAttempt()));
  const int last = report("with its inverse", check_manifold(Heisenberg()));

  const auto group = std::make_shared<Heisenberg>();
  const auto midpoint = std::make_shared<Theta>(group);
  const CotangentLift lift(std::make_shared<CotangentBundle>(group), midpoint);
  const int map = report("midpoint map", check_discretization_map(*midpoint));
  const int lifted = report("its cotangent lift", check_cotangent_lift(lift));

  const double ratio = geodesic_error(200) / geodesic_error(400);
  std::cout << "error of a geodesic, 200 steps to 400: " << std::round(ratio) << " to 1\n";
  const bool as_told = first > 0 && second > 0 && third > 0 && last + map + lifted == 0;
  return as_told && std::abs(ratio - 4.0) < 0.2 ? 0 : 1;
}
