#include "courant/structures/laws.hpp"

#include <boost/test/unit_test.hpp>

#include "../manifolds/catalogue.hpp"
#include "catalogue.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/rank_profile.hpp"

// Mistakes that these cases have to notice:
//  * S1 takes too small dimensions for right
//  * S2 never fails
//  * S3 never fails
//  * S4 never fails
//  * S5 never fails
//  * S5 looks at zero alone
//  * S5' never fails
//  * S6 never fails
//  * S7 never fails
//  * coisotropy is not asked of open structures
//  * attitudes do not turn (structures/matrix_structures.cpp)
BOOST_AUTO_TEST_SUITE(structure_laws)

using namespace courant;

namespace {

// A structure with a formula for everything, for planted mistakes.
class Planted final : public DiracStructure {
 public:
  using Formula = std::function<ExprVector(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& u)>;
  Planted(Index n, Index ports, Index equations, Formula formula, bool claims_dirac = true)
      : DiracStructure("Planted", std::make_shared<Euclidean>(n), ports, equations),
        formula_(std::move(formula)),
        claims_dirac_(claims_dirac) {}
  bool is_dirac() const override { return claims_dirac_; }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override {
    return formula_(x, v, alpha, u);
  }
  Formula formula_;
  bool claims_dirac_;
};

// The laws that fail, by their first two letters.
std::set<std::string> failing(const DiracStructure& structure) {
  std::set<std::string> laws;
  for (const LawResult& result : check_structure(structure))
    if (!result.passed()) laws.insert(result.law.substr(0, 2));
  return laws;
}

using Laws = std::set<std::string>;

}  // namespace

BOOST_AUTO_TEST_CASE(every_structure_keeps_every_law) {
  for (const auto& entry : test::structure_catalogue()) BOOST_TEST_CONTEXT(entry.description) {
      for (const LawResult& result : check_structure(*entry.structure))
        BOOST_TEST(result.passed(), result);
    }
}

BOOST_AUTO_TEST_CASE(every_class_is_in_the_catalogue) {
  const auto classes = test::final_classes("structures", "DiracStructure");
  BOOST_TEST(classes.size() >= 14U);
  for (const std::string& name : classes)
    BOOST_TEST(std::ranges::any_of(
                   test::structure_catalogue(),
                   [&](const auto& entry) { return test::is_of_class(*entry.structure, name); }),
               name << " is missing from the catalogue of structures");
}

BOOST_AUTO_TEST_CASE(ranks_are_the_known_ones) {
  for (const auto& entry : test::structure_catalogue()) BOOST_TEST_CONTEXT(entry.description) {
      std::mt19937 generator(3);
      const VectorXd x = entry.structure->manifold()->random_point(generator);
      const FibreRanks ranks = fibre_ranks(*entry.structure, x);
      BOOST_TEST(ranks.vector_range == entry.rank_of_F);
      BOOST_TEST(ranks.gap > 1e3);
      if (!entry.structure->is_dirac()) continue;
      BOOST_TEST(ranks.dimension == entry.structure->manifold()->dimension());
      BOOST_TEST(entry.structure->linear(x).form().F.cols() == entry.rank_of_F);
    }
}

BOOST_AUTO_TEST_CASE(a_bivector_that_is_not_skew_is_not_isotropic) {
  const Poisson wrong(std::make_shared<Euclidean>(2),
                      test::constant_field(MatrixXd{{0.0, 1.0}, {-1.0, 1e-3}}));
  BOOST_TEST((failing(wrong) == Laws{"S2", "S3"}));
}

BOOST_AUTO_TEST_CASE(missing_equations_leave_too_much) {
  const Planted wrong(2, 0, 1,
                      [](const ExprVector&, const ExprVector& v, const ExprVector& alpha,
                         const ExprVector&) { return ExprVector((v - alpha).head(1)); });
  BOOST_TEST((failing(wrong) == Laws{"S1", "S2", "S3"}));
}

BOOST_AUTO_TEST_CASE(more_equations_leave_too_little) {
  const Planted wrong(
      2, 0, 3,
      [](const ExprVector&, const ExprVector& v, const ExprVector& alpha, const ExprVector&) {
        ExprVector residual(3);
        residual << alpha, v[0];
        return residual;
      });
  BOOST_TEST((failing(wrong) == Laws{"S1", "S3"}));
}

BOOST_AUTO_TEST_CASE(a_membership_that_is_not_linear_is_found) {
  const Planted wrong(
      1, 0, 1,
      [](const ExprVector&, const ExprVector& v, const ExprVector& alpha, const ExprVector&) {
        return ExprVector(ExprVector::Constant(1, v[0] + 0.1 * square(v[0]) * alpha[0]));
      });
  BOOST_TEST(failing(wrong).contains("S4"));
}

