#include "courant/integrators/methods/integrator_laws.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <optional>

#include "courant/integrators/methods/claimed_order.hpp"
#include "courant/integrators/methods/energy_imbalance.hpp"
#include "courant/integrators/methods/measured_differential.hpp"
#include "courant/integrators/methods/state_separation.hpp"
#include "courant/manifolds/measurement.hpp"

namespace courant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A symplectic form is preserved to about ten digits where it is preserved: differences of order 4
// know differentials no better.
constexpr double kSymplectic = 1e-8;
constexpr double kSameDifferential = 1e-7;
constexpr double kSame = StateSeparation::kSame;
// What round-off leaves of a balance of energies.
constexpr double kEnergy = 1e-12;

class IntegratorLaws {
 public:
  IntegratorLaws(const Integrator& integrator, const IntegratorSetting& setting,
                 const IntegratorLawOptions& options)
      : integrator_(integrator),
        setting_(setting),
        options_(options),
        M_(*setting.system->manifold()),
        separation_(M_, integrator.units(), setting.initial.x),
        order_(integrator, setting, options, separation_) {}

  IntegratorReport run() {
    attempt([&] { return gather_states(); });
    report_.order = finite(attempt([&] { return order_.order(); }));
    report_.asymmetry = attempt([&] { return asymmetry(); });
    order_law();
    symmetry_law();
    symplecticity_laws();
    restart_law();
    backward_law();
    failure_law();
    empty_law();
    time_law();
    energy_law();
    differential_law();
    return std::move(report_);
  }

 private:
  LawMeasurement law(const std::string& text, double bound) const {
    return LawMeasurement(integrator_.name() + " on " + M_.name(), text, bound);
  }
  void add(const LawMeasurement& measured) { report_.laws.push_back(measured.result()); }
  std::string where() const { return describe("x", setting_.initial.x); }

