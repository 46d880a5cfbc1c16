#include "courant/structures/network.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/kirchhoff.hpp"

namespace courant {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

bool has_state(const NetworkBranch& branch) {
  return branch.kind == Kind::charge || branch.kind == Kind::flux;
}

bool is_port(const NetworkBranch& branch) {
  return branch.role == Role::port && !has_state(branch);
}

// Branches.
std::vector<Index> ports_of(const std::vector<NetworkBranch>& branches) {
  std::vector<Index> ports;
  for (std::size_t k = 0; k < branches.size(); ++k)
    if (is_port(branches[k])) ports.push_back(static_cast<Index>(k));
  return ports;
}

// What a normal tree takes first.
double weight(const NetworkBranch& branch) {
  switch (branch.kind) {
    case Kind::charge:
      return 1.0;
    case Kind::flux:
      return 4.0;
    case Kind::current:
      return branch.role == Role::source ? 0.0 : 2.0;
    case Kind::voltage:
      return branch.role == Role::source ? 5.0 : 3.0;
  }
  return 0.0;
}

std::vector<NetworkBranch> named(std::vector<NetworkBranch> branches) {
  for (NetworkBranch& branch : branches) {
    if (branch.current_name.empty()) branch.current_name = "i_" + branch.name;
    if (branch.voltage_name.empty()) branch.voltage_name = "v_" + branch.name;
    if (branch.state_name.empty() && branch.kind == Kind::charge)
      branch.state_name = "q_" + branch.name;
    if (branch.state_name.empty() && branch.kind == Kind::flux)
      branch.state_name = "phi_" + branch.name;
  }
  return branches;
}

std::unique_ptr<const Kirchhoff> kirchhoff(Index node_count,
                                           const std::vector<NetworkBranch>& branches) {
  CircuitGraph graph(as_size(node_count));
  for (const NetworkBranch& branch : branches) {
    if (std::min(branch.from, branch.to) < 0 || std::max(branch.from, branch.to) >= node_count)
      throw std::invalid_argument("Network::Network: the branch \"" + branch.name +
                                  "\" is between nodes " + std::to_string(branch.from) + " and " +
                                  std::to_string(branch.to) + ", expected nodes below " +
                                  std::to_string(node_count) + ".");
    if (!has_state(branch) && !is_port(branch) && !branch.law)
      throw std::invalid_argument("Network::Network: the branch \"" + branch.name +
                                  "\" has no law, expected one for what is no charge or flux.");
    add_edge(as_size(branch.from), as_size(branch.to), CircuitElement{branch.name, weight(branch)},
             graph);
  }
  return std::make_unique<const Kirchhoff>(graph);
}

// `a = b - c + …`, cut off where there are many.
std::string sum(const std::string& left, const std::vector<std::pair<double, std::string>>& terms) {
  constexpr std::size_t most = 8;
  std::string text = left + " =";
  if (terms.empty()) text += " 0";
  for (std::size_t k = 0; k < terms.size() && k < most; ++k) {
    const auto& [sign, name] = terms[k];
    text += k == 0 ? (sign < 0.0 ? " -" : " ") : (sign < 0.0 ? " - " : " + ");
    text += name;
  }
  return terms.size() > most ? text + " + …" : text;
}

ImplicitSystem::Names names_of(const std::vector<NetworkBranch>& branches,
                               const Kirchhoff& kirchhoff) {
  ImplicitSystem::Names names;
  for (const NetworkBranch& branch : branches) {
    if (has_state(branch))
      names.coordinates.push_back(branch.state_name);
    else
      names.auxiliary.push_back(branch.kind == Kind::current ? branch.current_name
                                                             : branch.voltage_name);
  }
  const SparseMatrixXd M = kirchhoff.hybrid_representation().M.transpose();  // columns: equations
  const auto& tree = kirchhoff.tree();
  const auto& links = kirchhoff.links();
  const auto inner = static_cast<Index>(tree.size());
  for (Index row = 0; row < M.cols(); ++row) {
    std::vector<std::pair<double, std::string>> terms;
    for (SparseMatrixXd::InnerIterator it(M, row); it; ++it)
      terms.emplace_back(it.value(),
                         it.row() < inner
                             ? branches[as_size(tree[as_size(it.row())])].voltage_name
                             : branches[as_size(links[as_size(it.row() - inner)])].current_name);
    names.equations.push_back(sum(row < inner
                                      ? branches[as_size(tree[as_size(row)])].current_name
                                      : branches[as_size(links[as_size(row - inner)])].voltage_name,
                                  terms));
  }
  for (const Index port : ports_of(branches)) {
    names.auxiliary.push_back("u_" + branches[as_size(port)].name);
    names.equations.push_back("0 = y_" + branches[as_size(port)].name);
  }
  return names;
}

Index states(const std::vector<NetworkBranch>& branches) {
  return std::count_if(branches.begin(), branches.end(), has_state);
}

// Where the inputs of ports are among the unknowns: after those of the branches.
std::vector<Index> inputs_of(const std::vector<NetworkBranch>& branches) {
  std::vector<Index> inputs(ports_of(branches).size());
  std::iota(inputs.begin(), inputs.end(), std::ssize(branches) - states(branches));
  return inputs;
}

// Evaluates laws when their results are first asked for.
class Evaluation final : public NetworkVariables {
 public:
  Evaluation(const std::vector<NetworkBranch>& branches, const ExprVector& x, const Expr& t)
      : branches_(branches), x_(x), t_(t), known_(branches.size()) {}

