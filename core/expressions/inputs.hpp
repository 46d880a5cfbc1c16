// Inputs: where equations find their unknowns and parameters.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/numbers/as_size.hpp"

namespace courant {

// The places of the numbers that a Function of unknowns y and parameters p takes: those of y, its first group,
// and of the groups of p in the order in which the function declares them. A solver writes y there. The
// numbers stay the caller's; the places are copied without an allocation.
class Inputs {
 public:
  // So many groups at most.
  static constexpr std::size_t kMost = 12;

  Inputs() = default;
  // Throws std::length_error if there are more than kMost.
  Inputs(double* y, std::initializer_list<const double*> parameters)
      : y_(y), count_(parameters.size() + 1) {
    check_count();
    places_[0] = y;
    std::copy(parameters.begin(), parameters.end(), places_.begin() + 1);
  }

  Index count() const { return static_cast<Index>(count_); }
  double* unknowns() const { return y_; }
  const double* operator[](Index group) const { return places_[as_size(group)]; }
  // As Function::value takes them.
  const double* const* data() const { return places_.data(); }

  void set_unknowns(double* y) { places_[0] = y_ = y; }
  void set_parameter(Index group, const double* numbers) { places_[as_size(group)] = numbers; }
  // A group behind the others. Throws std::length_error if it is one too many.
  void add_parameter(const double* numbers) {
    ++count_;
    check_count();
    places_[count_ - 1] = numbers;
  }

  // Without the last group.
  void drop_parameter() { --count_; }

  // Throws std::invalid_argument that names `equations` unless it takes so many groups.
  void require_count(Index groups, const std::string& equations) const {
    if (groups != count())
      throw std::invalid_argument("Inputs: got " + std::to_string(count()) +
                                  " groups, expected the " + std::to_string(groups) + " of " +
                                  equations + ".");
  }

 private:
  void check_count() const {
    if (count_ > kMost)
      throw std::length_error("Inputs: got " + std::to_string(count_) +
                              " groups, expected at most " + std::to_string(kMost) + ".");
  }

  double* y_ = nullptr;
  std::array<const double*, kMost> places_ = {};
  std::size_t count_ = 0;
};

}  // namespace courant
