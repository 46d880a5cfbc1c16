#include "courant/core/expressions/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "courant/core/numbers/ball.hpp"
#include "courant/core/numbers/digits.hpp"
#include "courant/core/numbers/operation.hpp"
#include "courant/core/numbers/quadruple.hpp"
#include "courant/core/numbers/uncertain.hpp"

namespace courant::taylor {
namespace {

// What series are made of, numbers of 53 or 113 bits or numbers with bounds of their errors, and the functions that
// recurrences start from.
double value_of(double a) { return a; }
double value_of(const Uncertain& a) { return a.value; }
double value_of(const Quadruple& a) { return static_cast<double>(a); }
double value_of(const Digits& a) { return static_cast<double>(a); }
double value_of(const Ball& a) { return static_cast<double>(a); }
bool vanishes(double a) { return a == 0.0; }
bool vanishes(const Uncertain& a) { return a.is_exactly(0.0); }
bool vanishes(const Quadruple& a) { return a == 0.0; }
bool vanishes(const Digits& a) { return a.is_zero(); }
bool vanishes(const Ball& a) { return a.is_zero(); }
bool is_nonzero(double a) { return a != 0.0; }
bool is_nonzero(const Uncertain& a) { return a.is_nonzero(); }
bool is_nonzero(const Quadruple& a) { return !(a == 0.0); }
bool is_nonzero(const Digits& a) { return !a.shrinks(); }
bool is_nonzero(const Ball& a) { return !a.contains_zero(); }
double function(Op op, double a) { return evaluate(op, 0, a, 0.0, 0.0); }
Uncertain function(Op op, const Uncertain& a) { return evaluate(op, a); }
Quadruple function(Op op, const Quadruple& a) { return evaluate(op, a); }
Digits function(Op op, const Digits& a) { return evaluate(op, a); }
Ball function(Op op, const Ball& a) { return evaluate(op, a); }
double power(double a, double p) { return std::pow(a, p); }
Uncertain power(const Uncertain& a, const Uncertain& p) { return pow(a, p); }
Quadruple power(const Quadruple& a, const Quadruple& p) { return pow(a, p); }
Digits power(const Digits& a, const Digits& p) { return pow(a, p); }
Ball power(const Ball& a, const Ball& p) { return pow(a, p); }
double angle(double y, double x) { return std::atan2(y, x); }
Uncertain angle(const Uncertain& y, const Uncertain& x) { return atan2(y, x); }
Quadruple angle(const Quadruple& y, const Quadruple& x) { return atan2(y, x); }
Digits angle(const Digits& y, const Digits& x) { return atan2(y, x); }
Ball angle(const Ball& y, const Ball& x) { return atan2(y, x); }

template <class T>
void multiply(Index K, const T* a, const T* b, T* out) {
  for (Index n = 0; n <= K; ++n) {
    T sum = 0.0;
    for (Index i = 0; i <= n; ++i) sum += a[i] * b[n - i];
    out[n] = sum;
  }
}

template <class T>
void divide(Index K, const T* a, const T* b, T* out) {
  for (Index n = 0; n <= K; ++n) {
    T sum = a[n];
    for (Index i = 1; i <= n; ++i) sum -= b[i] * out[n - i];
    out[n] = sum / b[0];
  }
}

template <class T>
void square_root(Index K, const T* a, T* out) {
  out[0] = function(Op::sqrt, a[0]);
  for (Index n = 1; n <= K; ++n) {
    T sum = a[n];
    for (Index i = 1; i < n; ++i) sum -= out[i] * out[n - i];
    out[n] = sum / (2.0 * out[0]);
  }
}

// Σ_{i=1}^{n} i a_i b_{n-i}: n times the coefficient of tⁿ in ∫ a' b.
template <class T>
T integral(Index n, const T* a, const T* b) {
  T sum = 0.0;
  for (Index i = 1; i <= n; ++i) sum += static_cast<double>(i) * a[i] * b[n - i];
  return sum;
}

// y' = a' y; out[0] is set.
template <class T>
void exponential(Index K, const T* a, T* out) {
  for (Index n = 1; n <= K; ++n) out[n] = integral(n, a, out) / static_cast<double>(n);
}

template <class T>
void logarithm(Index K, const T* a, T* out) {
  out[0] = function(Op::log, a[0]);
  for (Index n = 1; n <= K; ++n) {
    T sum = static_cast<double>(n) * a[n];
    for (Index i = 1; i < n; ++i) sum -= static_cast<double>(i) * out[i] * a[n - i];
    out[n] = sum / (static_cast<double>(n) * a[0]);
  }
}

// s' = a' c, c' = sign · a' s: sine and cosine (sign = -1), hyperbolic ones (sign = +1). s[0], c[0]
// are set.
template <class T>
void sine_and_cosine(Index K, const T* a, double sign, T* s, T* c) {
  for (Index n = 1; n <= K; ++n) {
    s[n] = integral(n, a, c) / static_cast<double>(n);
    c[n] = sign * integral(n, a, s) / static_cast<double>(n);
  }
}

// y' = (1 + sign · y²) a': tangent (sign = +1), hyperbolic tangent (sign = -1). y[0] is set; w
// receives 1 + sign · y².
template <class T>
void tangents(Index K, const T* a, double sign, T* y, T* w) {
  w[0] = 1.0 + sign * y[0] * y[0];
  for (Index n = 1; n <= K; ++n) {
    y[n] = integral(n, a, w) / static_cast<double>(n);
    T sum = 0.0;
    for (Index i = 0; i <= n; ++i) sum += y[i] * y[n - i];
    w[n] = sign * sum;
  }
}

// y with w y' = u', y[0] set.
template <class T>
void integrate_quotient(Index K, const T* u, const T* w, T* y) {
  for (Index n = 1; n <= K; ++n) {
    T sum = static_cast<double>(n) * u[n];
    for (Index i = 1; i < n; ++i) sum -= static_cast<double>(i) * y[i] * w[n - i];
    y[n] = sum / (static_cast<double>(n) * w[0]);
  }
}

// y = a^p for a constant p, from a y' = p a' y.
template <class T>
void constant_power(Index K, const T* a, T p, T* y) {
  y[0] = power(a[0], p);
  for (Index n = 1; n <= K; ++n) {
    T sum = 0.0;
    for (Index i = 1; i <= n; ++i)
      sum += (p * static_cast<double>(i) - static_cast<double>(n - i)) * a[i] * y[n - i];
    y[n] = sum / (static_cast<double>(n) * a[0]);
  }
}

template <class T>
bool is_constant(Index K, const T* a) {
  return std::all_of(a + 1, a + K + 1, [](const T& coefficient) { return vanishes(coefficient); });
}

// Whether a^p is a product of factors a.
template <class T>
bool is_whole(const T& p) {
  if constexpr (std::is_same_v<T, Ball>)
    if (!p.is_exact()) return false;
  const double value = value_of(p);
  return value == std::floor(value) && std::fabs(value) <= 1e6;
}

// aᵏ by repeated squaring; scratch 3 (K+1).
template <class T>
void whole_power(Index K, const T* a, std::int32_t k, T* out, T* scratch) {
  T* base = scratch;
  T* product = base + (K + 1);
  T* one = product + (K + 1);
  std::copy(a, a + K + 1, base);
  std::fill(one, one + K + 1, T(0.0));
  one[0] = 1.0;
  std::copy(one, one + K + 1, out);
  auto exponent = static_cast<std::uint32_t>(k < 0 ? -static_cast<std::int64_t>(k) : k);
  bool first = true;
  while (exponent != 0) {
    if ((exponent & 1U) != 0) {
      if (first)
        std::copy(base, base + K + 1, out);
      else {
        multiply(K, out, base, product);
        std::copy(product, product + K + 1, out);
      }
      first = false;
    }
    exponent >>= 1;
    if (exponent != 0) {
      multiply(K, base, base, product);
      std::copy(product, product + K + 1, base);
    }
  }
  if (k < 0) {
    std::copy(out, out + K + 1, product);
    divide(K, one, product, out);
  }
}

// f ∘ a from f[j] = f⁽ʲ⁾(a_0) / j!, by Horner's rule in a - a_0; scratch 2 (K+1).
template <class T>
void compose(Index K, const T* a, const T* f, T* out, T* scratch) {
  T* shifted = scratch;
  T* product = shifted + (K + 1);
  std::copy(a, a + K + 1, shifted);
  shifted[0] = 0.0;
  std::fill(out, out + K + 1, T(0.0));
  for (Index j = K; j >= 0; --j) {
    multiply(K, out, shifted, product);
    std::copy(product, product + K + 1, out);
    out[0] += f[j];
  }
}

// (-1)ʲ c_k⁽ʲ⁾(s) / j! = G_{j,k} = Σ_i (i+j over j) (-s)ⁱ / (2i+2j+k)!, by summing that.
template <class T>
T stumpff_series(Index j, std::int32_t k, const T& s) {
  const double first = static_cast<double>(2 * j + k);
  T term = 1.0;
  for (double n = 2.0; n <= first; ++n) term = term / n;
  T sum = 0.0;
  for (double i = 0.0; i < 400.0; ++i) {
    const T next = sum + term;
    if (next == sum && i > 0.0) break;
    sum = next;
    const double n = first + 2.0 * i;
    term = term * (-s * (i + 1.0 + static_cast<double>(j)) / ((i + 1.0) * (n + 1.0) * (n + 2.0)));
  }
  return sum;
}

// f[j] = c_k⁽ʲ⁾(s) / j!, to a relative 1e-12 (of the size that f[j] has near s) for j ≤ 15. The
// series loses digits where s ≫ (j+k)²; there G_{j,0}, G_{j,1} come from the differential equation
// of c_0, c_1, upward in j, and s G_{j,k+2} = G_{j-1,k+2} - G_{j,k}, with G_{-1,k+2} = 1/k!, which
// lose digits where the series doesn't.
void stumpff_derivatives(Index K, std::int32_t k, double s, double* f) {
  const auto series_is_better = [&](Index j) {
    const auto order = static_cast<double>(j + k);
    return s < 64.0 || order * order > s;
  };
  if (!series_is_better(0)) {
    const std::int32_t first = k % 2;
    f[0] = stumpff(first, s);
    if (K > 0) f[1] = first == 0 ? 0.5 * stumpff(1, s) : (f[0] - stumpff(0, s)) / (2.0 * s);
    for (Index j = 0; j + 2 <= K; ++j) {
      const auto n = static_cast<double>(j);
      f[j + 2] = ((4.0 * n + 2.0 + 4.0 * first) * (n + 1.0) * f[j + 1] - f[j]) /
                 (4.0 * s * (n + 1.0) * (n + 2.0));
    }
    double inverse_factorial = 1.0;
    for (std::int32_t m = first; m < k; m += 2) {
      for (Index j = 0; j <= K; ++j) f[j] = ((j == 0 ? inverse_factorial : f[j - 1]) - f[j]) / s;
      inverse_factorial /= (m + 1.0) * (m + 2.0);
    }
  }
  for (Index j = 0; j <= K; ++j) {
    if (series_is_better(j)) f[j] = stumpff_series(j, k, s);
    if (j % 2 != 0) f[j] = -f[j];
  }
  f[0] = stumpff(k, s);
}

void stumpff_derivatives(Index K, std::int32_t k, const Uncertain& s, Uncertain* f) {
  std::vector<double> value(static_cast<std::size_t>(K) + 2);
  stumpff_derivatives(K + 1, k, s.value, value.data());
  double inverse_factorial = 1.0;  // 1/(2j+k)!, the size of the terms of f[j]
  for (std::int32_t n = 2; n <= k; ++n) inverse_factorial /= n;
  for (Index j = 0; j <= K; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const auto n = static_cast<double>(2 * j + k);
    const double own = std::fabs(s.value) < 1.0 ? 8.0 * Uncertain::unit : 1e-12;
    f[j] = {value[at], static_cast<double>(j + 1) * std::fabs(value[at + 1]) * s.error +
                           own * std::max(std::fabs(value[at]), inverse_factorial)};
    inverse_factorial /= (n + 1.0) * (n + 2.0);
  }
}

// By the series alone, which loses four digits up to 64, and nine up to 400.
template <class T>
void stumpff_derivatives(Index K, std::int32_t k, const T& s, T* f) {
  constexpr double most = std::is_same_v<T, Digits> ? 400.0 : 64.0;
  for (Index j = 0; j <= K; ++j) {
    f[j] =
        value_of(s) < most ? stumpff_series(j, k, s) : T(std::numeric_limits<double>::quiet_NaN());
    if (j % 2 != 0) f[j] = -f[j];
  }
}

void stumpff_derivatives(Index K, std::int32_t /*k*/, const Ball& /*s*/, Ball* f) {
  std::fill(f, f + K + 1, Ball(std::numeric_limits<double>::quiet_NaN()));
}

// f[j] = g_k⁽ʲ⁾(c) / j! of arccos_factor.
void arccos_factor_derivatives(Index K, std::int32_t k, double c, double* f) {
  double factorial = 1.0;
  for (Index j = 0; j <= K; ++j) {
    if (j > 0) factorial *= static_cast<double>(j);
    f[j] = arccos_factor(k + static_cast<std::int32_t>(j), c) / factorial;
  }
}

void arccos_factor_derivatives(Index K, std::int32_t k, const Uncertain& c, Uncertain* f) {
  std::vector<double> value(static_cast<std::size_t>(K) + 2);
  arccos_factor_derivatives(K + 1, k, c.value, value.data());
  for (Index j = 0; j <= K; ++j) {
    const auto at = static_cast<std::size_t>(j);
    f[j] = {value[at], static_cast<double>(j + 1) * std::fabs(value[at + 1]) * c.error +
                           64.0 * Uncertain::unit * std::fabs(value[at])};
  }
}

template <class T>
void arccos_factor_derivatives(Index K, std::int32_t /*k*/, const T& /*c*/, T* f) {
  std::fill(f, f + K + 1, T(std::numeric_limits<double>::quiet_NaN()));
}

template <class T>
int decided_sign(Index K, const T* a) {
  for (Index i = 0; i <= K; ++i)
    if (is_nonzero(a[i])) return value_of(a[i]) > 0 ? 1 : -1;
  return 0;
}

template <class T>
void carry_out(Op op, std::int32_t k, Index K, const T* a, const T* b, const T* c, T* out,
               T* scratch) {
  switch (op) {
    case Op::negate:
      for (Index i = 0; i <= K; ++i) out[i] = -a[i];
      return;
    case Op::add:
      for (Index i = 0; i <= K; ++i) out[i] = a[i] + b[i];
      return;
    case Op::subtract:
      for (Index i = 0; i <= K; ++i) out[i] = a[i] - b[i];
      return;
    case Op::multiply:
      multiply(K, a, b, out);
      return;
    case Op::divide:
      divide(K, a, b, out);
      return;
    case Op::sqrt:
      square_root(K, a, out);
      return;
    case Op::exp:
      out[0] = function(Op::exp, a[0]);
      exponential(K, a, out);
      return;
    case Op::log:
      logarithm(K, a, out);
      return;
    case Op::sin:
    case Op::cos: {
      const bool sine = op == Op::sin;
      T* s = sine ? out : scratch;
      T* cosine = sine ? scratch : out;
      s[0] = function(Op::sin, a[0]);
      cosine[0] = function(Op::cos, a[0]);
      sine_and_cosine(K, a, -1.0, s, cosine);
      return;
    }
    case Op::sinh:
    case Op::cosh: {
      const bool sine = op == Op::sinh;
      T* s = sine ? out : scratch;
      T* cosine = sine ? scratch : out;
      s[0] = function(Op::sinh, a[0]);
      cosine[0] = function(Op::cosh, a[0]);
      sine_and_cosine(K, a, 1.0, s, cosine);
      return;
    }
    case Op::tan:
      out[0] = function(Op::tan, a[0]);
      tangents(K, a, 1.0, out, scratch);
      return;
    case Op::tanh:
      out[0] = function(Op::tanh, a[0]);
      tangents(K, a, -1.0, out, scratch);
      return;
    case Op::asin:
    case Op::acos: {
      T* w = scratch;
      T* square_root_of_w = scratch + (K + 1);
      multiply(K, a, a, w);
      for (Index i = 1; i <= K; ++i) w[i] = -w[i];
      w[0] = (1.0 - a[0]) * (1.0 + a[0]);
      square_root(K, w, square_root_of_w);
      out[0] = function(Op::asin, a[0]);
      integrate_quotient(K, a, square_root_of_w, out);
      if (op == Op::acos) {
        for (Index i = 0; i <= K; ++i) out[i] = -out[i];
        out[0] = function(Op::acos, a[0]);
      }
      return;
    }
    case Op::atan: {
      T* w = scratch;
      multiply(K, a, a, w);
      w[0] += 1.0;
      out[0] = function(Op::atan, a[0]);
      integrate_quotient(K, a, w, out);
      return;
    }
    case Op::atan2: {  // (x² + y²) θ' = x y' - y x', a = y and b = x
      T* w = scratch;
      T* numerator = scratch + (K + 1);
      multiply(K, a, a, w);
      multiply(K, b, b, numerator);
      for (Index i = 0; i <= K; ++i) w[i] += numerator[i];
      numerator[0] = 0.0;
      for (Index n = 1; n <= K; ++n)
        numerator[n] = (integral(n, a, b) - integral(n, b, a)) / static_cast<double>(n);
      out[0] = angle(a[0], b[0]);
      integrate_quotient(K, numerator, w, out);
      return;
    }
    case Op::abs: {
      const double s = decided_sign(K, a);
      for (Index i = 0; i <= K; ++i) out[i] = s * a[i];
      return;
    }
    case Op::power:
      whole_power(K, a, k, out, scratch);
      return;
    case Op::pow:
      if (!is_constant(K, b)) {
        logarithm(K, a, scratch);
        multiply(K, b, scratch, scratch + (K + 1));
        out[0] = power(a[0], b[0]);
        exponential(K, scratch + (K + 1), out);
      } else if (is_whole(b[0])) {
        whole_power(K, a, static_cast<std::int32_t>(value_of(b[0])), out, scratch);
      } else {
        constant_power(K, a, b[0], out);
      }
      return;
    case Op::min:
    case Op::max: {
      for (Index i = 0; i <= K; ++i) scratch[i] = a[i] - b[i];
      const int s = decided_sign(K, scratch);
      const T* chosen = (op == Op::min) == (s <= 0) ? a : b;
      std::copy(chosen, chosen + K + 1, out);
      return;
    }
    case Op::select: {
      const T* chosen = value_of(a[0]) != 0 ? b : c;
      std::copy(chosen, chosen + K + 1, out);
      return;
    }
    case Op::stumpff:
      stumpff_derivatives(K, k, a[0], scratch);
      compose(K, a, scratch, out, scratch + (K + 1));
      return;
    case Op::arccos_factor:
      arccos_factor_derivatives(K, k, a[0], scratch);
      compose(K, a, scratch, out, scratch + (K + 1));
      return;
    case Op::sign:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::logical_and:
    case Op::logical_or:
    case Op::logical_not:
      std::fill(out, out + K + 1, T(0.0));
      out[0] = evaluate(op, k, value_of(a[0]), b != nullptr ? value_of(b[0]) : 0.0, 0.0);
      return;
    case Op::constant:
    case Op::variable:
      break;
  }
  std::fill(out, out + K + 1, T(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace

void apply(Op op, std::int32_t k, Index K, const double* a, const double* b, const double* c,
           double* out, double* scratch) {
  carry_out(op, k, K, a, b, c, out, scratch);
}

void apply(Op op, std::int32_t k, Index K, const Uncertain* a, const Uncertain* b,
           const Uncertain* c, Uncertain* out, Uncertain* scratch) {
  carry_out(op, k, K, a, b, c, out, scratch);
}

void apply(Op op, std::int32_t k, Index K, const Quadruple* a, const Quadruple* b,
           const Quadruple* c, Quadruple* out, Quadruple* scratch) {
  carry_out(op, k, K, a, b, c, out, scratch);
}

void apply(Op op, std::int32_t k, Index K, const Digits* a, const Digits* b, const Digits* c,
           Digits* out, Digits* scratch) {
  carry_out(op, k, K, a, b, c, out, scratch);
}

void apply(Op op, std::int32_t k, Index K, const Ball* a, const Ball* b, const Ball* c, Ball* out,
           Ball* scratch) {
  carry_out(op, k, K, a, b, c, out, scratch);
}

}  // namespace courant::taylor
