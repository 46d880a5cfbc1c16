#include "courant/running/study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/reading/substepping.hpp"
#include "courant/reading/transformed_time.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/start_moves.hpp"

namespace courant {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kMostMoments = 1000;

// The study is interrupted.
struct Stopped {};

// A run: the states at some moments, how many steps it made, and what it cost.
struct Flight {
  std::vector<State> states;
  long steps = 0;
  SolverStatistics work;
  double seconds = 0.0;
};

// Where and how a subject starts, and which of its quantities are looked at.
class StudiedProblem {
 public:
  StudiedProblem(const StudySubject& subject, const StudyOptions& options)
      : subject_(subject),
        options_(options),
        ladder_(start_of_run(experiment())),
        observer_(experiment(), ladder_, options.backend) {
    if (!experiment().method || !experiment().time)
      throw ExperimentError("/method", "is missing; a study is one of a method and its steps");
    if (experiment().boundary)
      throw ExperimentError(
          "/boundary",
          "is not solved by a study; expected an experiment without, such as the "
          "one that a run writes, whose initial values are those of the solution");
    const TimeSpan& time = *experiment().time;
    if (const std::optional<std::string> place = place_of_resets(experiment().events))
      throw ExperimentError(*place,
                            "is done by a run; a study compares methods between jumps; expected "
                            "events that set nothing");
    if (time.steps == 0) throw ExperimentError("/time/end", "is the start; expected a later time");
    stride_ = time.is_transformed() ? 1 : (time.steps + kMostMoments - 1) / kMostMoments;
    choose_quantities();
  }

  const Experiment& experiment() const { return subject_.experiment; }
  const std::vector<std::string>& quantities() const { return quantities_; }
  bool has_closed_form() const { return !deviations_.empty(); }

  PreparedMethod prepare(const MethodChoice& method, double step) const {
    return method.prepare({.system = experiment().model.system,
                           .ladder = ladder_,
                           .initial = ladder_.point,
                           .step = step,
                           .backend = options_.backend,
                           .vocabulary = &experiment().model.vocabulary});
  }

  // The run with each step cut in `parts`.
  Flight fly(const MethodChoice& choice, long parts) const {
    const TimeSpan& time = *experiment().time;
    const double h = time.step / static_cast<double>(parts);
    const PreparedMethod method = prepare(choice, h);
    const auto stepper = method.integrator->stepper();
    State state = method.initial;
    Flight flight;
    const auto begin = Clock::now();
    stepper->prepare(state, h);
    if (time.is_transformed()) {
      flight.states.push_back(end_in_time(*stepper, state, h));
      flight.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      flight.work = stepper->statistics();
      flight.steps = flight.work.steps;
      return flight;
    }
    flight.steps = time.steps * parts;
    for (long k = 0; k < time.steps; ++k) {
      for (long part = 1; part <= parts; ++part) {
        const double end =
            part == parts ? time.time(k + 1) : time.time(k) + static_cast<double>(part) * h;
        stepper->step(state, h, end);
        if (options_.stop && *options_.stop) throw Stopped();
      }
      if ((k + 1) % stride_ == 0 || k + 1 == time.steps) flight.states.push_back(state);
    }
    flight.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    flight.work = stepper->statistics();
    return flight;
  }

  // The quantities at the moments of a flight, one a column.
  MatrixXd values(const Flight& flight) { return rows(flight, columns_); }
  // How far they are from their closed forms.
  MatrixXd deviations(const Flight& flight) { return rows(flight, deviations_); }

 private:
  // In transformed time the one moment is the end of the run.
  State end_in_time(Stepper& stepper, State& state, double h) const {
    const double end = experiment().time->until;
    while (state.t < end) {
      stepper.step(state, h);
      if (options_.stop && *options_.stop) throw Stopped();
    }
    return stepper.between(stepper.share_at(end));
  }

