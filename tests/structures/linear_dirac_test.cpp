#include "courant/structures/linear_dirac.hpp"

#include <boost/test/unit_test.hpp>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(linear_dirac_test)

namespace {

constexpr double tolerance = 1e-9;
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
  // Of any even rank.
  MatrixXd skew(Index n) {
    const Index half = below(n / 2 + 1);
    const MatrixXd A = matrix(n, half), B = matrix(n, half);
    return A * B.transpose() - B * A.transpose();
  }
  MatrixXd orthogonal(Index n) { return orthonormalized(matrix(n, n)); }
  // With eigenvalues 1 and -1 of any multiplicity, which make D ∩ V and D ∩ V* of any dimension.
  MatrixXd orthogonal_with_fixed_directions(Index n) {
    const Index plus = below(n + 1), minus = below(n - plus + 1), rest = n - plus - minus;
    MatrixXd block = MatrixXd::Identity(n, n);
    block.block(plus, plus, minus, minus) *= -1.0;
    block.bottomRightCorner(rest, rest) = orthogonal(rest);
    const MatrixXd Q = orthogonal(n);
    return Q * block * Q.transpose();
  }
  std::mt19937& generator() { return generator_; }

 private:
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

// The kinds of Dirac structures, each as a random one on a space of dimension n.
using Kind = std::function<LinearDirac(Index, Random&)>;
const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> all{
      {"any", [](Index n, Random& random) { return LinearDirac::random(n, random.generator()); }},
      {"F ⊕ F°",
       [](Index n, Random& random) {
         return LinearDirac::annihilator_sum(random.matrix(n, random.below(n + 1)));
       }},
      {"graph of ω",
       [](Index n, Random& random) { return LinearDirac::graph_of_form(random.skew(n)); }},
      {"graph of Λ",
       [](Index n, Random& random) { return LinearDirac::graph_of_bivector(random.skew(n)); }},
      {"Λ on a subspace",
       [](Index n, Random& random) {
         const Index r = random.below(n + 1);
         return LinearDirac(BivectorOnSubspace{random.matrix(n, r), random.skew(r)});
       }},
      {"graph of O",
       [](Index n, Random& random) {
         return LinearDirac::from_scattering(random.orthogonal_with_fixed_directions(n));
       }},
  };
  return all;
}

// One random structure of each kind after the other, `trials` times, in dimensions 0 to 12.
template <class Law>
void for_each_kind(unsigned seed, const Law& law) {
  for (const auto& [name, kind] : kinds()) {
    BOOST_TEST_CONTEXT(name) {
      Random random(seed);
      for (int trial = 0; trial < trials; ++trial) law(kind(trial % 13, random), random);
    }
  }
}

// A random element (v, α) of D.
std::pair<VectorXd, VectorXd> element(const LinearDirac& D, Random& random) {
  const VectorXd c = random.matrix(D.dimension(), 1);
  return {D.vectors() * c, D.covectors() * c};
}

double span_distance(const MatrixXd& A, const MatrixXd& B) {
  return distance(PairedSubspace::image(A, 0.0 * A), PairedSubspace::image(B, 0.0 * B));
}

}  // namespace

BOOST_AUTO_TEST_CASE(definition_2_1) {
  for_each_kind(1, [](const LinearDirac& D, Random&) {
    BOOST_TEST(D.dimension() == D.space_dimension());
    BOOST_TEST(D.isotropy_defect() < 1e-12);
    BOOST_TEST(D.coisotropy_defect() < 1e-12);
    BOOST_TEST(distance(D, D.orthogonal()) < 1e-12);
    BOOST_TEST(!D.decision().ambiguous());
  });
}

