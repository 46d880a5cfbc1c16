#include "courant/reading/lie_algebra_keys.hpp"

#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {

std::vector<Key> lie_algebra_keys() {
  return {optional_key("algebra", takes::word({"so3", "se3", "so", "abelian"}), "one with a name"),
          optional_key("n", takes::integer(0), "of so(n) and Rⁿ"),
          optional_key("constants", takes::number_matrices(),
                       "constants[k][i][j]: the part of [e_i, e_j] along e_k")};
}

std::optional<std::vector<MatrixXd>> read_matrices(const JsonReader& value) {
  const auto elements = value.elements();
  if (!elements) return std::nullopt;
  std::vector<MatrixXd> result;
  for (const JsonReader& element : *elements) {
    const auto rows = element.elements();
    if (!rows) return std::nullopt;
    const auto n = static_cast<Index>(rows->size());
    MatrixXd A(n, n);
    for (Index i = 0; i < n; ++i) {
      const auto entries = (*rows)[static_cast<std::size_t>(i)].elements();
      if (!entries) return std::nullopt;
      if (static_cast<Index>(entries->size()) != n) {
        element.expected("a square matrix of numbers");
        return std::nullopt;
      }
      for (Index j = 0; j < n; ++j) {
        const auto entry = (*entries)[static_cast<std::size_t>(j)].number();
        if (!entry) return std::nullopt;
        A(i, j) = *entry;
      }
    }
    result.push_back(std::move(A));
  }
  return result;
}

std::optional<LieAlgebra> read_lie_algebra(ObjectReader& object) {
  const auto algebra = object.optional("algebra"), constants_key = object.optional("constants");
  const auto n_key = object.optional("n");
  if (!algebra == !constants_key) {
    object.place().problem(
        "a Lie algebra is one of \"algebra\" or has structure \"constants\"; expected one of the "
        "two");
    return std::nullopt;
  }
  const JsonReader& place = algebra ? *algebra : *constants_key;
  try {
    if (algebra) {
      const auto word = algebra->word({"so3", "se3", "so", "abelian"});
      if (!word) return std::nullopt;
      const bool sized = *word == "so" || *word == "abelian";
      if (sized != n_key.has_value()) {
        place.problem(sized ? "needs its size; expected \"n\" beside it"
                            : "has a size of its own; expected no \"n\" beside it");
        return std::nullopt;
      }
      const auto n = sized ? n_key->integer(0) : std::optional<Index>(0);
      if (!n) return std::nullopt;
      return *word == "so3"   ? LieAlgebra::so3()
             : *word == "se3" ? LieAlgebra::se3()
             : *word == "so"  ? LieAlgebra::so(*n)
                              : LieAlgebra::abelian(*n);
    }
    const auto constants = read_matrices(*constants_key);
    if (!constants) return std::nullopt;
    return LieAlgebra("g", *constants);
  } catch (const std::exception& error) {
    place.problem(without_place(error.what()));
    return std::nullopt;
  }
}

std::optional<LieAlgebra> semidirect(const LieAlgebra& g, const std::vector<MatrixXd>& rho,
                                     const JsonReader& place) {
  try {
    return LieAlgebra::semidirect(g, rho);
  } catch (const std::exception& error) {
    place.problem(without_place(error.what()));
    return std::nullopt;
  }
}

}  // namespace courant
