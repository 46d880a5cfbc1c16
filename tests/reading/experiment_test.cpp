#include "courant/reading/experiment.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "courant/core/language/formula.hpp"
#include "experiment_problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a time between two steps is taken for a step (reading/expectation.cpp)
//  * a value may be given twice (reading/initial_values.cpp)
//  * a step is a whole period
BOOST_AUTO_TEST_SUITE(experiment)

namespace {

const Json vortices = Json::parse(R"json({
  "system": { "type": "point-vortices", "strengths": [1, 1, -1, -1] },
  "initial": { "x": [-1, 1, -1, 1], "y": [2, 2, -2, -2] },
  "method": { "type": "constrain-first", "discretization": "midpoint", "projector": "momentum" },
  "time": { "step": 1.0, "end": 300 },
  "observe": { "spread": "(x[1]-x[0])^2 + (y[1]-y[0])^2" },
  "expect": [ { "observable": "H", "max_drift": 2e-4 } ]
})json");

const Json pendulum = Json::parse(R"json({
  "system": {
    "type": "lagrangian", "parameters": { "g": 9.81, "l": 2, "k": "sqrt(g/l)" },
    "definitions": { "height": "-l*cos(q)", "kinetic": "l^2*q'^2/2" },
    "coordinates": ["q"], "lagrangian": "kinetic - g*height"
  },
  "initial": { "q": 1, "q'": "k" }, "method": "rk4", "time": { "step": 0.1, "end": 1 }
})json");

using courant::problems;

std::string problems(Json experiment, const char* pointer, const Json& value) {
  experiment[Json::json_pointer(pointer)] = value;
  return problems(experiment);
}

std::string problems_without(Json experiment, const char* parent, const char* key) {
  experiment[Json::json_pointer(parent)].erase(key);
  return problems(experiment);
}

}  // namespace

BOOST_AUTO_TEST_CASE(reads_an_experiment) {
  const Experiment experiment = read_experiment(vortices.dump());
  BOOST_TEST(experiment.model.description == "4 point vortices, singular Lagrangian form");
  BOOST_TEST(experiment.method->description == "constrain-first, midpoint, momentum projector");
  BOOST_TEST(experiment.time->steps == 300);
  BOOST_TEST(experiment.model.system->manifold()->ambient_dimension() == 16);
  BOOST_TEST(experiment.initial.x.given.count() == 8);
  BOOST_TEST(experiment.initial.x.values[3] == 1.0);
  BOOST_TEST(experiment.initial.x.values[4] == 2.0);
  BOOST_TEST(problems(pendulum) == "");
}

BOOST_AUTO_TEST_CASE(fills_defaults_into_the_document) {
  const Json document = read_experiment(pendulum.dump()).document;
  BOOST_TEST(document["time"]["start"] == 0.0);
  BOOST_TEST(document["output"]["every"] == 1);
  BOOST_TEST(document["output"]["epoch"] == 4096);
  BOOST_TEST(document["output"]["format"] == "csv");
  BOOST_TEST(document["method"]["type"] == "rk4");
  BOOST_TEST(read_experiment(vortices.dump()).document["system"]["form"] == "lagrangian");
  // What was filled in means the same: the document is its own completion.
  BOOST_TEST(read_experiment(document.dump()).document.dump() == document.dump());
}

