#include "courant/running/check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "courant/core/derivative.hpp"
#include "courant/core/message.hpp"
#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/vector_field.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_interconnection.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/integrability.hpp"
#include "courant/structures/laws.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/rank_profile.hpp"

namespace courant {
namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

constexpr double symplectic_bound = 1e-8;

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

class Check {
 public:
  explicit Check(const Experiment& experiment)
      : experiment_(experiment),
        system_(*experiment.model.system),
        manifold_(*system_.manifold()),
        ladder_(consistent_start(experiment)),
        points_(points()) {}

  Json operator()() {
    Json checks = Json::array(), structures = Json::array();
    add_laws(checks, "manifold", check_manifold(manifold_));
    for (const auto& [name, structure] : this->structures()) {
      add_laws(checks, "structure", check_structure(*structure, points_));
      add_laws(checks, "structure", proposition_7_1(*structure));
      structures.push_back(describe(name, *structure));
    }
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
            {"invariants", invariants()}};
  }

 private:
  std::vector<std::pair<std::string, StructurePointer>> structures() const {
    if (!experiment_.model.structures.empty()) return experiment_.model.structures;
    if (const auto* system = dynamic_cast<const DiracSystem*>(&system_))
      return {{"", system->structure()}};
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
                                            .backend = Backend::interpreter});
    } catch (const std::invalid_argument& error) {
      throw ExperimentError("/method", without_place(error.what()));
    }
    if (method->map) {
      const auto* lift = dynamic_cast<const CotangentLift*>(method->map.get());
      add_laws(checks, "discretization map",
               lift ? check_cotangent_lift(*lift) : check_discretization_map(*method->map));
    }
    const Integrator& integrator = *method->integrator;
    initial_ = method->initial;
    step_ = experiment_.time->step;
    const auto attempt = [](const auto& measure) -> std::optional<decltype(measure())> {
      try {
        return measure();
      } catch (const std::exception&) {
        return std::nullopt;
      }
    };
    const auto json_of = [](const std::optional<double>& value) {
      return value ? number(*value) : Json();
    };
    attempt([&] { return gather_states(integrator); });
    const auto asymmetry = attempt([&] { return symmetry_defect(integrator); });
    const auto order = attempt([&] { return measured_order(integrator); });
    if (asymmetry && integrator.is_symmetric())
      add_laws(checks, "method",
               {{integrator.name(), "P1 Φ_{-h} ∘ Φ_h = id", *asymmetry, 1e-9, where()}});
    const auto step = attempt([&] { return differential(integrator, step_); });
    const auto preserved = attempt([&] { return structure_defect(step.value()); });
    std::optional<double> bent;
    std::optional<bool> symplectic;
    if (const StructurePointer form = symplectic_structure()) {
      bent = attempt([&] { return symplecticity_defect(form, step.value()); });
      // A small step of a method of high order can look symplectic: a longer one tells.
      if (bent && *bent > symplectic_bound)
        symplectic = false;
      else if (bent && integrator.is_symplectic())
        symplectic = *integrator.is_symplectic();
      else if (bent)
        if (const auto longer = attempt(
                [&] { return symplecticity_defect(form, differential(integrator, 8.0 * step_)); }))
          symplectic = *longer <= symplectic_bound;
      if (bent && integrator.is_symplectic().value_or(false))
        add_laws(checks, "method",
                 {{integrator.name(), "P2 Φ_h*ω = ω", *bent, symplectic_bound, where()}});
    }
    return {{"name", integrator.name()},
            {"order", integrator.order()},
            {"measured_order", json_of(order)},
            {"symmetric", integrator.is_symmetric()},
            {"symmetry_defect", json_of(asymmetry)},
            {"symplectic", symplectic ? Json(*symplectic) : Json()},
            {"symplecticity_defect", json_of(bent)},
            {"structure_defect", json_of(preserved)}};
  }

  std::string where() const { return courant::describe("x", initial_.x); }

  VectorXd stepped(const Integrator& integrator, const VectorXd& x, double h, int steps) const {
    State start = initial_;
    start.x = x;
    const auto stepper = integrator.start(start, h);
    for (int i = 0; i < steps; ++i) stepper->step();
    return stepper->state().x;
  }

  // Points on trajectories, where invariants are looked at.
  double gather_states(const Integrator& integrator) {
    const auto stepper = integrator.start(initial_, step_);
    for (int i = 0; i < 4; ++i) {
      stepper->step();
      states_.push_back(stepper->state().x);
    }
    return 0.0;
  }

  double scale() const { return std::max(initial_.x.norm(), 1e-300); }

  double symmetry_defect(const Integrator& integrator) const {
    const auto there = integrator.start(initial_, step_);
    there->step();
    State state = there->state();
    const auto back = integrator.start(state, -step_);
    back->step();
    return manifold_.separation(back->state().x, initial_.x) / scale();
  }

  // Slope of |x(h; 2^k steps) - x(h; 2^{k+1} steps)|: nothing where the steps are exact.
  double measured_order(const Integrator& integrator) const {
    std::vector<double> steps, errors;
    VectorXd coarse = stepped(integrator, initial_.x, step_ / 2.0, 2);
    for (int count = 4; count <= 64; count *= 2) {
      const VectorXd fine = stepped(integrator, initial_.x, step_ / count, count);
      steps.push_back(1.0 / count);
      errors.push_back((fine - coarse).norm() / scale());
      coarse = fine;
    }
    return log_log_slope(steps, errors, 1e-13);
  }

  // The structure, where it is the graph of a symplectic form at the initial point.
  StructurePointer symplectic_structure() const {
    const auto all = structures();
    const Index n = manifold_.dimension();
    if (all.empty() || n == 0) return nullptr;
    const PairedSubspace D = all.front().second->fibre(initial_.x);
    if (!D.is_dirac()) return nullptr;
    const bool symplectic = D.vector_range().cols() == n && D.covector_range().cols() == n;
    return symplectic ? all.front().second : nullptr;
  }

  // ω_D at x as a matrix in the basis of T_xM.
  static MatrixXd form_at(const DiracStructure& structure, const VectorXd& x) {
    const auto [F, omega] = structure.linear(x).form();
    return F * omega * F.transpose();
  }

  // One step from the initial point, y = Φ_h(x), with TΦ_h on T M_f: the columns of `image` are the
  // images of those of `tangent`, in the bases of T_xM and T_yM.
  struct Differential {
    VectorXd y;
    MatrixXd tangent, image;
  };
  Differential differential(const Integrator& integrator, double h) const {
    const VectorXd& x = initial_.x;
    const MatrixXd basis = manifold_.tangent_basis(x);
    Differential result;
    result.tangent = kernel(ladder_.conormals() * basis, {.data_error = 1e-9});
    result.y = stepped(integrator, x, h, 1);
    const MatrixXd back =
        manifold_.tangent_basis(result.y).transpose() * manifold_.coframe(result.y);
    const double epsilon = 1e-3 * scale();
    result.image.resize(basis.cols(), result.tangent.cols());
    for (Index k = 0; k < result.tangent.cols(); ++k) {
      const VectorXd direction = basis * result.tangent.col(k);
      const auto at = [&](double s) {
        return stepped(integrator, manifold_.retract(x, (s * epsilon * direction).eval()), h, 1);
      };
      const VectorXd velocity =
          (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * epsilon);
      result.image.col(k) = back * velocity;
    }
    return result;
  }

  // |Φ_h*ω - ω| next to |ω|, on T M_f at the initial point.
  double symplecticity_defect(const StructurePointer& structure, const Differential& step) const {
    const auto& [y, tangent, image] = step;
    const MatrixXd before = tangent.transpose() * form_at(*structure, initial_.x) * tangent;
    const MatrixXd after = image.transpose() * form_at(*structure, y) * image;
    if (before.size() == 0 || before.norm() == 0.0)
      throw std::domain_error("the form vanishes on the constraint set");
    return (after - before).norm() / before.norm();
  }

  // The distance of (Φ_h)_! D_x, the forward image, from D_y: 0 where the step preserves D. Only
  // where there are no constraints.
  double structure_defect(const Differential& step) const {
    const auto all = structures();
    if (all.empty() || ladder_.degrees_of_freedom != manifold_.dimension())
      throw std::domain_error("no structure, or constraints");
    const auto& [y, tangent, image] = step;
    const DiracStructure& D = *all.front().second;
    return distance(forward_image(image * tangent.transpose(), D.linear(initial_.x)), D.linear(y));
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
    const SymbolTable symbols = experiment_.model.symbols(x, v, z, t);
    for (const Observable& observable : experiment_.observe)
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
  std::vector<VectorXd> points_;
  std::vector<VectorXd> states_ = {};
  State initial_ = {};
  double step_ = 0.0;
};

}  // namespace

Json check_experiment(const Experiment& experiment) { return Check(experiment)(); }

}  // namespace courant
