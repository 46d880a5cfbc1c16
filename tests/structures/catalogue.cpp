#include "catalogue.hpp"

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/composed.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/gauge_transformed.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/product_structure.hpp"
#include "courant/structures/pullback.hpp"
#include "courant/structures/pushforward.hpp"
#include "courant/structures/restricted_bivector.hpp"
#include "courant/structures/restricted_two_form.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

namespace courant::test {
namespace {

template <class T, class... Arguments>
std::shared_ptr<const T> object(Arguments&&... arguments) {
  return std::make_shared<const T>(std::forward<Arguments>(arguments)...);
}

using ManifoldPointer = std::shared_ptr<const Manifold>;

ManifoldPointer R(Index n) { return object<Euclidean>(n); }

// The canonical bivector of R^{2k}, (q, p); its transpose is the matrix of dq ∧ dp.
MatrixXd canonical(Index k) {
  MatrixXd J = MatrixXd::Zero(2 * k, 2 * k);
  J.topRightCorner(k, k).setIdentity();
  J.bottomLeftCorner(k, k) = -MatrixXd::Identity(k, k);
  return J;
}

// ω = f(x) dx⁰ ∧ dx¹ on Rⁿ.
MatrixField plane_form(Index n, std::function<Expr(const ExprVector&)> f) {
  return [=](const ExprVector& x) {
    ExprMatrix omega = ExprMatrix::Zero(n, n);
    omega(0, 1) = f(x);
    omega(1, 0) = -f(x);
    return omega;
  };
}

// ρ(ξ) = ξ × on R³.
std::vector<MatrixXd> turns_of_space() {
  std::vector<MatrixXd> rho;
  for (Index i = 0; i < 3; ++i) {
    rho.push_back(MatrixXd::Zero(3, 3));
    rho.back()((i + 2) % 3, (i + 1) % 3) = 1.0;
    rho.back()((i + 1) % 3, (i + 2) % 3) = -1.0;
  }
  return rho;
}

// One column.
MatrixField column(std::function<ExprVector(const ExprVector&)> entries) {
  return [=](const ExprVector& x) { return ExprMatrix(entries(x)); };
}

ExprVector vector(std::initializer_list<Expr> entries) {
  ExprVector result(static_cast<Index>(entries.size()));
  std::copy(entries.begin(), entries.end(), result.data());
  return result;
}

// dz - y dx on R³, the contact form.
MatrixField contact() {
  return column([](const ExprVector& x) { return vector({-x[1], 0.0, 1.0}); });
}

// [J B; -Bᵀ 0] with J canonical on R², B = (0, g(q)) and a port coordinate.
StructurePointer with_port(std::function<Expr(const ExprVector&)> g) {
  return object<Poisson>(R(3), [=](const ExprVector& x) {
    ExprMatrix A = ExprMatrix::Zero(3, 3);
    A(0, 1) = 1.0;
    A(1, 0) = -1.0;
    A(1, 2) = g(x);
    A(2, 1) = -g(x);
    return A;
  });
}

std::vector<StructureEntry> make_catalogue() {
  const ManifoldPointer sphere = object<Sphere>(2), rotations = object<SpecialOrthogonal3>();
  // On the sphere α ↦ x × α is the Poisson structure of the area; v ↦ its matrix is the area form.
  const MatrixField area = [](const ExprVector& x) { return hat(x); };
  const auto canonical_of = [](const ManifoldPointer& Q) {
    return object<CanonicalSymplectic>(object<CotangentBundle>(Q));
  };
  const ManifoldPointer plane = R(2), space = R(3);
  const auto symplectic_plane = object<Poisson>(plane, constant_field(canonical(1)));
  const SmoothMap inclusion(sphere, space, [](const ExprVector& x) { return x; });
  const auto ball = object<LiePoisson>(LieAlgebra::so3(), space);
  const auto volume_part = object<Presymplectic>(space, [](const ExprVector& x) { return hat(x); });
  // (x, y) ↦ (x, y + x²) and back.
  const SmoothMap shear(plane, plane, [](const ExprVector& x) {
    return vector({x[0], x[1] + square(x[0])});
  });
  const SmoothMap unshear(plane, plane, [](const ExprVector& x) {
    return vector({x[0], x[1] - square(x[0])});
  });
  const MatrixXd J4 = canonical(2);
  return {
      {"canonical on T*R²", canonical_of(plane), true, 4},
      {"canonical on T*S²", canonical_of(sphere), true, 4},
      {"canonical on T*SO(3)", canonical_of(rotations), true, 6},
      {"canonical on a point", canonical_of(R(0)), true, 0},
      {"ω = 0 on R¹", object<Presymplectic>(R(1), constant_field(MatrixXd::Zero(1, 1))), true, 1},
      {"(1+x²) dx∧dy on R³",
       object<Presymplectic>(space,
                             plane_form(3, [](const ExprVector& x) { return 1.0 + square(x[0]); })),
       true, 3},
      {"z dx∧dy on R³, not closed",
       object<Presymplectic>(space, plane_form(3, [](const ExprVector& x) { return x[2]; })), false,
       3},
      {"area form on S²", object<Presymplectic>(sphere, area), true, 2},
      {"Σ x_i e_j∧e_k on SO(3), not closed",
       object<Presymplectic>(rotations,
                             [](const ExprVector& R) {
                               return hat(vector({R[0], R[3], R[6]}));
                             }),
       false, 3},
      {"bivector of the area on S²", object<Poisson>(sphere, area), true, 2},
      {"Λ constant on R³",
       object<Poisson>(space, plane_form(3, [](const ExprVector&) { return 1.0; })), true, 2},
      {"Λ = ∂_x∧(∂_y + x ∂_z), not Poisson",
       object<Poisson>(space,
                       [](const ExprVector& x) {
                         ExprMatrix A = ExprMatrix::Zero(3, 3);
                         A(0, 1) = 1.0;
                         A(1, 0) = -1.0;
                         A(0, 2) = x[0] * x[1];
                         A(2, 0) = -A(0, 2);
                         A(1, 2) = x[2];
                         A(2, 1) = -x[2];
                         return A;
                       }),
       false, 2},
      {"Lotka–Volterra bivector",
       object<Poisson>(plane, plane_form(2, [](const ExprVector& x) { return x[0] * x[1]; })), true,
       2},
      {"so(3)*", object<LiePoisson>(LieAlgebra::so3()), true, 2},
      {"so(3)*, plus", object<LiePoisson>(LieAlgebra::so3(), LiePoisson::Sign::plus), true, 2},
      {"se(3)*", object<LiePoisson>(LieAlgebra::se3()), true, 4},
      {"so(4)*", object<LiePoisson>(LieAlgebra::so(4)), true, 4},
      {"T*SO(3), trivialised",
       object<LiePoisson>(LieAlgebra::so3(), std::vector<MatrixXd>(), LiePoisson::Sign::minus,
                          rotations),
       true, 6},
      {"T*SO(3) × R³*, trivialised",
       object<LiePoisson>(LieAlgebra::so3(), turns_of_space(), LiePoisson::Sign::minus, rotations),
       true, 6},
      {"abelian", object<LiePoisson>(LieAlgebra::abelian(2)), true, 0},
      {"contact planes, not involutive",
       object<Distribution>(Distribution::annihilated_by(space, 1, contact())), false, 2},
      {"planes z = const",
       object<Distribution>(
           Distribution::annihilated_by(space, 1, column([](const ExprVector& x) {
                                          return vector({0.0, 0.0, 1.0 + square(x[0])});
                                        }))),
       true, 2},
      {"contact planes by fields",
       object<Distribution>(Distribution::spanned_by(space, 2,
                                                     [](const ExprVector& x) {
                                                       ExprMatrix X = ExprMatrix::Zero(3, 2);
                                                       X(0, 0) = 1.0;
                                                       X(2, 0) = x[1];
                                                       X(1, 1) = 1.0;
                                                       return X;
                                                     })),
       false, 2},
      {"the zero distribution",
       object<Distribution>(
           Distribution::spanned_by(plane, 0, constant_field(MatrixXd::Zero(2, 0)))),
       true, 0},
      {"a left-invariant plane field on SO(3), not involutive",
       object<Distribution>(Distribution::annihilated_by(
           rotations, 1, constant_field(MatrixXd{{0.0}, {0.0}, {1.0}}))),
       false, 2},
      {"a left-invariant line field on SO(3)",
       object<Distribution>(
           Distribution::spanned_by(rotations, 1, constant_field(MatrixXd{{0.0}, {0.6}, {0.8}}))),
       true, 1},
      {"circles of latitude on S²",
       object<Distribution>(Distribution::annihilated_by(
           sphere, 1, column([](const ExprVector& x) {
             return vector({-x[0] * x[2], -x[1] * x[2], 1.0 - square(x[2])});
           }))),
       true, 1},
      {"dq∧dp on a nonholonomic distribution of T*R²",
       object<RestrictedTwoForm>(R(4), constant_field(J4), 1, column([](const ExprVector& x) {
                                   return vector({-sin(x[1]), cos(x[1]), 0.0, 0.0});
                                 })),
       true, 3},
      {"dq∧dp on contact directions of T*R³",
       object<RestrictedTwoForm>(R(6), constant_field(canonical(3)), 1,
                                 column([](const ExprVector& x) {
                                   return vector({-x[1], 0.0, 1.0, 0.0, 0.0, 0.0});
                                 })),
       false, 5},
      {"area form on circles of S²",
       object<RestrictedTwoForm>(sphere, area, 1, column([](const ExprVector& x) {
                                   return vector({-x[0] * x[2], -x[1] * x[2], 1.0 - square(x[2])});
                                 })),
       true, 1},
      {"canonical bivector on p₂ = const",
       object<RestrictedBivector>(R(4), constant_field(J4), 1,
                                  constant_field(MatrixXd{{0.0}, {0.0}, {0.0}, {1.0}})),
       true, 3},
      {"canonical bivector, contact fields",
       object<RestrictedBivector>(R(6), constant_field(canonical(3)), 1,
                                  column([](const ExprVector& x) {
                                    return vector({0.0, 0.0, 0.0, -x[1], 0.0, 1.0});
                                  })),
       false, 5},
      {"open port-Hamiltonian",
       object<OpenPortHamiltonian>(R(2), constant_field(canonical(1)), 1,
                                   constant_field(MatrixXd{{0.0}, {1.0}})),
       false, 2},
      {"open without ports",
       object<OpenPortHamiltonian>(R(2), constant_field(canonical(1)), 0,
                                   constant_field(MatrixXd::Zero(2, 0))),
       true, 2},
      {"closed port-Hamiltonian",
       object<ClosedPortHamiltonian>(R(4), constant_field(J4), 1, column([](const ExprVector& x) {
                                       return vector({0.0, 0.0, -sin(x[1]), cos(x[1])});
                                     })),
       true, 3},
      {"so(3)* gauged by a closed form",
       object<GaugeTransformed>(ball, plane_form(3, [](const ExprVector& x) { return x[0]; })),
       true, 2},
      {"canonical gauged by a form that is not closed",
       object<GaugeTransformed>(object<Poisson>(R(4), constant_field(J4)),
                                plane_form(4, [](const ExprVector& x) { return x[2]; })),
       false, 4},
      {"T*S² × so(3)*",
       object<ProductStructure>(std::vector<StructurePointer>{canonical_of(sphere), ball}), true,
       6},
      {"the empty product", object<ProductStructure>(std::vector<StructurePointer>{}), true, 0},
      {"two oscillators with a common port",
       object<Composed>(with_port([](const ExprVector&) { return 1.0; }), plane,
                        with_port([](const ExprVector& x) { return 2.0 + sin(x[0]); }), plane, 1),
       true, 3},
      {"two conservation laws on two cells",
       object<StokesDirac>(object<CellComplex>(CellComplex::interval(1.0, 2)), 0), true, 6},
      {"dx form pulled back to S²", object<Pullback>(inclusion, volume_part), true, 2},
      {"so(3)* pulled back to S²", object<Pullback>(inclusion, ball), true, 2},
      {"the plane pushed forward by a shear", object<Pushforward>(shear, unshear, symplectic_plane),
       true, 2},
  };
}

}  // namespace

const std::vector<StructureEntry>& structure_catalogue() {
  static const std::vector<StructureEntry> catalogue = make_catalogue();
  return catalogue;
}

ExprMatrix hat(const ExprVector& a) {
  ExprMatrix result(3, 3);
  result << Expr(0.0), -a[2], a[1], a[2], Expr(0.0), -a[0], -a[1], a[0], Expr(0.0);
  return result;
}

MatrixField constant_field(const MatrixXd& matrix) {
  return [matrix](const ExprVector&) { return ExprMatrix(constants(matrix)); };
}

}  // namespace courant::test
