#include "courant/running/checkpoint.hpp"

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "../core/files/temporary_folder.hpp"
#include "courant/core/words/version.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * numbers that are not finite become null
//  * a checkpoint does not keep the images of the tangent map
BOOST_AUTO_TEST_SUITE(checkpoint)

namespace {

using Limits = std::numeric_limits<double>;

// NaN is NaN, whatever its bits; -0 is not 0.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(const VectorXd& a, const VectorXd& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return same(x, y); });
}

// Numbers of every kind.
class Numbers {
 public:
  double operator()() {
    static constexpr double special[] = {
        0.0, -0.0, Limits::denorm_min(), Limits::max(), -Limits::infinity(), Limits::quiet_NaN()};
    const auto which = generator_() % 20;
    if (which < std::size(special)) return special[which];
    double value = std::bit_cast<double>(generator_());
    return std::isfinite(value) ? value : 1.0 / 3.0;
  }
  VectorXd operator()(Index size) {
    return VectorXd::NullaryExpr(size, [&] { return (*this)(); });
  }

 private:
  std::mt19937_64 generator_{3};
};

Checkpoint example() {
  Numbers number;
  return {.run = "0123456789abcdef",
          .k = 1234567890123,
          .state = {.t = 0.1, .x = number(300), .v = number(200), .z = VectorXd(0)},
          .motion = {.is_predictable = true, .displacements = number(40)},
          .trajectory = {.size = 8000, .part = 4096, .hashes = {~std::uintmax_t{0}, 1}},
          .wall_seconds = 12.5,
          .cpu_seconds = 24.25,
          .solver = {.steps = 1,
                     .iterations = 2,
                     .factorizations = 3,
                     .failures = 4,
                     .second_attempts = 5,
                     .confirmations = 6,
                     .divisions = 7},
          .statistics = {.count = 7.0,
                         .initial = number(30),
                         .final = number(30),
                         .min = number(30),
                         .max = number(30),
                         .mean_t = number(),
                         .variation = number(),
                         .mean = number(30),
                         .covariation = number(30)},
          .rows_at_times = {{0.1, number(30)}, {1.0 / 3.0, number(30)}},
          .not_finite = NotFinite{.t = 2.5, .value = -Limits::infinity(), .column = 4},
          .energy_watch = EnergyWatch::Memory{.initial = number(),
                                              .largest = 2.0,
                                              .looked_at = 1e-300,
                                              .found_at = 1e-301,
                                              .finding = "H \"has\"\nchanged: ü"},
          .ladder_watch = LadderWatch::Memory{.largest = number(9),
                                              .last = number(9),
                                              .before_last = VectorXd(0),
                                              .last_time = 0.7},
          .observed = {
              .power_account = PowerAccount::Memory{.first = number(),
                                                    .last = number(),
                                                    .balance = -0.0,
                                                    .greatest = Limits::quiet_NaN(),
                                                    .size = 0.1,
                                                    .stage_greatest = number(),
                                                    .moved = number(),
                                                    .supplied = number(20),
                                                    .dissipated = VectorXd(0)},
              .tangent_map = TangentMap::Memory{
                  .first = number(5), .present = number(5), .images = number(20).reshaped(5, 4)}}};
}

void check_same(const Observer::Memory& a, const Observer::Memory& b) {
  BOOST_TEST_REQUIRE(a.power_account.has_value() == b.power_account.has_value());
  if (a.power_account) {
    BOOST_TEST(same(a.power_account->first, b.power_account->first));
    BOOST_TEST(same(a.power_account->last, b.power_account->last));
    BOOST_TEST(same(a.power_account->balance, b.power_account->balance));
    BOOST_TEST(same(a.power_account->greatest, b.power_account->greatest));
    BOOST_TEST(same(a.power_account->size, b.power_account->size));
    BOOST_TEST(same(a.power_account->stage_greatest, b.power_account->stage_greatest));
    BOOST_TEST(same(a.power_account->moved, b.power_account->moved));
    BOOST_TEST(same(a.power_account->supplied, b.power_account->supplied));
    BOOST_TEST(same(a.power_account->dissipated, b.power_account->dissipated));
  }
  BOOST_TEST_REQUIRE(a.tangent_map.has_value() == b.tangent_map.has_value());
  if (a.tangent_map) {
    BOOST_TEST(same(a.tangent_map->first, b.tangent_map->first));
    BOOST_TEST(same(a.tangent_map->present, b.tangent_map->present));
    const MatrixXd &images = a.tangent_map->images, &others = b.tangent_map->images;
    BOOST_TEST_REQUIRE(images.rows() == others.rows());
    BOOST_TEST_REQUIRE(images.cols() == others.cols());
    BOOST_TEST(same(images.reshaped(), others.reshaped()));
  }
}

