// Everything that an experiment can be made of.
#pragma once

#include <string>
#include <vector>

#include "courant/reading/kind.hpp"

namespace courant {

// The kinds of a noun.
struct Shelf {
  std::string name;         // "manifolds"
  std::string noun;         // "manifold", as in the schema
  std::string description;  // one sentence
  std::vector<KindDescription> kinds;
};

// Systems, manifolds, structures, methods, discretizations and projectors, those that a program has
// added included.
std::vector<Shelf> catalogue();

// The keys that all kinds of a shelf with three or more of them have, with the same meaning; they are said once.
std::vector<Key> common_keys(const Shelf& shelf);
// The shelf without these.
Shelf without_common_keys(Shelf shelf);

// The table of a shelf between two comments, as docs/experiment-format.md has it.
std::string marked_table(const Shelf& shelf);

// The JSON Schema of experiments: `frame` with the definitions of all nouns as the kinds declare
// them.
Json experiment_schema(Json frame);

}  // namespace courant
