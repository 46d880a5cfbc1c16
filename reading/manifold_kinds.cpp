#include <random>

#include "courant/core/words/message.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/stiefel.hpp"
#include "courant/manifolds/symmetric_positive_definite.hpp"
#include "courant/manifolds/tangent_bundle.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/reading/lie_algebra_keys.hpp"
#include "courant/reading/space.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

std::optional<ManifoldPointer> euclidean(ObjectReader&, const Vocabulary& vocabulary) {
  return std::make_shared<Euclidean>(vocabulary.coordinates.size());
}

std::optional<ManifoldPointer> torus(ObjectReader&, const Vocabulary& vocabulary) {
  return std::make_shared<Torus>(vocabulary.coordinates.size());
}

std::optional<ManifoldPointer> sphere(ObjectReader& object, const Vocabulary& vocabulary) {
  const bool projective = object.word("retraction") == "projective";
  return std::make_shared<Sphere>(vocabulary.coordinates.size() - 1,
                                  projective ? Sphere::projective() : Sphere::exponential());
}

std::optional<ManifoldPointer> hyperbolic(ObjectReader&, const Vocabulary& vocabulary) {
  return std::make_shared<Hyperbolic>(vocabulary.coordinates.size() - 1);
}

// SO(3) or SE(3), whose retractions have the same names.
template <class Group>
std::optional<ManifoldPointer> read_group(ObjectReader& object) {
  const bool cayley = object.word("retraction") == "cayley";
  return std::make_shared<Group>(cayley ? Group::cayley() : Group::exponential());
}

std::optional<ManifoldPointer> rotations(ObjectReader& object, const Vocabulary&) {
  return read_group<SpecialOrthogonal3>(object);
}

std::optional<ManifoldPointer> motions(ObjectReader& object, const Vocabulary&) {
  return read_group<SpecialEuclidean3>(object);
}

std::optional<ManifoldPointer> stiefel(ObjectReader& object, const Vocabulary& vocabulary) {
  const auto& declarations = vocabulary.coordinates.declarations();
  if (declarations.size() == 1 && declarations[0].shape.size() == 2 &&
      declarations[0].shape[0] >= declarations[0].shape[1])
    return std::make_shared<Stiefel>(declarations[0].shape[0], declarations[0].shape[1]);
  object.place().problem(
      "the points of a Stiefel manifold are matrices with at least as many rows as columns; "
      "expected coordinates such as \"X[4][2]\"");
  return std::nullopt;
}

std::optional<ManifoldPointer> all_rotations(ObjectReader& object, const Vocabulary& vocabulary) {
  const auto& declarations = vocabulary.coordinates.declarations();
  if (declarations.size() == 1 && declarations[0].shape.size() == 2 &&
      declarations[0].shape[0] == declarations[0].shape[1])
    return std::make_shared<SpecialOrthogonal>(declarations[0].shape[0]);
  object.place().problem(
      "the points of SO(n) are square matrices; expected coordinates such as \"X[4][4]\"");
  return std::nullopt;
}

std::optional<ManifoldPointer> symmetric_positive_definite(ObjectReader& object,
                                                           const Vocabulary& vocabulary) {
  Index n = 1;
  while (n * (n + 1) / 2 < vocabulary.coordinates.size()) ++n;
  if (n * (n + 1) / 2 == vocabulary.coordinates.size())
    return std::make_shared<SymmetricPositiveDefinite>(n);
  object.place().problem("a lower triangle does not have " +
                         std::to_string(vocabulary.coordinates.size()) +
                         " entries; expected n(n+1)/2 coordinates, such as \"X[6]\"");
  return std::nullopt;
}

// The group of an algebra of matrices, with the retraction that is named.
std::optional<ManifoldPointer> group_by(ObjectReader& object, const MatrixAlgebra& algebra,
                                        const MatrixGroup::Equations& equations = {}) {
  const std::string word = object.word("retraction");
  try {
    return std::make_shared<MatrixGroup>(algebra,
                                         word == "cayley"        ? cayley_map(algebra)
                                         : word == "second-kind" ? second_kind_map(algebra)
                                                                 : exponential_map(algebra),
                                         equations);
  } catch (const std::domain_error& error) {
    object.place().problem(without_place(error.what()));
    return std::nullopt;
  }
}

std::optional<ManifoldPointer> plane_motions(ObjectReader& object, const Vocabulary&) {
  return group_by(object, MatrixAlgebra::se2());
}

std::optional<ManifoldPointer> unit_quaternions(ObjectReader& object, const Vocabulary&) {
  return group_by(object, MatrixAlgebra::su2());
}

