#include "ladder_starts.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

constexpr std::array kinds = {"catalogued", "generic",     "zeros", "first axis", "second axis",
                              "at rest",    "right angle", "small", "SI units",   "all equal"};

// The numbers of a start of this kind, made from those of the catalogue.
VectorXd numbers(const std::string& kind, const VectorXd& given, std::mt19937& generator) {
  const Index n = given.size();
  VectorXd x = given;
  if (kind == "generic") {
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    for (double& number : x) number += uniform(generator) * (1.0 + std::fabs(number));
  } else if (kind == "at rest") {
    x.tail(n / 2).setZero();
  } else if (kind == "small") {
    x *= 1e-8;
  } else if (kind == "SI units") {
    for (Index i = 0; i < n; ++i) x[i] *= i % 2 == 0 ? 1e-3 : 1e3;
  } else if (kind == "all equal") {
    x.setOnes();
  } else if (kind != "catalogued") {
    x.setZero();
    if (kind == "first axis" || kind == "right angle") x[0] = 1.0;
    if (kind == "second axis") x[std::min<Index>(1, n - 1)] = -1.0;
    if (kind == "right angle" && n > 1) x[1] = std::cos(std::numbers::pi / 2);
  }
  return x;
}

// Four vortices at different places, for kinds where numbers() has two at one.
VectorXd vortex_places(const std::string& kind) {
  VectorXd x = VectorXd::Zero(16);
  const double zero = kind == "right angle" ? std::cos(std::numbers::pi / 2) : 0.0;
  if (kind == "first axis")
    x.head(4) << -3, -1, 1, 2.5;
  else if (kind == "second axis")
    x.segment(4, 4) << -3, -1, 1, 2.5;
  else if (kind == "all equal")
    x.head(8) << 1, 1, -1, -1, 1, -1, 1, -1;
  else
    x.head(8) << 1, zero, -1, zero, zero, 1, zero, -1;
  return x;
}

// What the kinds must leave alone: the formulas of some systems are not defined everywhere, and
// singular points are points.
void keep_apart(const KnownLadder& known, KnownStart& start) {
  VectorXd& x = start.problem.guess.x;
  const VectorXd& given = known.problem.guess.x;
  const auto is = [&](const char* name) { return known.name == name; };
  const bool is_zero = x[0] == 0.0;
  if (is("four vortices") &&
      (x[0] == x[1] || x[0] == 0.0 || x[1] == 0.0 || start.kind == "right angle"))
    x = vortex_places(start.kind);
  // Their velocities grow like 1/x and derivatives of order k like x^(-1-2k): millimetres are small.
  if (is("four vortices") && start.kind == "small") x = 1e-3 * given;
  if (is("relativistic particle with einbein") && std::fabs(x[2]) < 1e-12) x[2] = 1.0;
  if (is("Lotka-Volterra Lagrangian"))
    for (double& number : x.head(2)) number = number > 1e-12 ? number : 1.0;
  // z² = 0
  if (is("Cawley")) x[2] = 0.0;
  // The branches of a parallelogram meet where all bars lie on one line.
  if (is("parallelogram linkage") && (start.kind == "small" || start.kind == "SI units"))
    x.head(3) = given.head(3);
  if (is("parallelogram linkage") && is_zero && start.kind != "second axis")
    start.verdict = Verdict::rank_change, start.dimensions.clear();
  if (is("parallelogram linkage, flat")) x.head(3).setZero();
  if (is("lemniscate at its node")) x.head(2).setZero();
  // p_θ = r² (θ' - a) determines θ' where r is not 0.
  if (is("Christ-Lee") && is_zero) start.verdict = Verdict::rank_change, start.dimensions.clear();
  // x' = x
  if (is("x x' = x² at the origin") && !is_zero)
    start.verdict = Verdict::regular, start.dimensions = {{1, 1}, {1, 1}};
}

// A point with as many zeros as there can be: e₃ on S², the unit of SO(3), at rest.
VectorXd corner(const Manifold& M) {
  VectorXd x = VectorXd::Zero(M.ambient_dimension());
  if (M.ambient_dimension() >= 9)
    x[0] = x[4] = x[8] = 1.0;
  else
    x[2] = 1.0;
  return x;
}

using Term = std::function<Expr(V arguments, std::mt19937& choice)>;

Problem with(const Problem& problem, std::mt19937& generator, const Term& term) {
  Problem result = problem;
  const auto seed = generator();
  result.system = std::make_shared<FormulaSystem>(
      problem.system->manifold(), problem.system->auxiliary_size(),
      problem.system->equation_count(), [system = problem.system, term, seed](V x, V v, V z, T t) {
        std::mt19937 choice(seed);
        ExprVector arguments(x.size() + v.size() + z.size());
        arguments << x, v, z;
        ExprVector F = system->residual(x, v, z, t);
        for (Expr& equation : F) equation += term(arguments, choice);
        return F;
      });
  return result;
}

Expr any(V arguments, std::mt19937& choice) {
  return arguments[static_cast<Index>(choice() % static_cast<std::uint32_t>(arguments.size()))];
}

}  // namespace

Problem with_planted_round_off(const Problem& problem, std::mt19937& generator) {
  return with(problem, generator, [](V arguments, std::mt19937& choice) {
    const Expr a = any(arguments, choice) + 0.3;
    return (square(sin(a)) + square(cos(a)) - 1) * any(arguments, choice);
  });
}

Problem with_cancelled_products(const Problem& problem, std::mt19937& generator) {
  return with(problem, generator, [](V arguments, std::mt19937& choice) {
    const Expr a = any(arguments, choice), b = any(arguments, choice);
    return (a + 0.7) * b - a * b - 0.7 * b;
  });
}

std::vector<KnownStart> ten_starts(const KnownLadder& known, unsigned seed) {
  std::vector<KnownStart> starts;
  std::mt19937 generator(seed);
  const Manifold& M = *known.problem.system->manifold();
  const bool is_flat = M.dimension() == M.ambient_dimension();
  for (const std::string kind : kinds) {
    KnownStart start = {kind, known.problem, known.verdict, known.dimensions};
    VectorXd& x = start.problem.guess.x;
    if (is_flat) {
      x = numbers(kind, x, generator);
      if (kind == "small") {
        start.problem.guess.v *= 1e-8;
        start.problem.guess.z *= 1e-8;
      }
      keep_apart(known, start);
    } else if (kind != "catalogued") {
      const VectorXd direction = VectorXd::LinSpaced(M.dimension(), 0.7, -0.4);
      const VectorXd base = corner(M);
      x = M.retract(base, M.tangent_basis(base) * numbers(kind, direction, generator));
    }
    starts.push_back(std::move(start));
  }
  return starts;
}

}  // namespace courant::examples