BOOST_AUTO_TEST_CASE(a_membership_with_a_constant_does_not_vanish) {
  const Planted wrong(
      1, 0, 1, [](const ExprVector&, const ExprVector& v, const ExprVector&, const ExprVector&) {
        return ExprVector(ExprVector::Constant(1, v[0] - 1e-3));
      });
  BOOST_TEST(failing(wrong).contains("S5"));
}

// The quadratic part has no derivative at zero: the fibre takes the equation for 0 = 0.
BOOST_AUTO_TEST_CASE(a_membership_that_is_quadratic_does_not_vanish_on_its_fibre) {
  const Planted wrong(
      1, 0, 1, [](const ExprVector&, const ExprVector& v, const ExprVector&, const ExprVector&) {
        return ExprVector(ExprVector::Constant(1, square(v[0])));
      });
  BOOST_TEST(failing(wrong).contains("S1"));
  BOOST_TEST(failing(wrong).contains("S4"));
  BOOST_TEST(failing(wrong).contains("S5"));
}

// Its derivative at zero is that of v₀, so the fibre is right, but it asks for nothing of vectors
// that are longer than 1/10.
BOOST_AUTO_TEST_CASE(a_membership_that_vanishes_off_its_fibre_is_found) {
  const Planted wrong(
      1, 0, 1, [](const ExprVector&, const ExprVector& v, const ExprVector&, const ExprVector&) {
        return ExprVector(ExprVector::Constant(1, select(abs(v[0]) < 0.1, v[0], 0.0)));
      });
  int found = 0;
  for (const LawResult& result : check_structure(wrong)) {
    if (result.law.starts_with("S1") || result.law.starts_with("S5 membership = 0"))
      BOOST_TEST(result.passed(), result);
    if (!result.law.starts_with("S5 membership ≠ 0")) continue;
    ++found;
    BOOST_TEST(!result.passed(), result);
  }
  BOOST_TEST(found == 1);
}

// {(v, v)} has dimension n, but its orthogonal is {(v, -v)}: open structures contain theirs.
BOOST_AUTO_TEST_CASE(an_open_structure_contains_its_orthogonal) {
  const Planted wrong(
      2, 0, 2,
      [](const ExprVector&, const ExprVector& v, const ExprVector& alpha, const ExprVector&) {
        return ExprVector(v - alpha);
      },
      false);
  BOOST_TEST((failing(wrong) == Laws{"S3"}));
}

BOOST_AUTO_TEST_CASE(an_open_structure_is_not_dirac_whatever_it_claims) {
  const auto open = [](const ExprVector&, const ExprVector& v, const ExprVector& alpha,
                       const ExprVector& u) {
    ExprVector residual(2);
    residual << v[0] - alpha[1], v[1] + alpha[0] - u[0];
    return residual;
  };
  BOOST_TEST((failing(Planted(2, 1, 2, open)) == Laws{"S1", "S2"}));
  BOOST_TEST((failing(Planted(2, 1, 2, open, false)) == Laws{}));
}

// x dx on R: F is a point everywhere but at 0, where it is a line.
BOOST_AUTO_TEST_CASE(a_distribution_that_is_not_regular_jumps) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto D = Distribution::annihilated_by(
      line, 1, [](const ExprVector& x) { return ExprMatrix(ExprMatrix::Constant(1, 1, x[0])); });
  const std::vector<VectorXd> points{VectorXd{{-1.0}}, VectorXd{{0.0}}, VectorXd{{2.0}}};
  for (const LawResult& result : check_structure(D, points)) {
    if (result.law.starts_with("S6")) {
      BOOST_TEST(result.defect == 1.0);
      BOOST_TEST(result.where == "x = (0)");
    } else {
      BOOST_TEST(result.passed(), result);  // Dirac at every point even so
    }
  }
  const RankProfile profile = rank_profile(D, points);
  BOOST_TEST((profile.jumps == std::vector<std::size_t>{1}));
}

// Its values are not tangent to the sphere: the equations it claims to be n are n + 1.
BOOST_AUTO_TEST_CASE(a_bivector_out_of_the_tangent_space_is_found) {
  const Poisson wrong(std::make_shared<Sphere>(2), [](const ExprVector& x) {
    ExprVector a = x;
    a[0] += 0.1;
    return test::hat(a);
  });
  BOOST_TEST(failing(wrong).contains("S7"));
}

BOOST_AUTO_TEST_CASE(what_throws_fails_a_law) {
  const Poisson wrong(std::make_shared<Euclidean>(2),
                      [](const ExprVector&) { return ExprMatrix(ExprMatrix::Zero(3, 3)); });
  const auto results = check_structure(wrong);
  BOOST_TEST(!results.front().passed());
  BOOST_TEST(results.front().where.find("the bivector is 3 × 3") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
