// A million steps of symplectic methods: docs/energy-drift.md has more of them.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "run_in.hpp"
#include "waveforms.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(energy_drift_long)

// What the line through (t, H) rises by over the run, next to the greatest |H - H(0)| and to what a million
// roundings make of H at random.
BOOST_AUTO_TEST_CASE(no_drift_in_a_million_steps) {
  constexpr long steps = 1'000'000;
  for (const char* name :
       {"spherical_pendulum", "double_pendulum", "pendulum_angle", "duffing", "elastic_pendulum",
        "henon_heiles_section", "point_vortices_lagrangian", "body_in_fluid", "geodesic_se3"}) {
    Json experiment =
        Json::parse(read_text("experiments/" + std::string(name) + ".json"), nullptr, true, true);
    for (const char* key : {"expect", "events", "observe", "symmetries", "defects"})
      experiment.erase(key);
    Json& time = experiment["time"];
    time["end"] =
        std::to_string(steps) + "*(" +
        (time["step"].is_string() ? time["step"].get<std::string>() : time["step"].dump()) + ")";
    experiment["output"] = {{"every", 500}};
    const TemporaryFolder folder;
    RunOptions options;  // compiled where there is a compiler
    options.folder = folder / "run";
    const RunOutcome outcome = run(read_experiment(experiment.dump()), options);
    BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed), name);
    const Waveforms rows_of_run = read_table(folder / "run/trajectory.csv", ',');
    const std::size_t H = rows_of_run.column("H");
    double t = 0.0, error = 0.0, greatest = 0.0;
    const double first = rows_of_run.rows.front()[H],
                 rows = static_cast<double>(rows_of_run.rows.size());
    for (const auto& row : rows_of_run.rows) {
      t += row[0] / rows;
      error += (row[H] - first) / rows;
      greatest = std::max(greatest, std::fabs(row[H] - first));
    }
    double spread = 0.0, together = 0.0;
    for (const auto& row : rows_of_run.rows) {
      spread += (row[0] - t) * (row[0] - t);
      together += (row[0] - t) * (row[H] - first - error);
    }
    const double rise =
        together / spread * (rows_of_run.rows.back()[0] - rows_of_run.rows.front()[0]);
    const double round_off = 2e-16 * std::sqrt(static_cast<double>(steps)) * std::fabs(first);
    BOOST_TEST(std::fabs(rise) < 0.02 * greatest + 50.0 * round_off, name);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
