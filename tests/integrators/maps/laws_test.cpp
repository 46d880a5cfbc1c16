// Each law has a discretization map planted that breaks it.
#include "courant/integrators/maps/laws.hpp"

#include <boost/test/unit_test.hpp>
#include <functional>
#include <limits>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/spherical_midpoint.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

BOOST_AUTO_TEST_SUITE(discretization_laws)

using namespace courant;

namespace {

// A map of which parts can be replaced.
class Planted final : public DiscretizationMap {
 public:
  using Map = std::function<PointPair<Expr>(const ExprVector&, const ExprVector&)>;
  using Inverse = std::function<TangentVector<Expr>(const ExprVector&, const ExprVector&)>;
  using Start = std::function<Displacement(const ExprVector&, const ExprVector&)>;
  struct Parts {
    Map forward;
    Inverse inverse;
    int order;
    bool symmetric;
    std::optional<bool> symplectic;
    Start start = {};
    double stage_time = 0.5;
    bool left_invariant = false;
    double domain_radius = std::numeric_limits<double>::infinity();
  };
  Planted(std::shared_ptr<const Manifold> manifold, Parts parts)
      : DiscretizationMap("Planted", std::move(manifold)), parts_(std::move(parts)) {}
  int order() const override { return parts_.order; }
  bool is_symmetric() const override { return parts_.symmetric; }
  std::optional<bool> is_symplectic() const override { return parts_.symplectic; }
  double stage_time() const override { return parts_.stage_time; }
  bool is_left_invariant() const override { return parts_.left_invariant; }
  double domain_radius() const override { return parts_.domain_radius; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override {
    return parts_.forward(x, v);
  }
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override {
    return parts_.inverse(x0, x1);
  }
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override {
    return parts_.start ? parts_.start(x0, w) : from_start_by_inverse(x0, w);
  }

  Parts parts_;
};

Planted::Parts parts_of(const DiscretizationMap& map) {
  return {.forward = [&](const ExprVector& x, const ExprVector& v) { return map.forward(x, v); },
          .inverse = [&](const ExprVector& x, const ExprVector& y) { return map.inverse(x, y); },
          .order = map.order(),
          .symmetric = map.is_symmetric(),
          .symplectic = map.is_symplectic(),
          .stage_time = map.stage_time(),
          .left_invariant = map.is_left_invariant(),
          .domain_radius = map.domain_radius()};
}

bool fails(const DiscretizationMap& map, const Planted::Parts& parts, const std::string& law) {
  for (const LawResult& result :
       check_discretization_map(Planted(map.manifold(), parts), {.points = 1}))
    if (!result.passed() && result.law.starts_with(law)) return true;
  return false;
}

const Chordal& chordal() {
  static const Chordal map(std::make_shared<Sphere>(2));
  return map;
}

const CotangentLift& lift() {
  static const auto rotations = std::make_shared<SpecialOrthogonal3>();
  static const CotangentLift map(std::make_shared<CotangentBundle>(rotations),
                                 std::make_shared<Theta>(rotations, 0.5));
  return map;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_map_that_nothing_is_planted_in_passes) {
  BOOST_TEST(all_passed(
      check_discretization_map(Planted(chordal().manifold(), parts_of(chordal())), {.points = 1})));
  BOOST_TEST(all_passed(
      check_discretization_map(Planted(lift().manifold(), parts_of(lift())), {.points = 1})));
}

BOOST_AUTO_TEST_CASE(d1_a_map_that_moves_points) {
  auto parts = parts_of(chordal());
  parts.forward = [](const ExprVector& x, const ExprVector& v) {
    auto pair = chordal().forward(x, v);
    pair.first[1] += 1e-9;
    return pair;
  };
  BOOST_TEST(fails(chordal(), parts, "D1"));
}

BOOST_AUTO_TEST_CASE(d2_a_map_that_is_too_long) {
  auto parts = parts_of(chordal());
  parts.forward = [](const ExprVector& x, const ExprVector& v) {
    return chordal().forward(x, ExprVector(Expr(1.0 + 1e-9) * v));
  };
  BOOST_TEST(fails(chordal(), parts, "D2"));
}

BOOST_AUTO_TEST_CASE(d3_a_map_that_leaves_the_manifold) {
  auto parts = parts_of(chordal());
  parts.forward = [](const ExprVector& x, const ExprVector& v) {
    return DiscretizationMap::PointPair<Expr>{x - Expr(0.5) * v, x + Expr(0.5) * v};
  };
  BOOST_TEST(fails(chordal(), parts, "D3 R⁻ and R⁺"));
}

BOOST_AUTO_TEST_CASE(d3_an_inverse_of_another_map) {
  static const Theta geodesic(chordal().manifold());
  auto parts = parts_of(chordal());
  parts.inverse = parts_of(geodesic).inverse;
  BOOST_TEST(fails(chordal(), parts, "D3 R_d⁻¹(R_d"));
  BOOST_TEST(fails(chordal(), parts, "D3 R_d(R_d⁻¹"));
}

// The printed formula with ‖v‖ where that is not differentiable.
BOOST_AUTO_TEST_CASE(d3_an_inverse_that_is_not_smooth_at_the_diagonal) {
  auto parts = parts_of(chordal());
  parts.inverse = [](const ExprVector& x0, const ExprVector& x1) {
    auto result = chordal().inverse(x0, x1);
    const Expr s = result.v.squaredNorm();
    const Expr norm = sqrt(select(s < 1e-30, 1.0, s));
    result.v = norm * (result.v / norm);
    result.v = select(s < 1e-30, 0.0, 1.0) * result.v;
    return result;
  };
  BOOST_TEST(!fails(chordal(), parts, "D3 R_d⁻¹(R_d"));
  BOOST_TEST(fails(chordal(), parts, "D3 derivatives of R_d⁻¹"));
}

BOOST_AUTO_TEST_CASE(d5_pairs_that_end_elsewhere_or_are_too_long) {
  auto parts = parts_of(chordal());
  parts.start = [](const ExprVector& x0, const ExprVector& w) {
    return chordal().from_start(x0, w);
  };
  BOOST_TEST(!fails(chordal(), parts, "D5"));
  parts.start = [](const ExprVector& x0, const ExprVector& w) {
    auto result = chordal().from_start(x0, w);
    result.end = chordal().manifold()->retract(x0, w);  // right to second order
    return result;
  };
  BOOST_TEST(fails(chordal(), parts, "D5"));
  parts.start = [](const ExprVector& x0, const ExprVector& w) {
    return chordal().from_start(x0, ExprVector(Expr(1.5) * w));
  };
  BOOST_TEST(fails(chordal(), parts, "D5"));
}

BOOST_AUTO_TEST_CASE(d4_an_order_that_is_too_high_or_too_low) {
  const Theta explicit_euler(chordal().manifold(), 0.0);
  auto parts = parts_of(explicit_euler);
  BOOST_TEST(!fails(explicit_euler, parts, "D4 measured order"));
  parts.order = 2;
  BOOST_TEST(fails(explicit_euler, parts, "D4 measured order"));
  parts = parts_of(chordal());
  parts.order = 1;
  BOOST_TEST(fails(chordal(), parts, "D4 measured order"));
}

BOOST_AUTO_TEST_CASE(d4_a_symmetry_that_is_wrongly_claimed_or_denied) {
  const Theta asymmetric(chordal().manifold(), 0.49);
  auto parts = parts_of(asymmetric);
  parts.symmetric = true;
  BOOST_TEST(fails(asymmetric, parts, "D4 symmetric"));
  parts = parts_of(chordal());
  parts.symmetric = false;
  BOOST_TEST(fails(chordal(), parts, "D4 not symmetric"));
}

BOOST_AUTO_TEST_CASE(d4_symplecticity_that_is_wrongly_claimed_or_denied) {
  // The midpoint rule of T*SO(3) itself, which is no lift.
  const Theta midpoint(lift().manifold());
  auto parts = parts_of(midpoint);
  parts.symplectic = true;
  BOOST_TEST(fails(midpoint, parts, "D4 symplectic"));
  parts.symplectic = false;
  BOOST_TEST(!fails(midpoint, parts, "D4 not symplectic"));
  parts = parts_of(lift());
  parts.symplectic = false;
  BOOST_TEST(fails(lift(), parts, "D4 not symplectic"));
}

BOOST_AUTO_TEST_CASE(d4_symplecticity_off_a_cotangent_bundle) {
  auto parts = parts_of(chordal());
  parts.symplectic = true;
  BOOST_TEST(fails(chordal(), parts, "D4 is_symplectic"));
}

// Wherever the order is one, a stage at another time keeps it: D6 sees what D4 cannot.
BOOST_AUTO_TEST_CASE(d6_a_stage_at_another_time) {
  const Theta explicit_euler(chordal().manifold(), 0.0);
  auto parts = parts_of(explicit_euler);
  BOOST_TEST(!fails(explicit_euler, parts, "D6"));
  parts.stage_time = 0.5;
  BOOST_TEST(fails(explicit_euler, parts, "D6"));
  BOOST_TEST(!fails(explicit_euler, parts, "D4 measured order"));
  parts = parts_of(chordal());
  parts.stage_time = 0.4;
  BOOST_TEST(fails(chordal(), parts, "D6"));
  BOOST_TEST(fails(chordal(), parts, "D4 measured order"));
}

BOOST_AUTO_TEST_CASE(d7_invariance_that_is_wrongly_claimed) {
  const Theta midpoint(std::make_shared<SpecialOrthogonal3>());
  auto parts = parts_of(midpoint);
  BOOST_TEST(parts.left_invariant);
  BOOST_TEST(!fails(midpoint, parts, "D7"));
  // Of second order in v, by as much as the point tells.
  parts.forward = [&](const ExprVector& x, const ExprVector& v) {
    return midpoint.forward(x, ExprVector((1.0 + 1e-3 * x[0] * v.squaredNorm()) * v));
  };
  BOOST_TEST(fails(midpoint, parts, "D7"));
  parts = parts_of(chordal());
  parts.left_invariant = true;  // on a manifold that is no group
  BOOST_TEST(fails(chordal(), parts, "D7"));
}

BOOST_AUTO_TEST_CASE(d3_a_domain_that_is_too_large) {
  const SphericalMidpoint midpoint(std::make_shared<Sphere>(2));
  auto parts = parts_of(midpoint);
  BOOST_TEST(!fails(midpoint, parts, "D3"));
  parts.domain_radius = std::numeric_limits<double>::infinity();
  BOOST_TEST(fails(midpoint, parts, "D3"));
}

// The lift without the torsion of the frame: right on vector spaces, wrong on a group.
BOOST_AUTO_TEST_CASE(d4_a_lift_that_forgets_the_torsion) {
  const auto& M = dynamic_cast<const CotangentBundle&>(*lift().manifold());
  auto parts = parts_of(lift());
  parts.forward = [&](const ExprVector& x, const ExprVector& v) {
    ExprVector changed = v;
    changed.tail(3) -= M.torsion(M.position(x), M.momentum(x), M.horizontal(v));
    return lift().forward(x, changed);
  };
  BOOST_TEST(fails(lift(), parts, "D4 symplectic"));
}

BOOST_AUTO_TEST_SUITE_END()