BOOST_AUTO_TEST_CASE(names_the_place_in_a_formula) {
  BOOST_TEST(problems(pendulum, "/system/lagrangian", "kinetic - qq") ==
             "/system/lagrangian: column 11: unknown name \"qq\" (did you mean \"q\"?)");
  BOOST_TEST(problems(pendulum, "/system/definitions/height", "-l*coz(q)")
                 .find("/system/definitions/height: column 4: ") == 0u);
  BOOST_TEST(problems(pendulum, "/system/parameters/k", "sqrt(g/")
                 .find("/system/parameters/k: column 8: ") == 0u);
  BOOST_TEST(problems(vortices, "/observe/spread", "x[4]").find("/observe/spread: column ") == 0u);
  BOOST_TEST(
      problems(pendulum, "/initial/q", "t").find("/initial/q: column 1: unknown name \"t\"") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_strengths_and_steps_that_mean_nothing) {
  BOOST_TEST(
      problems(vortices, "/system/strengths/2", 0).find("/system/strengths/2: is 0; expected") ==
      0u);
  BOOST_TEST(problems(vortices, "/system/strengths", Json::array()).find("/system/strengths: ") ==
             0u);
  BOOST_TEST(problems(vortices, "/time/step", -1.0) ==
             "/time/step: is -1.0; expected a number greater than 0");
  BOOST_TEST(problems(vortices, "/time/step", 0) ==
             "/time/step: is 0; expected a number greater than 0");
  Json in_periods = vortices;
  in_periods["time"]["step"] = {{"period", "2*(1 + 1)"}, {"steps", 8}};
  BOOST_TEST(read_experiment(in_periods.dump()).time->step == 0.5);
  BOOST_TEST(problems(vortices, "/time/step", Json{{"period", -1}, {"steps", 0}}) ==
             "/time/step/steps: is 0; expected an integer, at least 1\n"
             "/time/step/period: is -1; expected a number greater than 0");
  BOOST_TEST(problems(vortices, "/time/step", Json{{"period", 1}}) ==
             "/time/step/steps: is missing");
  const std::string not_whole = problems(vortices, "/time/step", 0.7);
  BOOST_TEST(not_whole.starts_with("/time/end: is 428.57"), not_whole);
  BOOST_TEST(not_whole.ends_with("as with a step of 0.6993006993006993"), not_whole);
  BOOST_TEST(problems(vortices, "/time/end", -1).find("/time/end: is -1; expected") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_coinciding_vortices) {
  Json coinciding = vortices;
  coinciding["initial"]["x"][1] = -1;
  BOOST_TEST(problems(coinciding).find("/initial: vortices 0 and 1 are at one place") == 0u);
  coinciding["initial"]["y"][1] = 2.5;
  BOOST_TEST(problems(coinciding) == "");
}

BOOST_AUTO_TEST_CASE(refuses_unknown_and_missing_keys) {
  BOOST_TEST(problems(vortices, "/metod", 1) == "/metod: unknown key (did you mean \"method\"?)");
  BOOST_TEST(problems(vortices, "/method/projektor", "momentum") ==
             "/method/projektor: unknown key (did you mean \"projector\"?)");
  BOOST_TEST(problems(vortices, "/method/type", "constrainfirst") ==
             "/method/type: unknown \"constrainfirst\" (did you mean \"constrain-first\"?)");
  BOOST_TEST(problems_without(vortices, "", "system") == "/system: is missing");
  BOOST_TEST(problems_without(vortices, "", "initial") == "/initial: is missing");
  BOOST_TEST(problems_without(vortices, "", "method") == "/method: is missing");
  BOOST_TEST(problems_without(vortices, "", "time") == "/time: is missing");
  BOOST_TEST(problems_without(vortices, "/system", "strengths") == "/system/strengths: is missing");
  BOOST_TEST(problems(Json::array()) == "is an empty array; expected an object");
}

BOOST_AUTO_TEST_CASE(tells_all_problems_at_once) {
  Json wrong = pendulum;
  wrong["titel"] = "x";
  wrong["time"]["step"] = "fast";
  wrong["system"]["lagrangian"] = "q'^2 - u";
  wrong["initial"]["p"] = 1;
  wrong["observe"] = {{"speed", "abs(q'"}};
  wrong["expect"] = {{{"observable", "L"}, {"max_drift", 1}}};
  const std::string found = problems(wrong);
  // Without a system, what is said in its words cannot be looked into.
  for (const char* where : {"/titel: ", "/time/step: ", "/system/lagrangian: "})
    BOOST_TEST(found.find(where) != std::string::npos, where << " is not in\n" << found);
  wrong["system"]["lagrangian"] = "q'^2";
  const std::string now = problems(wrong);
  for (const char* where : {"/titel: ", "/time/step: ", "/initial/p: key, column 1: unknown name",
                            "/observe/speed: column ", "/expect/0/observable: unknown"})
    BOOST_TEST(now.find(where) != std::string::npos, where << " is not in\n" << now);
}

BOOST_AUTO_TEST_CASE(refuses_names_that_are_taken) {
  BOOST_TEST(
      problems(vortices, "/system/parameters", {{"x", 1}}).find("/system/parameters/x: key, ") ==
      0u);
  BOOST_TEST(
      problems(pendulum, "/system/coordinates", {"q", "q"}).find("/system/coordinates/1: ") == 0u);
  BOOST_TEST(
      problems(pendulum, "/system/coordinates", {"q", "g"}).find("/system/coordinates/1: ") == 0u);
  BOOST_TEST(
      problems(pendulum, "/system/coordinates", {"q", "t"}).find("/system/coordinates/1: ") == 0u);
  BOOST_TEST(problems(pendulum, "/system/coordinates", {"q", "p_q"})
                 .find("/system/coordinates: the momentum of") == 0u);
  BOOST_TEST(problems(pendulum, "/system/definitions/q", "1") ==
             "/system/coordinates/0: column 1: \"q\" has a meaning already; expected a new name");
  BOOST_TEST(problems(pendulum, "/observe", {{"H", "1"}}).find("/observe/H: key, ") == 0u);
  BOOST_TEST(problems(pendulum, "/observe", {{"q", "1"}}).find("/observe/q: key, ") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_initial_values_that_do_not_fit) {
  BOOST_TEST(problems(vortices, "/initial/x", {1, 2, 3}) ==
             "/initial/x: has 3 values; expected 4, for x");
  BOOST_TEST(problems(vortices, "/initial/x[0]", 1) == "/initial/x[0]: is given twice");
  BOOST_TEST(problems(vortices, "/initial/x[4]", 1).find("/initial/x[4]: key, column ") == 0u);
  BOOST_TEST(problems(vortices, "/initial/y", {1, 2, 3, "1/0"})
                 .find("/initial/y/3: is inf; expected a finite number") == 0u);
  BOOST_TEST(problems(vortices, "/hold", {"p_x"})
                 .find("/hold/0: is to be held, but its value is not given") == 0u);
  BOOST_TEST(problems(vortices, "/hold", {"x", "z"}).find("/hold/1: ") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_structures_that_do_not_fit) {
  Json regular = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["x", "y"], "hamiltonian": "x^2 + y^2",
                "structure": { "type": "bivector", "matrix": [[0, "1+x"], ["-1-x", 0]] } },
    "initial": { "x": 1, "y": 0 } })json");
  BOOST_TEST(problems(regular) == "");
  BOOST_TEST(problems(regular, "/system/structure/matrix/1/0", "1+x")
                 .find("/system/structure/matrix: is not skew-symmetric: ") == 0u);
  BOOST_TEST(problems(regular, "/system/structure/matrix/1", Json::array({0}))
                 .find("/system/structure/matrix/1: has 1 entries; expected 2") == 0u);
  BOOST_TEST(problems(regular, "/system/structure/matrix", {{0}})
                 .find("/system/structure/matrix: has 1 rows; expected 2 rows of 2 formulas") ==
             0u);
  BOOST_TEST(problems(regular, "/system/structure/matrix/0/1", "t")
                 .find("/system/structure/matrix/0/1: column 1: unknown name \"t\"") == 0u);
  Json canonical = regular;
  canonical["system"]["structure"] = "canonical";
  canonical["system"]["manifold"] = "euclidean";
  BOOST_TEST(problems(canonical).find("/system/structure: the canonical structure is on ") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_parts_of_structures_that_do_not_fit) {
  const Json product = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["x", "p_x", "s[3]"], "hamiltonian": "x^2 + s[0]",
                "definitions": { "twice": "2*x" },
                "structure": { "type": "product", "factors": [
                  { "coordinates": ["x"], "structure": "canonical" },
                  { "coordinates": ["s[3]"],
                    "structure": { "type": "lie-poisson", "algebra": "so3" } } ] } },
    "initial": { "x": 1, "p_x": 0, "s": [1, 0, 0] } })json");
  BOOST_TEST(problems(product) == "");
  BOOST_TEST(problems(product, "/system/coordinates/1", "p") ==
             "/system/structure/factors: have the coordinates x, p_x, s[0], s[1], s[2]; expected "
             "x, p, s[0], s[1], s[2], those of the whole, in that order");
  BOOST_TEST(problems(product, "/system/manifold", "euclidean").find("/system/manifold: is made") ==
             0u);
  BOOST_TEST(problems(product, "/system/structure/factors/0/coordinates/0", "twice")
                 .find("/system/structure/factors/0/coordinates/0: ") == 0u);
  BOOST_TEST(problems(product, "/system/structure/factors/0/momenta", 1)
                 .find("/system/structure/factors/0/momenta: unknown key") == 0u);
  BOOST_TEST(problems_without(product, "/system/structure/factors/1", "structure")
                 .find("/system/structure/factors/1/structure: ") == 0u);
  BOOST_TEST(problems(product, "/system/structure/factors/1/structure",
                      {{"type", "bivector"}, {"matrix", {{0, "x"}, {"-x", 0}}}})
                 .find("/system/structure/factors/1/structure/matrix: has 2 rows; expected 3") ==
             0u);
  Json gauge = product;  // it is on the manifold of the product
  gauge["system"]["structure"] = {{"type", "gauge"},
                                  {"structure", product.at("system").at("structure")},
                                  {"matrix", Json(5, Json(5, 0))}};
  BOOST_TEST(problems(gauge) == "");
  BOOST_TEST(problems(gauge, "/system/manifold", "euclidean").find("/system/manifold: is made") ==
             0u);
  BOOST_TEST(problems(gauge, "/system/structure/matrix/1", Json::array({0}))
                 .find("/system/structure/matrix/1: has 1 entries; expected 5") == 0u);

  const Json composed = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q", "p"], "hamiltonian": "q^2 + p^2",
                "structure": { "type": "composed", "parts": [
                  { "coordinates": ["q"],
                    "structure": { "type": "bivector", "matrix": [[0, 1], [-1, 0]] } },
                  { "coordinates": ["p"],
                    "structure": { "type": "distribution", "fields": [1, -1] } } ] } },
    "initial": { "q": 1, "p": 0 } })json");
  BOOST_TEST(problems(composed) == "");
  BOOST_TEST(problems(composed, "/system/structure/ports", 2)
                 .find("/system/structure/parts/0/structure/matrix: has 2 rows; expected 3") == 0u);
  BOOST_TEST(problems(composed, "/system/structure/ports", 0).find("/system/structure/ports: ") ==
             0u);
  BOOST_TEST(problems(composed, "/system/structure/parts/0/structure", "canonical")
                 .find("/system/structure/parts/0/structure: the canonical structure is on ") ==
             0u);
  Json three = composed;
  three["system"]["coordinates"].push_back("r");
  three["system"]["structure"]["parts"].push_back(
      {{"coordinates", {"r"}}, {"structure", {{"type", "distribution"}, {"fields", {1, -1}}}}});
  BOOST_TEST(problems(three) == "/system/structure/parts: are 3; expected 2");
  // A product does not have the ports.
  const Json without_ports = {
      {"type", "product"},
      {"factors", {composed.at(Json::json_pointer("/system/structure/parts/0"))}}};
  Json inner = composed;
  inner["system"]["structure"]["parts"][0]["structure"] = without_ports;
  inner["system"]["structure"]["parts"][0]["structure"]["factors"][0]["structure"]["matrix"] = {
      {0}};
  BOOST_TEST(problems(inner).starts_with("/system/structure/parts: "));
  BOOST_TEST(problems(inner).find("Composed") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(refuses_maps_that_do_not_fit) {
  const Json pullback = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["a", "b"], "hamiltonian": "a^2 + b^2",
                "structure": { "type": "pullback", "coordinates": ["x"], "structure": "canonical",
                               "map": ["a^3 + a", "b"] } },
    "initial": { "a": 1, "b": 0 } })json");
  BOOST_TEST(problems(pullback) == "");
  BOOST_TEST(problems(pullback, "/system/structure/map", Json::array({"a"})) ==
             "/system/structure/map: has 1 formulas; expected 2, one for each coordinate of "
             "CotangentBundle(Euclidean(1))");
  BOOST_TEST(problems(pullback, "/system/structure/map/1", "p_x")
                 .find("/system/structure/map/1: column 1: unknown name \"p_x\"") == 0u);
  BOOST_TEST(problems(pullback, "/system/structure/coordinates/0", "a")
                 .find("/system/structure/coordinates/0: ") == 0u);
  BOOST_TEST(
      problems_without(pullback, "/system/structure", "map").find("/system/structure/map: ") == 0u);
  BOOST_TEST(problems(pullback, "/system/structure/section", {"x", "p_x"})
                 .find("/system/structure/section: unknown key") == 0u);
  Json sphere = pullback;
  sphere["system"]["structure"] = {{"type", "pullback"},
                                   {"coordinates", {"x[3]"}},
                                   {"manifold", "sphere"},
                                   {"structure", {{"type", "distribution"}, {"fields", {0, 0, 0}}}},
                                   {"map", {"cos(a)", "sin(a)", 0}}};
  BOOST_TEST(problems(sphere) == "");
  BOOST_TEST(problems(sphere, "/system/structure/map/2", "b")
                 .find("/system/structure/map: leads away from Sphere(2, ") == 0u);

  const Json pushforward = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["a", "b"], "hamiltonian": "a^2 + b^2",
                "structure": { "type": "pushforward", "coordinates": ["x"],
                               "structure": "canonical", "map": ["2*x", "p_x/2"],
                               "section": ["a/2", "2*b"] } },
    "initial": { "a": 1, "b": 0 } })json");
  BOOST_TEST(problems(pushforward) == "");
  BOOST_TEST(problems(pushforward, "/system/structure/section/0", "a")
                 .find("/system/structure/section: is no section: ") == 0u);
  BOOST_TEST(problems(pushforward, "/system/structure/section", {"a/2", "2*b", 0})
                 .find("/system/structure/section: has 3 formulas; expected 2") == 0u);
  BOOST_TEST(problems(pushforward, "/system/structure/map/0", "a")
                 .find("/system/structure/map/0: column 1: unknown name \"a\"") == 0u);
  BOOST_TEST(problems_without(pushforward, "/system/structure", "section")
                 .find("/system/structure/section: ") == 0u);
}

