#include "courant/structures/time_transformation.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/solve/gauss_newton.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/structures/canonical_symplectic.hpp"

namespace courant {
namespace {

std::vector<Index> count_from(Index first, Index count) {
  std::vector<Index> list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), first);
  return list;
}

void append_from(std::vector<Index>& list, Index first, Index count) {
  for (Index i = 0; i < count; ++i) list.push_back(first + i);
}

std::shared_ptr<const Product> with_time(std::shared_ptr<const Manifold> manifold) {
  return std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
      std::move(manifold), std::make_shared<Euclidean>(1)});
}

const CotangentBundle& phase_space_of(const std::shared_ptr<const GeneratingFamily>& family,
                                      const TimeRate& rate) {
  const auto* bundle =
      family ? dynamic_cast<const CotangentBundle*>(family->manifold().get()) : nullptr;
  if (!bundle || !rate)
    throw std::invalid_argument(
        "TransformedFamily::TransformedFamily: the family or the rate is missing, or the family is "
        "not on a cotangent bundle.");
  return *bundle;
}

std::string time_name(const std::vector<std::string>& taken, std::string name) {
  while (std::ranges::find(taken, name) != taken.end()) name += '_';
  return name;
}

// Names of the extended system. Those of equations are left to it.
ImplicitSystem::Names extended_names(const ImplicitSystem& system, const TimePlaces& places) {
  const ImplicitSystem::Names& own = system.names();
  const auto size = static_cast<std::size_t>(places.manifold->ambient_dimension());
  ImplicitSystem::Names names{.coordinates = std::vector<std::string>(size),
                              .auxiliary = own.auxiliary};
  names.coordinates.back() = time_name(own.coordinates, "p_t");
  names.coordinates[static_cast<std::size_t>(places.time_of_point)] =
      time_name(own.coordinates, "t");
  for (std::size_t i = 0; i < places.point.size(); ++i)
    names.coordinates[static_cast<std::size_t>(places.point[i])] = own.coordinates[i];
  return names;
}

// The equation t' = g comes after the first tangent block of the others, so that it is one still.
struct TimeEquation {
  TimeEquation(const ImplicitSystem& system, const TimePlaces& its_places, TimeRate its_rate)
      : places(its_places),
        rate(std::move(its_rate)),
        first(system.tangent_blocks() > 0 ? system.manifold()->tangent_dimension()
                                          : system.equation_count()) {}

  // A point and time of the system, and its velocity.
  ExprVector point(const ExprVector& x) const { return x(places.point); }
  const Expr& time(const ExprVector& x) const { return x[places.time_of_point]; }
  Expr rate_at(const ExprVector& x) const { return rate(point(x), time(x)); }
  ExprVector velocity(const ExprVector& v, const Expr& g) const {
    return (v(places.tangent) / g).eval();
  }
  ExprVector with_time(const ExprVector& equations, const ExprVector& v, const Expr& g) const {
    ExprVector all(equations.size() + 1);
    all << equations.head(first), v[places.time_of_tangent] - g,
        equations.tail(equations.size() - first);
    return all;
  }
  ImplicitSystem::Names names(const ImplicitSystem& system) const {
    ImplicitSystem::Names all = extended_names(system, places);
    all.equations = system.names().equations;
    all.equations.insert(all.equations.begin() + first, "equation of time");
    return all;
  }

  TimePlaces places;
  TimeRate rate;
  Index first;
};

class PlainSystem final : public ImplicitSystem {
 public:
  PlainSystem(std::shared_ptr<const ImplicitSystem> system, TimeEquation time)
      : ImplicitSystem(time.places.manifold, system->auxiliary_size(), system->equation_count() + 1,
                       time.names(*system)),
        system_(std::move(system)),
        time_(std::move(time)) {}
  Index tangent_blocks() const override { return system_->tangent_blocks() > 0 ? 1 : 0; }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr&) const override {
    const Expr g = time_.rate_at(x);
    return time_.with_time(
        system_->residual(time_.point(x), time_.velocity(v, g), z, time_.time(x)), v, g);
  }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr&) const override {
    return system_->energy(time_.point(x), z, time_.time(x));
  }
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override {
    return system_->auxiliary_guess(x(time_.places.point), time_.places.velocity(v));
  }

  std::shared_ptr<const ImplicitSystem> system_;
  TimeEquation time_;
};

