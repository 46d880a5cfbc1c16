#include "courant/core/taylor.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/operation.hpp"

namespace courant::taylor {
namespace {

void multiply(Index K, const double* a, const double* b, double* out) {
  for (Index n = 0; n <= K; ++n) {
    double sum = 0.0;
    for (Index i = 0; i <= n; ++i) sum += a[i] * b[n - i];
    out[n] = sum;
  }
}

void divide(Index K, const double* a, const double* b, double* out) {
  for (Index n = 0; n <= K; ++n) {
    double sum = a[n];
    for (Index i = 1; i <= n; ++i) sum -= b[i] * out[n - i];
    out[n] = sum / b[0];
  }
}

void square_root(Index K, const double* a, double* out) {
  out[0] = std::sqrt(a[0]);
  for (Index n = 1; n <= K; ++n) {
    double sum = a[n];
    for (Index i = 1; i < n; ++i) sum -= out[i] * out[n - i];
    out[n] = sum / (2.0 * out[0]);
  }
}

// Σ_{i=1}^{n} i a_i b_{n-i}: n times the coefficient of tⁿ in ∫ a' b.
double integral(Index n, const double* a, const double* b) {
  double sum = 0.0;
  for (Index i = 1; i <= n; ++i) sum += static_cast<double>(i) * a[i] * b[n - i];
  return sum;
}

// y' = a' y; out[0] is set.
void exponential(Index K, const double* a, double* out) {
  for (Index n = 1; n <= K; ++n) out[n] = integral(n, a, out) / static_cast<double>(n);
}

void logarithm(Index K, const double* a, double* out) {
  out[0] = std::log(a[0]);
  for (Index n = 1; n <= K; ++n) {
    double sum = static_cast<double>(n) * a[n];
    for (Index i = 1; i < n; ++i) sum -= static_cast<double>(i) * out[i] * a[n - i];
    out[n] = sum / (static_cast<double>(n) * a[0]);
  }
}

// s' = a' c, c' = sign · a' s: sine and cosine (sign = -1), hyperbolic ones (sign = +1). s[0], c[0]
// are set.
void sine_and_cosine(Index K, const double* a, double sign, double* s, double* c) {
  for (Index n = 1; n <= K; ++n) {
    s[n] = integral(n, a, c) / static_cast<double>(n);
    c[n] = sign * integral(n, a, s) / static_cast<double>(n);
  }
}

// y' = (1 + sign · y²) a': tangent (sign = +1), hyperbolic tangent (sign = -1). y[0] is set; w
// receives 1 + sign · y².
void tangents(Index K, const double* a, double sign, double* y, double* w) {
  w[0] = 1.0 + sign * y[0] * y[0];
  for (Index n = 1; n <= K; ++n) {
    y[n] = integral(n, a, w) / static_cast<double>(n);
    double sum = 0.0;
    for (Index i = 0; i <= n; ++i) sum += y[i] * y[n - i];
    w[n] = sign * sum;
  }
}

// y with w y' = u', y[0] set.
void integrate_quotient(Index K, const double* u, const double* w, double* y) {
  for (Index n = 1; n <= K; ++n) {
    double sum = static_cast<double>(n) * u[n];
    for (Index i = 1; i < n; ++i) sum -= static_cast<double>(i) * y[i] * w[n - i];
    y[n] = sum / (static_cast<double>(n) * w[0]);
  }
}

// y = a^p for a constant p, from a y' = p a' y.
void constant_power(Index K, const double* a, double p, double* y) {
  y[0] = std::pow(a[0], p);
  for (Index n = 1; n <= K; ++n) {
    double sum = 0.0;
    for (Index i = 1; i <= n; ++i)
      sum += (p * static_cast<double>(i) - static_cast<double>(n - i)) * a[i] * y[n - i];
    y[n] = sum / (static_cast<double>(n) * a[0]);
  }
}

bool is_constant(Index K, const double* a) {
  return std::all_of(a + 1, a + K + 1, [](double coefficient) { return coefficient == 0.0; });
}

// aᵏ by repeated squaring; scratch 3 (K+1).
void whole_power(Index K, const double* a, std::int32_t k, double* out, double* scratch) {
  double* base = scratch;
  double* product = base + (K + 1);
  double* one = product + (K + 1);
  std::copy(a, a + K + 1, base);
  std::fill(one, one + K + 1, 0.0);
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
void compose(Index K, const double* a, const double* f, double* out, double* scratch) {
  double* shifted = scratch;
  double* product = shifted + (K + 1);
  std::copy(a, a + K + 1, shifted);
  shifted[0] = 0.0;
  std::fill(out, out + K + 1, 0.0);
  for (Index j = K; j >= 0; --j) {
    multiply(K, out, shifted, product);
    std::copy(product, product + K + 1, out);
    out[0] += f[j];
  }
}

// (-1)ʲ c_k⁽ʲ⁾(s) / j! = G_{j,k} = Σ_i (i+j over j) (-s)ⁱ / (2i+2j+k)!, by summing that.
double stumpff_series(Index j, std::int32_t k, double s) {
  const double first = static_cast<double>(2 * j + k);
  double term = 1.0;
  for (double n = 2.0; n <= first; ++n) term /= n;
  double sum = 0.0;
  for (double i = 0.0; i < 400.0; ++i) {
    const double next = sum + term;
    if (next == sum && i > 0.0) break;
    sum = next;
    const double n = first + 2.0 * i;
    term *= -s * (i + 1.0 + static_cast<double>(j)) / ((i + 1.0) * (n + 1.0) * (n + 2.0));
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

int decided_sign(Index K, const double* a) {
  for (Index i = 0; i <= K; ++i)
    if (a[i] != 0.0) return a[i] > 0 ? 1 : -1;
  return 0;
}

}  // namespace

void apply(Op op, std::int32_t k, Index K, const double* a, const double* b, const double* c,
           double* out, double* scratch) {
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
      out[0] = std::exp(a[0]);
      exponential(K, a, out);
      return;
    case Op::log:
      logarithm(K, a, out);
      return;
    case Op::sin:
    case Op::cos: {
      const bool sine = op == Op::sin;
      double* s = sine ? out : scratch;
      double* cosine = sine ? scratch : out;
      s[0] = std::sin(a[0]);
      cosine[0] = std::cos(a[0]);
      sine_and_cosine(K, a, -1.0, s, cosine);
      return;
    }
    case Op::sinh:
    case Op::cosh: {
      const bool sine = op == Op::sinh;
      double* s = sine ? out : scratch;
      double* cosine = sine ? scratch : out;
      s[0] = std::sinh(a[0]);
      cosine[0] = std::cosh(a[0]);
      sine_and_cosine(K, a, 1.0, s, cosine);
      return;
    }
    case Op::tan:
      out[0] = std::tan(a[0]);
      tangents(K, a, 1.0, out, scratch);
      return;
    case Op::tanh:
      out[0] = std::tanh(a[0]);
      tangents(K, a, -1.0, out, scratch);
      return;
    case Op::asin:
    case Op::acos: {
      double* w = scratch;
      double* root = scratch + (K + 1);
      multiply(K, a, a, w);
      for (Index i = 1; i <= K; ++i) w[i] = -w[i];
      w[0] = (1.0 - a[0]) * (1.0 + a[0]);
      square_root(K, w, root);
      out[0] = std::asin(a[0]);
      integrate_quotient(K, a, root, out);
      if (op == Op::acos) {
        for (Index i = 0; i <= K; ++i) out[i] = -out[i];
        out[0] = std::acos(a[0]);
      }
      return;
    }
    case Op::atan: {
      double* w = scratch;
      multiply(K, a, a, w);
      w[0] += 1.0;
      out[0] = std::atan(a[0]);
      integrate_quotient(K, a, w, out);
      return;
    }
    case Op::atan2: {  // (x² + y²) θ' = x y' - y x', a = y and b = x
      double* w = scratch;
      double* numerator = scratch + (K + 1);
      multiply(K, a, a, w);
      multiply(K, b, b, numerator);
      for (Index i = 0; i <= K; ++i) w[i] += numerator[i];
      numerator[0] = 0.0;
      for (Index n = 1; n <= K; ++n)
        numerator[n] = (integral(n, a, b) - integral(n, b, a)) / static_cast<double>(n);
      out[0] = std::atan2(a[0], b[0]);
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
        out[0] = std::pow(a[0], b[0]);
        exponential(K, scratch + (K + 1), out);
      } else if (b[0] == std::floor(b[0]) && std::fabs(b[0]) <= 1e6) {
        whole_power(K, a, static_cast<std::int32_t>(b[0]), out, scratch);
      } else {
        constant_power(K, a, b[0], out);
      }
      return;
    case Op::min:
    case Op::max: {
      for (Index i = 0; i <= K; ++i) scratch[i] = a[i] - b[i];
      const int s = decided_sign(K, scratch);
      const double* chosen = (op == Op::min) == (s <= 0) ? a : b;
      std::copy(chosen, chosen + K + 1, out);
      return;
    }
    case Op::select: {
      const double* chosen = a[0] != 0 ? b : c;
      std::copy(chosen, chosen + K + 1, out);
      return;
    }
    case Op::stumpff:
      stumpff_derivatives(K, k, a[0], scratch);
      compose(K, a, scratch, out, scratch + (K + 1));
      return;
    case Op::arccos_factor: {
      double factorial = 1.0;
      for (Index j = 0; j <= K; ++j) {
        if (j > 0) factorial *= static_cast<double>(j);
        scratch[j] = arccos_factor(k + static_cast<std::int32_t>(j), a[0]) / factorial;
      }
      compose(K, a, scratch, out, scratch + (K + 1));
      return;
    }
    case Op::sign:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::logical_and:
    case Op::logical_or:
    case Op::logical_not:
      std::fill(out, out + K + 1, 0.0);
      out[0] = evaluate(op, k, a[0], b != nullptr ? b[0] : 0.0, 0.0);
      return;
    case Op::constant:
    case Op::variable:
      break;
  }
  std::fill(out, out + K + 1, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace courant::taylor
