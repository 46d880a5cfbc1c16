// The reduced map on the duals of algebras of matrices.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "bracket_defect.hpp"
#include "courant/integrators/maps/group_midpoint.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/reduced_map.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/euler_poincare.hpp"

// Mistakes that these cases have to notice:
//  * the source of the pairs that begin at a point is x₀ τ(v/2) where that is not x₀ τ(-v/2)⁻¹
//    (integrators/maps/group_midpoint.cpp)
BOOST_AUTO_TEST_SUITE(reduced_matrix_groups)

using namespace courant;

namespace {

using V = const ExprVector&;
using T = const Expr&;
using MapPointer = std::shared_ptr<const DiscretizationMap>;

// Neither quadratic nor with a symmetry.
Expr energy_of(V mu, V, T) {
  Expr sum = 0.3 * mu[0] * square(mu[mu.size() - 1]);
  for (Index i = 0; i < mu.size(); ++i) sum += square(mu[i]) / (1.5 + 0.4 * static_cast<double>(i));
  return sum;
}

EulerPoincare problem_of(const MatrixAlgebra& g) {
  return {.algebra = LieAlgebra(g), .hamiltonian = energy_of};
}

std::vector<MapPointer> maps_of(const MatrixAlgebra& g) {
  const auto group = std::make_shared<MatrixGroup>(g);
  return {std::make_shared<Theta>(group), std::make_shared<Theta>(group, 0.3),
          std::make_shared<GroupMidpoint>(group, cayley_map(g)),
          std::make_shared<GroupMidpoint>(group, second_kind_map(g)),
          std::make_shared<Theta>(group->with(second_kind_map(g)), 0.7)};
}

VectorXd start_of(Index n) {
  VectorXd mu(n);
  for (Index i = 0; i < n; ++i) mu[i] = 0.6 * std::cos(1.0 + 1.7 * static_cast<double>(i));
  return mu;
}

using test::bracket_defect;
using test::step;

}  // namespace

BOOST_AUTO_TEST_CASE(are_poisson_maps) {
  for (const MatrixAlgebra& g : {MatrixAlgebra::se2(), MatrixAlgebra::su2(), MatrixAlgebra::sl(2),
                                 MatrixAlgebra::heisenberg(1), MatrixAlgebra::sp(2)}) {
    const auto system = euler_poincare_system(problem_of(g));
    const LiePoisson structure{LieAlgebra(g)};
    const auto maps = maps_of(g);
    for (std::size_t i = 0; i < (g.dimension() > 6 ? 1U : maps.size()); ++i) {
      const ReducedMap method(system, maps[i], {.backend = Backend::interpreter});
      const double defect = bracket_defect(method, structure, start_of(g.dimension()), 0.1, 0.01);
      BOOST_TEST(defect < 1e-12, g.name() << ", " << maps[i]->name() << ": " << defect);
    }
  }
  // The midpoint rule of R³ is none.
  const auto system = euler_poincare_system(problem_of(MatrixAlgebra::sl(2)));
  const DiscretizeFirst midpoint(system, std::make_shared<Theta>(system->manifold()));
  BOOST_TEST(bracket_defect(midpoint, LiePoisson{LieAlgebra(MatrixAlgebra::sl(2))}, start_of(3),
                            0.1, 0.01) > 1e-6);
}

// Casimirs by formulas: the length of the force, that of momenta, the determinant, p_z.
BOOST_AUTO_TEST_CASE(keep_casimirs) {
  using Casimir = std::function<double(const VectorXd&)>;
  const std::vector<std::pair<MatrixAlgebra, Casimir>> cases = {
      {MatrixAlgebra::se2(), [](const VectorXd& x) { return x[1] * x[1] + x[2] * x[2]; }},
      {MatrixAlgebra::su2(), [](const VectorXd& x) { return x.squaredNorm(); }},
      {MatrixAlgebra::sl(2), [](const VectorXd& x) { return x[0] * x[0] / 4.0 + x[1] * x[2]; }},
      {MatrixAlgebra::heisenberg(1), [](const VectorXd& x) { return x[2]; }}};
  for (const auto& [g, casimir] : cases)
    for (const MapPointer& map : maps_of(g)) {
      const ReducedMap method(euler_poincare_system(problem_of(g)), map,
                              {.backend = Backend::interpreter});
      const VectorXd x = start_of(g.dimension());
      const VectorXd end = step(method, x, 0.05, 1000);
      BOOST_TEST(std::fabs(casimir(end) - casimir(x)) < 1e-12, g.name() << ", " << map->name());
      BOOST_TEST((end - x).norm() > 1e-3);
    }
}

