#include "courant/structures/lie_group.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/laws.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/representation.hpp"

// Mistakes that these cases have to notice:
//  * any representation is taken for polynomials
BOOST_AUTO_TEST_SUITE(lie_group)

using namespace courant;

namespace {

const auto rotations = std::make_shared<SpecialOrthogonal3>();
const auto motions = std::make_shared<SpecialEuclidean3>();

// ω × on R³ for the first three of n components, 0 for the others, on c copies.
std::vector<MatrixXd> turns(Index n, Index c) {
  std::vector<MatrixXd> rho(static_cast<std::size_t>(n), MatrixXd::Zero(3 * c, 3 * c));
  for (Index i = 0; i < 3; ++i)
    for (Index k = 0; k < 3 * c; k += 3) {
      rho[static_cast<std::size_t>(i)](k + (i + 2) % 3, k + (i + 1) % 3) = 1.0;
      rho[static_cast<std::size_t>(i)](k + (i + 1) % 3, k + (i + 2) % 3) = -1.0;
    }
  return rho;
}

// E_ij on R⁴.
std::vector<MatrixXd> turns_of_four() {
  std::vector<MatrixXd> rho;
  for (Index i = 0; i < 4; ++i)
    for (Index j = i + 1; j < 4; ++j) {
      rho.push_back(MatrixXd::Zero(4, 4));
      rho.back()(i, j) = 1.0;
      rho.back()(j, i) = -1.0;
    }
  return rho;
}

}  // namespace

BOOST_AUTO_TEST_CASE(groups_of_algebras) {
  BOOST_TEST(is_group_of(rotations, LieAlgebra::so3()));
  BOOST_TEST(is_group_of(motions, LieAlgebra::se3()));
  BOOST_TEST(is_group_of(std::make_shared<Euclidean>(3), LieAlgebra::abelian(3)));
  BOOST_TEST(!is_group_of(rotations, LieAlgebra::abelian(3)));
  BOOST_TEST(!is_group_of(std::make_shared<Euclidean>(3), LieAlgebra::so3()));
  BOOST_TEST(!is_group_of(motions, LieAlgebra::so(4)));
  BOOST_TEST(!is_group_of(std::make_shared<Sphere>(3), LieAlgebra::so3()));
  // In another basis it is another matter.
  BOOST_TEST(!is_group_of(rotations, LieAlgebra::so(3)));

  BOOST_TEST(group_of(LieAlgebra::so3())->name() == rotations->name());
  BOOST_TEST(group_of(LieAlgebra::se3())->name() == motions->name());
  BOOST_TEST(group_of(LieAlgebra::abelian(2))->name() == Euclidean(2).name());
  BOOST_TEST(group_of(LieAlgebra::so(4))->name() == "SpecialOrthogonal(4)");
}

// Of an algebra without a centre the adjoint matrices have a group: so(3) in another basis, where it is SO(3), and sl(2). A centre
// acts by zero.
BOOST_AUTO_TEST_CASE(adjoint_groups) {
  auto twice = LieAlgebra::so3().constants();
  for (MatrixXd& c : twice) c *= 2.0;
  const LieAlgebra sl2("sl2", LieAlgebra(MatrixAlgebra::sl(2)).constants());
  for (const LieAlgebra& g : {LieAlgebra("2 so(3)", twice), sl2}) {
    const auto group = group_of(g);
    BOOST_REQUIRE(group);
    BOOST_TEST(group->name() == "MatrixGroup(ad " + g.name() + ", exponential)");
    BOOST_TEST(is_group_of(group, g));
    for (const LawResult& result : check_manifold(*group)) BOOST_TEST(result.passed(), result);
  }
  const LieAlgebra heisenberg("h", LieAlgebra(MatrixAlgebra::heisenberg(1)).constants());
  BOOST_TEST((group_of(heisenberg) == nullptr));
}

// What is made of matrices has their group.
BOOST_AUTO_TEST_CASE(groups_of_matrices) {
  for (const MatrixAlgebra& matrices :
       {MatrixAlgebra::se2(), MatrixAlgebra::su2(), MatrixAlgebra::heisenberg(2),
        MatrixAlgebra::sl(3), MatrixAlgebra::gl(2), MatrixAlgebra::sp(2),
        MatrixAlgebra::galilei()}) {
    const LieAlgebra g(matrices);
    const auto group = group_of(g);
    BOOST_TEST(group->name() == "MatrixGroup(" + matrices.name() + ", exponential)");
    BOOST_TEST(is_group_of(group, g), matrices.name());
    for (const GroupMap& map : {second_kind_map(matrices)})
      BOOST_TEST(is_group_of(std::make_shared<MatrixGroup>(matrices, map), g), matrices.name());
  }
  BOOST_TEST(is_group_of(std::make_shared<MatrixGroup>(MatrixAlgebra::su2()), LieAlgebra::so3()));
  BOOST_TEST(!is_group_of(std::make_shared<MatrixGroup>(MatrixAlgebra::sl(2)), LieAlgebra::so3()));
}

// A(x y) = A(x) A(y), and the differential at the unit is ρ.
BOOST_AUTO_TEST_CASE(actions_are_representations) {
  std::mt19937 generator(1);
  for (const auto& [group, rho] :
       {std::pair<std::shared_ptr<const Manifold>, std::vector<MatrixXd>>(rotations, turns(3, 1)),
        {rotations, turns(3, 2)},
        {motions, turns(6, 1)},
        {std::make_shared<SpecialOrthogonal>(4), turns_of_four()},
        {rotations, symmetric_square(turns(3, 1))},
        {rotations, symmetric_square(exterior_square(turns(3, 1)))},
        {std::make_shared<SpecialOrthogonal>(4), exterior_square(turns_of_four())},
        {motions, dual(adjoint_representation(LieAlgebra::se3()))}}) {
    const GroupAction action = group_action(*group, rho);
    BOOST_REQUIRE(action);
    const auto A = [&](const VectorXd& x) { return MatrixXd(values(action(constants(x)))); };
    const VectorXd e = *group->unit();
    const VectorXd x = group->random_point(generator);
    const VectorXd v = group->random_tangent(e, 0.7, generator);
    const VectorXd y = group->retract(e, v), xy = group->retract(x, v);
    BOOST_TEST((A(xy) - A(x) * A(y)).norm() < 2e-14 * A(x).norm());
    MatrixXd sum = MatrixXd::Zero(rho[0].rows(), rho[0].cols());
    for (Index i = 0; i < v.size(); ++i) sum += v[i] * rho[static_cast<std::size_t>(i)];
    const VectorXd near = group->retract(e, VectorXd(1e-5 * v));
    const VectorXd back = group->retract(e, VectorXd(-1e-5 * v));
    BOOST_TEST(((A(near) - A(back)) / 2e-5 - sum).norm() < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(actions_that_are_not_known) {
  auto transposed = turns(3, 1);
  for (MatrixXd& rho : transposed) rho.transposeInPlace();
  BOOST_TEST(!group_action(*rotations, transposed));
  BOOST_TEST(!group_action(*motions, turns(3, 1)));
  BOOST_TEST(!group_action(Euclidean(3), turns(3, 1)));
  // e^x is no polynomial.
  BOOST_TEST(!group_action(Euclidean(1), {MatrixXd::Ones(1, 1)}));
  const GroupAction trivial =
      group_action(Euclidean(2), {MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 4)});
  BOOST_REQUIRE(trivial);
  BOOST_TEST(values(trivial(constants(VectorXd{{1.0, 2.0}}))).isIdentity(0.0));
  BOOST_TEST(group_action(*rotations, {})(constants(*rotations->unit())).size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
