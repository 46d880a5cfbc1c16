#include "courant/reading/method_kinds.hpp"

#include <array>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/staggered.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/damped_composition.hpp"
#include "courant/integrators/methods/discrete_gradient.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/reduced_map.hpp"
#include "courant/integrators/methods/staggering.hpp"
#include "courant/integrators/methods/starting_procedure.hpp"
#include "courant/integrators/methods/verlet.hpp"
#include "courant/integrators/step/projector_in_units.hpp"
#include "courant/reading/method_in_units.hpp"
#include "courant/reading/transformed_time.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;
using MapPointer = std::shared_ptr<const DiscretizationMap>;

std::shared_ptr<const Integrator> explicit_method(const MethodSetting& at,
                                                  ExplicitRungeKutta::Kind kind) {
  return std::make_shared<ExplicitRungeKutta>(
      std::make_shared<VectorField>(at.system, at.ladder, at.backend), kind);
}

// Where Method 1 starts so that its first step leads to where RK2 leads.
State start_of_method_1(const MethodSetting& at, const DiscretizationMap& map) {
  const State next =
      explicit_method(at, ExplicitRungeKutta::Kind::midpoint)->advance(at.initial, at.step);
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(at.system->manifold());
  if (!bundle)
    throw std::invalid_argument(
        "the start \"rk2\" is for cotangent bundles, but the system is on " +
        at.system->manifold()->name() + "; expected \"on-manifold\"");
  return starting_procedure(*at.system, map, at.initial, bundle->position(next.x), at.step);
}

const std::vector<int> kOrders = {2, 4, 6, 8};

// The order that is asked for, 0 for the method's own; nothing if it is none of kOrders.
std::optional<int> read_order(ObjectReader& object) {
  const auto key = object.optional("order");
  if (!key) return 0;
  const auto order = key->integer(2);
  if (!order) return std::nullopt;
  if (std::ranges::find(kOrders, *order) != kOrders.end()) return static_cast<int>(*order);
  key->expected(takes::integer(kOrders).text);
  return std::nullopt;
}

std::string order_text(int order) { return order == 0 ? "" : ", order " + std::to_string(order); }

// The method itself, or the composition of that order.
std::shared_ptr<const Integrator> composed(std::shared_ptr<const Integrator> method, int order) {
  if (order == 0 || order == method->order()) return method;
  const auto refuse = [order](const std::string& reason) {
    throw ExperimentError("/method/order", "is " + std::to_string(order) + ", but " + reason);
  };
  if (!method->is_symmetric() || method->order() != 2)
    refuse("the method is not symmetric, and of order " + std::to_string(method->order()) +
           "; expected a symmetric discretization such as \"midpoint\", and no gauge freedom");
  return std::make_shared<Composition>(std::move(method), order);
}

// Whether `damping` is asked for, whose steps are those of the theta family; nothing, and a problem, if
// another discretization is.
std::optional<bool> read_damping(ObjectReader& object,
                                 const std::optional<DiscretizationChoice>& map) {
  const bool is_damped = object.word("damping") == "l-stable";
  if (!is_damped || !map || map->description == "midpoint") return is_damped;
  object.optional("damping")->problem(
      "is \"l-stable\", which is made of steps of the theta family, theta = 0.414 and 1; expected "
      "the discretization \"midpoint\", which these take the place of");
  return std::nullopt;
}

std::string damping_text(bool is_damped) { return is_damped ? ", damped" : ""; }

// The two maps of a DampedComposition, on the space of the states itself: a cotangent lift is explicit in
// momenta where it is implicit in positions, and damps nothing.
std::array<MapPointer, 2> damped_maps(const MethodSetting& at) {
  const auto theta_map = [&](double theta) {
    return map_at({"theta",
                   [theta](const ManifoldPointer& M) -> MapPointer {
                     return std::make_shared<Theta>(M, theta);
                   }},
                  at);
  };
  return {theta_map(DampedComposition::kThetas[0]), theta_map(DampedComposition::kThetas[1])};
}

