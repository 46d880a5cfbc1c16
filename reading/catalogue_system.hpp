// CatalogueSystem: a ready-made system, described by formulas with parameters.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "courant/reading/model.hpp"
#include "courant/reading/registry.hpp"

namespace courant {

// A system of the catalogue that is data. Its text is a JSON object:
//
//   "summary"     one line
//   "reference"   where it is from
//   "parameters"  by name: "value", a number, an array or a formula of earlier ones; "unit" (SI;
//                 missing: none); "meaning", a few words; "positive": true if it has to be
//   "system"      the description by formulas, of any kind of system, in these parameters
//   "example"     what `courant new` writes: an experiment, whose "system" has what is not as by
//                 default. It expects a result that is known otherwise
//
// In an experiment each parameter is a key of the system, with its value as default:
//
//   "system": {"type": "duffing", "a": -1, "parameters": {"period": "2*pi/sqrt(2*a/m)"}}
//
// `parameters`, `tables` and `definitions` are those of the experiment, in which those of the
// system are known.
class CatalogueSystem {
 public:
  // Throws std::invalid_argument, with the name, if the text is not that.
  CatalogueSystem(std::string_view name, std::string_view text);

  // Its example, and this in formulas, have a key for each parameter.
  const KindDescription& description() const { return description_; }

  // The model of a system of this type, whose formulas `kinds` reads. What is wrong with a parameter is said at its
  // key.
  std::optional<Model> read(ObjectReader& system, const Registry<Model>& kinds) const;

 private:
  // The system in formulas with the values that the experiment gives.
  std::optional<Json> filled(ObjectReader& system) const;
  bool has_parameter(const std::string& name) const;
  // The problems of the system in formulas, at the places that the experiment has.
  void tell(const Findings& problems, ObjectReader& system) const;

  KindDescription description_;
  Json template_;  // in formulas, without parameters
  std::vector<std::string> parameters_, positive_;
};

// Those of systems/*.json.
const std::vector<CatalogueSystem>& catalogue_systems();

}  // namespace courant
