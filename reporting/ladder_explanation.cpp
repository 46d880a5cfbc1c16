#include "courant/reporting/ladder_explanation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "courant/core/language/formula_tree.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reporting/bracket_words.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/short_list.hpp"

namespace courant {
namespace {

std::string plural(Index count, const std::string& noun) {
  return count == 1 ? "one " + noun : counted(count, noun);
}

// 1.2 dx - 1.6 dy
Prose linear_form(const LadderReport::Values& components, const std::string& prefix) {
  Prose sum;
  int terms = 0;
  for (const auto& [name, value] : components) {
    if (++terms > 6) return sum + (value < 0 ? " - \u2026" : " + \u2026");
    std::string sign = terms == 1 ? "" : "0";  // what a term comes after
    add_term(sign, value, prefix, 4);
    sum += sign.substr(terms == 1 ? 0 : 1) + Prose::formula(name);
  }
  return sum;
}

// An equation by its name, which may be its formula. p_x' = dL/dx has a derivative by a variable, which the language of
// formulas takes for a quotient.
Prose equation_in_words(const std::string& name) {
  const std::size_t slash = name.find("/d");
  if (slash == std::string::npos) {
    const auto tree = formula_tree(name);
    return tree && tree->kind != FormulaTree::Kind::name ? Prose::formula(name) : Prose(name);
  }
  const std::size_t equals = name.find(" = ");
  const std::size_t begin = equals == std::string::npos ? 0 : equals + 3;
  const std::string variable = name.substr(slash + 2);
  if (name[begin] != 'd' || !formula_tree(variable)) return name;
  const Prose derivative =
      "∂" + name.substr(begin + 1, slash - begin - 1) + "/∂" + Prose::formula(variable);
  return begin == 0 ? derivative : Prose::formula(name.substr(0, equals)) + " = " + derivative;
}

// "d²/dt² ", of order 2; empty of order 0.
std::string derivative_sign(Index order) {
  if (order == 0) return "";
  const std::string power = order == 1 ? "" : superscript(order);
  return "d" + power + "/dt" + power + " ";
}

// The highest derivatives first: they are what the constraint is made of, the others what removes
// the rest.
Prose sources(LadderReport::Origin list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.derivative > b.derivative; });
  Prose text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i == 5) return text + " and " + std::to_string(list.size() - 5) + " more";
    text += (i == 0 ? "" : ", ") + derivative_sign(list[i].derivative) + "[" +
            equation_in_words(list[i].equation) + "]";
  }
  return text;
}

// The entries of a list that belong to level k.
template <class Entry>
std::vector<Entry> of_level(const std::vector<Entry>& list, Index k) {
  std::vector<Entry> entries;
  for (const Entry& entry : list)
    if (entry.level == k) entries.push_back(entry);
  return entries;
}

// x' = v: those that are functions of the point from level k on, and where all are told, those of
// level 0 too.
void explain_velocities(const LadderReport::Elimination& found, Index k, bool all,
                        std::vector<Prose>& lines) {
  constexpr std::size_t columns = 90, most_rows = 18;
  std::size_t rows = 0, left = 0;
  for (const LadderReport::Velocity& velocity : found.velocities) {
    const auto& [name, level, written, on_M_f] = velocity;
    if (level != k && !(all && level == 0)) continue;
    const std::string& formula = all && level < k && !on_M_f.empty() ? on_M_f : written;
    rows += 1 + (name.size() + formula.size()) / columns;
    if (rows <= most_rows)
      lines.push_back("    " + Prose::formula(name + " = " + formula));
    else
      ++left;
  }
  if (left > 0) lines.push_back("    \u2026 and " + std::to_string(left) + " more");
}

