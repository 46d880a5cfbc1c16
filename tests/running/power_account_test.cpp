#include "courant/running/power_account.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "../reading/experiment_problems.hpp"
#include "courant/running/run_files.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * reactions count as ports (reading/energy_words.cpp)
//  * losses count as supply
//  * what a step does not balance at its stage is not seen
//  * the stage is that of the state (running/observer.cpp)
//  * a closed form of the balance is compared with the balance of the step before
//    (running/observer.cpp)
//  * the energies at an event are those of its part of the step alone
//    (running/observer_elsewhere.cpp)
//  * rows between two steps have no energies (running/trajectory_rows.cpp)
//  * observers are told of the stage of another step (running/runner.cpp)
BOOST_AUTO_TEST_SUITE(power_account_test)

using namespace courant;

namespace {

// A run and its rows.
struct RunIn {
  explicit RunIn(const Json& experiment)
      : outcome(run_in(folder, experiment)),
        rows(read_trajectory_csv(folder / "run" / "trajectory.csv")) {}
  std::vector<double> column(const std::string& name) const {
    const auto values = rows.column(name);
    return {values.begin(), values.end()};
  }
  bool has_column(const std::string& name) const { return rows.contains(name); }
  TemporaryFolder folder;
  RunOutcome outcome;
  TrajectoryTable rows;
};

// q' = p, p' = -q³ - c p + u with the force u = sin t at the port "hand".
Json driven(const Json& method) {
  return {
      {"system",
       {{"type", "port-hamiltonian"},
        {"parameters", {{"c", 0.5}}},
        {"coordinates", {"q", "p"}},
        {"J", {{0, 1}, {-1, 0}}},
        {"R", {{0, 0}, {0, "c"}}},
        {"B", {0, 1}},
        {"hamiltonian", "p^2/2 + q^4/4"},
        {"ports", "open"},
        {"port_names", {"hand"}},
        {"inputs", {"sin(t)"}}}},
      {"initial", {{"q", 1}, {"p", 0}}},
      {"method", method},
      {"time", {{"step", 0.1}, {"end", 5}}},
      {"observe",
       {{"u", {{"formula", "u_hand"}, {"at", "stage"}}},
        {"y", {{"formula", "y_hand"}, {"at", "stage"}}},
        {"p_stage", {{"formula", "p"}, {"at", "stage"}}},
        {"lost", {{"formula", "u_hand*y_hand - dot(effort, flow) - c*y_hand^2"}, {"at", "stage"}}},
        {"supplied_hand", "supplied_hand"},
        {"efficiency", "dissipated/(1 + supplied)"}}}};
}

}  // namespace

