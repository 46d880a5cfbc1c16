#include "courant/reading/netlist.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "run_in.hpp"
#include "waveforms.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(netlists_against_ngspice)

namespace {

// The netlist with accurate steps and with what makes ngspice write potentials to a file.
std::string for_ngspice(std::string netlist, const std::vector<std::string>& nodes,
                        const std::string& output) {
  std::string control =
      ".options reltol=1e-6 abstol=1e-15 vntol=1e-9 chgtol=1e-18\n.control\n"
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

}  // namespace

// Every potential within 1e-3 of the largest one of the circuit. No energy is lost but round-off; with damping
// less than 1e-5 of it.
BOOST_AUTO_TEST_CASE(waveforms_of_netlists) {
  if (std::system("command -v ngspice > /dev/null") != 0) {
    BOOST_TEST_MESSAGE("ngspice is not installed");
    return;
  }
  for (const char* name : {"rc_pulse", "rlc_uic", "rectifier", "transformer", "amplifier", "bridge",
                           "doubler", "cockcroft", "peak_detector", "pulse_corner",
                           // Which begin at an operating point, or with potentials of .ic.
                           "zener", "supply", "phase_shift", "whole_coupling"})
    BOOST_TEST_CONTEXT(name) {
      const std::string netlist = read_text(std::string("tests/corpus/netlists/") + name + ".cir");
      const Json experiment = import_netlist(netlist);
      const TemporaryFolder folder;
      BOOST_REQUIRE(run_in(folder, experiment).status == RunStatus::completed);
      const Waveforms ours = read_table(folder / "run/trajectory.csv", ',');
      std::vector<std::string> nodes;
      for (const auto& [key, formula] : experiment.at("observe").items())
        if (key.rfind("potential_", 0) == 0 && key.find("x1_") == std::string::npos)
          nodes.push_back(key.substr(10));
      write_text(folder / "circuit.cir",
                 for_ngspice(netlist, nodes, (folder / "potentials.txt").string()));
      BOOST_REQUIRE(
          std::system(
              ("ngspice -b " + (folder / "circuit.cir").string() + " > /dev/null 2>&1").c_str()) >=
          0);
      const Waveforms theirs = read_table(folder / "potentials.txt", ' ');
      BOOST_REQUIRE(theirs.rows.size() > 100u);

      double largest = 0.0, difference = 0.0;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::size_t column = ours.column("potential_" + nodes[k]);
        for (const auto& row : ours.rows) {
          largest = std::max(largest, std::abs(row[column]));
          difference = std::max(difference, std::abs(row[column] - theirs.at(row[0], k + 1)));
        }
      }
      double energy_there = 0.0, imbalance = 0.0;
      for (const auto& row : ours.rows) {
        for (const char* energy : {"supplied", "H"})
          energy_there = std::max(energy_there, std::abs(row[ours.column(energy)]));
        imbalance = std::max(imbalance, std::abs(row[ours.column("balance")]));
      }
      const bool is_damped = experiment["method"].contains("damping");
      BOOST_TEST(imbalance <= (is_damped ? 1e-5 : 1e-8) * energy_there);
      BOOST_TEST_MESSAGE(name << ": " << difference / largest);
      BOOST_TEST(difference < 1e-3 * largest);
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
  experiment["method"].erase("damping");
  double largest = 0.0;
  for (const double drop : potentials()) largest = std::max(largest, std::abs(drop));
  BOOST_TEST(largest > 1e3);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
