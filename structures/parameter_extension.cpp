#include "courant/structures/parameter_extension.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/structures/energy_system.hpp"

namespace courant {
namespace {

ExprVector alone(const Expr& value) { return ExprVector::Constant(1, value); }

// What both kinds of extended systems are made of. The equations θ' = 0 come after the first tangent block
// of the others, so that it is one still.
struct WithParameters {
  WithParameters(const ImplicitSystem& of, const std::vector<Parameter>& added)
      : parameters(added),
        at(added),
        N(of.manifold()->ambient_dimension()),
        n(of.manifold()->tangent_dimension()),
        p(static_cast<Index>(added.size())),
        first(of.tangent_blocks() > 0 ? n : of.equation_count()),
        manifold(std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
            of.manifold(), std::make_shared<Euclidean>(p)})),
        names(of.names()) {
    std::vector<std::string> rates;
    for (const Parameter& parameter : added) {
      std::string name = parameter.name;
      while (std::ranges::find(names.coordinates, name) != names.coordinates.end()) name += '_';
      names.coordinates.push_back(name);
      rates.push_back("rate of " + parameter.name);
    }
    names.equations.insert(names.equations.begin() + first, rates.begin(), rates.end());
  }

  ExprVector point(const ExprVector& x) const { return x.head(N); }
  ExprVector values(const ExprVector& x) const { return x.tail(p); }
  ExprVector tangent(const ExprVector& v) const { return v.head(n); }
  ExprVector with_rates(const ExprVector& equations, const ExprVector& v) const {
    return joined({ExprVector(equations.head(first)), ExprVector(v.tail(p)),
                   ExprVector(equations.tail(equations.size() - first))});
  }

  std::vector<Parameter> parameters;
  AtParameters at;
  Index N, n, p, first;
  std::shared_ptr<const Manifold> manifold;
  ImplicitSystem::Names names;
};

// The energy with an entry for each parameter before it, which is what it is at these values.
std::optional<Expr> energy_at(const ImplicitSystem& system, const WithParameters& with,
                              const ExprVector& x, const ExprVector& z, const Expr& t) {
  bool is_known = true;
  const ExprVector E = with.at({with.point(x), z, alone(t)}, with.values(x), [&](const auto& y) {
    const auto energy = system.energy(y[0], y[1], y[2][0]);
    is_known = energy.has_value();
    return alone(energy.value_or(Expr(0.0)));
  });
  return is_known ? std::optional(E[0]) : std::nullopt;
}

VectorXd guess_at(const ImplicitSystem& system, const WithParameters& with, const VectorXd& x,
                  const VectorXd& v) {
  return system.auxiliary_guess(x.head(with.N), v.size() > 0 ? VectorXd(v.head(with.n)) : v);
}

class ExtendedImplicit final : public ImplicitSystem {
 public:
  ExtendedImplicit(std::shared_ptr<const ImplicitSystem> system, WithParameters with)
      : ImplicitSystem(with.manifold, system->auxiliary_size(), system->equation_count() + with.p,
                       with.names),
        system_(std::move(system)),
        with_(std::move(with)) {}
  Index tangent_blocks() const override { return system_->tangent_blocks() > 0 ? 1 : 0; }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    return with_.with_rates(
        with_.at({with_.point(x), with_.tangent(v), z, alone(t)}, with_.values(x),
                 [&](const auto& y) { return system_->residual(y[0], y[1], y[2], y[3][0]); }),
        v);
  }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    return energy_at(*system_, with_, x, z, t);
  }
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override {
    return guess_at(*system_, with_, x, v);
  }

  std::shared_ptr<const ImplicitSystem> system_;
  WithParameters with_;
};

// The covector is (d_xE, ∂_θE).
class ExtendedEnergy final : public EnergySystem {
 public:
  ExtendedEnergy(std::shared_ptr<const EnergySystem> system, WithParameters with)
      : EnergySystem(with.manifold, system->auxiliary_size(), system->equation_count() + with.p,
                     with.names),
        system_(std::move(system)),
        with_(std::move(with)) {}
  Index tangent_blocks() const override { return system_->tangent_blocks() > 0 ? 1 : 0; }

