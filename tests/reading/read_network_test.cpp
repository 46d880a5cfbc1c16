#include <boost/test/unit_test.hpp>
#include <map>
#include <random>

#include "courant/reading/experiment.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/network.hpp"
#include "experiment_problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(read_network_test)

namespace {

Json network(const Json& nodes, const char* elements) {
  return {{"system", {{"type", "network"}, {"nodes", nodes}, {"elements", Json::parse(elements)}}},
          {"initial", Json::object()}};
}

void refused(const Json& nodes, const char* elements, const std::string& expected) {
  const std::string found = problems(network(nodes, elements));
  BOOST_TEST(found.find(expected) != std::string::npos,
             "expected " << expected << "\nfound " << found);
}

// A number named `name` at x, v, z, t.
double quantity(const Model& model, const char* name, const VectorXd& x, const VectorXd& v,
                const VectorXd& z, double t) {
  return model.symbols(constants(x), constants(v), constants(z), Expr(t))
      .find(name)
      ->values[0]
      .value();
}

}  // namespace

BOOST_AUTO_TEST_CASE(wrong_networks_are_refused_in_their_own_words) {
  refused({"0", "a"}, R"([{"type":"voltage-source","name":"V1","from":"a","to":"0","value":1},
                          {"type":"capacitor","name":"C1","from":"a","to":"0","value":1},
                          {"type":"voltage-source","name":"V2","from":"a","to":"0","value":2}])",
          "/system/elements/2: voltage sources V1 and V2 form a loop");
  refused({"0", "a"}, R"([{"type":"voltage-source","name":"V1","from":"a","to":"a","value":1},
                          {"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])",
          "/system/elements/0: the voltage source V1 is shorted: both its ends are at the node "
          "\"a\"");
  refused({"0", "a", "b"},
          R"([{"type":"current-source","name":"I1","from":"a","to":"0","value":1},
              {"type":"current-source","name":"I2","from":"b","to":"0","value":1},
              {"type":"capacitor","name":"C1","from":"a","to":"b","value":1}])",
          "/system/elements/1: current sources I1 and I2 form a cut-set: there is no other way");
  refused({"0", "a", "b"},
          R"([{"type":"current-source","name":"I1","from":"a","to":"b","value":1},
              {"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])",
          "/system/elements/0: current source I1 forms a cut-set: there is no other way for its "
          "current");
  refused({"0", "a", "b"}, R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])",
          "/system/nodes/2: the node \"b\" floats: no element is connected to it");
  refused({"0", "a", "b", "c"},
          R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1},
              {"type":"resistor","name":"R1","from":"b","to":"c","value":1}])",
          "/system/nodes/2: the nodes \"b\" and \"c\" float: no element leads from there to the "
          "ground \"0\"");
  refused({"0", "a"}, R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1},
                          {"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])",
          "/system/elements/1/name: two elements have the name \"C1\", the other is "
          "/system/elements/0");
  refused({"0", "out"}, R"([{"type":"capacitor","name":"C1","from":"uot","to":"0","value":1}])",
          "/system/elements/0/from: unknown node \"uot\" (did you mean \"out\"?)");
  refused({"0", "a"}, R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1},
                          {"type":"mass","name":"M1","at":"a","value":1}])",
          "/system/elements/1/at: the node \"a\" is electrical for C1 and translational for M1");
  refused({"0", "a", "a"}, R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])",
          "/system/nodes/2: is \"a\" again");
  refused({"0", "a"}, R"([{"type":"resistor","name":"R1","from":"a","to":"0","value":1}])",
          "/system/elements: nothing stores energy");
}

