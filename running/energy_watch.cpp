#include "courant/running/energy_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Changes below this part of |H| are not looked at, and the next look is at a change so many times
// as large.
constexpr double kLeast = 1e-6;
constexpr double kFurther = 4.0;

// Numbers are rounded in each step, and in the solution of the first.
constexpr double kFirstSteps = 10.0;
// By so much next to the largest of them coordinates are rounded in a step.
constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();

// A method of order 1 has a third; errors that do not fall at all, one or more.
constexpr double kConvergent = 0.6;

// Steps times coordinates of what is made again from the start: a tenth of a second, about.
constexpr double kMostWork = 1e5;
// Where ports and what they dissipate leave this part of a change of H, as damping takes it, steps of other sizes
// may differ by that part of it.
constexpr double kAccounted = 0.1, kAgreed = 1e-2;
// An error of H that is more than this part of its terms is said, whether it converges or not.
constexpr double kMostOfTerms = 1e-2;
// Where the run in steps of a third leaves less than this part of a change of H, the change is the method's.
constexpr double kLeft = 0.5;

}  // namespace

EnergyWatch::EnergyWatch(std::shared_ptr<const Integrator> integrator,
                         std::function<double(const State&)> energy,
                         std::function<EnergySizes(const State&)> sizes, Columns columns,
                         State start)
    : integrator_(std::move(integrator)),
      energy_(std::move(energy)),
      sizes_(std::move(sizes)),
      columns_(std::move(columns)),
      start_(std::move(start)) {}

std::optional<RunEnd> EnergyWatch::watch(const RunMoment& moment) {
  const double H = moment.row[columns_.energy];
  if (moment.k == 0) memory_.initial = H;
  memory_.largest = std::max(memory_.largest, std::fabs(H));
  const double change = std::fabs(H - memory_.initial);
  if (!(change > std::max(kFurther * memory_.looked_at, kLeast * memory_.largest)) || moment.k == 0)
    return std::nullopt;
  memory_.looked_at = change;
  // Where H is a sum of terms that cancel, |H| is no measure of them, nor of its round-off.
  const auto [terms, round_off] = sizes(moment.step.after);
  const double noise = (kFirstSteps + static_cast<double>(moment.k)) * round_off;
  if (!(change > std::max(noise, kLeast * terms)) || stands_still(moment)) return std::nullopt;
  const std::string what =
      "H has changed by " + number_text(H - memory_.initial) + " at t = " + number_text(moment.t);
  const std::string so = " The trajectory may be wrong from there on.";
  if (finding().empty() && !is_explained(moment, terms)) {
    memory_.found_at = change;
    memory_.finding = what +
                      ", and shorter steps would not change it less: not the method's order "
                      "explains it." +
                      so;
  } else if (const auto in_thirds = change_in_thirds(moment);
             finding().empty() && in_thirds && std::fabs(*in_thirds) < kLeft * change) {
    memory_.found_at = change;
    memory_.finding = what + ", and by " + number_text(*in_thirds) +
                      " in steps of a third: that is the error of steps of " +
                      number_text(moment.step.h) + "." + so;
  }
  return end_where_broken(moment);
}

std::string EnergyWatch::finding() const {
  return memory_.found_at > kLeast * memory_.largest ? memory_.finding : "";
}

EnergySizes EnergyWatch::sizes(const State& state) const {
  try {
    return sizes_(state);
  } catch (const std::domain_error&) {  // then nothing is known of them
    return {};
  }
}

bool EnergyWatch::converges(const State& from, double h, long count, double agreed,
                            double most) const {
  double end[3];
  try {
    int parts = 1;
    for (double& H : end) {
      H = energy_(integrator_->advance(from, h / parts, parts * count));
      parts *= 3;
    }
  } catch (const std::runtime_error&) {  // a shorter step that cannot be made says nothing
    return true;
  } catch (const std::domain_error&) {
    return true;
  }
  const double first = std::fabs(end[0] - end[1]), second = std::fabs(end[1] - end[2]);
  const bool stays = second > kConvergent * first && second > kLeast * memory_.largest;
  return !(stays && first + second > agreed) && !(first + second > most);
}