// Rows hold the energies since the beginning, the balance of the last step, and what ports and efforts were
// at its stage.
BOOST_AUTO_TEST_CASE(energies_and_stages_of_a_run) {
  for (const std::string method : {"discrete-gradient", "discretize-first"}) {
    const RunIn run(driven(method));
    BOOST_REQUIRE(run.outcome.status == RunStatus::completed);
    const auto column = [&](const std::string& name) { return run.column(name); };
    const auto t = column("t"), p = column("p"), H = column("H"), supplied = column("supplied"),
               dissipated = column("dissipated"), balance = column("balance"), u = column("u"),
               y = column("y"), p_stage = column("p_stage"), lost = column("lost"),
               efficiency = column("efficiency");
    BOOST_TEST((column("supplied_hand") == supplied));
    BOOST_TEST(supplied[0] == 0.0);
    BOOST_TEST(std::abs(u[0]) < 1e-15);  // of the first state: sin 0
    BOOST_TEST(std::abs(y[0] - p[0]) < 1e-15);
    double greatest = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const double h = t[k] - t[k - 1];
      BOOST_TEST(std::abs(u[k] - std::sin(t[k] - h / 2.0)) < 1e-13);
      BOOST_TEST(std::abs(p_stage[k] - (p[k] + p[k - 1]) / 2.0) < 1e-13);
      // (29): at the stage efforts and flows balance, whatever the method is.
      BOOST_TEST(std::abs(lost[k]) < 1e-12);
      const double in = supplied[k] - supplied[k - 1], out = dissipated[k] - dissipated[k - 1];
      BOOST_TEST(std::abs(in - h * u[k] * y[k]) < 1e-13);
      BOOST_TEST(std::abs(out - h * 0.5 * y[k] * y[k]) < 1e-13);
      BOOST_TEST(out >= 0.0);
      BOOST_TEST(std::abs(balance[k] - (H[k] - H[k - 1] - in + out)) < 1e-13);
      BOOST_TEST(std::abs(efficiency[k] - dissipated[k] / (1.0 + supplied[k])) < 1e-13);
      greatest = std::max(greatest, std::abs(balance[k]));
    }
    BOOST_REQUIRE(run.outcome.summary.power_balance.has_value());
    const PowerAccount::Report& account = *run.outcome.summary.power_balance;
    using Ports = std::vector<std::pair<std::string, double>>;
    BOOST_TEST((account.supplied == Ports{{"hand", supplied.back()}}));
    BOOST_TEST((account.dissipated == Ports{{"resistance", dissipated.back()}}));
    BOOST_TEST(account.stored == H.back() - H.front());
    BOOST_TEST(account.max_balance == greatest);
    const bool exact = method == "discrete-gradient";
    const double imbalance = account.max_imbalance;
    BOOST_TEST((exact ? imbalance < 1e-14 : imbalance > 1e-5), method << ": " << imbalance);
    if (exact) BOOST_TEST(imbalance >= 0.0);
    // (29) and (31), next to what moves: whatever the method is, and H.
    BOOST_TEST(account.max_stage_imbalance < 1e-14);
    BOOST_TEST(account.max_stage_imbalance > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(expectations_of_the_balance) {
  Json experiment = driven("discrete-gradient");
  experiment["expect"] = {{{"max_imbalance", 1e-13}}, {{"observable", "balance"}, {"max", 1e-13}}};
  BOOST_TEST(RunIn(experiment).outcome.as_expected());
  experiment["method"] = "discretize-first";
  BOOST_TEST(!RunIn(experiment).outcome.as_expected());
  experiment["expect"] = {{{"max_stage_imbalance", 1e-14}}};
  BOOST_TEST(RunIn(experiment).outcome.as_expected());
  experiment["expect"] = {{{"max_stage_imbalance", 1e-300}}};
  BOOST_TEST(!RunIn(experiment).outcome.as_expected());
  experiment["expect"] = {{{"max_imbalance", -1}}};
  BOOST_TEST(problems(experiment).find("/expect/0/max_imbalance: is -1") == 0u,
             problems(experiment));
  // Equations alone do not say what they supply.
  const Json implicit = {
      {"system", {{"type", "implicit"}, {"coordinates", {"x"}}, {"equations", {"x' + x"}}}},
      {"initial", {{"x", 1}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.1}, {"end", 1}}},
      {"expect", {{{"max_imbalance", 1.0}}}}};
  BOOST_TEST(problems(implicit).find("/expect/0/max_imbalance: tests nothing") == 0u,
             problems(implicit));
}

// An epoch changes nothing but what a method knows of the steps before, and where an event is found, the
// energies are those up to there.
BOOST_AUTO_TEST_CASE(epochs_and_events) {
  Json experiment = driven("discrete-gradient");
  experiment["observe"] = Json::object();
  experiment["events"] = {{"turn", "p - 0.1"}};
  const RunIn whole(experiment);
  experiment["output"]["epoch"] = 7;
  const RunIn parts(experiment);
  for (const char* name : {"supplied", "dissipated"})
    for (std::size_t k = 0; k < whole.column(name).size(); ++k)
      BOOST_TEST(std::abs(whole.column(name)[k] - parts.column(name)[k]) < 1e-12);
  BOOST_TEST(parts.outcome.summary.power_balance->max_imbalance < 1e-14);
  std::istringstream lines(read_text(whole.folder / "run" / "events.csv"));
  std::string line;
  std::getline(lines, line);
  BOOST_TEST(line.find("event,t,q,p,H,supplied,dissipated,balance") == 0u, line);
  int count = 0;
  const double H0 = whole.column("H")[0];
  for (; std::getline(lines, line); ++count) {
    std::istringstream words(line.substr(line.find(',') + 1));
    double t = 0, q = 0, p = 0, H = 0, supplied = 0, dissipated = 0, balance = 0;
    char comma = 0;
    words >> t >> comma >> q >> comma >> p >> comma >> H >> comma >> supplied >> comma >>
        dissipated >> comma >> balance;
    BOOST_TEST(dissipated > 0.0);
    BOOST_TEST(std::abs(H - H0 - supplied + dissipated) < 1e-13);
    BOOST_TEST(std::abs(balance) < 1e-14);
  }
  BOOST_TEST(count > 0);
}

// Rows between two steps have the energies up to there.
BOOST_AUTO_TEST_CASE(rows_at_times) {
  Json experiment = driven("discrete-gradient");
  experiment["observe"] = Json::object();
  experiment["output"]["at"] = {0, 0.02, 0.31, 0.35, 0.4, 4.97};
  const RunIn run(experiment);
  const auto H = run.column("H"), supplied = run.column("supplied"),
             dissipated = run.column("dissipated");
  BOOST_REQUIRE(H.size() >= 6u);
  for (std::size_t k = 1; k < H.size(); ++k) {
    BOOST_TEST(dissipated[k] > dissipated[k - 1]);
    BOOST_TEST(std::abs(H[k] - H[0] - supplied[k] + dissipated[k]) < 1e-13);
  }
}

// Names of one's own come first; wrong ones are told.
BOOST_AUTO_TEST_CASE(names) {
  Json experiment = driven("discrete-gradient");
  experiment["observe"] = {{"supplied", "q + p"}, {"balance", "q - p"}};
  const RunIn run(experiment);
  BOOST_TEST(run.column("supplied")[0] == 1.0);
  BOOST_TEST(run.column("balance").back() == run.column("q").back() - run.column("p").back());
  experiment["observe"] = {{"a", "supplied_foot"}};
  BOOST_TEST(problems(experiment).find("unknown name \"supplied_foot\"") != std::string::npos,
             problems(experiment));
  experiment["observe"] = {{"a", {{"formula", "supplied"}, {"at", "stage"}}}};
  BOOST_TEST(problems(experiment).find("unknown name \"supplied\"") != std::string::npos,
             problems(experiment));
  experiment["observe"] = {{"a", {{"formula", "q"}, {"at", "end"}}}};
  BOOST_TEST(problems(experiment).find("/observe/a/at: ") == 0u, problems(experiment));
  // Without a method there are no steps.
  experiment.erase("method");
  experiment.erase("time");
  experiment["observe"] = {{"a", "supplied"}};
  BOOST_TEST(problems(experiment).find("unknown name \"supplied\"") != std::string::npos,
             problems(experiment));
}

// A system without ports has no such columns, and the energy of each step is still accounted for.
BOOST_AUTO_TEST_CASE(closed_systems) {
  const Json pendulum = {
      {"system",
       {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "p_q^2/2 - cos(q)"}}},
      {"initial", {{"q", 1}, {"p_q", 0}}},
      {"method", {{"type", "discrete-gradient"}, {"gradient", "itoh-abe"}}},
      {"time", {{"step", 0.1}, {"end", 10}}},
      {"expect", {{{"max_imbalance", 1e-14}}, {{"observable", "H"}, {"max_drift", 1e-14}}}}};
  const RunIn run(pendulum);
  BOOST_TEST(run.outcome.as_expected());
  BOOST_TEST(!run.has_column("supplied"));
  BOOST_TEST(!run.has_column("balance"));
  BOOST_TEST(run.outcome.summary.power_balance.has_value());
}