  void set_current(Index branch, const Expr& value) { known_[as_size(branch)].current = value; }
  void set_voltage(Index branch, const Expr& value) { known_[as_size(branch)].voltage = value; }

  Expr current(Index branch) const override { return of(branch, &Known::current); }
  Expr voltage(Index branch) const override { return of(branch, &Known::voltage); }
  const ExprVector& x() const override { return x_; }
  const Expr& t() const override { return t_; }

 private:
  struct Known {
    std::optional<Expr> current, voltage;
    bool asked = false;
  };

  Expr of(Index branch, std::optional<Expr> Known::*variable) const {
    Known& known = known_.at(as_size(branch));
    if (!(known.*variable)) {
      if (known.asked)
        throw std::invalid_argument("Network::Network: the law of the branch \"" +
                                    branches_[as_size(branch)].name +
                                    "\" needs its own result, expected none in a circle.");
      known.asked = true;
      known.*variable = branches_[as_size(branch)].law(*this);
    }
    return *(known.*variable);
  }

  const std::vector<NetworkBranch>& branches_;
  const ExprVector& x_;
  const Expr& t_;
  mutable std::vector<Known> known_;
};

// The own unknowns of branches.
void know_unknowns(const std::vector<NetworkBranch>& branches, const std::vector<Index>& place,
                   const ExprVector& z, Evaluation& evaluation) {
  for (std::size_t k = 0; k < branches.size() && z.size() > 0; ++k) {
    if (branches[k].kind == Kind::current)
      evaluation.set_current(static_cast<Index>(k), z[place[k]]);
    else if (branches[k].kind == Kind::voltage)
      evaluation.set_voltage(static_cast<Index>(k), z[place[k]]);
  }
}

}  // namespace

Network::Network(Index node_count, std::vector<NetworkBranch> branches, Energy energy)
    : Network(node_count, named(std::move(branches)), std::move(energy), nullptr) {}

