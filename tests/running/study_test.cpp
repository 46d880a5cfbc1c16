#include "courant/running/study.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/check.hpp"
#include "courant/tests/core/says.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the error is that of the end, not the greatest
//  * the reference is taken for better than it is
//  * the reference is of order 5
//  * a reference is said to be that of all methods if it is that of the first
//    (running/study_report.cpp)
BOOST_AUTO_TEST_SUITE(study_test)

namespace {

// Nonlinear, with no closed form.
const std::string pendulum = R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 - cos(q)" },
  "initial": { "q": 2, "p_q": 0 },
  "method": "METHOD",
  "time": { "step": 0.1, "end": 2 },
  "observe": { "twice": "2*q" }
})json";

// q' = q²: q = 1/(1 - t).
const std::string riccati = R"json({
  "system": { "type": "implicit", "coordinates": ["q"], "equations": ["q' - q^2"] },
  "initial": { "q": 1 },
  "method": "METHOD",
  "time": { "step": 0.05, "end": 0.5 },
  "expect": [ { "state": { "q": "FORM" }, "tolerance": 0.1 } ]
})json";

Experiment experiment(std::string text, const std::string& method,
                      const std::string& form = "1/(1 - t)") {
  text.replace(text.find("METHOD"), 6, method);
  if (const auto at = text.find("FORM"); at != std::string::npos) text.replace(at, 4, form);
  return read_experiment(text);
}

StudyOptions options() { return {.backend = Backend::interpreter}; }

Json study_of(const Experiment& one, const StudyOptions& how = options()) {
  const StudySubject subject{"subject", one};
  return to_json(study(std::span(&subject, 1), how)).at("methods").front();
}

}  // namespace

BOOST_AUTO_TEST_CASE(measures_the_order_against_a_closed_form) {
  const std::pair<const char*, double> orders[] = {
      {"discretize-first", 2.0}, {"rk2", 2.0}, {"rk4", 4.0}};
  for (const auto& [method, order] : orders) {
    const Json found = study_of(experiment(riccati, method));
    BOOST_TEST(found["reference"] == "closed form");
    BOOST_TEST(found["reference_order"].is_null());
    BOOST_TEST(found["reference_error"] == 0.0);
    BOOST_TEST(found["quantities"] == Json::array({"q"}));
    BOOST_TEST(std::abs(found["order"].get<double>() - order) < 0.15, method);
    BOOST_TEST(found["rows"].size() == 5u);
  }
}

