#include "courant/extensions/spice/netlist_sources.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"
#include "courant/extensions/spice/netlist_behaviour.hpp"

namespace courant::netlist {
namespace {

bool ends_waveform(const std::string& word) {
  return word == "ac" || word == "dc" || word == "distof1" || word == "distof2";
}

std::string any_of(const std::vector<const char*>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i)
    words += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(names[i]);
  return words;
}

class Values {
 public:
  // The words up to DC or AC, which may stand behind a waveform; with `names`, those of Gnucap may stand before an = instead of
  // places, shortened too: `sin ampl=2 freq=1k`. Throws LineError for other names.
  Values(const std::vector<std::string>& words, std::size_t first, const Scope& scope, int line,
         const SymbolTable& parameters, const std::vector<const char*>& names)
      : line_(line), parameters_(parameters) {
    for (std::size_t i = first; i < words.size() && !ends_waveform(words[i]); ++i) {
      if (i + 2 >= words.size() || words[i + 1] != "=") {
        formulas_.push_back(formula(words[i], scope, line));
        continue;
      }
      const auto named = std::ranges::find_if(
          names, [&](const char* name) { return std::string_view(name).starts_with(words[i]); });
      if (named == names.end() && !names.empty() && words[i] == "samples") {  // how long steps are
        i += 2;
        continue;
      }
      if (named == names.end())
        throw LineError{line, "the waveform has no value " + words[i] + "; expected " +
                                  (names.empty() ? "numbers alone" : any_of(names))};
      const auto place = static_cast<std::size_t>(named - names.begin());
      if (formulas_.size() <= place) formulas_.resize(place + 1);
      formulas_[place] = formula(words[i + 2], scope, line);
      is_named_ = true;
      i += 2;
    }
  }
  std::size_t size() const { return formulas_.size(); }
  const std::string& at(std::size_t i) const {
    if (!is_given(i))
      throw LineError{line_, "the waveform has " + std::to_string(size()) +
                                 " values; expected at least " + std::to_string(i + 1)};
    return *formulas_[i];
  }
  std::string at(std::size_t i, double otherwise) const {
    return is_given(i) ? *formulas_[i] : exact_text(otherwise);
  }
  // … where values are given by names.
  std::string at_named(std::size_t i, double otherwise) const {
    return is_named_ ? at(i, otherwise) : at(i);
  }
  double number_at(std::size_t i) const {
    try {
      return parse_formula(at(i), parameters_).value();
    } catch (const FormulaError&) {
      throw LineError{line_, "\"" + at(i) + "\" is no number; expected one for a time"};
    }
  }
  double number_at(std::size_t i, double otherwise) const {
    return is_given(i) ? number_at(i) : otherwise;
  }

 private:
  bool is_given(std::size_t i) const { return i < size() && formulas_[i]; }