Network::Network(Index node_count, std::vector<NetworkBranch> branches, Energy energy,
                 std::unique_ptr<const Kirchhoff> structure)
    : PortSystem(std::make_shared<Euclidean>(states(branches)),
                 std::ssize(branches) - states(branches) + std::ssize(ports_of(branches)),
                 std::ssize(branches) + std::ssize(ports_of(branches)),
                 names_of(branches, *(structure = kirchhoff(node_count, branches))),
                 inputs_of(branches)),
      node_count_(node_count),
      branches_(std::move(branches)),
      energy_(std::move(energy)),
      kirchhoff_(std::move(structure)),
      M_(kirchhoff_->hybrid_representation().M),
      paths_(kirchhoff_->potentials().transpose()) {
  ports_ = ports_of(branches_);
  Index state = 0, unknown = 0;
  for (const NetworkBranch& branch : branches_)
    place_.push_back(has_state(branch) ? state++ : unknown++);
  Graph graph;
  const ExprVector x = graph.variables("x", state);
  const Expr t = graph.variable("t");
  const ExprVector z = graph.variables("z", auxiliary_size());
  ports(x, graph.variables("v", state), effort(x, z, t), z, t);
}

Network::~Network() = default;

Expr Network::do_generator(const ExprVector& x, const ExprVector&, const Expr& t) const {
  return energy_(x, t);
}

std::optional<Expr> Network::do_energy(const ExprVector& x, const ExprVector& z,
                                       const Expr& t) const {
  Expr sum = energy_(x, t);
  const bool has_implicit = std::ranges::any_of(
      branches_, [](const NetworkBranch& branch) { return static_cast<bool>(branch.energy); });
  if (!has_implicit) return sum;
  Evaluation evaluation(branches_, x, t);
  know_unknowns(branches_, place_, z, evaluation);
  for (const NetworkBranch& branch : branches_)
    if (branch.energy) sum += branch.energy(evaluation);
  return sum;
}

ExprVector Network::do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const {
  const Graph graph = fresh_graph({x, z, ExprVector::Constant(1, t)});
  ExprVector from(x.size() + 1), to(x.size() + 1);
  from << graph.variables("x", x.size()), graph.variable("t");
  to << x, t;
  const ExprVector at_fresh = from.head(x.size());
  ExprVector effort = substitute(gradient(energy_(at_fresh, from[x.size()]), at_fresh), from, to);
  Evaluation evaluation(branches_, x, t);
  know_unknowns(branches_, place_, z, evaluation);
  for (std::size_t k = 0; k < branches_.size(); ++k)
    if (has_state(branches_[k]) && branches_[k].law)
      effort[place_[k]] = branches_[k].law(evaluation);
  return effort;
}

Network::Ports Network::ports(const ExprVector& x, const ExprVector& velocity,
                              const ExprVector& alpha, const ExprVector& z, const Expr& t) const {
  Evaluation evaluation(branches_, x, t);
  const auto count = static_cast<Index>(branches_.size());
  for (Index k = 0; k < count; ++k) {
    const NetworkBranch& branch = branches_[as_size(k)];
    const Index place = place_[as_size(k)];
    switch (branch.kind) {
      case Kind::charge:
        evaluation.set_current(k, velocity[place]);
        evaluation.set_voltage(k, alpha[place]);
        break;
      case Kind::flux:
        evaluation.set_voltage(k, velocity[place]);
        evaluation.set_current(k, alpha[place]);
        break;
      case Kind::current:
        evaluation.set_current(k, z[place]);
        break;
      case Kind::voltage:
        evaluation.set_voltage(k, z[place]);
        break;
    }
  }
  for (std::size_t a = 0; a < ports_.size(); ++a) {
    const Expr& u = z[inputs()[a]];
    if (branches_[as_size(ports_[a])].kind == Kind::current)
      evaluation.set_voltage(ports_[a], u);
    else
      evaluation.set_current(ports_[a], -u);
  }
  Ports ports{ExprVector(count), ExprVector(count)};
  for (Index k = 0; k < count; ++k) {
    ports.current[k] = evaluation.current(k);
    ports.voltage[k] = evaluation.voltage(k);
  }
  return ports;
}