BOOST_AUTO_TEST_CASE(definition_2_1_rejects_what_is_not_dirac) {
  for_each_kind(2, [](const LinearDirac& D, Random&) {
    const Index n = D.space_dimension();
    if (n == 0) return;
    // One vector less is isotropic only, its orthogonal coisotropic only.
    const PairedSubspace less =
        PairedSubspace::image(D.vectors().leftCols(n - 1), D.covectors().leftCols(n - 1));
    BOOST_TEST(less.is_isotropic());
    BOOST_TEST(!less.is_coisotropic());
    BOOST_TEST(less.orthogonal().is_coisotropic());
    BOOST_TEST(!less.orthogonal().is_isotropic());
    BOOST_CHECK_THROW(LinearDirac{less}, std::domain_error);
    BOOST_CHECK_THROW(LinearDirac{less.orthogonal()}, std::domain_error);
    // Of dimension n, but one vector is wrong by 1e-4.
    MatrixXd basis = D.basis();
    // In the direction of (α, v) from (v, α), which pairs with it to more than 0.
    basis.col(0) += 1e-4 * basis.col(0).reshaped(n, 2).rowwise().reverse().reshaped();
    const PairedSubspace wrong = PairedSubspace::image(basis.topRows(n), basis.bottomRows(n));
    BOOST_TEST(wrong.dimension() == n);
    BOOST_CHECK_THROW(LinearDirac{wrong}, std::domain_error);
  });
  Random random(3);
  for (Index n = 1; n <= 12; ++n) {
    const PairedSubspace generic = PairedSubspace::image(random.matrix(n, n), random.matrix(n, n));
    BOOST_TEST(!generic.is_isotropic());
    BOOST_TEST(!generic.is_coisotropic());
    BOOST_CHECK_THROW(LinearDirac{generic}, std::domain_error);
  }
}

// D_F = F ⊕ F°.
BOOST_AUTO_TEST_CASE(example_2_2_1) {
  Random random(4);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13, r = random.below(n + 1);
    MatrixXd F = random.matrix(n, r + 1);
    F.col(r) = F.leftCols(r) * random.matrix(r, 1);  // columns may be dependent
    const LinearDirac D = LinearDirac::annihilator_sum(F);
    BOOST_TEST(span_distance(D.vector_range(), F) < tolerance);
    BOOST_TEST(span_distance(D.vector_kernel(), F) < tolerance);
    BOOST_TEST((D.covector_range().transpose() * F).norm() < tolerance);
    BOOST_TEST(D.covector_kernel().cols() == n - r);
    BOOST_TEST(distance(D, LinearDirac(FormOnSubspace{F.leftCols(r), MatrixXd::Zero(r, r)})) <
               tolerance);
  }
}

// D_ω = {(v, ω♭v)}, ω♭(u)(v) = ω(u, v).
BOOST_AUTO_TEST_CASE(example_2_2_2) {
  Random random(5);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13;
    const MatrixXd omega = random.skew(n);
    const LinearDirac D = LinearDirac::graph_of_form(omega);
    const auto [v, alpha] = element(D, random);
    const VectorXd u = random.matrix(n, 1);
    BOOST_TEST(std::abs(alpha.dot(u) - v.dot(omega * u)) < tolerance);
    BOOST_TEST(D.covector_kernel().cols() == 0);
    BOOST_TEST(D.vector_kernel().cols() == n - decide_rank(omega).rank);
    BOOST_TEST((omega * D.vector_kernel()).norm() < tolerance);
    if (omega.norm() > 0.1) BOOST_TEST(distance(D, LinearDirac::graph_of_form(-omega)) > 1e-3);
  }
}

// D_Λ = {(♯α, α)}, ⟨β, ♯α⟩ = Λ(β, α).
BOOST_AUTO_TEST_CASE(example_2_2_3) {
  Random random(6);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13;
    const MatrixXd lambda = random.skew(n);
    const LinearDirac D = LinearDirac::graph_of_bivector(lambda);
    const auto [v, alpha] = element(D, random);
    const VectorXd beta = random.matrix(n, 1);
    BOOST_TEST(std::abs(beta.dot(v) - beta.dot(lambda * alpha)) < tolerance);
    BOOST_TEST(D.vector_kernel().cols() == 0);
    BOOST_TEST((lambda * D.covector_kernel()).norm() < tolerance);  // Casimir covectors
    BOOST_TEST(D.covector_kernel().cols() == n - decide_rank(lambda).rank);
    if (lambda.norm() > 0.1)
      BOOST_TEST(distance(D, LinearDirac::graph_of_bivector(-lambda)) > 1e-3);
  }
}

