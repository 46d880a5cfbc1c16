#include "courant/running/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "courant/core/solve/bracketed_root.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Of a step: the bracket of a zero ends at this length. The curve of a step is known no better.
constexpr double kBracket = 4e-16;

// Bracketing takes some ten evaluations; bisection alone would take 52.
constexpr unsigned kMaxEvaluations = 100;

RunEnd cannot_locate(const RunMoment& moment, const std::exception& error) {
  return {RunStatus::failed, "An event between t = " + number_text(moment.step.before.t) +
                                 " and t = " + number_text(moment.t) +
                                 " cannot be located: " + without_place(error.what())};
}

}  // namespace

EventWatch::EventWatch(std::vector<Event> events, Index first, std::vector<std::string> columns,
                       std::map<std::string, std::set<long>> kept, Tell tell,
                       std::optional<Memory> memory)
    : events_(std::move(events)),
      first_(first),
      columns_(std::move(columns)),
      kept_(std::move(kept)),
      tell_(std::move(tell)) {
  if (memory)
    memory_ = std::move(*memory);
  else
    for (const Event& event : events_) memory_.records[event.name] = {};
}

void EventWatch::set_curve(Stepper& stepper, Measure measure) {
  stepper_ = &stepper;
  measure_ = std::move(measure);
}

std::optional<RunEnd> EventWatch::watch(const RunMoment& moment) {
  if (end_) return end_;
  const auto count = static_cast<Index>(events_.size());
  const std::set<long> behind = std::exchange(memory_.behind, {});
  std::vector<Zero> zeros;
  try {
    for (std::size_t i = 0; moment.k > 0 && i < events_.size(); ++i) {
      const double after = moment.row[first_ + static_cast<Index>(i)];
      if (behind.contains(static_cast<long>(i))) {
        if (const auto back = events_[i].is_beyond(after) ? side_before(i, moment) : std::nullopt)
          zeros.push_back(locate(i, *back, moment));
        continue;
      }
      const double before = memory_.values[static_cast<Index>(i)];
      if (events_[i].is_between(before, after)) zeros.push_back(locate(i, {0.0, before}, moment));
    }
  } catch (const std::runtime_error& error) {
    return end_ = cannot_locate(moment, error);
  } catch (const std::domain_error& error) {
    return end_ = cannot_locate(moment, error);
  }
  VectorXd sides = std::exchange(memory_.values, moment.row.segment(first_, count));
  std::stable_sort(zeros.begin(), zeros.end(), [&](const Zero& a, const Zero& b) {
    return moment.step.h > 0.0 ? a.t < b.t : b.t < a.t;
  });
  for (Zero& zero : zeros) {
    take(zero);
    sides[static_cast<Index>(zero.event)] = memory_.values[static_cast<Index>(zero.event)];
    if (events_[zero.event].sets()) {
      memory_.values = sides;  // what has not passed a zero yet may pass it there
      reset_ = Reset{zero.event, std::move(zero.part), std::move(zero.row)};
      return std::nullopt;
    }
    if (!events_[zero.event].stops) continue;
    stop_ = Stop{events_[zero.event].name, zero.t, std::move(zero.row), std::move(zero.part)};
    return end_ = RunEnd{RunStatus::completed, ""};
  }
  return std::nullopt;
}

std::optional<EventWatch::Reset> EventWatch::go_on_behind(const Reset& reset, const VectorXd& row,
                                                          Stepper& way) {
  stepper_ = &way;
  const VectorXd before = std::exchange(memory_.values, row.segment(first_, std::ssize(events_)));
  memory_.behind.insert(static_cast<long>(reset.event));
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const auto place = static_cast<Index>(i);
    if (i == reset.event || !events_[i].is_between(before[place], memory_.values[place])) continue;
    take({i, reset.step.after.t, row, reset.step});
    if (events_[i].sets()) return Reset{i, reset.step, row};
  }
  return std::nullopt;
}

std::optional<EventWatch::From> EventWatch::side_before(std::size_t event,
                                                        const RunMoment& moment) {
  // Its quantity is zero where the step begins, to round-off, so its sign there says nothing.
  constexpr int halvings = 20;
  const Index column = first_ + static_cast<Index>(event);
  const double after = moment.row[column];
  double s = 1.0;
  for (int k = 0; k < halvings; ++k) {
    s /= 2.0;
    const double value = measure_(stepper_->part(s))[column];
    if (value * after < 0.0) return From{s, value};
  }
  return std::nullopt;
}

EventWatch::Zero EventWatch::locate(std::size_t event, From from, const RunMoment& moment) {
  const Index column = first_ + static_cast<Index>(event);
  const double after = moment.row[column];
  if (after == 0.0) return {event, moment.t, moment.row, moment.step};
  Zero nearest{event, moment.t, moment.row, moment.step};
  double least = std::fabs(after);
  const auto value = [&](double s) {
    const Step part = stepper_->part(s);
    const VectorXd& row = measure_(part);
    if (std::fabs(row[column]) < least) {
      least = std::fabs(row[column]);
      nearest = {event, part.after.t, row, part};
    }
    return row[column];
  };
  bracketed_root(value, {from.s, 1.0}, from.value, after, kBracket, kMaxEvaluations);
  return nearest;
}

void EventWatch::take(const Zero& zero) {
  const std::string& name = events_[zero.event].name;
  EventRecord& record = memory_.records[name];
  ++record.count;
  if (record.count == 1) record.first = zero.t;
  record.last = zero.t;
  tell_(name, zero.t, zero.row);
  const auto kept = kept_.find(name);
  if (kept == kept_.end() || !kept->second.contains(record.count)) return;
  auto& quantities = record.occurrences[record.count];
  quantities["t"] = zero.t;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    quantities[columns_[i]] = zero.row[static_cast<Index>(i)];
}

}  // namespace courant