  void choose_quantities() {
    const auto& names = observer_.names();
    const auto& forms = experiment().expect.deviations;
    const auto form_of = [&](const std::string& quantity) {
      return std::ranges::find(forms, quantity, &Expectations::Deviation::quantity);
    };
    const std::vector<std::string> sensitivities = experiment().sensitivities
                                                       ? experiment().sensitivities->columns()
                                                       : std::vector<std::string>();
    const auto is_of_map = [&](const std::string& quantity) {
      return std::ranges::find(experiment().defects, quantity, column_of) !=
                 experiment().defects.end() ||
             std::ranges::find(sensitivities, quantity) != sensitivities.end();
    };
    quantities_ = options_.quantities;
    if (quantities_.empty())
      for (const auto& form : forms)
        if (std::ranges::find(quantities_, form.quantity) == quantities_.end() &&
            !is_of_map(form.quantity))
          quantities_.push_back(form.quantity);
    if (quantities_.empty())
      quantities_.assign(names.begin(),
                         names.begin() + static_cast<std::ptrdiff_t>(observer_.coordinate_count()));
    const auto column = [&](const std::string& name) {
      const auto found = std::ranges::find(names, name);
      const std::vector<std::string> written(
          names.begin(), names.begin() + static_cast<std::ptrdiff_t>(observer_.first_constraint()));
      if (is_of_map(name))
        throw ExperimentError("--of " + name,
                              "is no function of the state, whose error a study "
                              "measures; expected a coordinate, H or an observable");
      if (found == names.end())
        throw ExperimentError("--of " + name, "there is no such quantity" +
                                                  did_you_mean(name, written) +
                                                  "; expected a coordinate, H or an observable");
      return found - names.begin();
    };
    bool all = true;
    for (const std::string& quantity : quantities_) {
      columns_.push_back(column(quantity));
      if (const auto form = form_of(quantity); form != forms.end())
        deviations_.push_back(column(form->name));
      else
        all = false;
    }
    if (!all) deviations_.clear();
  }

  MatrixXd rows(const Flight& flight, const std::vector<Index>& columns) {
    MatrixXd found(static_cast<Index>(columns.size()), static_cast<Index>(flight.states.size()));
    for (Index j = 0; j < found.cols(); ++j) {
      const VectorXd& row = observer_.row(flight.states[static_cast<std::size_t>(j)]);
      for (Index i = 0; i < found.rows(); ++i)
        found(i, j) = row[columns[static_cast<std::size_t>(i)]];
    }
    return found;
  }

  const StudySubject& subject_;
  const StudyOptions& options_;
  ConstraintLadder ladder_;
  Observer observer_;
  long stride_ = 1;
  std::vector<std::string> quantities_;
  std::vector<Index> columns_, deviations_;  // in the rows of the observer
};

double greatest_norm(const MatrixXd& columns) {
  double greatest = 0.0;
  for (Index j = 0; j < columns.cols(); ++j) {
    const double norm = columns.col(j).norm();
    if (!(norm <= greatest)) greatest = norm;  // NaN stays
  }
  return greatest;
}

// What is true, as far as it is known.
struct Truth {
  std::string words;
  double error = 0.0;
  MatrixXd values;           // none: closed form
  std::optional<int> order;  // of the method; none: closed form
};

// A method that references are made by, and its order.
struct ReferenceMethod {
  MethodChoice choice;
  int order;