// Whether the energy depends on t.
bool has_time(const EnergySystem& system) {
  const Graph graph;
  const ExprVector t = graph.variables("t", 1);
  const Expr E = system.generator(graph.variables("x", system.manifold()->ambient_dimension()),
                                  graph.variables("z", system.auxiliary_size()), t[0]);
  return depends(ExprVector::Constant(1, E), t);
}

// The covector is (d_xE, ∂_tE). Powers are those in a unit of τ, with what time supplies as a port:
// along solutions ⟨α, v⟩ = g (supplied - dissipated) + α_t g.
class PlainEnergySystem final : public EnergySystem {
 public:
  PlainEnergySystem(std::shared_ptr<const EnergySystem> system, TimeEquation time)
      : EnergySystem(time.places.manifold, system->auxiliary_size(), system->equation_count() + 1,
                     time.names(*system)),
        system_(std::move(system)),
        time_(std::move(time)),
        has_time_(has_time(*system_)) {}
  Index tangent_blocks() const override { return system_->tangent_blocks() > 0 ? 1 : 0; }

 private:
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr&) const override {
    return system_->generator(time_.point(x), z, time_.time(x));
  }
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr&) const override {
    ExprVector alpha(manifold()->tangent_dimension());
    alpha(time_.places.tangent) = system_->effort(time_.point(x), z, time_.time(x));
    alpha[time_.places.time_of_tangent] = time_slope(x, z);
    return alpha;
  }
  ExprVector do_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                          const ExprVector& z, const Expr&, const ExprVector& y,
                          const Expr&) const override {
    const Expr g = time_.rate_at(x);
    return time_.with_time(
        system_->equations(time_.point(x), time_.velocity(v, g), alpha(time_.places.tangent), z,
                           time_.time(x), time_.point(y), time_.time(y)),
        v, g);
  }
  Powers do_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                   const ExprVector& z, const Expr&) const override {
    const Expr g = time_.rate_at(x);
    Powers powers = system_->powers(time_.point(x), time_.velocity(v, g),
                                    alpha(time_.places.tangent), z, time_.time(x));
    for (PortPower& port : powers.supplied) port.power = g * port.power;
    for (PortPower& port : powers.dissipated) port.power = g * port.power;
    if (has_time_)
      powers.supplied.push_back(
          {"time", alpha[time_.places.time_of_tangent] * v[time_.places.time_of_tangent]});
    return powers;
  }
  bool do_has_explicit_energy() const override { return system_->has_explicit_energy(); }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr&) const override {
    return system_->energy(time_.point(x), z, time_.time(x));
  }
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override {
    return system_->auxiliary_guess(x(time_.places.point), time_.places.velocity(v));
  }

  // ∂E/∂t, at fresh variables: x may be constants.
  Expr time_slope(const ExprVector& x, const ExprVector& z) const {
    const Graph graph = fresh_graph({x, z});
    ExprVector from(x.size() + z.size());
    from << graph.variables("x", x.size()), graph.variables("z", z.size());
    const ExprVector at = from.head(x.size());
    const ExprVector t = ExprVector::Constant(1, time_.time(at));
    const ExprVector slope =
        gradient(system_->generator(time_.point(at), from.tail(z.size()), time_.time(at)), t);
    ExprVector to(from.size());
    to << x, z;
    return substitute(slope, from, to)[0];
  }

  std::shared_ptr<const EnergySystem> system_;
  TimeEquation time_;
  bool has_time_;
};

