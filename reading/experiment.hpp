// Experiment: what a JSON file asks for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "courant/integrators/boundary/boundary_solution.hpp"
#include "courant/reading/boundary.hpp"
#include "courant/reading/ensemble.hpp"
#include "courant/reading/event.hpp"
#include "courant/reading/expectation.hpp"
#include "courant/reading/initial_values.hpp"
#include "courant/reading/method_kinds.hpp"
#include "courant/reading/model.hpp"
#include "courant/reading/observable.hpp"
#include "courant/reading/output.hpp"
#include "courant/reading/sensitivities.hpp"
#include "courant/reading/symmetries.hpp"

namespace courant {

// What a run measures of its tangent map, as TangentMap defines it.
enum class Defect { symplecticity, volume };
std::string column_of(Defect defect);  // "symplecticity_defect", "volume_defect"

// A system, where it starts, how it is integrated, what is observed and expected. Without a method
// it asks for the constraint algorithm alone. docs/experiment-format.md has the whole of it.
struct Experiment {
  Json document;  // as written, defaults filled in
  std::string title;
  Model model;
  InitialValues initial;
  std::optional<MethodChoice> method;  // both or none
  std::optional<TimeSpan> time;
  std::vector<DeclaredSymmetry> symmetries;
  std::vector<Observable> observe;
  NameList energies =
      {};  // energy_words(model) of a run; those that `observe` has for others unnamed
  // Whether there are columns `supplied` and `dissipated`, where these are words, and `balance`.
  bool writes_energies = false, writes_balance = false;
  std::vector<Defect> defects;  // that have columns
  std::optional<Sensitivities> sensitivities = {};
  std::vector<Event> events;
  std::optional<Boundary> boundary = {};
  // Of an experiment that begins where its boundary conditions ask for, and takes as long.
  std::shared_ptr<const BoundarySolution> solution = {};
  std::optional<Ensemble> ensemble = {};
  Expectations expect;
  Output output;
  long examine = 0;                   // steps between two examinations of the ladder; 0: none
  std::vector<Problem> remarks = {};  // on what may be a slip, and changes nothing

  double start() const { return time ? time->start : 0.0; }
};

// Reads the text of a file. Throws ExperimentError with everything that is wrong with it.
Experiment read_experiment(std::string_view text);
// The same for what such a text says. Keys that begin with // are comments, at any depth.
Experiment read_experiment_document(const Json& document);
// About a system that is there as an object, which takes the place of the key "system":
//
//   read_experiment_document({{"initial", …}, {"method", "constrain-first"}, {"time", …}}, model_of(system))
Experiment read_experiment_document(const Json& document, const Model& model);
Json without_comments(const Json& document);

}  // namespace courant
