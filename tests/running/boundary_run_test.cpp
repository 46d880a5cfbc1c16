#include "courant/running/boundary_run.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "courant/running/run_in_memory.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a run does not begin at the solution, or takes another time
//  * conditions of transversality are added where costates are given, or are missing
//  * what is not solved is run, or completes
//  * the solution 0 has no size, and is never near enough
//  * a run whose round-off grows leaves the motion that was found
//  * a cost at the end is left out, or has the other sign
//  * a guess of the motion is not looked at
//  * a control is beyond its barrier
//  * a parameter of a continuation does not come to its own value
BOOST_AUTO_TEST_SUITE(boundary_run)

namespace {

Json bratu(double c) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"parameters", {{"c", c}}},
            {"coordinates", {"q"}},
            {"hamiltonian", "p_q^2/2 + c*exp(q)"}}},
          {"initial", {{"q", 0}}},
          {"boundary", {{"initial", {{"q", 0}}}, {"final", {{"q", 0}}}}},
          {"method", {{"type", "discretize-first"}, {"order", 4}}},
          {"time", {{"step", 0.05}, {"end", 1}}}};
}

// x' = v, v' = u, ∫ (u²/2 + k) dt → min.
Json cart(const Json& boundary, double k = 0.0) {
  return {{"system",
           {{"type", "optimal-control"},
            {"parameters", {{"k", k}}},
            {"states", {"x", "v"}},
            {"controls", {"u"}},
            {"dynamics", {"v", "u"}},
            {"cost", "u^2/2 + k"}}},
          {"initial", {{"x", 0}, {"v", 0}}},
          {"boundary", boundary},
          {"method", {{"type", "discretize-first"}, {"order", 4}}},
          {"time", {{"step", 0.1}, {"end", 2}}}};
}

// y'' = 10⁴ y, y = e^(-100 t): round-off at the beginning has grown by e^100 at the end.
Json layer() {
  return {{"system",
           {{"type", "implicit"},
            {"coordinates", {"y", "v"}},
            {"equations", {"y' - v", "v' - 1e4*y"}}}},
          {"initial", {{"y", 1}, {"v", -10}}},
          {"boundary", {{"initial", {{"y", 1}}}, {"final", {{"y", 0}}}, {"segments", 40}}},
          {"method", {{"type", "discretize-first"}}},
          {"time", {{"step", 0.001}, {"end", 1}}}};
}

RunInMemory ran(const Json& document) { return run_in_memory(read_experiment_document(document)); }