BOOST_AUTO_TEST_CASE(wrong_elements_are_refused) {
  const auto one = [](const std::string& keys) {
    return R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1},)"
           R"({"from":"a","to":"0",)" +
           keys + "}]";
  };
  const auto wrong = [&](const std::string& keys, const std::string& expected) {
    refused({"0", "a"}, one(keys).c_str(), expected);
  };
  wrong(R"("type":"resistor","name":"R1")",
        R"(/system/elements/1: has no law; expected "value", "voltage" or "current")");
  wrong(R"("type":"dc-motor","name":"M1")", "/system/elements/1/constant: is missing");
  wrong(R"("type":"current-source","name":"I1")", "/system/elements/1/value: is missing");
  wrong(R"("type":"capacitor","name":"C2")",
        R"(/system/elements/1: has no law; expected "value", "energy" or "voltage")");
  wrong(R"("type":"capacitor","name":"C2","value":1,"energy":"q_C2^2")",
        R"(/system/elements/1: has 2 laws; expected only one of "value", "energy" or "voltage")");
  wrong(R"("type":"capacitor","name":"C2","value":-1)",
        "/system/elements/1/value: is -1; expected a number greater than 0");
  for (const char* ratio : {"0", R"("1-1")"})
    wrong(
        std::string(R"("type":"ideal-transformer","name":"T1","secondary":["a","0"],"ratio":)") +
            ratio,
        std::string("/system/elements/1/ratio: is ") + ratio + "; expected a number other than 0");
  wrong(R"("type":"ideal-transformer","name":"T1","secondary":["a"],"ratio":1)",
        "/system/elements/1/secondary: has 1 entry; expected two names");
  wrong(R"("type":"resistor","name":"R 1","value":1)", R"(/system/elements/1/name: is "R 1")");
  wrong(R"("type":"resistor","name":"R1","value":"1+v_C2")",
        R"(/system/elements/1/value: column 3: unknown name "v_C2")");
  wrong(R"("type":"port","name":"P","input":"volt")", R"(/system/elements/1/input: is "volt")");
  wrong(R"("type":"port","name":"P")", "/system/elements/1/input: is missing");
  wrong(R"("type":"voltage-source","name":"E1","value":"2*v_E1")",
        "/system/elements/1: the law of E1 needs its own result");
  wrong(R"("type":"capacitor","name":"C2","energy":"q_C2*v_C1")",
        R"(/system/elements/1/energy: column 6: unknown name "v_C1")");
  wrong(R"("type":"mutual-inductance","name":"K1","inductors":["L1","L2"],"coupling":0.5)",
        "unknown key");
  refused({"0", "a"},
          R"([{"type":"inductor","name":"L1","from":"a","to":"0","value":1},
              {"type":"inductor","name":"L2","from":"a","to":"0","value":4},
              {"type":"mutual-inductance","name":"K1","inductors":["L1","L2"],"value":2}])",
          "/system/elements/2: couples the inductors L1 and L2 too closely");
  refused({"0", "a"},
          R"([{"type":"inductor","name":"L1","from":"a","to":"0","value":1},
              {"type":"mutual-inductance","name":"K1","inductors":["L1","L3"],"value":2}])",
          R"(/system/elements/1/inductors: "L3" is no inductor)");
  Json taken =
      network({"0", "a"}, R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":1}])");
  taken["system"]["parameters"] = {{"v_C1", 1}};
  BOOST_TEST(problems(taken).find("/system/elements/0: needs the name \"v_C1\"") == 0u,
             problems(taken));
}

// Laws see parameters, definitions, t, states, currents, voltages and potentials; definitions and
// observables too.
BOOST_AUTO_TEST_CASE(words_of_laws_and_observables) {
  Json experiment = network({"0", "a", "b"},
                            R"([{"type":"capacitor","name":"C1","from":"a","to":"0","value":"C"},
        {"type":"resistor","name":"R1","from":"a","to":"b","value":"1 + q_C1^2"},
        {"type":"voltage-source","name":"E1","from":"b","to":"0","value":"gain*potential_a*w"}])");
  experiment["system"]["parameters"] = {{"C", 0.5}, {"gain", -3}};
  experiment["system"]["definitions"] = {{"w", "1 + t"}, {"loss", "v_R1*i_R1"}};
  experiment["initial"] = {{"q_C1", 0.2}};
  experiment["observe"] = {{"i_R1", "i_R1"}, {"loss", "loss"}, {"twice", "2*potential_b"}};
  const Experiment read = read_experiment(experiment.dump());
  const Model& model = read.model;
  const double q = 0.2, t = 1.0, a = q / 0.5, b = -3.0 * a * 2.0, i = (a - b) / (1.0 + q * q);
  // Unknowns: i_R1, i_E1, and the potential that a law depends on.
  BOOST_TEST(
      (model.system->names().auxiliary == std::vector<std::string>{"i_R1", "i_E1", "potential_a"}));
  const VectorXd x = VectorXd{{q}}, v = VectorXd{{-i}}, z = VectorXd{{i, i, a}};
  BOOST_TEST(model.system->residual(x, v, z, t).norm() < 1e-13);
  BOOST_TEST(std::abs(quantity(model, "v_R1", x, v, z, t) - (a - b)) < 1e-13);
  BOOST_TEST(std::abs(quantity(model, "potential_b", x, v, z, t) - b) < 1e-13);
  BOOST_TEST(std::abs(quantity(model, "loss", x, v, z, t) - (a - b) * i) < 1e-13);
  BOOST_TEST(read.observe.size() == 3u);
}