  static std::optional<double> attempt(const std::function<double()>& measure) {
    try {
      return measure();
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  static std::optional<double> finite(std::optional<double> value) {
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  // The state after so many steps of h by one stepper.
  State advanced(const State& from, double h, int steps) const {
    return integrator_.advance(from, h, steps);
  }
  double gather_states() {
    const auto stepper = integrator_.stepper();
    State state = setting_.initial;
    for (int i = 0; i < 4; ++i) {
      stepper->step(state, setting_.step);
      report_.states.push_back(state.x);
      // A system that starts at zero has the size of where it goes.
      if (setting_.initial.x.isZero(0.0)) separation_.include(state.x);
    }
    return 0.0;
  }

  double asymmetry() const {
    const State there = advanced(setting_.initial, setting_.step, 1);
    return separation_(advanced(there, -setting_.step, 1), setting_.initial);
  }

  void order_law() {
    auto measured = law("P1 measured order is order() = " + std::to_string(integrator_.order()) +
                            (options_.both_ways ? "" : " or more"),
                        ClaimedOrder::kTolerance);
    measured.add(
        [&] {
          const ClaimedOrder::Defect defect = order_.defect();
          if (defect.order) report_.order = defect.order;
          return defect.value;
        },
        where());
    add(measured);
  }

  void backward_law() {
    auto measured =
        law("P6 a step h < 0 goes back in time, with the order claimed", ClaimedOrder::kTolerance);
    measured.add([&] { return order_.backward_defect(); }, where());
    add(measured);
  }

  void symmetry_law() {
    if (integrator_.is_symmetric()) {
      auto measured = law("P2 Φ_{-h} ∘ Φ_h = id, as said", kSame);
      measured.add([&] { return asymmetry(); }, where());
      add(measured);
    } else if (options_.both_ways && M_.dimension() > 0) {
      auto measured = law("P2 not symmetric, as said", 0.0);
      measured.add([&] { return std::max(0.0, 1e-9 - asymmetry()); }, where());
      add(measured);
    }
  }

  // That of a step of the setting, which several laws ask for.
  const MeasuredDifferential& differential() {
    if (!differential_) differential_.emplace(integrator_, setting_, separation_.scale());
    return *differential_;
  }

  void differential_law() {
    if (setting_.is_gauge || M_.dimension() == 0 || !options_.both_ways) return;
    auto measured = law("P11 the differential is that of the steps", kSameDifferential);
    measured.add(
        [&] {
          const auto exact = integrator_.differential();
          return exact ? differential().defect(*exact) : 0.0;
        },
        where());
    add(measured);
  }

  void symplecticity_laws() {
    const bool claimed = integrator_.is_symplectic().value_or(false);
    const MeasuredDifferential* step = nullptr;
    attempt([&] {
      step = &differential();
      return 0.0;
    });
    if (step && has_symplectic_form(setting_))
      report_.symplecticity = attempt([&] { return step->symplecticity_defect(); });
    // The distance of two structures means nothing where numbers are far apart.
    if (step && setting_.structure && setting_.conormals.rows() == 0 && !integrator_.units())
      report_.preservation = attempt([&] { return step->preservation_defect(); });
    if (!claimed) return;
    auto symplectic = law("P3 Φ_h*ω = ω, as said", kSymplectic);
    if (report_.symplecticity)
      symplectic.add(*report_.symplecticity, where());
    else if (M_.dimension() == 0)
      symplectic.add(0.0, where());
    else
      symplectic.add(kInfinity, where() + ": no symplectic form, or no step, to measure it with");
    add(symplectic);
    if (!report_.preservation) return;
    auto preserves = law("P4 Φ_h preserves D, as said", kSymplectic);
    preserves.add(*report_.preservation, where());
    add(preserves);
  }

  void restart_law() {
    auto measured = law("P5 going on is the same as starting again from the state", kSame);
    if (setting_.is_gauge) return;
    measured.add(
        [&] {
          const auto stepper = integrator_.stepper();
          State state = setting_.initial;
          double worst = 0.0;
          for (int i = 0; i < 20; ++i) {
            const State again = advanced(state, setting_.step, 1);
            stepper->step(state, setting_.step);
            worst = std::max(worst, separation_(again, state));
          }
          return worst;
        },
        where());
    add(measured);
  }

  // With steps that grow until one fails; nothing fails for a method that can make any step.
  void failure_law() {
    auto measured = law("P7 a step that fails throws SolveError and leaves no trace", 0.0);
    for (const double factor : {1e3, 1e8, 1e150}) {
      measured.add(
          [&] {
            const auto stepper = integrator_.stepper();
            State state = setting_.initial;
            const State before = state;
            for (int attempts = 0; attempts < 2; ++attempts) {
              try {
                stepper->step(state, factor * setting_.step);
              } catch (const SolveError&) {
                if (!(state == before)) return kInfinity;
                State next = state;
                stepper->step(next, setting_.step);
                if (setting_.is_gauge) continue;
                const State again = advanced(before, setting_.step, 1);
                if (!(separation_(next, again) <= kSame)) return kInfinity;
                continue;
              }
              return is_finite(state) ? 0.0 : kInfinity;
            }
            return 0.0;
          },
          "a step " + describe("h", VectorXd::Constant(1, factor * setting_.step)));
    }
    add(measured);
  }

  void empty_law() {
    if (setting_.is_gauge || !options_.both_ways) return;
    auto measured = law("P8 v and z of the initial state may be empty", kSame);
    measured.add(
        [&] {
          State bare = setting_.initial;
          bare.v.resize(0);
          bare.z.resize(0);
          return separation_(advanced(bare, setting_.step, 1),
                             advanced(setting_.initial, setting_.step, 1));
        },
        where());
    add(measured);
  }

  void time_law() {
    auto measured = law("P9 the time after k steps is t₀ + k h, and k are counted", 1e-14);
    measured.add(
        [&] {
          const auto stepper = integrator_.stepper();
          State state = setting_.initial;
          double worst = 0.0;
          for (int k = 1; k <= 10; ++k) {
            stepper->step(state, setting_.step);
            const double t = setting_.initial.t + k * setting_.step;
            worst = std::max(worst, std::abs(state.t - t) / (1.0 + std::abs(t)));
            if (stepper->statistics().steps != k) return kInfinity;
          }
          return worst;
        },
        where());
    add(measured);
  }

  void energy_law() {
    report_.imbalance =
        attempt([&] { return energy_imbalance(integrator_, setting_, setting_.step); });
    if (!integrator_.has_exact_energy()) return;
    auto measured =
        law("P10 H changes by what is supplied less what is dissipated, as said", kEnergy);
    for (const double factor : {1.0, -0.1, 1e-3})
      measured.add([&] { return energy_imbalance(integrator_, setting_, factor * setting_.step); },
                   "steps of " + describe("h", VectorXd::Constant(1, factor * setting_.step)));
    add(measured);
  }

  const Integrator& integrator_;
  const IntegratorSetting& setting_;
  const IntegratorLawOptions& options_;
  const Manifold& M_;
  StateSeparation separation_;
  ClaimedOrder order_;
  IntegratorReport report_;
  std::optional<MeasuredDifferential> differential_;
};

}  // namespace

IntegratorReport check_integrator(const Integrator& integrator, const IntegratorSetting& setting,
                                  const IntegratorLawOptions& options) {
  return IntegratorLaws(integrator, setting, options).run();
}

}  // namespace courant
