#include "courant/structures/integrability.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "catalogue.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"

// Mistakes that these cases have to notice:
//  * a term of the Courant tensor has the other sign
//  * coordinate fields are taken for constant
//  * points where the rank changes are judged
//  * structures that are not Dirac are judged
BOOST_AUTO_TEST_SUITE(integrability_test)

using namespace courant;

namespace {

// A skew matrix of n × n from its entries above the diagonal, by rows.
MatrixField skew(Index n, std::function<std::vector<Expr>(const ExprVector&)> entries) {
  return [=](const ExprVector& x) {
    ExprMatrix A = ExprMatrix::Zero(n, n);
    const std::vector<Expr> upper = entries(x);
    std::size_t next = 0;
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j) {
        A(i, j) = upper[next++];
        A(j, i) = -A(i, j);
      }
    return A;
  };
}

// A cubic bivector or two-form on R⁴ without any symmetry.
MatrixField wild() {
  return skew(4, [](const ExprVector& x) {
    return std::vector<Expr>{x[2] * x[3], 1.0 + square(x[1]), sin(x[0]) * x[3],
                             exp(x[1]),   x[0] * x[1] * x[2], cos(x[3]) + x[0]};
  });
}

const VectorXd somewhere = VectorXd{{0.3, -0.7, 1.1, 0.4}};

// ∂_k A_ij by central differences of order 4, the independent route.
MatrixXd difference(const MatrixField& field, const VectorXd& x, Index k) {
  const auto at = [&](double s) {
    VectorXd moved = x;
    moved[k] += s;
    return MatrixXd(values(field(constants(moved))));
  };
  const double h = 1e-3;
  return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
}

}  // namespace

// Integrable exactly where it is known to be.
BOOST_AUTO_TEST_CASE(remark_2_6) {
  std::size_t integrable = 0, not_integrable = 0;
  for (const auto& entry : test::structure_catalogue()) BOOST_TEST_CONTEXT(entry.description) {
      if (!entry.structure->is_dirac()) continue;
      std::mt19937 generator(5);
      std::vector<VectorXd> points;
      for (int i = 0; i < 4; ++i)
        points.push_back(entry.structure->manifold()->random_point(generator));
      const IntegrabilitySurvey survey = integrability(*entry.structure, points);
      BOOST_TEST(survey.undefined == 0U);
      BOOST_TEST(survey.integrable() == entry.integrable,
                 "defect " << survey.worst.defect << ", scale " << survey.worst.scale);
      if (!entry.integrable) BOOST_TEST(survey.worst.defect > 1e-3);
      ++(entry.integrable ? integrable : not_integrable);
    }
  BOOST_TEST(integrable > 20U);
  BOOST_TEST(not_integrable >= 8U);
}

// The condition of the graph of ω is dω = 0: on graphs T((X, ω♭X), …) = ± dω(X, Y, Z).
BOOST_AUTO_TEST_CASE(remark_2_6_closedness) {
  const auto M = std::make_shared<Euclidean>(4);
  const AlternatingTensor d = exterior_derivative(*M, wild(), somewhere);
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j)
      for (Index k = 0; k < 4; ++k) {
        const double expected = difference(wild(), somewhere, i)(j, k) +
                                difference(wild(), somewhere, j)(k, i) +
                                difference(wild(), somewhere, k)(i, j);
        BOOST_TEST(std::abs(d(i, j, k) - expected) < 1e-10);
      }
  // The tensor on (e_i, ω♭e_i), whatever basis courant_tensor takes: its norm on R⁴ transformed.
  const Presymplectic D(M, wild());
  const MatrixXd omega = values(wild()(constants(somewhere)));
  const MatrixXd graph_metric = MatrixXd::Identity(4, 4) + omega * omega.transpose();
  const MatrixXd inverse = LuDecomposition(graph_metric).inverse();
  double squared = 0.0;  // |dω|² in the metric of the graph
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j)
      for (Index k = 0; k < 4; ++k)
        for (Index a = 0; a < 4; ++a)
          for (Index b = 0; b < 4; ++b)
            for (Index c = 0; c < 4; ++c)
              squared += d(i, j, k) * d(a, b, c) * inverse(i, a) * inverse(j, b) * inverse(k, c);
  const AlternatingTensor T = courant_tensor(D, somewhere);
  double sum = 0.0;
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j)
      for (Index k = 0; k < 4; ++k) sum += T(i, j, k) * T(i, j, k);
  BOOST_TEST(std::abs(std::sqrt(sum) - std::sqrt(squared)) < 1e-10 * std::sqrt(squared));
}

