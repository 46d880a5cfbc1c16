#include "courant/running/run_steps.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <exception>
#include <iterator>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "courant/core/linear/pairs.hpp"

namespace courant {
namespace {

using namespace std::chrono_literals;

// Steps that are made ahead, and numbers that they may take.
constexpr std::size_t kMostAhead = 8192, kLeastAhead = 4, kNumbersAhead = 1 << 18;

// One thread makes thousands of quick steps while the other one sleeps so long; slow ones are not looked for more often
// than that. A thread that waits to be woken waits longer, and whoever wakes it as well.
constexpr std::chrono::microseconds kShortPause = 1ms, kLongPause = 5ms;

template <class Condition>
void wait_for(const Condition& condition) {
  for (auto pause = kShortPause; !condition(); pause = std::min(2 * pause, kLongPause))
    std::this_thread::sleep_for(pause);
}

Motion begin_epoch(Stepper& stepper) {
  Motion motion = stepper.motion();
  stepper.forget();
  stepper.expect(motion);
  return motion;
}

void start_at(Stepper& stepper, double h, RunSteps::Start& start) {
  if (start.motion)
    stepper.expect(*start.motion);
  else
    stepper.prepare(start.state, h);
}

}  // namespace

// A ring of states, that of the start and those after each step: from seen_ to made_ they belong to the reader, the
// others to the thread. What the thread writes in every step it has allocated: two threads that write to one line of memory
// wait for each other.
class RunSteps::Ahead {
 public:
  Ahead(const Integrator& integrator, const TimeSpan& time, long epoch, Start start)
      : made_(start.k),
        seen_(start.k),
        step_{.h = time.step, .after = start.state},
        thread_([this, &integrator, &time, epoch,
                 start = std::move(start)](const std::stop_token& stop) {
          try {
            make_all(integrator, time, epoch, start, stop);
          } catch (...) {
            failure_ = std::current_exception();
          }
          is_over_ = true;
        }) {}

  // The state after step k; those before are needed no more.
  void take(long k) {
    seen_.store(k, std::memory_order_release);
    if (k >= known_) {
      wait_for([&] { return made_.load(std::memory_order_acquire) > k || is_over_; });
      known_ = made_.load(std::memory_order_acquire);
      if (k >= known_) {
        told_ = failed_;
        std::rethrow_exception(failure_);
      }
    }
    step_.before.swap(step_.after);
    State& after = step_.after;
    const double* from = &numbers_[place(k) * size_];
    after.t = *from++;
    VectorXd* const parts[] = {&after.x, &after.v, &after.z, &after.carried};
    for (std::size_t i = 0; i < std::size(parts); ++i) {
      parts[i]->resize(sizes_[i]);
      copy_pairs(from, sizes_[i], parts[i]->data());
      from += sizes_[i];
    }
    told_ = statistics_[place(k)];
  }

  Step& step() { return step_; }
  const SolverStatistics& statistics() const { return told_; }
  // Of the epoch that ended with step k.
  Motion end_epoch(long k) { return motions_[place(k)]; }

 private:
  std::size_t place(long k) const { return static_cast<std::size_t>(k & (room_ - 1)); }

  void make_room(const State& state, long steps) {
    sizes_ = {state.x.size(), state.v.size(), state.z.size(), state.carried.size()};
    for (const Index size : sizes_) size_ += static_cast<std::size_t>(size);
    const std::size_t most = std::min(kMostAhead, static_cast<std::size_t>(steps) + 1);
    const std::size_t room =
        std::bit_floor(std::clamp(kNumbersAhead / size_, kLeastAhead, std::max(kLeastAhead, most)));
    room_ = static_cast<long>(room);
    numbers_ = std::make_unique_for_overwrite<double[]>(room * size_);
    statistics_.resize(room);
    motions_.resize(room);
  }

  void write(const State& state, double* to) const {
    *to++ = state.t;
    for (const VectorXd* part : {&state.x, &state.v, &state.z, &state.carried}) {
      copy_pairs(part->data(), part->size(), to);
      to += part->size();
    }
  }