// What S_k adds: each equation in velocities, and what becomes of it with those of S_{k-1}.
void explain_steps(const std::vector<ConstraintFormulas::Step>& steps, Index k,
                   std::vector<Prose>& lines) {
  for (std::size_t i = 0; i < shown_of(steps.size()); ++i) {
    const std::string &derivative = steps[i].derivative, &result = steps[i].result;
    Prose text = "    " + Prose::formula(derivative + " = 0");
    if (result == "0")
      text += ": " + Prose::formula("0 = 0") + " with the velocities of S" + subscript(k - 1) +
              ", so the constraint is kept";
    else if (!result.empty() && result != derivative &&
             (steps[i].kind == ConstraintFormulas::Step::Kind::constraint || result.size() < 60))
      text +=
          ", with the velocities of S" + subscript(k - 1) + ":  " + Prose::formula(result + " = 0");
    lines.push_back(text);
  }
  tell_rest(steps.size(), lines);
}

// Whether formulas of more than a line stand among the results of these steps: once is enough.
bool are_told_long(const std::vector<ConstraintFormulas::Constraint>& formulas,
                   const std::vector<ConstraintFormulas::Step>& steps) {
  constexpr std::size_t letters = 80;
  const auto shown = std::span(steps).first(shown_of(steps.size()));
  return std::ranges::any_of(formulas,
                             [](const auto& one) { return one.formula.size() > letters; }) &&
         std::ranges::all_of(formulas, [&](const ConstraintFormulas::Constraint& one) {
           return std::ranges::any_of(shown, [&](const ConstraintFormulas::Step& step) {
             return step.kind == ConstraintFormulas::Step::Kind::constraint &&
                    step.result == one.formula;
           });
         });
}

void explain_level(const LadderReport& ladder, Index k, std::vector<Prose>& lines) {
  const auto at = static_cast<std::size_t>(k);
  const LadderReport::Level& level = ladder.levels.at(at);
  const Index dim_M = level.dim_M.value_or(-1), fibre = level.fibre.value_or(-1);
  const LadderReport::Elimination found = ladder.elimination.value_or(LadderReport::Elimination());
  const auto formulas = of_level(found.formulas, k);
  const auto constraints = of_level(*ladder.constraints, k);
  const auto steps = of_level(found.steps, k);
  const auto count = static_cast<Index>(constraints.size());

  std::string text = "Level " + std::to_string(k) + ". ";
  const std::string M = "M" + subscript(k);
  if (k == 0) {
    const Index n = ladder.dimension.value_or(-1);
    text += count == 0
                ? "The equations put no constraint on the coordinates near this point: " + M +
                      " is all of M there, of dimension " + std::to_string(n) + "."
                : "Near this point " + M + " has dimension " + std::to_string(dim_M) + " of " +
                      std::to_string(n) + ": the equations contain " + plural(count, "constraint") +
                      " on the coordinates.";
  } else {
    if (!steps.empty()) {
      lines.push_back(text + "Solutions stay on M" + subscript(k - 1) +
                      ", so its constraints hold differentiated too. S" + subscript(k) + " adds");
      explain_steps(steps, k, lines);
      text = "";
    } else if (count > 0) {
      text += "Solutions stay on M" + subscript(k - 1) +
              ", so its constraints hold differentiated too: ";
    }
    if (count > 0)
      text += (steps.empty() ? "" : "That makes ") + plural(count, "hidden constraint") + ". " + M +
              " has dimension " + std::to_string(dim_M) + ".";
    else
      text += "No new constraint on the coordinates, but on the velocity.";
  }
  const Index before = k == 0 ? -1 : ladder.levels[at - 1].fibre.value_or(-1);
  if (fibre == 0) {
    text += " The velocity is determined at each of its points near this one.";
    if (ladder.elimination && found.velocities.empty())
      text += " No formula for it of up to five lines was found.";
  }
  if (fibre != 0 && (before != fibre || count > 0))
    text += " The velocity at a point of it is free in " + plural(fibre, "direction") + ".";
  lines.push_back(text);

  const bool all_formulas = formulas.size() == constraints.size();
  if (!are_told_long(formulas, steps)) {
    for (std::size_t i = 0; i < shown_of(formulas.size()); ++i)
      lines.push_back("    " + Prose::formula(formulas[i].formula + " = 0"));
    tell_rest(formulas.size(), lines);
  }
  if (!all_formulas) {
    for (std::size_t i = 0; i < shown_of(constraints.size()); ++i) {
      lines.push_back("    differential here: " + linear_form(constraints[i].gradient, "d"));
      lines.push_back("    from " + sources(constraints[i].from));
    }
    tell_rest(constraints.size(), lines);
  }
  const bool is_last = fibre == 0 ? before != 0 : ladder.index == k && k > 0;
  const bool has_any = std::ranges::any_of(found.velocities, [&](const auto& velocity) {
    return velocity.level == k || (is_last && velocity.level == 0);
  });
  if (!has_any || (k == 0 && fibre != 0)) return;
  if (fibre != 0) lines.push_back("Velocities that are determined there:");
  explain_velocities(found, k, is_last, lines);
  if (is_last && fibre == 0 && std::ssize(found.velocities) < ladder.dimension.value_or(0))
    lines.push_back("For the others no formula of up to five lines was found.");
}

