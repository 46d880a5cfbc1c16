#include "courant/running/left_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/integrators/step/vector_field.hpp"

namespace courant {
namespace {

constexpr Index kMostCoordinates = 500;

// A constraint that is this part of its terms is not met. A product of d coordinates counts d times, so
// that for d = 6 this is a fifth of it. Constraints that a method meets up to its order are left 10⁻⁴ of
// their terms in the steps that people take.
constexpr double kPartOfTerms = 0.03;
// Below this part of the terms of another one it may be round-off; a coordinate below this part of the
// largest one is measured by that part.
constexpr double kSmallPart = 1e-6;

// What methods leave of constraints by their order is said where it does not fall with the step, above this part of the
// terms, and where the run can be made again in so much work.
constexpr double kPartByOrder = 1e-4, kNotFalling = 0.6;
constexpr double kMostWorkAgain = 1e5;

// Of a coordinate, for slopes.
constexpr double kPartForSlopes = 1e-6;

// An error a (-1)^k has second differences of 4 a; a = 1/20 of the way of a coordinate is seen.
constexpr double kPartOfWay = 0.2;
// A way below this part of the largest coordinate may be round-off.
constexpr double kLeastWay = 1e-8;
constexpr double kLeastOfOthers = 1e-2;
// A velocity or an unknown below this part of its terms may be round-off: that of coordinates, which is multiplied where steps ring.
constexpr double kLeastOfUnwritten = 1e-8;

// Some columns c of a row at a state and Σ_j |∂c_i/∂x_j| s_j there; empty where they are not defined.
struct MeasuredColumns {
  VectorXd value = {}, terms = {};
};

using Measured = std::function<VectorXd(const State&)>;

MeasuredColumns columns_at(const Measured& value, const State& state, const VectorXd& size) {
  try {
    MeasuredColumns result{value(state), {}};
    result.terms = VectorXd::Zero(result.value.size());
    State moved = state;
    for (Index j = 0; j < size.size(); ++j) {
      moved.x[j] += kPartForSlopes * size[j];
      result.terms += (value(moved) - result.value).cwiseAbs() / kPartForSlopes;
      moved.x[j] = state.x[j];
    }
    if (result.terms.allFinite()) return result;
  } catch (const std::domain_error&) {  // of what is not defined there nothing is said
  }
  return {};
}

MeasuredColumns columns_at(Observer& observer, const State& state, const VectorXd& size,
                           Index first, Index count) {
  return columns_at(
      [&](const State& at) -> VectorXd { return observer.row(at).segment(first, count); }, state,
      size);
}

MeasuredColumns constraints_at(Observer& observer, const State& state, const VectorXd& size) {
  return columns_at(observer, state, size, static_cast<Index>(observer.first_constraint()),
                    static_cast<Index>(observer.constraint_count()));
}

// The first that is not met, or -1.
Index not_met(const VectorXd& value, const VectorXd& terms) {
  for (Index i = 0; i < value.size(); ++i)
    if (std::fabs(value[i]) > std::max(kPartOfTerms * terms[i], kSmallPart * terms.maxCoeff()))
      return i;
  return -1;
}

std::string left_sentence(Index i, const std::string& words, double terms) {
  return "constraint[" + std::to_string(i) + "] " + words + ", its terms " + number_text(terms, 3) +
         ": the run has left the constraints, and the trajectory may be wrong.";
}

}  // namespace

std::string left_constraints(Observer& observer, const QuantityStatistics& statistics,
                             const State& start, const State& end) {
  const Index n = end.x.size(), count = static_cast<Index>(observer.constraint_count());
  if (n == 0 || n > kMostCoordinates || count == 0 || statistics.empty()) return "";
  const QuantityStatistics::Memory& all = statistics.memory();
  VectorXd size = all.min.head(n).cwiseAbs().cwiseMax(all.max.head(n).cwiseAbs());
  size = size.cwiseMax(kSmallPart * size.maxCoeff());
  const MeasuredColumns last = constraints_at(observer, end, size);
  if (last.value.size() == 0) return "";
  if (const Index i = not_met(last.value, last.terms); i >= 0)
    return left_sentence(i, "is " + number_text(last.value[i]) + " at the end", last.terms[i]);

  const MeasuredColumns first = constraints_at(observer, start, size);
  if (first.value.size() == 0) return "";
  const auto column = static_cast<Index>(observer.first_constraint());
  const VectorXd greatest =
      all.min.segment(column, count).cwiseAbs().cwiseMax(all.max.segment(column, count).cwiseAbs());
  const VectorXd terms = first.terms.cwiseMax(last.terms);
  const Index i = not_met(greatest, terms);
  return i < 0
             ? ""
             : left_sentence(i, "was up to " + number_text(greatest[i]) + " on the way", terms[i]);
}

std::string kept_violation(const Integrator& integrator, Observer& observer,
                           const QuantityStatistics& statistics, const State& start,
                           const State& end, const StepsOfRun& run) {
  const Index n = end.x.size(), count = static_cast<Index>(observer.constraint_count());
  constexpr long both_parts = 3 + 9;
  if (n == 0 || count == 0 || run.steps == 0 || statistics.empty() ||
      static_cast<double>(both_parts * run.steps * n) > kMostWorkAgain)
    return "";
  const QuantityStatistics::Memory& all = statistics.memory();
  VectorXd size = all.min.head(n).cwiseAbs().cwiseMax(all.max.head(n).cwiseAbs());
  size = size.cwiseMax(kSmallPart * size.maxCoeff());
  const MeasuredColumns last = constraints_at(observer, end, size);
  if (last.value.size() == 0) return "";
  Index i = 0;
  const double part =
      (last.value.cwiseAbs().array() / last.terms.array().max(kSmallPart * last.terms.maxCoeff()))
          .maxCoeff(&i);
  if (!(part > kPartByOrder)) return "";
  double before = std::fabs(last.value[i]);
  try {
    for (const int parts : {3, 9}) {
      const State again = integrator.advance(start, run.h / parts, parts * run.steps);
      const double now =
          std::fabs(observer.row(again)[static_cast<Index>(observer.first_constraint()) + i]);
      if (!(now > kNotFalling * before)) return "";
      before = now;
    }
  } catch (const std::runtime_error&) {  // shorter steps that cannot be made say nothing
    return "";
  } catch (const std::domain_error&) {
    return "";
  }
  return "constraint[" + std::to_string(i) + "] is " + number_text(last.value[i]) +
         " at the end, and with steps of a ninth it is " + number_text(before) +
         ": the method does not converge for this system, and the trajectory may be wrong.";
}

namespace {

// Of an alternating row of five numbers half the least second difference, else 0.
double alternating(const VectorXd& x) {
  const VectorXd d = x.tail(3) - 2.0 * x.segment(1, 3) + x.head(3);
  return d[0] * d[1] < 0 && d[1] * d[2] < 0 ? d.cwiseAbs().minCoeff() : 0.0;
}

std::string to_and_fro(const std::string& name, double by, const char* advice) {
  return name + " goes to and fro with each step, by " + number_text(by / 2, 3) +
         " at the end: the steps do not resolve it, and the trajectory may be wrong. " + advice;
}

constexpr const char* kDamp =
    "\"damping\": \"l-stable\" of the method damps what the steps do not resolve.";

// What the field has at states: ẋ, then z.
class RatesAndUnknowns {
 public:
  RatesAndUnknowns(const ImplicitSystem& system, const VectorField& field) : evaluate_(field) {
    for (const std::string& name : system.names().coordinates) names_.push_back(name + "'");
    for (const std::string& name : system.names().auxiliary) names_.push_back(name);
  }

