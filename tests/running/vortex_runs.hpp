// Folders of finished runs to read: the four vortices of Section 6.3, computed here by hand-written
// schemes.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "../core/files/temporary_folder.hpp"

namespace courant::test {

// The shortest digits that read back to the same double.
inline std::string shortest(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

using Vortices = std::array<double, 8>;  // x¹ … x⁴, y¹ … y⁴
constexpr std::array<double, 4> strengths = {1, 1, -1, -1};
constexpr Vortices leapfrogging = {-1, 1, -1, 1, 2, 2, -2, -2};

inline Vortices combination(const Vortices& a, double s, const Vortices& b) {
  Vortices sum;
  for (std::size_t i = 0; i < 8; ++i) sum[i] = a[i] + s * b[i];
  return sum;
}

// Eq. (6).
inline Vortices velocity(const Vortices& q) {
  Vortices v{};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == j) continue;
      const double dx = q[j] - q[k], dy = q[4 + j] - q[4 + k];
      const double weight = strengths[k] / (2 * std::numbers::pi * (dx * dx + dy * dy));
      v[j] -= weight * dy;
      v[4 + j] += weight * dx;
    }
  }
  return v;
}

// Eq. (9), over unordered pairs.
inline double energy(const Vortices& q) {
  double sum = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t k = j + 1; k < 4; ++k) {
      sum += strengths[j] * strengths[k] *
             std::log(std::pow(q[j] - q[k], 2) + std::pow(q[4 + j] - q[4 + k], 2));
    }
  }
  return sum / (4 * std::numbers::pi);
}

// The fixed point of q ↦ base + h X((from + q)/2), to round-off.
inline Vortices implicit_midpoint(const Vortices& base, const Vortices& from, Vortices q,
                                  double h) {
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Vortices middle = combination(combination(Vortices{}, 0.5, from), 0.5, q);
    const Vortices next = combination(base, h, velocity(middle));
    double change = 0;
    for (std::size_t i = 0; i < 8; ++i) change = std::max(change, std::abs(next[i] - q[i]));
    q = next;
    if (change < 1e-14) break;
  }
  return q;
}

inline Vortices explicit_midpoint(const Vortices& q, double h) {
  return combination(q, h, velocity(combination(q, h / 2, velocity(q))));
}

using Path = std::vector<Vortices>;

inline Path rk2_path(int steps, double h = 1) {
  Path path = {leapfrogging};
  while (static_cast<int>(path.size()) <= steps) path.push_back(explicit_midpoint(path.back(), h));
  return path;
}

// Method 2, Eq. (15).
inline Path one_step_path(int steps, double h = 1) {
  Path path = {leapfrogging};
  while (static_cast<int>(path.size()) <= steps) {
    path.push_back(
        implicit_midpoint(path.back(), path.back(), explicit_midpoint(path.back(), h), h));
  }
  return path;
}

// Method 1, Eq. (13): q₂ = q₀ + h (X(q₀₁) + X(q₁₂)) at the midpoints, q₁ from RK2.
inline Path two_step_path(int steps, double h = 1) {
  Path path = rk2_path(1, h);
  while (static_cast<int>(path.size()) <= steps) {
    const Vortices &q0 = path[path.size() - 2], &q1 = path.back();
    const Vortices middle = combination(combination(Vortices{}, 0.5, q0), 0.5, q1);
    const Vortices base = combination(q0, h, velocity(middle));
    path.push_back(implicit_midpoint(base, q1, explicit_midpoint(q1, h), h));
  }
  return path;
}

inline std::string csv(const Path& path, double h = 1) {
  std::string text = "t,x[0],x[1],x[2],x[3],y[0],y[1],y[2],y[3],H,spread\n";
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Vortices& q = path[k];
    text += shortest(static_cast<double>(k) * h);
    for (const double value : q) text += "," + shortest(value);
    text += "," + shortest(energy(q));
    text += "," + shortest(std::pow(q[1] - q[0], 2) + std::pow(q[5] - q[4], 2)) + "\n";
  }
  return text;
}

inline nlohmann::ordered_json summary(const Path& path, const std::string& method, double h = 1) {
  using Json = nlohmann::ordered_json;
  double least = energy(path.front()), greatest = least;
  for (const Vortices& q : path)
    least = std::min(least, energy(q)), greatest = std::max(greatest, energy(q));
  const double initial = energy(path.front()),
               drift = std::max(greatest - initial, initial - least);
  const auto steps = static_cast<double>(path.size()) - 1;
  const Json level_0 = {{"k", 0},     {"dim_S", 16}, {"dim_M", 8},
                        {"fibre", 8}, {"gap", 1e15}, {"residual", 1e-17}};
  Json level_1 = {{"k", 1},     {"dim_S", 8},  {"dim_M", 8},
                  {"fibre", 0}, {"gap", 3e14}, {"residual", 2e-17}};
  Json level_2 = level_1;
  level_2["k"] = 2;
  return {{"status", "completed"},
          {"message", ""},
          {"system", "point vortices (4)"},
          {"method", method},
          {"steps", path.size() - 1},
          {"time", {{"start", 0}, {"end", steps * h}, {"step", h}}},
          {"observables",
           {{"H",
             {{"initial", initial},
              {"final", energy(path.back())},
              {"min", least},
              {"max", greatest},
              {"max_drift", drift}}},
            {"spread",
             {{"initial", 4.0}, {"final", 4.1}, {"min", 1.1}, {"max", 4.2}, {"max_drift", 2.9}}}}},
          {"ladder",
           {{"verdict", "regular"},
            {"index", 1},
            {"gauge_dimension", 0},
            {"degrees_of_freedom", 8},
            {"levels", Json::array({level_0, level_1, level_2})}}},
          {"expectations", Json::array({{{"description", "H: max drift"},
                                         {"passed", drift < 2e-4},
                                         {"value", drift},
                                         {"bound", 2e-4}}})},
          {"solver",
           {{"iterations_per_step", 3.02}, {"factorizations_per_step", 1.0}, {"failures", 0}}},
          {"backend", "native"},
          {"wall_seconds", 0.00213},
          {"cpu_seconds", 0.00211},
          {"steps_per_second", 140845.0}};
}

inline void write_run(const std::filesystem::path& folder, const Path& path,
                      const std::string& method) {
  write_text(folder / "trajectory.csv", csv(path));
  write_text(folder / "summary.json", summary(path, method).dump(2) + "\n");
  const nlohmann::ordered_json experiment = {
      {"title", "Point vortices: two leapfrogging pairs"},
      {"system", {{"type", "point-vortices"}, {"strengths", {1, 1, -1, -1}}}},
      {"initial", {{"x", {-1, 1, -1, 1}}, {"y", {2, 2, -2, -2}}}},
      {"method", {{"type", method}}},
      {"time", {{"step", 1.0}, {"end", static_cast<double>(path.size()) - 1}}},
      {"observe", {{"spread", "(x[1]-x[0])^2 + (y[1]-y[0])^2"}}}};
  write_text(folder / "experiment.json", experiment.dump(2) + "\n");
}

}  // namespace courant::test
