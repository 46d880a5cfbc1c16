#include "courant/core/solve/bracketed_root.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace courant {

Bracket bracketed_root(const std::function<double(double)>& f, Bracket within, double f_low,
                       double f_high, double width, unsigned most_evaluations) {
  std::uintmax_t evaluations = most_evaluations;
  const auto [low, high] = boost::math::tools::toms748_solve(
      f, within.low, within.high, f_low, f_high, [&](double a, double b) { return b - a <= width; },
      evaluations);
  return {low, high};
}

}  // namespace courant