std::optional<ManifoldPointer> galilei_group(ObjectReader& object, const Vocabulary&) {
  return group_by(object, MatrixAlgebra::galilei());
}

// A family of algebras by the size of the matrices that the coordinates are, a multiple of `multiple` and at least
// `least`.
std::optional<ManifoldPointer> of_square_matrices(ObjectReader& object,
                                                  const Vocabulary& vocabulary,
                                                  MatrixAlgebra (*make)(Index), Index multiple,
                                                  Index least, const std::string& example) {
  const auto& declarations = vocabulary.coordinates.declarations();
  if (declarations.size() == 1 && declarations[0].shape.size() == 2 &&
      declarations[0].shape[0] == declarations[0].shape[1] && declarations[0].shape[0] >= least &&
      declarations[0].shape[0] % multiple == 0)
    return group_by(object, make(declarations[0].shape[0] / multiple));
  object.place().problem("the points of this group are square matrices" +
                         std::string(multiple == 2 ? " with an even number of rows" : "") +
                         "; expected coordinates such as \"" + example + "\"");
  return std::nullopt;
}

std::optional<ManifoldPointer> special_linear(ObjectReader& object, const Vocabulary& vocabulary) {
  return of_square_matrices(object, vocabulary, MatrixAlgebra::sl, 1, 2, "X[2][2]");
}

std::optional<ManifoldPointer> general_linear(ObjectReader& object, const Vocabulary& vocabulary) {
  return of_square_matrices(object, vocabulary, MatrixAlgebra::gl, 1, 1, "X[2][2]");
}

std::optional<ManifoldPointer> symplectic(ObjectReader& object, const Vocabulary& vocabulary) {
  return of_square_matrices(object, vocabulary, MatrixAlgebra::sp, 2, 2, "X[4][4]");
}

std::optional<ManifoldPointer> heisenberg(ObjectReader& object, const Vocabulary& vocabulary) {
  const Index size = vocabulary.coordinates.size();
  if (size >= 3 && size % 2 == 1)
    return group_by(object, MatrixAlgebra::heisenberg((size - 1) / 2));
  object.place().problem("a point of a Heisenberg group does not have " + std::to_string(size) +
                         " numbers; expected an odd number of coordinates, such as \"x\", \"y\", "
                         "\"z\"");
  return std::nullopt;
}

// Formulas of the coordinates, as equations; a problem where one is wrong.
std::optional<MatrixGroup::Equations> read_equations(const JsonReader& key,
                                                     const Vocabulary& vocabulary) {
  const auto equations = read_formula_vector(key);
  if (!equations) return std::nullopt;
  try {
    Graph graph;
    const SymbolTable symbols =
        vocabulary.symbols({.x = graph.variables("x", vocabulary.coordinates.size())});
    if (!check(*equations, symbols, key.findings())) return std::nullopt;
  } catch (const FormulaError& error) {  // of a definition
    key.problem(std::string("cannot be read: in a definition, ") + error.what());
    return std::nullopt;
  }
  return [equations = *equations, vocabulary](const ExprVector& x) {
    return evaluate(equations, vocabulary.symbols({.x = x}));
  };
}

std::optional<ManifoldPointer> group_of_matrices(ObjectReader& object,
                                                 const Vocabulary& vocabulary) {
  const auto key = object.required("basis");
  const auto equations_key = object.optional("equations");
  const auto basis = key ? read_matrices(*key) : std::nullopt;
  const auto equations = equations_key ? read_equations(*equations_key, vocabulary)
                                       : std::optional(MatrixGroup::Equations());
  if (!basis || !equations) return std::nullopt;
  try {
    const MatrixAlgebra algebra("g", *basis);
    const Index size = algebra.ambient_dimension();
    if (vocabulary.coordinates.size() == size) return group_by(object, algebra, *equations);
    key->problem("has matrices of " + std::to_string(size) + " entries, but the coordinates are " +
                 std::to_string(vocabulary.coordinates.size()) +
                 "; expected one for each entry, row by row");
  } catch (const std::exception& error) {
    key->problem(without_place(error.what()));
  }
  return std::nullopt;
}

