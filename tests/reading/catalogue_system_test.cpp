#include "courant/reading/catalogue_system.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/reading/json_document.hpp"
#include "courant/reading/new_experiment.hpp"
#include "experiment_problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * values that an experiment gives to a ready-made system are not used
//  * a negative mass is taken
//  * problems of parameters are told at a place that the experiment does not have
BOOST_AUTO_TEST_SUITE(catalogue_system_test)

namespace {

const KindDescription& entry(const std::string& type) {
  for (const CatalogueSystem& one : catalogue_systems())
    if (one.description().type == type) return one.description();
  throw std::logic_error("no " + type);
}

// An experiment with this system and what else it needs.
Json with_system(const Json& system) {
  Json experiment = entry(system.at("type")).example;
  experiment["system"] = system;
  experiment.erase("expect");
  return experiment;
}

Json duffing(const Json& changes) {
  Json system = {{"type", "duffing"}};
  if (!changes.empty()) system.update(changes);
  return with_system(system);
}

std::shared_ptr<const ImplicitSystem> system_of(const Json& experiment) {
  return read_experiment(experiment.dump()).model.system;
}

double largest_difference(const ImplicitSystem& one, const ImplicitSystem& other) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return VectorXd::NullaryExpr(size, [&] { return normal(generator); }).eval();
  };
  double largest = 0.0;
  for (int trial = 0; trial < 5; ++trial) {
    const VectorXd x = one.manifold()->random_point(generator);
    const VectorXd v = random(one.manifold()->tangent_dimension()),
                   z = random(one.auxiliary_size());
    largest = std::max(
        largest, (one.residual(x, v, z, 0.3) - other.residual(x, v, z, 0.3)).cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace

// Every file: a line on each parameter, where it is from, a result that it expects; and in formulas
// it is the same system.
BOOST_AUTO_TEST_CASE(all_are_complete) {
  BOOST_TEST(catalogue_systems().size() >= 30u);
  for (const CatalogueSystem& one : catalogue_systems()) {
    const KindDescription& kind = one.description();
    BOOST_TEST(kind.reference.size() > 10u, kind.type);
    BOOST_TEST(kind.example.at("expect").size() >= 2u, kind.type);
    for (const Key& key : kind.keys) BOOST_TEST(!key.summary.empty(), kind.type << ' ' << key.name);
    const auto system = system_of(parse_json(new_experiment(kind.type)));
    const auto formulas = system_of(parse_json(new_experiment(kind.type, true)));
    BOOST_TEST(system->names().coordinates == formulas->names().coordinates);
    BOOST_TEST(largest_difference(*system, *formulas) == 0.0, kind.type);
  }
}

// What is given is used, a formula of other parameters too; what is not given is by default.
BOOST_AUTO_TEST_CASE(parameters_are_keys) {
  const auto in_formulas = [](double m, double a, double b) {
    return system_of({{"system",
                       {{"type", "hamiltonian"},
                        {"coordinates", {"q"}},
                        {"parameters", {{"m", m}, {"a", a}, {"b", b}}},
                        {"hamiltonian", "p_q^2/(2*m) + a*q^2/2 + b*q^4/4"}}},
                      {"initial", {{"q", 1}, {"p_q", 0}}}});
  };
  BOOST_TEST(largest_difference(*system_of(duffing({})), *in_formulas(1, 1, 1)) == 0.0);
  BOOST_TEST(largest_difference(*system_of(duffing({{"m", 2}, {"b", "3*m"}})),
                                *in_formulas(2, 1, 6)) == 0.0);
  BOOST_TEST(largest_difference(*system_of(duffing({{"m", 2}})), *in_formulas(1, 1, 1)) > 0.1);
  // Sizes as well.
  BOOST_TEST(
      system_of(with_system({{"type", "toda-lattice"}, {"n", 3}}))->manifold()->dimension() == 6);
  const Experiment read = read_experiment(duffing({{"m", 2}}).dump());
  BOOST_TEST(read.model.description.starts_with("duffing: "));
}

// The document with defaults says what all parameters are, and can be read again.
BOOST_AUTO_TEST_CASE(defaults_are_filled_in) {
  const Json completed = read_experiment(duffing({{"m", 2}}).dump()).document;
  BOOST_TEST(completed["system"]["m"] == 2);
  BOOST_TEST(completed["system"]["b"] == 1);
  BOOST_TEST(!completed["system"].contains("manifold"));
  BOOST_TEST(problems(completed) == "");
}

// Names of one's own, made of those of the system.
BOOST_AUTO_TEST_CASE(parameters_and_definitions_are_added) {
  Json experiment =
      duffing({{"parameters", {{"A", "2*sqrt(a/b)"}}}, {"definitions", {{"speed", "p_q/m"}}}});
  experiment["observe"] = {{"twice", "2*speed + A"}};
  BOOST_TEST(problems(experiment) == "");
  BOOST_TEST(problems(duffing({{"parameters", {{"b", 3}}}})) ==
             "/system/parameters/b: is a parameter of the system; expected it as a key beside "
             "\"type\"");
}

// Problems are said at places that the experiment has.
BOOST_AUTO_TEST_CASE(what_is_wrong_is_said_at_its_key) {
  BOOST_TEST(problems(duffing({{"m", -2}})) == "/system/m: is -2; expected more than 0");
  BOOST_TEST(
      problems(duffing({{"m", "b*c"}})).starts_with("/system/m: column 1: unknown name \"b\""),
      problems(duffing({{"m", "b*c"}})));
  BOOST_TEST(problems(duffing({{"mass", 1}})).starts_with("/system/mass: unknown key"),
             problems(duffing({{"mass", 1}})));
  BOOST_TEST(problems(with_system({{"type", "double-pendulum"}, {"l", {1, 0}}})) ==
             "/system/l: is 0; expected more than 0");
  // A value of another size than formulas need.
  const std::string size = problems(with_system({{"type", "double-pendulum"}, {"l", 1}}));
  BOOST_TEST(size.starts_with("/system: with these values /lagrangian of the system in formulas "),
             size);
}

BOOST_AUTO_TEST_CASE(a_text_that_is_none_is_refused) {
  BOOST_CHECK_THROW(CatalogueSystem("one", "{"), std::invalid_argument);
  BOOST_CHECK_THROW(CatalogueSystem("one", "{\"summary\": \"\"}"), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