ExprVector Network::potentials(const ExprVector& voltage) const {
  ExprVector result = ExprVector::Zero(node_count_);
  for (Index node = 0; node < node_count_; ++node)
    for (SparseMatrixXd::InnerIterator it(paths_, node); it; ++it)
      result[node] += it.value() * voltage[it.row()];
  return result;
}

Expr Network::power(const Ports& ports, Role role) const {
  Expr result = 0.0;
  for (std::size_t k = 0; k < branches_.size(); ++k)
    if (branches_[k].role == role)
      result += ports.current[static_cast<Index>(k)] * ports.voltage[static_cast<Index>(k)];
  return result;
}

Expr Network::dissipated_power(const Ports& ports) const { return power(ports, Role::resistor); }
Expr Network::supplied_power(const Ports& ports) const {
  return -power(ports, Role::source) - power(ports, Role::port);
}

Index Network::charge_loop_count() const {
  return std::count_if(kirchhoff_->links().begin(), kirchhoff_->links().end(), [&](Index branch) {
    return branches_[as_size(branch)].kind == Kind::charge;
  });
}

Index Network::flux_cut_set_count() const {
  return std::count_if(kirchhoff_->tree().begin(), kirchhoff_->tree().end(),
                       [&](Index branch) { return branches_[as_size(branch)].kind == Kind::flux; });
}

EnergySystem::Powers Network::do_inner_powers(const ExprVector& x, const ExprVector& v,
                                              const ExprVector& alpha, const ExprVector& z,
                                              const Expr& t) const {
  const Ports all = ports(x, v, alpha, z, t);
  Powers powers;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const auto index = static_cast<Index>(k);
    const Expr power = all.current[index] * all.voltage[index];
    if (branches_[k].role == Role::source)
      powers.supplied.push_back({branches_[k].name, -power});
    else if (branches_[k].role == Role::resistor)
      powers.dissipated.push_back({branches_[k].name, power});
  }
  return powers;
}

bool Network::do_is_free(Index) const { return true; }

ExprVector Network::do_output(const ExprVector&, const ExprVector&, const ExprVector& z) const {
  ExprVector y(port_count());
  for (Index a = 0; a < y.size(); ++a) {
    const Index port = ports_[as_size(a)];
    const Expr& own = z[place_[as_size(port)]];
    y[a] = branches_[as_size(port)].kind == Kind::current ? -own : own;
  }
  return y;
}

ExprVector Network::do_port_equations(const Expr&, const ExprVector&, const ExprVector& y) const {
  return y;
}

ExprVector Network::do_inner_equations(const ExprVector& x, const ExprVector& v,
                                       const ExprVector& alpha, const ExprVector& z,
                                       const Expr& t) const {
  const auto& tree = kirchhoff_->tree();
  const auto& links = kirchhoff_->links();
  const Ports all = ports(x, v, alpha, z, t);
  const auto inner = static_cast<Index>(tree.size());
  ExprVector residual(std::ssize(branches_)), input(std::ssize(branches_));
  for (Index k = 0; k < inner; ++k) {
    residual[k] = all.current[tree[as_size(k)]];
    input[k] = all.voltage[tree[as_size(k)]];
  }
  for (Index k = inner; k < residual.size(); ++k) {
    residual[k] = all.voltage[links[as_size(k - inner)]];
    input[k] = all.current[links[as_size(k - inner)]];
  }
  for (Index column = 0; column < M_.outerSize(); ++column)
    for (SparseMatrixXd::InnerIterator it(M_, column); it; ++it)
      residual[it.row()] -= it.value() * input[column];
  return residual;
}

VectorXd Network::do_auxiliary_guess(const VectorXd&, const VectorXd&) const {
  VectorXd guess = VectorXd::Zero(auxiliary_size());
  for (std::size_t k = 0; k < branches_.size(); ++k)
    if (!has_state(branches_[k])) guess[place_[k]] = branches_[k].guess;
  return guess;
}

}  // namespace courant
