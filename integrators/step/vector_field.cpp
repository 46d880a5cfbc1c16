#include "courant/integrators/step/vector_field.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "courant/core/algebra/elimination.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/regular_matrix.hpp"
#include "courant/core/numbers/uncertain.hpp"
#include "courant/core/solve/newton.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {
namespace {

using regular_matrix::kNoise;

// Of the terms of equations, a part that is none.
constexpr double kSolved = 1e-9;

// The Jacobian by the first input, with 0 for what rounding may have left of a zero: numbers are known to their last
// digit. Scales would make a coefficient of its like of any other.
MatrixXd jacobian_above_rounding(const Function& F, const std::vector<VectorXd>& at) {
  std::vector<std::vector<Uncertain>> groups;
  std::vector<const Uncertain*> in;
  for (const VectorXd& numbers : at) {
    groups.emplace_back();
    for (const double number : numbers) groups.back().push_back(Uncertain::rounded(number));
  }
  for (const auto& group : groups) in.push_back(group.data());
  std::vector<Uncertain> all(static_cast<std::size_t>(F.output_size() + F.nonzeros()));
  F.taylor_with_jacobian(in.data(), 0, all.data());
  VectorXd above(std::ssize(all));
  std::ranges::transform(all, above.begin(), [](const Uncertain& a) {
    return a.is_nonzero() || !std::isfinite(a.error) ? a.value : 0.0;
  });
  return F.dense_jacobian(above);
}

// What may be the matter with a point that has no velocity.
std::string whereabouts(const Manifold& M, const VectorXd& x) {
  const double defect = M.point_defect(x);
  if (defect < 1e-3) return "is at or near a singular point";
  return "has left " + M.name() + ", whose equations are violated by " + number_text(defect);
}

}  // namespace

