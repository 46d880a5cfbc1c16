// What an experiment chooses of a method, before there is a system to make it for.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/reading/nominal_sizes.hpp"
#include "courant/reading/vocabulary.hpp"
#include "courant/structures/implicit_system.hpp"
#include "courant/structures/parameter_extension.hpp"
#include "courant/structures/time_transformation.hpp"

namespace courant {

class TransformedIntegrator;

// What a method is made for.
struct MethodSetting {
  std::shared_ptr<const ImplicitSystem> system;
  const ConstraintLadder& ladder;  // of the system at the initial state
  State initial;
  double step = 0.0;
  Backend backend = Backend::automatic;
  const Vocabulary* vocabulary = nullptr;  // the names for formulas of the method, if it has any
  // Of a system in transformed time: the setting in its own, and what leads from one to the other.
  const MethodSetting* own = nullptr;
  std::shared_ptr<const TimeTransformation> transformation = nullptr;
  // Sizes that are given of coordinates and unknowns, or null.
  const NominalSizes* nominal = nullptr;
  // Of a system with parameters as coordinates: the setting of the system itself, and what leads from one to the other.
  const MethodSetting* plain = nullptr;
  const ParameterExtension* extension = nullptr;
};

// The method, the initial state moved to where it wants to start, and the discretization map, of
// methods that have one.
struct PreparedMethod {
  std::shared_ptr<const Integrator> integrator;
  State initial;
  std::shared_ptr<const DiscretizationMap> map = {};
  // In transformed time: the method that makes the integrator's steps, whose laws are those of the extended
  // system.
  std::shared_ptr<const TransformedIntegrator> transformed = {};
  // What a projector measures moves by, "kinetic", "euclidean" or "given"; empty where nothing is measured.
  std::string metric = {};
};

// The choice of a method, before there is a system to make it for.
struct MethodChoice {
  std::string description;  // "constrain-first, midpoint, momentum projector"
  // Throws std::invalid_argument where the method does not fit the system.
  std::function<PreparedMethod(const MethodSetting&)> prepare;
  // Whether steps on a Lagrangian system of this setting are symplectic; empty: they are not.
  std::function<bool(const MethodSetting&)> keeps_form = {};
};

// The choice of a discretization map. `make` gives it on any manifold; on a cotangent bundle it is
// the cotangent lift of that on the base.
struct DiscretizationChoice {
  std::string description;
  std::function<std::shared_ptr<const DiscretizationMap>(std::shared_ptr<const Manifold>)> make;
  // Whether a step is half a step of this map, then half a step of its adjoint (Verlet).
  bool is_half = false;
};

// The choice of a projector; `make` throws std::invalid_argument where it does not fit the
// manifold, ExperimentError where its formulas or names do not fit the system.
struct ProjectorChoice {
  struct Made {
    std::shared_ptr<const Projector> projector;
    std::string metric = {};  // as of PreparedMethod
  };
  std::string description;
  std::function<Made(const MethodSetting&)> make;
};

}  // namespace courant
