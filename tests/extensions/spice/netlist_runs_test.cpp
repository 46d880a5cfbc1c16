#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "courant/extensions/spice/netlist.hpp"
#include "courant/tests/running/run_in.hpp"
#include "courant/tests/running/waveforms.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(netlists_against_ngspice)

namespace {

// The netlist with accurate steps and with what makes ngspice write potentials to a file.
std::string for_ngspice(std::string netlist, const std::vector<std::string>& nodes,
                        const std::string& output, const std::string& options) {
  std::string control = ".options " + options +
                        "\n.control\n"
                        "set wr_singlescale\nset wr_vecnames\nset numdgt=12\nrun\nwrdata " +
                        output;
  for (const std::string& node : nodes) control += " v(" + node + ")";
  // The greatest step, after the start: that of the netlist.
  const std::size_t tran = netlist.find(".tran"), end = netlist.find('\n', tran);
  std::istringstream words(netlist.substr(tran, end - tran));
  std::string dot, step, stop, uic;
  words >> dot >> step >> stop >> uic;
  netlist.replace(tran, end - tran, ".tran " + step + " " + stop + " 0 " + step + " " + uic);
  netlist.replace(netlist.find(".end\n"), 5, control + "\nquit\n.endc\n.end\n");
  return netlist;
}

const std::string accurate = "reltol=1e-6 abstol=1e-15 vntol=1e-9 chgtol=1e-18";

// The rows of a run and those of ngspice.
struct Comparison {
  Waveforms ours, theirs;
  std::vector<std::string> nodes;  // columns 1, 2, … of theirs
  Json experiment;
  bool completed = false;
  double stage_imbalance = 0.0, step = 0.0;
  std::vector<std::string> warnings;

  explicit Comparison(const std::string& name, const std::string& options = accurate) {
    const std::string netlist = read_text("tests/corpus/netlists/" + name + ".cir");
    experiment = import_netlist(netlist);
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
    completed = true;
    stage_imbalance = outcome.summary.power_balance->max_stage_imbalance;
    step =
        experiment.at("time").at("end").get<double>() / static_cast<double>(outcome.summary.steps);
    warnings = outcome.summary.warnings;
    ours = read_table(folder / "run/trajectory.csv", ',');
    for (const auto& [key, formula] : experiment.at("observe").items())
      if (key.rfind("potential_", 0) == 0 && key.find("x1_") == std::string::npos)
        nodes.push_back(key.substr(10));
    write_text(folder / "circuit.cir",
               for_ngspice(netlist, nodes, (folder / "potentials.txt").string(), options));
    BOOST_REQUIRE(
        std::system(
            ("ngspice -b " + (folder / "circuit.cir").string() + " > /dev/null 2>&1").c_str()) >=
        0);
    theirs = read_table(folder / "potentials.txt", ' ');
    BOOST_REQUIRE(theirs.rows.size() > 100u);
    BOOST_REQUIRE(theirs.rows.back()[0] > 0.999 * ours.rows.back()[0]);
  }

  // |ours - theirs| of each row, next to the largest potential of the circuit.
  std::vector<double> differences(const std::string& node) const {
    double largest = 0.0;
    for (const std::string& any : nodes)
      for (const auto& row : theirs.rows)
        largest = std::max(largest, std::abs(row[number(any) + 1]));
    std::vector<double> result;
    for (const auto& row : ours.rows)
      result.push_back(
          std::abs(row[ours.column("potential_" + node)] - theirs.at(row[0], number(node) + 1)) /
          largest);
    return result;
  }

 private:
  std::size_t number(const std::string& node) const {
    return static_cast<std::size_t>(std::ranges::find(nodes, node) - nodes.begin());
  }
};

}  // namespace