VectorFieldFormulas::VectorFieldFormulas(std::shared_ptr<const ImplicitSystem> of,
                                         const ConstraintLadder& ladder, Freedom freedom)
    : system(std::move(of)) {
  if (!system) throw std::invalid_argument("VectorField::VectorField: system is null.");
  if (ladder.verdict != Verdict::regular &&
      !(freedom == Freedom::gauge && ladder.verdict == Verdict::gauge))
    throw std::invalid_argument(
        "VectorField::VectorField: the ladder's verdict is " + to_string(ladder.verdict) +
        "; expected regular: S_f is not the graph of a vector field. " + ladder.reason);
  check_ladder("VectorField::VectorField", *system, ladder);
  const Manifold& M = *system->manifold();
  const Index n = M.dimension();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  const ExprVector t = graph.variables("t", 1);
  const LocalFormulation local(graph, *system, x, basis, t[0], ladder.differentiations);
  // At ξ = 0 the chart is at x itself.
  const auto at_origin = [&](const ExprVector& y) {
    return substitute(y, local.xi[0], ExprVector::Zero(n));
  };

  std::vector<Expr> unknowns;
  for (std::size_t j = 1; j < local.xi.size(); ++j)
    unknowns.insert(unknowns.end(), local.xi[j].begin(), local.xi[j].end());
  for (const ExprVector& z : local.z) unknowns.insert(unknowns.end(), z.begin(), z.end());
  const ExprVector y = Eigen::Map<ExprVector>(unknowns.data(), static_cast<Index>(unknowns.size()));
  inputs = {{"y", y}, {"x", x}, {"basis", basis_parameters(basis)}, {"t", t}};

  // Values at the ladder's point, by the jet's leading coefficients; the other jets start at zero.
  const LinearMap<double> B = TransportedFrame::at(M, ladder.point.x);
  start = VectorXd::Zero(y.size());
  start.head(n) = B.transpose() * ladder.point.v;
  z_offset = static_cast<Index>(local.xi.size() - 1) * n;
  start.segment(z_offset, system->auxiliary_size()) = ladder.point.z;

  all = at_origin(local.equations);
  const VectorXd entries = B.entries().reshaped();
  VectorXd preference = VectorXd::Ones(all.size());
  // Equations before their derivatives: with the velocity from the derivative of a constraint
  // instead of the equation for it, momenta would be free to leave M_f. And those that give an unknown
  // explicitly before the others: their pivots cannot vanish, as those of two rolling constraints do
  // where the wheels are parallel.
  // All of them stay far above round-off, whatever the index is.
  constexpr double lower = 2.0, lowest = 8.0;  // digits
  const int most =
      ladder.differentiations.empty()
          ? 0
          : *std::max_element(ladder.differentiations.begin(), ladder.differentiations.end());
  const double derived = std::pow(10.0, -std::min(lower, lowest / std::max(most, 1)));
  std::vector<int> order(static_cast<std::size_t>(system->equation_count()), 0);
  std::vector<Index> given;
  for (Index i = 0; i < all.size(); ++i) {
    int& derivatives = order[static_cast<std::size_t>(local.source[static_cast<std::size_t>(i)])];
    preference[i] *= std::pow(derived, derivatives);
    if (derivatives++ == 0) given.push_back(i);
  }
  const Index of_structure = system->tangent_blocks() * M.tangent_dimension();
  std::vector<bool> is_explicit(static_cast<std::size_t>(all.size()), false);
  const Elimination elimination(all(given), y, {});
  for (const Elimination::Pivot& pivot : elimination.pivots)
    is_explicit[static_cast<std::size_t>(given[static_cast<std::size_t>(pivot.equation)])] = true;
  // Of many equations those that give unknowns explicitly are kept, and independent ones are looked
  // for among what is left of the others: the decomposition is dense.
  constexpr Index many = 500;
  // What has coefficients that are the same everywhere comes before what has not: at a start without rotation a ball
  // that rolls seems to tell its angular velocity as well as its momentum does, and no more after a quarter turn.
  std::vector<bool> varies(static_cast<std::size_t>(all.size()), false);
  if (y.size() <= many) {
    const SparseExprMatrix slopes = jacobian(all, y);
    const std::vector<bool> depends_on_x = each_depends(slopes.values, x);
    for (std::size_t k = 0; k < slopes.row.size(); ++k)
      if (depends_on_x[k]) varies[static_cast<std::size_t>(slopes.row[k])] = true;
  }
  for (Index i = of_structure; i < all.size(); ++i) {
    // On curved spaces the coefficients of velocities in a structure are numbers on M alone.
    if (!is_explicit[static_cast<std::size_t>(i)]) preference[i] *= 0.1;
    if (varies[static_cast<std::size_t>(i)]) preference[i] *= 0.1;
  }
  std::vector<Index> kept, candidates;
  for (Index i = 0; i < all.size(); ++i)
    (y.size() > many && is_explicit[static_cast<std::size_t>(i)] ? kept : candidates).push_back(i);
  std::vector<Function::Input> of_left = inputs;
  VectorXd left_start = start;
  ExprVector left = all;
  if (!kept.empty()) {
    of_left[0].variables = y(elimination.kept);
    left_start = start(elimination.kept);
    left = substitute(all(candidates), y, elimination.unknowns);
  }
  const Function full("vector field", of_left, left, {.differentiate = {"y"}});
  // Without units: the entries of a force of 10⁻⁸ N are no round-off next to those of 10⁹ s⁻³.
  const VectorXd t0 = VectorXd::Constant(1, ladder.point.t);
  const MatrixXd J =
      equilibrate(jacobian_above_rounding(full, {left_start, ladder.point.x, entries, t0}), kNoise)
          .scaled;
  VectorXd scale = J.rowwise().norm();
  scale = scale.unaryExpr([](double size) { return size > 0 ? 1.0 / size : 0.0; })
              .cwiseProduct(preference(candidates));
  // The ladder decided this rank with a gap; here it only has to be found again.
  constexpr double data_error = 2e-14;
  const CompleteOrthogonalDecomposition rows((scale.asDiagonal() * J).transpose(), data_error);
  std::vector<Index> others;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    (static_cast<Index>(i) < rows.rank() ? kept : others)
        .push_back(candidates[static_cast<std::size_t>(rows.order()[i])]);
  equations = all(kept);
  std::sort(others.begin(), others.end());
  const std::vector<bool> contains_unknowns = each_depends(all, y);
  std::vector<Expr> not_kept;
  for (const Index row : others)
    if (contains_unknowns[static_cast<std::size_t>(row)]) not_kept.push_back(all[row]);

  left_out = Eigen::Map<const ExprVector>(not_kept.data(), static_cast<Index>(not_kept.size()));

  const ExprVector v = at_origin(local.v);
  rate.resize(x.size() + v.size() + local.z[0].size());
  rate << M.frame(x) * v, v, local.z[0];
  solved = equations;
  if (ladder.gauge_dimension == 0 && y.size() <= many)
    hold_open(
        y, jacobian_above_rounding(full, {start, ladder.point.x, entries, t0})(kept, Eigen::all));
  if (left_out.size() == 0) take_explicit(y);
}

