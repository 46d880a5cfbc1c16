#include "courant/integrators/methods/composed_differential.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

// Mistakes that these cases have to notice:
//  * all parts have the differential of the first
BOOST_AUTO_TEST_SUITE(composed_differential)

using namespace courant;

namespace {

// x ↦ A x, whatever the step.
class Linear final : public StepDifferential {
 public:
  explicit Linear(MatrixXd A) : A_(std::move(A)) {}

 private:
  MatrixXd do_images(const Step&, const MatrixXd& V) const override { return A_ * V; }
  MatrixXd do_pull_back(const Step&, const MatrixXd& Lambda) const override {
    return A_.transpose() * Lambda;
  }
  MatrixXd A_;
};

std::shared_ptr<const StepDifferential> linear(double a, double b, double c, double d) {
  MatrixXd A(2, 2);
  A << a, b, c, d;
  return std::make_shared<Linear>(A);
}

Step at_zero(double h) {
  const State state{.x = VectorXd::Zero(2)};
  return {.h = h, .before = state, .after = state};
}
Step of_parts(std::size_t count, double h = 0.5) {
  Step step = at_zero(1.0);
  step.parts.assign(count, at_zero(h));
  return step;
}

const auto shear = linear(1, 1, 0, 1), stretch = linear(2, 0, 0, 3);

}  // namespace

// Matrices that do not commute: T Φ_2 ∘ T Φ_1, the first part first.
BOOST_AUTO_TEST_CASE(parts_are_applied_one_after_the_other) {
  const auto both = ComposedDifferential::of("method", {shear, stretch});
  MatrixXd expected(2, 2);
  expected << 2, 2, 0, 3;
  BOOST_TEST(((*both)(of_parts(2), MatrixXd::Identity(2, 2)) == expected));
}

// The adjoint of a product is that of the factors, the last part first.
BOOST_AUTO_TEST_CASE(covectors_are_pulled_back_through_the_last_part_first) {
  const auto both = ComposedDifferential::of("method", {shear, stretch});
  MatrixXd expected(2, 2);
  expected << 2, 0, 2, 3;
  BOOST_TEST((both->pull_back(of_parts(2), MatrixXd::Identity(2, 2)) == expected));
  BOOST_CHECK_THROW(both->pull_back(of_parts(2), MatrixXd::Identity(3, 3)), std::invalid_argument);
  BOOST_CHECK_THROW(both->pull_back(of_parts(2, 0.0), MatrixXd::Identity(2, 2)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(differentials_go_in_turn) {
  const auto one = ComposedDifferential::of("method", {shear});
  BOOST_TEST((*one)(of_parts(5), MatrixXd::Identity(2, 2))(0, 1) == 5.0);
  const auto both = ComposedDifferential::of("method", {shear, stretch});
  BOOST_TEST((*both)(of_parts(3), MatrixXd::Identity(2, 2))(0, 1) == 5.0);
}

BOOST_AUTO_TEST_CASE(without_one_of_them_there_is_none) {
  BOOST_TEST(!ComposedDifferential::of("method", {shear, nullptr}));
}

BOOST_AUTO_TEST_CASE(a_step_that_does_not_know_its_parts_is_refused) {
  const auto one = ComposedDifferential::of("method", {shear});
  const MatrixXd V = MatrixXd::Identity(2, 2);
  BOOST_CHECK_THROW((*one)(of_parts(0), V), std::invalid_argument);
  BOOST_CHECK_THROW((*one)(of_parts(2, 0.0), V), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
