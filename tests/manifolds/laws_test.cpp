// Each law has a manifold planted that breaks it, and only what depends on it.
#include "courant/manifolds/laws.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * M1 never fails
//  * M2 takes an order above 1 for 2
//  * M3 never fails
//  * M4 lets the inverse leave the tangent space
//  * M4 does not ask whether the inverse leads to y
//  * M5 does not hold the coframe against the frame
//  * M5 does not count the dimension
//  * M5 takes dependent constraints
//  * M7 never fails
//  * M7 is not asked of those that claim it
//  * M8 lets the projection move points
//  * M9 never fails
//  * M9 lets the unit be no point
//  * a scaling symmetry may leave the manifold
BOOST_AUTO_TEST_SUITE(manifold_laws)

using namespace courant;

namespace {

// S² with the exponential retraction, parts of which can be replaced.
class Planted final : public Manifold {
 public:
  using VectorMap = std::function<ExprVector(const ExprVector&, const ExprVector&)>;
  using MatrixMap = std::function<ExprMatrix(const ExprVector&)>;
  struct Parts {
    VectorMap retract = Sphere::exponential().map;
    VectorMap inverse = Sphere::exponential().inverse;
    MatrixMap frame = projector;
    MatrixMap coframe = projector;
    std::function<ExprVector(const ExprVector&)> constraint = [](const ExprVector& x) {
      return ExprVector(ExprVector::Constant(1, x.squaredNorm() - 1.0));
    };
    double radius = Sphere::exponential().injectivity_radius;
    bool geodesic = false;
    VectorXd project_offset = VectorXd::Zero(3);
    double project_turn = 0.0;  // about the last axis
    Index dimension = 2;
    std::optional<VectorXd> unit = std::nullopt;
    double velocity_factor = 1.0;
    std::optional<Manifold::ScalingSymmetries> scaling_symmetries = std::nullopt;
  };
  explicit Planted(Parts parts)
      : Manifold("Planted", parts.dimension, 3, 3), parts_(std::move(parts)) {}
  bool is_geodesic() const override { return parts_.geodesic; }

  static ExprMatrix projector(const ExprVector& x) {
    return ExprMatrix::Identity(3, 3) - x * x.transpose();
  }

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return parts_.retract(x, v);
  }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return parts_.inverse(x, y);
  }
  ExprMatrix do_frame(const ExprVector& x) const override { return parts_.frame(x); }
  ExprMatrix do_coframe(const ExprVector& x) const override { return parts_.coframe(x); }
  ExprVector do_constraint(const ExprVector& x) const override { return parts_.constraint(x); }
  double do_injectivity_radius(const VectorXd&) const override { return parts_.radius; }
  std::optional<VectorXd> do_unit() const override { return parts_.unit; }
  ScalingSymmetries do_scaling_symmetries() const override {
    const std::vector<Index> none(3, ScalingSymmetries::none);
    return parts_.scaling_symmetries.value_or(ScalingSymmetries{none, none, {0, 0, 0}});
  }
  ExprVector do_velocity_along(const ExprVector& x, const ExprVector& v,
                               const Expr& s) const override {
    return parts_.velocity_factor * differentiated_velocity(x, v, s);
  }
  VectorXd do_project(const VectorXd& x) const override {
    const Eigen::AngleAxisd turn(parts_.project_turn, Eigen::Vector3d::UnitZ());
    return turn.matrix() * x.normalized() + parts_.project_offset;
  }

  Parts parts_;
};

// R² with the retraction y = x + v, y_1 moved by bend(x_0) v_0².
enum class Claim { unit, scaling_symmetries };
class Sheared final : public Manifold {
 public:
  Sheared(std::function<Expr(const Expr&)> bend, Claim claim)
      : Manifold("Sheared", 2, 2, 2), bend_(std::move(bend)), claim_(claim) {}

 private:
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    ExprVector y = x + v;
    y[1] += bend_(x[0]) * square(v[0]);
    return y;
  }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    ExprVector v = y - x;
    v[1] -= bend_(x[0]) * square(v[0]);
    return v;
  }
  ExprMatrix do_frame(const ExprVector&) const override { return ExprMatrix::Identity(2, 2); }
  ExprMatrix do_coframe(const ExprVector&) const override { return ExprMatrix::Identity(2, 2); }
  std::optional<VectorXd> do_unit() const override {
    if (claim_ == Claim::unit) return VectorXd::Zero(2);
    return std::nullopt;
  }
  ScalingSymmetries do_scaling_symmetries() const override {
    const std::vector<Index> each = {0, 1}, none(2, ScalingSymmetries::none);
    return claim_ == Claim::scaling_symmetries ? ScalingSymmetries{each, each, each}
                                               : ScalingSymmetries{none, none, {0, 0}};
  }
  std::function<Expr(const Expr&)> bend_;
  Claim claim_;
};