// A unit current into H = q⁴/4: the midpoint rule has q = t, and H grows by h³(t - h/2)/4 more than it is
// supplied with in the step that ends at t. What is compared with that is the balance of this step.
BOOST_AUTO_TEST_CASE(a_closed_form_of_the_balance) {
  Json source = {
      {"system",
       {{"type", "port-hamiltonian"},
        {"coordinates", {"q"}},
        {"J", {{0}}},
        {"B", {1}},
        {"hamiltonian", "q^4/4"},
        {"ports", "open"},
        {"inputs", {"1"}}}},
      {"initial", {{"q", 0}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.1}, {"end", 2}}},
      {"expect", {{{"state", {{"balance", "0.00025*max(0, t - 0.05)"}}}, {"tolerance", 1e-14}}}}};
  const RunIn run(source);
  BOOST_TEST(run.column("balance").back() == 0.00025 * 1.95, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(run.outcome.as_expected());
  source["expect"][0]["state"]["balance"] = "0.00025*max(0, t - 0.15)";  // that of the step before
  BOOST_TEST(!RunIn(source).outcome.as_expected());
}

// Reactions of constraints alone are accounted for where something asks for them.
BOOST_AUTO_TEST_CASE(reactions) {
  Json particle = Json::parse(read_text("experiments/nonholonomic_particle.json"));
  particle.erase("expect");
  particle.erase("observe");
  particle["time"] = {{"step", 0.1}, {"end", 2}};
  const RunIn plain(particle);
  BOOST_TEST(!plain.has_column("supplied"));
  BOOST_TEST(!plain.outcome.summary.power_balance.has_value());
  particle["observe"] = {{"supplied", "supplied"}, {"work", "supplied_constraints"}};
  const RunIn asked(particle);
  BOOST_TEST(asked.outcome.summary.power_balance.has_value());
  BOOST_TEST((asked.column("supplied") == asked.column("work")));
  BOOST_TEST(std::abs(asked.column("work").back()) < 1e-13);
}

