// Repetition: a part of an experiment that is written once and read many times.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {

// The key `repeat` of an object: integer indices, each with its first and its last value.
//
//   {"repeat": {"i": [1, "n"], "j": [1, "i"]}, "name": "n{i}_{j}"}
//
// There is a turn for each choice of the indices, the last of which runs fastest, and none where a
// last value is one less than the first. The bounds are constant formulas of parameters and of the
// indices before. In a turn, every {formula} in the texts beside `repeat` stands for its value:
// "n{i+1}" for "n4" where i = 3. It is a formula of parameters and indices, with an integer from 0 as
// its value. At most 10⁶ turns. Without the key there is one turn, and braces know parameters alone.
class Repetition {
 public:
  // One choice of the indices.
  class Turn {
   public:
    Turn(SymbolTable symbols, std::string words)
        : symbols_(std::move(symbols)), words_(std::move(words)) {}

    // "i = 3, j = 4"
    const std::string& words() const { return words_; }
    // A text with its braces filled in; nothing, and a problem, where one is wrong.
    std::optional<std::string> filled(const std::string& text, const std::string& pointer,
                                      Findings& findings) const;
    // The same for all texts of a value, without the key `repeat` of an object.
    Json filled(const JsonReader& pattern) const;

   private:
    SymbolTable symbols_;
    std::string words_;
  };

  // Nothing, and a problem, where the value of `repeat` is wrong. No index may have the name of a
  // constant.
  static std::optional<Repetition> read(const JsonReader& repeat, const SymbolTable& constants);

  // What reads one turn, with findings of its own.
  using Read = std::function<void(const Turn&, Findings&)>;
  // Makes the turns, up to the first in which problems are found. They become problems of `findings`
  // that say which turn it is; what the first turn leaves to defaults is kept. Whether all was right.
  bool for_each(Findings& findings, const Read& read) const;

 private:
  Repetition(SymbolTable constants, std::vector<std::string> names)
      : constants_(std::move(constants)), names_(std::move(names)) {}
  SymbolTable symbols(const std::vector<Index>& turn) const;

  SymbolTable constants_;
  std::vector<std::string> names_;
  std::vector<std::vector<Index>> turns_;
};

}  // namespace courant
