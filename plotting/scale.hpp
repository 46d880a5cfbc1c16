// The scales of an axis, and where its ticks go.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace courant::plot {

// [lower, upper]; made empty, and widened by what it has to include.
struct Interval {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(lower <= upper); }
  double length() const { return upper - lower; }
  bool contains(double value) const { return lower <= value && value <= upper; }
  void include(double value);                    // infinities and NaN are left out
  void include(std::span<const double> values);  // each of them
};

// A mark on an axis; a minor tick has no label.
struct Tick {
  double value;
  std::string label;
};

// The ticks of an axis, and the power of ten that their labels leave out: value = label ×
// 10^exponent.
struct Ticks {
  std::vector<Tick> marks;
  int exponent = 0;
};

// A strictly increasing map from values to lengths along an axis.
//
// To subclass, override do_transform, do_inverse, do_linear_zone and do_ticks.
class Scale {
 public:
  virtual ~Scale() = default;

  double transform(double value) const { return do_transform(value); }
  double inverse(double length) const { return do_inverse(length); }

  // The values among which the scale is linear.
  Interval linear_zone() const { return do_linear_zone(); }

  // Ticks inside the interval, about `about` of them with a label. The interval is finite and has a
  // length.
  Ticks ticks(Interval interval, int about) const { return do_ticks(interval, about); }

  // The interval with `margin` of its length along the axis added on both sides; a single value (to
  // 12 digits) gets room on both sides first.
  Interval padded(Interval interval, double margin) const;

 private:
  virtual double do_transform(double value) const = 0;
  virtual double do_inverse(double length) const = 0;
  virtual Interval do_linear_zone() const = 0;
  virtual Ticks do_ticks(Interval interval, int about) const = 0;
};

// y ↦ y. Ticks at multiples of 1, 2 or 5 times a power of ten.
class LinearScale final : public Scale {
  double do_transform(double value) const override { return value; }
  double do_inverse(double length) const override { return length; }
  Interval do_linear_zone() const override {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  Ticks do_ticks(Interval interval, int about) const override;
};

// y ↦ y/L for |y| ≤ L, and sign(y) (1 + log₁₀(|y|/L)) beyond: a decade outside the threshold L > 0
// is as long as [0, L]. Continuous, odd. Ticks at 0 and ±10^k, minor ones at their multiples by 2
// to 9.
class SymmetricLogScale final : public Scale {
 public:
  // Throws std::invalid_argument unless the threshold is positive and finite.
  explicit SymmetricLogScale(double threshold);

  double threshold() const { return threshold_; }

 private:
  double do_transform(double value) const override;
  double do_inverse(double length) const override;
  Interval do_linear_zone() const override { return {-threshold_, threshold_}; }
  Ticks do_ticks(Interval interval, int about) const override;

  double threshold_;
};

// y ↦ log₁₀ y for y > 0; what is not positive has no place, and is -∞. Ticks at powers of ten with
// minor ones at their multiples, or with labels at 1, 2 and 5 times them where there are few.
class LogScale final : public Scale {
  double do_transform(double value) const override;
  double do_inverse(double length) const override;
  Interval do_linear_zone() const override { return {0, 0}; }
  Ticks do_ticks(Interval interval, int about) const override;
};

// 0, 1, … with a word at each, for values that are no numbers.
class WordScale final : public Scale {
 public:
  explicit WordScale(std::vector<std::string> words) : words_(std::move(words)) {}

 private:
  double do_transform(double value) const override { return value; }
  double do_inverse(double length) const override { return length; }
  Interval do_linear_zone() const override;
  Ticks do_ticks(Interval interval, int about) const override;

  std::vector<std::string> words_;
};

// The least of 1, 2, 5 times a power of ten that cuts `length` > 0 into at most `pieces` steps.
double nice_step(double length, int pieces);

// Digits, after a minus or not, raised: "⁻¹²".
std::string superscript(std::string_view number);

// "10⁻⁴", "0", "−10³": sign · 10^exponent in Unicode.
std::string power_of_ten(int exponent, bool negative = false);

// A number with the given significant digits as one reads it in a text: "0.697421", "−1.16 × 10⁻⁴".
std::string readable(double value, int digits = 6);

}  // namespace courant::plot
