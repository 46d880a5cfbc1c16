#include "courant/running/start_stages.hpp"

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {
namespace {

// Entries of (x, v, z) with the values that are given of them.
LeastChange given_entries(const Flags& which, const VectorXd& values, Index offset) {
  LeastChange change;
  std::vector<Index> entries;
  for (Index i = 0; i < which.size(); ++i)
    if (which[i]) entries.push_back(i);
  for (const Index i : entries) change.rows.push_back(offset + i);
  change.given = values(entries);
  return change;
}

// The Cholesky factor of the part of a metric that belongs to these entries; that of 1 where it has none.
MatrixXd root_of_metric(const MatrixXd& metric, const std::vector<Index>& entries) {
  const auto count = std::ssize(entries);
  if (metric.size() > 0) {
    const CholeskyDecomposition factors(MatrixXd(metric(entries, entries)));
    if (factors.is_positive_definite()) return factors.L().transpose();
  }
  return MatrixXd::Identity(count, count);
}

// Of T*Q; null for other spaces.
std::shared_ptr<const CotangentBundle> bundle_of(const ImplicitSystem& system) {
  return std::dynamic_pointer_cast<const CotangentBundle>(system.manifold());
}

// Velocities and momenta.
class MotionStage {
 public:
  MotionStage(const Experiment& experiment, const InitialGuess& guess, Index positions)
      : system_(experiment.model.system), positions_(positions) {
    const Manifold& M = *system_->manifold();
    const InitialValues& initial = experiment.initial;
    const Index N = M.ambient_dimension();
    Flags momenta = initial.x.given;
    momenta.head(positions) = false;
    momenta_ = given_entries(momenta, guess.x, 0);
    if (guess.v.size() > 0) velocities_ = given_entries(given_components(initial, M), guess.v, N);
    weights_ = initial.cost_of_coordinates()(momenta_.rows);
  }

  bool is_empty() const { return momenta_.rows.empty() && velocities_.rows.empty(); }

  LeastChange operator()(const State& found) const {
    const Index N = system_->manifold()->ambient_dimension();
    const MatrixXd g = metric(found.x);
    std::vector<Index> momenta, velocities;
    for (const Index row : momenta_.rows) momenta.push_back(row - positions_);
    // A velocity of T*Q is one of Q and a force.
    for (const Index row : velocities_.rows) velocities.push_back(row - N);
    const bool is_weighted = weights_.size() > 0 && (weights_.array() != 1.0).any();
    const MatrixXd of_momenta =
        is_weighted
            ? MatrixXd(weights_.cwiseSqrt().asDiagonal())
            : root_of_metric(g.size() == 0 ? MatrixXd() : LuDecomposition(g).inverse(), momenta);
    MatrixXd whole = MatrixXd::Identity(system_->manifold()->tangent_dimension(),
                                        system_->manifold()->tangent_dimension());
    if (g.size() > 0) whole.topLeftCorner(g.rows(), g.cols()) = g;
    const MatrixXd of_velocities = root_of_metric(whole, velocities);

    LeastChange change;
    change.rows = velocities_.rows;
    change.rows.insert(change.rows.end(), momenta_.rows.begin(), momenta_.rows.end());
    change.given.resize(std::ssize(change.rows));
    change.given << velocities_.given, momenta_.given;
    MatrixXd root = MatrixXd::Zero(change.given.size(), change.given.size());
    root.topLeftCorner(of_velocities.rows(), of_velocities.cols()) = of_velocities;
    root.bottomRightCorner(of_momenta.rows(), of_momenta.cols()) = of_momenta;
    change.root = root.sparseView();
    return change;
  }

 private:
  // The components of v = C ẋ of which something is given.
  static Flags given_components(const InitialValues& initial, const Manifold& M) {
    const Flags& given = initial.velocity.given;
    if (M.has_identity_frame()) return given;
    const Flags are_velocities = M.velocities_among_components(initial.x.values);
    const MatrixXd C = M.coframe(initial.x.values).entries().cwiseAbs();
    const VectorXd of_given = C * given.cast<double>().matrix();
    return Flags::NullaryExpr(
        of_given.size(), [&](Index i) { return are_velocities[i] ? given[i] : of_given[i] > 0.0; });
  }

  // g at the positions; empty where there is none.
  MatrixXd metric(const VectorXd& x) const {
    const auto bundle = bundle_of(*system_);
    constexpr Index most = 200;
    if (!bundle || bundle->base()->tangent_dimension() > most) return {};
    const auto kinetic = kinetic_metric(system_, MomentumProjector::momenta_of(*bundle), x);
    if (!kinetic) return {};
    const MatrixXd g = values(kinetic->lower(constants(x)));
    return g.allFinite() && CholeskyDecomposition(g).is_positive_definite() ? g : MatrixXd();
  }

  std::shared_ptr<const ImplicitSystem> system_;
  Index positions_;
  LeastChange momenta_, velocities_;  // without roots
  VectorXd weights_;                  // of the momenta
};

}  // namespace

std::vector<NearestStart::Stage> start_stages(const Experiment& experiment,
                                              const InitialGuess& guess) {
  const ImplicitSystem& system = *experiment.model.system;
  const InitialValues& initial = experiment.initial;
  const Manifold& M = *system.manifold();
  const auto bundle = bundle_of(system);
  const Index N = M.ambient_dimension();
  const Index positions = bundle ? bundle->base()->ambient_dimension() : N;

  Flags where = initial.x.given;
  where.tail(N - positions) = false;
  std::vector<NearestStart::Stage> stages;
  const auto add = [&](LeastChange change, const VectorXd& weights) {
    if (change.rows.empty()) return;
    change.root = SparseMatrixXd(weights.cwiseSqrt().asDiagonal());
    stages.emplace_back([change](const State&) { return change; });
  };
  LeastChange point = given_entries(where, guess.x, 0);
  const VectorXd weights = initial.cost_of_coordinates()(point.rows);
  add(std::move(point), weights);
  if (MotionStage motion(experiment, guess, positions); !motion.is_empty())
    stages.emplace_back(std::move(motion));
  LeastChange unknowns =
      given_entries(initial.z.given, initial.z.values, N + M.tangent_dimension());
  std::vector<Index> which = unknowns.rows;
  for (Index& row : which) row -= N + M.tangent_dimension();
  const VectorXd of_unknowns = initial.cost_of_unknowns()(which);
  add(std::move(unknowns), of_unknowns);
  return stages;
}

}  // namespace courant