  std::string words(const std::string& step) const {
    return choice.description + ", order " + std::to_string(order) + ", at the step " + step;
  }
};

// The explicit method of order 8, or, where there is no vector field, the one that is studied.
ReferenceMethod reference_method(const StudiedProblem& problem) {
  const TimeSpan& time = *problem.experiment().time;
  const auto with_order = [&](MethodChoice choice) {
    const int order = problem.prepare(choice, time.step).integrator->order();
    return ReferenceMethod{std::move(choice), order};
  };
  const Json word = "rkf78";
  Findings findings;
  auto choice = method_kinds().read(JsonReader(word, "/method", findings));
  findings.require_clean();
  if (time.rate) choice = in_transformed_time(std::move(*choice), *time.rate);
  if (time.division) choice = with_substeps(std::move(*choice), *time.division);
  try {
    return with_order(std::move(*choice));
  } catch (const std::invalid_argument&) {  // no vector field
    return with_order(*problem.experiment().method);
  }
}

// Runs at ever shorter steps, until that changes the values no more than round-off does: of all,
// the one that differs least from the one before, by which it may be off.
Truth by_run(StudiedProblem& problem, const StudyOptions& options) {
  constexpr double enough = 1e-14, small = 1e-10;  // of the size of the values
  constexpr long most_steps = 2'000'000;           // of the last run
  const Experiment& experiment = problem.experiment();
  const ReferenceMethod method = reference_method(problem);
  long steps = experiment.time->is_transformed() ? 0 : experiment.time->steps;
  const auto run = [&](long parts) {
    const std::string step = number_text(experiment.time->step / static_cast<double>(parts));
    if (options.on_progress)
      options.on_progress("reference by " + method.choice.description + ", step " + step);
    const Flight flight = problem.fly(method.choice, parts);
    steps = flight.steps / parts;
    return Truth{method.words(step), 0.0, problem.values(flight), method.order};
  };
  long parts = 2;
  // Long steps may not be possible where shorter ones are.
  const auto first_possible = [&] {
    for (;; parts *= 2) try {
        return run(parts);
      } catch (const std::exception&) {
        if (4 * parts * steps > most_steps || parts > (1L << options.steps)) throw;
      }
  };
  Truth before = first_possible(), best;
  for (bool first = true; 2 * parts * steps <= most_steps || first; first = false) {
    parts *= 2;
    Truth finer = run(parts);
    const double size = greatest_norm(finer.values);
    finer.error = greatest_norm(finer.values - before.values);
    const bool is_round_off = !first && best.error <= small * size && finer.error > best.error / 2;
    if (first || finer.error < best.error) best = finer;
    if (is_round_off || finer.error <= enough * size) break;
    before = std::move(finer);
  }
  return best;
}

Truth reference_for(StudiedProblem& problem, const StudyOptions& options) {
  if (problem.has_closed_form()) return {"closed form", 0.0, {}, {}};
  return by_run(problem, options);
}

// A run at one step size, made again where it is too short for a clock.
Flight timed(const StudiedProblem& problem, long parts) {
  constexpr double long_enough = 0.02;  // seconds
  constexpr int most = 5;
  const MethodChoice& method = *problem.experiment().method;
  Flight flight = problem.fly(method, parts);
  for (int i = 1; i < most && flight.seconds < long_enough; ++i)
    flight.seconds = std::min(flight.seconds, problem.fly(method, parts).seconds);
  return flight;
}

using Row = StudyReport::Row;

// What a step size has for each quantity: its greatest error, and its greatest size.
struct OfQuantities {
  double step;
  VectorXd errors, sizes;
};

// The slope of log(error) over log(step) at the four smallest steps with an error above `floor`.
std::optional<double> fitted_order(const std::vector<Row>& rows, double floor) {
  std::vector<std::pair<double, double>> points;
  for (auto row = rows.rbegin(); row != rows.rend() && points.size() < 4; ++row)
    if (row->error > floor) points.emplace_back(std::log(row->step), std::log(row->error));
  if (points.size() < 3) return std::nullopt;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto count = static_cast<double>(points.size());
  for (const auto& [log_step, log_error] : points) x += log_step / count, y += log_error / count;
  for (const auto& [log_step, log_error] : points) {
    xx += (log_step - x) * (log_step - x);
    xy += (log_step - x) * (log_error - y);
  }
  return xy / xx;
}

// The order of each quantity by itself, above round-off of its own size and what the reference may be off by.
std::vector<std::optional<double>> orders_of(const std::vector<OfQuantities>& steps, Index count,
                                             double reference_error) {
  std::vector<std::optional<double>> orders;
  for (Index i = 0; i < count; ++i) {
    std::vector<Row> rows;
    double size = 0.0;
    for (const OfQuantities& of : steps) {
      rows.push_back({.step = of.step, .error = of.errors[i]});
      size = std::max(size, of.sizes[i]);
    }
    orders.push_back(fitted_order(rows, std::max(10.0 * reference_error, 1e-12 * size)));
  }
  return orders;
}

std::string remark_on(const std::vector<Row>& rows, const std::optional<double>& order,
                      double floor) {
  if (std::ranges::any_of(rows, [](const Row& row) { return std::isnan(row.error); }))
    return "Not every step could be made.";
  if (!order)
    return rows.back().error <= floor
               ? "Too few errors are above those of the reference and round-off for an order."
               : "";
  if (*order < 0.5)
    return "The error does not fall with the step: the reference is not the solution, or the "
           "method does not converge.";
  return "";
}

// Of a quantity whose order is lower than that of all together, which larger errors hide.
std::string remark_on_quantities(const std::vector<std::string>& quantities,
                                 const std::vector<std::optional<double>>& orders,
                                 const std::optional<double>& order) {
  constexpr double lower = 0.5;
  std::string names;
  for (std::size_t i = 0; i < orders.size(); ++i)
    if (order && orders[i] && *orders[i] < *order - lower)
      names +=
          (names.empty() ? "" : ", ") + quantities[i] + " (" + number_text(*orders[i], 3) + ")";
  return names.empty() ? "" : "Of a lower order than all together: " + names + ".";
}

StudyReport::Method method_report(const StudySubject& subject, const StudiedProblem& problem,
                                  const Truth& reference, std::vector<Row> rows, double size,
                                  const std::vector<OfQuantities>& by_quantity) {
  const double floor = std::max(10.0 * reference.error, 1e-12 * size);
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i - 1].error > floor && rows[i].error > floor)
      rows[i].order =
          std::log(rows[i - 1].error / rows[i].error) / std::log(rows[i - 1].step / rows[i].step);
  const std::optional<double> order = fitted_order(rows, floor);
  const std::vector<std::string>& quantities = problem.quantities();
  auto orders = orders_of(by_quantity, std::ssize(quantities), reference.error);
  std::string remark = remark_on(rows, order, floor);
  if (remark.empty()) remark = remark_on_quantities(quantities, orders, order);
  return {.experiment = subject.name,
          .method = problem.experiment().method->description,
          .quantities = problem.quantities(),
          .reference = reference.words,
          .reference_order = reference.order,
          .reference_error = reference.error,
          .order = order,
          .orders = std::move(orders),
          .remark = std::move(remark),
          .rows = std::move(rows)};
}

