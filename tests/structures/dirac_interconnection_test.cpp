#include "courant/structures/dirac_interconnection.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numeric>
#include <random>
#include <vector>

#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(dirac_interconnection_test)

namespace {

constexpr double tolerance = 1e-8;
constexpr int trials = 1000;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}

  MatrixXd matrix(Index m, Index n) {
    return MatrixXd::NullaryExpr(m, n, [&] { return normal_(generator_); });
  }
  Index below(Index count) {
    return std::uniform_int_distribution<Index>(0, count - 1)(generator_);
  }
  // Of any rank.
  MatrixXd map(Index m, Index n) {
    const Index rank = below(std::min(m, n) + 1);
    return matrix(m, rank) * matrix(rank, n);
  }
  MatrixXd skew(Index n) {
    const MatrixXd A = matrix(n, n);
    return A - A.transpose();
  }
  LinearDirac dirac(Index n) { return LinearDirac::random(n, generator_); }
  std::vector<Index> choice(Index count, Index n) {
    std::vector<Index> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), Index{0});
    std::shuffle(all.begin(), all.end(), generator_);
    all.resize(static_cast<std::size_t>(count));
    return all;
  }

 private:
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

MatrixXd skew_part(const MatrixXd& matrix) { return 0.5 * (matrix - matrix.transpose()); }

// A ∘ B by its definition: the equations of A and of B, ports (f, e) eliminated. `sign` -1 is the
// convention, +1 the wrong one.
PairedSubspace composition_by_equations(const LinearDirac& A, const std::vector<Index>& ports_of_A,
                                        const LinearDirac& B, const std::vector<Index>& ports_of_B,
                                        double sign) {
  const Index n_A = A.space_dimension(), n_B = B.space_dimension();
  const auto shared = static_cast<Index>(ports_of_A.size());
  const Index n = n_A + n_B - 2 * shared;
  const auto of_A = A.kernel_representation(), of_B = B.kernel_representation();
  MatrixXd F = MatrixXd::Zero(n_A + n_B, n), E = F, P = MatrixXd::Zero(n_A + n_B, 2 * shared);
  Index column = 0;
  const auto place = [&](const KernelRepresentation<MatrixXd>& D, Index row,
                         const std::vector<Index>& ports, double flow_sign) {
    const Index size = D.F.cols();
    for (Index k = 0; k < size; ++k) {
      const auto port = std::ranges::find(ports, k);
      if (port == ports.end()) {
        F.block(row, column, size, 1) = D.F.col(k);
        E.block(row, column++, size, 1) = D.E.col(k);
      } else {
        const Index p = port - ports.begin();
        P.block(row, p, size, 1) = flow_sign * D.F.col(k);
        P.block(row, shared + p, size, 1) = D.E.col(k);
      }
    }
  };
  place(of_A, 0, ports_of_A, 1.0);
  place(of_B, n_A, ports_of_B, sign);
  return PairedSubspace::kernel(F, E, P, A.block_options());
}

}  // namespace

BOOST_AUTO_TEST_CASE(images_of_dirac_structures_are_dirac) {
  Random random(1);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13, m = random.below(13);
    const MatrixXd phi = random.map(m, n);  // V → W
    BOOST_TEST(backward_image(phi, random.dirac(m)).dimension() == n);
    BOOST_TEST(forward_image(phi, random.dirac(n)).dimension() == m);
  }
}

BOOST_AUTO_TEST_CASE(images_by_their_definition) {
  Random random(2);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 9, m = random.below(9);
    const MatrixXd phi = random.map(m, n);
    const LinearDirac D = random.dirac(m), backward = backward_image(phi, D);
    // (v, φ*β) with (φv, β) ∈ D: all of the backward image is of this kind, with β up to ker φ*.
    for (Index k = 0; k < n; ++k) {
      const VectorXd v = backward.vectors().col(k), alpha = backward.covectors().col(k);
      MatrixXd equations(2 * m - D.dimension() + n, m);
      VectorXd values(equations.rows());
      equations << D.complement().bottomRows(m).transpose(), phi.transpose();
      values << -D.complement().topRows(m).transpose() * phi * v, alpha;
      const VectorXd beta =
          FundamentalSubspaces(equations, {.data_error = 1e-12}).pseudo_solve(values);
      BOOST_TEST((equations * beta - values).norm() < tolerance * (1.0 + beta.norm()));
    }
  }
}

