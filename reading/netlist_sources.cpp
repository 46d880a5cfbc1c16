#include "courant/reading/netlist_sources.hpp"

#include <algorithm>
#include <array>

#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"

namespace courant::netlist {
namespace {

class Values {
 public:
  // The words up to DC or AC, which may stand behind a waveform.
  Values(const std::vector<std::string>& words, std::size_t first, const Scope& scope, int line,
         const SymbolTable& parameters)
      : line_(line), parameters_(parameters) {
    for (std::size_t i = first; i < words.size() && words[i] != "ac" && words[i] != "dc"; ++i)
      formulas_.push_back(formula(words[i], scope, line));
  }
  std::size_t size() const { return formulas_.size(); }
  const std::string& at(std::size_t i) const {
    if (i >= size())
      throw LineError{line_, "the waveform has " + std::to_string(size()) +
                                 " values; expected at least " + std::to_string(i + 1)};
    return formulas_[i];
  }
  std::string at(std::size_t i, double otherwise) const {
    return i < size() ? formulas_[i] : exact_text(otherwise);
  }
  double number_at(std::size_t i) const {
    try {
      return parse_formula(at(i), parameters_).value();
    } catch (const FormulaError&) {
      throw LineError{line_, "\"" + at(i) + "\" is no number; expected one for a time"};
    }
  }
  double number_at(std::size_t i, double otherwise) const {
    return i < size() ? number_at(i) : otherwise;
  }