// One factor for each declaration of the coordinates.
std::optional<ManifoldPointer> product_of(ObjectReader& object, const Vocabulary& vocabulary) {
  const auto key = object.required("factors");
  const auto elements = key ? key->elements() : std::nullopt;
  if (!elements) return std::nullopt;
  const auto& declarations = vocabulary.coordinates.declarations();
  if (elements->size() != declarations.size()) {
    key->problem("are " + std::to_string(elements->size()) + "; expected one for each of the " +
                 std::to_string(declarations.size()) + " names in \"coordinates\"");
    return std::nullopt;
  }
  std::vector<ManifoldPointer> factors;
  for (std::size_t i = 0; i < elements->size(); ++i) {
    Vocabulary of_factor = vocabulary;
    of_factor.coordinates = NameList();
    of_factor.coordinates.append(declarations[i]);
    const auto factor = manifold_kinds().read((*elements)[i], of_factor);
    if (!factor) continue;
    if ((*factor)->ambient_dimension() == declarations[i].size()) {
      factors.push_back(*factor);
    } else {
      (*elements)[i].problem("is " + (*factor)->name() + " with points of " +
                             std::to_string((*factor)->ambient_dimension()) + " numbers, but \"" +
                             declarations[i].name + "\" has " +
                             std::to_string(declarations[i].size()));
    }
  }
  if (factors.size() != elements->size()) return std::nullopt;
  return std::make_shared<Product>(std::move(factors));
}

// Whether an equation grows with the square of the distance from the zero x, in each of some directions: there its gradient
// vanishes, though at the point that a search found some round-off is left of it.
bool has_a_square(const Manifold& submanifold, const VectorXd& x, std::mt19937& generator) {
  constexpr double nearby = 1e-4, linear_doubles = 2.0, square_quadruples = 4.0;
  std::normal_distribution<double> normal;
  Eigen::Array<bool, Eigen::Dynamic, 1> is_square =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(submanifold.constraint(x).size(), true);
  for (int direction = 0; direction < 3; ++direction) {
    VectorXd along(x.size());
    for (double& entry : along) entry = normal(generator);
    along *= nearby * (1.0 + x.norm()) / along.norm();
    const VectorXd once = submanifold.constraint(VectorXd(x + along)),
                   twice = submanifold.constraint(VectorXd(x + 2.0 * along));
    is_square = is_square && twice.array().abs() >
                                 0.5 * (linear_doubles + square_quadruples) * once.array().abs();
  }
  return is_square.any();
}

// {equations = 0} in the manifold `surrounding`.
std::optional<ManifoldPointer> implicit_submanifold(ObjectReader& object,
                                                    const Vocabulary& vocabulary) {
  const auto surrounding = manifold_kinds().read_key(object, "surrounding", vocabulary);
  const auto key = object.required("equations");
  const auto equations = key ? read_equations(*key, vocabulary) : std::nullopt;
  if (!surrounding || !equations) return std::nullopt;
  const Index size = vocabulary.coordinates.size();
  if ((*surrounding)->ambient_dimension() != size) {
    object.place().problem("is in " + (*surrounding)->name() + " with points of " +
                           std::to_string((*surrounding)->ambient_dimension()) +
                           " numbers, but the coordinates are " + std::to_string(size));
    return std::nullopt;
  }
  const auto count = static_cast<Index>(key->value().size());
  if (count == 0 || count >= (*surrounding)->dimension()) {
    key->problem("are " + std::to_string(count) + "; expected 1 to " +
                 std::to_string((*surrounding)->dimension() - 1) +
                 ", fewer than the dimension of " + (*surrounding)->name());
    return std::nullopt;
  }
  const auto submanifold = std::make_shared<ImplicitSubmanifold>(
      "ImplicitSubmanifold(" + (*surrounding)->name() + ", " + std::to_string(count) + ")",
      *surrounding, *equations, count);
  try {
    std::mt19937 generator(1);
    const VectorXd x = submanifold->random_point(generator);
    if (!submanifold->tangent_basis(x).entries().allFinite()) {
      key->problem(
          "are not independent where they are zero; expected equations with independent "
          "gradients");
      return std::nullopt;
    }
    if (!has_a_square(*submanifold, x, generator)) return submanifold;
    throw std::domain_error("no zero with a gradient");
  } catch (const std::domain_error&) {
    key->problem("have no zero that could be found in " + (*surrounding)->name() +
                 "; expected equations that hold somewhere, with independent gradients there");
  }
  return std::nullopt;
}

// A bundle on a "base".
template <class Bundle>
std::optional<ManifoldPointer> bundle_on(ObjectReader& object, const Vocabulary& vocabulary) {
  const auto base = manifold_kinds().read_key(object, "base", vocabulary);
  if (!base) return std::nullopt;
  return std::make_shared<Bundle>(*base);
}

}  // namespace

