#include "courant/structures/paired_subspace.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <sstream>

#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a sum doubts as little as the better of its parts
//  * subspaces of different dimensions may be close
BOOST_AUTO_TEST_SUITE(paired_subspace_test)

namespace {

class Random {
 public:
  MatrixXd matrix(Index m, Index n) {
    return MatrixXd::NullaryExpr(m, n, [&] { return normal_(generator_); });
  }
  Index below(Index count) {
    return static_cast<Index>(generator_() % static_cast<unsigned long>(count));
  }

  // Of random dimension 0 … 2n; some vectors and some covectors alone in it.
  PairedSubspace subspace(Index n) {
    const Index k = below(2 * n + 1);
    MatrixXd X = matrix(n, k), Y = matrix(n, k);
    for (Index j = 0; j < k; ++j) {
      if (below(4) == 0)
        X.col(j).setZero();
      else if (below(3) == 0)
        Y.col(j).setZero();
    }
    return PairedSubspace::image(X, Y);
  }

 private:
  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
};

constexpr double tolerance = 1e-11;

}  // namespace

BOOST_AUTO_TEST_CASE(pairing_is_that_of_section_2_1) {
  const VectorXd v1{{1, 2}}, alpha1{{3, 5}}, v2{{7, 11}}, alpha2{{13, 17}};
  BOOST_TEST(pairing(v1, alpha1, v2, alpha2) == 3 * 7 + 5 * 11 + 13 * 1 + 17 * 2);
}

