// Functions that exponentials and logarithms need to be smooth at the zero section.
#pragma once

#include <string_view>

namespace courant {

// Stumpff function c_k(s) = Σ_{i≥0} (-s)^i / (2i+k)!, entire in s; k ≥ 0.
//
//   c_0(θ²) = cos θ,   c_1(θ²) = sin θ / θ,   c_2(θ²) = (1 - cos θ) / θ²,   c_0(-θ²) = cosh θ, …
//   c_k' = (k c_{k+2} - c_{k+1}) / 2,         s c_{k+2} = 1/k! - c_k
//
// An exponential map written with c_k(‖v‖²) is analytic at v = 0, to every order.
double stumpff(int k, double s);

// The k-th derivative of g(c) = arccos(c) / √(1 - c²), analytic on c > -1; k ≥ 0.
//
//   g(cos θ) = θ / sin θ,   g(cosh θ) = θ / sinh θ
//   (1 - c²) g_{k+1} = (2k+1) c g_k + k² g_{k-1}      for k ≥ 1
//
// A logarithm written with g(⟨x, y⟩) is analytic at y = x, on spheres, rotations and hyperboloids.
// Infinite at c = -1 (the antipode, where the logarithm is not defined), not a number below.
double arccos_factor(int k, double c);

// The same two functions as C source, for code generated at run time: the same text, so the same
// bits.
std::string_view special_functions_source();

}  // namespace courant
