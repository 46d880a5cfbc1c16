#include "courant/running/run_summary.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "vortex_runs.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a number that is missing is zero
//  * a ladder that is a number is answered in words of the JSON library
BOOST_AUTO_TEST_SUITE(run_summary)

namespace {

RunSummary example() {
  RunSummary summary{.id = "0123456789abcdef",
                     .status = RunStatus::not_finite,
                     .message = "n is nan",
                     .warnings = {"one", "two"},
                     .title = "Title",
                     .system = "system",
                     .method = "method",
                     .steps = 17,
                     .time = RunSummary::Time{.start = 0.5, .end = 2.2, .step = 0.1},
                     .final = {{"q", 0.1}, {"p", -1e-300}},
                     .max_violation = 1e-13,
                     .power_balance = PowerAccount::Report{.supplied = {{"hand", 0.5}, {"1", -2.0}},
                                                           .dissipated = {},
                                                           .stored = 0.25,
                                                           .max_balance = 1e-15,
                                                           .max_imbalance = 1e-16,
                                                           .max_stage_imbalance = 1e-17},
                     .ladder = LadderReport{.verdict = Verdict::regular, .index = 1},
                     .backend = "native",
                     .wall_seconds = 0.25,
                     .cpu_seconds = 0.375,
                     .steps_per_second = 68.0};
  summary.observables = {
      {"H",
       QuantityRecord{
           .initial = 1.0, .final = 2.0, .min = 0.5, .max = 3.0, .max_drift = 2.0, .slope = 0.01}}};
  summary.expectations = {{.pointer = {},
                           .description = "d",
                           .passed = true,
                           .value = Json::array({{2, 2}}),
                           .bound = nullptr,
                           .finding = {}}};
  summary.solver = {.iterations_per_step = 1.5,
                    .factorizations_per_step = 0.25,
                    .failures = 1,
                    .second_attempts = 2,
                    .confirmations = 3,
                    .divisions = 4};
  return summary;
}

}  // namespace

BOOST_AUTO_TEST_CASE(reads_back_to_what_was_written) {
  const Json json = to_json(example());
  BOOST_TEST(to_json(read_run_summary(json)).dump(1) == json.dump(1));
  const RunSummary read = read_run_summary(json);
  BOOST_TEST((read.status == RunStatus::not_finite));
  BOOST_TEST(read.steps == 17);
  BOOST_TEST(read.time->end == 2.2);
  BOOST_TEST((read.final == example().final));
  BOOST_TEST(read.observable("H")->slope == 0.01);
  BOOST_TEST(!read.observable("K"));
  BOOST_TEST(read.max_violation.value() == 1e-13);
  BOOST_TEST((read.power_balance->supplied == example().power_balance->supplied));
  BOOST_TEST(read.power_balance->dissipated.empty());
  BOOST_TEST(read.power_balance->stored == 0.25);
  BOOST_TEST(read.power_balance->max_balance == 1e-15);
  BOOST_TEST(read.power_balance->max_imbalance == 1e-16);
  BOOST_TEST(read.power_balance->max_stage_imbalance == 1e-17);
  BOOST_TEST(read.expectations[0].passed);
  BOOST_TEST(read.solver.confirmations.value() == 3);
  BOOST_TEST(read.solver.divisions.value() == 4);
}

BOOST_AUTO_TEST_CASE(what_is_missing_or_null_is_not_known) {
  const RunSummary least =
      read_run_summary({{"status", "failed"}, {"system", "s"}, {"method", "m"}, {"steps", 0}});
  BOOST_TEST(!least.time);
  BOOST_TEST(!least.max_violation);
  BOOST_TEST(!least.power_balance);
  BOOST_TEST(!least.solver.failures);
  BOOST_TEST(std::isnan(least.wall_seconds));
  BOOST_TEST(std::isnan(least.cpu_seconds));
  BOOST_TEST(!least.ladder);
  Json json = to_json(example());
  json["observables"]["H"]["max"] = nullptr;
  json["observables"]["H"].erase("slope");
  json["final"]["p"] = nullptr;
  const RunSummary read = read_run_summary(json);
  BOOST_TEST(std::isnan(read.observable("H")->max));
  BOOST_TEST(std::isnan(read.observable("H")->slope));
  BOOST_TEST(std::isnan(read.final[1].second));
}

BOOST_AUTO_TEST_CASE(a_defect_is_said_with_its_place) {
  const auto said = [](const char* key, const Json& value) -> std::string {
    Json json = to_json(example());
    json[key] = value;
    try {
      read_run_summary(json);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  BOOST_TEST(said("steps", "many") == "/steps: is string, expected a number.");
  BOOST_TEST(said("ladder", {{"verdict", "later"}, {"levels", Json::array()}}) ==
             "/ladder/verdict: is \"later\", expected one of regular, gauge, inconsistent, "
             "rank-change, not-reached.");
  for (const char* list : {"moves", "levels", "constraints", "doubts"}) {
    Json ladder = {{"verdict", "regular"}, {"levels", Json::array()}};
    ladder[list] = Json::array({1.5});
    const std::string what = said("ladder", ladder);
    BOOST_TEST(what.find("exception") == std::string::npos, what);
  }
  BOOST_TEST(
      said("ladder", {{"verdict", "regular"}, {"levels", Json::array()}, {"moves", {1.5}}}) ==
      "/ladder: is none that a run writes.");
  BOOST_TEST(said("status", "lost") ==
             "/status: is \"lost\", expected running, completed, failed, interrupted or "
             "not-finite.");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