// R_d of Verlet. On spaces that are no cotangent bundles coordinates are told apart by what they move by.
MapPointer half_at(const DiscretizationChoice& map, const MethodSetting& at) {
  if (at.extension) return beside_parameters(half_at(map, *at.plain), at);
  const auto& M = at.system->manifold();
  if (std::dynamic_pointer_cast<const CotangentBundle>(M)) return map.make(M);
  const auto classes = staggering({at.system, at.ladder, VectorFieldFormulas::Freedom::none});
  if (classes) return std::make_shared<Staggered>(M, *classes);
  throw std::invalid_argument(
      "the discretization \"verlet\" is for positions and momenta, or for coordinates in two "
      "classes that move by "
      "each other, as charges and fluxes without resistors do; on " +
      M->name() + " they are not. Expected \"midpoint\"");
}

std::shared_ptr<const Integrator> in_halves(const MethodSetting& at, const MapPointer& map) {
  return std::make_shared<Verlet>(at.system, at.ladder, map,
                                  Verlet::Options{.backend = at.backend});
}

// A method of one or two maps, the order that is asked for, 0 for its own, and where it starts.
template <class Make>
PreparedMethod with_maps(const DiscretizationChoice& map, bool is_damped, int order,
                         const MethodSetting& at, const Make& make) {
  if (!is_damped) {
    const auto on_manifold = map.is_half ? half_at(map, at) : map_at(map, at);
    return {composed(make(on_manifold), order), at.initial, on_manifold};
  }
  const auto maps = damped_maps(at);
  return {composed(std::make_shared<DampedComposition>(make(maps[0]), make(maps[1])), order),
          at.initial, maps[1]};
}

// Steps of Method 1 that leave constraints in between are not near the identity, and compositions of them stay at order 2.
void require_no_constraints(int order, const MethodSetting& at, const std::string& method) {
  if (order <= 2 || at.ladder.degrees_of_freedom == at.system->manifold()->dimension()) return;
  throw ExperimentError("/method/order",
                        "is " + std::to_string(order) +
                            ", but on a system with constraints steps of " + method +
                            " are not near the identity, and compositions of them stay at order 2; "
                            "expected \"constrain-first\"");
}

std::optional<MethodChoice> discretize_first(ObjectReader& object) {
  const auto map = discretization_kinds().read_key(object, "discretization");
  const bool rk2 = object.word("start") == "rk2";
  const auto order = read_order(object);
  const auto is_damped = read_damping(object, map);
  if (!map || !order || !is_damped) return std::nullopt;
  if (rk2 && *is_damped) {
    object.optional("start")->problem(
        "is \"rk2\", which is about one step of the midpoint rule; expected \"on-manifold\" with "
        "damping");
    return std::nullopt;
  }
  if (rk2 && map->is_half) {
    object.optional("start")->problem(
        "is \"rk2\", which is about one step of the midpoint rule; expected \"on-manifold\" with "
        "the discretization \"verlet\"");
    return std::nullopt;
  }
  if (rk2 && *order > 2) {
    object.optional("start")->problem(
        "is \"rk2\", which is about one step of order 2; expected \"on-manifold\" with order " +
        std::to_string(*order));
    return std::nullopt;
  }
  return MethodChoice{
      "discretize-first, " + map->description + damping_text(*is_damped) + order_text(*order) +
          (rk2 ? ", started by rk2" : ""),
      [map = *map, order = *order, is_damped = *is_damped, rk2](const MethodSetting& at) {
        require_no_constraints(order, at, "discretize-first");
        if (map.is_half && at.ladder.degrees_of_freedom < at.system->manifold()->dimension())
          throw ExperimentError(
              "/method/discretization",
              "is \"verlet\", but on a system with constraints the equations of both halves leave "
              "the "
              "momentum at the end of a step open along the constraints; expected "
              "\"constrain-first\", which knows that it is on M_f");
        if (rk2 && at.own)
          throw std::invalid_argument(
              "the start \"rk2\" is about one step of a given length of time; expected "
              "\"on-manifold\" with a transformation of time");
        return prepared_in_units(
            [&](const MethodSetting& in_units) {
              PreparedMethod method = with_maps(
                  map, is_damped, order, in_units,
                  [&](const MapPointer& on_manifold) -> std::shared_ptr<const Integrator> {
                    if (map.is_half) return in_halves(in_units, on_manifold);
                    return std::make_shared<DiscretizeFirst>(
                        in_units.system, on_manifold,
                        DiscretizeFirst::Options{.backend = in_units.backend});
                  });
              if (rk2) method.initial = start_of_method_1(in_units, *method.map);
              return method;
            },
            at);
      },
      [is_damped = *is_damped](const MethodSetting&) { return !is_damped; }};
}