BOOST_AUTO_TEST_CASE(refuses_expectations_that_cannot_be_met_or_missed) {
  const auto expecting = [](const Json& entry) {
    return problems(vortices, "/expect", Json::array({entry}));
  };
  BOOST_TEST(expecting({{"observable", "h"}, {"max_drift", 1}}) ==
             "/expect/0/observable: unknown observable or coordinate \"h\" (did you mean \"H\"?)");
  BOOST_TEST(expecting({{"observable", "H"}}).find("/expect/0: has no bound; expected") == 0u);
  BOOST_TEST(expecting({{"at", 0.5}, {"state", {{"H", 1}}}, {"tolerance", 1}})
                 .find("/expect/0/at: is 0.5; expected the time of a step, from 0 to 300 by 1") ==
             0u);
  BOOST_TEST(expecting({{"state", {{"H", "cos(t) + q"}}}, {"tolerance", 1}})
                 .find("/expect/0/state/H: column 10: unknown name") == 0u);
  BOOST_TEST(expecting({{"state", {{"H", 1}}}}) == "/expect/0/tolerance: is missing");
  BOOST_TEST(expecting({{"verdict", "regulr"}}).find("/expect/0/verdict: unknown") == 0u);
  BOOST_TEST(expecting({{"ladder", {{1, 2, 3}}}}).find("/expect/0/ladder: ") == 0u);
  BOOST_TEST(expecting(Json::object()).find("/expect/0: expects nothing") == 0u);
  BOOST_TEST(expecting({{"max_drft", 1}}).find("/expect/0/max_drft: unknown key") == 0u);
}