// Every potential within 1e-3 of the largest one of the circuit. No energy is lost but round-off; with damping
// less than 1e-5 of it.
BOOST_AUTO_TEST_CASE(waveforms_of_netlists) {
  if (std::system("command -v ngspice > /dev/null") != 0) {
    BOOST_TEST_MESSAGE("ngspice is not installed");
    return;
  }
  for (const char* name :
       {"rc_pulse", "rlc_uic", "rectifier", "transformer", "amplifier", "bridge", "doubler",
        "cockcroft", "peak_detector", "pulse_corner",
        // Which begin at an operating point, or with potentials of .ic.
        "zener", "supply", "phase_shift", "whole_coupling",
        // An oscillator with a controlled source, a filter of order 7, two tanks.
        "wien_bridge", "butterworth", "coupled_tanks"})
    BOOST_TEST_CONTEXT(name) {
      const Comparison comparison(name);
      double energy_there = 0.0, imbalance = 0.0;
      const Waveforms& ours = comparison.ours;
      for (const auto& row : ours.rows) {
        for (const char* energy : {"supplied", "H"})
          energy_there = std::max(energy_there, std::abs(row[ours.column(energy)]));
        imbalance = std::max(imbalance, std::abs(row[ours.column("balance")]));
      }
      const bool is_damped = comparison.experiment["method"].contains("damping");
      BOOST_TEST(imbalance <= (is_damped ? 1e-5 : 1e-8) * energy_there);
      BOOST_TEST(comparison.stage_imbalance <
                 (std::string_view(name) == "amplifier" ? 2e-12 : 1e-12));
      for (const std::string& node : comparison.nodes)
        BOOST_TEST(std::ranges::max(comparison.differences(node)) < 1e-3, node);
    }
}

// Circuits that simulators find hard: diodes with nothing but themselves in their way, in series, in front of
// coils whose currents end, at transformers with no ground of their own. ngspice needs other tolerances for
// some of them: with those above it ends early. Where a current ends a potential jumps, in a row or two. What
// is stored, supplied and lost is balanced at the stages of all steps.
BOOST_AUTO_TEST_CASE(hard_netlists) {
  if (std::system("command -v ngspice > /dev/null") != 0) {
    BOOST_TEST_MESSAGE("ngspice is not installed");
    return;
  }
  const std::string plain = "reltol=1e-5";
  struct Hard {
    std::string name, options;
    std::vector<std::string> nodes;
    double rows = 1.0;  // so many of them are as near
  };
  const std::vector<Hard> all = {
      {"resistive_clipper", accurate, {"a"}},
      {"series_diodes", accurate, {"a", "b"}},
      {"bridge_stiff", accurate, {"a", "b", "p"}},
      {"three_phase", "reltol=1e-4 abstol=1e-9 rshunt=1e12", {"a1", "b1", "c1", "p", "m"}},
      {"transformer_bridge", plain, {"a", "p", "m", "s1", "s2"}},
      {"halfwave_coil", plain, {"c"}},
      {"halfwave_coil", plain, {"b"}, 0.99},
      {"center_tap", plain, {"a", "o"}},
      {"buck_dcm", accurate, {"out"}},
      {"buck_dcm", accurate, {"sw"}, 0.99},
      {"buck_resistive", plain, {"x", "out"}},
      {"coil_to_diode", accurate, {"sw", "out"}},
      {"quiet_diode", accurate, {"a"}},
  };
  for (const Hard& hard : all) BOOST_TEST_CONTEXT(hard.name) {
      const Comparison comparison(hard.name, hard.options);
      // Tens of amperes through exponentials leave more. The energy that moves in a step shrinks with it, round-off of
      // fluxes does not: of center_tap steps of 20, 10 and 5 µs leave 1.3, 2.8 and 5.4e-12.
      BOOST_TEST(comparison.stage_imbalance < (hard.name == "three_phase" ? 5e-12
                                               : hard.name == "center_tap"
                                                   ? 2e-12 * (2e-5 / comparison.step)
                                                   : 1e-12));
      // The edge of a pulse is no finding.
      BOOST_TEST(comparison.warnings.empty());
      for (const std::string& node : hard.nodes) {
        std::vector<double> differences = comparison.differences(node);
        std::ranges::sort(differences);
        const auto last =
            static_cast<std::size_t>(hard.rows * static_cast<double>(differences.size() - 1));
        BOOST_TEST(differences[last] < 1e-3, node);
      }
    }
}