// Whether this is what stands for a key that is missing, written as a word or as an object.
bool is_default(const ObjectReader& object, const std::string& key, const Json& value) {
  const Json& word = object.declared_default(key);
  return value == word || value == Json{{"type", word}};
}

// The projector for a system, which may be the one that it was made for in other units.
std::shared_ptr<const Projector> in_units_of(const ImplicitSystem& system,
                                             const std::shared_ptr<const Projector>& projector) {
  const auto* measured = dynamic_cast<const SystemInUnits*>(&system);
  if (!measured) return projector;
  return std::make_shared<ProjectorInUnits>(projector, measured->units());
}

std::optional<MethodChoice> constrain_first(ObjectReader& object) {
  const auto map = discretization_kinds().read_key(object, "discretization");
  const auto projector = projector_kinds().read_key(object, "projector");
  const auto order = read_order(object);
  const auto is_damped = read_damping(object, map);
  if (!map || !projector || !order || !is_damped) return std::nullopt;
  if (const auto given = object.optional("projector");
      given && map->is_half && !is_default(object, "projector", given->value())) {
    given->problem(
        "takes no part in the discretization \"verlet\", whose multipliers lead to M_f; expected "
        "no "
        "projector");
    return std::nullopt;
  }
  return MethodChoice{
      "constrain-first, " + map->description + damping_text(*is_damped) +
          (map->is_half ? "" : ", " + projector->description) + order_text(*order),
      [map = *map, projector = *projector, order = *order,
       is_damped = *is_damped](const MethodSetting& at) {
        const ProjectorChoice::Made made =
            map.is_half ? ProjectorChoice::Made{} : projector_at(projector, at);
        PreparedMethod method = prepared_in_units(
            [&](const MethodSetting& in_units) {
              return with_maps(
                  map, is_damped, order, in_units,
                  [&](const MapPointer& on_manifold) -> std::shared_ptr<const Integrator> {
                    if (map.is_half) return in_halves(in_units, on_manifold);
                    return std::make_shared<ConstrainFirst>(
                        in_units.system, in_units.ladder, on_manifold,
                        in_units_of(*in_units.system, made.projector),
                        ConstrainFirst::Options{.backend = in_units.backend});
                  });
            },
            at);
        // Without constraints nothing is projected.
        if (at.ladder.degrees_of_freedom < at.system->manifold()->dimension())
          method.metric = made.metric;
        return method;
      },
      [is_damped = *is_damped](const MethodSetting& at) {
        return !is_damped && at.ladder.degrees_of_freedom == at.system->manifold()->dimension();
      }};
}

std::optional<MethodChoice> reduced(ObjectReader& object) {
  const auto map = read_map(object, "discretization");
  const auto order = read_order(object);
  if (!map || !order) return std::nullopt;
  return MethodChoice{
      "reduced, " + map->description + order_text(*order),
      [map = *map, order = *order](const MethodSetting& at) {
        if (at.own)
          throw std::invalid_argument(
              "\"reduced\" takes no transformation of time; expected another method, such as "
              "\"discretize-first\"");
        if (at.extension)
          throw std::invalid_argument(
              "steps of \"reduced\" are not known as functions of parameters; expected initial "
              "values alone, or another method, such as \"discretize-first\"");
        require_no_constraints(order, at, "reduced");
        const auto system = std::dynamic_pointer_cast<const DiracSystem>(at.system);
        const auto structure =
            system ? std::dynamic_pointer_cast<const LiePoisson>(system->structure()) : nullptr;
        if (!structure)
          throw std::invalid_argument(
              "\"reduced\" is for Lie-Poisson structures, as those of \"euler-poincare\"; expected "
              "another method");
        const auto group = structure->group() ? structure->group() : group_of(structure->acting());
        if (!group)
          throw std::invalid_argument("no group is known for the Lie algebra " +
                                      structure->acting().name() +
                                      ", by its matrices or those of its adjoint representation; "
                                      "expected an algebra with a name, or "
                                      "one of \"matrices\"");
        const auto on_group = map.make(group);
        return PreparedMethod{
            composed(std::make_shared<ReducedMap>(system, on_group,
                                                  ReducedMap::Options{.backend = at.backend}),
                     order),
            at.initial, on_group};
      }};
}

