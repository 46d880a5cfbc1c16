#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>

#include "courant/extensions/spice/netlist.hpp"
#include "courant/tests/running/run_in.hpp"
#include "courant/tests/running/waveforms.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(lossless_network_long)

namespace {

// The times at the beginning and the end that are written, in steps.
constexpr int kWindow = 400;

// The energies of tests/corpus/netlists/lossless.cir in each row that ngspice writes of this window. It
// does not keep what comes before, which would be a gigabyte.
std::vector<double> energies_of_ngspice(const TemporaryFolder& folder, std::string netlist,
                                        const std::string& end, const std::string& from) {
  const std::string output = (folder / "waveforms.txt").string();
  netlist.resize(netlist.find(".tran"));
  netlist +=
      ".control\nset wr_singlescale\nset wr_vecnames\nset numdgt=15\n"
      "save v(a) v(b) v(c) i(l1) i(l2)\n"
      "tran 5n " +
      end + " " + from + " 5n uic\nwrdata " + output +
      " v(a) v(b) v(c) i(l1) i(l2)\nquit\n.endc\n.end\n";
  write_text(folder / "circuit.cir", netlist);
  const std::string command =
      "ngspice -b " + (folder / "circuit.cir").string() + " > /dev/null 2>&1";
  BOOST_REQUIRE(std::system(command.c_str()) >= 0);
  std::vector<double> energies;
  for (const auto& row : read_table(output, ' ').rows)
    energies.push_back(0.5 *
                       (1e-9 * row[1] * row[1] + 2e-9 * row[2] * row[2] + 1.5e-9 * row[3] * row[3] +
                        1e-6 * row[4] * row[4] + 3e-6 * row[5] * row[5]));
  BOOST_REQUIRE(energies.size() >= std::size_t{kWindow});
  return energies;
}

}  // namespace

// The trapezoidal rule of both keeps the energy of a linear circuit, whatever the step. ngspice begins, and
// goes on after each breakpoint, with steps of another rule, of order 1, and that costs energy.
BOOST_AUTO_TEST_CASE(energy_over_a_hundred_thousand_periods) {
  constexpr double energy = 0.5e-9;
  const std::string netlist = read_text("tests/corpus/netlists/lossless.cir");
  Json experiment = import_netlist(netlist);
  BOOST_REQUIRE(experiment.at("output").at("interval").get<double>() == 5e-9);
  experiment["time"] = {{"step", 5e-9}, {"end", experiment.at("time").at("end")}};
  experiment["output"] = {{"every", 4000}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_REQUIRE(outcome.status == RunStatus::completed);
  const Waveforms ours = read_table(folder / "run/trajectory.csv", ',');
  double drift = 0.0;
  for (const auto& row : ours.rows)
    drift = std::max(drift, std::abs(row[ours.column("H")] / energy - 1.0));
  BOOST_TEST_MESSAGE("Courant: " << drift);
  BOOST_TEST(ours.rows.size() == 1001u);
  BOOST_TEST(drift < 1e-12);

  if (std::system("command -v ngspice > /dev/null") != 0) {
    BOOST_TEST_MESSAGE("ngspice is not installed");
    return;
  }
  const std::vector<double> first = energies_of_ngspice(folder, netlist, "2u", "0"),
                            last = energies_of_ngspice(folder, netlist, "20m", "19.998m");
  const double at_start = std::abs(first.back() / energy - 1.0),
               later = std::abs(last.back() / first.back() - 1.0);
  BOOST_TEST_MESSAGE("ngspice: " << at_start << " in its first 2 µs, then " << later);
  BOOST_TEST(later < 1e-7);
  BOOST_TEST(drift < at_start + later);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