bool EnergyWatch::is_accounted(const RunMoment& moment) const {
  const double change = std::fabs(moment.row[columns_.energy] - memory_.initial);
  return columns_.balance && std::fabs(moment.row[*columns_.balance]) <= kAccounted * change;
}

double EnergyWatch::through_ports(const RunMoment& moment) const {
  double sum = 0.0;
  for (const Index column : columns_.through_ports) sum += std::fabs(moment.row[column]);
  return sum;
}

bool EnergyWatch::stands_still(const RunMoment& moment) const {
  State first = start_;
  integrator_->stepper()->prepare(first, moment.step.h);  // where a method on M_f moves it
  const double rounding = kRoundings * first.x.lpNorm<Eigen::Infinity>();
  return (moment.step.after.x - first.x).lpNorm<Eigen::Infinity>() <=
         (kFirstSteps + static_cast<double>(moment.k)) * rounding;
}

std::optional<RunEnd> EnergyWatch::end_where_broken(const RunMoment& moment) const {
  const Step& step = moment.step;
  const double before = sizes(step.before).terms;
  if (!(before > 0.0) || is_accounted(moment)) return std::nullopt;
  double end[3], least = std::numeric_limits<double>::infinity();
  try {
    int parts = 1;
    for (double& H : end) {
      const State there = integrator_->advance(step.before, step.h / parts, parts);
      H = energy_(there);
      least = std::min(least, sizes(there).terms);
      parts *= 3;
    }
  } catch (const std::runtime_error&) {  // a shorter step that cannot be made says nothing
    return std::nullopt;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
  const double size = std::max({before, least, through_ports(moment)});
  const double error = std::fabs(end[0] - end[1]) + std::fabs(end[1] - end[2]);
  if (!(size > 0.0) || !(error > size)) return std::nullopt;
  constexpr double all_parts = 1 + 3 + 9;
  if (all_parts * work_from_start(moment) <= kMostWork &&
      converges(start_, step.h, moment.k, 0.0, kMostOfTerms * size))
    return std::nullopt;
  return RunEnd{RunStatus::failed,
                "The step to t = " + number_text(moment.t) + " led to H = " + number_text(end[0]) +
                    "; in three and in nine parts it leads to " + number_text(end[1]) + " and " +
                    number_text(end[2]) +
                    ". The steps do not resolve the solution there, as at a collision or a pole, "
                    "and its end is no state of it."};
}

double EnergyWatch::work_from_start(const RunMoment& moment) const {
  return static_cast<double>(moment.k * std::max<Index>(1, start_.x.size()));
}

std::optional<double> EnergyWatch::energy_in_thirds(const RunMoment& moment) const {
  if (3 * work_from_start(moment) > kMostWork) return std::nullopt;
  try {
    return energy_(integrator_->advance(start_, moment.step.h / 3.0, 3 * moment.k));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

std::optional<double> EnergyWatch::change_in_thirds(const RunMoment& moment) const {
  const double size = sizes(start_).terms;
  const double change = std::fabs(moment.row[columns_.energy] - memory_.initial);
  if (columns_.balance || !(size > 0.0) || !(change > size)) return std::nullopt;
  const auto there = energy_in_thirds(moment);
  return there ? std::optional(*there - memory_.initial) : std::nullopt;
}

bool EnergyWatch::is_explained(const RunMoment& moment, double terms) const {
  const Step& step = moment.step;
  constexpr double any = std::numeric_limits<double>::infinity();
  const double change = std::fabs(moment.row[columns_.energy] - memory_.initial);
  const double agreed = is_accounted(moment) ? kAgreed * change : 0.0;
  if (converges(step.before, step.h, 1, agreed, any)) return true;
  // An error that changes its sign, as after the edge of a pulse, makes the first of the differences small by
  // accident: those of shorter steps tell.
  if (converges(step.before, step.h / 3.0, 3, agreed, any) &&
      converges(step.before, step.h / 9.0, 9, agreed, any))
    return true;
  constexpr double all_parts = 1 + 3 + 9;
  const double work = work_from_start(moment);
  if (all_parts * work <= kMostWork)
    return converges(start_, step.h, moment.k, agreed, kMostOfTerms * terms);
  const auto there = energy_in_thirds(moment);
  return there && std::fabs(*there - moment.row[columns_.energy]) <= kAgreed * change;
}

}  // namespace courant