std::string problem_of(const Json& document) {
  try {
    ran(document);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_begins_where_its_conditions_ask_for) {
  const RunInMemory run = ran(bratu(1.0));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  const auto q = run.rows.column("q"), p = run.rows.column("p_q");
  BOOST_TEST(q.size() == 21u);
  BOOST_TEST(std::abs(q.back()) < 1e-12);
  BOOST_TEST(std::abs(p.front() - 0.5493527287752711) < 1e-6);
  const Json& told = run.outcome.summary.boundary;
  BOOST_TEST(told["verdict"] == "isolated");
  BOOST_TEST(std::abs(told["conditions"]["q at the end"].get<double>()) < 1e-12);
  BOOST_TEST(told.at("conjugate_times").empty());
  BOOST_TEST(told["rank"] == told["unknowns"]);
  BOOST_TEST(told["singular_values"].size() == told["unknowns"].get<std::size_t>());
  // What is written is read back.
  BOOST_TEST(read_run_summary(to_json(run.outcome.summary)).boundary == told);
}

// Bratu's problem has no solution above 3.5138, and a continuation comes near to that.
BOOST_AUTO_TEST_CASE(what_is_not_solved_fails_and_says_how_far_it_came) {
  const RunInMemory run = ran(bratu(4.0));
  BOOST_TEST((run.outcome.status == RunStatus::failed));
  BOOST_TEST(run.outcome.message.starts_with("/boundary: no motion was found"),
             run.outcome.message);
  BOOST_TEST(run.outcome.summary.boundary["verdict"] == "unsolved");
  Json document = bratu(4.0);
  document["boundary"]["continuation"] = {{"parameter", "c"}, {"from", 0}};
  const RunInMemory other = ran(document);
  BOOST_TEST((other.outcome.status == RunStatus::failed));
  BOOST_TEST(other.outcome.message.starts_with("/boundary: with c: the continuation comes to 3.51"),
             other.outcome.message);
  document = bratu(3.5);
  document["boundary"]["continuation"] = {{"parameter", "c"}, {"from", 0}};
  BOOST_TEST((ran(document).outcome.status == RunStatus::completed));
}

// Parameters of systems of the catalogue stand beside their type, or are not said.
BOOST_AUTO_TEST_CASE(a_continuation_goes_along_a_parameter_of_the_catalogue) {
  Json document{{"system", {{"type", "pendulum"}, {"l", 2}}},
                {"initial", {{"q", 0}, {"p_q", 4}}},
                {"boundary",
                 {{"initial", {{"q", 0}}},
                  {"final", {{"q", 1}}},
                  {"continuation", {{"parameter", "l"}, {"from", 1}}}}},
                {"method", "discretize-first"},
                {"time", {{"step", 0.01}, {"end", 0.4}}}};
  const RunInMemory run = ran(document);
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  document["boundary"].erase("continuation");
  const double p = ran(document).rows.column("p_q").front();
  BOOST_TEST(std::abs(run.rows.column("p_q").front() - p) < 1e-9);
  document["boundary"]["continuation"] = {{"parameter", "m"}, {"from", 2}};
  BOOST_TEST((ran(document).outcome.status == RunStatus::completed));
}

// From rest at 0 to the place 1 in the time 2, with any speed: v is free, so p_v = 0 at the end, and x = (3 T t² - t³)/(2 T³).
BOOST_AUTO_TEST_CASE(a_free_end_has_the_conditions_of_transversality) {
  const Json start{{"x", 0}, {"v", 0}};
  RunInMemory run = ran(cart({{"initial", start}, {"final", {{"x", 1}}}}));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(std::abs(run.rows.column("p_v").back()) < 1e-12);
  BOOST_TEST(std::abs(run.rows.column("x")[10] - (3.0 * 2.0 - 1.0) / 16.0) < 1e-10);
  // On the line x + v = 1: the costate is at right angles to it, p_x = p_v.
  run = ran(cart({{"initial", start}, {"final", {{"x + v", 1}}}}));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(std::abs(run.rows.column("p_v").back() - run.rows.column("p_x").back()) < 1e-12);
  BOOST_TEST(std::abs(run.rows.column("p_v").back()) > 0.1);
  // Where a costate is given nothing is added: one condition too few, a family.
  run = ran(cart({{"initial", start}, {"final", {{"p_x + x", 0}}}}));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(run.outcome.summary.boundary["family_dimension"] == 1);
  // With a price k of time, from rest to rest over 1: u = 6/T² (1 - 2t/T), cost 6/T³ + k T, T⁴ = 18/k.
  run = ran(cart({{"initial", start}, {"final", {{"x", 1}, {"v", 0}}}, {"free", {"T"}}}, 2.0));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(std::abs(run.rows.column("t").back() - std::pow(9.0, 0.25)) < 1e-9);
  BOOST_TEST(run.rows.rows() == 21u);
  // At a target x = 3 - t that comes nearer, v given: E = ν ∂g/∂t, ∂g/∂t = 1, p_x = -ν.
  run = ran(cart({{"initial", start}, {"final", {{"x + t", 3}, {"v", 0}}}, {"free", {"T"}}}, 2.0));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(std::abs(run.rows.column("H").back() + run.rows.column("p_x").back()) < 1e-9);
  BOOST_TEST(std::abs(run.rows.column("x").back() + run.rows.column("t").back() - 3.0) < 1e-9);
  // The same target where it is written as values of the states: ν is that of p all the same.
  const double met = run.rows.column("t").back();
  run =
      ran(cart({{"initial", start}, {"final", {{"x", "3 - t"}, {"v", 0}}}, {"free", {"T"}}}, 2.0));
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(run.outcome.summary.boundary["verdict"] == "isolated");
  BOOST_TEST(std::abs(run.rows.column("t").back() - met) < 1e-9);
}

// x' = u, ∫ (x² + u²)/2 dt + s x(T)²/2 → min: u = -P x with P' = P² - 1, P(T) = s. With a cost r T of the time too, which is
// free, the time is that at which E = p u - (x² + u²)/2 is r: for p = -s x at the end, (s² - 1) x(T)²/2.
BOOST_AUTO_TEST_CASE(a_cost_of_the_end_is_part_of_transversality) {
  Json document = {{"system",
                    {{"type", "optimal-control"},
                     {"parameters", {{"s", 0.5}, {"r", 0}}},
                     {"states", {"x"}},
                     {"controls", {"u"}},
                     {"dynamics", {"u"}},
                     {"cost", "(x^2 + u^2)/2"},
                     {"final_cost", "s*x^2/2 + r*t"}}},
                   {"initial", {{"x", 1}}},
                   {"boundary", {{"initial", {{"x", 1}}}}},
                   {"method", {{"type", "discretize-first"}, {"order", 4}}},
                   {"time", {{"step", 0.02}, {"end", 1}}}};
  const auto x_at_the_end = [](double s, double T) {
    return std::cosh(std::atanh(s)) / std::cosh(T + std::atanh(s));
  };
  const RunInMemory fixed = ran(document);
  BOOST_TEST_REQUIRE((fixed.outcome.status == RunStatus::completed), fixed.outcome.message);
  BOOST_TEST(std::abs(fixed.rows.column("x").back() - x_at_the_end(0.5, 1.0)) < 1e-8);

  document["boundary"]["final"] = {{"p_x", 0}};
  BOOST_TEST(
      problem_of(document).starts_with("/boundary: leaves the final_cost of the system out"));
  document["boundary"].erase("final");
  document["system"]["final_cost"] = "u";
  BOOST_TEST(problem_of(document).starts_with("/system/final_cost: column 1: unknown name \"u\""));
  document["system"]["final_cost"] = "s*x^2/2 + r*t";

  document["boundary"]["free"] = {"T"};
  const double x = x_at_the_end(0.5, 1.25);
  document["system"]["parameters"]["r"] = (0.25 - 1.0) * x * x / 2.0;
  const RunInMemory timed = ran(document);
  BOOST_TEST_REQUIRE((timed.outcome.status == RunStatus::completed), timed.outcome.message);
  BOOST_TEST(std::abs(timed.rows.column("x").back() - x) < 1e-7);
}

// Dubins' car, |u| ≤ 1 by a barrier. From no costate it does not turn; the run from there leads nowhere. Beyond the barrier
// the equations have solutions too.
BOOST_AUTO_TEST_CASE(a_guess_of_the_motion_leads_to_it_within_the_barrier_of_a_control) {
  Json document = {
      {"system",
       {{"type", "optimal-control"},
        {"parameters", {{"mu", 0.01}}},
        {"states", {"x", "y", "theta"}},
        {"controls", {"u"}},
        {"dynamics", {"cos(theta)", "sin(theta)", "u"}},
        {"cost", "1 - mu*log(1 - u^2)"}}},
      {"initial", {{"x", 0}, {"y", 0}, {"theta", 0}, {"p_x", 0.8}, {"p_y", 0.5}, {"p_theta", 0.5}}},
      {"boundary",
       {{"initial", {{"x", 0}, {"y", 0}, {"theta", 0}}},
        {"final", {{"x", 3}, {"y", 2}, {"theta", 0}}},
        {"free", {"T"}},
        {"guess",
         {{"x", "3*t/4"}, {"y", "t/2"}, {"theta", "0.6*sin(pi*t/4)"}, {"p_theta", "0.5 - t/4"}}}}},
      {"method", {{"type", "discretize-first"}}},
      {"time", {{"step", 0.04}, {"end", 4}}},
      {"observe", {{"turn", "u"}}}};
  for (const double mu : {0.01, 0.003}) {
    document["system"]["parameters"]["mu"] = mu;
    document["boundary"]["continuation"] = {{"parameter", "mu"}, {"from", 0.1}};
    const RunInMemory run = ran(document);
    BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
    for (const double u : run.rows.column("turn")) BOOST_TEST(std::abs(u) < 1.0);
    for (const double H : run.rows.column("H")) BOOST_TEST(std::isfinite(H));
    // Two arcs and what touches both.
    const double shortest = 2.0 * std::asin(2.0 / 3.0) + std::sqrt(5.0);
    const double duration = run.rows.column("t").back();
    BOOST_TEST(duration > shortest);
    BOOST_TEST(duration < shortest + 3.0 * mu);
  }
}

BOOST_AUTO_TEST_CASE(conditions_may_name_observables_velocities_and_arrays) {
  Json document{{"system",
                 {{"type", "mechanical"},
                  {"coordinates", {"r[2]"}},
                  {"holonomic", {"dot(r, r) - 1"}},
                  {"potential", "9.81*r[1]"}}},
                {"initial", {{"r", {1, 0}}, {"r[1]'", -0.4}}},
                {"observe", {{"angle", "atan2(r[1], r[0])"}}},
                {"boundary", {{"initial", {{"r", {1, 0}}}}, {"final", {{"angle", -1.2}}}}},
                {"method", {{"type", "constrain-first"}}},
                {"time", {{"step", 0.01}, {"end", 0.4}}}};
  RunInMemory run = ran(document);
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(std::abs(run.rows.column("angle").back() + 1.2) < 1e-10);
  BOOST_TEST(*run.outcome.summary.max_violation < 1e-12);
  document["boundary"]["final"] = {{"r[0]'^2 + r[1]'^2", 9}};
  document["boundary"]["initial"] = {{"r[0]", 1}, {"r[1]", 0}};
  run = ran(document);
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  const double px = run.rows.column("p_r[0]").back(), py = run.rows.column("p_r[1]").back();
  BOOST_TEST(std::abs(px * px + py * py - 9.0) < 1e-9);
}

// Of y'' = 10⁴ y between 0 and 0, and from any guess.
BOOST_AUTO_TEST_CASE(the_motion_that_is_zero_is_found) {
  Json document = layer();
  document["boundary"] = {{"initial", {{"y", 0}}}, {"final", {{"y", 0}}}};
  document["time"]["end"] = 0.1;
  const RunInMemory run = ran(document);
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(run.outcome.summary.boundary["verdict"] == "isolated");
  BOOST_TEST(std::abs(run.rows.column("v").front()) < 1e-99);
}

BOOST_AUTO_TEST_CASE(a_run_on_which_round_off_grows_goes_on_from_node_to_node) {
  const RunInMemory run = ran(layer());
  BOOST_TEST_REQUIRE((run.outcome.status == RunStatus::completed), run.outcome.message);
  BOOST_TEST(run.outcome.summary.boundary["verdict"] == "isolated");
  BOOST_TEST(run.outcome.summary.boundary.value("needs_nodes", false));
  BOOST_TEST(!run.outcome.summary.boundary.contains("conjugate_times"));
  const auto y = run.rows.column("y");
  const double factor = 0.95 / 1.05;  // of the midpoint rule
  for (const std::size_t k : {10u, 100u, 500u, 1000u})
    BOOST_TEST(std::abs(y[k] - std::pow(factor, k)) < 1e-12, "step " << k);
}

BOOST_AUTO_TEST_CASE(a_run_that_was_stopped_goes_on_with_the_same_bytes) {
  Json document = bratu(1.0);
  document["time"]["step"] = 0.02;
  document["output"]["epoch"] = 7;
  check_resumption(document, {5, 30}, "boundary values");
  document = layer();
  document["output"]["epoch"] = 10;
  check_resumption(document, {60, 505}, "from node to node");
}

BOOST_AUTO_TEST_CASE(what_is_no_boundary_problem_is_refused_at_its_place) {
  const auto with = [](const std::string& pointer, const Json& value) {
    Json document = bratu(1.0);
    document[Json::json_pointer(pointer)] = value;
    return problem_of(document);
  };
  const auto begins = [](const std::string& text, const std::string& with_what) {
    BOOST_TEST(text.starts_with(with_what), text);
  };
  begins(with("/boundary/final", {{"qq", 0}}), "/boundary/final/qq: key, column 1: unknown name");
  begins(with("/boundary/final", {{"c", 0}}), "/boundary/final/c: key, \"c\" does not depend on");
  begins(with("/boundary/final", {{"q", {0, 1}}}), "/boundary/final/q: has 2 values; expected 1");
  begins(with("/boundary/free", {"h"}), "/boundary/free/0: is \"h\"; expected \"T\"");
  begins(with("/boundary/periodic", 1), "/boundary/periodic: is 1; expected true or false");
  begins(with("/boundary/segments", 0), "/boundary/segments: is 0; expected");
  begins(with("/boundary", Json::object()), "/boundary: has no conditions");
  begins(with("/boundary/guess", {{"c", "t"}}),
         "/boundary/guess/c: key, \"c\" is no coordinate; expected one");
  begins(with("/boundary/guess", {{"q", "q + t"}}),
         "/boundary/guess/q: column 1: unknown name \"q\"");
  begins(with("/boundary/continuation", {{"parameter", "d"}, {"from", 0}}),
         "/boundary/continuation/parameter: is \"d\"; expected a parameter");
  begins(with("/boundary/final", {{"q", 0}, {"p_q", 0}}),
         "/boundary: there are more independent conditions, 1 at the beginning and 2 at the end, "
         "than");
  begins(with("/time/end", 0), "/boundary: needs a trajectory");
  Json document = bratu(1.0);
  document["expect"] = {{{"boundary", "isolated"}, {"conjugate_points", 0}},
                        {{"at", "end"}, {"state", {{"q", 0}}}, {"tolerance", 1e-12}},
                        {{"duration", 1}, {"tolerance", 1e-12}}};
  BOOST_TEST(ran(document).outcome.as_expected());
  document["expect"] = {
      {{"boundary", "family"}}, {{"conjugate_points", 1}}, {{"duration", 2}, {"tolerance", 0.5}}};
  const RunInMemory run = ran(document);
  for (const auto& expectation : run.outcome.expectations)
    BOOST_TEST(!expectation.passed, expectation.description);
  document.erase("boundary");
  begins(problem_of(document), "/expect/0: tests nothing");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