std::shared_ptr<const DiscreteDifferential> differential(const std::string& name) {
  if (name == "averaged-vector-field") return std::make_shared<AveragedDifferential>();
  if (name == "itoh-abe") return std::make_shared<ItohAbeDifferential>();
  return std::make_shared<GonzalezDifferential>();
}

std::optional<MethodChoice> discrete_gradient(ObjectReader& object) {
  const auto map = read_map(object, "discretization");
  const std::string gradient = object.word("gradient");
  if (!map) return std::nullopt;
  return MethodChoice{"discrete-gradient, " + gradient + ", " + map->description,
                      [map = *map, gradient](const MethodSetting& at) {
                        const auto on_manifold = map_at(map, at);
                        return PreparedMethod{std::make_shared<DiscreteGradient>(
                                                  at.system, on_manifold, differential(gradient),
                                                  DiscreteGradient::Options{.backend = at.backend,
                                                                            .units = units_at(at)}),
                                              at.initial, on_manifold};
                      }};
}

template <ExplicitRungeKutta::Kind kind>
std::optional<MethodChoice> explicit_runge_kutta(ObjectReader& object) {
  const auto prepare = [](const MethodSetting& at) {
    return PreparedMethod{explicit_method(at, kind), at.initial};
  };
  return MethodChoice{object.optional("type")->text().value(), [prepare](const MethodSetting& at) {
                        return prepared_in_units(prepare, at);
                      }};
}

}  // namespace

Registry<MethodChoice>& method_kinds() {
  const Key map = default_key("discretization", takes::kind("discretization"), "midpoint", "R_d");
  const Key order = optional_key("order", takes::integer(kOrders),
                                 "by symmetric composition; that of the discretization if missing");
  const Key damping = default_key(
      "damping", takes::word({"none", "l-stable"}), "none",
      "l-stable: two steps of the theta family in each, of order 2; what is faster than a "
      "step dies out, where the midpoint rule carries it on");
  static Registry<MethodChoice> kinds({
      {{"discretize-first",
        "Method 1: (1/h) R_d⁻¹(x₀, x₁) ∈ S₀",
        {map, order, damping,
         default_key("start", takes::word({"on-manifold", "rk2"}), "on-manifold",
                     "at the consistent point, or with the momentum that makes the first step "
                     "that of rk2")}},
       discretize_first},
      {{"constrain-first",
        "Method 2: the constraint algorithm, then R_d projected to M_f",
        {map, order, damping,
         default_key("projector", takes::kind("projector"), "orthogonal",
                     "how points are brought to M_f")}},
       constrain_first},
      {{"discrete-gradient",
        "Method 1 with a discrete gradient of H: energy changes by exactly what ports supply and "
        "resistors take",
        {map,
         default_key("gradient", takes::word({"gonzalez", "averaged-vector-field", "itoh-abe"}),
                     "gonzalez", "which one; itoh-abe is of order 1")}},
       discrete_gradient},
      {{"reduced",
        "Method 1 on a Lie group, reduced to the dual of its Lie algebra: coadjoint orbits are "
        "kept",
        {default_key("discretization", takes::kind("discretization"), "cayley",
                     "R_d, on the group"),
         order}},
       reduced},
      {{"rk2", "explicit midpoint rule on S_f, order 2"},
       explicit_runge_kutta<ExplicitRungeKutta::Kind::midpoint>},
      {{"rk4", "classical Runge–Kutta method on S_f, order 4"},
       explicit_runge_kutta<ExplicitRungeKutta::Kind::classical>},
      {{"dopri5", "Dormand–Prince method on S_f at constant steps, order 5"},
       explicit_runge_kutta<ExplicitRungeKutta::Kind::dormand_prince>},
      {{"rkf78", "method of Fehlberg on S_f at constant steps, order 8"},
       explicit_runge_kutta<ExplicitRungeKutta::Kind::fehlberg>},
  });
  return kinds;
}

}  // namespace courant
