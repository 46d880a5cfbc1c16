// Loops over arrays of numbers, two at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "courant/core/numbers/vectors.hpp"

namespace courant {

// Two numbers, which every 64-bit machine takes at once.
using Pair = Eigen::Array2d;

template <class Numbers>
concept PairOrNumber = std::same_as<Numbers, Pair> || std::same_as<Numbers, double>;

// f(i, Pair()) for i = begin, begin + 2, …; where one number is left, f(i, double()) for that. The second
// argument says by its type alone what f is to read.
template <class F>
[[gnu::always_inline]] inline void for_each_pair(Index begin, Index end, const F& f) {
  Index i = begin;
  for (; i + 1 < end; i += 2) f(i, Pair());
  if (i < end) f(i, double());
}

template <PairOrNumber Numbers>
inline Numbers read(const double* from) {
  if constexpr (std::same_as<Numbers, Pair>)
    return Eigen::Map<const Pair>(from);
  else
    return *from;
}
inline void write(double* to, const Pair& numbers) { Eigen::Map<Pair>{to} = numbers; }
inline void write(double* to, double number) { *to = number; }

// to = from, `count` numbers; without the call that an assignment of Eigen is, which takes longer than a few numbers.
inline void copy_pairs(const double* from, Index count, double* to) {
  for_each_pair(0, count,
                [&]<class Numbers>(Index i, Numbers) { write(to + i, read<Numbers>(from + i)); });
}

inline Pair magnitude(const Pair& numbers) { return numbers.abs(); }
inline double magnitude(double number) { return std::fabs(number); }
inline Pair larger(const Pair& a, const Pair& b) { return a.max(b); }
inline Pair larger(const Pair& a, double b) { return a.max(b); }
inline double larger(double a, double b) { return std::max(a, b); }
inline Pair smaller(const Pair& a, const Pair& b) { return a.min(b); }
inline double smaller(double a, double b) { return std::min(a, b); }
inline bool is_at_most(const Pair& a, const Pair& b) { return (a <= b).all(); }
inline bool is_at_most(double a, double b) { return a <= b; }

// Σ of what is added, in two parts: even places and odd ones. A program in C that does the same gets the same
// bits.
class PairSum {
 public:
  void add(const Pair& numbers) { parts_ += numbers; }
  void add(double number) { parts_[0] += number; }
  double value() const { return parts_[0] + parts_[1]; }

 private:
  Pair parts_ = Pair::Zero();
};

// The largest of 0 and what is added; without a promise about what is not a number.
class PairMaximum {
 public:
  void add(const Pair& numbers) { parts_ = parts_.max(numbers); }
  void add(double number) { parts_[0] = std::max(parts_[0], number); }
  double value() const { return std::max(parts_[0], parts_[1]); }

 private:
  Pair parts_ = Pair::Zero();
};

// Whether all of them are: 0 · ±∞ and 0 · NaN are NaN. Many are added up in several sums, which do not wait for each
// other.
inline bool are_finite(const double* numbers, Index count) {
  PairSum sum;
  Index i = 0;
  if (count >= 8) {
    Pair sums[4] = {Pair::Zero(), Pair::Zero(), Pair::Zero(), Pair::Zero()};
    for (; i + 7 < count; i += 8)
      for (Index k = 0; k < 4; ++k) sums[k] += 0.0 * read<Pair>(numbers + i + 2 * k);
    sum.add(Pair((sums[0] + sums[1]) + (sums[2] + sums[3])));
  }
  for_each_pair(i, count, [&]<class Numbers>(Index k, Numbers) {
    sum.add(Numbers(0.0 * read<Numbers>(numbers + k)));
  });
  return sum.value() == 0.0;
}

}  // namespace courant
