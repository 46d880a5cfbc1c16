#include "courant/core/numbers/special_functions.hpp"

#include <math.h>  // the shared source below is C

namespace courant {
namespace {

// One text, compiled here and handed to the run-time compiler.
//
// Stumpff: the series where |s| < 1 (at most 12 terms to 1e-17). Outside, closed forms of c_0 and
// c_1 and the recurrence upward, which divides by s and so gains accuracy while |s| ≥ 1 and k!
// stays moderate; for larger k the series again, which converges for every s and loses at most
// exp(√|s|)·k!/√|s|^k, small where it is used (k² > |s|).
//
// arccos_factor: g_k = A_k (2/(1+c))^{k+1} F(k+1, 1/2; k+3/2; y) with y = (c-1)/(c+1), |y| < 1 for
// c > 0, and the recurrence upward from the closed form, which multiplies its errors by 1/|y| a
// step where |y| < 1: the series where that would lose more than a factor 16 (at most 100 terms to
// 1e-17 for k ≤ 8), the recurrence elsewhere.
#define COURANT_SHARED_SOURCE                                                                    \
  static double courant_stumpff_series(int k, double s) {                                        \
    double term = 1.0;                                                                           \
    double sum = 0.0;                                                                            \
    int i;                                                                                       \
    for (i = 2; i <= k; ++i) term /= i;                                                          \
    for (i = k; i < k + 400; i += 2) {                                                           \
      double next = sum + term;                                                                  \
      if (next == sum && i > k) break;                                                           \
      sum = next;                                                                                \
      term *= -s / ((i + 1.0) * (i + 2.0));                                                      \
    }                                                                                            \
    return sum;                                                                                  \
  }                                                                                              \
  static double courant_stumpff(int k, double s) {                                               \
    double c, r, inverse_factorial;                                                              \
    int i;                                                                                       \
    if (!(fabs(s) >= 1.0) || (double)k * k > fabs(s) + 8.0) return courant_stumpff_series(k, s); \
    r = sqrt(fabs(s));                                                                           \
    if (k % 2 == 0)                                                                              \
      c = s > 0 ? cos(r) : cosh(r);                                                              \
    else                                                                                         \
      c = s > 0 ? sin(r) / r : sinh(r) / r;                                                      \
    inverse_factorial = 1.0;                                                                     \
    for (i = k % 2; i < k; i += 2) {                                                             \
      c = (inverse_factorial - c) / s;                                                           \
      inverse_factorial /= (i + 1.0) * (i + 2.0);                                                \
    }                                                                                            \
    return c;                                                                                    \
  }                                                                                              \
  static double courant_arccos_factor(int k, double c) {                                         \
    double y = (c - 1.0) / (c + 1.0);                                                            \
    double w, g, previous, lost;                                                                 \
    int i;                                                                                       \
    lost = fabs(y);                                                                              \
    for (i = 1; i < k; ++i) lost *= fabs(y);                                                     \
    if (lost < 0.0625) {                                                                         \
      double term = 2.0 / (1.0 + c);                                                             \
      double sum = 0.0;                                                                          \
      for (i = 0; i < k; ++i) term *= -(i + 1.0) * (i + 1.0) / ((i + 1.5) * (1.0 + c));          \
      for (i = 0; i < 400; ++i) {                                                                \
        double next = sum + term;                                                                \
        if (next == sum && i > 0) break;                                                         \
        sum = next;                                                                              \
        term *= (k + i + 1.0) * (i + 0.5) / ((k + i + 1.5) * (i + 1.0)) * y;                     \
      }                                                                                          \
      return sum;                                                                                \
    }                                                                                            \
    w = (1.0 - c) * (1.0 + c);                                                                   \
    if (c < 1.0)                                                                                 \
      g = acos(c) / sqrt(w);                                                                     \
    else                                                                                         \
      g = acosh(c) / sqrt(-w);                                                                   \
    if (k == 0) return g;                                                                        \
    previous = g;                                                                                \
    g = (c * g - 1.0) / w;                                                                       \
    for (i = 1; i < k; ++i) {                                                                    \
      double next = ((2.0 * i + 1.0) * c * g + (double)i * i * previous) / w;                    \
      previous = g;                                                                              \
      g = next;                                                                                  \
    }                                                                                            \
    return g;                                                                                    \
  }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
COURANT_SHARED_SOURCE
#pragma GCC diagnostic pop

#define COURANT_QUOTE(...) #__VA_ARGS__
#define COURANT_QUOTE_EXPANDED(...) COURANT_QUOTE(__VA_ARGS__)
constexpr char kSource[] = COURANT_QUOTE_EXPANDED(COURANT_SHARED_SOURCE);

}  // namespace

double stumpff(int k, double s) { return courant_stumpff(k, s); }

double arccos_factor(int k, double c) { return courant_arccos_factor(k, c); }

std::string_view special_functions_source() { return kSource; }

}  // namespace courant