// The error of a step is that of the run itself.
BOOST_AUTO_TEST_CASE(an_error_is_the_greatest_along_the_run) {
  const Json found = study_of(experiment(riccati, "rk2"));
  double q = 1.0, greatest = 0.0;
  for (int k = 1; k <= 10; ++k) {
    const double half = q + 0.025 * q * q;
    q += 0.05 * half * half;
    greatest = std::max(greatest, std::abs(q - 1.0 / (1.0 - 0.05 * k)));
  }
  BOOST_TEST(found["rows"][0]["error"].get<double>() == greatest,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(found["rows"][0]["step"] == 0.05);
  BOOST_TEST(found["rows"][4]["steps"] == 160);
}

BOOST_AUTO_TEST_CASE(without_a_closed_form_the_reference_is_a_fine_run) {
  for (const auto& [method, order] : {std::pair("discretize-first", 2.0), std::pair("rk4", 4.0)}) {
    const Json found = study_of(experiment(pendulum, method));
    BOOST_TEST(says(found["reference"].get<std::string>(), "rkf78, order 8, at the step 0.0"),
               found["reference"]);
    BOOST_TEST(found["reference_order"] == 8);
    BOOST_TEST(found["reference_error"].get<double>() < 1e-12);
    BOOST_TEST(found["quantities"] == Json::array({"q", "p_q"}));
    BOOST_TEST(std::abs(found["order"].get<double>() - order) < 0.15, method);
  }
}

// The slope over steps whose errors are above round-off.
BOOST_AUTO_TEST_CASE(the_method_of_references_is_of_order_8) {
  Json document = experiment(riccati, "rkf78").document;
  StudyOptions how = options();
  how.steps = 2;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, n = 0.0;
  for (const double count : {28.0, 36.0, 46.0, 60.0}) {
    document["time"] = {{"step", 0.9 / count}, {"end", 0.9}};
    const Json found = study_of(read_experiment_document(document), how);
    const double log_step = std::log(0.9 / count),
                 log_error = std::log(found["rows"][0]["error"].get<double>());
    x += log_step, y += log_error, xx += log_step * log_step, xy += log_step * log_error, n += 1.0;
  }
  const double order = (n * xy - x * y) / (n * xx - x * x);
  BOOST_TEST(std::abs(order - 8.0) < 0.15, "shows " << order);
}

BOOST_AUTO_TEST_CASE(quantities_can_be_chosen) {
  StudyOptions how = options();
  how.quantities = {"twice"};
  const Json twice = study_of(experiment(pendulum, "rk4"), how);
  how.quantities = {"q"};
  const Json once = study_of(experiment(pendulum, "rk4"), how);
  BOOST_TEST(
      twice["rows"][0]["error"].get<double>() == 2.0 * once["rows"][0]["error"].get<double>(),
      boost::test_tools::tolerance(1e-6));
  how.quantities = {"thrice"};
  BOOST_CHECK_THROW(study_of(experiment(pendulum, "rk4"), how), ExperimentError);
}

// x has errors of 10⁻⁴ and order 4; y, whose errors are a thousandth of that, moves by a velocity with a corner, and has order 2 at most.
BOOST_AUTO_TEST_CASE(small_quantities_have_orders_of_their_own) {
  const Experiment one = read_experiment(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "y"],
                "equations": ["x' - 3*x*cos(5*t)", "y' - 1e-4*abs(t - 1/3)*abs(t - 1/3)^0.5"] },
    "initial": { "x": 1, "y": 0 }, "method": "rk4", "time": { "step": 0.05, "end": 1 } })json");
  StudyOptions how = options();
  how.steps = 4;
  const Json found = study_of(one, how);
  BOOST_TEST(std::abs(found["order"].get<double>() - 4.0) < 0.35);
  BOOST_TEST(std::abs(found["orders"]["x"].get<double>() - 4.0) < 0.35);
  BOOST_TEST(found["orders"]["y"].get<double>() < 3.2);
  BOOST_TEST(says(found["remark"].get<std::string>(), "Of a lower order than all together: y ("),
             found["remark"]);
  // Alone the other one has nothing to hide.
  how.quantities = {"x"};
  BOOST_TEST(study_of(one, how)["remark"] == "");
}

// What P12 of `courant check` says of Method 1 on a problem of index 3 in an unknown that multiplies states.
BOOST_AUTO_TEST_CASE(a_study_agrees_with_the_law_of_convergence) {
  Json problem = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["a", "b", "c", "d"], "unknowns": ["u"],
                "equations": ["a' - 2*a*b*c*d", "b' + a*b*d^2", "c' - (a*b + c*d)*u",
                              "d' + a*b^2*d^2*u", "a*b^2 - 1"] },
    "initial": { "a": 1, "b": 1, "c": 1, "d": 1 }, "time": { "step": 0.01, "end": 1 } })json");
  for (const auto& [method, order] :
       {std::pair("discretize-first", 0.0), std::pair("constrain-first", 2.0)}) {
    problem["method"] = method;
    const Experiment one = read_experiment(problem.dump());
    const Json found = study_of(one);
    int measured = 0;
    const Json report = check_experiment(one);
    for (const Json& check : report.at("checks"))
      if (check.at("law") == "P12") {
        ++measured;
        BOOST_TEST(check.at("passed").get<bool>() == (order > 0.0), method << ": " << check);
      }
    BOOST_TEST(measured == 1);
    BOOST_TEST(std::abs(found["order"].get<double>() - order) < 0.3, method);
    double lowest = 10.0;
    for (const Json& of : found["orders"]) lowest = std::min(lowest, of.get<double>());
    BOOST_TEST(std::abs(lowest - order) < 0.3, method << ": " << found["orders"]);
  }
}