// Where the equations kept are fewer than the unknowns that they contain, they leave some open, as derivatives of
// multipliers: held, these leave a square matrix. `J`: of the equations at the ladder's point.
void VectorFieldFormulas::hold_open(const ExprVector& y, const MatrixXd& J) {
  constexpr double tangents_first = 1e3, well_conditioned = 1e-8;
  const Subgraph contained(equations);
  std::vector<Index> places;
  for (Index i = 0; i < y.size(); ++i)
    if (contained.contains(y[i])) places.push_back(i);
  const auto rank = static_cast<Index>(J.rows());
  if (std::ssize(places) <= rank) return;
  // Unknowns of the system and their derivatives mean the same at every point, coordinates in a basis do not.
  const Manifold& M = *system->manifold();
  const Index tangents = M.dimension() == M.tangent_dimension() ? M.dimension() : z_offset;
  MatrixXd columns = equilibrate(J(Eigen::all, places), kNoise).scaled;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k] < tangents) columns.col(static_cast<Index>(k)) *= tangents_first;
  const QrDecomposition chosen = QrDecomposition::pivoted(columns);
  const VectorXd sizes = chosen.diagonal().cwiseAbs();
  if (!(sizes[rank - 1] > well_conditioned)) return;
  for (Index k = rank; k < std::ssize(places); ++k)
    held.push_back(places[static_cast<std::size_t>(chosen.order()[static_cast<std::size_t>(k)])]);
  std::sort(held.begin(), held.end());
  if (held.front() < tangents) return held.clear();
  solved = substitute(equations, ExprVector(y(held)), constants(VectorXd(start(held))));
}

void VectorFieldFormulas::take_explicit(const ExprVector& y) {
  const Elimination elimination(equations, y, {});
  if (!elimination.kept.empty() || !elimination.remaining.empty()) return;
  held.clear();
  solved = ExprVector(0);
  rate = substitute(rate, y, elimination.unknowns);
  all = substitute(all, y, elimination.unknowns);
  inputs[0].variables = equations = ExprVector(0);
  start = VectorXd(0);
  z_offset = 0;
}

VectorField::VectorField(VectorFieldFormulas formulas, Backend backend)
    : formulas_(std::move(formulas)) {
  const auto& inputs = formulas_.inputs;
  const Backend together = backend.together();
  equations_ = std::make_shared<const EquationSystem>(
      "vector field", inputs, formulas_.solved,
      EquationSystem::Options{.backend = together, .eliminates = false});
  left_out_ = Function("left out", inputs, formulas_.left_out, {.backend = together});
  rate_ = Function("rate", inputs, formulas_.rate, {.backend = together});
  basis_ = TransportedFrame::projection(*formulas_.system->manifold(), together);
  together.compile();
}

