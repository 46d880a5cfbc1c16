#include "courant/systems/structure_kinds.hpp"

#include <cmath>
#include <random>

#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/poisson.hpp"

namespace courant {
namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

// The matrix at x, filled by rows.
ExprMatrix matrix(const WrittenFormulas& formulas, const Vocabulary& vocabulary,
                  const ExprVector& x) {
  const ExprVector entries = evaluate(formulas, vocabulary.symbols({.x = x}));
  const Index columns = formulas.shape[1];
  ExprMatrix result(formulas.shape[0], columns);
  for (Index i = 0; i < result.rows(); ++i) result.row(i) = entries.segment(i * columns, columns);
  return result;
}

// Whether A(x) + A(x)ᵀ = 0, up to round-off, at some points; a problem where it is not. Points
// where the matrix is not finite say nothing.
bool is_skew(const Manifold& manifold, const Poisson::Bivector& bivector, const JsonReader& place) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 3; ++trial) {
    const MatrixXd A = values(bivector(constants(manifold.random_point(generator))));
    if (!A.allFinite()) continue;
    Index i = 0, j = 0;
    const double defect = (A + A.transpose()).cwiseAbs().maxCoeff(&i, &j);
    if (defect > 1e-12 * A.cwiseAbs().maxCoeff()) {
      const auto entry = [](Index row, Index column) {
        return "[" + std::to_string(row) + "][" + std::to_string(column) + "]";
      };
      place.problem("is not skew-symmetric: at a random point entry " + entry(i, j) +
                    (i == j ? " is " : " and entry " + entry(j, i) + " add up to ") +
                    std::to_string(i == j ? A(i, i) : A(i, j) + A(j, i)) + "; expected 0");
      return false;
    }
  }
  return true;
}

std::optional<StructurePointer> canonical(ObjectReader& object, const StructureSite& site) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(site.manifold);
  if (!bundle) {
    object.place().problem("the canonical structure is on " + site.manifold->name() +
                           "; expected a cotangent bundle as manifold");
    return std::nullopt;
  }
  return std::make_shared<CanonicalSymplectic>(bundle);
}

std::optional<StructurePointer> bivector(ObjectReader& object, const StructureSite& site) {
  const Index n = site.manifold->tangent_dimension();
  const auto key = object.required("matrix");
  const auto formulas = key ? read_formula_matrix(*key, n, n) : std::nullopt;
  if (!formulas) return std::nullopt;
  Graph graph;
  const ExprVector x = graph.variables("x", site.manifold->ambient_dimension());
  if (!check(*formulas, site.vocabulary.symbols({.x = x}), key->findings())) return std::nullopt;
  const Poisson::Bivector bivector = [formulas = *formulas,
                                      vocabulary = site.vocabulary](const ExprVector& point) {
    return matrix(formulas, vocabulary, point);
  };
  if (!is_skew(*site.manifold, bivector, *key)) return std::nullopt;
  return std::make_shared<Poisson>(site.manifold, bivector);
}

}  // namespace

const Registry<StructurePointer, StructureSite>& structure_kinds() {
  static const Registry<StructurePointer, StructureSite> kinds({
      {{"canonical", "the graph of ω = dq ∧ dp on a cotangent bundle"}, canonical},
      {{"bivector", "the graph of a bivector given by its \"matrix\" Λ of formulas: v = Λ(x) α"},
       bivector},
  });
  return kinds;
}

}  // namespace courant