BOOST_AUTO_TEST_CASE(images_of_graphs) {
  Random random(3);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13, m = random.below(13);
    const MatrixXd phi = random.map(m, n);
    const MatrixXd omega = random.skew(m), lambda = random.skew(n);
    BOOST_TEST(distance(backward_image(phi, LinearDirac::graph_of_form(omega)),
                        LinearDirac::graph_of_form(skew_part(phi.transpose() * omega * phi))) <
               tolerance);
    BOOST_TEST(distance(forward_image(phi, LinearDirac::graph_of_bivector(lambda)),
                        LinearDirac::graph_of_bivector(skew_part(phi * lambda * phi.transpose()))) <
               tolerance);
  }
}

BOOST_AUTO_TEST_CASE(images_compose) {
  Random random(4);
  for (int trial = 0; trial < trials; ++trial) {
    const Index a = trial % 9, b = random.below(9), c = random.below(9);
    const MatrixXd phi = random.map(b, a), psi = random.map(c, b);
    const LinearDirac over_a = random.dirac(a), over_c = random.dirac(c);
    BOOST_TEST(distance(backward_image(psi * phi, over_c),
                        backward_image(phi, backward_image(psi, over_c))) < tolerance);
    BOOST_TEST(distance(forward_image(psi * phi, over_a),
                        forward_image(psi, forward_image(phi, over_a))) < tolerance);
    const MatrixXd change = MatrixXd::Identity(a, a) + 0.1 * random.matrix(a, a);
    BOOST_TEST(distance(backward_image(change, forward_image(change, over_a)), over_a) < tolerance);
  }
}