  VectorXd at(const State& state) {
    evaluate_(state, rate_);
    VectorXd both(rate_.size() + evaluate_.z().size());
    both << rate_, evaluate_.z();
    return both;
  }
  const std::string& name(Index j) const { return names_[static_cast<std::size_t>(j)]; }

 private:
  VectorField::Evaluation evaluate_;
  VectorXd rate_;
  std::vector<std::string> names_;
};

std::string unwritten_alternation(const Integrator& integrator, const ConstraintLadder& ladder,
                                  const std::vector<State>& states, const VectorXd& size) {
  constexpr Index most_coordinates = 60;
  const auto& system = integrator.system();
  if (size.size() > most_coordinates || ladder.verdict != Verdict::regular) return "";
  // Beside constraints a field is one of many extensions.
  if (ladder.degrees_of_freedom != system->manifold()->dimension()) return "";
  try {
    const VectorField field(system, ladder, Backend::interpreter);
    RatesAndUnknowns measured(*system, field);
    MatrixXd x(0, 0);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const VectorXd column = measured.at(states[k]);
      if (k == 0) x.resize(column.size(), std::ssize(states));
      x.col(static_cast<Index>(k)) = column;
    }
    std::optional<MeasuredColumns> columns;
    for (Index j = 0; j < x.rows(); ++j) {
      const double largest = x.row(j).cwiseAbs().maxCoeff(), by = alternating(x.row(j).transpose());
      if (!(by > kPartOfWay * largest)) continue;
      // What terms cancel in, or what has decayed, has their round-off.
      if (!columns)
        columns = columns_at([&](const State& at) { return measured.at(at); }, states.back(), size);
      if (columns->terms.size() == 0 || !(largest > kLeastOfUnwritten * columns->terms[j]))
        continue;
      return to_and_fro(measured.name(j), by, kDamp);
    }
  } catch (const std::runtime_error&) {  // of what is not defined there nothing is said
  } catch (const std::domain_error&) {
  }
  return "";
}

}  // namespace

