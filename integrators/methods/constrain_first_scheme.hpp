// What a step by Method 2 is made from.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/open_jets.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// A system with its ladder, a discretization map and a projector, and what follows from them before any
// formula of a step is there: S_f, M_f of codimension d, and W where it is the same everywhere.
struct ConstrainFirstScheme {
  // Of S_f: equations that follow from the others, and what is open in those that are left.
  struct Omissions {
    std::vector<Index> redundant;  // ascending
    OpenJets open;
    VectorXd held;  // values of open.unknowns
  };

  // Throws std::invalid_argument where ConstrainFirst does.
  ConstrainFirstScheme(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
                       std::shared_ptr<const DiscretizationMap> map,
                       std::shared_ptr<const Projector> projector, bool keeps_all_equations);

  std::string name() const { return "constrain-first"; }
  const Manifold& manifold() const { return *system->manifold(); }
  // d = dim M - dim M_f
  Index codimension() const { return manifold().dimension() - ladder->degrees_of_freedom; }
  Index gauge_dimension() const { return ladder->gauge_dimension; }
  // Whether W is the same at every x, or there is nothing to project.
  bool has_fixed_directions() const { return codimension() == 0 || fixed_directions.size() > 0; }

  std::shared_ptr<const ImplicitSystem> system;
  std::shared_ptr<const ConstraintLadder> ladder;
  std::shared_ptr<const DiscretizationMap> map;
  std::shared_ptr<const Projector> projector;
  bool keeps_all_equations;   // those that follow from others too
  MatrixXd fixed_directions;  // W, where it is the same at every x; else empty
};

}  // namespace courant