// A closed form that is not the solution: the errors stop falling, and the order does not pass for one.
BOOST_AUTO_TEST_CASE(a_wrong_reference_is_said) {
  const Json found = study_of(experiment(riccati, "rk4", "1/(1 - t) + 0.001"));
  BOOST_TEST(std::abs(found["order"].get<double>()) < 0.1);
  BOOST_TEST(found["remark"].get<std::string>().find("The error does not fall with the step") ==
             0u);
}

BOOST_AUTO_TEST_CASE(steps_that_cannot_be_made_are_said) {
  // q blows up at t = 1, which an implicit step of 2 does not get past.
  Json document = experiment(riccati, "discretize-first").document;
  document["time"] = {{"step", 0.45}, {"end", 0.9}};
  const Json found = study_of(read_experiment_document(document));
  BOOST_TEST(found["rows"][0]["error"].is_null() ==
             !found["rows"][0]["message"].get<std::string>().empty());
  BOOST_TEST(!found["rows"][0]["message"].get<std::string>().empty());
  BOOST_TEST(found["rows"][4]["error"].get<double>() > 0.0);
}

BOOST_AUTO_TEST_CASE(methods_share_what_is_the_same) {
  const StudySubject subjects[] = {{"a", experiment(pendulum, "rk2")},
                                   {"a", experiment(pendulum, "rk4")}};
  const StudyReport report = study(subjects, options());
  const Json both = to_json(report);
  BOOST_TEST(both["status"] == "completed");
  BOOST_TEST(both["reference"].is_string());
  BOOST_TEST(both["methods"][0]["reference_error"] == both["methods"][1]["reference_error"]);
  const std::string csv = study_csv(report);
  BOOST_TEST(std::count(csv.begin(), csv.end(), '\n') == 11);
  BOOST_TEST(csv.find("experiment,method,step,steps,error,order,iterations,factorizations,seconds,"
                      "message,reference\na,rk2,0.1,20,") == 0u);
  BOOST_TEST(says(csv, ",,\"rkf78, order 8, at the step"), csv);
}

// What is known and what is not.
BOOST_AUTO_TEST_CASE(what_is_written_is_read_back) {
  StudyReport report;
  report.is_interrupted = true;
  report.methods = {{.experiment = "a",
                     .method = "rk2",
                     .quantities = {"q", "p"},
                     .reference = "closed form",
                     .order = 1.875,
                     .orders = {2.0, {}},
                     .rows = {{.step = 0.25, .message = "cannot be made"},
                              {.step = 0.125,
                               .error = 1e-3,
                               .seconds = 0.5,
                               .order = 2.5,
                               .steps = 8,
                               .iterations = 16,
                               .factorizations = 1}}},
                    {.experiment = "b",
                     .method = "rk4",
                     .quantities = {"q", "p"},
                     .reference = "rkf78",
                     .reference_order = 8,
                     .reference_error = 1e-13,
                     .remark = "Not every step could be made."}};
  const Json json = to_json(report);
  BOOST_TEST(json["reference"].is_null());
  BOOST_TEST(json["quantities"] == Json({"q", "p"}));
  BOOST_TEST(json["methods"][0]["rows"][0]["error"].is_null());
  BOOST_TEST(json["methods"][1]["order"].is_null());
  BOOST_TEST(to_json(read_study_report(json)) == json);
  BOOST_CHECK_THROW(read_study_report(Json{{"methods", 3}}), Json::exception);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_studied_is_refused) {
  Json document = experiment(pendulum, "rk2").document;
  document.erase("method");
  document.erase("time");
  BOOST_CHECK_THROW(study_of(read_experiment_document(document)), ExperimentError);
  const std::atomic<bool> stop{true};
  StudyOptions how = options();
  how.stop = &stop;
  const StudySubject subject{"a", experiment(pendulum, "rk2")};
  const StudyReport report = study(std::span(&subject, 1), how);
  BOOST_TEST(report.is_interrupted);
  BOOST_TEST(to_json(report)["status"] == "interrupted");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
