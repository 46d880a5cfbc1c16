// MeantNumber: what a person means who writes a number.
#pragma once

#include <optional>
#include <string>

namespace courant {

// The exact number behind a double that was typed: the shortest decimal that reads as that double, so that 0.6 and -0.8
// lie on the circle; or, where the decimal is long, a fraction or a fraction of π whose terms are small and that reads
// as the same double, so that 1/3 is a third. A value.
struct MeantNumber {
  // p/q · π^power_of_pi.
  struct Fraction {
    int p = 0, q = 1, power_of_pi = 0;  // -1, 0 or 1

    // In numbers of some precision, `pi` among them.
    template <class Number>
    Number value(const Number& pi) const {
      const Number ratio = Number(p) / Number(q);
      return power_of_pi == 0 ? ratio : power_of_pi > 0 ? Number(ratio * pi) : Number(ratio / pi);
    }
  };

  bool is_negative = false;
  std::optional<Fraction> fraction;  // else digits · 10^exponent
  std::string digits;
  int exponent = 0;
};

// Of a number that is finite and not 0.
MeantNumber meant_number(double number);

}  // namespace courant
