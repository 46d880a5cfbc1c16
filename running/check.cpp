#include "courant/running/check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>

#include "courant/core/derivative.hpp"
#include "courant/core/message.hpp"
#include "courant/integrators/integrator_laws.hpp"
#include "courant/integrators/ladder/ladder_laws.hpp"
#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/transformed_integrator.hpp"
#include "courant/integrators/vector_field.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/symmetry_check.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/integrability.hpp"
#include "courant/structures/laws.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/rank_profile.hpp"

namespace courant {
namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

constexpr double symplectic_bound = 1e-8;
// A momentum that a method keeps changes in so many steps by what their equations are solved to, 1e-14
// or so of its terms each; one that it does not keep by its truncation error.
constexpr Index kMomentumSteps = 20;
constexpr double kKept = 1e-11;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json rows(const MatrixXd& matrix) {
  Json json = Json::array();
  for (Index i = 0; i < matrix.rows(); ++i) {
    const VectorXd row = matrix.row(i);
    json.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return json;
}

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
      add_laws(checks, "structure", proposition_7_1(*structure));
      structures.push_back(describe(name, *structure));
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

  Json point(const VectorXd& x) const {
    Json json = Json::object();
    const auto& names = system_.names().coordinates;
    for (Index i = 0; i < x.size(); ++i) json[names[static_cast<std::size_t>(i)]] = x[i];
    return json;
  }

  // Of the submanifold 𝓛, at the consistent initial point.
  std::vector<LawResult> family_laws() const {
    const auto* system = dynamic_cast<const DiracSystem*>(&system_);
    const State& point = ladder_.point;
    if (!system || ladder_.verdict == Verdict::inconsistent || !point.z.allFinite()) return {};
    const FamilyPoint at{point.x, point.z.head(system->family()->parameter_size()), point.t};
    return check_generating_family(*system->family(), std::span(&at, 1));
  }

  // Of port-Hamiltonian structures.
  std::vector<LawResult> proposition_7_1(const DiracStructure& structure) const {
    const bool open = dynamic_cast<const OpenPortHamiltonian*>(&structure) != nullptr;
    if (!open && !dynamic_cast<const ClosedPortHamiltonian*>(&structure)) return {};
    LawMeasurement law(structure.name(),
                       open ? "7.1 coisotropic, and Dirac only where B = 0 (1 where not)"
                            : "7.1 Dirac (1 where not)",
                       0.0);
    for (const VectorXd& x : points_)
      law.add(
          [&] {
            const PairedSubspace D = structure.fibre(x);
            const bool no_input = fibre_ranks(structure, x).ports == 0;
            const bool holds = open ? D.is_coisotropic() && D.is_dirac() == no_input : D.is_dirac();
            return holds ? 0.0 : 1.0;
          },
          courant::describe("x", x));
    return {law.result()};
  }

  Json describe(const std::string& name, const DiracStructure& structure) const {
    const VectorXd& x = points_.front();
    const PairedSubspace D = structure.fibre(x);
    const RankProfile ranks = rank_profile(structure, points_);
    const FibreRanks& here = ranks.at.front();
    const bool dirac = D.is_dirac();
    Json json{{"name", structure.name()},
              {"ports", name},
              {"dimension", D.dimension()},
              {"manifold_dimension", manifold_.dimension()},
              {"rank_of_F", here.vector_range},
              {"isotropic", D.is_isotropic()},
              {"isotropy_defect", D.isotropy_defect()},
              {"coisotropic", D.is_coisotropic()},
              {"coisotropy_defect", D.coisotropy_defect()},
              {"dirac", dirac},
              {"claims_dirac", structure.is_dirac()},
              {"kind", Json()},
              {"rank_of_form", Json()},
              {"casimirs", Json()},
              {"pair", Json()},
              {"integrable", Json()},
              {"integrability_defect", Json()},
              {"integrability", ""},
              {"not_integrable_at", Json()},
              {"rank_jumps_at", Json::array()},
              {"gap", ranks.generic.gap}};
    for (const std::size_t i : ranks.jumps) json["rank_jumps_at"].push_back(point(points_[i]));
    if (!dirac) {
      json["integrability"] = "not defined: D is not a Dirac structure";
      return json;
    }
    const LinearDirac linear(D);
    const auto [F, omega] = linear.form();
    json["kind"] = linear.kind();
    json["rank_of_form"] = here.rank_of_form();
    json["casimirs"] = here.casimirs();
    json["pair"] = {{"F", rows(F)}, {"omega", rows(omega)}};
    const IntegrabilitySurvey survey = integrability(structure, points_);
    if (survey.undefined == survey.points) {
      json["integrability"] = "not defined: " + survey.worst.undefined;
      return json;
    }
    json["integrable"] = survey.integrable();
    json["integrability_defect"] = survey.worst.defect;
    json["integrability"] = "Courant's condition at " +
                            std::to_string(survey.points - survey.undefined) + " of " +
                            std::to_string(survey.points) + " points";
    if (!survey.integrable()) json["not_integrable_at"] = point(survey.worst.x);
    return json;
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
    measure_momenta(*method->integrator, method->initial);
    add_laws(checks, "method", report.laws);
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

  // How far the method takes each momentum from its first value in some steps, next to the terms it
  // is the sum of.
  void measure_momenta(const Integrator& integrator, State state) {
    if (symmetries_.empty()) return;
    Graph graph;
    const ExprVector x = graph.variables("x", manifold_.ambient_dimension());
    const auto count = static_cast<Index>(experiment_.symmetries.size());
    ExprVector outputs(2 * count);
    for (Index i = 0; i < count; ++i) {
      const Symmetry& symmetry = experiment_.symmetries[static_cast<std::size_t>(i)].symmetry;
      const CotangentBundle& T = *symmetry.phase_space();
      const ExprVector q = T.position(x), p = T.momentum(x);
      const ExprVector xi = T.base()->coframe(q) * symmetry.field(q);
      outputs[2 * i] = symmetry.momentum(x);
      outputs[2 * i + 1] = 0.0;
      for (Index k = 0; k < p.size(); ++k) outputs[2 * i + 1] += abs(p[k] * xi[k]);
    }
    const Function momenta("momenta", {{"x", x}}, outputs);
    MatrixXd values(2 * count, kMomentumSteps + 1);
    try {
      const auto stepper = integrator.stepper();
      const double start = state.t, h = experiment_.time->step;
      for (Index k = 0; k <= kMomentumSteps; ++k) {
        if (k == 0)
          stepper->prepare(state, h);
        else
          stepper->step(state, h, start + static_cast<double>(k) * h);
        values.col(k) = momenta({state.x});
      }
    } catch (const SolveError&) {  // told by the laws of the method
      return;
    }
    momentum_drifts_ = VectorXd(count);
    for (Index i = 0; i < count; ++i) {
      const double drift = (values.row(2 * i).array() - values(2 * i, 0)).abs().maxCoeff();
      (*momentum_drifts_)[i] = drift == 0.0 ? 0.0 : drift / values.row(2 * i + 1).maxCoeff();
    }
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

  // d/dt of the energy and of the observables of x alone, along S_f, at the points of M_f that the
  // first steps reach.
  Json invariants() const {
    Json json = Json::array();
    if (ladder_.verdict != Verdict::regular) return json;
    Graph graph;
    const ExprVector x = graph.variables("x", manifold_.ambient_dimension());
    const ExprVector v = graph.variables("v", manifold_.tangent_dimension());
    const ExprVector z = graph.variables("z", system_.auxiliary_size());
    const Expr t = graph.variable("t");
    std::vector<std::pair<std::string, Expr>> quantities;
    if (const auto energy = system_.energy(x, z, t)) quantities.emplace_back("H", *energy);
    for (const DeclaredSymmetry& declared : experiment_.symmetries)
      quantities.emplace_back(declared.name, declared.symmetry.momentum(x));
    const SymbolTable symbols = experiment_.model.symbols(x, v, z, t);
    for (const Observable& observable : experiment_.observe)
      if (!observable.uses_energies)
        quantities.emplace_back(observable.name, evaluate(observable.formula, symbols));
    if (quantities.empty()) return json;

    ExprVector outputs(3 * static_cast<Index>(quantities.size()));
    const ExprVector velocity = manifold_.frame(x) * v;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      const Expr& quantity = quantities[i].second;
      const ExprVector slope = gradient(quantity, x);
      Expr rate = 0.0, size = 0.0, other = 0.0;
      for (Index k = 0; k < x.size(); ++k) {
        rate += slope[k] * velocity[k];
        size += abs(slope[k] * velocity[k]);
      }
      for (const Expr& d : gradient(quantity, v)) other += abs(d);
      for (const Expr& d : gradient(quantity, z)) other += abs(d);
      other += abs(gradient(quantity, ExprVector::Constant(1, t))[0]);
      outputs.segment(3 * static_cast<Index>(i), 3) << rate, size, other;
    }
    const Function function(
        "invariants", {{"x", x}, {"v", v}, {"z", z}, {"t", ExprVector::Constant(1, t)}}, outputs);
    const VectorField field(experiment_.model.system, ladder_, Backend::interpreter);
    VectorField::Evaluation evaluation(field);
    VectorXd rate(x.size());
    MatrixXd worst = MatrixXd::Zero(3, static_cast<Index>(quantities.size()));
    std::vector<VectorXd> points{ladder_.point.x};
    points.insert(points.end(), states_.begin(), states_.end());
    for (const VectorXd& at : points) {
      evaluation(at, rate, experiment_.start());
      const VectorXd values = function(
          {at, evaluation.v(), evaluation.z(), VectorXd::Constant(1, experiment_.start())});
      worst = worst.cwiseMax(values.cwiseAbs().reshaped(3, worst.cols()));
    }
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      const auto k = static_cast<Index>(i);
      // What depends on v, z or t changes with them too: nothing is said of it.
      if (!(worst(2, k) == 0.0)) continue;
      json.push_back({{"name", quantities[i].first},
                      {"rate", number(worst(0, k))},
                      {"scale", number(worst(1, k))},
                      {"invariant", worst(0, k) <= 1e-9 * worst(1, k) + 1e-14}});
    }
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
