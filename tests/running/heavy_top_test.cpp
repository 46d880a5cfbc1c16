// The heavy top in three formulations: on T*SO(3), as a Lie-Poisson system on e(3)*, and as
// constrained motion of a matrix. Each route knows nothing of the others.
#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(heavy_top)

namespace {

using test::method_1, test::method_2;

constexpr double kTime = 1.0;

// The vertical in the body at the end: the last row of R, or G.
const VectorXd& vertical() {
  static const VectorXd end = test::problem(test::experiment_file("heavy_top_lie_poisson"))
                                  .end("dopri5", kTime, 500)
                                  .tail(3);
  return end;
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_rotations) {
  const auto top = test::problem(test::experiment_file("heavy_top_so3"));
  BOOST_TEST((top.end("dopri5", kTime, 500).segment(6, 3) - vertical()).norm() < 1e-11);
  for (const char* map : {"exponential", "cayley"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(top.order(method, kTime, vertical(), 6) - 2.0) < 0.15, method.dump());
}

BOOST_AUTO_TEST_CASE(as_a_lie_poisson_system) {
  const auto top = test::problem(test::experiment_file("heavy_top_lie_poisson"));
  BOOST_TEST(std::abs(top.order(method_1("midpoint"), kTime, vertical(), 3) - 2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(as_constrained_motion) {
  const auto top = test::problem(test::experiment_file("heavy_top_constrained"));
  BOOST_TEST(top.ladder.degrees_of_freedom == 6);
  BOOST_TEST((top.end("dopri5", kTime, 500).segment(6, 3) - vertical()).norm() < 1e-9);
  BOOST_TEST(std::abs(top.order(method_2("midpoint"), kTime, vertical(), 6, {32, 64, 128, 256}) -
                      2.0) < 0.15);
}

// P·G and |G|² are Casimirs of e(3)*; on T*SO(3) the first is the moment map of turns about the
// vertical.
BOOST_AUTO_TEST_CASE(casimirs_and_moment_map) {
  const auto lie_poisson = test::problem(test::experiment_file("heavy_top_lie_poisson"));
  const VectorXd before = lie_poisson.ladder.point.x;
  const VectorXd after = lie_poisson.end(method_1("midpoint"), 20.0, 2000);
  BOOST_TEST(std::abs(after.tail(3).norm() - 1.0) < 1e-13);
  BOOST_TEST(std::abs(after.head(3).dot(after.tail(3)) - before.head(3).dot(before.tail(3))) <
             1e-12);
  const auto on_rotations = test::problem(test::experiment_file("heavy_top_so3"));
  const VectorXd x = on_rotations.end(method_1("cayley"), 20.0, 2000);
  BOOST_TEST(std::abs(x.segment(6, 3).dot(x.tail(3)) - before.head(3).dot(before.tail(3))) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
