#include "courant/integrators/step/predictor.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

// Mistakes that these cases have to notice:
//  * the last of an odd number of unknowns is not extrapolated
//  * sequences of another kind are believed
//  * what equations leave open grows by what sequences hand to each other
//  * what changes its sign in each step is predicted from all of them
//  * every second step is extrapolated where all of them are as good
//  * the last of eight unknowns are not extrapolated
BOOST_AUTO_TEST_SUITE(predictor)

using namespace courant;

namespace {

// ‖y_k - its prediction‖_∞ for k = 0 … count - 1 (at k = 0 without one).
template <class Sequence>
std::vector<double> errors(Predictor& predictor, int count, const Sequence& y) {
  std::vector<double> result;
  for (int k = 0; k < count; ++k) {
    const VectorXd right = y(k);
    VectorXd predicted = VectorXd::Zero(right.size());
    if (!predictor.is_empty()) predictor.predict(predicted);
    result.push_back((predicted - right).lpNorm<Eigen::Infinity>());
    predictor.record(right);
  }
  return result;
}

VectorXd two(double first, double second) { return Eigen::Vector2d(first, second); }

}  // namespace

// Unknowns at other places are neither read nor written.
BOOST_AUTO_TEST_CASE(places) {
  Predictor predictor({2, 2}, {1, 2}), alone({1, 1});
  for (int k = 0; k < 30; ++k) {
    const double a = std::sin(0.1 * k), b = k % 3;
    predictor.record(Eigen::Vector4d(std::nan(""), a, b, std::nan("")));
    alone.record(two(a, b));
    VectorXd y = VectorXd::Constant(4, 7.0), expected = two(0.0, 0.0);
    predictor.predict(y);
    alone.predict(expected);
    BOOST_TEST(y == (VectorXd(4) << 7.0, expected, 7.0).finished());
  }
}

// A polynomial is continued exactly as soon as one more unknown than its degree is known.
BOOST_AUTO_TEST_CASE(polynomials) {
  for (int degree = 0; degree <= Predictor::kMaxDegree; ++degree) {
    Predictor predictor({1});
    const auto found = errors(predictor, 41, [&](int k) {
      return VectorXd(VectorXd::Constant(1, std::pow(0.05 * k - 1.0, degree)));
    });
    for (std::size_t k = 0; k < found.size(); ++k)
      if (k > static_cast<std::size_t>(degree))
        BOOST_TEST(found[k] < 1e-12, "degree " << degree << ", step " << k << ": " << found[k]);
  }
}

// Eight, two and one at a time, each unknown is extrapolated from what it was itself.
BOOST_AUTO_TEST_CASE(many_unknowns) {
  Predictor predictor({11, 8});
  const auto found = errors(predictor, 30, [](int k) {
    VectorXd y(19);
    for (Index i = 0; i < 19; ++i)
      y[i] = static_cast<double>(i) - 0.3 * k + std::pow(0.05 * k, i % 4);
    return y;
  });
  for (std::size_t k = 5; k < found.size(); ++k) BOOST_TEST(found[k] < 1e-11);
}

// Smooth and slow: all but round-off is foreseen, which a parabola is far from.
BOOST_AUTO_TEST_CASE(smooth) {
  Predictor predictor({1, 1});
  const auto found =
      errors(predictor, 200, [](int k) { return two(std::sin(0.05 * k), std::cos(0.03 * k)); });
  for (std::size_t k = 20; k < found.size(); ++k) BOOST_TEST(found[k] < 3e-12);
}

// A part that changes its sign in each step, beside a smooth one: polynomials would be wrong by all of it.
BOOST_AUTO_TEST_CASE(alternating) {
  Predictor predictor({1, 1});
  const auto found = errors(predictor, 200, [](int k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    return two(std::sin(0.05 * k) + sign * std::cos(0.03 * k), std::cos(0.03 * k));
  });
  for (std::size_t k = 20; k < found.size(); ++k) BOOST_TEST(found[k] < 2e-4);
}

// In noise the last value is about as good as any; high degrees would make it 2⁸ times larger.
BOOST_AUTO_TEST_CASE(rough) {
  Predictor predictor({1, 1});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  const auto found = errors(predictor, 2000, [&](int) {
    const double first = noise(generator);
    return two(first, noise(generator));
  });
  double largest = 0.0;
  for (std::size_t k = 20; k < found.size(); ++k) largest = std::max(largest, found[k]);
  BOOST_TEST(largest < 8.0);
}

// A rough multiplier leaves the prediction of the vectors as good as it was.
BOOST_AUTO_TEST_CASE(degrees_apart) {
  Predictor predictor({1, 1});
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  VectorXd predicted(2);
  for (int k = 0; k < 200; ++k) {
    const double right = std::sin(0.05 * k);
    if (k > 20) {
      predictor.predict(predicted);
      BOOST_TEST(std::fabs(predicted[0] - right) < 3e-12);
    }
    predictor.record(two(right, noise(generator)));
  }
}

