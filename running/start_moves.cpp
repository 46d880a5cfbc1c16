#include "courant/running/start_moves.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
namespace {

// A unit of the last digit with which a number is written; infinite for whole numbers, which say nothing of digits.
double last_digit(double number) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (number == std::round(number)) return none;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::scientific);
  const std::string_view written(text, static_cast<std::size_t>(end.ptr - text));
  const std::size_t mark = written.find('e');
  const std::size_t point = written.find('.');
  int digits = point == std::string_view::npos ? 0 : static_cast<int>(mark - point - 1);
  int exponent = 0;
  const char* first = text + mark + 1;
  if (*first == '+') ++first;
  std::from_chars(first, end.ptr, exponent);
  return std::pow(10.0, exponent - digits);
}

struct GivenPart {
  std::string name;
  bool may_move;  // unknowns, quantities
  std::vector<std::string> names;
  std::vector<double> given, found;

  double size() const { return norm(given); }
  double moved() const {
    std::vector<double> by(given.size());
    std::ranges::transform(given, found, by.begin(), std::minus<>());
    return norm(by);
  }
  // As much as the digits leave open, those of the finest number for all.
  double rounding() const {
    double least = std::numeric_limits<double>::infinity();
    for (const double number : given) least = std::min(least, last_digit(number));
    return std::isfinite(least)
               ? std::max(round_off(), 2.0 * least * std::sqrt(static_cast<double>(given.size())))
               : round_off();
  }
  // Zeros alone have no size: they are measured by 1.
  double round_off() const { return size() > 0.0 ? 1e-9 * (size() + norm(found)) : 1e-15; }
  // The numbers that moved most, in words; not those that moved by round-off next to these.
  std::string largest() const {
    constexpr std::size_t most = 3;
    constexpr double negligible = 1e-12;  // of the whole move
    std::vector<std::size_t> order(given.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto by = [&](std::size_t i) { return -std::fabs(found[i] - given[i]); };
    std::ranges::stable_sort(order, {}, by);
    const double least = negligible * moved();
    std::string text;
    for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
      const std::size_t i = order[k];
      if (!(std::fabs(found[i] - given[i]) > least)) break;
      text += (text.empty() ? "" : ", ") + names[i] + " from " + number_text(given[i], 6) + " to " +
              number_text(found[i], 6);
    }
    return text + (order.size() > most ? ", …" : "");
  }

 private:
  static double norm(const std::vector<double>& numbers) {
    return Eigen::Map<const VectorXd>(numbers.data(), std::ssize(numbers)).norm();
  }
};

std::vector<GivenPart> parts_of(const Experiment& experiment, const ConstraintLadder& ladder) {
  const ImplicitSystem& system = *experiment.model.system;
  const InitialValues& initial = experiment.initial;
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system.manifold());
  const Index N = system.manifold()->ambient_dimension();
  const Index positions = bundle ? bundle->base()->ambient_dimension() : N;
  std::vector<GivenPart> kinds = {{bundle ? "positions" : "coordinates", false, {}, {}, {}},
                                  {"momenta", false, {}, {}, {}},
                                  {"velocities", false, {}, {}, {}},
                                  {"unknowns", true, {}, {}, {}}};
  const auto add = [](GivenPart& kind, const PartialVector& given, const VectorXd& found, Index i,
                      const std::string& name) {
    if (!given.given[i]) return;
    kind.names.push_back(name);
    kind.given.push_back(given.values[i]);
    kind.found.push_back(found[i]);
  };
  const auto& coordinates = system.names().coordinates;
  const VectorXd rates = initial.velocity.given.any()
                             ? VectorXd(system.manifold()->frame(ladder.point.x) * ladder.point.v)
                             : VectorXd(VectorXd::Zero(N));
  for (Index i = 0; i < N; ++i) {
    const std::string& name = coordinates[static_cast<std::size_t>(i)];
    add(kinds[i < positions ? 0 : 1], initial.x, ladder.point.x, i, name);
    add(kinds[2], initial.velocity, rates, i, name + "'");
  }
  for (Index i = 0; i < initial.z.given.size(); ++i)
    add(kinds[3], initial.z, ladder.point.z, i,
        system.names().auxiliary[static_cast<std::size_t>(i)]);
  // Quantities have units of their own, each. They are what coordinates that are not given are chosen by, and give way
  // where all are given. A zero is measured by 1, as the sum of others that it is.
  constexpr double zero = 1e-9;
  for (const GivenQuantity& quantity : initial.quantities) {
    const std::string& name = quantity.formula.text;
    const auto move = std::ranges::find(ladder.moves, name, &Movement::name);
    if (move == ladder.moves.end() || (quantity.value == 0.0 && std::fabs(move->to) <= zero))
      continue;
    kinds.push_back({"value of " + name, true, {name}, {move->from}, {move->to}});
  }
  return kinds;
}