 private:
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const override {
    return with_.at({with_.point(x), z, alone(t)}, with_.values(x), [&](const auto& y) {
      return alone(system_->generator(y[0], y[1], y[2][0]));
    })[0];
  }
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const override {
    return with_.at({with_.point(x), z, alone(t)}, with_.values(x), [&](const auto& y) {
      std::vector<std::string> names;
      for (const Parameter& parameter : with_.parameters) names.push_back(parameter.name);
      ExprVector theta(with_.p);
      const Graph graph = graph_of(joined({y[0], y[1], y[2]}));
      for (Index j = 0; j < with_.p; ++j)
        theta[j] = parameter_of(graph, names[static_cast<std::size_t>(j)], 0.0);
      return joined(system_->effort(y[0], y[1], y[2][0]),
                    gradient(system_->generator(y[0], y[1], y[2][0]), theta));
    });
  }
  ExprVector do_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                          const ExprVector& z, const Expr& t, const ExprVector& end,
                          const Expr& s) const override {
    return with_.with_rates(with_.at({with_.point(x), with_.tangent(v), with_.tangent(alpha), z,
                                      alone(t), with_.point(end), alone(s)},
                                     with_.values(x),
                                     [&](const auto& y) {
                                       return system_->equations(y[0], y[1], y[2], y[3], y[4][0],
                                                                 y[5], y[6][0]);
                                     }),
                            v);
  }
  Powers do_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                   const ExprVector& z, const Expr& t) const override {
    return system_->powers(with_.point(x), with_.tangent(v), with_.tangent(alpha), z, t);
  }
  bool do_has_explicit_energy() const override { return system_->has_explicit_energy(); }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    return energy_at(*system_, with_, x, z, t);
  }
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override {
    return guess_at(*system_, with_, x, v);
  }

  std::shared_ptr<const EnergySystem> system_;
  WithParameters with_;
};

std::shared_ptr<const ImplicitSystem> extended_system(
    const std::shared_ptr<const ImplicitSystem>& system, const std::vector<Parameter>& parameters) {
  if (!system) throw std::invalid_argument("ParameterExtension: the system is null.");
  if (parameters.empty())
    throw std::invalid_argument("ParameterExtension: there are no parameters; expected some.");
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (parameters[i].name == parameters[j].name)
        throw std::invalid_argument("ParameterExtension: the parameter " + parameters[i].name +
                                    " is there twice; expected each once.");
  WithParameters with(*system, parameters);
  if (auto with_energy = std::dynamic_pointer_cast<const EnergySystem>(system))
    return std::make_shared<ExtendedEnergy>(std::move(with_energy), std::move(with));
  return std::make_shared<ExtendedImplicit>(system, std::move(with));
}

}  // namespace

ParameterExtension::ParameterExtension(std::shared_ptr<const ImplicitSystem> system,
                                       std::vector<Parameter> parameters)
    : system_(std::move(system)),
      extended_(extended_system(system_, parameters)),
      parameters_(std::move(parameters)) {}

VectorXd ParameterExtension::values() const {
  VectorXd theta(count());
  for (Index j = 0; j < count(); ++j) theta[j] = parameters_[static_cast<std::size_t>(j)].value;
  return theta;
}

State ParameterExtension::to_extended(const State& state) const {
  State all = state;
  all.x.resize(state.x.size() + count());
  all.x << state.x, values();
  if (state.v.size() > 0) {
    all.v.resize(state.v.size() + count());
    all.v << state.v, VectorXd::Zero(count());
  }
  return all;
}

State ParameterExtension::from_extended(const State& state) const {
  State own = state;
  own.x = state.x.head(state.x.size() - count());
  if (state.v.size() > 0) own.v = state.v.head(state.v.size() - count());
  return own;
}

AtParameters::AtParameters(const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters) names_.push_back(parameter.name);
}

AtParameters::Trace::Trace(const std::vector<std::string>& names,
                           const std::vector<ExprVector>& arguments)
    : parameters(add_parameters(graph, names)) {
  for (const ExprVector& argument : arguments)
    variables.push_back(graph.variables("argument", argument.size()));
}

ExprVector AtParameters::Trace::brought(const ExprVector& result,
                                        const std::vector<ExprVector>& arguments,
                                        const ExprVector& values) const {
  ExprVector from = parameters, to = values;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    from = joined(from, variables[i]);
    to = joined(to, arguments[i]);
  }
  return substitute(result, from, to);
}

}  // namespace courant