// The condition of the graph of Λ is the Jacobi identity, [Λ, Λ] = 0.
BOOST_AUTO_TEST_CASE(remark_2_6_jacobi_identity) {
  const Euclidean M(4);
  const AlternatingTensor bracket = schouten_bracket(M, wild(), wild(), somewhere);
  const MatrixXd A = values(wild()(constants(somewhere)));
  const auto nested = [&](Index i, Index j, Index k) {  // {x^i, {x^j, x^k}}
    double sum = 0.0;
    for (Index l = 0; l < 4; ++l) sum += A(i, l) * difference(wild(), somewhere, l)(j, k);
    return sum;
  };
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j)
      for (Index k = 0; k < 4; ++k)
        BOOST_TEST(std::abs(bracket(i, j, k) -
                            2.0 * (nested(i, j, k) + nested(j, k, i) + nested(k, i, j))) < 1e-9);
  BOOST_TEST(bracket.max_abs() > 0.1);
}

// [Λ, M] is symmetric, and [Λ + M, Λ + M] = [Λ, Λ] + 2 [Λ, M] + [M, M].
BOOST_AUTO_TEST_CASE(the_schouten_bracket_is_bilinear) {
  const Euclidean M(4);
  const MatrixField one = wild();
  const MatrixField two = skew(4, [](const ExprVector& x) {
    return std::vector<Expr>{x[0], x[1] * x[3], 2.0, x[2], square(x[0]), x[1]};
  });
  const MatrixField both = [=](const ExprVector& x) { return ExprMatrix(one(x) + two(x)); };
  const auto bracket = [&](const MatrixField& a, const MatrixField& b) {
    return schouten_bracket(M, a, b, somewhere);
  };
  const auto ab = bracket(one, two), ba = bracket(two, one), aa = bracket(one, one),
             bb = bracket(two, two), sum = bracket(both, both);
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j)
      for (Index k = 0; k < 4; ++k) {
        BOOST_TEST(std::abs(ab(i, j, k) - ba(i, j, k)) < 1e-13);
        BOOST_TEST(std::abs(sum(i, j, k) - aa(i, j, k) - 2.0 * ab(i, j, k) - bb(i, j, k)) < 1e-12);
      }
}

// d(dω) = 0 has no room here, but d(df ∧ dg) = 0 does, and df ∧ dg with a factor h is not closed.
BOOST_AUTO_TEST_CASE(exact_forms_are_closed) {
  const Euclidean M(4);
  const auto form = [](bool with_factor) -> MatrixField {
    return [=](const ExprVector& x) {
      // f = x₀ sin x₁ + x₂², g = exp(x₃) x₁
      ExprVector df(4), dg(4);
      df << sin(x[1]), x[0] * cos(x[1]), 2.0 * x[2], Expr(0.0);
      dg << Expr(0.0), exp(x[3]), Expr(0.0), exp(x[3]) * x[1];
      const Expr h = with_factor ? 1.0 + x[0] : Expr(1.0);
      ExprMatrix omega(4, 4);
      for (Index i = 0; i < 4; ++i)
        for (Index j = 0; j < 4; ++j) omega(i, j) = h * (df[i] * dg[j] - df[j] * dg[i]);
      return omega;
    };
  };
  BOOST_TEST(exterior_derivative(M, form(false), somewhere).max_abs() < 1e-14);
  BOOST_TEST(exterior_derivative(M, form(true), somewhere).max_abs() > 0.1);
}

// On SO(3) with ω_ij constant in the left-invariant frame, dω(e₀, e₁, e₂) = -Σ ω([e_i, e_j], e_k)
// = 0 (so(3) is unimodular); with ω = f(R) ε it is the derivative of f along the axis.
BOOST_AUTO_TEST_CASE(on_a_lie_group) {
  const SpecialOrthogonal3 M;
  std::mt19937 generator(2);
  const VectorXd R = M.random_point(generator);
  const MatrixField constant = test::constant_field(MatrixXd{{0, 3, -2}, {-3, 0, 1}, {2, -1, 0}});
  BOOST_TEST(exterior_derivative(M, constant, R).max_abs() < 1e-13);
  const MatrixField axis = [](const ExprVector& R_) {
    ExprMatrix omega = ExprMatrix::Zero(3, 3);
    omega(0, 1) = R_[0];
    omega(1, 0) = -R_[0];
    return omega;
  };
  // R[0] = R_00 along e₂: d/ds (R exp(s ê₂))_00 = R_01.
  const double R01 = R[1];
  BOOST_TEST(std::abs(exterior_derivative(M, axis, R)(0, 1, 2) - R01) < 1e-12);
}