// "M9 ", "M11": of the laws that do not hold.
std::vector<std::string> broken_by(const Manifold& M) {
  std::vector<std::string> laws;
  for (const LawResult& result : check_manifold(M))
    if (!result.passed()) laws.push_back(result.law.substr(0, 3));
  return laws;
}

ExprVector normalised(const ExprVector& x) { return x / sqrt(x.squaredNorm()); }

bool fails(const Planted::Parts& parts, const std::string& law) {
  for (const LawResult& result : check_manifold(Planted(parts)))
    if (!result.passed() && result.law.starts_with(law)) return true;
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_manifold_that_nothing_is_planted_in_passes) {
  Planted::Parts parts;
  BOOST_TEST(all_passed(check_manifold(Planted(parts))));
  parts.geodesic = true;
  BOOST_TEST(all_passed(check_manifold(Planted(parts))));
}

BOOST_AUTO_TEST_CASE(m1_a_retraction_that_moves_points) {
  Planted::Parts parts;
  parts.retract = [](const ExprVector& x, const ExprVector& v) {
    ExprVector y = x + v;
    y[0] += 1e-9;
    return normalised(y);
  };
  BOOST_TEST(fails(parts, "M1"));
}

BOOST_AUTO_TEST_CASE(m2_a_retraction_that_is_not_rigid) {
  Planted::Parts parts;
  parts.retract = [](const ExprVector& x, const ExprVector& v) {
    return normalised(x + Expr(1.001) * v);
  };
  BOOST_TEST(fails(parts, "M2 d/ds"));
  BOOST_TEST(fails(parts, "M2 slope"));
}

BOOST_AUTO_TEST_CASE(m3_a_retraction_that_leaves_the_manifold) {
  Planted::Parts parts;
  parts.retract = [](const ExprVector& x, const ExprVector& v) { return ExprVector(x + v); };
  BOOST_TEST(fails(parts, "M3"));
}

BOOST_AUTO_TEST_CASE(m4_an_inverse_of_another_retraction) {
  Planted::Parts parts;
  parts.inverse = Sphere::projective().inverse;
  BOOST_TEST(fails(parts, "M4 R⁻¹(x, R"));
}

BOOST_AUTO_TEST_CASE(m4_an_inverse_that_is_not_tangent) {
  Planted::Parts parts;
  parts.inverse = [](const ExprVector& x, const ExprVector& y) {
    return ExprVector(Sphere::exponential().inverse(x, y) + Expr(1e-3) * x);
  };
  parts.retract = [](const ExprVector& x, const ExprVector& v) {  // which that leaves alone
    return Sphere::exponential().map(x, Planted::projector(x) * v);
  };
  BOOST_TEST(fails(parts, "M4 R(x, R⁻¹"));
}

// One round trip still closes: the short way round leads to the same point.
BOOST_AUTO_TEST_CASE(m4_a_radius_that_is_too_large) {
  Planted::Parts parts;
  parts.radius = 4.0;
  BOOST_TEST(fails(parts, "M4 R⁻¹(x, R"));
  BOOST_TEST(!fails(parts, "M4 R(x, R⁻¹"));
}

BOOST_AUTO_TEST_CASE(m4_a_radius_that_is_no_length) {
  for (const double radius : {std::numeric_limits<double>::infinity(), -1.0, 0.0, std::nan("")}) {
    Planted::Parts parts;
    parts.radius = radius;
    BOOST_TEST(fails(parts, "M4 r(x)"), radius);
  }
  // A retraction that never comes back may have no bound.
  Planted::Parts parts;
  parts.retract = Sphere::projective().map;
  parts.inverse = Sphere::projective().inverse;
  parts.radius = std::numeric_limits<double>::infinity();
  BOOST_TEST(!fails(parts, "M4 r(x)"));
}

// Wrong only at distances between those of the tangent vectors that are tried.
BOOST_AUTO_TEST_CASE(m4_an_inverse_that_is_wrong_at_some_distances) {
  Planted::Parts parts;
  parts.inverse = [](const ExprVector& x, const ExprVector& y) {
    const ExprVector v = Sphere::exponential().inverse(x, y);
    const Expr s = v.squaredNorm();
    return ExprVector(select(s > 1e-4, select(s < 0.1, 1.001, 1.0), 1.0) * v);
  };
  BOOST_TEST(!fails(parts, "M4 R⁻¹(x, R"));
  BOOST_TEST(fails(parts, "M4 R(x, R⁻¹"));
}

BOOST_AUTO_TEST_CASE(m4_an_inverse_that_throws) {
  Planted::Parts parts;
  parts.inverse = [](const ExprVector&, const ExprVector&) -> ExprVector {
    throw std::logic_error("forgotten");
  };
  BOOST_TEST(fails(parts, "M4"));
  BOOST_TEST(fails(parts, "M6"));
}