  // What step k will be written to has been read by the other core. Asked for in time, it comes while steps are made.
  // The states of large systems, whose steps are long, would drive out what these need.
  void fetch(long k) const {
    constexpr std::size_t line = 64 / sizeof(double), most = 16 * line;
    const double* const numbers = &numbers_[place(k) * size_];
    for (std::size_t i = 0; i < std::min(size_, most); i += line)
      __builtin_prefetch(numbers + i, 1);
    __builtin_prefetch(&statistics_[place(k)], 1);
  }

  void publish(RunSteps& steps) {
    const std::size_t at = place(steps.k());
    write(steps.reached(), &numbers_[at * size_]);
    statistics_[at] = steps.statistics();
    if (steps.is_epoch_over()) motions_[at] = steps.end_epoch();
    made_.store(steps.k() + 1, std::memory_order_release);
    fetch(steps.k() + 2);
  }

  void make_all(const Integrator& integrator, const TimeSpan& time, long epoch, Start start,
                const std::stop_token& stop) {
    RunSteps steps(integrator, time, epoch, std::move(start), false);
    try {
      steps.begin();
      make_room(steps.state(), time.steps - steps.k());
      publish(steps);
      long seen = steps.k();
      while (steps.k() < time.steps && !stop.stop_requested()) {
        if (steps.k() + 1 - seen >= room_) {
          wait_for([&] {
            seen = seen_.load(std::memory_order_acquire);
            return steps.k() + 1 - seen < room_ || stop.stop_requested();
          });
          continue;
        }
        steps.next();
        publish(steps);
      }
    } catch (...) {
      failed_ = steps.statistics();
      throw;
    }
  }

  std::array<Index, 4> sizes_{};              // of x, v, z, what is carried
  std::size_t size_ = 1;                      // of all, with t
  long room_ = 0;                             // states in the ring, a power of two
  std::unique_ptr<double[]> numbers_;         // of these states
  std::vector<SolverStatistics> statistics_;  // after each of them
  std::vector<Motion> motions_;               // of the epochs that end there
  SolverStatistics failed_;                   // once it is over
  std::exception_ptr failure_;
  alignas(64) std::atomic<long> made_;  // states
  alignas(64) std::atomic<long> seen_;
  alignas(64) std::atomic<bool> is_over_ = false;
  // Of the reader.
  alignas(64) long known_ = 0;
  Step step_;
  SolverStatistics told_;
  std::jthread thread_;  // the last one: it uses the others
};

RunSteps::RunSteps(const Integrator& integrator, const TimeSpan& time, long epoch, Start start,
                   bool ahead)
    : time_(time), epoch_(epoch), k_(start.k), end_(start.k + epoch) {
  if (ahead) {
    ahead_ = std::make_unique<Ahead>(integrator, time, epoch, std::move(start));
  } else {
    stepper_ = integrator.stepper();
    start_ = std::move(start);
  }
}

RunSteps::~RunSteps() = default;

void RunSteps::begin() {
  if (ahead_)
    ahead_->take(k_);
  else
    start_at(*stepper_, time_.step, start_);
}

void RunSteps::next() {
  if (const auto node = start_.nodes.find(k_); node != start_.nodes.end()) {
    State from = state();
    from.x = node->second;
    replace(from);
  }
  if (ahead_)
    ahead_->take(k_ + 1);
  else if (goes_on_)
    stepper_->go_on(time_.step, time_.time(k_ + 1));
  else
    stepper_->step(start_.state, time_.step, time_.time(k_ + 1));
  goes_on_ = true;
  ++k_;
}

void RunSteps::skip_to(const State& state) {
  replace(state);
  ++k_;
}

void RunSteps::replace(const State& state) {
  start_.state = state;
  goes_on_ = false;
  stepper_->forget();
}

const Step& RunSteps::ended() const { return ahead_ ? ahead_->step() : stepper_->ended(); }

const State& RunSteps::reached() const { return goes_on_ ? stepper_->ended().after : start_.state; }

State& RunSteps::state() {
  if (ahead_) return ahead_->step().after;
  start_.state = reached();
  goes_on_ = false;
  return start_.state;
}

const SolverStatistics& RunSteps::statistics() const {
  return ahead_ ? ahead_->statistics() : stepper_->statistics();
}

Motion RunSteps::end_epoch() {
  end_ += epoch_;
  if (ahead_) return ahead_->end_epoch(k_);
  state();
  return begin_epoch(*stepper_);
}

}  // namespace courant
