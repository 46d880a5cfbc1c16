#include "courant/running/undetermined_start.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/running/ladder_search.hpp"

namespace courant {
namespace {

// The coordinates that are not given and change along a direction on M_f along which no given one changes; none
// if what is given of (v, z) may tell these directions apart.
std::vector<Index> free_coordinates(const Manifold& M, const ConstraintLadder& ladder,
                                    const InitialValues& initial) {
  const LinearMap<double> basis = M.tangent_basis(ladder.point.x);
  const LinearMap<double> motion = M.frame(ladder.point.x) * basis;
  MatrixXd conditions = ladder.conormals() * basis;
  const std::vector<Index> given = indices(initial.x.given);
  // On Rⁿ directions are coordinates: those that are given, and those that no conormal contains, need no matrix.
  std::vector<Index> sought, free;
  if (motion.is_identity()) {
    for (Index i = 0; i < motion.cols(); ++i)
      if (!initial.x.given[i]) (conditions.col(i).isZero(0.0) ? free : sought).push_back(i);
    conditions = conditions(Eigen::all, sought).eval();
  } else {
    const Index count = conditions.rows();
    conditions.conservativeResize(count + std::ssize(given), Eigen::NoChange);
    conditions.bottomRows(std::ssize(given)) = motion.entries()(given, Eigen::all);
    sought = indices(!initial.x.given);
  }
  const MatrixXd directions =
      sought.empty() ? MatrixXd() : kernel(conditions, {.data_error = 1e-9});
  if (std::ssize(free) + directions.cols() <=
      initial.velocity.given.count() + initial.z.given.count())
    return {};
  for (std::size_t k = 0; k < sought.size(); ++k) {
    const auto row = static_cast<Index>(k);
    const double length = motion.is_identity()
                              ? directions.row(row).norm()
                              : (motion.entries().row(sought[k]) * directions).norm();
    if (length > 1e-6) free.push_back(sought[k]);
  }
  std::sort(free.begin(), free.end());
  return free;
}

}  // namespace

std::vector<std::string> undetermined_coordinates(const Experiment& experiment,
                                                  const ConstraintLadder& ladder) {
  if (ladder.verdict != Verdict::regular && ladder.verdict != Verdict::gauge) return {};
  const InitialValues& initial = experiment.initial;
  if (initial.x.given.all() || experiment.model.starts_at_zero) return {};
  const std::vector<Index> free =
      free_coordinates(*experiment.model.system->manifold(), ladder, initial);
  const auto& coordinates = experiment.model.system->names().coordinates;
  std::vector<std::string> names;
  for (const Index i : free) names.push_back(coordinates[static_cast<std::size_t>(i)]);
  return names;
}

bool determined_at_rest(const Experiment& experiment, const std::vector<std::string>& missing,
                        const std::function<ConsistentStart(const Experiment&)>& start) {
  Json document = experiment.document;
  Json& initial = document["initial"];
  if (!initial.is_object() || initial.contains("rest")) return false;
  initial["rest"] = true;
  try {
    const Experiment resting = read_experiment_document(document);
    const auto& names = resting.model.system->names().coordinates;
    const auto is_told = [&](const Flags& given, const std::string& name) {
      const auto found = std::ranges::find(names, name);
      return found != names.end() && given[found - names.begin()];
    };
    for (const std::string& name : missing)
      if (!is_told(resting.initial.x.given, name) &&
          !(name.starts_with("p_") && is_told(resting.initial.velocity.given, name.substr(2))))
        return false;
    const ConsistentStart found = start(resting);
    return !has_no_start(found) && found.moves.empty();
  } catch (const ExperimentError&) {
    return false;
  }
}

}  // namespace courant
