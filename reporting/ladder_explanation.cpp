#include "courant/reporting/ladder_explanation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "courant/core/message.hpp"

namespace courant {
namespace {

using Json = nlohmann::ordered_json;

std::string subscript(int k) {
  std::string text;
  for (const char digit : std::to_string(k)) {
    text += "\xE2\x82";
    text += static_cast<char>(0x80 + (digit - '0'));
  }
  return text;
}

std::string plural(int count, const std::string& noun) {
  return (count == 1 ? "one " : std::to_string(count) + " ") + noun + (count == 1 ? "" : "s");
}

// 1.2 dx - 1.6 dy
std::string linear_form(const Json& components, const std::string& prefix) {
  std::string text;
  int terms = 0;
  for (const auto& [name, entry] : components.items()) {
    const double value = entry.get<double>();
    if (++terms > 6) return text + (value < 0 ? " - \u2026" : " + \u2026");
    const std::string size = number_text(std::abs(value), 4);
    text += text.empty() ? (value < 0 ? "-" : "") : (value < 0 ? " - " : " + ");
    text += (size == "1" ? "" : size + " ") + prefix + name;
  }
  return text;
}

std::string derivative(int order, const std::string& equation) {
  if (order == 0) return "[" + equation + "]";
  if (order == 1) return "d/dt [" + equation + "]";
  return "d^" + std::to_string(order) + "/dt^" + std::to_string(order) + " [" + equation + "]";
}

// The highest derivatives first: they are what the constraint is made of, the others what removes
// the rest.
std::string sources(const Json& terms) {
  std::vector<std::pair<int, std::string>> list;
  for (const Json& term : terms)
    list.emplace_back(term.at("derivative").get<int>(), term.at("equation").get<std::string>());
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i == 5) return text + " and " + std::to_string(list.size() - 5) + " more";
    text += (i == 0 ? "" : ", ") + derivative(list[i].first, list[i].second);
  }
  return text;
}

int whole(const Json& value) { return value.is_number_integer() ? value.get<int>() : -1; }

// The entries of a list that belong to level k.
std::vector<const Json*> of_level(const Json& ladder, const char* list, int k) {
  std::vector<const Json*> entries;
  if (ladder.contains(list))
    for (const Json& entry : ladder.at(list))
      if (whole(entry.at("level")) == k) entries.push_back(&entry);
  return entries;
}

constexpr int most = 6;  // lines of a kind

void tell_rest(std::size_t count, std::vector<std::string>& lines) {
  if (count > most) lines.push_back("    \u2026 and " + std::to_string(count - most) + " more");
}

// x' = v: those that are functions of the point from level k on.
void explain_velocities(const Json& ladder, int k, std::vector<std::string>& lines) {
  if (!ladder.contains("velocities")) return;
  std::size_t count = 0;
  for (const auto& [name, velocity] : ladder.at("velocities").items())
    if (whole(velocity.at("level")) == k && ++count <= most)
      lines.push_back("    " + name + " = " + velocity.at("formula").get<std::string>());
  tell_rest(count, lines);
}

// What S_k adds: each equation in velocities, and what becomes of it with those of S_{k-1}.
void explain_steps(const std::vector<const Json*>& steps, int k, std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < steps.size() && i < most; ++i) {
    const std::string derivative = steps[i]->at("derivative"), result = steps[i]->at("result");
    std::string text = "    " + derivative + " = 0";
    if (result == "0")
      text += ": 0 = 0 with the velocities of S" + subscript(k - 1) + ", so the constraint is kept";
    else if (!result.empty() && result != derivative &&
             (steps[i]->at("kind") == "constraint" || result.size() < 60))
      text += ", with the velocities of S" + subscript(k - 1) + ":  " + result + " = 0";
    lines.push_back(text);
  }
  tell_rest(steps.size(), lines);
}