BOOST_AUTO_TEST_CASE(orthogonal_laws) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = trial % 13;
    const PairedSubspace U = random.subspace(n), W = random.subspace(n);
    const PairedSubspace orthogonal = U.orthogonal();
    BOOST_TEST(U.dimension() + orthogonal.dimension() == 2 * n);
    BOOST_TEST(distance(orthogonal.orthogonal(), U) < tolerance);
    BOOST_TEST(distance(intersection(U, W).orthogonal(), sum(orthogonal, W.orthogonal())) <
               tolerance);
    BOOST_TEST(intersection(U, W).dimension() + sum(U, W).dimension() ==
               U.dimension() + W.dimension());
    BOOST_TEST(U.isotropy_defect() == orthogonal.coisotropy_defect(),
               boost::test_tools::tolerance(1e-9));
    for (Index j = 0; j < U.dimension(); ++j) {
      for (Index k = 0; k < orthogonal.dimension(); ++k) {
        BOOST_TEST(std::abs(pairing(U.vectors().col(j), U.covectors().col(j),
                                    orthogonal.vectors().col(k), orthogonal.covectors().col(k))) <
                   tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(isotropic_and_coisotropic) {
  // (e₀, 0) alone is isotropic; its orthogonal, all with α₀ = 0, is coisotropic; both are neither
  // both.
  const PairedSubspace line = PairedSubspace::image(MatrixXd{{1}, {0}}, MatrixXd{{0}, {0}});
  BOOST_TEST(line.is_isotropic());
  BOOST_TEST(!line.is_coisotropic());
  BOOST_TEST(!line.orthogonal().is_isotropic());
  BOOST_TEST(line.orthogonal().is_coisotropic());
  BOOST_TEST(line.orthogonal().distance(VectorXd{{3, 4}}, VectorXd{{0, 5}}) < tolerance);
  BOOST_TEST(line.orthogonal().distance(VectorXd{{3, 4}}, VectorXd{{-2, 5}}) == 2.0,
             boost::test_tools::tolerance(1e-12));
  // (e₀, e⁰) pairs with itself to 2: neither. Of unit length, the defect is 1.
  const PairedSubspace graph = PairedSubspace::image(MatrixXd{{1}, {0}}, MatrixXd{{1}, {0}});
  BOOST_TEST(!graph.is_isotropic());
  BOOST_TEST(!graph.is_coisotropic());
  BOOST_TEST(graph.isotropy_defect() == 1.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(!graph.is_dirac());
}

BOOST_AUTO_TEST_CASE(kernel_and_image_are_the_same_subspaces) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = trial % 13;
    const PairedSubspace U = random.subspace(n);
    const MatrixXd equations = U.complement().transpose();
    // Dependent equations and generators do no harm.
    const MatrixXd more = random.matrix(2 * n + 1, equations.rows()) * equations;
    BOOST_TEST(distance(PairedSubspace::kernel(more.leftCols(n), more.rightCols(n)), U) <
               tolerance);
    const MatrixXd mixed = U.basis() * random.matrix(U.dimension(), 2 * n + 1);
    BOOST_TEST(distance(PairedSubspace::image(mixed.topRows(n), mixed.bottomRows(n)), U) <
               tolerance);
  }
}

BOOST_AUTO_TEST_CASE(ports_are_eliminated) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = trial % 7, m = random.below(4), r = random.below(2 * n + m + 1);
    const MatrixXd F = random.matrix(r, n), E = random.matrix(r, n);
    MatrixXd P = random.matrix(r, m);
    if (m > 1) P.col(1) = P.col(0);
    const PairedSubspace U = PairedSubspace::kernel(F, E, P);
    MatrixXd all(r, 2 * n + m);
    all << F, E, P;
    const MatrixXd solutions = kernel(all);
    // Blocks of a matrix with orthonormal columns, which may be all noise.
    const RankOptions options{.data_error = 1e-13, .magnitude = 1.0};
    BOOST_TEST(
        distance(PairedSubspace::image(solutions.topRows(n), solutions.middleRows(n, n), options),
                 U) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(projections_and_intersections) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = trial % 13;
    const PairedSubspace U = random.subspace(n);
    const MatrixXd V_U = U.vector_kernel(), C_U = U.covector_kernel();
    BOOST_TEST(U.vector_range().cols() + C_U.cols() == U.dimension());
    BOOST_TEST(U.covector_range().cols() + V_U.cols() == U.dimension());
    for (Index k = 0; k < V_U.cols(); ++k) {
      BOOST_TEST(U.distance(V_U.col(k), VectorXd::Zero(n)) < tolerance);
    }
    for (Index k = 0; k < C_U.cols(); ++k) {
      BOOST_TEST(U.distance(VectorXd::Zero(n), C_U.col(k)) < tolerance);
    }
    // Annihilators of the kernels of U are the projections of U^⊥.
    const PairedSubspace orthogonal = U.orthogonal();
    BOOST_TEST((orthogonal.covector_range().transpose() * V_U).norm() < tolerance);
    BOOST_TEST((orthogonal.vector_range().transpose() * C_U).norm() < tolerance);
    BOOST_TEST(orthogonal.covector_range().cols() + V_U.cols() == n);
  }
}

BOOST_AUTO_TEST_CASE(distance_is_the_sine_of_the_angle) {
  const auto line = [](double angle) {
    return PairedSubspace::image(MatrixXd{{std::cos(angle)}, {0}},
                                 MatrixXd{{std::sin(angle)}, {0}});
  };
  BOOST_TEST(distance(line(0.1), line(0.4)) == std::sin(0.3), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(distance(line(0.1), line(0.1)) < 1e-15);
  BOOST_TEST(distance(line(0.1), line(0.1).orthogonal()) == 1.0);
}

// Noisy data, as from a Jacobian at a point that an iteration found.
BOOST_AUTO_TEST_CASE(the_error_of_the_data_is_known) {
  Random random;
  const MatrixXd exact = random.matrix(8, 3) * random.matrix(3, 5);
  const MatrixXd noisy = exact + 1e-10 * exact.cwiseProduct(random.matrix(8, 5));
  const auto image = [&](const RankOptions& options) {
    return PairedSubspace::image(noisy.topRows(4), noisy.bottomRows(4), options);
  };
  BOOST_TEST(image({.data_error = 1e-9}).dimension() == 3);
  BOOST_TEST(image({}).dimension() == 5);
  BOOST_TEST(!image({.data_error = 1e-9}).decision().ambiguous());
}

BOOST_AUTO_TEST_CASE(prints) {
  std::ostringstream text;
  text << PairedSubspace::image(MatrixXd{{1}, {0}}, MatrixXd{{0}, {0}});
  BOOST_TEST(text.str().starts_with(
      "subspace of V ⊕ V*, dim V = 2, dimension 1: isotropic, not coisotropic\n"));
}

BOOST_AUTO_TEST_CASE(wrong_sizes_are_refused) {
  const MatrixXd A = MatrixXd::Ones(2, 3), B = MatrixXd::Ones(3, 3);
  BOOST_CHECK_THROW(PairedSubspace::image(A, B), std::invalid_argument);
  BOOST_CHECK_THROW(PairedSubspace::kernel(A, B), std::invalid_argument);
  BOOST_CHECK_THROW(PairedSubspace::kernel(A, A, B), std::invalid_argument);
  BOOST_CHECK_THROW(distance(PairedSubspace::image(A, A), PairedSubspace::image(B, B)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(PairedSubspace::image(B, B).distance(VectorXd::Ones(2), VectorXd::Ones(3)),
                    std::invalid_argument);
}

// What is made of two subspaces is as uncertain as the worse of them, whichever comes first.
BOOST_AUTO_TEST_CASE(errors_of_data_are_inherited) {
  const MatrixXd one = MatrixXd::Identity(2, 2), zero = MatrixXd::Zero(2, 2);
  const PairedSubspace exact = PairedSubspace::image(one, zero);
  const PairedSubspace measured = PairedSubspace::image(zero, one, {.data_error = 1e-6});
  BOOST_TEST(measured.block_options().data_error == 1e-6);
  BOOST_TEST(measured.orthogonal().block_options().data_error == 1e-6);
  for (const auto& [U, W] : {std::pair(exact, measured), std::pair(measured, exact)}) {
    BOOST_TEST(sum(U, W).block_options().data_error == 1e-6);
    BOOST_TEST(intersection(U, W).block_options().data_error == 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(a_subspace_is_far_from_a_part_of_it) {
  const MatrixXd one = MatrixXd::Identity(2, 2), zero = MatrixXd::Zero(2, 2);
  const PairedSubspace plane = PairedSubspace::image(one, zero);
  const PairedSubspace line = PairedSubspace::image(one.col(0), zero.col(0));
  BOOST_TEST(distance(line, plane) == 1.0);
  BOOST_TEST(distance(plane, line) == 1.0);
}

// One equation p u + f v + e α = 0 written twice, the second time with other factors: it determines
// u and nothing else, and what is left of the second after u is eliminated is round-off.
BOOST_AUTO_TEST_CASE(equations_that_say_the_same_leave_nothing) {
  Random random;
  for (int trial = 0; trial < 50; ++trial) {
    const MatrixXd factors = random.matrix(3, 1), row = random.matrix(1, 3);
    const MatrixXd equations = factors * row;
    const PairedSubspace all =
        PairedSubspace::kernel(equations.col(0), equations.col(1), equations.col(2));
    BOOST_TEST(all.dimension() == 2);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
