#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/step/field_projector.hpp"
#include "courant/integrators/step/kinetic_projector.hpp"
#include "courant/reading/method_kinds.hpp"

namespace courant {
namespace {

using ProjectorPointer = std::shared_ptr<const Projector>;

// Names of coordinates, each with what stands beside it, and where that stands in the experiment.
struct NamedValue {
  std::string name, pointer;
  double value = 0.0;
};

// What a metric may be given by. Formulas and names are looked at when there is a system.
struct MetricChoice {
  std::optional<WrittenFormulas> formulas = {};
  std::string word = {};  // "kinetic", "euclidean", or nothing where nothing is said
  std::string pointer = {};
};

constexpr const char* kKinetic = "kinetic";
constexpr const char* kEuclidean = "euclidean";
constexpr const char* kGiven = "given";
// The words for a metric.
std::vector<std::string> metric_words() { return {kKinetic, kEuclidean}; }

[[noreturn]] void refuse_kinetic(const MetricChoice& metric, const std::string& why) {
  throw ExperimentError(metric.pointer, "is \"kinetic\", but " + why +
                                            "; expected \"euclidean\" or a matrix of formulas");
}

const Vocabulary& names(const MethodSetting& at) {
  if (!at.vocabulary)
    throw std::invalid_argument("the projector has formulas or names, but the system has no names");
  return *at.vocabulary;
}

// The entries of x that a name stands for.
std::vector<Index> entries(const std::string& name, const std::string& pointer,
                           const MethodSetting& at) {
  try {
    const Reference reference = parse_reference(name);
    if (reference.is_velocity)
      throw ExperimentError(pointer, "\"" + name + "\" is a velocity; expected a coordinate");
    const auto [first, count] = names(at).coordinates.find(reference);
    std::vector<Index> result;
    for (Index i = 0; i < count; ++i) result.push_back(first + i);
    return result;
  } catch (const FormulaError& error) {
    throw ExperimentError(pointer, error.what());
  }
}

// x ↦ rows × columns, of formulas by rows; ExperimentError where they are none of the point.
Projector::MatrixFormula point_matrix(const WrittenFormulas& formulas, Index rows, Index columns,
                                      const MethodSetting& at) {
  const Vocabulary vocabulary = names(at);
  Graph graph;
  Findings findings;
  check(formulas, vocabulary.symbols({.x = graph.variables("x", at.initial.x.size())}), findings);
  findings.require_clean();
  return [formulas, vocabulary, rows, columns](const ExprVector& x) {
    const ExprVector values = evaluate(formulas, vocabulary.symbols({.x = x}));
    return ExprMatrix(values.reshaped<Eigen::RowMajor>(rows, columns));
  };
}

// A matrix of formulas of the point; symmetric and positive definite at the initial point, as seen
// by `seen`.
Projector::MatrixFormula metric_formula(const MetricChoice& metric, Index size,
                                        const MethodSetting& at,
                                        const std::function<MatrixXd(const MatrixXd&)>& seen) {
  const WrittenFormulas& formulas = *metric.formulas;
  if (formulas.shape != Shape{size, size})
    throw ExperimentError(metric.pointer,
                          "is no " + size_text(size, size) + " matrix; expected one");
  auto formula = point_matrix(formulas, size, size, at);
  const MatrixXd G = values(formula(constants(at.initial.x)));
  const bool symmetric = (G - G.transpose()).norm() <= 1e-12 * G.norm();
  const MatrixXd part = seen(G);
  if (!symmetric || !CholeskyDecomposition(part).is_positive_definite() || !G.allFinite())
    throw ExperimentError(metric.pointer,
                          "is not symmetric and positive definite at the initial point; expected a "
                          "metric");
  return formula;
}

std::optional<MetricChoice> read_metric(ObjectReader& object) {
  const auto key = object.optional("metric");
  if (!key) return MetricChoice{};
  if (key->value().is_string()) {
    const auto word = key->word(metric_words());
    if (!word) return std::nullopt;
    return MetricChoice{.word = *word, .pointer = key->pointer()};
  }
  auto formulas = read_formulas(*key);
  if (!formulas) return std::nullopt;
  return MetricChoice{.formulas = std::move(formulas), .pointer = key->pointer()};
}

std::optional<std::vector<NamedValue>> read_weights(ObjectReader& object) {
  const auto key = object.optional("weights");
  std::vector<NamedValue> weights;
  if (!key) return weights;
  const auto given = key->entries();
  if (!given) return std::nullopt;
  for (const auto& [name, value] : *given) {
    const auto weight = value.positive_number();
    if (!weight) return std::nullopt;
    weights.push_back({name, value.pointer(), *weight});
  }
  return weights;
}

// Σ weight · movement² of the coordinates: EᵀwE in the tangent representation.
ProjectorPointer weighted(const std::vector<NamedValue>& weights, const MethodSetting& at) {
  const auto manifold = at.system->manifold();
  VectorXd w = VectorXd::Ones(manifold->ambient_dimension());
  for (const NamedValue& weight : weights)
    for (const Index i : entries(weight.name, weight.pointer, at)) w[i] = weight.value;
  return std::make_shared<OrthogonalProjector>(*manifold, [manifold, w](const ExprVector& x) {
    const ExprMatrix E = manifold->frame(x);
    return ExprMatrix(E.transpose() * constants(w).asDiagonal() * E);
  });
}

std::optional<ProjectorChoice> orthogonal(ObjectReader& object) {
  const auto metric = read_metric(object);
  const auto weights = read_weights(object);
  if (!metric || !weights) return std::nullopt;
  if (!weights->empty() && (metric->formulas || !metric->word.empty())) {
    object.optional("weights")->problem("are given beside a metric; expected one of the two");
    return std::nullopt;
  }
  return ProjectorChoice{
      "orthogonal projector",
      [metric = *metric, weights = *weights](const MethodSetting& at) -> ProjectorChoice::Made {
        const auto manifold = at.system->manifold();
        if (!weights.empty()) return {weighted(weights, at), kGiven};
        if (metric.formulas) {
          const MatrixXd basis = manifold->tangent_basis(at.initial.x);
          return {std::make_shared<OrthogonalProjector>(
                      *manifold, metric_formula(metric, manifold->tangent_dimension(), at,
                                                [&](const MatrixXd& G) -> MatrixXd {
                                                  return basis.transpose() * G * basis;
                                                })),
                  kGiven};
        }
        const bool is_free = at.ladder.degrees_of_freedom == manifold->dimension();
        if (metric.word != kEuclidean && !is_free) {
          if (auto kinetic = KineticProjector::of(at.system, at.ladder)) return {kinetic, kKinetic};
          if (metric.word == kKinetic)
            refuse_kinetic(metric,
                           "the system has no kinetic energy g^ij p_i p_j / 2 on a cotangent "
                           "bundle that measures its constraints");
        }
        return {std::make_shared<OrthogonalProjector>(), kEuclidean};
      }};
}

// The momenta of pairs (position, momentum), as entries of x.
struct WrittenPair {
  std::string position, momentum, pointer;
};

std::optional<std::vector<WrittenPair>> read_pairs(ObjectReader& object) {
  const auto key = object.optional("pairs");
  std::vector<WrittenPair> pairs;
  if (!key) return pairs;
  const auto elements = key->elements();
  if (!elements) return std::nullopt;
  for (const JsonReader& element : *elements) {
    const auto pair = element.elements();
    if (!pair) return std::nullopt;
    if (pair->size() != 2) {
      element.expected("the names of a position and its momentum");
      return std::nullopt;
    }
    const auto position = pair->front().text(), momentum = pair->back().text();
    if (!position || !momentum) return std::nullopt;
    pairs.push_back({*position, *momentum, element.pointer()});
  }
  if (pairs.empty()) {
    key->expected("at least one pair of names");
    return std::nullopt;
  }
  return pairs;
}

std::vector<Index> momenta(const std::vector<WrittenPair>& pairs, const MethodSetting& at) {
  const Manifold& M = *at.system->manifold();
  if (pairs.empty()) {
    const auto* bundle = dynamic_cast<const CotangentBundle*>(&M);
    if (!bundle)
      throw std::invalid_argument(
          "the momentum projector moves momenta, but the system is on " + M.name() +
          ", which has none; expected \"pairs\" that say which coordinates are the momenta, or "
          "\"orthogonal\"");
    return MomentumProjector::momenta_of(*bundle);
  }
  if (M.ambient_dimension() != M.tangent_dimension())
    throw ExperimentError(pairs.front().pointer, "names coordinates of " + M.name() +
                                                     ", whose tangent vectors have other entries; "
                                                     "expected no pairs");
  std::vector<Index> result;
  for (const WrittenPair& pair : pairs) {
    const auto q = entries(pair.position, pair.pointer, at),
               p = entries(pair.momentum, pair.pointer, at);
    if (q.size() != p.size())
      throw ExperimentError(pair.pointer, "pairs " + std::to_string(q.size()) + " numbers with " +
                                              std::to_string(p.size()) +
                                              "; expected as many of both");
    result.insert(result.end(), p.begin(), p.end());
  }
  return result;
}

std::optional<ProjectorChoice> momentum(ObjectReader& object) {
  const auto metric = read_metric(object);
  const auto pairs = read_pairs(object);
  if (!metric || !pairs) return std::nullopt;
  return ProjectorChoice{
      "momentum projector",
      [metric = *metric, pairs = *pairs](const MethodSetting& at) -> ProjectorChoice::Made {
        const auto manifold = at.system->manifold();
        const std::vector<Index> moving = momenta(pairs, at);
        Projector::MatrixFormula formula;
        std::string name = kEuclidean;
        if (metric.formulas) {
          formula = metric_formula(metric, static_cast<Index>(moving.size()), at,
                                   [](const MatrixXd& g) { return g; });
          name = kGiven;
        } else if (metric.word != kEuclidean) {
          if (const auto kinetic = kinetic_metric(at.system, moving, at.initial.x)) {
            formula = kinetic->lower;
            name = kKinetic;
          } else if (metric.word == kKinetic) {
            refuse_kinetic(metric, "the system has no kinetic energy g^ij p_i p_j / 2");
          }
        }
        // What is small next to other momenta is so in the metric.
        VectorXd units;
        if (formula) {
          units = VectorXd::Ones(manifold->tangent_dimension());
          units(moving) = values(formula(constants(at.initial.x))).diagonal().cwiseSqrt();
        }
        const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(manifold);
        if (bundle && pairs.empty())
          return {std::make_shared<MomentumProjector>(bundle, formula, units), name};
        return {std::make_shared<MomentumProjector>(*manifold, moving, formula, units), name};
      }};
}

// Fields as they are written, a row each, for the directions at `at`.
ProjectorPointer along_fields(const WrittenFormulas& fields, const std::string& pointer,
                              const MethodSetting& at) {
  const Manifold& M = *at.system->manifold();
  const Index size = M.tangent_dimension();
  const Index count = M.dimension() - at.ladder.degrees_of_freedom;
  const bool is_one = fields.shape.size() == 1;
  const Shape shape = is_one ? Shape{1, fields.shape[0]} : fields.shape;
  if (shape != Shape{count, size})
    throw ExperimentError(pointer, "is " + size_text(shape[0], shape[1]) + "; expected " +
                                       size_text(count, size) + ", a tangent vector of " +
                                       M.name() + " a row for each constraint of M_f");
  const auto rows = point_matrix(fields, count, size, at);
  const auto columns = [rows](const ExprVector& x) -> ExprMatrix { return rows(x).transpose(); };
  const MatrixXd V = values(columns(constants(at.initial.x)));
  const LinearMap<double> basis = M.tangent_basis(at.initial.x);
  const MatrixXd across = V - basis * (basis.transpose() * V);
  if (!V.allFinite() || across.norm() > 1e-9 * V.norm())
    throw ExperimentError(pointer, "is not tangent to " + M.name() +
                                       " at the initial point, off by " +
                                       number_text(across.norm()) + "; expected tangent vectors");
  return std::make_shared<FieldProjector>(M, count, columns);
}

std::optional<ProjectorChoice> directions(ObjectReader& object) {
  const auto key = object.required("fields");
  const auto fields = key ? read_formulas(*key) : std::nullopt;
  if (!fields) return std::nullopt;
  if (fields->shape.size() != 1 && fields->shape.size() != 2) {
    key->expected("vector fields, one a row");
    return std::nullopt;
  }
  return ProjectorChoice{"projector along given directions",
                         [fields = *fields, pointer = key->pointer()](
                             const MethodSetting& at) -> ProjectorChoice::Made {
                           return {along_fields(fields, pointer, at)};
                         }};
}

}  // namespace

Registry<ProjectorChoice>& projector_kinds() {
  const Takes names = takes::array_of(takes::text(), 2, 2);
  static Registry<ProjectorChoice> kinds({
      {{"orthogonal",
        "to the nearest point of M_f: on T*Q q in the metric g of the kinetic energy, then p in "
        "its "
        "inverse, if there is one and nothing else is said",
        {optional_key("weights", takes::weights(), "of Σ weight · movement², 1 if not named"),
         optional_key("metric", takes::metric(metric_words()), "in which the point is nearest")}},
       orthogonal},
      {{"momentum",
        "q stays, p moves as little as possible, in the metric of the energy if none is given",
        {optional_key("pairs", takes::array_of(names, 1),
                      "positions and their momenta, where M is no cotangent bundle"),
         optional_key("metric", takes::metric(metric_words()), "g_ij of Section 8.2")}},
       momentum},
      {{"directions",
        "along vector fields of one's own, as many as M_f has constraints",
        {required_key("fields", takes::field_rows(),
                      "formulas of the point, a tangent vector a row")}},
       directions},
  });
  return kinds;
}

}  // namespace courant