Registry<ManifoldPointer, Vocabulary>& manifold_kinds() {
  const auto retraction = [](const char* other) {
    return default_key("retraction", takes::word({"exponential", other}), "exponential",
                       "what leads from a tangent vector to a point");
  };
  const Key of_group =
      default_key("retraction", takes::word({"exponential", "cayley", "second-kind"}),
                  "exponential", "what leads from a tangent vector to a point");
  const Key base = default_key("base", takes::kind("manifold"), "euclidean", "Q");
  static Registry<ManifoldPointer, Vocabulary> kinds({
      {{"euclidean", "Rⁿ, with as many dimensions as there are coordinates"}, euclidean},
      {{"torus", "Tⁿ by n angles"}, torus},
      {{"sphere", "Sⁿ by unit vectors of Rⁿ⁺¹: \"xi[3]\" for S²", {retraction("projective")}},
       sphere},
      {{"hyperbolic", "Hⁿ, the hyperboloid x₀² = 1 + x₁² + … in Rⁿ⁺¹, x₀ > 0: \"x[3]\" for H²"},
       hyperbolic},
      {{"so3",
        "rotations by 3×3 matrices, \"R[3][3]\"; the momentum p_R[3] is that in the body",
        {retraction("cayley")}},
       rotations},
      {{"se3",
        "rigid motions, \"R[3][3]\", \"r[3]\", with momenta p_R[3] (angular) and p_r[3] (linear), "
        "both in the body; or one array of 12 with a momentum of 6",
        {retraction("cayley")}},
       motions},
      {{"so",
        "rotations of Rⁿ by n×n matrices, \"X[n][n]\"; the momentum p_X[n(n-1)/2] is that in the "
        "body"},
       all_rotations},
      {{"se2",
        "motions of the plane, \"R[2][2]\", \"r[2]\", with momenta p_R (angular) and p_r[2] "
        "(linear), both in the "
        "body; or one array of 6 with a momentum of 3",
        {of_group}},
       plane_motions},
      {{"su2",
        "unit quaternions, \"q[4]\", q' = q v/2; the momentum p_q[3] is that in the body",
        {of_group}},
       unit_quaternions},
      {{"heisenberg",
        "\"x[n]\", \"y[n]\", \"z\" of the matrices (1 x z; 0 1 y; 0 0 1), with x' = v_x, y' = v_y, "
        "z' = v_z + x v_y",
        {of_group}},
       heisenberg},
      {{"sl", "n×n matrices of determinant 1, \"X[n][n]\"; p_X[n²-1]", {of_group}}, special_linear},
      {{"gl", "n×n matrices of positive determinant, \"X[n][n]\"; p_X[n][n]", {of_group}},
       general_linear},
      {{"sp", "symplectic 2n×2n matrices, \"X[2*n][2*n]\"; p_X[n(2n+1)]", {of_group}}, symplectic},
      {{"galilei",
        "Galilei's group by 5×5 matrices, \"X[5][5]\"; p_X[10]: rotation, boost, space, time",
        {of_group}},
       galilei_group},
      {{"matrix-group",
        "the group of an algebra of matrices, all entries row by row, \"X[m][m]\"; X' = X (v_0 B_0 "
        "+ v_1 B_1 + …)",
        {required_key("basis", takes::number_matrices(),
                      "B_0, B_1, …: independent, and closed under commutators"),
         optional_key("equations", takes::array_of(takes::formula(), 1),
                      "formulas that are zero on the group, beside those that are found: linear "
                      "ones, invariant forms, "
                      "the determinant"),
         of_group}},
       group_of_matrices},
      {{"stiefel", "orthonormal k-frames of Rⁿ by n×k matrices, \"X[n][k]\""}, stiefel},
      {{"symmetric-positive-definite",
        "such n×n matrices by their lower triangle, row after row: \"X[3]\" for 2×2"},
       symmetric_positive_definite},
      {{"product",
        "the product of its factors",
        {required_key("factors", takes::array_of(takes::kind("manifold")),
                      "one for each name in the coordinates")}},
       product_of},
      {{"implicit-submanifold",
        "where equations hold in a surrounding manifold",
        {default_key("surrounding", takes::kind("manifold"), "euclidean",
                     "the manifold around it, with the same coordinates"),
         required_key("equations", takes::array_of(takes::formula(), 1),
                      "formulas of the coordinates that are zero on it, with independent "
                      "gradients")}},
       implicit_submanifold},
      {{"tangent-bundle", "TQ; the velocity over x is v_x", {base}}, bundle_on<TangentBundle>},
      {{"cotangent-bundle", "T*Q; the momentum of x is p_x", {base}}, bundle_on<CotangentBundle>},
  });
  return kinds;
}

}  // namespace courant
