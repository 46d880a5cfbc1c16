// Network: branches between nodes, Kirchhoff's laws and the energy that is stored.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/structures/port_system.hpp"

namespace courant {

using SparseMatrixXd = Eigen::SparseMatrix<double>;

class Kirchhoff;
class NetworkVariables;

// A branch of a network, from one node to another. Its current counts positive from `from` to `to`,
// its voltage is the potential of `from` less that of `to`: current times voltage flows in.
// "Current" and "voltage" stand for every pair of a through and an across variable: force and
// velocity, torque and angular velocity, flow and pressure, entropy flow and temperature.
struct NetworkBranch {
  // Which variable is given by what:
  //
  //   charge    a state x of its own:    current = x', voltage = ∂H/∂x
  //   flux      a state x of its own:    voltage = x', current = ∂H/∂x
  //   current   an unknown of its own, the current; the law gives the voltage
  //   voltage   an unknown of its own, the voltage; the law gives the current
  enum class Kind { charge, flux, current, voltage };
  // What the power that flows in does: it is stored, lost, or comes from outside; the powers of all
  // couplers together are zero. A port has no law. Its input u is an unknown beside that of its kind, its
  // output y is what power comes in with, y u = -current voltage:
  //
  //   current   u = voltage,   y = -current    what is joined holds the voltage
  //   voltage   u = -current,  y = voltage     what is joined sends a current in at `from`
  //
  // So a port of which nothing is said, 0 = y, is open in the first case and shorted in the second.
  enum class Role { storage, resistor, source, coupler, port };
  using Law = std::function<Expr(const NetworkVariables&)>;

  std::string name;
  Index from = 0, to = 0;  // nodes
  Kind kind = Kind::current;
  Role role = Role::resistor;
  // Of `current` and `voltage`, in currents and voltages of other branches, states and t. Of a
  // charge or a flux it may stand for ∂H/∂x, where that is known better than H.
  Law law = {};
  // Of a charge or a flux whose law has unknowns of other branches: what it stores, in terms of these.
  Law energy = {};
  // The names of its through and its across variable.
  std::string current_name = {}, voltage_name = {};
  std::string state_name = {};  // of a charge or a flux
  double guess = 0.0;           // where its unknown is looked for first
};

// A network as an implicit system on Rⁿ, a coordinate for each branch with a state, an auxiliary
// unknown for each other one. With the spanning forest of Kirchhoff, its elements 1 and the others
// 2, the equations are the hybrid representation of the Kirchhoff–Dirac structure:
//
//   (i₁, v₂) = M (v₁, i₂),   M skew
//
// as many as there are branches, and one for each port. The inputs of ports come last among the unknowns.
// The forest is a normal tree: it takes sources of voltage first,
// then charges, then all that is neither, then fluxes, and sources of current last. So a charge
// outside the tree closes a loop of charges and sources of voltage, a flux in the tree is cut by
// fluxes and sources of current alone; the equation of each contains only x and t. If all
// couplers, resistors and energies are strictly passive, M_f has n less these dimensions, and the
// ladder ends at 0 where there are none, at 1 otherwise.
//
// Along solutions dH/dt = supplied power - dissipated power: each source supplies and each resistor
// dissipates under the name of its branch.
class Network final : public PortSystem {
 public:
  using Energy = std::function<Expr(const ExprVector& x, const Expr& t)>;

  // Node 0 is the ground; the others are 1 … node_count - 1. Throws std::invalid_argument if a
  // node is out of range, a law is missing or the laws of branches need each other in a circle.
  Network(Index node_count, std::vector<NetworkBranch> branches, Energy energy);
  ~Network() override;

  const std::vector<NetworkBranch>& branches() const { return branches_; }
  Index node_count() const { return node_count_; }

  // The independent loops of charges and sources of voltage with a charge in them, and cut-sets of
  // fluxes and sources of current with a flux in them.
  Index charge_loop_count() const;
  Index flux_cut_set_count() const;

  // All currents and voltages (one a branch), at x, x', z, t and the efforts α of the states, ∂H/∂x
  // but for a discrete gradient; all of them may be any expressions.
  struct Ports {
    ExprVector current, voltage;
  };
  Ports ports(const ExprVector& x, const ExprVector& velocity, const ExprVector& alpha,
              const ExprVector& z, const Expr& t) const;
  // The potentials of the nodes (node_count), each less that of the ground or, where no branch
  // leads there, of the first node of its part.
  ExprVector potentials(const ExprVector& voltage) const;
  // Powers that resistors take in and that sources and ports give.
  Expr dissipated_power(const Ports& ports) const;
  Expr supplied_power(const Ports& ports) const;

 private:
  Network(Index node_count, std::vector<NetworkBranch> branches, Energy energy,
          std::unique_ptr<const Kirchhoff> structure);
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override;
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  bool do_is_free(Index port) const override;
  ExprVector do_output(const ExprVector& x, const ExprVector& alpha,
                       const ExprVector& z) const override;
  ExprVector do_inner_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                const ExprVector& z, const Expr& t) const override;
  ExprVector do_port_equations(const Expr& t, const ExprVector& u,
                               const ExprVector& y) const override;
  Powers do_inner_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                         const ExprVector& z, const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;
  Expr power(const Ports& ports, NetworkBranch::Role role) const;

  Index node_count_;
  std::vector<NetworkBranch> branches_;
  Energy energy_;
  std::vector<Index> place_;  // of each branch: the index of its state or unknown
  std::vector<Index> ports_;  // branches
  std::unique_ptr<const Kirchhoff> kirchhoff_;
  SparseMatrixXd M_, paths_;  // E × E; E × N, the transpose of Kirchhoff::potentials
};

// What the law of a branch may depend on. The variables that laws give are evaluated when they are
// asked for.
class NetworkVariables {
 public:
  virtual ~NetworkVariables() = default;
  // Of a branch by its number in Network::branches(): what flows through it, and what lies across it.
  virtual Expr current(Index branch) const = 0;
  virtual Expr voltage(Index branch) const = 0;
  // The charges and fluxes of the network, and the time.
  virtual const ExprVector& x() const = 0;
  virtual const Expr& t() const = 0;
};

}  // namespace courant
