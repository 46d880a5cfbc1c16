#include "courant/manifolds/matrix_group.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "catalogue.hpp"
#include "courant/manifolds/laws.hpp"

// Mistakes that these cases have to notice:
//  * the Stumpff function of the next index in the exponential (manifolds/group_map.cpp)
//  * π/sin φ + g instead of π/sin φ - g in the logarithm of wide angles (manifolds/group_map.cpp)
//  * one halving less than squarings (manifolds/group_map.cpp)
//  * factors of the second kind in the reversed order (manifolds/group_map.cpp)
//  * the adjugate without its signs (core/expressions/linear_algebra.cpp)
//  * the equation of the determinant left out (manifolds/matrix_algebra.cpp)
BOOST_AUTO_TEST_SUITE(matrix_group)

using namespace courant;

namespace {

MatrixXd hat(const MatrixAlgebra& g, const VectorXd& v) {
  MatrixXd V = MatrixXd::Zero(g.size(), g.size());
  for (Index a = 0; a < v.size(); ++a) V += v[a] * g.basis()[static_cast<std::size_t>(a)];
  return V;
}

// The Taylor series of exp at V/2^10, squared ten times in long double.
MatrixXd exponential_series(const MatrixXd& V) {
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Long A = V.cast<long double>() / 1024.0L;
  Long sum = Long::Identity(V.rows(), V.cols()), power = sum;
  for (int k = 1; k < 20; ++k) {
    power = (power * A).eval() / static_cast<long double>(k);
    sum += power;
  }
  for (int k = 0; k < 10; ++k) sum = (sum * sum).eval();
  return sum.cast<double>();
}

VectorXd random_vector(Index n, double length, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return length *
         VectorXd(VectorXd::NullaryExpr(n, [&] { return normal(generator); })).normalized();
}

std::string refusal(const std::function<void()>& make) {
  try {
    make();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

const std::vector<MatrixAlgebra> algebras = {MatrixAlgebra::se2(),         MatrixAlgebra::su2(),
                                             MatrixAlgebra::heisenberg(2), MatrixAlgebra::sl(2),
                                             MatrixAlgebra::sl(3),         MatrixAlgebra::gl(2),
                                             MatrixAlgebra::sp(2),         MatrixAlgebra::galilei(),
                                             test::rotation_matrices(),    test::affine_maps()};

}  // namespace

BOOST_AUTO_TEST_CASE(exponentials_are_those_of_the_series) {
  std::mt19937 generator(1);
  for (const MatrixAlgebra& g : algebras)
    for (const double length : {1e-9, 0.3, 2.0, 4.0}) {
      const VectorXd v = random_vector(g.dimension(), length, generator);
      const MatrixXd expected = exponential_series(hat(g, v));
      const MatrixXd found = values(exponential_map(g).map(constants(v)));
      BOOST_TEST((found - expected).norm() < 1e-14 * (1.0 + expected.squaredNorm()),
                 g.name() << ", length " << length << ": " << (found - expected).norm());
    }
}

// Which algebras have closed formulas, and of which form.
BOOST_AUTO_TEST_CASE(power_laws) {
  const auto law = [](const MatrixAlgebra& g) {
    return g.power_law() ? g.power_law()->k : Index(-1);
  };
  BOOST_TEST(law(MatrixAlgebra::su2()) == 0);
  BOOST_TEST(law(MatrixAlgebra::sl(2)) == 0);
  BOOST_TEST(law(MatrixAlgebra::se2()) == 1);
  BOOST_TEST(law(test::rotation_matrices()) == 1);
  BOOST_TEST(law(MatrixAlgebra::heisenberg(1)) == 1);  // v̂³ = 0
  BOOST_TEST(law(MatrixAlgebra::galilei()) == 3);
  BOOST_TEST(law(MatrixAlgebra::sl(3)) == -1);
  BOOST_TEST(law(MatrixAlgebra::sp(2)) == -1);
  BOOST_TEST(MatrixGroup(MatrixAlgebra::galilei()).has_inverse());
  BOOST_TEST(!MatrixGroup(MatrixAlgebra::sl(3)).has_inverse());
  // Radii: a turn by π, and by 2π of the rotation for quaternions.
  const auto radius = [](const MatrixAlgebra& g) {
    const MatrixGroup G(g);
    return G.injectivity_radius(*G.unit());
  };
  BOOST_TEST(radius(MatrixAlgebra::se2()) == M_PI, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(radius(MatrixAlgebra::su2()) == 2.0 * M_PI, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(radius(MatrixAlgebra::sl(2)) == M_SQRT2 * M_PI, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(std::isinf(radius(MatrixAlgebra::heisenberg(1))));
}

// Just inside a half turn, where the cosine says little; for k ≥ 2 what is lost grows with the third power.
BOOST_AUTO_TEST_CASE(logarithms_of_wide_angles) {
  std::mt19937 generator(2);
  for (const MatrixAlgebra& g : {MatrixAlgebra::se2(), MatrixAlgebra::su2(),
                                 MatrixAlgebra::galilei(), test::rotation_matrices()}) {
    const GroupMap map = exponential_map(g);
    VectorXd v = random_vector(g.dimension(), 1.0, generator);
    for (const double part : {0.4, 0.6, 0.9, 0.999, 0.99999}) {
      const VectorXd w = v * (part / map.extent(v));
      const VectorXd back = values(map.inverse(map.map(constants(w))));
      BOOST_TEST((back - w).norm() <
                     1e-13 * w.norm() / std::pow(1.0 - part, g.power_law()->k < 2 ? 1.5 : 3.0),
                 g.name() << ", " << part << ": " << (back - w).norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(cayley_transforms) {
  std::mt19937 generator(3);
  for (const MatrixAlgebra& g : {MatrixAlgebra::se2(), MatrixAlgebra::su2(), MatrixAlgebra::sl(2),
                                 MatrixAlgebra::sp(2), test::rotation_matrices()}) {
    const VectorXd v = random_vector(g.dimension(), 1.0, generator);
    const MatrixXd V = hat(g, v), one = MatrixXd::Identity(V.rows(), V.cols());
    const MatrixXd found = values(cayley_map(g).map(constants(v)));
    BOOST_TEST(((one - 0.5 * V) * found - (one + 0.5 * V)).norm() < 1e-14 * (1.0 + found.norm()),
               g.name());
  }
  BOOST_TEST(refusal([] {
               cayley_map(MatrixAlgebra::sl(3));
             }).starts_with("cayley_map: the Cayley transform of sl(3) leaves the group"));
}

// On SE(2) exp(ω) exp(u₁) exp(u₂) = (R(ω), R(ω) u).
BOOST_AUTO_TEST_CASE(coordinates_of_the_second_kind) {
  const MatrixGroup G(MatrixAlgebra::se2(), second_kind_map(MatrixAlgebra::se2()));
  const double w = 0.8, a = 0.3, b = -0.5, c = std::cos(w), s = std::sin(w);
  const VectorXd expected{{c, -s, s, c, c * a - s * b, s * a + c * b}};
  BOOST_TEST((G.retract(*G.unit(), VectorXd{{w, a, b}}) - expected).norm() < 1e-15);
}

// Points of SU(2) are quaternions: q τ(v) for v along one axis, and q' = q v/2.
BOOST_AUTO_TEST_CASE(unit_quaternions) {
  const MatrixGroup G(MatrixAlgebra::su2());
  const VectorXd y = G.retract(*G.unit(), VectorXd{{0.0, 0.7, 0.0}});
  BOOST_TEST((y - VectorXd{{std::cos(0.35), 0.0, std::sin(0.35), 0.0}}).norm() < 1e-15);
  // i j = k
  const VectorXd i{{0.0, 1.0, 0.0, 0.0}};
  BOOST_TEST((G.frame(i) * VectorXd{{0.0, 2.0, 0.0}} - VectorXd{{0.0, 0.0, 0.0, 1.0}}).norm() <
             1e-15);
}

BOOST_AUTO_TEST_CASE(what_is_no_algebra_is_refused) {
  const MatrixXd E{{0.0, 1.0}, {0.0, 0.0}}, F{{0.0, 0.0}, {1.0, 0.0}};
  BOOST_TEST(refusal([&] {
               MatrixAlgebra("g", {E, F});
             }) ==
             "MatrixAlgebra: the commutator of the matrices 0 and 1 is 1.41421 away from "
             "the span of the basis; expected an algebra that is closed under brackets.");
  BOOST_TEST(refusal([&] {
               MatrixAlgebra("g", {E, 2.0 * E});
             }).starts_with("MatrixAlgebra: the 2 matrices of the basis are dependent"));
  BOOST_TEST(refusal([&] {
               MatrixAlgebra("g", {E, MatrixXd::Zero(3, 3)});
             }).starts_with("MatrixAlgebra: the basis has 2 matrices; expected"));
  BOOST_TEST(refusal([&] { MatrixAlgebra("g", {}); }) != "");
}

// The diagonal matrices (e^a, e^{-2a}) have none of the equations that are found: x₀² x₃ = 1 has to be given.
BOOST_AUTO_TEST_CASE(equations_that_are_given) {
  const MatrixAlgebra g("g", {MatrixXd{{1.0, 0.0}, {0.0, -2.0}}});
  BOOST_TEST(g.missing_equations() == 1);
  BOOST_TEST(refusal([&] {
               MatrixGroup G(g);
             }).find("of 3 equations of the group 1 is not found; expected it to be given") !=
             std::string::npos);
  const auto equation = [](double value) {
    return [value](const ExprVector& x) {
      return ExprVector(ExprVector::Constant(1, square(x[0]) * x[3] - value));
    };
  };
  const MatrixGroup G(g, exponential_map(g), equation(1.0));
  for (const LawResult& result : check_manifold(G)) BOOST_TEST(result.passed(), result);
  BOOST_TEST(refusal([&] {
               MatrixGroup(g, exponential_map(g), equation(2.0));
             }).find("the equations are off by") != std::string::npos);
}

// A reflection keeps every equation of SO(3).
BOOST_AUTO_TEST_CASE(reflections_are_outside) {
  const MatrixGroup G(test::rotation_matrices());
  VectorXd x = VectorXd::Zero(9);
  x[0] = x[4] = 1.0;
  x[8] = -1.0;
  BOOST_TEST(G.constraint(x).norm() == 0.0);
  BOOST_TEST(std::isinf(G.point_defect(x)));
}

BOOST_AUTO_TEST_SUITE_END()