// On T*R with ω = dq ∧ dp both graphs are Hamilton's equations: dH ↦ (∂H/∂p, -∂H/∂q).
BOOST_AUTO_TEST_CASE(example_2_2_signs) {
  const MatrixXd omega{{0, 1}, {-1, 0}};
  const LinearDirac D = LinearDirac::graph_of_form(omega);
  const VectorXd dH{{3, 5}}, v{{5, -3}};
  BOOST_TEST(D.distance(v, dH) < 1e-14);
  BOOST_TEST(D.distance(-v, dH) > 1.0);
  BOOST_TEST(distance(D, LinearDirac::graph_of_bivector(omega)) < 1e-14);
  Random random(7);
  for (Index n = 2; n <= 12; n += 2) {
    const MatrixXd A = random.matrix(n, n), form = A - A.transpose();
    BOOST_TEST(distance(LinearDirac::graph_of_form(form),
                        LinearDirac::graph_of_bivector(
                            LuDecomposition(form.transpose()).inverse())) < 1e-8);
  }
}

// D determines (F_D, ω_D), and the other way round.
BOOST_AUTO_TEST_CASE(proposition_2_3) {
  for_each_kind(8, [](const LinearDirac& D, Random& random) {
    const auto [F, omega] = D.form();
    BOOST_TEST((omega + omega.transpose()).norm() == 0.0);
    BOOST_TEST((F.transpose() * D.covector_kernel()).norm() < tolerance);  // D ∩ V* = F_D°
    BOOST_TEST(F.cols() + D.covector_kernel().cols() == D.space_dimension());
    BOOST_TEST((F * omega * F.transpose() * D.vector_kernel()).norm() < 1e-7);  // D ∩ V = ker ω_D
    BOOST_TEST(distance(LinearDirac(FormOnSubspace{F, omega}), D) < tolerance);
    // ω_D(u, v) = α(v) = -β(u) for (u, α), (v, β) ∈ D.
    const auto [u, alpha] = element(D, random);
    const auto [v, beta] = element(D, random);
    const double value = (F.transpose() * u).dot(omega * (F.transpose() * v));
    const double scale = 1.0 + omega.norm();
    BOOST_TEST(std::abs(value - alpha.dot(v)) < tolerance * scale);
    BOOST_TEST(std::abs(value + beta.dot(u)) < tolerance * scale);
  });
}

BOOST_AUTO_TEST_CASE(proposition_2_3_converse) {
  Random random(9);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = trial % 13, r = random.below(n + 1);
    const MatrixXd F = random.matrix(n, r), omega = random.skew(r);
    const LinearDirac D(FormOnSubspace{F, omega});
    // By the definition: u ∈ F and α(f_j) = ω(u, f_j), for n independent (u, α).
    const auto [u, alpha] = element(D, random);
    const VectorXd c = FundamentalSubspaces(F).pseudo_solve(u);
    BOOST_TEST((F * c - u).norm() < tolerance);
    BOOST_TEST((F.transpose() * alpha - omega.transpose() * c).norm() < tolerance);
    // Another basis of F, with the form in it, is the same structure; another form is not.
    const MatrixXd change = random.orthogonal(r);
    const MatrixXd in_other_basis = change.transpose() * omega * change;
    const FormOnSubspace same{F * change, 0.5 * (in_other_basis - in_other_basis.transpose())};
    BOOST_TEST(distance(LinearDirac(same), D) < tolerance);
    if (r > 1) {
      MatrixXd other = omega;
      other(0, 1) += 1.0;
      other(1, 0) -= 1.0;
      BOOST_TEST(distance(LinearDirac(FormOnSubspace{F, other}), D) > 1e-6);
    }
  }
}