// The constraints of levels below `end`, where the ladder has no end to tell more of them.
void list_constraints(const LadderReport::Elimination& found, Index end,
                      std::vector<Prose>& lines) {
  for (Index k = 0; k < end; ++k) {
    const auto formulas = of_level(found.formulas, k);
    if (formulas.empty()) continue;
    lines.push_back(k == 0 ? "Level 0. The equations contain"
                           : "Level " + std::to_string(k) + ". Differentiated, that leads to");
    for (std::size_t i = 0; i < shown_of(formulas.size()); ++i)
      lines.push_back("    " + Prose::formula(formulas[i].formula + " = 0") +
                      (formulas[i].is_singular ? ", whose differential is 0 here" : ""));
    tell_rest(formulas.size(), lines);
  }
}

// From the equations to 1 = 0, where elimination gets there.
void explain_contradiction(const LadderReport::Elimination& found, std::vector<Prose>& lines) {
  const ConstraintFormulas::Step* last = nullptr;
  for (const ConstraintFormulas::Step& step : found.steps)
    if (step.kind == ConstraintFormulas::Step::Kind::contradiction) last = &step;
  const auto levels_of = [&](const auto& list) {
    Index most = -1;
    for (const auto& entry : list) most = std::max(most, entry.level);
    return most + 1;
  };
  if (!last || last->derivative.empty()) {
    const std::size_t before = lines.size();
    list_constraints(found, last ? last->level + 1 : levels_of(found.formulas), lines);
    if (!last && lines.size() > before)
      lines.push_back("No point nearby satisfies these and what follows from them.");
    else if (last && !last->constraint.empty())
      lines.push_back("These have no zero in common: together they lead to 1 = 0.");
    else if (last)
      lines.push_back("The equations lead to " + Prose::formula(last->result + " = 0") +
                      ": no velocity satisfies them.");
    return;
  }
  const Index end = last->level;
  const std::string &derivative = last->derivative, &result = last->result;
  list_constraints(found, end, lines);
  lines.push_back("Level " + std::to_string(end) + ". Solutions stay on M" + subscript(end - 1) +
                  ": from " + Prose::formula(last->constraint + " = 0") + " follows");
  lines.push_back("    " + Prose::formula(derivative + " = 0"));
  Prose known;
  for (const auto& [name, level, formula, on_M_f] : found.velocities)
    if (derivative.find(name) != std::string::npos && level < end)
      known += (known.parts().empty() ? "" : ", ") + Prose::formula(name + " = " + formula);
  lines.push_back("But S" + subscript(end - 1) + " has" +
                  (known.parts().empty() ? " velocities with" : ""));
  lines.push_back("    " + (known.parts().empty() ? Prose::formula(result + " = 0") : known));
  if (!known.parts().empty()) lines.push_back("Put in, that is");
  if (!known.parts().empty()) lines.push_back("    " + Prose::formula(result + " = 0"));
  lines.push_back("That cannot be: S" + subscript(end) + " is empty.");
}