// Transistors take what they are supplied with, and store no more: at the stages of all steps to round-off.
BOOST_AUTO_TEST_CASE(transistors_balance_their_power) {
  for (const char* name : {"common_emitter", "rtl_inverter", "push_pull"})
    BOOST_TEST_CONTEXT(name) {
      const TemporaryFolder folder;
      const RunOutcome outcome = run_in(
          folder,
          import_netlist(read_text("tests/corpus/transistors/" + std::string(name) + ".cir")));
      BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
      // Newton's method ends where voltages of several junctions in a row are right to 10⁻¹² or so.
      BOOST_TEST(outcome.summary.power_balance->max_stage_imbalance <
                 (std::string_view(name) == "rtl_inverter" ? 1e-12 : 5e-11));
    }
}

// The first number of .tran says how often to print: a pulse of 1 ns, printed each 10 ns. L i' = v_a - v_b, C v_b' = i + (v_a - v_b)/R in
// steps of 1 ps by Runge and Kutta.
BOOST_AUTO_TEST_CASE(steps_follow_the_waveform_and_not_the_rows) {
  const Json experiment = import_netlist(
      "t\nV1 a 0 PULSE(0 1 0 1n 1n 1n 2)\nL1 a b 20n\nR1 a b 250\nC1 b 0 600p\n.tran 10n 1u uic\n");
  const TemporaryFolder folder;
  BOOST_TEST_REQUIRE((run_in(folder, experiment).status == RunStatus::completed));
  const Waveforms ours = read_table(folder / "run/trajectory.csv", ',');
  BOOST_TEST(ours.rows.size() == 101u);
  const auto source = [](double t) {
    return std::max(0.0, std::min({t / 1e-9, 1.0, (3e-9 - t) / 1e-9}));
  };
  constexpr double h = 1e-12;
  double i = 0.0, v = 0.0;
  const std::size_t column = ours.column("potential_b");
  for (std::size_t row = 1, step = 0; row < 30; ++row) {
    for (; static_cast<double>(step) * h < ours.rows[row][0] - h / 2; ++step) {
      const double t = static_cast<double>(step) * h;
      const auto rate = [&](double at, double i_at, double v_at) {
        const double over = source(at) - v_at;
        return std::pair(over / 20e-9, (i_at + over / 250.0) / 600e-12);
      };
      const auto [a, b] = rate(t, i, v);
      const auto [c, d] = rate(t + h / 2, i + h / 2 * a, v + h / 2 * b);
      const auto [e, f] = rate(t + h / 2, i + h / 2 * c, v + h / 2 * d);
      const auto [g, k] = rate(t + h, i + h * e, v + h * f);
      i += h / 6 * (a + 2 * c + 2 * e + g);
      v += h / 6 * (b + 2 * d + 2 * f + k);
    }
    BOOST_TEST(std::abs(ours.rows[row][column] - v) < 2e-3, ours.rows[row][0]);
  }
}

// Coils of one core, or nearly one, have voltages like their windings, √(L₂/L₁), in every row.
BOOST_AUTO_TEST_CASE(voltages_of_coils_are_like_their_windings) {
  const Json stiff = import_netlist(
      "t\nV1 a 0 PULSE(-8 8 0 1u 1u 399u 800u)\nR1 a p 1.5\nL1 p 0 80m\nL2 s 0 320m\nR2 s 0 10\n"
      "K1 L1 L2 0.999999\n.tran 10u 8m\n");
  const Json three = import_netlist(
      "t\nV1 a 0 SIN(0 12 60)\nR1 a p 1\nL1 p 0 90m\nL2 s 0 360m\nL3 u 0 22.5m\nR2 s 0 9\nR3 u 0 "
      "4\n"
      "K12 L1 L2 1\nK13 L1 L3 1\nK23 L2 L3 1\n.tran 0.1m 50m\n");
  for (const Json& experiment : {stiff, three}) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
    BOOST_TEST(outcome.summary.warnings.empty());
    const Waveforms table = read_table(folder / "run/trajectory.csv", ',');
    long far = 0;
    for (const auto& row : table.rows) {
      const double p = row[table.column("potential_p")], s = row[table.column("potential_s")];
      far += std::abs(s - 2.0 * p) > 5e-3 ? 1 : 0;
      if (experiment == three)
        BOOST_TEST(std::abs(row[table.column("potential_u")] - p / 2.0) < 1e-9);
    }
    BOOST_TEST(far <= (experiment == stiff ? 21 : 0));  // at edges the leakage takes 2 μs
  }
}

