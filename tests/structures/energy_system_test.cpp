#include "courant/structures/energy_system.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

BOOST_AUTO_TEST_SUITE(energy_system_test)

using namespace courant;

namespace {

using V = const ExprVector&;
using T = const Expr&;

class Numbers {
 public:
  VectorXd operator()(Index size) {
    return VectorXd::NullaryExpr(size, [&] { return normal_(generator_); });
  }

 private:
  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
};

double sum(const std::vector<PortPower>& ports) {
  double total = 0.0;
  for (const PortPower& port : ports) total += port.power.value();
  return total;
}

// The v that the first equations, which are affine in v with a regular matrix, have for the rest.
VectorXd velocity(const EnergySystem& system, const VectorXd& x, const VectorXd& alpha,
                  const VectorXd& z, double t) {
  const Index n = system.manifold()->tangent_dimension();
  Graph graph;
  const ExprVector v = graph.variables("v", n);
  const ExprVector F =
      system.equations(constants(x), v, constants(alpha), constants(z), t, constants(x), t);
  const ExprVector first = F.head(n);
  const MatrixXd A = values(jacobian(first, v).dense());
  const VectorXd b = values(substitute(first, v, ExprVector::Zero(n)));
  return LuDecomposition(A).solve(-b);
}

// ⟨α, v⟩ - Σ supplied + Σ dissipated.
double defect(const EnergySystem& system, const VectorXd& x, const VectorXd& v,
              const VectorXd& alpha, const VectorXd& z, double t) {
  const EnergySystem::Powers powers =
      system.powers(constants(x), constants(v), constants(alpha), constants(z), Expr(t));
  return alpha.dot(v) - sum(powers.supplied) + sum(powers.dissipated);
}

}  // namespace

// For any covector in the place of dH, and any u.
BOOST_AUTO_TEST_CASE(port_hamiltonian_systems_balance_any_effort) {
  const auto space = std::make_shared<Euclidean>(3);
  const auto J = [](V x) {
    ExprMatrix A = ExprMatrix::Zero(3, 3);
    A(0, 1) = x[2];
    A(1, 0) = -x[2];
    return A;
  };
  const auto R = [](V x) { return ExprMatrix(ExprVector(x) * ExprVector(x).transpose().eval()); };
  const auto B = [](V x) {
    ExprMatrix columns(3, 2);
    columns << x[0], Expr(1.0), Expr(0.3), x[1], Expr(-1.0), x[2];
    return columns;
  };
  const auto D = [](V x) {
    ExprMatrix A(2, 2);
    A << Expr(0.4), x[0], -x[0], Expr(0.1);
    return A;
  };
  const PortHamiltonianSystem system(
      {J, R, B, 2, D},
      std::make_shared<Hamiltonian>(space, [](V x, T) { return cosh(x[0]) * x[1] + x[2]; }),
      std::nullopt);
  Numbers random;
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd x = random(3), alpha = random(3), u = random(2);
    const VectorXd v = velocity(system, x, alpha, u, 0.0);
    BOOST_TEST(std::abs(defect(system, x, v, alpha, u, 0.0)) < 1e-13);
    BOOST_TEST(std::abs(defect(system, x, v, alpha + VectorXd::Unit(3, 0), u, 0.0)) > 1e-6);
  }
  // With dH in its place the equations are those of the system.
  const VectorXd x = random(3), v = random(3), u = random(2);
  const ExprVector dH = system.effort(constants(x), constants(u), 0.0);
  BOOST_TEST((values(system.equations(constants(x), constants(v), dH, constants(u), 0.0,
                                      constants(x), 0.0)) -
              system.residual(x, v, u, 0.0))
                 .norm() == 0.0);
}

// Sources and reactions of a Dirac system, and ports that its structure leaves open.
BOOST_AUTO_TEST_CASE(dirac_systems_balance_any_effort) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto H = std::make_shared<Hamiltonian>(M, [](V x, T) { return x.squaredNorm(); });
  const DiracSystem pushed(
      std::make_shared<CanonicalSymplectic>(M), H,
      {.source =
           [](V x, V v, V alpha, T t) {
             ExprVector e(8);
             e << ExprVector(0.3 * alpha), x[0] * v[1], -v[0], sin(t), x[1];
             return e;
           },
       .constraint =
           [](V x, V v, V, T t) {
             return ExprVector(ExprVector::Constant(1, v[0] - x[1] * v[1] + t));
           },
       .constraint_count = 1});
  const auto space = std::make_shared<Euclidean>(2);
  const DiracSystem open(std::make_shared<OpenPortHamiltonian>(
                             space,
                             [](V x) {
                               ExprMatrix A = ExprMatrix::Zero(2, 2);
                               A(0, 1) = x[0];
                               A(1, 0) = -x[0];
                               return A;
                             },
                             1,
                             [](V x) {
                               ExprMatrix column(2, 1);
                               column << Expr(1.0), x[1];
                               return column;
                             }),
                         std::make_shared<Hamiltonian>(space, [](V x, T) { return x[0]; }));
  Numbers random;
  for (int trial = 0; trial < 10; ++trial) {
    for (const DiracSystem* system : {&pushed, &open}) {
      const Index n = system->manifold()->dimension();
      const VectorXd x = random(n), alpha = random(n), z = random(system->auxiliary_size());
      const VectorXd v = velocity(*system, x, alpha, z, 0.7);
      BOOST_TEST(std::abs(defect(*system, x, v, alpha, z, 0.7)) < 1e-12 * (1.0 + v.norm()));
    }
  }
}

// ∂E/∂λ is asked for at another point than the rest.
BOOST_AUTO_TEST_CASE(constraints_have_a_point_of_their_own) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto family = std::make_shared<ConstrainedFamily>(
      std::make_shared<Hamiltonian>(M, [](V x, T) { return square(x[1]); }),
      [](V x, V, T t) { return ExprVector(ExprVector::Constant(1, x[0] - t)); }, 1);
  const DiracSystem system(std::make_shared<CanonicalSymplectic>(M), family);
  const VectorXd zero = VectorXd::Zero(2), end = VectorXd{{5.0, 0.0}};
  const VectorXd F =
      values(system.equations(constants(zero), constants(zero), constants(zero),
                              constants(VectorXd::Zero(1)), 0.0, constants(end), 2.0));
  BOOST_TEST((F - VectorXd{{0.0, 0.0, 3.0}}).norm() == 0.0);
}

// H, and H + λφ, are energies; velocities and squares of multipliers make none.
BOOST_AUTO_TEST_CASE(which_energies_are_explicit) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto D = std::make_shared<CanonicalSymplectic>(M);
  const auto H = std::make_shared<Hamiltonian>(M, [](V x, T) { return square(x[1]); });
  const auto L = std::make_shared<Lagrangian>(M, [](V, V w, T) { return square(w[0]); });
  const auto phi = [](V x, V, T) { return ExprVector(ExprVector::Constant(1, x[0])); };
  BOOST_TEST(DiracSystem(D, H).has_explicit_energy());
  BOOST_TEST(DiracSystem(D, std::make_shared<ConstrainedFamily>(H, phi, 1)).has_explicit_energy());
  BOOST_TEST(!DiracSystem(D, L).has_explicit_energy());
  BOOST_TEST(!DiracSystem(D, std::make_shared<ConstrainedFamily>(L, phi, 1)).has_explicit_energy());
}

BOOST_AUTO_TEST_SUITE_END()
