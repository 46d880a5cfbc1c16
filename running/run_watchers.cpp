#include "courant/running/run_watchers.hpp"

#include <chrono>
#include <cmath>
#include <utility>

namespace courant {
namespace {

class Statistics final : public RunWatcher {
 public:
  explicit Statistics(QuantityStatistics& statistics) : statistics_(statistics) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    statistics_.add(moment.t, moment.row);
    return std::nullopt;
  }

 private:
  QuantityStatistics& statistics_;
};

class Finiteness final : public RunWatcher {
 public:
  Finiteness(std::optional<NotFinite>& found, Index count, const QuantityStatistics& statistics)
      : found_(found), count_(count), statistics_(statistics) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    if (statistics_.is_finite()) return std::nullopt;
    for (Index i = 0; i < count_ && !found_; ++i)
      if (!std::isfinite(moment.row[i]))
        found_ = NotFinite{.t = moment.t, .value = moment.row[i], .column = i};
    return std::nullopt;
  }

 private:
  std::optional<NotFinite>& found_;
  Index count_;
  const QuantityStatistics& statistics_;
};

class RowsAtTimes final : public RunWatcher {
 public:
  RowsAtTimes(std::multimap<long, double> due, std::map<double, VectorXd>& rows)
      : due_(std::move(due)), rows_(rows) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    for (auto [at, end] = due_.equal_range(moment.k); at != end; ++at)
      rows_[at->second] = moment.row;
    return std::nullopt;
  }

 private:
  std::multimap<long, double> due_;
  std::map<double, VectorXd>& rows_;
};

class Examination final : public RunWatcher {
 public:
  Examination(LadderWatch& watch, long every) : watch_(watch), every_(every) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    if (moment.k % every_ != 0) return std::nullopt;
    const std::string finding = watch_.examine(moment.step.after);
    if (finding.empty()) return std::nullopt;
    return RunEnd{RunStatus::failed,
                  "Stopped after step " + std::to_string(moment.k) + ". " + finding};
  }

 private:
  LadderWatch& watch_;
  long every_;
};

class Display final : public RunWatcher {
 public:
  Display(std::function<void(const Progress&)> show, std::function<double()> energy_drift,
          long first)
      : show_(std::move(show)), energy_drift_(std::move(energy_drift)), first_(first) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    const auto now = Clock::now();
    if (moment.k == first_) return std::nullopt;
    if (now - shown_ > std::chrono::milliseconds(100) || moment.k == moment.steps) {
      shown_ = now;
      const std::chrono::duration<double> seconds = now - begin_;
      show_({.step = moment.k,
             .steps = moment.steps,
             .first = first_,
             .seconds = seconds.count(),
             .energy_drift = energy_drift_()});
    }
    return std::nullopt;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::function<void(const Progress&)> show_;
  std::function<double()> energy_drift_;
  long first_;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
};

class Stop final : public RunWatcher {
 public:
  explicit Stop(const std::atomic<bool>& stop) : stop_(stop) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    if (moment.k == moment.steps || !stop_.load(std::memory_order_relaxed)) return std::nullopt;
    return RunEnd{RunStatus::interrupted,
                  "Interrupted after step " + std::to_string(moment.k) + "."};
  }

 private:
  const std::atomic<bool>& stop_;
};

}  // namespace

std::unique_ptr<RunWatcher> keep_statistics(QuantityStatistics& statistics) {
  return std::make_unique<Statistics>(statistics);
}

std::unique_ptr<RunWatcher> find_not_finite(std::optional<NotFinite>& found, Index count,
                                            const QuantityStatistics& statistics) {
  return std::make_unique<Finiteness>(found, count, statistics);
}

std::unique_ptr<RunWatcher> keep_rows(std::multimap<long, double> due,
                                      std::map<double, VectorXd>& rows) {
  return std::make_unique<RowsAtTimes>(std::move(due), rows);
}

std::unique_ptr<RunWatcher> examine_ladder(LadderWatch& watch, long every) {
  return std::make_unique<Examination>(watch, every);
}

std::unique_ptr<RunWatcher> show_progress(std::function<void(const Progress&)> show,
                                          std::function<double()> energy_drift, long first) {
  return std::make_unique<Display>(std::move(show), std::move(energy_drift), first);
}

std::unique_ptr<RunWatcher> stop_when(const std::atomic<bool>& stop) {
  return std::make_unique<Stop>(stop);
}

}  // namespace courant
