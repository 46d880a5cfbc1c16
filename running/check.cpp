#include "courant/running/check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>

#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/ladder_laws.hpp"
#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/integrator_laws.hpp"
#include "courant/integrators/methods/state_separation.hpp"
#include "courant/integrators/methods/transformed_integrator.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/measured_invariants.hpp"
#include "courant/running/momentum_drifts.hpp"
#include "courant/running/structure_description.hpp"
#include "courant/running/symmetry_check.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/laws.hpp"

namespace courant {
namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

constexpr double symplectic_bound = 1e-8;
// A momentum that a method keeps changes by less (momentum_drifts).
constexpr double kKept = 1e-11;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// "S1 dim D = n" is law S1, statement dim D = n. Of retractions M1 and M2 are (R1) and (R2) of
// Definition 4.1, and have these names.
std::string law_name(const std::string& name) {
  return name == "M1" ? "R1" : name == "M2" ? "R2" : name;
}

void add_laws(Json& checks, const char* subject, const std::vector<LawResult>& results) {
  for (const LawResult& result : results) {
    const auto space = result.law.find(' ');
    checks.push_back({{"subject", subject},
                      {"name", result.subject},
                      {"law", law_name(result.law.substr(0, space))},
                      {"statement", space == std::string::npos ? "" : result.law.substr(space + 1)},
                      {"passed", result.passed()},
                      {"defect", number(result.defect)},
                      {"bound", result.bound},
                      {"where", result.where}});
  }
}

// Laws are measured with dense matrices.
constexpr Index kMostMeasured = 2000;

const Experiment& of_moderate_size(const Experiment& experiment) {
  const Index size = experiment.model.system->manifold()->dimension();
  if (size > kMostMeasured)
    throw ExperimentError("/system",
                          "has " + std::to_string(size) + " coordinates; expected at most " +
                              std::to_string(kMostMeasured) + " where laws are measured");
  return experiment;
}

class Check {
 public:
  explicit Check(const Experiment& experiment)
      : experiment_(of_moderate_size(experiment)),
        system_(*experiment.model.system),
        manifold_(*system_.manifold()),
        ladder_(consistent_start(experiment)),
        symmetries_(check_symmetries(experiment, ladder_)),
        points_(points()) {}

  Json operator()() {
    Json checks = Json::array(), structures = Json::array();
    add_laws(checks, "manifold", check_manifold(manifold_));
    for (const auto& [name, structure] : this->structures()) {
      add_laws(checks, "structure", check_structure(*structure, points_));
      add_laws(checks, "structure", proposition_7_1(*structure, points_));
      structures.push_back(
          structure_description(name, *structure, points_, system_.names().coordinates));
    }
    add_laws(checks, "family", family_laws());
    for (const SymmetryFinding& finding : symmetries_)
      add_laws(checks, "symmetry", finding.report.laws);
    add_laws(checks, "ladder", check_ladder(ladder_, manifold_.dimension()));
    const Json method = check_method(checks);
    const bool passed = std::ranges::all_of(
        checks, [](const Json& check) { return check.at("passed").get<bool>(); });
    return {{"passed", passed},
            {"title", experiment_.title},
            {"system", experiment_.model.description},
            {"manifold", manifold_.name()},
            {"checks", checks},
            {"structure", structures.empty() ? Json() : structures.front()},
            {"structures", structures},
            {"method", method},
            {"symmetries", symmetries()},
            {"invariants", invariants()}};
  }

 private:
  std::vector<std::pair<std::string, StructurePointer>> structures() const {
    if (!experiment_.model.structures.empty()) return experiment_.model.structures;
    if (const auto structure = system_.structure()) return {{"", structure}};
    return {};
  }

  // The consistent initial point, and some at a tenth of its size around it.
  std::vector<VectorXd> points() const {
    std::mt19937 generator(1);
    VectorXd x = ladder_.point.x;
    if (x.size() != manifold_.ambient_dimension() || !x.allFinite())
      x = manifold_.random_point(generator);
    std::vector<VectorXd> result{x};
    const double size = x.size() > 0 && x.norm() > 0.0 ? x.norm() : 1.0;
    const double length = std::min(0.1 * size, 0.5 * manifold_.injectivity_radius(x));
    for (int i = 0; i < 4; ++i)
      result.push_back(manifold_.retract(x, manifold_.random_tangent(x, length, generator)));
    return result;
  }

