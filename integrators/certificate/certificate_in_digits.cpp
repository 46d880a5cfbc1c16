#include "courant/integrators/certificate/certificate_in_digits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/integrators/certificate/binary_scales.hpp"
#include "courant/integrators/certificate/elimination_reading.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/certificate/ladder_proof.hpp"
#include "courant/integrators/certificate/movements.hpp"
#include "courant/integrators/certificate/neighbourhood.hpp"

namespace courant {
namespace {

std::string dimensions_in_words(const std::vector<LadderLevel>& levels) {
  std::string text;
  for (const LadderLevel& level : levels)
    text += (text.empty() ? "(" : ", (") + std::to_string(level.dim_S) + "," +
            std::to_string(level.dim_M) + ")";
  return text;
}

// One certificate on its way.
class Certifier {
 public:
  Certifier(const JetEquations& equations, const InitialGuess& guess,
            const ConstraintAlgorithm::Options& options, Decider decider = Decider::digits)
      : equations_(equations),
        guess_(guess),
        max_level_(options.max_level),
        decider_(decider),
        nearest_(equations, guess, options.metric) {}

  ConstraintLadder run() {
    Jet jet = nearest_.start();
    result_.point = state_of(equations_, jet);
    for (Index k = 0; k <= max_level_; ++k) {
      const NearestJet::Found found = nearest_.find(k);
      if (!found.is_zero) {
        finish_without_point(jet, found, k);
        return std::move(result_);
      }
      jet = found.jet;
      at(jet);
      if (elimination_->dim_M(k) < 0) {
        end_at_instant(jet);
        return std::move(result_);
      }
      const bool repeats = k > 0 && elimination_->dim_S(k) == elimination_->dim_S(k - 1) &&
                           elimination_->dim_M(k) == elimination_->dim_M(k - 1);
      if (!repeats) {
        // The search for the next level may leave a singular point.
        around_.emplace(equations_, nearest_, jet, *elimination_, 1);
        if (around_->is_singular() && around_->is_transversal() && is_singular(jet))
          return std::move(result_);
        continue;
      }
      result_.index = k - 1;
      finish(jet);
      return std::move(result_);
    }
    fill_in(jet);
    if (is_singular(jet)) return std::move(result_);
    result_.reason = "The dimensions still fell at level " + std::to_string(max_level_) +
                     ", the highest allowed.";
    return std::move(result_);
  }

  // The guess with 0 for each coordinate that looks like what rounding left; nothing if none does.
  std::optional<InitialGuess> without_rounding() const {
    Jet jet = nearest_.start();
    for (Index j = 0; j < guess_.x.size(); ++j)
      jet.y[static_cast<std::size_t>(j)] = Digits::written(guess_.x[j]);
    InitialGuess result = guess_;
    for (const Index j : rounded_unknowns(equations_, jet))
      if (j < guess_.x.size()) result.x[j] = 0.0;
    if (result.x == guess_.x) return std::nullopt;
    return result;
  }

  // Whether a switch is at its edge at the last jet, and its sides are not the same there.
  bool is_at_edge() const { return is_at_edge_; }

  // Whether its sides differ there, to first order, in equations that are differentiated so often or less.
  bool has_two_sides(const std::vector<int>& differentiations) const {
    const Index rows = equations_.row_size();
    return has_two_sides(*last_, [&](Index row) {
      const auto e = static_cast<std::size_t>(row % rows);
      return e >= differentiations.size() || row / rows <= differentiations[e];
    });
  }

 private:
  void at(const Jet& jet) {
    const auto values = equations_.at(jet.t, jet.y, jet.k);
    is_at_edge_ = values.is_at_edge && has_two_sides(jet, [](Index) { return true; });
    elimination_.emplace(equations_, values, jet);
    if (is_at_edge_) last_ = jet;
  }

