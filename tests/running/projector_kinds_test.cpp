#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <random>

#include "../integrators/varying_metric.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/running/runner.hpp"
#include "problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * round-off of a point off its manifold chooses units of conormals
//    (integrators/step/transported_conormals.cpp)
//  * on curved spaces nearest points in a metric are looked for off the space too
//    (integrators/step/projector.cpp)
BOOST_AUTO_TEST_SUITE(projector_kinds_test)

namespace {

// Section 8 with two constraints and a metric that is not constant, gⁱʲ = diag(1, 1/(1 + q₀²), 0.7,
// 1.2), V = ‖q‖²/2 + 0.3 q₀q₁, μ¹ = dq₂ - q₁dq₀, μ² = dq₃ - q₀dq₁, as equations with momenta in a
// unit of one's own: p is `unit` times what is written p.
Json nonholonomic(double unit) {
  return {{"system",
           {{"type", "implicit"},
            {"parameters", {{"s", unit}}},
            {"coordinates", {"q[4]", "p[4]"}},
            {"unknowns", {"l[2]"}},
            {"definitions", {{"v", {"s*p[0]", "s*p[1]/(1 + q[0]^2)", "0.7*s*p[2]", "1.2*s*p[3]"}}}},
            {"equations",
             {"q[0]' - v[0]", "q[1]' - v[1]", "q[2]' - v[2]", "q[3]' - v[3]",
              "s*p[0]' + q[0] + 0.3*q[1] - q[0]*v[1]^2 + q[1]*l[0]",
              "s*p[1]' + q[1] + 0.3*q[0] + q[0]*l[1]", "s*p[2]' + q[2] - l[0]",
              "s*p[3]' + q[3] - l[1]", "v[2] - q[1]*v[0]", "v[3] - q[0]*v[1]"}},
            {"energy",
             "(s^2*p[0]^2 + s^2*p[1]^2/(1 + q[0]^2) + 0.7*s^2*p[2]^2 + 1.2*s^2*p[3]^2 + "
             "dot(q, q))/2 + 0.3*q[0]*q[1]"}}},
          {"initial", {{"q", {0.5, 0.8, -0.3, 0.6}}, {"p[0]", 0.9 / unit}, {"p[1]", -0.7 / unit}}}};
}

using namespace varying_metric;

Vector4d projected(const Vector4d& q, const Vector4d& p) {
  const Eigen::Matrix2d C = mu(q).transpose() * inverse_metric(q) * mu(q);
  return p - mu(q) * C.inverse() * constraints(q, p);
}

// How far a step is from (39) to (43): the middle of q̇ = gⁱʲp and of the constraint, and the ends
// of p by 𝒫, with the λ that fits best.
double defect_of_39_to_43(const VectorXd& x0, const VectorXd& x1, double h) {
  const Vector4d q0 = x0.head(4), p0 = x0.tail(4), q1 = x1.head(4), p1 = x1.tail(4);
  const Vector4d q = 0.5 * (q0 + q1), p = inverse_metric(q).inverse() * (q1 - q0) / h;
  const auto ends = [&](const Vector4d& force) {
    VectorXd result(8);
    result << projected(q0, p - h / 2 * force) - p0, projected(q1, p + h / 2 * force) - p1;
    return result;
  };
  const VectorXd known = ends(-dH_dq(q, p));
  MatrixXd A(8, 2);
  for (Index a = 0; a < 2; ++a) A.col(a) = ends(mu(q).col(a) - dH_dq(q, p)) - known;
  const Vector2d lambda = QrDecomposition::in_order(A).solve(-known);
  return (A * lambda + known).norm() + constraints(q, p).norm();
}

Json method(const Json& projector) {
  return {{"type", "constrain-first"}, {"projector", projector}};
}
Json pair(const char* position, const char* momentum) {
  return Json::array({Json::array({position, momentum})});
}
const Json kPairs = pair("q", "p");

std::string problem_of(const Json& experiment, const Json& projector) {
  try {
    test::problem(experiment).prepare(method(projector), 0.1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// The metric of the kinetic energy by default; given, it is the same; another one is not.
BOOST_AUTO_TEST_CASE(equations_39_to_43_from_json) {
  const test::Problem nonholonomic_motion = test::problem(nonholonomic(1.0));
  const double h = 0.1;
  const VectorXd x0 = nonholonomic_motion.ladder.point.x;
  const auto defect = [&](const Json& projector) {
    return defect_of_39_to_43(x0, nonholonomic_motion.end(method(projector), h, 1), h);
  };
  BOOST_TEST(defect({{"type", "momentum"}, {"pairs", kPairs}}) < 1e-13);
  const Json given = {
      {"type", "momentum"},
      {"pairs", kPairs},
      {"metric", {{1, 0, 0, 0}, {0, "1 + q[0]^2", 0, 0}, {0, 0, "1/0.7", 0}, {0, 0, 0, "1/1.2"}}}};
  BOOST_TEST(defect(given) < 1e-13);
  BOOST_TEST(defect({{"type", "momentum"}, {"pairs", kPairs}, {"metric", "euclidean"}}) > 1e-6);
  BOOST_TEST(defect("orthogonal") > 1e-6);
}

// The same of a kind with a metric, and of its Lagrangian: the default is ∂²L/∂w².
BOOST_AUTO_TEST_CASE(equations_39_to_43_of_a_lagrangian) {
  const Json constraints = {"q[2]' - q[1]*q[0]'", "q[3]' - q[0]*q[1]'"};
  const Json initial = {{"q", {0.5, 0.8, -0.3, 0.6}}, {"p_q[0]", 0.9}, {"p_q[1]", -0.7}};
  const Json mechanical = {{"system",
                            {{"type", "mechanical"},
                             {"coordinates", {"q[4]"}},
                             {"metric", {"1", "1 + q[0]^2", "1/0.7", "1/1.2"}},
                             {"potential", "dot(q, q)/2 + 0.3*q[0]*q[1]"},
                             {"nonholonomic", constraints}}},
                           {"initial", initial}};
  const Json lagrangian = {{"system",
                            {{"type", "lagrangian"},
                             {"coordinates", {"q[4]"}},
                             {"lagrangian",
                              "(q[0]'^2 + (1 + q[0]^2)*q[1]'^2 + q[2]'^2/0.7 + q[3]'^2/1.2 - "
                              "dot(q, q))/2 - 0.3*q[0]*q[1]"},
                             {"nonholonomic", constraints}}},
                           {"initial", initial}};
  for (const Json& system : {mechanical, lagrangian}) {
    const test::Problem motion = test::problem(system);
    const double h = 0.1;
    const VectorXd x0 = motion.ladder.point.x;
    const auto defect = [&](const Json& projector) {
      return defect_of_39_to_43(x0, motion.end(method(projector), h, 1), h);
    };
    BOOST_TEST(defect("momentum") < 1e-13);
    BOOST_TEST(defect({{"type", "momentum"}, {"metric", "euclidean"}}) > 1e-6);
  }
}

// Vector fields of one's own: (0, μ¹) and (0, μ²) are those of the momentum projector. p₂ and p₃ alone may
// move as well; that is another method of order 2, which keeps the constraints too.
BOOST_AUTO_TEST_CASE(directions_of_ones_own) {
  const test::Problem motion = test::problem(nonholonomic(1.0));
  const VectorXd x0 = motion.ladder.point.x;
  const Json along = {
      {"type", "directions"},
      {"fields", {{0, 0, 0, 0, "-q[1]", 0, 1, 0}, {0, 0, 0, 0, 0, "-2*q[0]", 0, 2}}}};
  const double h = 0.1;
  BOOST_TEST(defect_of_39_to_43(x0, motion.end(method(along), h, 1), h) < 1e-13);

  const Json last = {{"type", "directions"},
                     {"fields", {{0, 0, 0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, 0, 0, 1}}}};
  const VectorXd x1 = motion.end(method(last), h, 1);
  BOOST_TEST(defect_of_39_to_43(x0, x1, h) > 1e-6);
  BOOST_TEST(constraints(x1.head(4), x1.tail(4)).norm() < 1e-14);
  const VectorXd exact = motion.end({{"type", "dopri5"}}, 1.0, 400);
  for (const Json& projector : {along, last}) {
    const double order = motion.order(method(projector), 1.0, exact);
    BOOST_TEST(std::abs(order - 2.0) < 0.15, projector << " shows " << order);
  }
}

// On SO(3), where M_f is ω₃ = 0: p_R moves along (c, 0, 1), one row for one constraint.
BOOST_AUTO_TEST_CASE(directions_on_a_group) {
  const Json system = {
      {"type", "mechanical"},       {"manifold", "so3"},
      {"coordinates", {"R[3][3]"}}, {"metric", {{1.5, 0, 0.3}, {0, 2.5, 0.4}, {0.3, 0.4, 1.2}}},
      {"potential", "0.7*R[2][2]"}, {"nonholonomic", "v_R[2]"}};
  const Json initial = {{"R", {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}, {"v_R", {0.8, -0.5, 0}}};
  const test::Problem body = test::problem({{"system", system}, {"initial", initial}});
  const Json along = {{"type", "directions"}, {"fields", {0, 0, 0, "0.2*R[2][0]", 0, 1}}};
  const VectorXd exact = body.end({{"type", "dopri5"}}, 1.0, 400);
  const double order = body.order(method(along), 1.0, exact);
  BOOST_TEST(std::abs(order - 2.0) < 0.15, "shows " << order);
  const VectorXd difference =
      body.end(method(along), 1.0, 8) - body.end(method("momentum"), 1.0, 8);
  BOOST_TEST(difference.norm() > 1e-6);
}

// A matrix in a long run is a rotation up to 1e-14, so that entries of Jacobians that should be zero are
// as large. They are no numbers: a stepper that begins there moves p along the conormal, and leaves R.
BOOST_AUTO_TEST_CASE(a_rotation_up_to_round_off) {
  const Json system = {{"type", "mechanical"},
                       {"manifold", "so3"},
                       {"coordinates", {"R[3][3]"}},
                       {"metric", {{1.4, 0, 0.3}, {0, 2.1, 0.4}, {0.3, 0.4, 1.7}}},
                       {"potential", "0.7*R[2][2] + 0.5*R[0][1] + 0.3*R[1][0]"},
                       {"nonholonomic", "v_R[2] - 0.25*v_R[0]"}};
  const Json initial = {{"R", {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}, {"v_R", {0.6, -0.5, 0.15}}};
  const test::Problem body = test::problem({{"system", system}, {"initial", initial}});
  const PreparedMethod prepared =
      body.prepare({{"type", "constrain-first"}, {"discretization", "cayley"}}, 0.1);
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> off(-6e-15, 6e-15);
  for (int i = 0; i < 20; ++i) {
    const State on = prepared.integrator->advance(prepared.initial, 0.1, 2 * i);
    State near = on;
    for (double& entry : near.x.head(9)) entry += off(generator);
    const double difference =
        (prepared.integrator->advance(near, 0.1, 3).x - prepared.integrator->advance(on, 0.1, 3).x)
            .norm();
    BOOST_TEST(difference < 1e-12, "after " << 2 * i << " steps it is " << difference);
  }
}

// What is measured by the kinetic energy does not depend on the unit of the momenta; numbers do.
BOOST_AUTO_TEST_CASE(units_of_momenta_do_not_matter) {
  const auto end = [](double unit, const Json& projector) {
    VectorXd x = test::problem(nonholonomic(unit)).end(method(projector), 0.5, 5);
    x.tail(4) *= unit;
    return x;
  };
  const Json projector = {{"type", "momentum"}, {"pairs", kPairs}};
  const VectorXd expected = end(1.0, projector);
  for (const double unit : {1e-3, 1e3})
    BOOST_TEST((end(unit, projector) - expected).norm() < 1e-6,
               projector << " moves by " << (end(unit, projector) - expected).norm()
                         << " where the unit is " << unit);
  const Json numbers = "orthogonal";
  BOOST_TEST((end(1e3, numbers) - end(1.0, numbers)).norm() > 1e-5);
}

// Starts with zeros in them: of one coordinate each, and of all velocities. The projector finds the motion that the
// nearest point in the numbers leads to, to the order of the method.
BOOST_AUTO_TEST_CASE(starts_with_zeros) {
  int starts = 0;
  for (const char* name : {"suslov_so3", "nonholonomic_particle", "snakeboard", "knife_edge",
                           "rolling_disk", "chaplygin_sleigh", "unicycle", "pendulum_cartesian"}) {
    const Json file = test::experiment_file(name);
    std::vector<Json> initials = {file.at("initial")};
    Json at_rest = file.at("initial");
    for (const auto& [key, value] : file.at("initial").items()) {
      if (!value.is_number() && !value.is_string()) continue;
      Json without = file.at("initial");
      without[key] = 0;
      initials.push_back(without);
      if (key.back() == '\'') at_rest[key] = 0;
    }
    initials.push_back(at_rest);
    for (const Json& initial : initials) {
      Json experiment = {{"system", file.at("system")}, {"initial", initial}};
      test::Problem motion;
      try {
        motion = test::problem(experiment);
      } catch (const std::exception&) {
        continue;  // no point of M_f has these zeros
      }
      if (motion.ladder.verdict != Verdict::regular) continue;
      ++starts;
      const auto difference = [&](long steps) {
        const VectorXd usual = motion.end(method("orthogonal"), 0.4, steps);
        const Json numbers = {{"type", "orthogonal"}, {"metric", "euclidean"}};
        return (usual - motion.end(method(numbers), 0.4, steps)).norm() / (1.0 + usual.norm());
      };
      const double coarse = difference(40), fine = difference(80);
      BOOST_TEST((fine < 0.35 * coarse || fine < 1e-9),
                 name << " from " << initial << ": " << coarse << ", then " << fine);
      BOOST_TEST(coarse < 1e-2, name << " from " << initial << ": " << coarse);
    }
  }
  BOOST_TEST(starts > 30);
}

// Units of momenta at such starts: along an axis, and from rest.
BOOST_AUTO_TEST_CASE(units_of_momenta_do_not_matter_at_zeros) {
  for (const Json& start : {Json{{"q", {0.5, 0, 0, 0}}, {"p", {0.9, 0, 0, 0}}},
                            Json{{"q", {0, 0, 0, 0}}, {"p", {0.9, 0.3, 0, 0}}},
                            Json{{"q", {0.5, 0.8, 0, 0}}, {"p", {0, 0, 0, 0}}}}) {
    const auto end = [&](double unit) {
      Json experiment = nonholonomic(unit);
      experiment["initial"] = start;
      for (Json& p : experiment["initial"]["p"]) p = p.get<double>() / unit;
      VectorXd x =
          test::problem(experiment).end(method({{"type", "momentum"}, {"pairs", kPairs}}), 0.5, 20);
      x.tail(4) *= unit;
      return x;
    };
    const VectorXd expected = end(1.0);
    for (const double unit : {1e-6, 1e-3, 1e3, 1e6})
      BOOST_TEST((end(unit) - expected).norm() < 1e-4, start << " moves by "
                                                             << (end(unit) - expected).norm()
                                                             << " where the unit is " << unit);
  }
}

// "kinetic" where there is no kinetic energy is no wish that could be met by something else; where nothing is said, the
// numbers are measured, which the run says.
BOOST_AUTO_TEST_CASE(a_metric_that_is_none) {
  const Json relativistic = {
      {"system",
       {{"type", "hamiltonian"},
        {"coordinates", {"x", "y", "z"}},
        {"hamiltonian", "sqrt(1+p_x^2+p_y^2+2*p_z^2)+x^2/2"},
        {"nonholonomic", "z'-y*x'"}}},
      {"initial", {{"x", 0.6}, {"y", 0.8}, {"z", 0}, {"p_x", 0.4}, {"p_y", -0.3}}}};
  for (const char* type : {"momentum", "orthogonal"}) {
    const std::string text = problem_of(relativistic, {{"type", type}, {"metric", "kinetic"}});
    BOOST_TEST(
        text.find(
            "/method/projector/metric: is \"kinetic\", but the system has no kinetic energy") == 0u,
        text);
    const test::Problem motion = test::problem(relativistic);
    BOOST_TEST(motion.prepare(method(type), 0.1).metric == "euclidean");
  }
  Json classical = relativistic;
  classical["system"]["hamiltonian"] = "(p_x^2+p_y^2+2*p_z^2)/2+x^2/2";
  const test::Problem motion = test::problem(classical);
  BOOST_TEST(motion.prepare(method("orthogonal"), 0.1).metric == "kinetic");
  BOOST_TEST(motion.prepare(method("momentum"), 0.1).metric == "kinetic");
  BOOST_TEST(
      motion.prepare(method({{"type", "orthogonal"}, {"weights", {{"x", 2}}}}), 0.1).metric ==
      "given");
  BOOST_TEST(motion.prepare("rk4", 0.1).metric.empty());
}

// One default, in a file and in a program.
BOOST_AUTO_TEST_CASE(the_default_is_that_of_programs) {
  for (const char* name : {"knife_edge", "pendulum_holonomic", "pendulum_cartesian"}) {
    const Json file = test::experiment_file(name);
    const test::Problem motion =
        test::problem({{"system", file.at("system")}, {"initial", file.at("initial")}});
    const PreparedMethod written = motion.prepare("constrain-first", 0.02);
    const ConstrainFirst program(motion.experiment.model.system, motion.ladder, written.map);
    BOOST_TEST(program.advance(motion.ladder.point, 0.02, 10).x ==
                   written.integrator->advance(motion.ladder.point, 0.02, 10).x,
               name);
  }
}

BOOST_AUTO_TEST_CASE(weights_and_metrics_say_the_same) {
  const test::Problem motion = test::problem(nonholonomic(1.0));
  const auto end = [&](const Json& projector) { return motion.end(method(projector), 0.5, 5); };
  Json metric = Json::array();
  for (int i = 0; i < 8; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 8; ++j) row.push_back(i != j ? 0 : i < 4 ? 25 : 1);
    metric.push_back(row);
  }
  const VectorXd weighted = end({{"type", "orthogonal"}, {"weights", {{"q", 25}}}});
  BOOST_TEST((weighted - end({{"type", "orthogonal"}, {"metric", metric}})).norm() < 1e-12);
  BOOST_TEST((weighted - end({{"type", "orthogonal"}, {"metric", "euclidean"}})).norm() > 1e-7);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said_where_it_is) {
  const Json system = nonholonomic(1.0);
  const auto begins = [&](const Json& projector, const std::string& start) {
    const std::string text = problem_of(system, projector);
    BOOST_TEST(text.find(start) == 0u, text);
  };
  begins("momentum", "the momentum projector moves momenta, but the system is on Euclidean(8)");
  begins({{"type", "momentum"}, {"pairs", pair("q", "P")}}, "/method/projector/pairs/0: ");
  begins({{"type", "momentum"}, {"pairs", pair("q", "p[1]")}},
         "/method/projector/pairs/0: pairs 4 numbers with 1");
  begins({{"type", "momentum"}, {"pairs", pair("q", "p'")}},
         "/method/projector/pairs/0: \"p'\" is a velocity");
  begins({{"type", "momentum"}, {"pairs", Json::array()}}, "/method/projector/pairs: ");
  begins({{"type", "momentum"}, {"pairs", kPairs}, {"metric", {{1, 0}, {0, 1}}}},
         "/method/projector/metric: is no 4 × 4 matrix");
  begins({{"type", "orthogonal"}, {"weights", {{"z", 2}}}}, "/method/projector/weights/z: ");
  begins({{"type", "orthogonal"}, {"weights", {{"q", -2}}}}, "/method/projector/weights/q: ");
  begins({{"type", "orthogonal"}, {"weights", {{"q", 2}}}, {"metric", "euclidean"}},
         "/method/projector/weights: are given beside a metric");
  begins({{"type", "orthogonal"}, {"metric", "kinetic"}}, "/method/projector/metric: ");
  const Json row = {0, 0, 0, 0, "-q[1]", 0, 1, 0};
  begins({{"type", "directions"}, {"fields", row}},
         "/method/projector/fields: is 1 × 8; expected 2 × 8, a tangent vector of Euclidean(8) a "
         "row for each constraint of M_f");
  begins({{"type", "directions"}, {"fields", {row, {0, 0, 0, 0, 0, "qq", 0, 1}}}},
         "/method/projector/fields/1/5: column 1: unknown name \"qq\"");
  begins({{"type", "directions"}, {"fields", {row, {0, 0, 0, 0, "t", 0, 0, 1}}}},
         "/method/projector/fields/1/4: ");
  begins({{"type", "directions"}, {"fields", "q[0]"}}, "/method/projector/fields: ");
  begins({{"type", "directions"}}, "/method/projector/fields: is missing");
  Json indefinite = Json::array();
  for (int i = 0; i < 4; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 4; ++j) row.push_back(i != j ? 0 : i - 1);
    indefinite.push_back(row);
  }
  begins({{"type", "momentum"}, {"pairs", kPairs}, {"metric", indefinite}},
         "/method/projector/metric: is not symmetric and positive definite");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