  // Of the submanifold 𝓛, at the consistent initial point.
  std::vector<LawResult> family_laws() const {
    const auto* system = dynamic_cast<const DiracSystem*>(&system_);
    const State& point = ladder_.point;
    if (!system || ladder_.verdict == Verdict::inconsistent || !point.z.allFinite()) return {};
    const FamilyPoint at{point.x, point.z.head(system->family()->parameter_size()), point.t};
    return check_generating_family(*system->family(), std::span(&at, 1));
  }

  Json check_method(Json& checks) {
    if (!experiment_.method || ladder_.verdict == Verdict::inconsistent) return Json();
    std::optional<PreparedMethod> method;
    try {
      method = experiment_.method->prepare({.system = experiment_.model.system,
                                            .ladder = ladder_,
                                            .initial = ladder_.point,
                                            .step = experiment_.time->step,
                                            .backend = Backend::interpreter,
                                            .vocabulary = &experiment_.model.vocabulary});
    } catch (const ExperimentError&) {  // has its own place
      throw;
    } catch (const std::invalid_argument& error) {
      throw ExperimentError("/method", without_place(error.what()));
    }
    if (method->map) {
      const auto* lift = dynamic_cast<const CotangentLift*>(method->map.get());
      add_laws(checks, "discretization map",
               lift ? check_cotangent_lift(*lift) : check_discretization_map(*method->map));
    }
    const auto& transformed = method->transformed;
    const Integrator& integrator = transformed ? *transformed->wrapped() : *method->integrator;
    const auto structure = experiment_.model.structure();
    const IntegratorSetting setting =
        transformed ? extended_setting(*transformed->transformation(), method->initial)
                    : IntegratorSetting{
                          .system = experiment_.model.system,
                          .initial = method->initial,
                          .step = experiment_.time->step,
                          .conormals = ladder_.conormals(),
                          .is_gauge = ladder_.gauge_dimension > 0,
                          .structure = structure && structure->is_dirac() ? structure : nullptr};
    const IntegratorReport report = check_integrator(integrator, setting);
    states_ = report.states;
    if (transformed)
      for (VectorXd& x : states_) x = VectorXd(x(transformed->transformation()->places().point));
    if (!symmetries_.empty())
      momentum_drifts_ = momentum_drifts(experiment_, *method->integrator, method->initial);
    add_laws(checks, "method", report.laws);
    if (!transformed)
      if (const auto law = convergence(integrator, method->initial))
        add_laws(checks, "method", {*law});
    const auto json_of = [](const std::optional<double>& value) {
      return value ? number(*value) : Json();
    };
    return {{"name", integrator.name()},
            {"order", integrator.order()},
            {"measured_order", json_of(report.order)},
            {"symmetric", integrator.is_symmetric()},
            {"symmetry_defect", json_of(report.asymmetry)},
            {"exact_energy", integrator.has_exact_energy()},
            {"imbalance", json_of(report.imbalance)},
            {"symplectic", is_symplectic(integrator, setting, report)},
            {"symplecticity_defect", json_of(report.symplecticity)},
            {"structure_defect", json_of(report.preservation)}};
  }