// The errors after one unit of time against those of a fourth of the step. With the exponential map θ falls out of what is
// reduced, x τ(-θv) and x τ((1-θ)v) being τ(v) apart: the order is 2, and 1 for θ ≠ ½ only with another map.
BOOST_AUTO_TEST_CASE(have_their_order) {
  for (const MatrixAlgebra& g : {MatrixAlgebra::se2(), MatrixAlgebra::sl(2)}) {
    const auto system = euler_poincare_system(problem_of(g));
    const VectorXd x = start_of(g.dimension());
    const ReducedMap fine(system, maps_of(g).front(), {.backend = Backend::interpreter});
    // Extrapolated from even powers of the step.
    const VectorXd a = step(fine, x, 1.0 / 400, 400), b = step(fine, x, 1.0 / 800, 800);
    const VectorXd reference = b + (b - a) / 3.0;
    const std::vector<MapPointer> maps = maps_of(g);
    for (const MapPointer& map : maps) {
      const ReducedMap method(system, map, {.backend = Backend::interpreter});
      const auto error = [&](long n) {
        return (step(method, x, 1.0 / static_cast<double>(n), n) - reference).norm();
      };
      const double slope = std::log2(error(160) / error(640)) / 2.0;
      const bool is_by_exponential = map == maps[1];
      BOOST_TEST(std::fabs(slope - (is_by_exponential ? 2 : method.order())) < 0.15,
                 g.name() << ", " << map->name() << ": " << slope);
    }
  }
}

// By quaternions and by rotation matrices the body is the same.
BOOST_AUTO_TEST_CASE(quaternions_are_over_rotations) {
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const auto quaternions = std::make_shared<MatrixGroup>(MatrixAlgebra::su2());
  EulerPoincare above = problem_of(MatrixAlgebra::su2()), below = above;
  below.algebra = LieAlgebra::so3();
  above.group = quaternions;
  below.group = rotations;
  const ReducedMap by_q(euler_poincare_system(above), std::make_shared<Theta>(quaternions),
                        {.backend = Backend::interpreter});
  const ReducedMap by_R(euler_poincare_system(below), std::make_shared<Theta>(rotations),
                        {.backend = Backend::interpreter});
  VectorXd x(7), y(12);
  x << start_of(3), *quaternions->unit();
  y << start_of(3), *rotations->unit();
  x = step(by_q, x, 0.1, 200);
  y = step(by_R, y, 0.1, 200);
  BOOST_TEST((x.head(3) - y.head(3)).norm() < 1e-12);
  const double q0 = x[3], q1 = x[4], q2 = x[5], q3 = x[6];
  BOOST_TEST(std::fabs(1.0 - 2.0 * (q2 * q2 + q3 * q3) - y[3]) < 1e-12);
  BOOST_TEST(std::fabs(2.0 * (q1 * q2 - q0 * q3) - y[4]) < 1e-12);
  BOOST_TEST(std::fabs(2.0 * (q1 * q3 + q0 * q2) - y[5]) < 1e-12);
}

// (x, μ) are those of Method 1 on T*G.
BOOST_AUTO_TEST_CASE(are_reductions_of_method_1) {
  const MatrixAlgebra g = MatrixAlgebra::se2();
  for (const MapPointer& map : maps_of(g)) {
    const auto group = map->manifold();
    const auto bundle = std::make_shared<CotangentBundle>(group);
    const auto whole = std::make_shared<DiracSystem>(
        std::make_shared<CanonicalSymplectic>(bundle),
        std::make_shared<Hamiltonian>(
            bundle, [](V x, T t) { return energy_of(x.tail(3), ExprVector(0), t); }));
    EulerPoincare problem = problem_of(g);
    problem.group = group;
    const DiscretizeFirst full(whole, std::make_shared<CotangentLift>(bundle, map),
                               {.backend = Backend::interpreter});
    const ReducedMap method(euler_poincare_system(problem), map, {.backend = Backend::interpreter});
    VectorXd x(9), y(9);
    x << *group->unit(), start_of(3);
    y << start_of(3), *group->unit();
    x = step(full, x, 0.05, 40);
    y = step(method, y, 0.05, 40);
    BOOST_TEST((x.head(6) - y.tail(6)).norm() + (x.tail(3) - y.head(3)).norm() < 1e-12,
               map->name());
  }
}

BOOST_AUTO_TEST_SUITE_END()
