#include "courant/integrators/predictor.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

using namespace courant;

namespace {

const MatrixXd kIdentity = MatrixXd::Identity(1, 1);

// ‖y_k - its prediction‖_∞ for k = 0 … count - 1 (at k = 0 without one).
template <class Sequence>
std::vector<double> errors(Predictor& predictor, int count, const Sequence& y) {
  std::vector<double> result;
  for (int k = 0; k < count; ++k) {
    const VectorXd right = y(k);
    VectorXd predicted = VectorXd::Zero(right.size());
    if (!predictor.is_empty()) predictor.predict(kIdentity, predicted);
    result.push_back((predicted - right).lpNorm<Eigen::Infinity>());
    predictor.record(kIdentity, right);
  }
  return result;
}

VectorXd two(double first, double second) { return Eigen::Vector2d(first, second); }

}  // namespace

BOOST_AUTO_TEST_SUITE(predictor)

// A polynomial is continued exactly as soon as one more unknown than its degree is known.
BOOST_AUTO_TEST_CASE(polynomials) {
  for (int degree = 0; degree <= Predictor::kMaxDegree; ++degree) {
    const Euclidean line(1);
    Predictor predictor(line, 1, 1);
    const auto found = errors(predictor, 41, [&](int k) {
      return VectorXd(VectorXd::Constant(1, std::pow(0.05 * k - 1.0, degree)));
    });
    for (std::size_t k = 0; k < found.size(); ++k)
      if (k > static_cast<std::size_t>(degree))
        BOOST_TEST(found[k] < 1e-12, "degree " << degree << ", step " << k << ": " << found[k]);
  }
}

// Smooth and slow: all but round-off is foreseen, which a parabola is far from.
BOOST_AUTO_TEST_CASE(smooth) {
  const Euclidean line(1);
  Predictor predictor(line, 1, 2);
  const auto found =
      errors(predictor, 200, [](int k) { return two(std::sin(0.05 * k), std::cos(0.03 * k)); });
  for (std::size_t k = 20; k < found.size(); ++k) BOOST_TEST(found[k] < 3e-12);
}

// In noise the last value is about as good as any; high degrees would make it 2⁸ times larger.
BOOST_AUTO_TEST_CASE(rough) {
  const Euclidean line(1);
  Predictor predictor(line, 1, 2);
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
  const Euclidean line(1);
  Predictor predictor(line, 1, 2);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  VectorXd predicted(2);
  for (int k = 0; k < 200; ++k) {
    const double right = std::sin(0.05 * k);
    if (k > 20) {
      predictor.predict(kIdentity, predicted);
      BOOST_TEST(std::fabs(predicted[0] - right) < 3e-12);
    }
    predictor.record(kIdentity, two(right, noise(generator)));
  }
}

// Coordinates with respect to a basis that is another one in every step: the vector is continued.
BOOST_AUTO_TEST_CASE(turning_bases) {
  const Sphere sphere(2);
  Predictor predictor(sphere, 1, 2);
  const auto basis = [](int k) {
    MatrixXd B = MatrixXd::Zero(3, 2);
    B(0, 0) = B(1, 1) = std::cos(0.7 * k);
    B(1, 0) = std::sin(0.7 * k);
    B(0, 1) = -B(1, 0);
    return B;
  };
  const auto vector = [](int k) {
    return Eigen::Vector3d(std::sin(0.05 * k), 1.0 + std::cos(0.04 * k), 0.0);
  };
  VectorXd predicted(2);
  for (int k = 0; k < 100; ++k) {
    if (k > 20) {
      predictor.predict(basis(k), predicted);
      BOOST_TEST((basis(k) * predicted - vector(k)).norm() < 1e-11);
    }
    predictor.record(basis(k), basis(k).transpose() * vector(k));
  }
}

// An unknown that equations do not determine goes on as predicted: its round-off must not grow like
// a high power of the steps.
BOOST_AUTO_TEST_CASE(undetermined) {
  const auto last = [](int limit) {
    Predictor predictor(2);
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

BOOST_AUTO_TEST_SUITE_END()