// "Three constraints: two primary …" and what is left when gauge is counted off.
void explain_freedom(const LadderReport& ladder, std::vector<Prose>& lines) {
  const Index index = *ladder.index, dim_M = ladder.degrees_of_freedom.value_or(-1);
  lines.push_back("Degrees of freedom: " + std::to_string(dim_M) + ", the dimension of M" +
                  subscript(index) + ": so many initial values can be chosen.");
  if (!ladder.classes) return;
  const LadderReport::Classes& classes = *ladder.classes;
  const Index primary = classes.primary, secondary = classes.secondary;
  const Index left = classes.degrees_of_freedom_up_to_gauge;
  if (primary + secondary > 0 && classes.brackets) {
    const Index first = classes.brackets->first_class, second = classes.brackets->second_class;
    const Index primary_first = classes.brackets->primary_first_class;
    std::string text = "Classes: " + plural(primary + secondary, "constraint") + ", ";
    text += secondary == 0 ? "primary (in the equations)"
            : primary == 0 ? "secondary (hidden)"
                           : std::to_string(primary) + " primary (in the equations) and " +
                                 std::to_string(secondary) + " secondary (hidden)";
    text += primary + secondary == 1
                ? ". It has bracket 0 with itself: "
                : ". The matrix of their brackets {\u03c6_a, \u03c6_b} has rank " +
                      std::to_string(second) + ": ";
    if (second == 0)
      text += first == 1 ? "it is of the first class" : "all are of the first class";
    else if (first == 0)
      text += "all are of the second class";
    else
      text += std::to_string(second) + " of the second class, " + std::to_string(first) +
              " of the first";
    if (first > 0 && primary > 0 && secondary > 0)
      text += primary_first == 0 ? ", none of these primary"
                                 : ", " + std::to_string(primary_first) + " of these primary";
    text += ". ";
    text += first == 0 ? "None generates a gauge transformation."
                       : "The first class generates gauge transformations, "
                         "which are tangent to M" +
                             subscript(index) + ".";
    lines.push_back(text);
  }
  if (left != dim_M)
    lines.push_back("Degrees of freedom up to gauge: " + std::to_string(left) +
                    ", the rank of the structure on M" + subscript(index) +
                    ": so many of the values can be observed.");
  if (classes.is_ambiguous) lines.push_back("Ambiguous: a rank behind the classes is doubtful.");
}

void explain_unknowns(const LadderReport& ladder, std::vector<Prose>& lines) {
  Prose free;
  int listed = 0;
  double largest = 1.0;
  for (const LadderReport::Unknown& unknown : ladder.end->unknowns)
    largest = std::max(largest, std::abs(unknown.value));
  for (const auto& [name, value, is_determined, formula] : ladder.end->unknowns) {
    if (!is_determined) {
      free += (free.parts().empty() ? "" : ", ") + Prose::formula(name);
      continue;
    }
    if (++listed > 8) continue;
    if (listed == 1) lines.push_back("Unknowns that are determined, with their values here:");
    Prose text =
        "    " +
        Prose::formula(name + " = " + number_text(std::abs(value) < 1e-14 * largest ? 0 : value));
    const bool is_told = ladder.elimination && ladder.elimination->velocity(name);
    if (formula && !is_told) text += "  (" + Prose::formula(name + " = " + *formula) + ")";
    lines.push_back(text);
  }
  if (listed > 8) lines.push_back("    \u2026 and " + std::to_string(listed - 8) + " more");
  if (!free.parts().empty()) lines.push_back("Unknowns that nothing determines: " + free + ".");
}

}  // namespace

