#include "courant/reading/output.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/experiment.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * rows between steps are written at the steps too
//  * the name of an array stands for none of its elements
BOOST_AUTO_TEST_SUITE(output)

namespace {

Json oscillator(const Json& output) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"coordinates", {"q", "r[2]"}},
            {"parameters", {{"T", 2}}},
            {"hamiltonian", "(p_q^2 + q^2)/2"}}},
          {"initial", {{"q", 1}}},
          {"method", "rk4"},
          {"time", {{"start", 1}, {"step", 0.5}, {"end", 4}}},
          {"observe", {{"twice", "2*q"}}},
          {"output", output}};
}

Output read(const Json& output) { return read_experiment_document(oscillator(output)).output; }

std::string problem(const Json& output) {
  try {
    read(output);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

const TimeSpan time_span{.start = 1, .step = 0.5, .steps = 6};

}  // namespace

BOOST_AUTO_TEST_CASE(heads_of_columns_have_units) {
  const Output with =
      read({{"units", {{"t", "s"}, {"q", "m"}, {"r", "kg m/s"}, {"twice", "2 m"}}}});
  BOOST_TEST(with.heading("t") == "t [s]");
  BOOST_TEST(with.heading("q") == "q [m]");
  BOOST_TEST(with.heading("r[1]") == "r[1] [kg m/s]");
  BOOST_TEST(with.heading("H") == "H");
  BOOST_TEST(with.heading("twice") == "twice [2 m]");
  for (const char* name : {"t", "r[1]", "r[1][2]", "a"}) {
    BOOST_TEST(without_unit(std::string(name) + " [m]") == name);
    BOOST_TEST(without_unit(name) == name);
  }
}

BOOST_AUTO_TEST_CASE(coordinates_have_columns_as_they_are_asked_for) {
  const Output all = read(Json::object());
  const Output some = read({{"coordinates", {"r", "p_r[1]"}}});
  const Output none = read({{"coordinates", Json::array()}});
  for (const char* name : {"q", "r[0]", "r[1]", "p_q", "p_r[0]", "p_r[1]"}) {
    const std::string coordinate = name;
    BOOST_TEST(all.has_column(coordinate));
    BOOST_TEST(some.has_column(coordinate) == (coordinate[0] == 'r' || coordinate == "p_r[1]"));
    BOOST_TEST(!none.has_column(coordinate));
  }
  BOOST_TEST(problem({{"coordinates", {"twice"}}})
                 .find("/output/coordinates/0: there is no such coordinate") == 0u);
  BOOST_TEST(problem({{"coordinates", {"s"}}})
                 .find("/output/coordinates/0: there is no such coordinate") == 0u);
  BOOST_TEST(problem({{"coordinates", "q"}}).find("/output/coordinates: is \"q\"; expected") == 0u);
}

BOOST_AUTO_TEST_CASE(rows_at_steps_and_between) {
  const Output output = read({{"at", {"T", 1.75, 1, 3.0000000000001, 3.25, 1.75, "T*sqrt(2)"}}});
  BOOST_CHECK(output.at.size() == 6u);
  std::vector<long> steps;
  for (long k = 0; k <= 6; ++k)
    if (output.is_written(k, time_span)) steps.push_back(k);
  BOOST_CHECK(steps == (std::vector<long>{0, 2, 4, 6}));  // 1, T = 2, 3, and the end
  BOOST_CHECK(output.between(2, time_span) == (std::vector<double>{1.75}));
  BOOST_TEST(output.between(4, time_span).size() == 1u);  // 2 √2
  BOOST_CHECK(output.between(5, time_span) == (std::vector<double>{3.25}));
  for (const long k : {1L, 3L, 6L}) BOOST_TEST(output.between(k, time_span).empty());
}

BOOST_AUTO_TEST_CASE(every_so_many_steps_and_the_last) {
  const Output output = read({{"every", 4}});
  for (long k = 0; k <= 6; ++k)
    BOOST_TEST(output.is_written(k, time_span) == (k == 0 || k == 4 || k == 6));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said) {
  const std::pair<Json, std::string> cases[] = {
      {{{"at", {0.5}}}, "/output/at/0: is 0.5; expected a time from 1 to 4"},
      {{{"at", {"x"}}}, "/output/at/0: column 1: unknown name \"x\""},
      {{{"at", {2}}, {"every", 2}}, "/output/at: stands beside \"every\""},
      {{{"units", {{"qq", "m"}}}},
       "/output/units/qq: there is no such quantity (did you mean \"q\"?)"},
      {{{"units", {{"q", "m,s"}}}}, "/output/units/q: is \"m,s\"; expected a unit without comma"},
      {{{"units", {{"q", ""}}}}, "/output/units/q: is \"\""},
      {{{"labels", {{"q", "two\nlines"}}}}, "/output/labels/q: is "},
      {{{"labels", {{"q", 3}}}}, "/output/labels/q: is 3; expected a string"},
      {{{"evry", 3}}, "/output/evry: unknown key"}};
  for (const auto& [json, words] : cases)
    BOOST_TEST(problem(json).find(words) != std::string::npos, problem(json)
                                                                   << " has no " << words);
}

BOOST_AUTO_TEST_CASE(comments_are_left_out_everywhere) {
  Json document = oscillator({{"every", 2}, {"// every", "two"}});
  document["//"] = "an oscillator";
  document["system"]["// hamiltonian"] = "quadratic";
  document["initial"]["// q"] = {{"//", 1}};
  document["expect"] = {{{"observable", "H"}, {"// why", "no reason"}, {"max_drift", 1}}};
  const Experiment experiment = read_experiment_document(document);
  BOOST_TEST(experiment.output.every == 2);
  BOOST_TEST(experiment.document.dump().find("//") == std::string::npos);
  document["system"]["/ hamiltonian"] = "no comment";
  BOOST_CHECK_THROW(read_experiment_document(document), ExperimentError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