// Two transistors as diodes, one behind the other, that block: what diffuses into them is a charge, and nothing else is. Below -0.9 V
// it says nothing of the voltage but by the leak, and a velocity needs that.
BOOST_AUTO_TEST_CASE(transistors_as_diodes_that_block) {
  const Json experiment = import_netlist(
      "t\nV1 a 0 SIN(0 2 1k)\nR1 a b 1k\nQ1 b b c q\nQ2 c c 0 q\n"
      ".model q npn(is=1e-14 bf=100 tf=1n)\n.tran 10u 2m\n.end\n");
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), outcome.message);
  const Waveforms table = read_table(folder / "run/trajectory.csv", ',');
  // Each has a half of what is there; in the forward half of the period i = (v_a - v_b)/R with v_b = 2 s log(i/(I_s (1 + 1/100))).
  for (const auto& row : table.rows) {
    const double a = row[table.column("potential_a")], b = row[table.column("potential_b")],
                 c = row[table.column("potential_c")];
    BOOST_TEST(std::abs(c - b / 2.0) < 1e-3, row[0]);
    if (a < -0.1) BOOST_TEST(std::abs(b - a) < 1e-6, row[0]);
    if (a > 1.5)
      BOOST_TEST(std::abs(b - 2.0 * 0.02586492 * std::log((a - b) / 1e3 / 1.01e-14)) < 1e-3,
                 row[0]);
  }
}

// A choke between two diodes. Where its current ends, the potential behind the diodes follows from the leak of
// 1e-12 S in the row next to it. The midpoint rule rings, with potentials of 10⁶ V.
BOOST_AUTO_TEST_CASE(chokes_do_not_ring) {
  const std::string netlist = read_text("tests/corpus/netlists/choke_freewheel.cir");
  Json experiment = import_netlist(netlist);
  const auto potentials = [&] {
    const TemporaryFolder folder;
    BOOST_REQUIRE(run_in(folder, experiment).status == RunStatus::completed);
    const Waveforms table = read_table(folder / "run/trajectory.csv", ',');
    std::vector<double> r;
    for (const auto& row : table.rows) {
      const double a = row[table.column("potential_a")];
      r.push_back(row[table.column("potential_r")] - std::max(a, 0.0));
    }
    return r;
  };
  // One of the two diodes conducts: r is at most a forward voltage below the higher of a and 0.
  long far = 0;
  for (const double drop : potentials()) far += drop > 0.05 || drop < -1.1 ? 1 : 0;
  BOOST_TEST(far <= 3);
  experiment["method"] = "constrain-first";
  double largest = 0.0;
  for (const double drop : potentials()) largest = std::max(largest, std::abs(drop));
  BOOST_TEST(largest > 1e3);
}

// A square wave into coils that are coupled by all but 10⁻⁶: 2 μs are no time for steps of 10 μs, and the voltages go to and fro by
// tens of volts while the fluxes hardly move. Nobody writes the voltages. Damped, they do not.
BOOST_AUTO_TEST_CASE(what_nobody_writes_is_looked_at_too) {
  Json experiment = import_netlist(
      "t\nV1 a 0 PULSE(-8 8 0 1u 1u 399u 800u)\nR1 a p 1.5\nL1 p 0 80m\nL2 s 0 320m\nR2 s 0 10\n"
      "K1 L1 L2 0.999999\n.tran 10u 2m\n");
  experiment["time"] = {{"step", 1e-5}, {"end", 2e-3}};
  for (const bool is_damped : {false, true})
    for (const bool is_written : {false, true}) {
      Json asked = experiment;
      asked["method"] = {{"type", "constrain-first"}};
      if (is_damped) asked["method"]["damping"] = "l-stable";
      if (!is_written) asked.erase("observe");
      const TemporaryFolder folder;
      const auto warnings = run_in(folder, asked).summary.warnings;
      BOOST_TEST(warnings.size() == (is_damped ? 0u : 1u));
      if (!warnings.empty())
        BOOST_TEST(warnings[0].find("goes to and fro") != std::string::npos, warnings[0]);
    }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