// Restriction to a subspace: (F_D ∩ W, ω_D restricted), which is what the backward image along W ⊂
// V is.
BOOST_AUTO_TEST_CASE(images_of_subspaces) {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 1 + trial % 8, r = random.below(n + 1);
    const PairedSubspace D = random.dirac(n);
    const PairedSubspace coisotropic =
        sum(D, PairedSubspace::image(random.matrix(n, 1), random.matrix(n, 1)));
    const MatrixXd inclusion = random.matrix(n, r);
    BOOST_TEST(backward_image(inclusion, coisotropic).is_coisotropic());
    BOOST_TEST(backward_image(inclusion, coisotropic.orthogonal()).is_isotropic());
    BOOST_TEST(distance(backward_image(inclusion, coisotropic).orthogonal(),
                        backward_image(inclusion, coisotropic.orthogonal())) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(products) {
  Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Index a = trial % 7, b = random.below(7);
    const LinearDirac A = random.dirac(a), B = random.dirac(b), AB = product(A, B);
    BOOST_TEST(AB.dimension() == a + b);
    // The projection on the first factor has A for its image.
    BOOST_TEST(distance(forward_image(MatrixXd::Identity(a, a + b), AB), A) < tolerance);
    BOOST_TEST(distance(backward_image(MatrixXd::Identity(a + b, a), AB),
                        backward_image(MatrixXd::Identity(a, a), A)) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(tensor_products) {
  Random random(7);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 9;
    const LinearDirac A = random.dirac(n), B = random.dirac(n), C = random.dirac(n);
    const MatrixXd form = random.skew(n);
    BOOST_TEST(distance(tensor_product(A, B), tensor_product(B, A)) < tolerance);
    BOOST_TEST(distance(tensor_product(tensor_product(A, B), C),
                        tensor_product(A, tensor_product(B, C))) < tolerance);
    BOOST_TEST(distance(tensor_product(A, LinearDirac::graph_of_form(form)),
                        A.gauge_transformed(form)) < tolerance);
    BOOST_TEST(distance(tensor_product(A, LinearDirac::graph_of_form(MatrixXd::Zero(n, n))), A) <
               tolerance);
  }
}

BOOST_AUTO_TEST_CASE(compositions_are_dirac) {
  Random random(8);
  int wrong_sign_is_dirac = 0, joined = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Index n_A = trial % 13, n_B = random.below(13);
    const Index shared = random.below(std::min(n_A, n_B) + 1);
    const std::vector<Index> ports_of_A = random.choice(shared, n_A);
    const std::vector<Index> ports_of_B = random.choice(shared, n_B);
    const LinearDirac A = random.dirac(n_A), B = random.dirac(n_B);
    const LinearDirac joint = composition(A, ports_of_A, B, ports_of_B);
    BOOST_TEST(joint.dimension() == n_A + n_B - 2 * shared);
    BOOST_TEST(joint.isotropy_defect() < 1e-10);
    BOOST_TEST(distance(joint, composition_by_equations(A, ports_of_A, B, ports_of_B, -1.0)) <
               tolerance);
    if (shared == 0) BOOST_TEST(distance(joint, product(A, B)) < tolerance);
    if (shared > 0 && shared < std::min(n_A, n_B)) {
      ++joined;
      wrong_sign_is_dirac += composition_by_equations(A, ports_of_A, B, ports_of_B, 1.0).is_dirac();
    }
  }
  // The control: with f_A = f_B power is not conserved, but for structures without any to exchange.
  BOOST_TEST(joined > 300);
  BOOST_TEST(wrong_sign_is_dirac < joined / 2);
}

BOOST_AUTO_TEST_CASE(compositions_are_associative) {
  Random random(9);
  for (int trial = 0; trial < 300; ++trial) {
    // A on 0 1 | 2, B on 0 | 1 2 | 3 4, C on 0 1 | 2: A and B share one port, B and C two.
    const LinearDirac A = random.dirac(3), B = random.dirac(5), C = random.dirac(3);
    const std::vector<Index> last{2}, first{0}, middle{1, 2}, both{0, 1};
    const LinearDirac AB = composition(A, last, B, first);   // A0 A1 B1 B2 B3 B4
    const LinearDirac BC = composition(B, middle, C, both);  // B0 B3 B4 C2
    const LinearDirac left = composition(AB, std::vector<Index>{2, 3}, C, both);
    const LinearDirac right = composition(A, last, BC, first);
    BOOST_TEST(distance(left, right) < tolerance);
  }
}

// Two gyrators in a row are a transformer.
BOOST_AUTO_TEST_CASE(two_gyrators_are_a_transformer) {
  const auto gyrator = [](double ratio) {  // v₁ = g α₂, v₂ = -g α₁
    return LinearDirac::graph_of_bivector(MatrixXd{{0, ratio}, {-ratio, 0}});
  };
  const LinearDirac joint =
      composition(gyrator(2.0), std::vector<Index>{1}, gyrator(6.0), std::vector<Index>{0});
  // v = (v₁, -3 v₁), α = (3 α₂, α₂): power v₁α₁ + v₂α₂ = 0.
  BOOST_TEST(distance(joint, LinearDirac::annihilator_sum(MatrixXd{{1}, {-3}})) < 1e-12);
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused) {
  Random random(10);
  const LinearDirac A = random.dirac(3), B = random.dirac(2);
  const std::vector<Index> none, zero{0}, twice{0, 0}, beyond{3};
  BOOST_CHECK_THROW(composition(A, zero, B, none), std::invalid_argument);
  BOOST_CHECK_THROW(composition(A, twice, B, std::vector<Index>{0, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(composition(A, beyond, B, zero), std::invalid_argument);
  BOOST_CHECK_THROW(backward_image(MatrixXd::Zero(2, 4), A), std::invalid_argument);
  BOOST_CHECK_THROW(forward_image(MatrixXd::Zero(4, 2), A), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
