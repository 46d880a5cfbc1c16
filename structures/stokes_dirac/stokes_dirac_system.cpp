#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"

#include <numeric>
#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

Index states_of(const std::shared_ptr<const StokesDirac>& structure,
                const std::shared_ptr<const GeneratingFamily>& energy,
                const StokesDiracSystem::Setting& setting) {
  if (!structure || !energy)
    throw std::invalid_argument(
        "StokesDiracSystem: the structure or the energy is missing; expected both.");
  const Index n = setting.conduction ? structure->p_count() : structure->state_count();
  if (energy->parameter_size() != 0 || energy->manifold()->ambient_dimension() != n)
    throw std::invalid_argument(
        "StokesDiracSystem: the energy is on " + energy->manifold()->name() + " with " +
        std::to_string(energy->parameter_size()) + " parameters; expected a function of " +
        std::to_string(n) + " states.");
  return n;
}

ImplicitSystem::Names names_of_fields(std::vector<std::string> coordinates,
                                      const StokesDiracSystem::Setting& setting) {
  ImplicitSystem::Names names{std::move(coordinates), {}, {}};
  for (const StokesDiracSystem::Port& port : setting.ports)
    names.auxiliary.push_back("u_" + port.name);
  return names;
}

std::vector<Index> numbers_of(const std::vector<StokesDiracSystem::Port>& ports) {
  std::vector<Index> numbers(ports.size());
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

}  // namespace

StokesDiracSystem::StokesDiracSystem(std::shared_ptr<const StokesDirac> structure,
                                     std::shared_ptr<const GeneratingFamily> energy,
                                     Setting setting, std::vector<std::string> coordinates)
    : PortSystem{energy ? energy->manifold() : nullptr, std::ssize(setting.ports),
                 states_of(structure, energy, setting) + std::ssize(setting.ports),
                 names_of_fields(std::move(coordinates), setting), numbers_of(setting.ports)},
      structure_(std::move(structure)),
      energy_(std::move(energy)),
      setting_(std::move(setting)),
      d_p_(structure_->J().bottomLeftCorner(structure_->q_count(), structure_->p_count())),
      B_transpose_(structure_->B().transpose()) {
  const Index flows = std::ssize(structure_->flow_cells());
  const auto check = [&](const std::string& name, const std::vector<Index>& columns, Index size,
                         bool may_be_effort) {
    if (size != std::ssize(columns))
      throw std::invalid_argument("StokesDiracSystem: \"" + name + "\" has " +
                                  std::to_string(size) + " numbers for " +
                                  std::to_string(columns.size()) + " columns; expected as many.");
    for (const Index column : columns)
      if (column < 0 || column >= structure_->boundary_count() ||
          (setting_.conduction && !may_be_effort && column >= flows))
        throw std::invalid_argument("StokesDiracSystem: \"" + name + "\" has the column " +
                                    std::to_string(column) + "; expected one of the " +
                                    std::to_string(structure_->boundary_count()) +
                                    ", and with a conduction one whose input is a flow.");
  };
  for (const Supply& supply : setting_.supplies)
    check(supply.name, supply.columns, std::ssize(supply.columns), true);
  for (const Absorption& absorption : setting_.absorptions)
    check(absorption.name, absorption.columns, absorption.coefficients.size(), false);
  for (const Port& port : setting_.ports)
    check(port.name, port.columns, port.profile.size(), false);
  if (setting_.conduction && setting_.conduction->is_of_heat && structure_->degree() != 0)
    throw std::invalid_argument("StokesDiracSystem: the degree is " +
                                std::to_string(structure_->degree()) +
                                "; expected 0 for the conduction of heat.");
}

ExprVector StokesDiracSystem::supplied(const Supply& supply, const ExprVector& alpha,
                                       const Expr& t) const {
  ExprVector u = supply.input(t);
  if (!setting_.conduction || !setting_.conduction->is_of_heat) return u;
  const Index flows = std::ssize(structure_->flow_cells());
  for (std::size_t i = 0; i < supply.columns.size(); ++i)
    if (supply.columns[i] < flows)  // a single entry, 1
      for (SparseMatrixXd::InnerIterator it(structure_->B(), supply.columns[i]); it; ++it)
        u[static_cast<Index>(i)] = u[static_cast<Index>(i)] / alpha[it.row()];
  return u;
}

ExprVector StokesDiracSystem::given_inputs(const ExprVector& alpha, const ExprVector& z,
                                           const Expr& t) const {
  ExprVector u = ExprVector::Zero(structure_->boundary_count());
  for (const Supply& supply : setting_.supplies) {
    const ExprVector values = supplied(supply, alpha, t);
    for (std::size_t i = 0; i < supply.columns.size(); ++i)
      u[supply.columns[i]] += values[static_cast<Index>(i)];
  }
  for (std::size_t a = 0; a < setting_.ports.size(); ++a) {
    const Port& port = setting_.ports[a];
    for (std::size_t i = 0; i < port.columns.size(); ++i)
      u[port.columns[i]] += port.profile[static_cast<Index>(i)] * z[static_cast<Index>(a)];
  }
  return u;
}

