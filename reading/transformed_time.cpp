#include "courant/reading/transformed_time.hpp"

#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/integrators/maps/product_map.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/transformed_integrator.hpp"
#include "courant/integrators/step/fixed_time_projector.hpp"
#include "courant/integrators/step/natural_units.hpp"
#include "courant/integrators/step/parameter_projector.hpp"

namespace courant {
namespace {

// So large a size that a correction of a discrete gradient leaves time as it is.
constexpr double kNoSize = 1e150;

// On a product with a second factor Rᵖ, whose stage is where that of the map is.
std::shared_ptr<const DiscretizationMap> beside_theta(std::shared_ptr<const DiscretizationMap> map,
                                                      std::shared_ptr<const Product> product) {
  const double theta = map->stage_time();
  auto flat = std::make_shared<Theta>(product->factors().back(), theta);
  return std::make_shared<ProductMap>(
      std::move(product),
      std::vector<std::shared_ptr<const DiscretizationMap>>{std::move(map), std::move(flat)});
}

std::shared_ptr<const TimeTransformation> transformation(const MethodChoice& choice,
                                                         const WrittenFormula& formula,
                                                         const MethodSetting& at) {
  const TimeRate rate = [formula, vocabulary = *at.vocabulary](const ExprVector& x, const Expr& t) {
    return evaluate(formula, vocabulary.symbols({.x = x, .t = t}));
  };
  const bool is_symplectic =
      choice.keeps_form && choice.keeps_form(at) && TimeTransformation::is_possible(*at.system);
  return std::make_shared<TimeTransformation>(is_symplectic
                                                  ? TimeTransformation::symplectic(at.system, rate)
                                                  : TimeTransformation::plain(at.system, rate));
}

PreparedMethod prepare(const MethodChoice& choice, const WrittenFormula& formula,
                       const MethodSetting& own) {
  const auto time = transformation(choice, formula, own);
  const double rate = time->rate(own.initial);
  if (!(rate > 0.0 && std::isfinite(rate)))
    throw ExperimentError(formula.pointer, "is " + number_text(rate) +
                                               " at the initial point; expected a positive number");
  const ConstraintLadder ladder = extended_ladder(*time, own.initial);
  if (ladder.verdict != own.ladder.verdict)
    throw std::runtime_error("In transformed time the constraint algorithm finds the system " +
                             to_string(ladder.verdict) + ", in its own time " +
                             to_string(own.ladder.verdict) + ".");
  PreparedMethod method = choice.prepare({.system = time->extended(),
                                          .ladder = ladder,
                                          .initial = time->to_extended(own.initial),
                                          .step = own.step,
                                          .backend = own.backend,
                                          .vocabulary = own.vocabulary,
                                          .own = &own,
                                          .transformation = time});
  method.integrator = method.transformed =
      std::make_shared<TransformedIntegrator>(time, method.integrator);
  method.initial = time->from_extended(method.initial);
  return method;
}

}  // namespace

MethodChoice in_transformed_time(MethodChoice choice, WrittenFormula rate) {
  const std::string description = choice.description + ", dt/dtau = " + rate.text;
  return {.description = description,
          .prepare = [choice = std::move(choice), rate = std::move(rate)](const MethodSetting& at) {
            return prepare(choice, rate, at);
          }};
}

std::shared_ptr<const DiscretizationMap> map_at(const DiscretizationChoice& choice,
                                                const MethodSetting& at) {
  const auto& manifold = at.system->manifold();
  if (at.extension) return beside_parameters(choice.make(at.plain->system->manifold()), at);
  if (!at.transformation || at.transformation->is_symplectic()) return choice.make(manifold);
  const auto product = std::dynamic_pointer_cast<const Product>(manifold);
  return beside_theta(choice.make(product->factors().front()), product);
}

std::shared_ptr<const DiscretizationMap> beside_parameters(
    std::shared_ptr<const DiscretizationMap> map, const MethodSetting& at) {
  return beside_theta(std::move(map),
                      std::dynamic_pointer_cast<const Product>(at.system->manifold()));
}

ProjectorChoice::Made projector_at(const ProjectorChoice& choice, const MethodSetting& at) {
  if (at.extension) {
    const ProjectorChoice::Made plain = choice.make(*at.plain);
    return {std::make_shared<ParameterProjector>(plain.projector, *at.extension), plain.metric};
  }
  if (!at.own) return choice.make(at);
  // There is nothing to project where the transformation is symplectic.
  if (at.transformation->is_symplectic()) return {std::make_shared<OrthogonalProjector>()};
  const ProjectorChoice::Made own = choice.make(*at.own);
  return {std::make_shared<FixedTimeProjector>(own.projector, at.own->system->manifold()),
          own.metric};
}

VectorXd units_at(const MethodSetting& at) {
  if (at.extension) {
    VectorXd all = VectorXd::Ones(at.system->manifold()->tangent_dimension());
    const VectorXd own = units_at(*at.plain);
    all.head(own.size()) = own;
    return all;
  }
  if (!at.own)
    return at.nominal
               ? units_by_sizes(at.system, at.ladder.point, at.nominal->coordinates, {}).tangent
               : VectorXd();
  VectorXd units = VectorXd::Ones(at.own->system->manifold()->tangent_dimension() + 1);
  units.tail(1).setConstant(kNoSize);
  return units;
}

}  // namespace courant