// After that the first unknowns of another sequence are foreseen as if they were the first.
BOOST_AUTO_TEST_CASE(forgets) {
  Predictor predictor({2});
  errors(predictor, 50, [](int k) { return two(std::sin(0.05 * k), 1.0); });
  predictor.forget();
  BOOST_TEST(predictor.is_empty());
  const auto found =
      errors(predictor, 40, [](int k) { return two(7.0 - 0.1 * k, 3.0 + 0.01 * k * k); });
  for (std::size_t k = 3; k < found.size(); ++k) BOOST_TEST(found[k] < 1e-10);
}

// An unknown that equations do not determine goes on as predicted: its round-off must not grow like
// a high power of the steps.
BOOST_AUTO_TEST_CASE(undetermined) {
  const auto last = [](int limit) {
    Predictor predictor({2});
    predictor.limit_degree(limit);
    VectorXd y = two(1.0, 0.3);
    for (int k = 0; k < 20000; ++k) {
      if (!predictor.is_empty()) predictor.predict(y);
      y[0] = std::sin(0.05 * k);
      predictor.record(y);
    }
    return y[1];
  };
  BOOST_TEST(std::fabs(last(Predictor::kUndetermined) - 0.3) < 1e-8);
  BOOST_TEST(!(std::fabs(last(Predictor::kMaxDegree) - 0.3) < 1.0));
}

namespace {

// The greatest error of predictions of f(k) that learn from those of `near` (k - 0.1) and (k - 0.3).
template <class Sequence, class Near>
double error_of_learning(const Sequence& f, const Near& near, bool learns) {
  Predictor first({2}), second({2}), learning({2});
  if (learns) {  // by a straight line through both errors
    learning.learn_from(first, two(1.5, 1.5));
    learning.learn_from(second, two(-0.5, -0.5));
  }
  double greatest = 0.0;
  VectorXd y = VectorXd::Zero(2);
  for (int k = 0; k < 100; ++k) {
    second.record(near(k - 0.3));
    first.record(near(k - 0.1));
    if (!learning.is_empty()) learning.predict(y);
    if (k > 20) greatest = std::max(greatest, (y - f(k)).norm());
    learning.record(f(k));
  }
  return greatest;
}

VectorXd circle(double k) { return two(std::sin(0.3 * k), std::cos(0.3 * k)); }

}  // namespace

// What sequences nearby in time have been predicted wrongly by, this one will be too. What they are
// apart by otherwise does not matter, if it is as smooth.
BOOST_AUTO_TEST_CASE(learns_from_sequences_nearby) {
  const double alone = error_of_learning(circle, circle, false);
  BOOST_TEST(error_of_learning(circle, circle, true) < 0.01 * alone);
  const auto apart = [](double k) { return VectorXd(circle(k) + two(3.0, 0.01 * k * k)); };
  BOOST_TEST(error_of_learning(circle, apart, true) < 0.01 * alone);
}

// One that has nothing to do with it, as in another basis, is not believed after the first steps.
BOOST_AUTO_TEST_CASE(learns_nothing_from_sequences_of_another_kind) {
  const double alone = error_of_learning(circle, circle, false);
  const auto turned = [](double k) { return VectorXd(-7.0 * circle(k)); };
  BOOST_TEST(error_of_learning(circle, turned, true) == alone);
}

// Where nothing is known of the sequences yet, or no longer, predictions are those without them.
BOOST_AUTO_TEST_CASE(learns_from_what_is_known) {
  Predictor near({2}), learning({2}), alone({2});
  learning.learn_from(near, two(2.0, 2.0));
  VectorXd y = two(0.0, 0.0), expected = y;
  for (int k = 0; k < 40; ++k) {
    if (k == 20) near.forget();
    if (k < 20) near.record(circle(0.1 * k));
    if (k >= 20 && k < 40) {
      learning.predict(y);
      alone.predict(expected);
      BOOST_TEST((y == expected));
    }
    learning.record(circle(0.1 * k + 0.05));
    alone.record(circle(0.1 * k + 0.05));
  }
}

// What equations leave open is what corrections of one sequence hand to the other: it must not grow.
BOOST_AUTO_TEST_CASE(undetermined_with_others) {
  Predictor first({2}), second({2});
  first.learn_from(second, two(3.0, 3.0));
  second.learn_from(first, two(3.0, 3.0));
  VectorXd y = two(1.0, 0.3), z = two(1.0, 0.3);
  for (int k = 0; k < 2000; ++k) {
    if (k > 2) first.predict(y), second.predict(z);
    if (k == 3)
      first.limit_degree(Predictor::kUndetermined), second.limit_degree(Predictor::kUndetermined);
    y[0] = std::sin(0.05 * k), z[0] = std::sin(0.05 * k + 0.02);
    first.record(y), second.record(z);
  }
  BOOST_TEST(std::fabs(y[1] - 0.3) < 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()
