#include "courant/plotting/scale.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "courant/plotting/digits.hpp"
#include "courant/plotting/svg.hpp"

namespace courant::plot {

namespace {

constexpr const char* minus_sign = "\u2212";

// Fixed decimals, with the sign that typesetting uses.
std::string fixed(double value, int decimals) {
  const std::string size = digits(std::abs(value), std::chars_format::fixed, decimals);
  const bool zero = size.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? minus_sign : "") + size;
}

int floor_log10(double positive) { return static_cast<int>(std::floor(std::log10(positive))); }

}  // namespace

void Interval::include(double value) {
  if (!std::isfinite(value)) return;
  lower = std::min(lower, value);
  upper = std::max(upper, value);
}

void Interval::include(std::span<const double> values) {
  for (const double value : values) include(value);
}

Interval Scale::padded(Interval interval, double margin) const {
  // 1e-12: a variation that a double of this size cannot show in four digits is none.
  const double size = std::max(std::abs(interval.lower), std::abs(interval.upper));
  double lower = transform(interval.lower), upper = transform(interval.upper);
  if (interval.length() <= 1e-12 * size) {
    const double room = lower == 0 ? 1 : std::abs(lower) / 2;
    lower -= room;
    upper += room;
  }
  const double pad = margin * (upper - lower);
  return {inverse(lower - pad), inverse(upper + pad)};
}

Ticks LinearScale::do_ticks(Interval interval, int about) const {
  const double step = nice_step(interval.length(), about);
  const double size = std::max(std::abs(interval.lower), std::abs(interval.upper));
  Ticks ticks;
  if (const int power = floor_log10(size); power >= 5 || power <= -4) ticks.exponent = power;
  // A step of 5 × 10^k has k decimals; the small number keeps log10(1e-k) from falling below -k.
  const int step_power = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const int decimals = std::clamp(ticks.exponent - step_power, 0, 17);
  const double first = std::ceil(interval.lower / step - 1e-9);
  const double last = std::floor(interval.upper / step + 1e-9);
  for (double multiple = first; multiple <= last; ++multiple) {
    const double value = multiple * step;
    ticks.marks.push_back({value, fixed(value / std::pow(10, ticks.exponent), decimals)});
  }
  return ticks;
}

SymmetricLogScale::SymmetricLogScale(double threshold) : threshold_(threshold) {
  if (!(threshold > 0) || !std::isfinite(threshold)) {
    throw std::invalid_argument("SymmetricLogScale: threshold is " + readable(threshold) +
                                ", expected a positive number.");
  }
}

double SymmetricLogScale::do_transform(double value) const {
  const double ratio = std::abs(value) / threshold_;
  return std::copysign(ratio <= 1 ? ratio : 1 + std::log10(ratio), value);
}

double SymmetricLogScale::do_inverse(double length) const {
  const double size = std::abs(length);
  return std::copysign(threshold_ * (size <= 1 ? size : std::pow(10, size - 1)), length);
}

Ticks SymmetricLogScale::do_ticks(Interval interval, int about) const {
  Ticks ticks;
  const auto mark = [&](double value, std::string label) {
    if (interval.contains(value)) ticks.marks.push_back({value, std::move(label)});
  };
  const int least = static_cast<int>(std::ceil(std::log10(threshold_) - 1e-9));
  const double largest = std::max({std::abs(interval.lower), std::abs(interval.upper), threshold_});
  const int greatest = floor_log10(largest) + 1;
  const double decades = transform(interval.upper) - transform(interval.lower);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / about)));
  mark(0, "0");
  for (int power = least; power <= greatest; ++power) {
    const bool labelled = (power - least) % stride == 0;
    const double decade = std::pow(10, power);
    for (const bool negative : {false, true}) {
      const double sign = negative ? -1 : 1;
      mark(sign * decade, labelled ? power_of_ten(power, negative) : "");
      for (int digit = 2; digit <= 9 && stride == 1; ++digit) mark(sign * digit * decade, "");
    }
  }
  std::sort(ticks.marks.begin(), ticks.marks.end(),
            [](const Tick& a, const Tick& b) { return a.value < b.value; });
  return ticks;
}

double LogScale::do_transform(double value) const {
  return value > 0 ? std::log10(value) : -std::numeric_limits<double>::infinity();
}

double LogScale::do_inverse(double length) const { return std::pow(10, length); }

Ticks LogScale::do_ticks(Interval interval, int about) const {
  Ticks ticks;
  if (!(interval.lower > 0)) return ticks;
  const double decades = transform(interval.upper) - transform(interval.lower);
  const int least = floor_log10(interval.lower), greatest = floor_log10(interval.upper);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / about)));
  constexpr double few = 2;  // decades
  for (int power = least; power <= greatest; ++power) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10, power);
      if (!interval.contains(value)) continue;
      const bool labelled =
          digit == 1 ? power % stride == 0 : decades < few && (digit == 2 || digit == 5);
      const std::string factor = digit == 1 ? "" : std::to_string(digit) + "·";
      if (labelled)
        ticks.marks.push_back({value, factor + power_of_ten(power)});
      else if (digit == 1 || stride == 1)
        ticks.marks.push_back({value, ""});
    }
  }
  return ticks;
}

Interval WordScale::do_linear_zone() const {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

Ticks WordScale::do_ticks(Interval interval, int about) const {
  Ticks ticks;
  const std::size_t stride =
      std::max<std::size_t>(1, words_.size() / static_cast<std::size_t>(std::max(1, about)));
  for (std::size_t i = 0; i < words_.size(); i += stride) {
    const auto value = static_cast<double>(i);
    if (interval.contains(value)) ticks.marks.push_back({value, words_[i]});
  }
  return ticks;
}

double nice_step(double length, int pieces) {
  const double coarsest = length / pieces;
  const double decade = std::pow(10, floor_log10(coarsest));
  for (const double multiple : {1.0, 2.0, 5.0}) {
    if (multiple * decade >= coarsest * (1 - 1e-9)) return multiple * decade;
  }
  return 10 * decade;
}

std::string superscript(std::string_view number) {
  static constexpr std::array<const char*, 10> raised = {"⁰", "¹", "²", "³", "⁴",
                                                         "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char digit : number)
    text += digit == '-' ? "⁻" : raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string power_of_ten(int exponent, bool negative) {
  return (negative ? minus_sign : "") + ("10" + superscript(std::to_string(exponent)));
}

std::string readable(double value, int digits) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value < 0 ? "\u2212∞" : "∞";
  if (value == 0) return "0";
  // Scientific first: its exponent is that of the rounded number, so 9.9999999 counts as 10.
  const std::string text = plot::digits(value, std::chars_format::scientific, digits - 1);
  const std::size_t e = text.find('e');
  int power = 0;
  const char* const power_begin = text.data() + e + (text[e + 1] == '+' ? 2 : 1);
  std::from_chars(power_begin, text.data() + text.size(), power);
  const auto trimmed = [](std::string number) {
    if (number.find('.') == std::string::npos) return number;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number;
  };
  if (power >= -3 && power < std::max(digits, 6)) {
    return trimmed(fixed(value, std::max(0, digits - 1 - power)));
  }
  std::string mantissa = text.substr(0, e);
  if (mantissa.front() == '-') mantissa.replace(0, 1, minus_sign);
  return trimmed(std::move(mantissa)) + " × " + power_of_ten(power);
}

}  // namespace courant::plot