// A source that is not the one of the equations: the stage of a step knows.
BOOST_AUTO_TEST_CASE(a_step_that_is_not_solved_has_no_balance_at_its_stage) {
  const Experiment experiment = read_experiment(driven("discretize-first").dump());
  const auto system = std::dynamic_pointer_cast<const EnergySystem>(experiment.model.system);
  PowerAccount account((StepEnergies(system)));
  account.open(0.0);
  Step step;
  step.before = {
      .t = 0.0, .x = VectorXd{{1.0, 0.0}}, .v = VectorXd::Zero(2), .z = VectorXd::Zero(1)};
  step.after = step.before;
  step.after.t = 0.1;
  step.h = 0.1;
  // p' = -q³ - p/2 + u with q = 1, p = 2, u = 3 is 1; 1.5 is not.
  step.stage = {
      .t = 0.05, .x = VectorXd{{1.0, 2.0}}, .v = VectorXd{{2.0, 1.0}}, .z = VectorXd{{3.0}}};
  account.enter(step);
  account.settle(0.0);
  BOOST_TEST(account.stage_imbalance() < 1e-15);
  step.stage.v[1] = 1.5;
  account.enter(step);
  account.settle(0.0);
  // p (1.5 - 1) next to |q³ q'| + |p p'| + |u p| + p²/2
  BOOST_TEST(std::abs(account.stage_imbalance() - 1.0 / 13.0) < 1e-14);
}

// Every experiment with ports, that is, expects the balance of power at its stages.
BOOST_AUTO_TEST_CASE(all_experiments_with_ports_expect_the_balance) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("experiments")) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "schema.json") continue;
    const Json experiment = Json::parse(read_text(entry.path()));
    const Json& type = experiment.at("system").at("type");
    if (type != "port-hamiltonian" && type != "network" && type != "interconnection") continue;
    ++count;
    BOOST_TEST(std::ranges::any_of(experiment.at("expect"),
                                   [](const Json& entry) {
                                     return entry.value("max_stage_imbalance", 1.0) <= 1e-12;
                                   }),
               entry.path());
  }
  BOOST_TEST(count >= 30);
}

// What dampers take is dissipated, by a matrix, by a Rayleigh function and beside forces, which supply.
BOOST_AUTO_TEST_CASE(dampers_dissipate) {
  for (const Json& damping : {Json{0.3}, Json("0.15*x'^2")}) {
    Json oscillator = {{"system",
                        {{"type", "mechanical"},
                         {"coordinates", {"x"}},
                         {"metric", {2.0}},
                         {"potential", "x^2"},
                         {"damping", damping}}},
                       {"initial", {{"x", 1}, {"x'", 0}}},
                       {"method", "constrain-first"},
                       {"time", {{"step", 0.01}, {"end", 3}}}};
    const auto account = [&] {
      const TemporaryFolder folder;
      const RunOutcome outcome = run_in(folder, oscillator);
      BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
      return *outcome.summary.power_balance;
    };
    const auto alone = account();
    BOOST_TEST(alone.supplied.empty());
    BOOST_REQUIRE(alone.dissipated.size() == 1u);
    BOOST_TEST(alone.dissipated[0].first == "damping");
    // x = e^{-γt}(cos ωt + γ/ω sin ωt), γ = 0.075, ω² = 1 - γ²
    const double g = 0.075, w = std::sqrt(1.0 - g * g), decay = std::exp(-3.0 * g);
    const double x = decay * (std::cos(3.0 * w) + g / w * std::sin(3.0 * w)),
                 v = -decay / w * std::sin(3.0 * w);
    BOOST_TEST(std::abs(alone.dissipated[0].second - (1.0 - x * x - v * v)) < 1e-4);
    oscillator["system"]["forces"] = {{"x", "0.2*cos(t)"}};
    const auto driven = account();
    BOOST_REQUIRE(driven.supplied.size() == 1u);
    BOOST_TEST(driven.supplied[0].first == "forces");
    BOOST_TEST(std::abs(driven.stored - driven.supplied[0].second + driven.dissipated[0].second) <
               1e-4);
    BOOST_TEST(driven.dissipated[0].second > 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