// d/dt of l cos(a) + t is -l sin(a) a' + 1, and of a definition made of it the same times a factor; also in later definitions.
BOOST_AUTO_TEST_CASE(definitions_have_time_derivatives) {
  const Experiment experiment = read_experiment(R"json({
    "system": { "type": "implicit", "coordinates": ["a", "b[2]"], "parameters": { "l": 2 },
      "definitions": { "ax": "l*cos(a) + t", "twice": "2*ax", "rate": "ax'^2", "both": ["a*b[0]", "b[1]^2"] },
      "equations": ["a' - 3", "b[0]' - 5", "b[1]' - rate"] },
    "initial": { "a": 0.4, "b": [1, 2] } })json");
  const SymbolTable symbols = experiment.model.symbols(
      ExprVector{{Expr(0.4), Expr(1.0), Expr(2.0)}}, ExprVector{{Expr(3.0), Expr(5.0), Expr(7.0)}},
      ExprVector(0), Expr(0.1));
  const auto value = [&](const char* formula) { return parse_formula(formula, symbols).value(); };
  const double rate = -2.0 * std::sin(0.4) * 3.0 + 1.0;
  BOOST_TEST(std::abs(value("ax'") - rate) < 1e-14);
  BOOST_TEST(std::abs(value("twice'") - 2.0 * rate) < 1e-14);
  BOOST_TEST(std::abs(value("rate") - rate * rate) < 1e-13);
  BOOST_TEST(std::abs(value("both[0]'") - (3.0 * 1.0 + 0.4 * 5.0)) < 1e-14);
  BOOST_TEST(std::abs(value("both[1]'") - 28.0) < 1e-14);
  // A velocity has no derivative here.
  BOOST_CHECK_THROW(value("rate'"), FormulaError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