std::string alternation(const Integrator& integrator, Observer& observer,
                        const QuantityStatistics& statistics, State end, double h,
                        const ConstraintLadder* field) {
  const Index n = end.x.size();
  if (n == 0 || n > kMostCoordinates || statistics.empty()) return "";
  const auto count = static_cast<Index>(observer.first_constraint());
  const QuantityStatistics::Memory& all = statistics.memory();
  constexpr int steps = 4;
  MatrixXd x(count, steps + 1);
  std::vector<State> states;
  const auto look = [&](int k) {
    x.col(k) = observer.row(end).head(count);
    states.push_back(end);
  };
  try {
    look(0);
    const auto stepper = integrator.stepper();
    const double t = end.t;
    for (int k = 1; k <= steps; ++k) {
      stepper->step(end, h, t + k * h);
      look(k);
    }
  } catch (const std::runtime_error&) {  // the run ends here
    return "";
  } catch (const std::domain_error&) {
    return "";
  }
  const VectorXd way = (all.max - all.min).head(count);
  VectorXd size = x.cwiseAbs().rowwise().maxCoeff();
  size.head(n).setConstant(size.head(n).maxCoeff());
  for (Index j = 0; j < count; ++j) {
    const double least = j < n ? kLeastWay : kLeastOfOthers;
    if (!(way[j] > least * size[j])) continue;
    const double by = alternating(x.row(j).transpose());
    if (!(by > kPartOfWay * way[j])) continue;
    // What terms cancel in, as a conserved quantity is zero, has their round-off.
    if (j >= n) {
      const VectorXd terms = columns_at(observer, end, size.head(n), j, 1).terms;
      if (terms.size() == 0 || !(way[j] > kLeastWay * terms[0])) continue;
    }
    return to_and_fro(observer.names()[static_cast<std::size_t>(j)], by,
                      j < n ? "Constrain-first has no such errors of algebraic equations." : kDamp);
  }
  if (!field) return "";
  // The largest that coordinates were in the run.
  const VectorXd largest = all.max.head(n).cwiseMax(-all.min.head(n)).cwiseAbs();
  return unwritten_alternation(integrator, *field, states, largest);
}

}  // namespace courant