// The dual of Proposition 2.3, and Theorem 2.5 at a point.
BOOST_AUTO_TEST_CASE(theorem_2_5_at_a_point) {
  for_each_kind(10, [](const LinearDirac& D, Random& random) {
    const auto [F, lambda] = D.bivector();
    BOOST_TEST((F.transpose() * D.vector_kernel()).norm() < tolerance);  // D ∩ V = (F_D^(*))°
    BOOST_TEST(distance(LinearDirac(BivectorOnSubspace{F, lambda}), D) < tolerance);
    const auto [v, alpha] = element(D, random);
    const auto [w, beta] = element(D, random);
    const double value = (F.transpose() * beta).dot(lambda * (F.transpose() * alpha));
    BOOST_TEST(std::abs(value - beta.dot(v)) < tolerance * (1.0 + lambda.norm()));
  });
}

// Open ports: coisotropic and not Dirac; closed ports: Dirac. The orthogonal of the open structure.
BOOST_AUTO_TEST_CASE(proposition_7_1_at_a_point) {
  Random random(11);
  for (int trial = 0; trial < trials; ++trial) {
    const Index n = 1 + trial % 12, m = 1 + random.below(n);
    const MatrixXd J = random.skew(n), I = MatrixXd::Identity(n, n);
    MatrixXd B = random.matrix(n, m);
    if (m > 1 && random.below(2) == 0) B.col(1) = 2.0 * B.col(0);
    const Index rank = decide_rank(B).rank;
    const PairedSubspace open = PairedSubspace::kernel(I, -J, -B);
    BOOST_TEST(open.dimension() == n + rank);
    BOOST_TEST(open.is_coisotropic());
    BOOST_TEST(!open.is_isotropic());
    BOOST_CHECK_THROW(LinearDirac{open}, std::domain_error);

    const LinearDirac closed(ConstrainedRepresentation<MatrixXd>{J, B});
    MatrixXd F = MatrixXd::Zero(n + m, n), E(n + m, n), P = MatrixXd::Zero(n + m, m);
    F.topRows(n) = I;
    E << -J, B.transpose();
    P.topRows(n) = -B;
    BOOST_TEST(distance(PairedSubspace::kernel(F, E, P), closed) < tolerance);
    BOOST_TEST(distance(intersection(open, closed), closed) < tolerance);

    // D^⊥ = {v = Jα, Bᵀα = 0}. Without Bᵀα = 0, as printed, it is too large.
    BOOST_TEST(distance(PairedSubspace::kernel(F, E), open.orthogonal()) < tolerance);
    BOOST_TEST(LinearDirac::graph_of_bivector(J).dimension() > open.orthogonal().dimension());

    // Why the closed structure is coisotropic: D^⊥ ⊆ D^(c), hence (D^(c))^⊥ ⊆ D, and (Bu, 0) ∈
    // D^(c) gives Bᵀα = 0. That D^(c) ⊆ D says nothing: D^(c) without one of its directions is in D
    // too.
    BOOST_TEST(distance(intersection(open.orthogonal(), closed), open.orthogonal()) < tolerance);
    BOOST_TEST(distance(intersection(closed.orthogonal(), open), closed.orthogonal()) < tolerance);
    const PairedSubspace ports = PairedSubspace::image(B, MatrixXd::Zero(n, m));
    BOOST_TEST(distance(intersection(ports, closed), ports) < tolerance);
    const MatrixXd fewer = closed.basis().leftCols(n - 1);
    const PairedSubspace part = PairedSubspace::image(fewer.topRows(n), fewer.bottomRows(n));
    BOOST_TEST(distance(intersection(part, open), part) < tolerance);
    BOOST_TEST(!part.is_coisotropic());
  }
}