// On SO(3), where frames do not commute: ½[Λ, Λ](df, dg, dh) = {f, {g, h}} + cyclic for any
// functions, with {f, g} = Λ(df, dg) differentiated along the frame.
BOOST_AUTO_TEST_CASE(remark_2_6_jacobi_identity_on_a_lie_group) {
  const SpecialOrthogonal3 M;
  const MatrixField constant = test::constant_field(MatrixXd{{0, 3, -2}, {-3, 0, 1}, {2, -1, 0}});
  const MatrixField varying = [](const ExprVector& R) { return test::hat(R.head(3)); };
  std::mt19937 generator(6);
  const VectorXd R = M.random_point(generator);
  Graph graph;
  const ExprVector at = graph.variables("R", 9);
  const auto number = [&](const Expr& value) {
    return values(substitute(ExprVector(ExprVector::Constant(1, value)), at, constants(R)))[0];
  };
  const auto d = [&](const Expr& f) {
    return ExprVector(M.frame(at).transpose() * gradient(f, at));
  };
  const Expr f = at[0] * at[4], g = square(at[5]) + at[1], h = sin(at[7]);
  MatrixXd differentials(3, 3);
  for (Index i = 0; i < 3; ++i) {
    differentials(0, i) = number(d(f)[i]);
    differentials(1, i) = number(d(g)[i]);
    differentials(2, i) = number(d(h)[i]);
  }
  const double volume = (differentials * M.tangent_basis(R)).determinant();
  for (const MatrixField& lambda : {constant, varying}) {
    const auto bracket = [&](const Expr& a, const Expr& b) {
      return d(a).dot(ExprVector(lambda(at) * d(b)));
    };
    const double jacobiator =
        number(bracket(f, bracket(g, h)) + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g)));
    BOOST_TEST(0.5 * schouten_bracket(M, lambda, lambda, R)(0, 1, 2) * volume == jacobiator,
               boost::test_tools::tolerance(1e-11));
    BOOST_TEST(std::abs(jacobiator) > 1e-2);
  }
}

// Every bivector on a surface is Poisson, and every two-form closed.
BOOST_AUTO_TEST_CASE(in_two_dimensions_everything_is_integrable) {
  const auto S2 = std::make_shared<Sphere>(2);
  const MatrixField field = [](const ExprVector& x) {
    return ExprMatrix((2.0 + x[0] * x[1]) * test::hat(x));
  };
  std::mt19937 generator(4);
  const VectorXd x = S2->random_point(generator);
  BOOST_TEST(integrability(Poisson(S2, field), x).integrable());
  BOOST_TEST(integrability(Presymplectic(S2, field), x).integrable());
}

// F ⊕ F° is integrable if and only if F is involutive: here dμ ∧ μ(∂_x, ∂_y, ∂_z) = c decides.
BOOST_AUTO_TEST_CASE(frobenius) {
  const auto M = std::make_shared<Euclidean>(3);
  for (const double c : {0.0, 1e-3, 1.0}) {
    const auto D = Distribution::annihilated_by(M, 1, [=](const ExprVector& x) {
      ExprMatrix mu(3, 1);
      mu << Expr(-c) * x[1], Expr(0.0), Expr(1.0);
      return mu;
    });
    const Integrability result = integrability(D, VectorXd{{0.2, 0.5, -0.3}});
    BOOST_TEST(result.integrable() == (c == 0.0));
    // The defect is c in the frame (∂_x + c y ∂_z, ∂_y, dz - c y dx), normalised.
    BOOST_TEST(std::abs(result.defect - c / (1.0 + 0.25 * c * c)) < 1e-12);
  }
}

// On R³⁰ one contact plane among 27 constant directions is found by random elements.
BOOST_AUTO_TEST_CASE(in_many_dimensions) {
  const auto M = std::make_shared<Euclidean>(30);
  for (const double c : {0.0, 0.1}) {
    const auto D = Distribution::annihilated_by(M, 1, [=](const ExprVector& x) {
      ExprMatrix mu = ExprMatrix::Zero(30, 1);
      mu(7, 0) = -c * x[11];
      mu(29, 0) = 1.0;
      return mu;
    });
    const Integrability result = integrability(D, VectorXd::Constant(30, 0.3));
    BOOST_TEST(result.undefined.empty());
    BOOST_TEST(result.integrable() == (c == 0.0));
    if (c > 0.0) BOOST_TEST(result.defect > 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(where_it_is_not_defined_it_says_so) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto D = Distribution::annihilated_by(
      line, 1, [](const ExprVector& x) { return ExprMatrix(ExprMatrix::Constant(1, 1, x[0])); });
  const std::vector<VectorXd> points{VectorXd{{0.0}}, VectorXd{{1.0}}};
  BOOST_TEST(!integrability(D, points[0]).integrable());
  BOOST_TEST(integrability(D, points[0]).undefined.find("rank") != std::string::npos);
  const IntegrabilitySurvey survey = integrability(D, points);
  BOOST_TEST(survey.undefined == 1U);
  BOOST_TEST(survey.worst.x == points[1]);
  // Open ports: T is no tensor.
  const OpenPortHamiltonian open(
      line, test::constant_field(MatrixXd::Zero(1, 1)), 1,
      [](const ExprVector& x) { return ExprMatrix(ExprMatrix::Constant(1, 1, x[0])); });
  BOOST_TEST(integrability(open, points[1]).undefined == "D is not Dirac at this point");
  BOOST_TEST(!integrability(open, points[1]).integrable());
}

BOOST_AUTO_TEST_SUITE_END()
