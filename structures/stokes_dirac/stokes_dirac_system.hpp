// StokesDiracSystem: conservation laws on a cell complex, with an energy, losses and a boundary.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/structures/generating_family.hpp"
#include "courant/structures/port_system.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

namespace courant {

// The states of a Stokes–Dirac structure, x = (p, q) ∈ R^N, with an energy H(x, t) and α = dH:
//
//   v = J α - r(x) α + B u_b,   y_b = Bᵀα,   u_b = Σ given inputs - c y_b + Σ_a profile_a u_a
//
// r, N numbers that are not negative, loses "resistance". What is said of the boundary is three kinds of things, each
// for some columns of B: inputs that are given in time supply power under their names, absorptions c ≥ 0 dissipate it,
// free ports a have one input u_a for all their columns and the output y_a = Σ profile y_b; closed as they are, 0 = y_a.
// Columns of which nothing is said have the input 0: no flow where it is a flow.
//
// With a conduction there is no q: x = p, and e_q = K(x) f is what a conductor lets through for f = -d_k e_p, with
// K ≥ 0 for each (k+1)-cell, so that "conduction" dissipates Σ K f². Where it is that of heat (k = 0), p is entropy and
// e_p the temperature, e_q the flow of energy, and
//
//   dp/dt = (d_kᵀ e_q)/e_p + u:   Σ e_p dp/dt = what is supplied,   Σ dp/dt - Σ u = Σ K f²/(e_p e_p') ≥ 0
//
// with both temperatures of an edge: the energy is conserved and entropy grows, whatever e_p > 0 is, so in each step of
// a discrete gradient too (irreversible port-Hamiltonian systems: Ramirez, Maschke & Sbarbaro 2013). A flow that is
// given in time is then one of energy, J, with the entropy u = J/e_p. The input of a free port is a flow of entropy, as
// in thermal networks.
class StokesDiracSystem final : public PortSystem {
 public:
  // Columns of B with an input that depends on time, of the size of `columns`.
  struct Supply {
    std::string name;
    std::vector<Index> columns;
    std::function<ExprVector(const Expr& t)> input;
  };
  struct Absorption {
    std::string name;
    std::vector<Index> columns;
    VectorXd coefficients;  // c
  };
  struct Port {
    std::string name;
    std::vector<Index> columns;
    VectorXd profile;
  };
  using Coefficients = std::function<ExprVector(const ExprVector& x)>;
  struct Conduction {
    Coefficients coefficients;  // K, q_count() numbers
    bool is_of_heat = false;
  };
  struct Setting {
    std::vector<Supply> supplies = {};
    std::vector<Absorption> absorptions = {};
    std::vector<Port> ports = {};
    Coefficients resistance = {};  // r, N numbers; may be empty: none
    std::optional<Conduction> conduction = {};
  };

  // The energy is on Rᴺ, without parameters. Names of coordinates may be empty. Throws std::invalid_argument for sizes
  // that do not fit, and with a conduction for absorptions and free ports whose input is an effort.
  StokesDiracSystem(std::shared_ptr<const StokesDirac> structure,
                    std::shared_ptr<const GeneratingFamily> energy, Setting setting,
                    std::vector<std::string> coordinates = {});

  const std::shared_ptr<const StokesDirac>& stokes_dirac() const { return structure_; }
  Index tangent_blocks() const override { return 1; }

  // The coordinates: p and, without a conduction, q.
  std::vector<CellForm> forms() const;
  // e_q at the efforts α: those of q, or what is conducted. Size q_count().
  ExprVector flux(const ExprVector& x, const ExprVector& alpha, const ExprVector& u,
                  const Expr& t) const;

 private:
  // What goes on between the cells: u_b, v = inner + B u_b, y_b.
  struct Balance {
    ExprVector inputs, rates, outputs, drop, flux;
  };
  Balance balance(const ExprVector& x, const ExprVector& alpha, const ExprVector& z,
                  const Expr& t) const;
  // The inputs of the columns of a supply, and those of all columns without absorptions.
  ExprVector supplied(const Supply& supply, const ExprVector& alpha, const Expr& t) const;
  ExprVector given_inputs(const ExprVector& alpha, const ExprVector& z, const Expr& t) const;
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  bool do_is_free(Index) const override { return true; }
  ExprVector do_output(const ExprVector& x, const ExprVector& alpha,
                       const ExprVector& z) const override;
  ExprVector do_inner_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                const ExprVector& z, const Expr& t) const override;
  ExprVector do_port_equations(const Expr& t, const ExprVector& u,
                               const ExprVector& y) const override;
  Powers do_inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                         const ExprVector& z, const Expr& t) const override;

  std::shared_ptr<const StokesDirac> structure_;
  std::shared_ptr<const GeneratingFamily> energy_;
  Setting setting_;
  SparseMatrixXd d_p_;          // q rows of J by columns of p: -d_I
  SparseMatrixXd B_transpose_;  // N_b × N
};

}  // namespace courant