std::vector<std::string> ladder_text_diagram(const LadderReport& ladder) {
  std::string S = "  ", arrows = "  ", M = "  ", dim_S = "dim S  ", dim_M = "dim M  ";
  std::vector<std::string> upper, lower, above, below, relation_S, relation_M;
  const LadderReport::Level* before = nullptr;
  for (const LadderReport::Level& level : ladder.levels) {
    const Index k = level.k;
    const bool empty = !level.dim_S;
    if (before) {
      const bool same = !empty && before->dim_S == level.dim_S;
      S += same ? "  =  " : "  \u2287  ";
      M += !empty && before->dim_M == level.dim_M ? "  =  " : "  \u2287  ";
      arrows += "     ";
      dim_S += "     ";
      dim_M += "     ";
    }
    const auto cell = [](std::string text, std::size_t columns) {
      text.insert(0, columns > text.size() ? columns - text.size() : 0, ' ');
      return text;
    };
    const std::size_t width = k < 10 ? 4 : 5;
    S += empty ? std::string(width - 1, ' ') + "\u2205"
               : std::string(width - (k < 10 ? 2 : 3), ' ') + "S" + subscript(k);
    M += empty ? std::string(width - 1, ' ') + "\u2205"
               : std::string(width - (k < 10 ? 2 : 3), ' ') + "M" + subscript(k);
    arrows += std::string(width - 2, ' ') + "\u2193\u03c4";
    dim_S += cell(empty ? "-" : std::to_string(*level.dim_S), width);
    dim_M += cell(empty ? "-" : std::to_string(level.dim_M.value_or(0)), width);
    before = &level;
  }
  const std::string margin(5, ' ');
  return {dim_S, margin + S, margin + arrows, margin + M, dim_M};
}

std::string family_in_words(const LadderReport& ladder) {
  if (!ladder.family) return "";
  const auto& [multipliers, rank] = *ladder.family;
  const std::string measured =
      "the rank of \u2202_\u03bb(\u2202_xE, \u2202_\u03bbE) is " + std::to_string(rank);
  if (ladder.family->is_morse())
    return "E is a Morse family here: " + measured + ", the number of multipliers \u03bb.";
  return "E is no Morse family here: " + measured + ", less than the " +
         plural(multipliers, "multiplier") +
         " \u03bb, so that nothing says that \U0001d4db is a Lagrangian submanifold.";
}

Prose reason_in_words(const LadderReport& ladder) {
  const std::string& reason = ladder.reason;
  const std::string list = in_words(ladder.contradiction);
  const std::size_t at = reason.rfind(list);
  if (list.empty() || at == std::string::npos) return reason;
  Prose text = reason.substr(0, at);
  for (std::size_t i = 0; i < ladder.contradiction.size(); ++i) {
    if (i > 0) text += ", ";
    if (i == kMostEquationsInWords) {
      text += "…";
      break;
    }
    const auto& [name, derivative] = ladder.contradiction[i];
    text += derivative_sign(derivative);
    const auto tree = formula_tree(name);
    const bool is_side =
        tree && tree->kind != FormulaTree::Kind::name && tree->kind != FormulaTree::Kind::equation;
    text += equation_in_words(is_side ? name + " = 0" : name);
  }
  return text + reason.substr(at + list.size());
}

std::vector<std::string> choices_in_words(const LadderReport& ladder) {
  std::vector<std::string> lines;
  for (const auto& [name, value, other] : ladder.choices)
    lines.push_back(name + " = " + number_text(value) + " is a choice: " + name + " = " +
                    number_text(other) +
                    " solves the equations at the same point as well. A value of " + name +
                    " in \"initial\" chooses.");
  return lines;
}

std::string proof_in_words(const LadderProof& proof) {
  if (!proof.missing.empty()) return "Not proved. " + proof.missing;
  const std::string where =
      proof.radius == 0.0 ? "with the coordinates above"
                          : "whose coordinates are those above to " + number_text(proof.radius, 1);
  const std::string found = "Proved, by balls: there is a consistent point " + where + ", and " +
                            plural(proof.not_zero, "pivot") +
                            (proof.not_zero == 1 ? " is" : " are") +
                            " nowhere zero in a ball around it";
  if (proof.zero == 0)
    return found +
           ". No number counts as zero for its digits, so the ranks are the same in the whole "
           "ball: dimensions, index and verdict are proved.";
  return found +
         ", so ranks are at least what the ladder says. That they are not more is not proved: " +
         plural(proof.zero, "number") + (proof.zero == 1 ? " counts" : " count") +
         " as zero for the digits alone.";
}