// What has to be the same for two subjects to have the same reference.
std::string problem_of(const Experiment& experiment) {
  Json parts = Json::object();
  for (const char* key :
       {"system", "initial", "hold", "start", "weights", "nominal", "time", "observe", "expect"})
    parts[key] = experiment.document.value(key, Json());
  return parts.dump();
}

StudyReport::Method study_of(const StudySubject& subject, const StudyOptions& options,
                             std::map<std::string, Truth>& references) {
  StudiedProblem problem(subject, options);
  const std::string key = problem_of(subject.experiment);
  if (!references.contains(key)) references[key] = reference_for(problem, options);
  const Truth& reference = references[key];
  std::vector<Row> rows;
  std::vector<OfQuantities> by_quantity;
  double size = greatest_norm(reference.values);
  for (int i = 0; i < options.steps; ++i) {
    const long parts = 1L << i;
    Row row;
    row.step = subject.experiment.time->step / static_cast<double>(parts);
    if (!subject.experiment.time->is_transformed())
      row.steps = subject.experiment.time->steps * parts;
    if (options.on_progress)
      options.on_progress(subject.experiment.method->description + ", step " +
                          number_text(row.step));
    try {
      const Flight flight = timed(problem, parts);
      const MatrixXd values = problem.values(flight);
      const MatrixXd errors =
          problem.has_closed_form() ? problem.deviations(flight) : values - reference.values;
      row.error = greatest_norm(errors);
      by_quantity.push_back({row.step, errors.cwiseAbs().rowwise().maxCoeff(),
                             values.cwiseAbs().rowwise().maxCoeff()});
      row.steps = flight.steps;
      row.iterations = flight.work.iterations;
      row.factorizations = flight.work.factorizations;
      row.seconds = flight.seconds;
      size = std::max(size, greatest_norm(values));
    } catch (const ExperimentError&) {  // has its own place
      throw;
    } catch (const std::invalid_argument& error) {
      throw ExperimentError("/method", without_place(error.what()));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      row.message = without_place(error.what());
    }
    rows.push_back(row);
  }
  return method_report(subject, problem, reference, std::move(rows), size, by_quantity);
}

}  // namespace

StudyReport study(std::span<const StudySubject> subjects, const StudyOptions& options) {
  StudyReport report;
  std::map<std::string, Truth> references;
  try {
    for (const StudySubject& subject : subjects) {
      report.methods.push_back(study_of(subject, options, references));
      if (options.on_method) options.on_method(report.methods.back());
    }
  } catch (const Stopped&) {
    report.is_interrupted = true;
  }
  return report;
}

}  // namespace courant
