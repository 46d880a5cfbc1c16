#include "courant/structures/implicit_system.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"

// Mistakes that these cases have to notice:
//  * a residual of the wrong size is passed on
BOOST_AUTO_TEST_SUITE(implicit_system)

using namespace courant;

namespace {

// x' = z, x + z = t.
class Relaxation final : public ImplicitSystem {
 public:
  explicit Relaxation(Names names = {}, Index equations = 2)
      : ImplicitSystem(std::make_shared<Euclidean>(1), 1, equations, std::move(names)) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    ExprVector result(2);
    result << v[0] - z[0], x[0] + z[0] - t;
    return result;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(residual) {
  const Relaxation system;
  const VectorXd r = system.residual(VectorXd::Constant(1, 2.0), VectorXd::Constant(1, 3.0),
                                     VectorXd::Constant(1, 0.5), 4.0);
  BOOST_TEST(r[0] == 2.5);
  BOOST_TEST(r[1] == -1.5);
  BOOST_TEST(!system.energy(ExprVector::Zero(1), ExprVector::Zero(1), 0.0).has_value());
}

BOOST_AUTO_TEST_CASE(names_have_defaults_and_are_checked) {
  BOOST_TEST(Relaxation().names().equations[1] == "equation[1]");
  BOOST_TEST(Relaxation({.coordinates = {"charge"}, .auxiliary = {}, .equations = {}})
                 .names()
                 .coordinates[0] == "charge");
  BOOST_CHECK_THROW(Relaxation({.coordinates = {}, .auxiliary = {"a", "b"}, .equations = {}}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(wrong_sizes_are_refused) {
  const VectorXd one = VectorXd::Zero(1), two = VectorXd::Zero(2);
  BOOST_CHECK_THROW(Relaxation().residual(two, one, one, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(Relaxation().residual(one, two, one, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(Relaxation().residual(one, one, two, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(Relaxation({}, 3).residual(one, one, one, 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