std::shared_ptr<const ImplicitSystem> plain_system(
    const std::shared_ptr<const ImplicitSystem>& system, const TimeRate& rate,
    const TimePlaces& places) {
  TimeEquation time(*system, places, rate);
  if (auto with_energy = std::dynamic_pointer_cast<const EnergySystem>(system))
    return std::make_shared<PlainEnergySystem>(std::move(with_energy), std::move(time));
  return std::make_shared<PlainSystem>(system, std::move(time));
}

std::shared_ptr<const ImplicitSystem> symplectic_system(
    const ImplicitSystem& system, const std::shared_ptr<const GeneratingFamily>& family,
    const TimeRate& rate, const TimePlaces& places) {
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(
          std::dynamic_pointer_cast<const CotangentBundle>(places.manifold)),
      std::make_shared<TransformedFamily>(family, rate), extended_names(system, places));
}

}  // namespace

TimePlaces TimePlaces::on_product(std::shared_ptr<const Manifold> manifold) {
  const Index N = manifold->ambient_dimension(), n = manifold->tangent_dimension();
  return {.point = count_from(0, N),
          .tangent = count_from(0, n),
          .time_of_point = N,
          .time_of_tangent = n,
          .manifold = with_time(std::move(manifold))};
}

TimePlaces TimePlaces::on_cotangent_bundle(const CotangentBundle& phase_space) {
  const auto& base = phase_space.base();
  const Index N = base->ambient_dimension(), n = base->tangent_dimension();
  TimePlaces places{.point = count_from(0, N),
                    .tangent = count_from(0, n),
                    .time_of_point = N,
                    .time_of_tangent = n,
                    .manifold = std::make_shared<CotangentBundle>(with_time(base))};
  append_from(places.point, N + 1, n);
  append_from(places.tangent, n + 1, n);
  return places;
}

VectorXd TimePlaces::velocity(const VectorXd& extended) const {
  const double g = extended.size() > 0 ? extended[time_of_tangent] : 0.0;
  return g > 0.0 ? VectorXd(extended(tangent) / g) : VectorXd();
}

TransformedFamily::TransformedFamily(std::shared_ptr<const GeneratingFamily> family, TimeRate rate)
    : GeneratingFamily(TimePlaces::on_cotangent_bundle(phase_space_of(family, rate)).manifold,
                       family->parameter_size()),
      family_(std::move(family)),
      rate_(std::move(rate)),
      places_(TimePlaces::on_cotangent_bundle(phase_space_of(family_, rate_))) {}

Expr TransformedFamily::do_value(const ExprVector& x, const ExprVector& lambda, const Expr&) const {
  const ExprVector point = x(places_.point);
  const Expr& t = x[places_.time_of_point];
  return rate_(point, t) * (family_->value(point, lambda, t) + x[x.size() - 1]);
}

VectorXd TransformedFamily::do_parameter_guess(const VectorXd& x, const VectorXd& v) const {
  return family_->parameter_guess(x(places_.point), places_.velocity(v));
}

bool TimeTransformation::is_possible(const ImplicitSystem& system) {
  const auto* dirac = dynamic_cast<const DiracSystem*>(&system);
  return dirac && dirac->is_lagrangian().value_or(false) &&
         dynamic_cast<const CotangentBundle*>(system.manifold().get());
}

TimeTransformation TimeTransformation::plain(std::shared_ptr<const ImplicitSystem> system,
                                             TimeRate rate) {
  if (!system || !rate)
    throw std::invalid_argument("TimeTransformation::plain: the system or the rate is missing.");
  TimePlaces places = TimePlaces::on_product(system->manifold());
  return {std::move(system), std::move(rate), std::move(places), nullptr};
}