// Nonlinear storage by its energy, or by its law, which is the derivative of the energy.
BOOST_AUTO_TEST_CASE(energies_and_laws_of_charges) {
  for (const char* law : {R"("energy":"q_C1^2/2 + q_C1^4")", R"("voltage":"q_C1 + 4*q_C1^3")"}) {
    const std::string elements =
        std::string(R"([{"type":"capacitor","name":"C1","from":"a","to":"0",)") + law +
        R"(}, {"type":"resistor","name":"R1","from":"a","to":"0","value":1}])";
    Json experiment = network({"0", "a"}, elements.c_str());
    experiment["initial"] = {{"q_C1", 1}};
    const Model model = read_experiment(experiment.dump()).model;
    const VectorXd x = VectorXd{{0.7}}, none = VectorXd{{0.0}};
    BOOST_TEST(std::abs(quantity(model, "v_C1", x, none, none, 0.0) - (0.7 + 4 * 0.343)) < 1e-14);
    const Expr H = *model.system->energy(constants(x), constants(none), Expr(0.0));
    BOOST_TEST(std::abs(H.value() - (0.245 + 0.2401)) < 1e-14);
  }
}

// Every kind of element at some state: the powers of couplers cancel, and dH/dt is what the sources
// supply less what the resistors take, for states and unknowns that need obey no law.
BOOST_AUTO_TEST_CASE(powers_of_elements) {
  const Json nodes = {"0", "a", "b", "c", "shaft", "wheel", "cone", "tank", "hot", "cold"};
  const Json experiment = network(nodes, R"json([
    {"type":"voltage-source","name":"V1","from":"a","to":"0","value":"cos(t)"
},
    {"type":"resistor","name":"R1","from":"a","to":"b","value":2,"heat":"hot"},
    {"type":"inductor","name":"L1","from":"b","to":"0","value":2},
    {"type":"inductor","name":"L2","from":"c","to":"0","value":3},
    {"type":"mutual-inductance","name":"K1","inductors":["L1","L2"],"coupling":0.5},
    {"type":"ideal-transformer","name":"T1","from":"a","to":"b","secondary":["c","0"],"ratio":3},
    {"type":"gyrator","name":"G1","from":"a","to":"0","secondary":["b","c"],"value":2},
    {"type":"dc-motor","name":"M1","from":"c","to":"0","shaft":"shaft","constant":0.3},
    {"type":"voice-coil","name":"B1","from":"b","to":"0","cone":"cone","constant":0.7},
    {"type":"gear","name":"Z1","from":"shaft","to":"wheel","ratio":5},
    {"type":"inertia","name":"J1","at":"wheel","value":2},
    {"type":"mass","name":"m1","at":"cone","value":2},
    {"type":"electromagnet","name":"X1","from":"a","to":"0","armature":"cone",
     "inductance":"1/(1+x_X1^2)"},
    {"type":"thermal-conductor","name":"W1","from":"hot","to":"cold","value":2},
    {"type":"heat-capacity","name":"H1","at":"hot","value":2},
    {"type":"heat-capacity","name":"H2","at":"cold","value":3},
    {"type":"tank","name":"A1","at":"tank","area":2},
    {"type":"pipe","name":"P1","from":"tank","to":"0","flow":"P_P1^3"}])json");
  Findings findings;
  const Json system = experiment.at("system");
  const auto model = system_kinds().read(JsonReader(system, "/system", findings));
  findings.require_clean();
  const auto& network = dynamic_cast<const Network&>(*model->system);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  const auto random = [&](Index n) {
    return VectorXd::NullaryExpr(n, [&] { return uniform(generator); }).eval();
  };
  const VectorXd x = random(network.manifold()->ambient_dimension());
  const Network::Ports ports =
      network.ports(constants(x), constants(random(x.size())),
                    network.effort(constants(x), ExprVector(0), Expr(0.3)),
                    constants(random(network.auxiliary_size())), Expr(0.3));
  std::map<std::string, double> coupled;
  for (std::size_t k = 0; k < network.branches().size(); ++k) {
    const NetworkBranch& branch = network.branches()[k];
    const auto index = static_cast<Index>(k);
    const double power = (ports.current[index] * ports.voltage[index]).value();
    if (branch.role == NetworkBranch::Role::coupler) coupled[branch.name.substr(0, 2)] += power;
  }
  BOOST_TEST(coupled.size() == 7u);
  for (const auto& [name, power] : coupled)
    BOOST_TEST(std::abs(power) < 1e-12, name << " gives the power " << power);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