const Function& VectorField::all() const {
  std::call_once(all_->once, [&] {
    all_->function =
        Function("vector field", formulas_.inputs, joined(formulas_.equations, formulas_.left_out),
                 {.differentiate = {formulas_.inputs[0].name}});
  });
  return all_->function;
}

// What solves the equations, and the basis of their ξ', ….
struct VectorField::Evaluation::Engine {
  explicit Engine(const VectorField& field)
      // Velocities, accelerations and forces have no unit in common: each is measured by itself.
      : newton(*field.equations_,
               std::vector<Index>(static_cast<std::size_t>(field.formulas_.start.size()), 1), {}),
        basis(*field.formulas_.system->manifold(), field.basis_) {}

  Newton newton;
  TransportedFrame basis;
};

VectorField::Evaluation::Evaluation(const VectorField& field)
    : field_(field),
      engine_(std::make_unique<Engine>(field)),
      y_(field.formulas_.start),
      kept_(y_),
      out_(field.rate_.output_size()),
      v_(VectorXd::Zero(field.formulas_.system->manifold()->tangent_dimension())),
      z_(VectorXd::Zero(field.formulas_.system->auxiliary_size())),
      left_out_(VectorXd::Zero(field.left_out_count())),
      sizes_(VectorXd::Zero(std::max<Index>(1, field.formulas_.start.size()))) {}

VectorField::Evaluation::Evaluation(Evaluation&& other) noexcept = default;
VectorField::Evaluation::~Evaluation() = default;

const LinearMap<double>& VectorField::Evaluation::basis() const { return engine_->basis.map(); }

void VectorField::Evaluation::start(const State& state) {
  sizes_.setZero();
  explained_ = 0.0;
  engine_->basis.move_to(state.x);
  y_ = field_.formulas_.start;
  const Manifold& M = *field_.formulas_.system->manifold();
  if (field_.is_explicit()) return;
  if (state.v.size() == M.tangent_dimension())
    engine_->basis.coordinates_of(state.v, y_.head(M.dimension()));
  if (state.z.size() == z_.size()) y_.segment(field_.formulas_.z_offset, z_.size()) = state.z;
  kept_ = y_;
}

void VectorField::Evaluation::discard() {
  engine_->newton.reset();
  y_ = kept_;
  sizes_.head(y_.size()) = y_.cwiseAbs();
}

void VectorField::Evaluation::forget() {
  sizes_.setZero();
  explained_ = 0.0;
  engine_->newton.reset();
  engine_->basis.forget();
  kept_ = y_ = field_.formulas_.start;
}

void VectorField::Evaluation::operator()(const VectorXd& x, VectorXd& rate, double t) {
  engine_->basis.move_to(x);
  solve(x, rate, t);
}

void VectorField::Evaluation::operator()(const State& state, VectorXd& rate) {
  engine_->newton.reset();
  start(state);
  solve(state.x, rate, state.t);
}

// At rest an unknown that is 0 has no size, and its round-off never becomes small next to itself. The
// equations know one: units in which their derivatives are comparable with 1, times the largest residual or
// unknown in these.
void VectorField::Evaluation::take_nominal_sizes(const Inputs& in) {
  const Function& F = field_.equations_->left();
  VectorXd all(F.output_size() + F.nonzeros());
  F.value_and_jacobian(in.data(), all.data());
  if (!all.allFinite()) return;
  const auto units = equilibrate(F.dense_jacobian(all), kNoise);
  const double size = std::max(largest(units.row_scale.cwiseProduct(all.head(F.output_size()))),
                               largest(y_.cwiseQuotient(units.column_scale)));
  sizes_.head(y_.size()) = size * units.column_scale;
}

