#include "courant/structures/family_rank.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/morse_family.hpp"

// Mistakes that these cases have to notice:
//  * the rank of a family counts what is normal to the manifold
//  * the rank is that of the second derivatives by multipliers alone
BOOST_AUTO_TEST_SUITE(family_rank_test)

using namespace courant;

namespace {

FamilyPoint at(const VectorXd& x, const VectorXd& lambda) { return {x, lambda, 0.0}; }

}  // namespace

// E = λ₀ x₀ + λ₁ c(x): the rows are those of the gradients of the conditions.
BOOST_AUTO_TEST_CASE(multipliers_of_conditions) {
  const auto with = [](double slope) {
    return MorseFamily(std::make_shared<Euclidean>(2), 2,
                       [slope](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
                         return l[0] * x[0] + l[1] * (3.0 * x[0] + slope * x[1] * x[1]);
                       });
  };
  const VectorXd x{{0.0, 0.4}}, lambda{{0.7, -0.2}};
  BOOST_TEST(family_rank(with(1.0), at(x, lambda)).rank == 2);
  BOOST_TEST(family_rank(with(0.0), at(x, lambda)).rank == 1);
  BOOST_TEST(family_rank(with(1.0), at(VectorXd::Zero(2), lambda)).rank == 1);
}

// E = λ³/3 - λ x has a fold at λ = 0 and is a Morse family there all the same; λ³ is none.
BOOST_AUTO_TEST_CASE(a_fold_and_a_cube) {
  const auto M = std::make_shared<Euclidean>(1);
  const MorseFamily fold(M, 1, [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
    return l[0] * l[0] * l[0] / 3.0 - l[0] * x[0];
  });
  const MorseFamily cube(M, 1, [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
    return l[0] * l[0] * l[0] / 3.0 + x[0];
  });
  const VectorXd zero = VectorXd::Zero(1);
  BOOST_TEST(family_rank(fold, at(zero, zero)).rank == 1);
  BOOST_TEST(family_rank(cube, at(zero, zero)).rank == 0);
  BOOST_TEST(family_rank(cube, at(zero, VectorXd::Ones(1))).rank == 1);
}

// λ (|x|² - 1) on the sphere: its gradient is normal, so that nothing along the sphere is left.
BOOST_AUTO_TEST_CASE(derivatives_are_along_the_manifold) {
  const MorseFamily family(std::make_shared<Sphere>(2), 1,
                           [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
                             return l[0] * (x.squaredNorm() - 1.0);
                           });
  BOOST_TEST(family_rank(family, at(VectorXd::Unit(3, 2), VectorXd::Ones(1))).rank == 0);
}

BOOST_AUTO_TEST_SUITE_END()
