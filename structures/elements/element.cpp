#include "courant/structures/elements/element.hpp"

#include <algorithm>
#include <utility>

namespace courant::elements {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

// Where the temperatures of branches are looked for: at 0 K the laws have no value.
constexpr double kRoomTemperature = 300.0;

bool is_state(const Element::Branch& branch) {
  return branch.kind == Kind::charge || branch.kind == Kind::flux;
}

NetworkBranch::Law bound(const Law& law, Index first_branch, const std::vector<Index>& states) {
  if (!law) return {};
  return [law, first_branch, states](const NetworkVariables& variables) {
    return law(Variables(variables, first_branch, states));
  };
}

}  // namespace

Index Element::terminal_count() const {
  Index count = terminals;
  for (const Branch& branch : branches) count = std::max({count, branch.from + 1, branch.to + 1});
  return count;
}

Index Element::state_count() const {
  return std::count_if(branches.begin(), branches.end(), is_state);
}

std::vector<NetworkBranch> placed(const Element& element, const std::string& name,
                                  const std::vector<Index>& nodes, Index first_branch,
                                  const std::vector<Index>& states) {
  const auto node = [&](Index terminal) {
    return terminal == Element::ground ? 0 : nodes[static_cast<std::size_t>(terminal)];
  };
  std::vector<NetworkBranch> branches;
  for (const Element::Branch& own : element.branches) {
    const std::string full = name + own.suffix;
    const bool is_temperature = own.domain == &domains::thermal && own.kind == Kind::voltage;
    branches.push_back({.name = full,
                        .from = node(own.from),
                        .to = node(own.to),
                        .kind = own.kind,
                        .role = own.role,
                        .law = bound(own.law, first_branch, states),
                        .energy = bound(own.energy, first_branch, states),
                        .current_name = own.domain->through + full,
                        .voltage_name = own.domain->across + full,
                        .state_name = is_state(own) ? own.letters + name : "",
                        .guess = is_temperature ? kRoomTemperature : 0.0});
  }
  return branches;
}

Element storage(const Domain& domain, Kind kind, const std::string& letters, StateLaw energy) {
  return {
      .branches = {{.domain = &domain, .kind = kind, .role = Role::storage, .letters = letters}},
      .energy = std::move(energy)};
}

StateLaw quadratic(double value) {
  return [value](const ExprVector& own, const ExprVector&, const Expr&) {
    return square(own[0]) / (2.0 * value);
  };
}

Element source(const Domain& domain, Kind kind, Law law) {
  return {
      .branches = {{.domain = &domain, .kind = kind, .role = Role::source, .law = std::move(law)}}};
}

Element resistive(const Domain& domain, Kind kind, Law law) {
  return {.branches = {
              {.domain = &domain, .kind = kind, .role = Role::resistor, .law = std::move(law)}}};
}

Element port(const Domain& domain, Kind kind) {
  return {.branches = {{.domain = &domain, .kind = kind, .role = Role::port}}};
}

Law times_current(Law factor) {
  return
      [factor = std::move(factor)](const Variables& own) { return factor(own) * own.current(0); };
}

Element transformer(double ratio, Element::Branch first, Element::Branch second) {
  first.kind = Kind::current;
  second.kind = Kind::voltage;
  first.role = second.role = Role::coupler;
  first.law = [ratio](const Variables& own) { return ratio * own.voltage(1); };
  second.law = [ratio](const Variables& own) { return -ratio * own.current(0); };
  return {.branches = {std::move(first), std::move(second)}};
}

}  // namespace courant::elements