  // Whether a row of F^[k] of which `is_read(row)` holds has another residual or other entries on the other side.
  template <class IsRead>
  bool has_two_sides(const Jet& jet, const IsRead& is_read) const {
    const auto above = equations_.on_side(1).at(jet.t, jet.y, jet.k);
    const auto below = equations_.on_side(-1).at(jet.t, jet.y, jet.k);
    const auto differ = [](const Digits& a, const Digits& b) {
      return a.is_finite() && !(a - b).shrinks();
    };
    const std::vector<JetEquations::Entry> pattern = equations_.pattern(jet.k);
    for (std::size_t i = 0; i < above.residual.size(); ++i)
      if (differ(above.residual[i], below.residual[i]) && is_read(static_cast<Index>(i)))
        return true;
    for (std::size_t e = 0; e < pattern.size(); ++e)
      if (differ(above.entries[e], below.entries[e]) && is_read(pattern[e].row)) return true;
    return false;
  }

  // What is known of a consistent jet.
  void fill_in(const Jet& jet) {
    result_.levels = levels_of(equations_, *elimination_, jet.k);
    result_.point = state_of(equations_, jet);
    result_.jet = chart_jet(equations_, jet);
    result_.moved = nearest_.distance(jet);
    result_.moves = movements(equations_.system(), guess_, result_.point);
    result_.degrees_of_freedom = result_.levels.back().dim_M;
    result_.gauge_dimension = result_.levels.back().fibre();
  }

  void finish(const Jet& jet) {
    fill_in(jet);
    if (is_singular(jet)) return;
    result_.verdict = result_.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
    describe(result_, equations_, *elimination_, jet);
    if (decider_ == Decider::proof) result_.proof = proof(equations_, *elimination_, jet);
    result_.differentiations = differentiations(equations_, *elimination_, result_.index);
    for (const Neighbourhood::Look& look : around_->looks()) {
      const std::vector<int> there = differentiations(equations_, look.elimination, result_.index);
      for (std::size_t e = 0; e < there.size(); ++e)
        result_.differentiations[e] = std::max(result_.differentiations[e], there[e]);
    }
  }

  // Looks at neighbours of a consistent jet; says what is found.
  bool is_singular(const Jet& jet) {
    constexpr int looks = 2;
    around_.emplace(equations_, nearest_, jet, *elimination_, looks);
    if (around_->is_divided()) {
      const auto other = std::ranges::find_if(
          around_->looks(),
          [](const Neighbourhood::Look& look) { return look.is_zero && !look.has_same_ranks; });
      result_.doubts.emplace_back(
          Doubt::Kind::neighbours,
          "Some consistent points nearby have other dimensions: " +
              dimensions_in_words(levels_of(equations_, other->elimination, jet.k)) + ".");
    }
    if (!around_->is_singular()) return false;
    fill_in(jet);
    result_.verdict = Verdict::rank_change;
    result_.index = -1;
    if (!around_->is_transversal()) {
      result_.reason =
          "The equations vanish at the point to higher order: Newton's method does not square its "
          "error next to it.";
      return true;
    }
    const auto& there = *std::find_if(around_->looks().begin(), around_->looks().end(),
                                      [](const auto& look) { return look.is_zero; });
    result_.reason = "The point is singular: consistent points next to it have the dimensions " +
                     dimensions_in_words(levels_of(equations_, there.elimination, jet.k)) +
                     ", and it has " + dimensions_in_words(result_.levels) + ".";
    return true;
  }