BOOST_AUTO_TEST_CASE(representations_are_of_the_same_structure) {
  std::set<std::pair<Index, Index>> seen;  // all (dim F_D, dim F_D^(*)) there are
  for_each_kind(12, [&](const LinearDirac& D, Random&) {
    const Index n = D.space_dimension();
    const auto kernel = D.kernel_representation();
    BOOST_TEST((kernel.F * kernel.E.transpose() + kernel.E * kernel.F.transpose()).norm() < 1e-12);
    BOOST_TEST(distance(LinearDirac(kernel), D) < tolerance);
    const auto image = D.image_representation();
    BOOST_TEST(distance(LinearDirac(image), D) < tolerance);
    const ImageRepresentation<MatrixXd> of_kernel{kernel.E.transpose(), kernel.F.transpose()};
    BOOST_TEST(distance(LinearDirac(of_kernel), D) < tolerance);

    const auto constrained = D.constrained_representation();
    BOOST_TEST(constrained.G.cols() == D.vector_kernel().cols());
    BOOST_TEST(distance(LinearDirac(constrained), D) < tolerance);

    const auto hybrid = D.hybrid_representation();
    BOOST_TEST((hybrid.M + hybrid.M.transpose()).norm() == 0.0);
    BOOST_TEST(static_cast<Index>(hybrid.effort_driven.size() + hybrid.flow_driven.size()) == n);
    BOOST_TEST(distance(LinearDirac(hybrid), D) < tolerance);
  });
  Random random(12);
  for (int trial = 0; trial < trials; ++trial) {
    const LinearDirac D = LinearDirac::random(12, random.generator());
    seen.insert({D.vector_range().cols(), D.covector_range().cols()});
  }
  // dim F_D = r and rank ω_D = r + s - n, even, between 0 and r: 49 pairs for n = 12.
  BOOST_TEST(seen.size() == 49u);
}

BOOST_AUTO_TEST_CASE(graph_of_an_orthogonal_matrix) {
  for_each_kind(13, [](const LinearDirac& D, Random& random) {
    const Index n = D.space_dimension();
    const MatrixXd O = D.scattering();
    BOOST_TEST((O.transpose() * O - MatrixXd::Identity(n, n)).norm() < 1e-12);
    BOOST_TEST(distance(LinearDirac::from_scattering(O), D) < 1e-12);
    const auto [v, alpha] = element(D, random);
    BOOST_TEST((v - alpha - O * (v + alpha)).norm() < 1e-12);
    // -1 is an eigenvalue as often as dim D ∩ V*, the others come in pairs or are 1.
    if (n > 0) {
      const double sign = D.covector_kernel().cols() % 2 == 0 ? 1.0 : -1.0;
      BOOST_TEST(std::abs(LuDecomposition(O).determinant() - sign) < 1e-9);
    }
  });
}

BOOST_AUTO_TEST_CASE(gauge_transformation) {
  for_each_kind(14, [](const LinearDirac& D, Random& random) {
    const Index n = D.space_dimension();
    const MatrixXd B = random.skew(n), C = random.skew(n);
    const LinearDirac transformed = D.gauge_transformed(B);
    const auto [F, omega] = D.form();
    const MatrixXd on_F = F.transpose() * B * F;
    const LinearDirac expected(FormOnSubspace{F, omega + 0.5 * (on_F - on_F.transpose())});
    BOOST_TEST(distance(transformed, expected) < tolerance);
    BOOST_TEST(distance(transformed.gauge_transformed(C), D.gauge_transformed(B + C)) < tolerance);
    BOOST_TEST(distance(transformed.gauge_transformed(-B), D) < tolerance);
  });
}

