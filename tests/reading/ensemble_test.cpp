#include "courant/reading/ensemble.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>

#include "../core/files/temporary_folder.hpp"
#include "courant/core/numbers/random_numbers.hpp"
#include "courant/reading/ensemble_members.hpp"
#include "courant/tests/core/says.hpp"
#include "experiment_problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(ensemble_test)

namespace {

Json members_of(const Json& ensemble) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"coordinates", {"x[2]"}},
            {"parameters", {{"k", {1, 2}}, {"m", 1}}},
            {"hamiltonian", "dot(p_x, p_x)/(2*m) + k[0]*x[0]^2 + k[1]*x[1]^2"}}},
          {"initial", {{"x", {1, 2}}, {"p_x[0]", 0}, {"p_x[1]", 0}}},
          {"ensemble", ensemble},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", 1}}}};
}

std::string problem_of(const Json& ensemble) { return problems(members_of(ensemble)); }

std::string problem_of_values(const Json& values) {
  return problem_of({{"members", 3}, {"values", values}});
}

std::string problem_of_table(const std::string& text, TableFiles which = TableFiles::anywhere,
                             const std::string& name = "starts.csv") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "here");
  std::ofstream(folder / "here/starts.csv") << text;
  std::ofstream(folder / "outside.csv") << text;
  Json document = members_of({{"table", name}});
  try {
    load_tables(document, folder / "here", which);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return problems(document);
}

}  // namespace

BOOST_AUTO_TEST_CASE(members_have_numbers_of_lists_and_formulas) {
  const Experiment experiment = read_experiment_document(members_of(
      {{"seed", 5},
       {"random", {{"g", "normal"}, {"u", "uniform"}}},
       {"values", {{"x[1]", {4, 5, 6}}, {"k[0]", "m + i/10"}, {"p_x[0]", "2*g + u"}, {"m", 3}}}}));
  const Ensemble& ensemble = *experiment.ensemble;
  BOOST_REQUIRE(ensemble.members() == 3);
  BOOST_TEST(ensemble.pointers ==
             (std::vector<std::string>{"/initial/x/1", "/system/parameters/k/0", "/initial/p_x[0]",
                                       "/system/parameters/m"}));
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST(ensemble.values(i, 0) == 4.0 + static_cast<double>(i));
    BOOST_TEST(ensemble.values(i, 1) == 1.0 + static_cast<double>(i) / 10.0);
    const auto number = static_cast<std::uint64_t>(i);
    BOOST_TEST(ensemble.values(i, 2) == 2.0 * RandomNumbers(5, "g", number).normal() +
                                            RandomNumbers(5, "u", number).uniform());
    BOOST_TEST(ensemble.values(i, 3) == 3.0);
  }
  const EnsembleMembers members(experiment);
  BOOST_TEST(members(2).initial.x.values[1] == 6.0);
  BOOST_TEST(members(2).document["system"]["parameters"]["k"][0] == 1.2);
}

// Otherwise a row of the array would stand for several times.
BOOST_AUTO_TEST_CASE(members_have_the_same_times) {
  Json document = members_of({{"values", {{"m", {1, 2}}}}});
  document["time"] = {{"step", "m/10"}, {"end", "10*m"}};
  const Experiment experiment = read_experiment_document(document);
  const EnsembleMembers members(experiment);
  BOOST_TEST(members(0).time->step == 0.1);
  BOOST_CHECK_EXCEPTION(members(1), ExperimentError, [](const ExperimentError& error) {
    return says(error.what(), "/time: is made of parameters that members change: the step is 0.2");
  });
}