  std::vector<std::optional<std::string>> formulas_;
  bool is_named_ = false;
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

// The time within a period: s - n period.
std::string within(const std::string& s, double period) {
  const std::string length = exact_text(period);
  return "(" + length + "*(0.5 + atan(tan(pi*(" + s + "/" + length + " - 0.5)))/pi))";
}

// v1 → v2 → v1, again and again.
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
  if (repeats) s = within(after, period);
  const std::string top = exact_text(rise + width), end = exact_text(rise + width + fall);
  return "if(" + after + " < 0, " + v1 + ", if(" + s + " < " + exact_text(rise) + ", " + v1 +
         " + (" + v2 + " - " + v1 + ")*" + s + "/" + exact_text(rise) + ", if(" + s + " < " + top +
         ", " + v2 + ", if(" + s + " < " + end + ", " + v2 + " + (" + v1 + " - " + v2 + ")*(" + s +
         " - " + top + ")/" + exact_text(fall) + ", " + v1 + "))))";
}

std::string sine(const Values& values, const Times& times, std::vector<Corner>& corners) {
  const std::string offset = values.at_named(0, 0.0), amplitude = values.at_named(1, 1.0);
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
  // Gnucap begins it again.
  const double period = values.number_at(6, 0.0);
  const bool repeats = period > 0.0 && period < times.end;
  for (const std::string& begin : {td1, td2})
    if (const auto corner = number(begin))
      add_corner(corners, *corner, repeats ? period : 0.0, times);
  if (repeats) add_corner(corners, period, period, times);
  const std::string s = repeats ? within("t", period) : "t";
  const auto part = [&](const std::string& from, const std::string& to, const std::string& delay,
                        const std::string& tau) {
    return "if(" + s + " < " + delay + ", 0, (" + to + " - " + from + ")*(1 - exp(-(" + s + " - " +
           delay + ")/" + tau + ")))";
  };
  return v1 + " + " + part(v1, v2, td1, tau1) + " + " + part(v2, v1, td2, tau2);
}

// offset + amplitude sin(2π fc t + index sin(2π fs t))
std::string frequency_modulated(const Values& values, const Times& times) {
  const std::string carrier = values.at(2, 1.0 / times.end), index = values.at(3, 0.0),
                    signal = values.at(4, 1.0 / times.end);
  const std::string degrees = "pi/180*";
  return values.at_named(0, 0.0) + " + " + values.at_named(1, 1.0) + "*sin(2*pi*" + carrier +
         "*t + " + degrees + values.at(5, 0.0) + " + " + index + "*sin(2*pi*" + signal + "*t + " +
         degrees + values.at(6, 0.0) + "))";
}

// amplitude (offset + sin(2π fm s)) sin(2π fc s) with s = t - delay > 0, else 0
std::string amplitude_modulated(const Values& values, const Times& times,
                                std::vector<Corner>& corners) {
  const double delay = values.number_at(4, 0.0);
  add_corner(corners, delay, 0.0, times);
  const std::string s = "max(t - " + exact_text(delay) + ", 0)";
  return values.at(0) + "*(" + values.at(1) + " + sin(2*pi*" + values.at(2, 1.0 / times.end) + "*" +
         s + "))*sin(2*pi*" + values.at(3, 0.0) + "*" + s + ")";
}

}  // namespace

std::string source(const std::vector<std::string>& words, const Scope& scope, const Times& times,
                   int line, const SymbolTable& parameters, std::vector<Corner>* corners) {
  std::vector<Corner> unasked;
  std::vector<Corner>& bends = corners ? *corners : unasked;
  std::string constant = "0";
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    using Names = std::vector<const char*>;
    const auto values = [&](const Names& names) {
      return Values(words, i + 1, scope, line, parameters, names);
    };
    if (word == "pulse")
      return pulse(values({"iv", "pv", "delay", "rise", "fall", "width", "period"}), times, bends);
    if (word == "sin" || word == "sine")
      return sine(values({"offset", "amplitude", "frequency", "delay", "damping"}), times, bends);
    if (word == "pwl") return piecewise_linear(values({}), times, line, bends);
    if (word == "exp")
      return exponential(values({"iv", "pv", "td1", "tau1", "td2", "tau2", "period"}), times,
                         bends);
    if (word == "sffm")
      return frequency_modulated(values({"offset", "amplitude", "carrier", "modindex", "signal"}),
                                 times);
    if (word == "am") return amplitude_modulated(values({}), times, bends);
    if (word == "ac" || word == "distof1" || word == "distof2") {
      while (i + 1 < words.size() && (words[i + 1] == "=" || number(words[i + 1]))) ++i;
    } else if (word == "trnoise" || word == "trrandom") {
      throw LineError{line, "the waveform " + word +
                                " is not supported; expected PULSE, SIN, PWL, EXP, SFFM or AM"};
    } else if (word == "portnum") {
      throw LineError{line, "a source with portnum is not supported"};
    } else if (word != "dc" && word != "=" && word != "tran") {
      constant = formula(word, scope, line);
    }
  }
  return constant;
}

}  // namespace courant::netlist