BOOST_AUTO_TEST_CASE(m5_frames_that_do_not_fit_each_other) {
  Planted::Parts parts;
  parts.coframe = [](const ExprVector& x) {
    return ExprMatrix(Expr(1.0 + 1e-9) * Planted::projector(x));
  };
  BOOST_TEST(fails(parts, "M5 C E C"));
}

// C = 1 is a left inverse of the frame, but its values are not tangent.
BOOST_AUTO_TEST_CASE(m5_a_coframe_that_is_not_tangent) {
  Planted::Parts parts;
  parts.coframe = [](const ExprVector&) { return ExprMatrix(ExprMatrix::Identity(3, 3)); };
  BOOST_TEST(fails(parts, "M5 C E C"));
}

// The directions of latitude alone: tangent, and too few.
BOOST_AUTO_TEST_CASE(m5_a_frame_of_too_few_directions) {
  Planted::Parts parts;
  parts.frame = parts.coframe = [](const ExprVector& x) {
    ExprVector east(3);
    east << -x[1], x[0], Expr(0.0);
    return ExprMatrix(east * east.transpose() / east.squaredNorm());
  };
  BOOST_TEST(fails(parts, "M5 E(x) has range"));
}

BOOST_AUTO_TEST_CASE(m5_a_frame_that_is_not_tangent) {
  Planted::Parts parts;
  parts.frame = parts.coframe = [](const ExprVector&) {
    ExprMatrix E = ExprMatrix::Identity(3, 3);
    E(2, 2) = 0.0;
    return E;
  };
  BOOST_TEST(fails(parts, "M5 E(x) has range"));
}

BOOST_AUTO_TEST_CASE(m5_a_dimension_that_is_wrong) {
  Planted::Parts parts;
  parts.dimension = 1;
  BOOST_TEST(fails(parts, "M5 E(x) has range"));
}

BOOST_AUTO_TEST_CASE(m5_a_constraint_with_a_vanishing_derivative) {
  Planted::Parts parts;
  parts.constraint = [](const ExprVector& x) {
    return ExprVector(ExprVector::Constant(1, square(x.squaredNorm() - 1.0)));
  };
  BOOST_TEST(fails(parts, "M5 E(x) has range"));
}

// The textbook formula with ‖v‖: every value is right except at v = 0, and there so is the guard.
BOOST_AUTO_TEST_CASE(m6_an_exponential_that_is_not_smooth_at_zero) {
  Planted::Parts parts;
  parts.retract = [](const ExprVector& x, const ExprVector& v) {
    const Expr s = v.squaredNorm();
    const Expr norm = sqrt(select(equal(s, 0.0), 1.0, s));
    const ExprVector moved = cos(norm) * x + sin(norm) / norm * v;
    return ExprVector(moved.binaryExpr(
        x, [&](const Expr& m, const Expr& e) { return select(equal(s, 0.0), e, m); }));
  };
  BOOST_TEST(!fails(parts, "M1"));
  BOOST_TEST(!fails(parts, "M3"));
  BOOST_TEST(!fails(parts, "M4"));
  BOOST_TEST(fails(parts, "M6 derivatives of R, E"));
}

// The textbook formula, θ/sin θ with θ = arccos⟨x, y⟩ and a guard at y = x: every value is right.
BOOST_AUTO_TEST_CASE(m6_a_logarithm_that_is_not_smooth_at_zero) {
  Planted::Parts parts;
  parts.inverse = [](const ExprVector& x, const ExprVector& y) {
    const Expr c = x.dot(y);
    const Expr inside = select(c < 1.0, c, 0.5);
    const Expr factor = acos(inside) / sqrt(1.0 - square(inside));
    return ExprVector(select(c < 1.0, factor, 1.0) * (y - c * x));
  };
  BOOST_TEST(!fails(parts, "M4"));
  BOOST_TEST(!fails(parts, "M6 derivatives of R, E"));
  BOOST_TEST(fails(parts, "M6 derivatives of R⁻¹"));
}

// log + 1e-11 log/‖log‖: within the bounds of the round trips, and steep near zero.
BOOST_AUTO_TEST_CASE(m6_a_logarithm_with_a_kink) {
  Planted::Parts parts;
  parts.inverse = [](const ExprVector& x, const ExprVector& y) {
    const ExprVector v = Sphere::exponential().inverse(x, y);
    const Expr s = v.squaredNorm();
    return ExprVector((1.0 + 1e-11 / sqrt(select(s > 0.0, s, 1.0))) * v);
  };
  BOOST_TEST(!fails(parts, "M4"));
  BOOST_TEST(fails(parts, "M6 derivatives of R⁻¹"));
}