void check_same(const Checkpoint& a, const Checkpoint& b) {
  BOOST_TEST(a.run == b.run);
  BOOST_TEST(a.k == b.k);
  BOOST_TEST(a.state.t == b.state.t);
  BOOST_TEST(same(a.state.x, b.state.x));
  BOOST_TEST(same(a.state.v, b.state.v));
  BOOST_TEST(same(a.state.z, b.state.z));
  BOOST_TEST(a.motion.is_predictable == b.motion.is_predictable);
  BOOST_TEST(same(a.motion.displacements, b.motion.displacements));
  BOOST_TEST((a.trajectory == b.trajectory));
  BOOST_TEST(a.wall_seconds == b.wall_seconds);
  BOOST_TEST(a.cpu_seconds == b.cpu_seconds);
  BOOST_TEST(a.solver.steps == b.solver.steps);
  BOOST_TEST(a.solver.iterations == b.solver.iterations);
  BOOST_TEST(a.solver.factorizations == b.solver.factorizations);
  BOOST_TEST(a.solver.failures == b.solver.failures);
  BOOST_TEST(a.solver.second_attempts == b.solver.second_attempts);
  BOOST_TEST(a.solver.confirmations == b.solver.confirmations);
  BOOST_TEST(a.solver.divisions == b.solver.divisions);
  BOOST_TEST(a.statistics.count == b.statistics.count);
  BOOST_TEST(same(a.statistics.initial, b.statistics.initial));
  BOOST_TEST(same(a.statistics.final, b.statistics.final));
  BOOST_TEST(same(a.statistics.min, b.statistics.min));
  BOOST_TEST(same(a.statistics.max, b.statistics.max));
  BOOST_TEST(same(a.statistics.mean_t, b.statistics.mean_t));
  BOOST_TEST(same(a.statistics.variation, b.statistics.variation));
  BOOST_TEST(same(a.statistics.mean, b.statistics.mean));
  BOOST_TEST(same(a.statistics.covariation, b.statistics.covariation));
  BOOST_TEST_REQUIRE(a.rows_at_times.size() == b.rows_at_times.size());
  for (const auto& [t, row] : a.rows_at_times) BOOST_TEST(same(row, b.rows_at_times.at(t)));
  BOOST_TEST_REQUIRE(a.not_finite.has_value() == b.not_finite.has_value());
  if (a.not_finite) {
    BOOST_TEST(a.not_finite->t == b.not_finite->t);
    BOOST_TEST(same(a.not_finite->value, b.not_finite->value));
    BOOST_TEST(a.not_finite->column == b.not_finite->column);
  }
  BOOST_TEST_REQUIRE(a.energy_watch.has_value() == b.energy_watch.has_value());
  if (a.energy_watch) {
    BOOST_TEST(same(a.energy_watch->initial, b.energy_watch->initial));
    BOOST_TEST(a.energy_watch->largest == b.energy_watch->largest);
    BOOST_TEST(a.energy_watch->looked_at == b.energy_watch->looked_at);
    BOOST_TEST(a.energy_watch->found_at == b.energy_watch->found_at);
    BOOST_TEST(a.energy_watch->finding == b.energy_watch->finding);
  }
  BOOST_TEST_REQUIRE(a.ladder_watch.has_value() == b.ladder_watch.has_value());
  if (a.ladder_watch) {
    BOOST_TEST(same(a.ladder_watch->largest, b.ladder_watch->largest));
    BOOST_TEST(same(a.ladder_watch->last, b.ladder_watch->last));
    BOOST_TEST(same(a.ladder_watch->before_last, b.ladder_watch->before_last));
    BOOST_TEST(a.ladder_watch->last_time == b.ladder_watch->last_time);
  }
  check_same(a.observed, b.observed);
}

}  // namespace

BOOST_AUTO_TEST_CASE(reads_back_to_the_same_bits) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "whole", example());
  check_same(read_checkpoint(folder / "whole"), example());
  Checkpoint little = example();
  little.rows_at_times.clear();
  little.not_finite.reset();
  little.energy_watch.reset();
  little.ladder_watch.reset();
  little.observed.power_account.reset();
  little.observed.tangent_map->images.resize(5, 0);  // of a run on single points
  write_checkpoint(folder / "little", little);
  check_same(read_checkpoint(folder / "little"), little);
}

BOOST_AUTO_TEST_CASE(what_is_no_checkpoint_is_refused_in_one_line) {
  const TemporaryFolder folder;
  const auto file = folder / "checkpoint.json";
  write_checkpoint(file, example());
  const std::string text = read_text(file);
  const auto refusal = [&](const std::string& from, const std::string& to) -> std::string {
    std::string other = text;
    BOOST_TEST_REQUIRE(other.find(from) != std::string::npos);
    Json changed = Json::parse(other.replace(other.find(from), from.size(), to));
    changed.erase("hash");
    changed["hash"] = content_hash(changed.dump());
    write_text(file, changed.dump());
    try {
      read_checkpoint(file);
    } catch (const RunFileError& error) {
      const std::string what = error.what();
      BOOST_TEST(what.find('\n') == std::string::npos);
      BOOST_TEST(what.starts_with(file.string() + ": "));
      return what.substr(file.string().size() + 2);
    }
    return "";
  };
  BOOST_TEST(refusal("\"k\":", "\"step\":") == "is not a checkpoint: key 'k' not found");
  BOOST_TEST(refusal("\"t\":0.1", "\"t\":\"half\"") == "half is no number.");
  BOOST_TEST(refusal("\"x\":[", "\"x\":[true,").starts_with("is not a checkpoint: type must be"));
  BOOST_TEST(refusal(COURANT_VERSION_STRING, "9.9.9") ==
             "version 9.9.9 of courant wrote it, this is " COURANT_VERSION_STRING
             ", which may make other bits.");
  BOOST_CHECK_THROW(read_checkpoint(folder / "none"), RunFileError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