 private:
  std::vector<std::string> formulas_;
  int line_;
  const SymbolTable& parameters_;
};

void add_corner(std::vector<Corner>& corners, double first, double period, const Times& times) {
  const auto same = [&](const Corner& other) {
    return other.first == first && other.period == period;
  };
  if (first >= times.end || (first <= 0.0 && period == 0.0)) return;
  if (std::ranges::none_of(corners, same)) corners.push_back({first, period});
}

// v1 → v2 → v1, again and again: the time within a period s = t - td - n per is
// per (1/2 + atan(tan(π ((t - td)/per - 1/2)))/π).
std::string pulse(const Values& values, const Times& times, std::vector<Corner>& corners) {
  const std::string &v1 = values.at(0), &v2 = values.at(1);
  const double delay = values.number_at(2, 0.0);
  const auto or_default = [](double value, double otherwise) {
    return value > 0.0 ? value : otherwise;
  };
  const double rise = or_default(values.number_at(3, 0.0), times.step);
  const double fall = or_default(values.number_at(4, 0.0), times.step);
  const double width = or_default(values.number_at(5, 0.0), times.end);
  const double period = or_default(values.number_at(6, 0.0), times.end);
  const std::string after = delay == 0.0 ? "t" : "(t - " + exact_text(delay) + ")";
  std::string s = after;
  const bool repeats = delay + period < times.end;
  for (const double corner : {0.0, rise, rise + width, rise + width + fall})
    add_corner(corners, delay + corner, repeats ? period : 0.0, times);
  if (repeats)
    s = "(" + exact_text(period) + "*(0.5 + atan(tan(pi*(" + after + "/" + exact_text(period) +
        " - 0.5)))/pi))";
  const std::string top = exact_text(rise + width), end = exact_text(rise + width + fall);
  return "if(" + after + " < 0, " + v1 + ", if(" + s + " < " + exact_text(rise) + ", " + v1 +
         " + (" + v2 + " - " + v1 + ")*" + s + "/" + exact_text(rise) + ", if(" + s + " < " + top +
         ", " + v2 + ", if(" + s + " < " + end + ", " + v2 + " + (" + v1 + " - " + v2 + ")*(" + s +
         " - " + top + ")/" + exact_text(fall) + ", " + v1 + "))))";
}

std::string sine(const Values& values, const Times& times, std::vector<Corner>& corners) {
  const std::string &offset = values.at(0), &amplitude = values.at(1);
  const std::string frequency = values.at(2, 1.0 / times.end), delay = values.at(3, 0.0);
  if (const auto begin = number(delay)) add_corner(corners, *begin, 0.0, times);
  const std::string damping = values.at(4, 0.0), phase = values.at(5, 0.0);
  const std::string angle = phase == "0" ? "" : " + pi/180*" + phase;
  const std::string after = delay == "0" ? "t" : "(t - " + delay + ")";
  std::string wave = amplitude + "*sin(2*pi*" + frequency + "*" + after + angle + ")";
  if (damping != "0") wave += "*exp(-" + after + "*" + damping + ")";
  const std::string start = phase == "0" ? "0" : amplitude + "*sin(pi/180*" + phase + ")";
  if (delay != "0") wave = "if(t < " + delay + ", " + start + ", " + wave + ")";
  return offset == "0" ? wave : offset + " + " + wave;
}

// v₀ + Σ (v_{k+1} - v_k) (min(max(t, t_k), t_{k+1}) - t_k)/(t_{k+1} - t_k)
std::string piecewise_linear(const Values& values, const Times& times, int line,
                             std::vector<Corner>& corners) {
  if (values.size() < 2 || values.size() % 2 == 1)
    throw LineError{line, "PWL has " + std::to_string(values.size()) +
                              " values; expected pairs of a time and a value"};
  for (std::size_t k = 0; k < values.size(); k += 2)
    add_corner(corners, values.number_at(k), 0.0, times);
  std::string sum = values.at(1);
  for (std::size_t k = 0; k + 3 < values.size(); k += 2) {
    const double from = values.number_at(k), to = values.number_at(k + 2);
    if (!(to > from))
      throw LineError{line, "the times of PWL do not increase at " + exact_text(to)};
    sum += " + (" + values.at(k + 3) + " - " + values.at(k + 1) + ")*(min(max(t, " +
           exact_text(from) + "), " + exact_text(to) + ") - " + exact_text(from) + ")/" +
           exact_text(to - from);
  }
  return sum;
}

std::string exponential(const Values& values, const Times& times, std::vector<Corner>& corners) {
  const std::string &v1 = values.at(0), &v2 = values.at(1);
  const std::string td1 = values.at(2, 0.0), tau1 = values.at(3, times.step);
  const std::string td2 = values.at(4, values.number_at(2, 0.0) + times.step),
                    tau2 = values.at(5, times.step);
  for (const std::string& begin : {td1, td2})
    if (const auto corner = number(begin)) add_corner(corners, *corner, 0.0, times);
  const auto part = [](const std::string& from, const std::string& to, const std::string& delay,
                       const std::string& tau) {
    return "if(t < " + delay + ", 0, (" + to + " - " + from + ")*(1 - exp(-(t - " + delay + ")/" +
           tau + ")))";
  };
  return v1 + " + " + part(v1, v2, td1, tau1) + " + " + part(v2, v1, td2, tau2);
}

}  // namespace

std::string source(const std::vector<std::string>& words, const Scope& scope, const Times& times,
                   int line, const SymbolTable& parameters, std::vector<Corner>* corners) {
  std::vector<Corner> unasked;
  std::vector<Corner>& bends = corners ? *corners : unasked;
  std::string constant = "0";
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto values = [&] { return Values(words, i + 1, scope, line, parameters); };
    if (word == "pulse") return pulse(values(), times, bends);
    if (word == "sin") return sine(values(), times, bends);
    if (word == "pwl") return piecewise_linear(values(), times, line, bends);
    if (word == "exp") return exponential(values(), times, bends);
    if (word == "ac") {
      while (i + 1 < words.size() && number(words[i + 1])) ++i;
    } else if (word == "sffm" || word == "am" || word == "trnoise" || word == "trrandom") {
      throw LineError{
          line, "the waveform " + word + " is not supported; expected PULSE, SIN, PWL or EXP"};
    } else if (word != "dc") {
      constant = formula(word, scope, line);
    }
  }
  return constant;
}

}  // namespace courant::netlist