BOOST_AUTO_TEST_CASE(kinds_are_recognised) {
  const MatrixXd omega{{0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
  const MatrixXd I = MatrixXd::Identity(3, 3);
  BOOST_TEST(LinearDirac::graph_of_form(omega).kind() == "graph of a presymplectic form");
  BOOST_TEST(LinearDirac::graph_of_bivector(omega).kind() == "graph of a bivector");
  BOOST_TEST(LinearDirac::graph_of_form(omega.topLeftCorner(2, 2)).kind() ==
             "graph of a symplectic form");
  BOOST_TEST(LinearDirac::annihilator_sum(I.leftCols(1)).kind() == "F ⊕ F°");
  BOOST_TEST(LinearDirac::annihilator_sum(I).kind() == "V ⊕ 0");
  BOOST_TEST(LinearDirac::annihilator_sum(MatrixXd(3, 0)).kind() == "0 ⊕ V*");
  const MatrixXd plane{{1, 0}, {0, 1}, {0, 0}, {0, 0}};
  const LinearDirac mixed = LinearDirac(FormOnSubspace{plane, MatrixXd{{0, 1}, {-1, 0}}});
  BOOST_TEST(mixed.kind() == "graph of a bivector");
  const MatrixXd space{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  BOOST_TEST(LinearDirac(FormOnSubspace{space, omega}).kind() == "a form on a subspace");
}

BOOST_AUTO_TEST_CASE(prints_equations) {
  std::ostringstream text;
  text << LinearDirac::graph_of_bivector(MatrixXd{{0, -3, 2}, {3, 0, -1}, {-2, 1, 0}});
  BOOST_TEST(text.str() ==
             "Dirac structure on V, dim V = 3: graph of a bivector\n"
             "  dim F_D = 2, rank ω_D = 2, dim D ∩ V = 0, dim D ∩ V* = 1\n"
             "  v[0] = -3 α[1] + 2 α[2]\n"
             "  v[1] = 3 α[0] - α[2]\n"
             "  v[2] = -2 α[0] + α[1]\n");
  text.str("");
  text << LinearDirac::annihilator_sum(MatrixXd{{1}, {0.5}});
  BOOST_TEST(text.str() ==
             "Dirac structure on V, dim V = 2: F ⊕ F°\n"
             "  dim F_D = 1, rank ω_D = 0, dim D ∩ V = 1, dim D ∩ V* = 1\n"
             "  v[1] = 0.5 v[0]\n"
             "  α[0] = -0.5 α[1]\n");
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused) {
  const MatrixXd I = MatrixXd::Identity(3, 3), S = MatrixXd{{0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
  BOOST_CHECK_THROW(LinearDirac::graph_of_form(I), std::domain_error);
  BOOST_CHECK_THROW(LinearDirac::graph_of_bivector(S + 1e-6 * I), std::domain_error);
  BOOST_CHECK_THROW(LinearDirac::graph_of_form(MatrixXd::Zero(2, 3)), std::invalid_argument);
  BOOST_CHECK_THROW(LinearDirac::from_scattering(2.0 * I), std::domain_error);
  BOOST_CHECK_THROW(LinearDirac(KernelRepresentation<MatrixXd>{I, I}), std::domain_error);
  BOOST_CHECK_THROW(LinearDirac(ImageRepresentation<MatrixXd>{I, MatrixXd::Ones(3, 2)}),
                    std::invalid_argument);
  BOOST_CHECK_THROW(LinearDirac(FormOnSubspace{MatrixXd::Ones(3, 3), S}), std::domain_error);
  BOOST_CHECK_THROW(LinearDirac(FormOnSubspace{I.leftCols(2), S}), std::invalid_argument);
  BOOST_CHECK_THROW(LinearDirac(ConstrainedRepresentation<MatrixXd>{I, I.leftCols(1)}),
                    std::domain_error);
  BOOST_CHECK_THROW(LinearDirac(HybridRepresentation<MatrixXd>{{0, 1}, {1}, S}),
                    std::invalid_argument);
  BOOST_CHECK_THROW(LinearDirac::graph_of_form(S).gauge_transformed(I), std::domain_error);
  BOOST_CHECK_EXCEPTION(
      LinearDirac(PairedSubspace::image(I.leftCols(2), I.leftCols(2))), std::domain_error,
      [](const std::domain_error& error) {
        return std::string(error.what()) ==
               "LinearDirac: the subspace has dimension 2, isotropy defect 1 and "
               "coisotropy defect 1; expected dimension 3 = dim V and defects of at "
               "most 1e-08.";
      });
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