TimeTransformation TimeTransformation::symplectic(
    const std::shared_ptr<const ImplicitSystem>& system, TimeRate rate) {
  if (!system || !rate || !is_possible(*system))
    throw std::invalid_argument(
        "TimeTransformation::symplectic: the system or the rate is missing, or the system is not "
        "given by a Morse family on a cotangent bundle with its canonical structure.");
  const auto& dirac = static_cast<const DiracSystem&>(*system);
  return {system, std::move(rate),
          TimePlaces::on_cotangent_bundle(static_cast<const CotangentBundle&>(*system->manifold())),
          dirac.family()};
}

TimeTransformation::TimeTransformation(std::shared_ptr<const ImplicitSystem> system, TimeRate rate,
                                       TimePlaces places,
                                       std::shared_ptr<const GeneratingFamily> family)
    : system_(std::move(system)),
      extended_(family ? symplectic_system(*system_, family, rate, places)
                       : plain_system(system_, rate, places)),
      places_(std::move(places)),
      family_(std::move(family)) {
  const Graph graph;
  const ExprVector x = graph.variables("x", system_->manifold()->ambient_dimension());
  const ExprVector z = graph.variables("z", system_->auxiliary_size());
  const ExprVector t = graph.variables("t", 1);
  rate_ = Function("rate", {{"x", x}, {"t", t}}, ExprVector::Constant(1, rate(x, t[0])));
  if (const auto* with_energy = dynamic_cast<const EnergySystem*>(system_.get()))
    has_time_in_energy_ = has_time(*with_energy);
  if (!family_) return;
  const ExprVector lambda = z.head(family_->parameter_size());
  energy_ = Function("energy", {{"x", x}, {"z", z}, {"t", t}},
                     ExprVector::Constant(1, family_->value(x, lambda, t[0])));
  stationarity_ = Function("stationarity", {{"x", x}, {"z", z}, {"t", t}},
                           family_->stationarity(x, lambda, t[0]), {.differentiate = {"z"}});
}

double TimeTransformation::rate(const State& state) const {
  return rate_({state.x, VectorXd::Constant(1, state.t)})[0];
}

State TimeTransformation::to_extended(const State& state) const {
  const Manifold& M = *places_.manifold;
  const double g = rate(state);
  State all{.x = VectorXd::Zero(M.ambient_dimension()),
            .v = VectorXd::Zero(M.tangent_dimension()),
            .z = state.z.size() > 0 ? state.z : system_->auxiliary_guess(state.x, state.v)};
  all.x(places_.point) = state.x;
  all.x[places_.time_of_point] = state.t;
  if (state.v.size() > 0) all.v(places_.tangent) = g * state.v;
  all.v[places_.time_of_tangent] = g;
  if (!family_) return all;
  all.x[all.x.size() - 1] =
      state.carried.size() > 0
          ? state.carried[0]
          : -energy_({state.x, stationary(state, all.z), VectorXd::Constant(1, state.t)})[0];
  return all;
}

// The λ nearest to one that is known with ∂_λE = 0 at the point of a state.
VectorXd TimeTransformation::stationary(const State& state, const VectorXd& near) const {
  if (near.size() == 0) return near;
  const VectorXd t = VectorXd::Constant(1, state.t);
  const auto value = [&](const VectorXd& z) { return stationarity_({state.x, z, t}); };
  const auto jacobian = [&](const VectorXd& z) { return stationarity_.jacobian({state.x, z, t}); };
  const GaussNewtonResult found = gauss_newton(value, jacobian, near);
  return found.converged ? found.y : near;
}

State TimeTransformation::from_extended(const State& all) const {
  const double g = all.v[places_.time_of_tangent];
  State state{.t = all.x[places_.time_of_point],
              .x = all.x(places_.point),
              .v = all.v(places_.tangent),
              .z = all.z};
  if (g != 0.0)
    state.v /= g;
  else
    state.v.setZero();
  if (family_) state.carried = all.x.tail(1);
  return state;
}

VectorXd TimeTransformation::covector(const VectorXd& extended) const {
  return extended.size() > 0 ? VectorXd(extended(places_.tangent)) : VectorXd();
}

}  // namespace courant