// Where a search for a start did not end next to the given values, what it came to is no start.
std::string lost(const Experiment& experiment, const ConstraintLadder& ladder) {
  constexpr double far = 1.0;
  const ImplicitSystem& system = *experiment.model.system;
  if (ladder.verdict != Verdict::not_reached || experiment.document.contains("start") ||
      ladder.point.x.size() != system.manifold()->ambient_dimension() ||
      ladder.point.v.size() != system.manifold()->tangent_dimension() ||
      ladder.point.z.size() != system.auxiliary_size())
    return "";
  for (const GivenPart& kind : parts_of(experiment, ladder))
    if (!kind.may_move && kind.size() > 0.0 && kind.moved() > far * kind.size())
      return "no consistent start was found: the search for one left the initial " + kind.name +
             " by " + number_text(kind.moved(), 3) + ", of " + number_text(kind.size(), 3) + " (" +
             kind.largest() + "); expected values near a consistent start";
  return "";
}

}  // namespace

StartMoves start_moves(const Experiment& experiment, const ConsistentStart& ladder) {
  constexpr double far = 0.1;
  StartMoves moves;
  if (!ladder.impasse.empty())
    return {.warning = "", .refusal = ladder.impasse + "; expected others"};
  if (std::string refusal = lost(experiment, ladder); !refusal.empty())
    return {.warning = "", .refusal = std::move(refusal)};
  if (ladder.moves.empty() || ladder.is_impulse) return moves;
  const InitialValues& initial = experiment.initial;
  const bool may_move = experiment.document.contains("start") || initial.x.held.any() ||
                        initial.velocity.held.any() || initial.z.held.any();
  for (const GivenPart& kind : parts_of(experiment, ladder)) {
    const double moved = kind.moved();
    const bool is_far = moved > std::max(far * kind.size(), kind.round_off());
    const bool is_explained = !(moved > kind.rounding());  // by the digits that were typed
    if (!is_far && is_explained) continue;
    const std::string how_far = "the initial " + kind.name + " had to move by " +
                                number_text(moved, 3) + ", of " + number_text(kind.size(), 3) +
                                ", to be consistent (" + kind.largest() + ')';
    if (!may_move && !kind.may_move && is_far && !is_explained && moves.refusal.empty())
      moves.refusal = how_far +
                      "; expected values within a tenth, or \"start\": \"nearest\" beside "
                      "\"initial\", which begins there";
    moves.warning += (moves.warning.empty() ? "T" : " T") + how_far.substr(1) +
                     (is_explained ? ", which is more than a tenth, though within its digits."
                                   : ", which is more than rounding.");
  }
  if (!ladder.is_nearest)
    moves.warning += std::string(moves.warning.empty() ? "" : " ") +
                     "The start is consistent, but it was not shown to be the nearest to the "
                     "initial values.";
  return moves;
}

ConsistentStart start_of_run(const Experiment& experiment) {
  ConsistentStart ladder = consistent_start(experiment);
  if (!experiment.method) return ladder;
  const StartMoves moves = start_moves(experiment, ladder);
  if (moves.refusal.empty()) return ladder;
  // Next to the operating point of a circuit a search in digits may end far away, where unknowns are nearer to 0; by bounds
  // it stays, sure of its ladder or not.
  ConsistentStart near = consistent_start(experiment, Decider::bounds);
  if (near.verdict != Verdict::inconsistent && start_moves(experiment, near).refusal.empty())
    return near;
  throw ExperimentError("/initial", moves.refusal);
}

}  // namespace courant
