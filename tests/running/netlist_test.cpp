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

// Every potential within 1e-3 of the largest one of the circuit, and no more energy lost than round-off of
// the currents of diodes.
BOOST_AUTO_TEST_CASE(waveforms_of_seven_netlists) {
  if (std::system("command -v ngspice > /dev/null") != 0) {
    BOOST_TEST_MESSAGE("ngspice is not installed");
    return;
  }
  for (const char* name :
       {"rc_pulse", "rlc_uic", "rectifier", "transformer", "amplifier", "bridge", "doubler"})
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
      BOOST_TEST(imbalance <= 1e-8 * energy_there);
      BOOST_TEST_MESSAGE(name << ": " << difference / largest);
      BOOST_TEST(difference < 1e-3 * largest);
    }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
