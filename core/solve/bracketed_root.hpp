// A zero of a function between two places where its signs differ.
#pragma once

#include <functional>

namespace courant {

// An interval in which a function changes its sign.
struct Bracket {
  double low, high;
};

// Shortens an interval until it is as short as `width`, or f has been evaluated `most_evaluations` times:
// algorithm 748 of ACM TOMS (G. Alefeld, F. Potra, Y. Shi, 1995). f_low and f_high are the values at its ends, of
// which one is 0 or the signs differ; throws std::exception otherwise.
Bracket bracketed_root(const std::function<double(double)>& f, Bracket within, double f_low,
                       double f_high, double width, unsigned most_evaluations);

}  // namespace courant
