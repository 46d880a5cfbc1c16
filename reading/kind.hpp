// KindDescription: what an experiment may say of one kind of thing, declared once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/findings.hpp"

namespace courant {

struct KindDescription;

// What a key takes: for people, as the end of "expected …", and for editors, as a JSON Schema.
struct Takes {
  std::string text;
  Json schema;
  std::vector<std::string> words = {};  // if it is one of these
};

// The values that keys take. Schemas refer to the definitions of experiments/schema.json.
namespace takes {
Takes number();
Takes number(double least, double greatest);
Takes integer(Index least);
Takes integer(const std::vector<int>& values);  // one of these
Takes text();
Takes word(std::vector<std::string> words);
Takes formula();
Takes formulas();                              // a formula, an array or a matrix of them
Takes formula_vector();                        // an array
Takes formula_matrix();                        // by rows
Takes components();                            // formulas, or an object of them by coordinate
Takes form_matrix();                           // a matrix, or "canonical"
Takes metric(std::vector<std::string> words);  // one of the words, or a matrix of formulas
Takes weights();                               // an object of names and positive numbers
Takes brackets();                              // an object of formulas by pairs of names
Takes field_rows();                            // vector fields or one-forms, one a row
Takes number_matrices();
Takes representation(std::vector<std::string> words);  // one of the words, or number_matrices
Takes coordinates();                                   // names and arrays of names, at least one
Takes names();
Takes parameters();
Takes tables();
Takes definitions();
Takes systems();  // an object of systems
Takes joint();
Takes boundary_conditions();  // an object of objects of formulas by region
Takes repetition();           // indices with their first and last values
Takes nodes();                // names, and patterns of names that are repeated
// One of the kinds of a noun: "manifold", "structure", "discretization", "projector", "method",
// "system".
Takes kind(const std::string& noun);
Takes array_of(const Takes& entry, std::size_t least = 0, std::optional<std::size_t> most = {});
// Parts of a mechanism: objects with the keys of a kind without a type, one, by name or in a list; true or false; a
// pose, an object of positions, a point of a body.
Takes one(const KindDescription& part);
Takes named(const KindDescription& part);
Takes list_of(const KindDescription& part);
Takes flag();
Takes pose();
Takes places();
Takes place_on_body();
// An object with `coordinates`, `manifold` and `structure`.
Takes structure_part();
}  // namespace takes

// A key of a kind. Without it there is an error (`required`), or it stands for `otherwise`, or
// nothing is said (an `otherwise` of null).
struct Key {
  std::string name;
  Takes takes;
  std::string summary;  // one sentence, without a full stop
  bool required = false;
  Json otherwise = nullptr;
};

// A key without which there is an error; one of which nothing is said if it is missing; one that then has a default.
Key required_key(std::string name, Takes takes, std::string summary);
Key optional_key(std::string name, Takes takes, std::string summary);
Key default_key(std::string name, Takes takes, Json otherwise, std::string summary);

// A kind of a noun, such as the "sphere" of "manifold": its word, one line, and its keys beside
// `type`. Without a word it is an object with these keys, which has no `type` unless that is one of them.
//
// Everything that is said of keys comes from here: the errors of the reader, which calls a key that
// is not declared unknown and takes defaults and words from the declaration; `courant list`, with
// and without --json; the JSON Schema; the tables of docs/experiment-format.md. Tests hold the last
// two to it.
struct KindDescription {
  std::string type;
  std::string summary;  // one line
  std::vector<Key> keys = {};
  // Of each of these sets of optional keys exactly one has to be there.
  std::vector<std::vector<std::string>> one_of = {};
  // Of systems: an experiment to start from, which `courant new` comments; null if there is none.
  Json example = nullptr;
  // Of systems of the catalogue that are data: the same as a description by formulas, and where it is from.
  Json formulas = nullptr;
  std::string reference = {};

  const Key* find(const std::string& key) const;  // null if there is none
  std::string sentence() const;                   // the summary, and the reference in brackets
  // Of the objects of this kind.
  Json schema() const;
};

// The JSON Schema of a noun: its kinds, those without required keys by their word alone too.
Json schema_of(const std::string& description, const std::vector<KindDescription>& kinds);
// A table in Markdown: type, keys with what they take and their defaults, summary.
std::string markdown_table(const std::vector<KindDescription>& kinds);

}  // namespace courant