  void finish_without_point(const Jet& before, const NearestJet::Found& found, Index k) {
    if (k > 0) {
      at(before);
      fill_in(before);
      if (is_singular(before)) return;
    }
    LadderLevel empty;
    empty.k = k;
    empty.is_empty = true;
    empty.is_solved = false;
    empty.residual = found.residual;
    const auto values = equations_.at(found.jet.t, found.jet.y, k);
    const auto are_finite = [](const std::vector<Digits>& numbers) {
      return std::all_of(numbers.begin(), numbers.end(),
                         [](const Digits& a) { return a.is_finite(); });
    };
    if (!found.is_finite || !are_finite(values.residual) || !are_finite(values.entries)) {
      result_.verdict = Verdict::not_reached;
      result_.reason =
          "A derivative of the equations is not finite at level " + std::to_string(k) + ".";
      result_.doubts.emplace_back(Doubt::Kind::search, result_.reason);
      return;
    }
    const StagedElimination elimination(equations_, values, found.jet);
    // Next to a zero in doubles what is left may be a search that did not end.
    constexpr double visible = 1e-13;
    const bool is_visible = found.is_least && (!found.was_near || found.residual > visible);
    for (const auto& row : elimination.rows()) {
      if (!is_visible || row.stage != StagedElimination::dependent || row.residual.is_zero())
        continue;
      result_.contradiction = equations_of(equations_, elimination, row);
      end_inconsistent(empty,
                       " was found near the given values: these equations contradict each other: " +
                           in_words(result_.contradiction) + ".");
      return;
    }
    if (found.was_near) {
      result_.verdict = Verdict::rank_change;
      result_.index = -1;
      result_.reason =
          "The search for a consistent point comes near one and does not square its error there: "
          "the equations vanish at it to higher order.";
      result_.doubts.emplace_back(Doubt::Kind::not_transversal, result_.reason);
      if (k == 0) {
        empty.is_empty = false;
        result_.levels.push_back(empty);
      }
      return;
    }
    if (is_visible) {
      end_inconsistent(empty,
                       " was found near the given values: the equations are violated by at least " +
                           number_text(found.residual, 3) + ".");
      return;
    }
    result_.verdict = Verdict::not_reached;
    result_.reason =
        "The search for a consistent point of level " + std::to_string(k) + " did not end.";
    result_.doubts.emplace_back(Doubt::Kind::search, result_.reason);
  }

  // Of (t, x) nothing is left free: a moment later there is no point.
  void end_at_instant(const Jet& jet) {
    fill_in(jet);
    LadderLevel empty;
    empty.k = jet.k;
    empty.is_empty = true;
    empty.is_solved = false;
    result_.levels.pop_back();
    std::string why = " is consistent but at this instant";
    for (const auto& row : elimination_->rows())
      if (row.stage == StagedElimination::point && row.level == jet.k) {
        result_.contradiction = equations_of(equations_, *elimination_, row);
        why += ": a moment later these equations contradict each other: " +
               in_words(result_.contradiction);
        break;
      }
    end_inconsistent(empty, why + ".");
  }

  void end_inconsistent(const LadderLevel& empty, const std::string& why) {
    result_.verdict = Verdict::inconsistent;
    result_.reason = "No point of S" + subscript(empty.k) + why;
    result_.levels.push_back(empty);
    result_.degrees_of_freedom = -1;
    result_.gauge_dimension = 0;
  }

