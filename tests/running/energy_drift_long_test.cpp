// A million steps of symplectic methods: docs/energy-drift.md has more of them.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "run_in.hpp"
#include "waveforms.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(energy_drift_long)

namespace {

constexpr Index kBlocks = 50;

// The line through averages over blocks of a run: what it rises by, and the error of that. Averages that are
// independent of each other have a ratio of Durbin and Watson of about 2; where it is below 1 their changes are
// taken for independent, and a random walk of these rises by sqrt(6/5 n) changes though nothing drives it.
struct Line {
  explicit Line(const VectorXd& means) {
    const double n = static_cast<double>(means.size());
    const VectorXd at = VectorXd::LinSpaced(means.size(), -0.5 * (n - 1.0), 0.5 * (n - 1.0));
    const double slope = at.dot(means) / at.squaredNorm();
    const VectorXd rest = (means.array() - means.mean()).matrix() - slope * at;
    const double changes = (rest.tail(rest.size() - 1) - rest.head(rest.size() - 1)).squaredNorm();
    rise = n * slope;
    error = n * std::sqrt(changes > rest.squaredNorm()
                              ? rest.squaredNorm() / (n - 2.0) / at.squaredNorm()
                              : 1.2 / n * changes / (n - 2.0));
  }
  double rise = 0.0, error = 0.0;
};

}  // namespace

// What the line through (t, H) rises by over the run is within four of its errors and of what a million roundings
// make of H at random, and a tenth of a unit of the last place of H a step, as a steady motion rounds.
BOOST_AUTO_TEST_CASE(no_drift_in_a_million_steps) {
  constexpr long steps = 1'000'000;
  for (const char* name :
       {"spherical_pendulum", "double_pendulum", "pendulum_angle", "duffing", "elastic_pendulum",
        "henon_heiles_section", "point_vortices_lagrangian", "body_in_fluid", "geodesic_se3"}) {
    Json experiment =
        Json::parse(read_text("experiments/" + std::string(name) + ".json"), nullptr, true, true);
    for (const char* key : {"expect", "events", "observe", "symmetries", "defects"})
      experiment.erase(key);
    // The motion of the experiment is chaotic: there the energy that the method keeps wanders, and the errors of a line
    // say nothing of that (twelve starts 1e-9 apart rise by 1e-8, give or take 1.4e-8). This one is regular.
    if (std::string(name) == "double_pendulum")
      experiment["initial"].update({{"a", 0.6}, {"b", 0.5}});
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
    const double first = rows_of_run.rows.front()[H];
    VectorXd means = VectorXd::Zero(kBlocks);
    const Index rows = std::ssize(rows_of_run.rows) / kBlocks;
    for (Index i = 0; i < kBlocks * rows; ++i)
      means[i / rows] +=
          (rows_of_run.rows[static_cast<std::size_t>(i)][H] - first) / static_cast<double>(rows);
    const Line line(means);
    const double round_off = 2.2e-16 * std::sqrt(static_cast<double>(steps)) * std::fabs(first);
    const double steady = 0.1 * 2.2e-16 * static_cast<double>(steps) * std::fabs(first);
    BOOST_TEST(std::fabs(line.rise) < 4.0 * std::hypot(line.error, round_off) + steady,
               name << ": " << line.rise << " ± " << line.error);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