void explain_level(const Json& ladder, int k, std::vector<std::string>& lines) {
  const Json& levels = ladder.at("levels");
  const Json& level = levels.at(static_cast<std::size_t>(k));
  const int dim_M = whole(level.at("dim_M")), fibre = whole(level.at("fibre"));
  std::vector<std::string> formulas;
  for (const Json* entry : of_level(ladder, "formulas", k))
    formulas.push_back(entry->at("formula"));
  const std::vector<const Json*> constraints = of_level(ladder, "constraints", k);
  const std::vector<const Json*> steps = of_level(ladder, "steps", k);
  const int count = static_cast<int>(constraints.size());

  std::string text = "Level " + std::to_string(k) + ". ";
  const std::string M = "M" + subscript(k);
  if (k == 0) {
    const int n = whole(ladder.at("dimension"));
    text += count == 0 ? "The equations put no constraint on the coordinates: " + M +
                             " is all of M, of dimension " + std::to_string(n) + "."
                       : M + " has dimension " + std::to_string(dim_M) + " of " +
                             std::to_string(n) + ": the equations contain " +
                             plural(count, "constraint") + " on the coordinates.";
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
  const int before = k == 0 ? -1 : whole(levels.at(static_cast<std::size_t>(k) - 1).at("fibre"));
  if (fibre == 0)
    text += " The velocity is determined at each of its points.";
  else if (before != fibre || count > 0)
    text += " The velocity at a point of it is free in " + plural(fibre, "direction") + ".";
  lines.push_back(text);

  const bool all_formulas = static_cast<int>(formulas.size()) == count;
  for (std::size_t i = 0; i < formulas.size() && i < most; ++i)
    lines.push_back("    " + formulas[i] + " = 0");
  tell_rest(formulas.size(), lines);
  if (!all_formulas) {
    for (std::size_t i = 0; i < constraints.size() && i < most; ++i) {
      lines.push_back("    differential here: " + linear_form(constraints[i]->at("gradient"), "d"));
      lines.push_back("    from " + sources(constraints[i]->at("from")));
    }
    tell_rest(constraints.size(), lines);
  }
  if (k > 0 || fibre == 0) explain_velocities(ladder, k, lines);
}

// From the equations to 1 = 0, where elimination gets there.
void explain_contradiction(const Json& ladder, std::vector<std::string>& lines) {
  const Json* last = nullptr;
  for (const Json& step : ladder.at("steps"))
    if (step.at("kind") == "contradiction") last = &step;
  if (!last) return;
  const int end = whole(last->at("level"));
  const std::string result = last->at("result");
  if (last->at("derivative").get<std::string>().empty()) {
    lines.push_back("The equations lead to " + result + " = 0: no velocity satisfies them.");
    return;
  }
  for (int k = 0; k < end; ++k) {
    lines.push_back(k == 0 ? "Level 0. The equations contain"
                           : "Level " + std::to_string(k) + ". Differentiated, that leads to");
    for (const Json* formula : of_level(ladder, "formulas", k))
      lines.push_back("    " + formula->at("formula").get<std::string>() + " = 0");
  }
  const std::string derivative = last->at("derivative");
  lines.push_back("Level " + std::to_string(end) + ". Solutions stay on M" + subscript(end - 1) +
                  ": from " + last->at("constraint").get<std::string>() + " = 0 follows");
  lines.push_back("    " + derivative + " = 0");
  std::string known;
  for (const auto& [name, velocity] : ladder.at("velocities").items())
    if (derivative.find(name) != std::string::npos && whole(velocity.at("level")) < end)
      known +=
          (known.empty() ? "" : ", ") + name + " = " + velocity.at("formula").get<std::string>();
  lines.push_back("But S" + subscript(end - 1) + " has" +
                  (known.empty() ? " velocities with" : ""));
  lines.push_back("    " + (known.empty() ? result + " = 0" : known));
  if (!known.empty()) lines.push_back("Put in, that is");
  if (!known.empty()) lines.push_back("    " + result + " = 0");
  lines.push_back("That cannot be: S" + subscript(end) + " is empty.");
}

// "Three constraints: two primary …" and what is left when gauge is counted off.
void explain_freedom(const Json& ladder, std::vector<std::string>& lines) {
  const int index = whole(ladder.at("index")), dim_M = whole(ladder.at("degrees_of_freedom"));
  lines.push_back("Degrees of freedom: " + std::to_string(dim_M) + ", the dimension of M" +
                  subscript(index) + ": so many initial values can be chosen.");
  if (!ladder.contains("classes")) return;
  const Json& classes = ladder.at("classes");
  const int primary = whole(classes.at("primary")), secondary = whole(classes.at("secondary"));
  const int left = whole(ladder.at("degrees_of_freedom_up_to_gauge"));
  if (primary + secondary > 0 && classes.contains("first_class")) {
    const int first = whole(classes.at("first_class")), second = whole(classes.at("second_class"));
    const int primary_first = whole(classes.at("primary_first_class"));
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
  if (classes.at("ambiguous").get<bool>())
    lines.push_back("Ambiguous: a rank behind the classes is doubtful.");
}

void explain_unknowns(const Json& ladder, std::vector<std::string>& lines) {
  std::string free;
  int listed = 0;
  double largest = 1.0;
  for (const Json& unknown : ladder.at("unknowns"))
    largest = std::max(largest, std::abs(unknown.at("value").get<double>()));
  for (const auto& [name, unknown] : ladder.at("unknowns").items()) {
    if (!unknown.at("determined").get<bool>()) {
      free += (free.empty() ? "" : ", ") + name;
      continue;
    }
    if (++listed > 8) continue;
    if (listed == 1) lines.push_back("Unknowns that are determined, with their values here:");
    const double value = unknown.at("value").get<double>();
    std::string text =
        "    " + name + " = " + number_text(std::abs(value) < 1e-14 * largest ? 0 : value);
    const bool is_told = ladder.value("velocities", Json::object()).contains(name);
    if (unknown.contains("formula") && !is_told)
      text += "  (" + name + " = " + unknown.at("formula").get<std::string>() + ")";
    lines.push_back(text);
  }
  if (listed > 8) lines.push_back("    \u2026 and " + std::to_string(listed - 8) + " more");
  if (!free.empty()) lines.push_back("Unknowns that nothing determines: " + free + ".");
}

}  // namespace

std::vector<std::string> ladder_text_diagram(const Json& ladder) {
  std::string S = "  ", arrows = "  ", M = "  ", dim_S = "dim S  ", dim_M = "dim M  ";
  std::vector<std::string> upper, lower, above, below, relation_S, relation_M;
  const Json* before = nullptr;
  for (const Json& level : ladder.at("levels")) {
    const int k = level.at("k").get<int>();
    const bool empty = level.at("dim_S").is_null();
    if (before) {
      const bool same = !empty && before->at("dim_S") == level.at("dim_S");
      S += same ? "  =  " : "  \u2287  ";
      M += !empty && before->at("dim_M") == level.at("dim_M") ? "  =  " : "  \u2287  ";
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
    dim_S += cell(empty ? "-" : std::to_string(level.at("dim_S").get<int>()), width);
    dim_M += cell(empty ? "-" : std::to_string(level.at("dim_M").get<int>()), width);
    before = &level;
  }
  const std::string margin(5, ' ');
  return {dim_S, margin + S, margin + arrows, margin + M, dim_M};
}

std::vector<std::string> ladder_explanation(const Json& ladder) {
  std::vector<std::string> lines;
  const Json& levels = ladder.at("levels");
  const int index = whole(ladder.at("index"));
  if (ladder.contains("constraints"))
    for (int k = 0; k <= (index < 0 ? static_cast<int>(levels.size()) - 1 : index); ++k)
      explain_level(ladder, k, lines);
  else if (ladder.contains("steps"))
    explain_contradiction(ladder, lines);
  if (ladder.contains("constraints") && index >= 0) {
    lines.push_back("Level " + std::to_string(index + 1) +
                    ". Nothing new: from here on every level is the same.");
    explain_freedom(ladder, lines);
    explain_unknowns(ladder, lines);
    const Json& gauge = ladder.at("gauge_directions");
    if (!gauge.empty()) {
      lines.push_back("Gauge: the velocity may be changed at will along");
      for (const Json& direction : gauge) lines.push_back("    " + linear_form(direction, ""));
      std::string determined;
      for (const Json& name : ladder.value("determined_velocities", Json::array()))
        determined += (determined.empty() ? "" : ", ") + name.get<std::string>();
      if (!determined.empty()) lines.push_back("Determined all the same: " + determined + ".");
    }
    const Json& redundant = ladder.at("redundant");
    if (!redundant.empty()) {
      lines.push_back("Redundant: " + plural(static_cast<int>(redundant.size()), "equation") +
                      (redundant.size() == 1 ? " follows" : " follow") +
                      " from the others here; harmless. Dependent among themselves are");
      for (std::size_t i = 0; i < std::min<std::size_t>(redundant.size(), 4); ++i)
        lines.push_back("    " + sources(redundant[i]));
    }
  }
  const Json* weakest = nullptr;
  for (const Json& level : levels)
    if (!level.at("gap").is_null() &&
        (!weakest || level.at("gap").get<double>() < weakest->at("gap").get<double>()))
      weakest = &level;
  if (weakest) {
    lines.push_back(
        "How sure: dimensions are differences of ranks, and a rank counts the "
        "singular values that "
        "exceed the bound of their error. In the weakest decision (level " +
        std::to_string(whole(weakest->at("k"))) + ") the smallest that was counted is " +
        number_text(weakest->at("smallest_counted").get<double>(), 2) +
        " times the bound, the largest that was taken for zero is " +
        number_text(weakest->at("largest_neglected").get<double>(), 2) + " times the bound.");
  }
  if (ladder.value("ambiguous", false)) {
    lines.push_back("Ambiguous: do not rely on the verdict.");
    for (const Json& doubt : ladder.value("doubts", Json::array()))
      lines.push_back("    " + doubt.get<std::string>());
  }
  return lines;
}

}  // namespace courant