BOOST_AUTO_TEST_CASE(a_table_has_the_values_of_lists) {
  const TemporaryFolder folder;
  std::ofstream(folder / "starts.csv") << "x[0], m\r\n1,2\r\n\r\n-3e-1,0.25\r\n";
  Json document = members_of({{"table", "starts.csv"}, {"values", {{"k[1]", "i"}}}});
  load_tables(document, folder.path(), TableFiles::beside);
  BOOST_TEST(document["ensemble"] ==
             Json::parse(R"({"values": {"x[0]": [1.0, -0.3], "m": [2.0, 0.25], "k[1]": "i"}})"));
  BOOST_TEST(read_experiment_document(document).ensemble->members() == 2);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_with_a_table_is_said_by_its_line) {
  BOOST_TEST(problem_of_table("x[0]\n1\n") == "");
  BOOST_TEST(says(problem_of_table("y\n1\n"),
                  "/ensemble/values/y: is neither an initial value nor a parameter"));
  BOOST_TEST(says(problem_of_table("x[0],m\n1,2\n1\n"), "starts.csv:3 has 1 cells; expected 2"));
  BOOST_TEST(
      says(problem_of_table("x[0]\n1\none\n"), "starts.csv:3 has \"one\"; expected a number"));
  BOOST_TEST(says(problem_of_table("x[0]\ninf\n"), "starts.csv:2 has \"inf\"; expected a number"));
  BOOST_TEST(says(problem_of_table("x[0]\n"), "starts.csv has no rows"));
  BOOST_TEST(says(problem_of_table(""), "/ensemble/table: "));
  BOOST_TEST(says(problem_of_table("m,m\n1,2\n"), "has two columns m"));
  BOOST_TEST(says(problem_of_table("m,\n1,2\n"), "has a column without a name"));
  BOOST_TEST(says(problem_of_table("m\n1\n", TableFiles::anywhere, "none.csv"), "cannot be read"));
  BOOST_TEST(problem_of_table("m\n1\n", TableFiles::anywhere, "../outside.csv") == "");
  BOOST_TEST(
      says(problem_of_table("m\n1\n", TableFiles::beside, "../outside.csv"),
           "the experiment is not trusted; expected a file in the folder of the experiment"));
  BOOST_TEST(problem_of_table("m\n1\n", TableFiles::beside) == "");
  BOOST_TEST(says(problem_of_table("m\n1\n", TableFiles::none), "/ensemble/table: "));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said_at_its_place) {
  BOOST_TEST(says(problem_of_values({{"xx[0]", {1, 2, 3}}}),
                  "/ensemble/values/xx[0]: is neither an initial value nor a parameter of the "
                  "experiment (did you mean \"x[0]\"?)"));
  BOOST_TEST(says(problem_of_values({{"x[7]", 1}}), "/ensemble/values/x[7]: key, "));
  BOOST_TEST(says(problem_of_values({{"k[2]", 1}}), "has the index 2; k has 2 elements"));
  BOOST_TEST(says(problem_of_values({{"k", 1}}), "is an array; expected one of its elements"));
  BOOST_TEST(says(problem_of_values({{"x", 1}}), "is an array; expected one of its elements"));
  BOOST_TEST(says(problem_of_values({{"m", {1, 2}}}), "has 2 numbers; expected 3"));
  BOOST_TEST(says(problem_of_values({{"m", Json::array()}}), "expected a number for each member"));
  BOOST_TEST(says(problem_of_values({{"m", {1, "a", 2}}}), "/ensemble/values/m/1"));
  BOOST_TEST(says(problem_of_values({{"m", "1 + j"}}), "/ensemble/values/m: "));
  BOOST_TEST(says(problem_of_values({{"m", "1/(i - 1)"}}), "for member 1; expected a finite"));
  BOOST_TEST(says(problem_of({{"values", {{"m", "1 + i"}}}}), "/ensemble: does not say how many"));
  BOOST_TEST(says(problem_of({{"members", 0}, {"values", {{"m", 1}}}}), "/ensemble/members: is 0"));
  BOOST_TEST(says(problem_of({{"members", 20'000'000}, {"values", {{"m", 1}}}}),
                  "expected at most 10000000 members"));
  BOOST_TEST(says(problem_of({{"members", 2}, {"random", {{"g", "gauss"}}}, {"seed", 1}}),
                  "/ensemble/random/g"));
  BOOST_TEST(says(problem_of({{"members", 2}, {"random", {{"g", "normal"}}}}),
                  "/ensemble/random: needs a seed"));
  BOOST_TEST(says(problem_of({{"members", 2}, {"random", {{"m", "normal"}}}, {"seed", 1}}),
                  "/ensemble/random/m: key, "));
  BOOST_TEST(says(problem_of({{"member", 2}}), "/ensemble/member: "));
  BOOST_TEST(says(problem_of({{"table", "starts.csv"}}), "which only the command reads"));
}

BOOST_AUTO_TEST_CASE(what_does_not_go_with_an_ensemble_is_refused) {
  const Json ensemble = {{"members", 2}, {"values", {{"m", "1 + i"}}}};
  const auto changed = [&](const char* key, const Json& value) {
    Json document = members_of(ensemble);
    document[key] = value;
    return problems(document);
  };
  BOOST_TEST(problem_of(ensemble) == "");
  BOOST_TEST(says(changed("boundary", {{"final", {{"x", {0, 0}}}}}),
                  "/ensemble: is of given starts, and \"boundary\" seeks one"));
  BOOST_TEST(says(changed("time", {{"tolerance", 1e-3}, {"end", 1}}),
                  "/ensemble: is for one step of all members"));
  BOOST_TEST(says(changed("time", {{"step", 0.1}, {"end", 1}, {"transformation", "1"}}),
                  "/ensemble: is for steps of one size in t"));
  Json no_run = members_of(ensemble);
  no_run.erase("method");
  no_run.erase("time");
  BOOST_TEST(says(problems(no_run), "/ensemble: needs trajectories"));
  Json alone = members_of(ensemble);
  alone.erase("ensemble");
  alone["expect"] = {{{"mean", {{"x[0]", 1}}}, {"tolerance", 1}}};
  BOOST_TEST(says(problems(alone), "/expect/0/mean: is of an ensemble"));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
