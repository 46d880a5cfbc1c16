#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/structures/kirchhoff_laws.hpp"
#include "courant/structures/laws.hpp"
#include "courant/structures/stokes_dirac/cell_complex_laws.hpp"
#include "meshes.hpp"

// Mistakes that these cases have to notice:
//  * inputs that are efforts have the wrong sign (structures/stokes_dirac/stokes_dirac.cpp)
//  * flows enter at the wrong cells (structures/stokes_dirac/stokes_dirac.cpp)
//  * K1 does not see a sign (structures/kirchhoff_laws.cpp)
//  * duals of cells are those of the middle of the mesh (structures/stokes_dirac/cell_complex.cpp)
BOOST_AUTO_TEST_SUITE(stokes_dirac_test)

using namespace courant;
using namespace courant::test;

namespace {

using ComplexPointer = std::shared_ptr<const CellComplex>;

ComplexPointer shared(CellComplex complex) {
  return std::make_shared<const CellComplex>(std::move(complex));
}

// Some of the k-cells of the boundary.
std::vector<Index> some_boundary(const CellComplex& K, Index k, std::mt19937& generator) {
  std::vector<Index> cells;
  for (const Index cell : K.cells_of(k, K.boundary()))
    if (generator() % 2 == 0) cells.push_back(cell);
  return cells;
}

std::vector<StokesDirac> structures() {
  std::mt19937 generator(7);
  std::vector<StokesDirac> all;
  const std::vector<ComplexPointer> complexes{
      shared(CellComplex::grid({random_lines(3, generator)})),
      shared(CellComplex::grid({random_lines(2, generator), random_lines(2, generator)})),
      shared(CellComplex::box({1.0, 1.0, 1.0}, {1, 2, 1})),
      shared(triangle(2)),
      shared(two_tetrahedra()),
      shared(CellComplex::graph(4, {{0, 1}, {2, 1}, {1, 3}}, VectorXd{{1.0, 2.0, 0.5}}))};
  for (const ComplexPointer& K : complexes)
    for (Index k = 0; k < K->dimension(); ++k) {
      all.emplace_back(K, k);
      all.emplace_back(K, k, some_boundary(*K, k, generator));
    }
  return all;
}

// ω² of the modes: of M_p⁻¹ d_Iᵀ ⋆ d_I, increasing.
VectorXd squared_frequencies(const StokesDirac& D) {
  const Index p = D.p_count(), q = D.q_count(), k = D.degree();
  VectorXd mass(p);
  for (Index i = 0; i < p; ++i) {
    const Index cell = D.p_cells()[static_cast<std::size_t>(i)];
    mass[i] = D.complex()->dual_measures(k)[cell] / D.complex()->measures(k)[cell];
  }
  const VectorXd star =
      D.complex()->dual_measures(k + 1).cwiseQuotient(D.complex()->measures(k + 1));
  const MatrixXd d = MatrixXd(D.J()).bottomLeftCorner(q, p);
  const VectorXd root = mass.cwiseSqrt().cwiseInverse();
  return symmetric_eigenvalues(root.asDiagonal() * (d.transpose() * star.asDiagonal() * d) *
                               root.asDiagonal());
}

// The least-squares slope of log |error| over log size.
double slope(const std::vector<double>& sizes, const std::vector<double>& errors) {
  const auto n = static_cast<double>(sizes.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double a = std::log(sizes[i]), b = std::log(std::abs(errors[i]));
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

// The order of the frequency of a mode that is the nearest to the exact one.
double order_of(const std::vector<Index>& counts, double exact,
                const std::function<StokesDirac(Index)>& make) {
  std::vector<double> sizes, errors;
  for (const Index count : counts) {
    const VectorXd all = squared_frequencies(make(count));
    Index nearest = 0;
    (all.array() - exact).abs().minCoeff(&nearest);
    sizes.push_back(1.0 / static_cast<double>(count));
    errors.push_back(all[nearest] - exact);
  }
  return slope(sizes, errors);
}

std::vector<Index> boundary_cells(const CellComplex& K, Index k) {
  return K.cells_of(k, K.boundary());
}

const double pi = std::acos(-1.0);

}  // namespace

BOOST_AUTO_TEST_CASE(laws) {
  for (const StokesDirac& D : structures()) {
    for (const LawResult& law : check_structure(D)) BOOST_TEST(law.passed(), law);
    for (const LawResult& law : check_stokes_dirac(D)) BOOST_TEST(law.passed(), law);
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_sign_is_seen) {
  const StokesDirac D(shared(CellComplex::interval(1.0, 3)), 0);
  auto kernel = D.kernel_representation();
  kernel.E.coeffRef(0, D.p_count()) *= -1.0;
  const auto laws = check_sparse_dirac("wrong", kernel, D.hybrid_representation());
  BOOST_TEST(!laws[0].passed());
  BOOST_TEST(!laws[3].passed());
}

// An interval of two cells with the effort of its left end as input: by hand.
BOOST_AUTO_TEST_CASE(two_cells) {
  const StokesDirac D(shared(CellComplex::interval(1.0, 2)), 0, {0});
  BOOST_TEST((D.p_cells() == std::vector<Index>{1, 2}));
  BOOST_TEST((D.flow_cells() == std::vector<Index>{2}));
  const VectorXd V{{3.0, 5.0}}, I{{7.0, 11.0}};
  const double inflow = 13.0, left = 17.0;
  VectorXd alpha(4);
  alpha << V, I;
  const VectorXd v = D.J() * alpha + D.B() * VectorXd{{inflow, left}},
                 y = D.B().transpose() * alpha;
  BOOST_TEST((v - VectorXd{{7.0 - 11.0, 11.0 + inflow, -(3.0 - left), -(5.0 - 3.0)}}).norm() ==
             0.0);
  BOOST_TEST((y - VectorXd{{5.0, 7.0}}).norm() == 0.0);
}

// The power balance by Stokes' theorem for any efforts: the power of the cells is that of the boundary.
BOOST_AUTO_TEST_CASE(power_balance) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  for (const StokesDirac& D : structures()) {
    const Index N = D.state_count(), b = D.boundary_count();
    const VectorXd alpha = VectorXd::NullaryExpr(N, [&] { return normal(generator); }),
                   u = VectorXd::NullaryExpr(b, [&] { return normal(generator); });
    // The k-form e_p with the inputs in its place on Γ, d e_p, and dᵀ e_q cell by cell.
    VectorXd e = VectorXd::Zero(D.complex()->count(D.degree()));
    for (Index i = 0; i < D.p_count(); ++i) e[D.p_cells()[static_cast<std::size_t>(i)]] = alpha[i];
    const Index flows = std::ssize(D.flow_cells());
    for (Index i = flows; i < b; ++i)
      e[D.effort_cells()[static_cast<std::size_t>(i - flows)]] = u[i];
    const SparseMatrixXd& d = D.complex()->coboundary(D.degree());
    const VectorXd e_q = alpha.tail(D.q_count()), rate_q = -(d * e), into = d.transpose() * e_q;
    VectorXd rate_p = into;
    double power = 0.0;
    for (Index i = 0; i < flows; ++i) {
      const Index cell = D.flow_cells()[static_cast<std::size_t>(i)];
      rate_p[cell] += u[i];
      power += u[i] * e[cell];
    }
    for (Index i = flows; i < b; ++i)
      power -= u[i] * into[D.effort_cells()[static_cast<std::size_t>(i - flows)]];
    const VectorXd v = D.J() * alpha + D.B() * u;
    for (Index i = 0; i < D.p_count(); ++i)
      BOOST_TEST(std::abs(v[i] - rate_p[D.p_cells()[static_cast<std::size_t>(i)]]) < 1e-13);
    BOOST_TEST((v.tail(D.q_count()) - rate_q).norm() < 1e-13);
    BOOST_TEST(std::abs(alpha.dot(v) - power) < 1e-12 * (1.0 + alpha.cwiseProduct(v).norm()));
    BOOST_TEST(std::abs(u.dot(D.B().transpose() * alpha) - power) < 1e-12 * (1.0 + u.norm()));
  }
}

// Modes with closed forms converge with order 2 in the size of the cells.
BOOST_AUTO_TEST_CASE(order_of_modes) {
  // A string that is held at one end, its second mode.
  const double string = order_of({8, 16, 32, 64}, 2.25 * pi * pi, [](Index n) {
    return StokesDirac(shared(CellComplex::interval(1.0, n)), 0, {0});
  });
  BOOST_TEST(std::abs(string - 2.0) < 0.15);
  // Electric and magnetic modes of a plane cavity: E = 0 on the walls, and curl E with the tangent of E 0 there.
  const auto plane = [](Index n) { return shared(CellComplex::rectangle(1.0, 0.75, n, n)); };
  const double tm = order_of({4, 6, 8, 12}, pi * pi * (1.0 + 16.0 / 9.0), [&](Index n) {
    const auto K = plane(n);
    return StokesDirac(K, 0, boundary_cells(*K, 0));
  });
  BOOST_TEST(std::abs(tm - 2.0) < 0.15);
  const double te = order_of({4, 6, 8, 10}, pi * pi, [&](Index n) {
    const auto K = plane(n);
    return StokesDirac(K, 1, boundary_cells(*K, 1));
  });
  BOOST_TEST(std::abs(te - 2.0) < 0.15);
  // The lowest mode of a box, which has no E_x.
  const double box = order_of({3, 4, 5, 6}, pi * pi * (1.0 + 1.0 / 0.64), [](Index n) {
    const auto K = shared(CellComplex::box({1.0, 0.8, 0.3}, {n, n, 2}));
    return StokesDirac(K, 1, boundary_cells(*K, 1));
  });
  BOOST_TEST(std::abs(box - 2.0) < 0.15);
  // An equilateral triangle with side 1 that is held at its edge: ω² = 16 π²/3 (Lamé).
  const double drum = order_of({6, 9, 12, 18}, 16.0 * pi * pi / 3.0, [](Index n) {
    const auto K = shared(triangle(n));
    return StokesDirac(K, 0, boundary_cells(*K, 0));
  });
  BOOST_TEST(std::abs(drum - 2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(refused) {
  const auto K = shared(CellComplex::interval(1.0, 3));
  BOOST_CHECK_THROW(StokesDirac(nullptr, 0), std::invalid_argument);
  BOOST_CHECK_THROW(StokesDirac(K, 1), std::invalid_argument);
  BOOST_CHECK_THROW(StokesDirac(K, 0, {1}), std::invalid_argument);
  BOOST_CHECK_THROW(StokesDirac(K, 0, {0, 0}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
