#include "ladder_catalogue.hpp"

#include <numbers>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

std::shared_ptr<const Euclidean> space(Index n) { return std::make_shared<Euclidean>(n); }

}  // namespace

Dimensions falling(Index dim_S, Index dim_M, Index steps) {
  Dimensions result;
  for (Index k = 0; k < steps; ++k) result.emplace_back(dim_S - k, dim_M - k);
  result.emplace_back(dim_M - steps + 1, dim_M - steps + 1);
  result.push_back(result.back());
  return result;
}

Dimensions dimensions(const ConstraintLadder& ladder) {
  Dimensions result;
  for (const LadderLevel& level : ladder.levels) result.emplace_back(level.dim_S, level.dim_M);
  return result;
}

SystemPointer lagrangian(Index n, Lagrangian::Formula L, ImplicitSystem::Names names) {
  const auto phase_space = std::make_shared<CotangentBundle>(space(n));
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                       std::make_shared<Lagrangian>(phase_space, std::move(L)),
                                       std::move(names));
}

SystemPointer flat(Index n, Index m, Index equation_count, FormulaSystem::Formula formula,
                   ImplicitSystem::Names names) {
  return std::make_shared<FormulaSystem>(space(n), m, equation_count, std::move(formula),
                                         std::move(names));
}

InitialGuess at(std::initializer_list<double> x) {
  InitialGuess guess;
  guess.x = Eigen::Map<const VectorXd>(x.begin(), static_cast<Index>(x.size()));
  return guess;
}

// L = ⟨α(q), q'⟩ - H(q), strengths Γ (Section 6 of the paper).
SystemPointer vortices() {
  const Eigen::Vector4d strength(1, 1, -1, -1);
  return lagrangian(8, [strength](V q, V w, T) {
    Expr kinetic = 0.0, H = 0.0;
    for (Index j = 0; j < 4; ++j) {
      kinetic += 0.5 * strength[j] * (q[j] * w[4 + j] - q[4 + j] * w[j]);
      for (Index k = 0; k < j; ++k)
        H += strength[j] * strength[k] / (4 * std::numbers::pi) *
             log(square(q[j] - q[k]) + square(q[4 + j] - q[4 + k]));
    }
    return kinetic - H;
  });
}

InitialGuess vortex_guess() {
  return {.x = (VectorXd(16) << -1, 1, -1, 1, 2, 2, -2, -2, VectorXd::Zero(8)).finished()};
}

SystemPointer closed_port_hamiltonian() {
  const auto M = std::make_shared<Euclidean>(4);
  const auto J = [](V) {
    ExprMatrix matrix = ExprMatrix::Zero(4, 4);
    matrix(0, 2) = matrix(1, 3) = 1.0;
    matrix(2, 0) = matrix(3, 1) = -1.0;
    return matrix;
  };
  const auto B = [](V) {
    ExprMatrix column = ExprMatrix::Zero(4, 1);
    column(1, 0) = 0.5;
    column(3, 0) = 1.0;
    return column;
  };
  const auto H = [](V x, T) {
    return (square(x[2]) + square(x[3])) / 2.0 + square(x[0]) / 2.0 + square(square(x[0])) / 4.0 +
           square(x[1]);
  };
  return std::make_shared<DiracSystem>(std::make_shared<ClosedPortHamiltonian>(M, J, 1, B),
                                       std::make_shared<Hamiltonian>(M, H));
}

SystemPointer cartesian_pendulum() {
  return flat(
      4, 1, 5,
      [](V x, V v, V z, T) {
        return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 9.81,
                          square(x[0]) + square(x[1]) - 1});
      },
      {{"x", "y", "p_x", "p_y"}, {"lambda"}, {"x' = p_x", "y' = p_y", "p_x'", "p_y'", "length"}});
}

std::vector<KnownLadder> errata() {
  return {
      {"four vortices",
       {vortices(), vortex_guess()},
       {{16, 8}, {8, 8}, {8, 8}},
       Verdict::regular,
       1},
      {"Cartesian pendulum",
       {cartesian_pendulum(), at({0.6, -0.9, 0.1, 0.3})},
       {{4, 3}, {3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       2},
      // x' = p, p' = -∇V + λ (-y, 0, 1), z' = y x'
      {"nonholonomic particle",
       {flat(6, 1, 7,
             [](V x, V v, V z, T) {
               return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + x[0] + z[0] * x[1],
                                 v[4] + x[1], v[5] - z[0], x[5] - x[1] * x[3]});
             }),
        at({0.3, 0.7, 0.2, 1.0, 0.4, 0.5})},
       {{6, 5}, {5, 5}, {5, 5}},
       Verdict::regular,
       1},
      // Charges of two capacitors in parallel, flux of an inductor; z: currents of the capacitors.
      {"parallel capacitors",
       {flat(3, 2, 5,
             [](V x, V v, V z, T) {
               return equations({v[0] - z[0], v[1] - z[1], z[0] + z[1] + x[2] / 3.0,
                                 x[0] / 2.0 - x[1], v[2] - x[0] / 2.0});
             }),
        at({1.0, 0.3, 0.2})},
       {{3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       1},
      // L = ½ (r'² + r² (θ' - a)²) - V(r).
      {"Christ-Lee",
       {lagrangian(3,
                   [](V q, V w, T) {
                     return 0.5 * (square(w[0]) + square(q[0]) * square(w[1] - q[2])) -
                            0.5 * square(q[0]);
                   }),
        at({1.2, 0.4, 0.3, 0.2, 0.5, 0.1})},
       {{6, 5}, {5, 4}, {5, 4}},
       Verdict::gauge,
       1},
  };
}

std::vector<KnownLadder> catalogue() {
  std::vector<KnownLadder> table = errata();
  ordinary(table);
  singular_lagrangians(table);
  mechanics(table);
  ports_and_circuits(table);
  optimal_control(table);
  on_manifolds(table);
  without_answers(table);
  return table;
}

}  // namespace courant::examples