LadderWords ladder_words(const LadderReport& ladder,
                         const std::optional<ConstraintBrackets>& brackets) {
  LadderWords words;
  std::vector<Prose>& lines = words.levels;
  if (ladder.constraints) {
    const Index last = ladder.index.value_or(static_cast<Index>(ladder.levels.size()) - 1);
    for (Index k = 0; k <= last; ++k) explain_level(ladder, k, lines);
  } else if (ladder.elimination && ladder.verdict == Verdict::rank_change) {
    list_constraints(*ladder.elimination, std::ssize(ladder.levels), lines);
  } else if (ladder.elimination) {
    explain_contradiction(*ladder.elimination, lines);
  }
  if (ladder.constraints && ladder.index && ladder.end) {
    lines.push_back("Level " + std::to_string(*ladder.index + 1) +
                    ". Nothing new: from here on every level is the same.");
    explain_freedom(ladder, words.freedom);
    if (brackets && ladder.classes && ladder.classes->brackets) {
      words.brackets = brackets_in_words(*brackets);
      words.dynamics = dynamics_in_words(*brackets);
    }
    explain_unknowns(ladder, words.unknowns);
    for (const std::string& line : choices_in_words(ladder)) words.unknowns.push_back(line);
    const auto& [unknowns, gauge, determined, differentiations, redundant, joints] = *ladder.end;
    if (!gauge.empty()) {
      words.unknowns.push_back("Gauge: the velocity may be changed at will along");
      for (const LadderReport::Values& direction : gauge)
        words.unknowns.push_back("    " + linear_form(direction, ""));
      if (!determined.empty())
        words.unknowns.push_back("Determined all the same: " + listed(determined) + ".");
    }
    for (const auto& [joint, conditions, of] : joints)
      words.unknowns.push_back("Redundant: " + std::to_string(conditions) + " of the " +
                               plural(of, "condition") + " of joint " + joint +
                               (conditions == 1 ? " follows" : " follow") +
                               " from the others here; harmless, but reactions are not unique.");
    if (!redundant.empty() && joints.empty()) {
      words.unknowns.push_back(
          "Redundant: " + plural(static_cast<Index>(redundant.size()), "equation") +
          (redundant.size() == 1 ? " follows" : " follow") +
          " from the others here; harmless. Dependent among themselves are");
      for (std::size_t i = 0; i < std::min<std::size_t>(redundant.size(), 4); ++i)
        words.unknowns.push_back("    " + sources(redundant[i]));
    }
  }
  if (ladder.family) words.unknowns.push_back(family_in_words(ladder));
  const LadderReport::Level* weakest = nullptr;
  for (const LadderReport::Level& level : ladder.levels)
    if (!std::isnan(level.gap) && (!weakest || level.gap < weakest->gap)) weakest = &level;
  if (weakest && std::isnan(weakest->smallest_counted)) {
    words.certainty.push_back(
        "How sure: dimensions are differences of ranks, and a number counts unless it shrinks by "
        "2\u2076\u2074 or more when its digits double.");
  } else if (weakest) {
    words.certainty.push_back(
        "How sure: dimensions are differences of ranks, and a rank counts the "
        "singular values that "
        "exceed the bound of their error. In the weakest decision (level " +
        std::to_string(weakest->k) + ") the smallest that was counted is " +
        number_text(weakest->smallest_counted, 2) +
        " times the bound, the largest that was taken for zero is " +
        number_text(weakest->largest_neglected, 2) + " times the bound.");
  }
  if (ladder.proof) words.certainty.push_back(proof_in_words(*ladder.proof));
  for (const std::string& doubt : doubts_in_words(ladder)) words.certainty.push_back(doubt);
  return words;
}

std::vector<Prose> ladder_explanation(const LadderReport& ladder,
                                      const std::optional<ConstraintBrackets>& brackets) {
  LadderWords words = ladder_words(ladder, brackets);
  std::vector<Prose> lines = std::move(words.levels);
  for (const std::vector<Prose>* part :
       {&words.freedom, &words.brackets, &words.dynamics, &words.unknowns, &words.certainty})
    lines.insert(lines.end(), part->begin(), part->end());
  return lines;
}

}  // namespace courant