BOOST_AUTO_TEST_CASE(m7_a_retraction_that_is_not_geodesic) {
  Planted::Parts parts;
  parts.retract = Sphere::projective().map;
  parts.inverse = Sphere::projective().inverse;
  parts.radius = 1.0;
  BOOST_TEST(all_passed(check_manifold(Planted(parts))));
  parts.geodesic = true;
  BOOST_TEST(fails(parts, "M7"));
}

// S² is no group, and no point off a manifold is its unit.
BOOST_AUTO_TEST_CASE(m9_a_unit_that_is_none) {
  for (const VectorXd& unit :
       {VectorXd(Eigen::Vector3d::UnitZ()), VectorXd(VectorXd::Zero(3)),
        VectorXd(VectorXd::Constant(3, std::nan(""))), VectorXd(VectorXd::Ones(4))}) {
    Planted::Parts parts;
    parts.unit = unit;
    BOOST_TEST(fails(parts, "M9"));
  }
}

// A sphere is not as large in another unit.
BOOST_AUTO_TEST_CASE(m11_a_scaling_symmetry_that_leaves_the_manifold) {
  Planted::Parts parts;
  parts.scaling_symmetries = Manifold::ScalingSymmetries{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  BOOST_TEST(fails(parts, "M11"));
  parts.scaling_symmetries = Manifold::ScalingSymmetries{{-1, -1}, {-1, -1, -1}, {0, 0, 0}};
  BOOST_CHECK_THROW(Planted(parts).scaling_symmetries(), std::invalid_argument);
}

// Nor does a retraction that is not linear fit with units of its own for each coordinate, on the plane.
BOOST_AUTO_TEST_CASE(m11_a_scaling_symmetry_that_the_retraction_does_not_know) {
  BOOST_TEST(
      broken_by(Sheared([](const Expr&) { return 0.0; }, Claim::scaling_symmetries)).empty());
  BOOST_TEST((broken_by(Sheared([](const Expr&) { return 0.3; }, Claim::scaling_symmetries)) ==
              std::vector<std::string>{"M11"}));
}

BOOST_AUTO_TEST_CASE(m10_a_velocity_that_is_not_that_of_the_curve) {
  Planted::Parts parts;
  parts.velocity_factor = 1.0 + 1e-9;
  BOOST_TEST(fails(parts, "M10"));
  BOOST_TEST(!fails(parts, "M7"));
}

// Functions whose results have other sizes than the class promises.
BOOST_AUTO_TEST_CASE(results_of_wrong_sizes_are_refused) {
  const VectorXd x = Eigen::Vector3d::UnitX(), v = Eigen::Vector3d::UnitY();
  Planted::Parts parts;
  parts.frame = [](const ExprVector&) { return ExprMatrix(ExprMatrix::Zero(3, 2)); };
  BOOST_CHECK_THROW(Planted(parts).frame(x), std::invalid_argument);
  BOOST_CHECK_THROW(Planted(parts).tangent_projector(x), std::invalid_argument);
  const auto laws = check_manifold(Planted(parts));
  BOOST_TEST(!all_passed(laws));
  BOOST_TEST(laws.front().where.find("the result is 3 × 2") != std::string::npos);
  parts = {};
  parts.coframe = [](const ExprVector&) { return ExprMatrix(ExprMatrix::Zero(4, 3)); };
  BOOST_CHECK_THROW(Planted(parts).coframe(x), std::invalid_argument);
  parts = {};
  parts.retract = parts.inverse = [](const ExprVector& point, const ExprVector& vector) {
    return ExprVector(point.head(2) + vector.head(2));
  };
  BOOST_CHECK_THROW(Planted(parts).retract(x, v), std::invalid_argument);
  BOOST_CHECK_THROW(Planted(parts).inverse_retract(x, v), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(m8_a_projection_that_moves_points_of_the_manifold) {
  Planted::Parts parts;
  parts.project_offset[1] = 1e-9;
  BOOST_TEST(fails(parts, "M8"));
}

BOOST_AUTO_TEST_CASE(m8_a_projection_that_moves_points_along_the_manifold) {
  Planted::Parts parts;
  parts.project_turn = 1e-9;
  BOOST_TEST(fails(parts, "M8"));
}

// R² with its addition, but a retraction that depends on where it starts.
BOOST_AUTO_TEST_CASE(m9_a_group_whose_retraction_is_not_invariant) {
  BOOST_TEST(broken_by(Sheared([](const Expr&) { return 0.0; }, Claim::unit)).empty());
  BOOST_TEST((broken_by(Sheared([](const Expr& x) { return 0.1 * x; }, Claim::unit)) ==
              std::vector<std::string>{"M9 "}));
}

BOOST_AUTO_TEST_SUITE_END()