  const JetEquations& equations_;
  const InitialGuess& guess_;
  Index max_level_;
  Decider decider_;
  NearestJet nearest_;
  ConstraintLadder result_;
  std::optional<StagedElimination> elimination_;
  std::optional<Neighbourhood> around_;
  std::optional<Jet> last_;  // that at() was called with
  bool is_at_edge_ = false;
};

// What there is to doubt where a switch is at its edge: nothing where both sides have this ladder, and are the same to
// first order in the equations, differentiated as often as a ladder reads them. v |v| at rest is smooth enough for a
// ladder that does not differentiate it, though its second derivatives jump.
std::optional<Doubt> doubt_of_sides(const Certifier& certifier, const ConstraintLadder& result,
                                    const JetEquations& equations, const InitialGuess& guess,
                                    const ConstraintAlgorithm::Options& options) {
  std::string sides;
  std::vector<int> read = result.differentiations;
  bool is_same = !read.empty();
  for (const int side : {1, -1}) {
    const JetEquations of_side = equations.on_side(side);
    const ConstraintLadder found = Certifier(of_side, guess, options).run();
    sides += std::string(sides.empty() ? " " : "; ") + (side > 0 ? "above the edge" : "below it") +
             " the ladder is " + to_string(found.verdict) + " " + dimensions_in_words(found.levels);
    is_same = is_same && are_alike(found, result) && !found.is_ambiguous() &&
              found.differentiations.size() == read.size();
    for (std::size_t e = 0; is_same && e < read.size(); ++e)
      read[e] = std::max(read[e], found.differentiations[e]);
  }
  if (is_same && !certifier.has_two_sides(read)) return std::nullopt;
  return Doubt(
      Doubt::Kind::at_switch,
      "A switch (abs, sign, min, max or a comparison) is at its edge at this point:" + sides + ".");
}

// What is found with the coordinates as they were given, and with 0 for those that look like the rounding of a zero.
struct Certified {
  ConstraintLadder result;
  std::optional<ConstraintLadder> without_rounding = std::nullopt;
};

Certified certified(const JetEquations& equations, const InitialGuess& guess,
                    const ConstraintAlgorithm::Options& options, Decider decider) {
  Certifier certifier(equations, guess, options, decider);
  Certified found{.result = certifier.run()};
  ConstraintLadder& result = found.result;
  if (decider == Decider::proof && !result.proof)
    result.proof =
        LadderProof{.missing = "Only ladders that are regular or gauge are proved; this one is " +
                               to_string(result.verdict) + "."};
  if (const std::optional<InitialGuess> rounded = certifier.without_rounding())
    found.without_rounding = Certifier(equations, *rounded, options).run();
  if (certifier.is_at_edge())
    if (const auto doubt = doubt_of_sides(certifier, result, equations, guess, options))
      result.doubts.push_back(*doubt);
  return found;
}

// Doubts a ladder that is another one without the rounding of zeros.
void doubt_rounding(ConstraintLadder& ladder, const Certified& found) {
  if (!found.without_rounding || are_alike(*found.without_rounding, ladder)) return;
  ladder.doubts.emplace_back(Doubt::Kind::near_singular,
                             "With 0 for what looks like the rounding of a zero among the given "
                             "coordinates the ladder is " +
                                 to_string(found.without_rounding->verdict) + " " +
                                 dimensions_in_words(found.without_rounding->levels) + ".");
}

}  // namespace

ConstraintLadder certificate_in_digits(const JetEquations& equations, const InitialGuess& guess,
                                       const ConstraintAlgorithm::Options& options,
                                       Decider decider) {
  Certified found = certified(equations, guess, options, decider);
  doubt_rounding(found.result, found);
  return std::move(found.result);
}

std::shared_ptr<const JetEquations> equations_in_digits(
    const std::shared_ptr<const ChartEquations>& in_chart, Decider decider) {
  constexpr Index most_unknowns = 120;
  if (decider == Decider::bounds) return nullptr;
  const ImplicitSystem& system = *in_chart->system();
  const Index unknowns = system.manifold()->ambient_dimension() + system.auxiliary_size();
  if (decider == Decider::both && unknowns > most_unknowns) return nullptr;
  return std::make_shared<const JetEquations>(in_chart);
}

ConstraintLadder decided_together(ConstraintLadder by_bounds, const JetEquations& equations,
                                  const InitialGuess& guess,
                                  const ConstraintAlgorithm::Options& options) {
  constexpr Index most_unknowns = 60;
  const bool is_sure = !by_bounds.is_ambiguous();
  if (is_sure && equations.point_size() + equations.auxiliary_size() > most_unknowns)
    return by_bounds;
  Certified found = certified(equations, guess, options, Decider::digits);
  ConstraintLadder& by_digits = found.result;
  const auto is_of_point = [](const Doubt& doubt) {
    return doubt.kind == Doubt::Kind::near_singular || doubt.kind == Doubt::Kind::at_switch;
  };
  // The given values may be a singular point, as the fold of an impasse, whatever holds at the point next to them.
  if (std::ranges::any_of(by_bounds.doubts, is_of_point)) return by_bounds;
  doubt_rounding(by_bounds, found);
  std::ranges::copy_if(by_digits.doubts, std::back_inserter(by_bounds.doubts), is_of_point);
  if (std::ranges::any_of(by_bounds.doubts, is_of_point)) return by_bounds;
  if (by_digits.is_ambiguous()) return by_bounds;
  const bool alike = are_alike(by_bounds, by_digits);
  const bool has_solutions =
      by_digits.verdict == Verdict::regular || by_digits.verdict == Verdict::gauge;
  if (by_digits.verdict == Verdict::inconsistent || (!is_sure && (alike || has_solutions)))
    return alike && is_sure ? by_bounds : by_digits;
  if (is_sure && !alike && has_solutions)
    by_bounds.doubts.emplace_back(
        Doubt::Kind::neighbours,
        "In two precisions the ladder is another one: " + to_string(by_digits.verdict) + " " +
            dimensions_in_words(by_digits.levels) + ".");
  return by_bounds;
}

}  // namespace courant