  // P12: over several steps the method converges to the solution of the equations, which an explicit method of order 8
  // makes of the field that the ladder leaves. A method that converges to something else, as for an index that it does not
  // bear, has any order by P1. Nothing where the field is not one of the state, or that solution has fewer digits.
  std::optional<LawResult> convergence(const Integrator& integrator, const State& initial) const {
    constexpr int steps = 8, finest = 64;
    constexpr double least_order = 0.5, round_off = 1e-9, known = 0.1;
    constexpr Index most_coordinates = 200;
    if (ladder_.verdict != Verdict::regular || manifold_.dimension() > most_coordinates)
      return std::nullopt;
    const double time = steps * experiment_.time->step;
    const StateSeparation separation(manifold_, integrator.units(), initial.x);
    std::vector<double> sizes, errors;
    double unknown = 0.0;
    try {
      const ExplicitRungeKutta way(
          std::make_shared<VectorField>(experiment_.model.system, ladder_, Backend::interpreter),
          ExplicitRungeKutta::Kind::fehlberg);
      const State end = way.advance(initial, time / finest, finest);
      unknown = separation(end, way.advance(initial, 2.0 * time / finest, finest / 2));
      for (int count = steps; count <= finest; count *= 2) {
        sizes.push_back(1.0 / count);
        errors.push_back(separation(integrator.advance(initial, time / count, count), end));
      }
    } catch (const std::exception&) {  // steps that cannot be made say nothing
      return std::nullopt;
    }
    if (!(unknown <= known * std::ranges::min(errors))) return std::nullopt;
    LawResult law{
        .subject = integrator.name(),
        .law = "P12 steps converge to the solution of the equations (shortfall of order 1/2)",
        .defect = 0.0,
        .bound = 0.0,
        .where = ""};
    law.where = "t from " + number_text(initial.t) + " on, for " + number_text(time, 3) +
                ": errors from " + number_text(errors.front(), 3) + " to " +
                number_text(errors.back(), 3);
    if (std::ranges::max(errors) > round_off)
      law.defect = std::max(0.0, least_order - log_log_slope(sizes, errors, 0.0));
    return law;
  }

  // In transformed time steps keep the laws of methods on the extended manifold.
  IntegratorSetting extended_setting(const TimeTransformation& time, const State& initial) const {
    const ConstraintLadder ladder = extended_ladder(time, initial);
    return {.system = time.extended(),
            .initial = time.to_extended(initial),
            .step = experiment_.time->step,
            .conormals = ladder.conormals(),
            .is_gauge = ladder.gauge_dimension > 0,
            .structure = time.extended()->structure()};
  }

  Json symmetries() const {
    Json json = Json::array();
    for (std::size_t i = 0; i < symmetries_.size(); ++i) {
      Json entry{{"name", symmetries_[i].name},
                 {"conserved", symmetries_[i].report.is_conserved()},
                 {"remark", symmetries_[i].why_not_conserved()},
                 {"kept", Json()},
                 {"drift", Json()}};
      if (momentum_drifts_) {
        const double drift = (*momentum_drifts_)[static_cast<Index>(i)];
        entry["drift"] = number(drift);
        entry["kept"] = drift <= kKept;
      }
      json.push_back(std::move(entry));
    }
    return json;
  }

  // Whether steps are symplectic, as claimed or as measured; null where there is no form.
  static Json is_symplectic(const Integrator& integrator, const IntegratorSetting& setting,
                            const IntegratorReport& report) {
    if (!report.symplecticity) return Json();
    if (*report.symplecticity > symplectic_bound) return false;
    if (integrator.is_symplectic()) return *integrator.is_symplectic();
    // A small step of a method of high order can look symplectic: a longer one tells.
    IntegratorSetting longer = setting;
    longer.step *= 8.0;
    const auto defect = check_integrator(integrator, longer).symplecticity;
    return defect ? Json(*defect <= symplectic_bound) : Json();
  }

  Json invariants() const {
    Json json = Json::array();
    for (const MeasuredInvariant& of : measured_invariants(experiment_, ladder_, states_))
      json.push_back({{"name", of.name},
                      {"rate", number(of.rate)},
                      {"scale", number(of.scale)},
                      {"invariant", of.is_invariant}});
    return json;
  }

  const Experiment& experiment_;
  const ImplicitSystem& system_;
  const Manifold& manifold_;
  ConstraintLadder ladder_;
  std::vector<SymmetryFinding> symmetries_;
  std::vector<VectorXd> points_;
  std::vector<VectorXd> states_ = {};
  std::optional<VectorXd> momentum_drifts_ = {};  // no value without steps
};

}  // namespace

Json check_experiment(const Experiment& experiment) { return Check(experiment)(); }

}  // namespace courant