// Whether F is what rounding leaves of its terms at y_, whatever the sizes were that a solver was told.
bool VectorField::Evaluation::holds(const Function& F, const Inputs& in, double solved) const {
  VectorXd all(F.output_size() + F.nonzeros()), terms = VectorXd::Zero(F.output_size());
  F.value_and_jacobian(in.data(), all.data());
  for (std::size_t k = 0; k < F.pattern_row().size(); ++k)
    terms[F.pattern_row()[k]] +=
        std::fabs(all[F.output_size() + static_cast<Index>(k)] * y_[F.pattern_col()[k]]);
  return largest(all.head(F.output_size())) <= solved * largest(terms);
}

// By the equations that were chosen at the ladder's point.
bool VectorField::Evaluation::is_solved(const Inputs& in) {
  for (const Index i : field_.formulas_.held) y_[i] = field_.formulas_.start[i];
  const auto converges = [&] {
    return engine_->newton.solve(in, sizes_.data()).status == Newton::Status::converged;
  };
  const auto begin_again = [&] {
    engine_->newton.reset();
    y_ = field_.formulas_.start;
  };
  // What is found by a matrix that sees some directions only has to hold.
  const auto is_found_again = [&] {
    return converges() &&
           (engine_->newton.is_determined() || holds(field_.equations_->left(), in, kSolved));
  };
  if (converges()) return true;
  begin_again();
  sizes_.setConstant(largest(y_));
  if (is_found_again()) return true;
  begin_again();
  take_nominal_sizes(in);
  if (is_found_again()) return true;
  begin_again();
  return engine_->newton.approach(in, sizes_.data()) && is_found_again();
}

// Where those are dependent, all equations tell the velocity, on M_f.
bool VectorField::Evaluation::is_solved_by_all(const Inputs& in, bool is_solved) {
  const VectorFieldFormulas& of = field_.formulas_;
  if (of.left_out.size() == 0 && of.held.empty()) return is_solved;
  const Function& all = field_.all();
  if (is_solved && holds(all, in, kSolved)) return true;
  const VectorXd found = y_;
  y_ = of.start;
  const VectorXd sizes = VectorXd::Constant(sizes_.size(), largest(y_));
  Newton newton(all, std::vector<Index>(static_cast<std::size_t>(y_.size()), 1), {});
  // Off M_f, by however little, least squares are a compromise, and no other velocity.
  constexpr double on_M_f = 1e-12;
  if (newton.solve(in, sizes.data()).status == Newton::Status::converged &&
      holds(all, in, is_solved ? on_M_f : kSolved))
    return true;
  y_ = found;
  return is_solved;
}

void VectorField::Evaluation::solve(const VectorXd& x, VectorXd& rate, double t) {
  const Inputs in(y_.data(), {x.data(), engine_->basis.data(), &t});
  if (field_.is_explicit()) {
    take_rate(in, rate);
    if (!are_finite(out_.data(), out_.size())) refuse(x, t);
    return;
  }
  const auto violation = [&] {
    field_.left_out_.value(in.data(), left_out_.data());
    return largest(left_out_);
  };
  constexpr double growth = 4.0;
  bool is_found = is_solved(in);
  if (!is_found || !engine_->newton.is_determined() || violation() > growth * explained_) {
    is_found = is_solved_by_all(in, is_found);
    explained_ = std::max(explained_, violation());
  }
  if (!is_found || !y_.allFinite()) refuse(x, t);
  sizes_.head(y_.size()) = sizes_.head(y_.size()).cwiseMax(y_.cwiseAbs());
  take_rate(in, rate);
}

void VectorField::Evaluation::take_rate(const Inputs& in, VectorXd& rate) {
  field_.rate_.value(in.data(), out_.data());
  rate = out_.head(out_.size() - v_.size() - z_.size());
  v_ = out_.segment(rate.size(), v_.size());
  z_ = out_.tail(z_.size());
}

void VectorField::Evaluation::refuse(const VectorXd& x, double t) const {
  throw std::domain_error("VectorField::operator(): no velocity found at t = " + number_text(t) +
                          "; the state " + whereabouts(*field_.formulas_.system->manifold(), x) +
                          ".");
}

}  // namespace courant
