// What is measured of a run, and the settings of a solver from coarse to fine.
#pragma once

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "courant/reading/experiment.hpp"

// A problem is a class P, written by hand but for the experiment. Its state for the competitors is
// y = (q, v) in units in which positions and velocities are about 1.
//
//   name, n, m            of the problem; positions; constraints g(q) = 0
//   separable             whether v' = f(q), q' = v
//   start<T>()            y at t = 0, on double and long double
//   period(), horizons    time unit, and for how many of them
//   exact(periods)        y after as many periods
//   field(y, dy, λ)       y' where the reactions λ are solved for: the underlying ODE
//   energy(y)
//   experiment(folder)    the document that Courant reads, in any units
//   time_scale()          its seconds for one unit of t
//   of_state(x, y)        y of a state of Courant
//   choices()             methods of Courant
//
// and for m > 0
//
//   residual(y, dy, r)    on any scalar: of the stabilised index 2 form (Gear, Gupta, Leimkuhler), y = (q, v, μ, λ):
//                         q' = v + Gᵀμ,  M v' = F + Gᵀλ,  g = 0,  G v = 0
//   violation(y)          the greatest of |g| and |G v|
//   rattle(y, h)          optional: a step of RATTLE
namespace work_precision {

using courant::Json;

// A method of Courant, and with how many steps a period its runs begin.
struct Choice {
  std::string label;
  Json method;
  long steps = 0;
};

// These, and the explicit method of a system with H = T + V, or RATTLE, at all orders.
inline std::vector<Choice> with_verlet(std::vector<Choice> choices, const char* type,
                                       const std::string& name) {
  for (const auto& [order, steps] :
       std::initializer_list<std::pair<int, long>>{{2, 500}, {4, 64}, {6, 32}, {8, 32}}) {
    Json method = {{"type", type}, {"discretization", "verlet"}};
    if (order > 2) method["order"] = order;
    choices.push_back(
        {order > 2 ? name + ", order " + std::to_string(order) : name, method, steps});
  }
  return choices;
}

// What is not the same from run to run.
struct Context {
  std::filesystem::path experiments;  // the folder
  double seconds = 0.0;               // the most that a run should take
  std::string solvers;                // how the names of those begin that are measured
  double periods = 0.0;
};

template <class P>
using StateOf = std::array<double, 2 * P::n>;

// Processor time of this thread.
inline double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A run would take longer than it should.
struct TooLong : std::runtime_error {
  TooLong() : std::runtime_error("would take too long") {}
};

// The greatest deviations of energy and constraints at some moments, and the time since the first.
template <class P>
class Record {
 public:
  // `most`: the seconds that the run should take. Throws TooLong when it is foreseen to take twice as
  // many, from the hundredth part of it on.
  Record(double end, double most)
      : end_(end),
        most_(most),
        energy_(P::energy(P::template start<double>().data())),
        begin_(work_precision::seconds()) {}
  double seconds() const { return work_precision::seconds() - begin_; }
  void add(double t, const double* y) {
    if (t > 0.01 * end_ && seconds() * end_ > 2.0 * most_ * t) throw TooLong();
    const double drift = std::fabs(P::energy(y) - energy_);
    if (t < 0.1 * end_) early_ = std::max(early_, drift);
    drift_ = std::max(drift_, drift);
    if constexpr (P::m > 0) violation_ = std::max(violation_, P::violation(y));
  }
  double early() const { return early_; }
  double drift() const { return drift_; }
  double violation() const { return violation_; }

 private:
  double end_, most_, energy_, begin_;
  double early_ = 0.0, drift_ = 0.0, violation_ = 0.0;
};

// Moments that do not come at the same phase of each period.
constexpr long kMoments = 997;

template <class P>
double end_of(const Context& context) {
  return context.periods * P::period();
}

// A run: its time, where it ended and what was seen on the way.
template <class P>
struct Run {
  double seconds = 0.0;
  StateOf<P> end{};
  Record<P> record;
};

// Runs run(0), run(1), … , each finer than the one before, until one takes too long or gets no better
// by being finer, and prints a line of JSON for each. Short runs are made again; the least time counts.
template <class P, class F>
void sweep(const Context& context, const std::string& solver, int most, const F& run) {
  if (!solver.starts_with(context.solvers)) return;
  const StateOf<P> exact = P::exact(context.periods);
  double best = INFINITY;
  int worse = 0;
  for (int k = 0; k < most && worse < 2; ++k) try {
      Run<P> found = run(k);
      double total = found.seconds;
      for (int again = 0; again < 4 && total < 0.5; ++again) {
        const double time = run(k).seconds;
        total += time;
        found.seconds = std::min(found.seconds, time);
      }
      double error = 0.0;
      for (std::size_t i = 0; i < exact.size(); ++i) {
        if (!std::isfinite(found.end[i])) throw std::runtime_error("is not finite at the end");
        error = std::max(error, std::fabs(found.end[i] - exact[i]));
      }
      const Json line = {{"problem", P::name},
                         {"periods", context.periods},
                         {"solver", solver},
                         {"setting", k},
                         {"seconds", found.seconds},
                         {"error", error},
                         {"early_drift", found.record.early()},
                         {"drift", found.record.drift()},
                         {"violation", found.record.violation()}};
      std::puts(line.dump().c_str());
      std::fflush(stdout);
      worse = error < 1e-4 && !(error < 0.7 * best) ? worse + 1 : 0;
      best = std::min(best, error);
    } catch (const TooLong&) {
      return;
    } catch (const std::exception& failure) {
      std::fprintf(stderr, "%s, %s, setting %d: %s\n", P::name, solver.c_str(), k, failure.what());
    }
}

// 1e-4, 1e-5, …, 1e-14
constexpr int kTolerances = 11;
inline double tolerance(int k) { return std::pow(10.0, -4 - k); }

}  // namespace work_precision
