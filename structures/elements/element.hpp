// Element: a part of a network with terminals, one or several branches between them, and their laws.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "courant/structures/elements/domain.hpp"
#include "courant/structures/network.hpp"

namespace courant::elements {

// What the laws of an element see of the network that it is in: the variables of its own branches and states, by their
// numbers in the element.
class Variables {
 public:
  // Both arguments have to outlive this. `states`: the coordinates of the states.
  Variables(const NetworkVariables& network, Index first_branch, const std::vector<Index>& states)
      : network_(network), first_(first_branch), states_(states) {}

  // By the numbers of branches and states in the element.
  Expr current(Index branch) const { return network_.current(first_ + branch); }
  Expr voltage(Index branch) const { return network_.voltage(first_ + branch); }
  const Expr& state(Index state) const {
    return network_.x()[states_[static_cast<std::size_t>(state)]];
  }
  const Expr& t() const { return network_.t(); }
  const NetworkVariables& network() const { return network_; }

 private:
  const NetworkVariables& network_;
  Index first_;
  const std::vector<Index>& states_;
};

// A law, or a quantity that a law is made of.
using Law = std::function<Expr(const Variables&)>;
// The same of the states of the element (own) and of all states of the network (x).
using StateLaw = std::function<Expr(const ExprVector& own, const ExprVector& x, const Expr& t)>;

// A number as a law.
inline Law constant(double value) {
  return [value](const Variables&) { return Expr(value); };
}

// What a part of a network is, wherever it is. Branches are those of NetworkBranch, from one terminal to another, in
// the variables of a domain each; those that are charges or fluxes are the states of the element, in this order.
// Elements of all domains are made by the functions beside this file (electrical.hpp …); NetworkAssembly makes a
// network of them. A value.
struct Element {
  static constexpr Index ground = -1;

  struct Branch {
    const Domain* domain = &domains::electrical;
    Index from = 0, to = 1;  // terminals, or the ground
    NetworkBranch::Kind kind = NetworkBranch::Kind::current;
    NetworkBranch::Role role = NetworkBranch::Role::resistor;
    // As in NetworkBranch: of a current or a voltage, and of a state where ∂H/∂x is known better than H.
    Law law = {};
    Law energy = {};           // of a charge whose law is implicit
    std::string suffix = {};   // what its name has after that of the element
    std::string letters = {};  // before the name of the element in that of its state
  };

  std::vector<Branch> branches = {};
  // What its states store, all together; nothing if that is zero, or the energy of a branch.
  StateLaw energy = {};
  Index terminals = 0;  // at least, besides those that branches lead to
  // In H, where it is a linear inductor: NetworkAssembly::couple may couple it to others.
  std::optional<double> inductance = {};

  // How many terminals it has besides the ground.
  Index terminal_count() const;
  Index state_count() const;
};

// The branches of an element in a network, with the laws of the element bound to their numbers there.
//
//   name          of the element
//   nodes         of its terminals
//   first_branch  the number of its first branch
//   states        the coordinates of its states
std::vector<NetworkBranch> placed(const Element& element, const std::string& name,
                                  const std::vector<Index>& nodes, Index first_branch,
                                  const std::vector<Index>& states);

// What elements of all domains are made of.

// A charge or a flux with an energy of its own; x²/(2 value) by quadratic().
Element storage(const Domain& domain, NetworkBranch::Kind kind, const std::string& letters,
                StateLaw energy);
StateLaw quadratic(double value);
// A branch whose law gives what its kind asks for.
Element source(const Domain& domain, NetworkBranch::Kind kind, Law law);
Element resistive(const Domain& domain, NetworkBranch::Kind kind, Law law);
// A port of the network, to which another system may be joined.
Element port(const Domain& domain, NetworkBranch::Kind kind);
// across = factor through
Law times_current(Law factor);
// Two branches without loss: across₁ = ratio across₂, through₂ = -ratio through₁; `first` and `second` have domain,
// terminals and suffix.
Element transformer(double ratio, Element::Branch first, Element::Branch second);

}  // namespace courant::elements