StokesDiracSystem::Balance StokesDiracSystem::balance(const ExprVector& x, const ExprVector& alpha,
                                                      const ExprVector& z, const Expr& t) const {
  const Index p = structure_->p_count(), q = structure_->q_count();
  const Index flows = std::ssize(structure_->flow_cells());
  Balance all;
  all.inputs = given_inputs(alpha, z, t);
  const auto absorb = [&] {
    for (const Absorption& absorption : setting_.absorptions)
      for (std::size_t i = 0; i < absorption.columns.size(); ++i)
        all.inputs[absorption.columns[i]] -=
            absorption.coefficients[static_cast<Index>(i)] * all.outputs[absorption.columns[i]];
  };
  if (!setting_.conduction) {
    all.outputs = sparse_product(B_transpose_, alpha);
    absorb();
    all.flux = alpha.tail(q);
    all.rates =
        sparse_product(structure_->J(), alpha) + sparse_product(structure_->B(), all.inputs);
  } else {
    // Efforts of inputs act on the drop; those of flows do not, and absorb alone.
    ExprVector efforts = all.inputs;
    efforts.head(flows).setZero();
    all.drop =
        sparse_product(d_p_, alpha) + ExprVector(sparse_product(structure_->B(), efforts).tail(q));
    all.flux = setting_.conduction->coefficients(x).cwiseProduct(all.drop);
    const SparseMatrixXd back = -SparseMatrixXd(d_p_.transpose());
    all.rates = sparse_product(back, all.flux);
    all.outputs = sparse_product(B_transpose_, joined(alpha, all.flux));
    if (setting_.conduction->is_of_heat) {
      all.rates = all.rates.cwiseQuotient(alpha);
      for (Index b = flows; b < all.outputs.size(); ++b)
        if (!all.inputs[b].is_constant(0.0)) all.outputs[b] = all.outputs[b] / all.inputs[b];
    }
    absorb();
    ExprVector entering = all.inputs;
    entering.tail(entering.size() - flows).setZero();
    all.rates += ExprVector(sparse_product(structure_->B(), entering).head(p));
  }
  if (setting_.resistance) all.rates -= setting_.resistance(x).cwiseProduct(alpha);
  return all;
}

std::vector<CellForm> StokesDiracSystem::forms() const {
  std::vector<CellForm> all{structure_->p_form()};
  if (!setting_.conduction) all.push_back(structure_->q_form());
  return all;
}

ExprVector StokesDiracSystem::flux(const ExprVector& x, const ExprVector& alpha,
                                   const ExprVector& u, const Expr& t) const {
  return balance(x, alpha, u, t).flux;
}

Expr StokesDiracSystem::do_generator(const ExprVector& x, const ExprVector&, const Expr& t) const {
  return energy_->value(x, ExprVector(0), t);
}

ExprVector StokesDiracSystem::do_effort(const ExprVector& x, const ExprVector&,
                                        const Expr& t) const {
  return energy_->differential(x, ExprVector(0), t);
}

// The outputs of free ports do not depend on inputs that are given: with a conduction their columns are flows.
ExprVector StokesDiracSystem::do_output(const ExprVector&, const ExprVector& alpha,
                                        const ExprVector&) const {
  ExprVector y = ExprVector::Zero(port_count());
  for (std::size_t a = 0; a < setting_.ports.size(); ++a) {
    const Port& port = setting_.ports[a];
    for (std::size_t i = 0; i < port.columns.size(); ++i)
      for (SparseMatrixXd::InnerIterator it(structure_->B(), port.columns[i]); it; ++it)
        y[static_cast<Index>(a)] +=
            port.profile[static_cast<Index>(i)] * it.value() * alpha[it.row()];
  }
  return y;
}

ExprVector StokesDiracSystem::do_inner_equations(const ExprVector& x, const ExprVector& v,
                                                 const ExprVector& alpha, const ExprVector& z,
                                                 const Expr& t) const {
  return v - balance(x, alpha, z, t).rates;
}

ExprVector StokesDiracSystem::do_port_equations(const Expr&, const ExprVector&,
                                                const ExprVector& y) const {
  return y;
}

EnergySystem::Powers StokesDiracSystem::do_inner_powers(const ExprVector& x, const ExprVector&,
                                                        const ExprVector& alpha,
                                                        const ExprVector& z, const Expr& t) const {
  const Balance all = balance(x, alpha, z, t);
  Powers powers;
  for (const Supply& supply : setting_.supplies) {
    const ExprVector values = supplied(supply, alpha, t);
    Expr power = 0.0;
    for (std::size_t i = 0; i < supply.columns.size(); ++i)
      power += all.outputs[supply.columns[i]] * values[static_cast<Index>(i)];
    powers.supplied.push_back({supply.name, power});
  }
  for (const Absorption& absorption : setting_.absorptions) {
    Expr power = 0.0;
    for (std::size_t i = 0; i < absorption.columns.size(); ++i)
      power += absorption.coefficients[static_cast<Index>(i)] *
               square(all.outputs[absorption.columns[i]]);
    powers.dissipated.push_back({absorption.name, power});
  }
  if (setting_.resistance)
    powers.dissipated.push_back(
        {"resistance", setting_.resistance(x).cwiseProduct(alpha.cwiseProduct(alpha)).sum()});
  if (setting_.conduction && !setting_.conduction->is_of_heat)
    powers.dissipated.push_back({"conduction", all.flux.cwiseProduct(all.drop).sum()});
  return powers;
}

}  // namespace courant
