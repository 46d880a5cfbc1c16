#include "courant/integrators/certificate/chain_array.hpp"

#include <stdexcept>

#include "courant/integrators/certificate/local_formulation.hpp"

namespace courant {
namespace {

const ImplicitSystem& existing(const std::shared_ptr<const ImplicitSystem>& system,
                               const std::shared_ptr<const DiscretizationMap>& map) {
  if (!system || !map)
    throw std::invalid_argument(std::string("ChainArray: the ") + (system ? "map" : "system") +
                                " is null; expected a system and a map.");
  return *system;
}

}  // namespace

ChainArray::ChainArray(std::shared_ptr<const ImplicitSystem> system,
                       std::shared_ptr<const DiscretizationMap> map, double h, double t,
                       const VectorXd& x0)
    // The order in which arguments are evaluated is open: each asks.
    : Prolongation(existing(system, map).manifold()->dimension(),
                   existing(system, map).auxiliary_size(), existing(system, map).equation_count()),
      system_(std::move(system)),
      map_(std::move(map)),
      h_(h),
      t_(t),
      origin_(x0) {
  const Manifold& M = *system_->manifold();
  if (*map_->manifold() != *system_->manifold())
    throw std::invalid_argument(
        "ChainArray: map is on another manifold than the system; expected one and the same "
        "manifold.");
  if (h == 0.0) throw std::invalid_argument("ChainArray: h is 0; expected a time step.");
  if (x0.size() != M.ambient_dimension())
    throw std::invalid_argument(
        "ChainArray: x0 has " + std::to_string(x0.size()) +
        " entries; expected ambient_dimension() = " + std::to_string(M.ambient_dimension()) + ".");
  basis_ = M.tangent_basis(x0);

  Graph graph;
  const ExprVector xi0 = graph.variables("xi0", M.dimension());
  const ExprVector xi1 = graph.variables("xi1", M.dimension());
  const ExprVector z = graph.variables("z", auxiliary_size());
  const ExprVector origin = graph.variables("x0", M.ambient_dimension());
  const LinearMap<Expr> basis = basis_variables(graph, M);
  const Expr time = graph.variable("t");
  const auto between = map_->inverse(M.chart(origin, basis, xi0), M.chart(origin, basis, xi1));
  const ExprVector v = Expr(1.0 / h) * between.v;
  link_ =
      Function("link",
               {{"xi0", xi0},
                {"xi1", xi1},
                {"z", z},
                {"x0", origin},
                {"basis", basis_parameters(basis)},
                {"t", ExprVector::Constant(1, time)}},
               system_->residual(between.x, v, z, time), {.differentiate = {"xi0", "xi1", "z"}});
}

VectorXd ChainArray::point(const VectorXd& y, Index i) const {
  const VectorXd v = basis_ * y.segment(x_offset(i), base_size());
  return system_->manifold()->retract(origin_, v);
}

std::vector<VectorXd> ChainArray::arguments(const VectorXd& y, Index i) const {
  const Index n = base_size();
  return {y.segment(x_offset(i), n),
          y.segment(x_offset(i + 1), n),
          y.segment(z_offset(i), auxiliary_size()),
          origin_,
          basis_.entries().reshaped(),
          VectorXd::Constant(1, t_ + (static_cast<double>(i) + map_->stage_time()) * h_)};
}

// The uncertainties of arguments() where they are those of unknowns; empty where they are roundings.
std::vector<VectorXd> ChainArray::arguments_error(const VectorXd& uncertainty, Index i) const {
  const Index n = base_size();
  return {uncertainty.segment(x_offset(i), n),
          uncertainty.segment(x_offset(i + 1), n),
          uncertainty.segment(z_offset(i), auxiliary_size()),
          VectorXd(),
          VectorXd(),
          VectorXd()};
}

VectorXd ChainArray::do_residual(const VectorXd& y, Index k) const {
  VectorXd value(row_count(k));
  for (Index i = 0; i <= k; ++i)
    value.segment(i * equation_count(), equation_count()) = link_(arguments(y, i));
  return value;
}

Linearization ChainArray::do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                                       Index k) const {
  const Index n = base_size(), r = equation_count();
  Linearization result;
  result.value.resize(row_count(k));
  result.value_error.resize(row_count(k));
  UncertainEntries entries;
  std::vector<Uncertain> out(static_cast<std::size_t>(r + link_.nonzeros()));
  for (Index i = 0; i <= k; ++i) {
    std::vector<std::vector<Uncertain>> in;
    const std::vector<VectorXd> values = arguments(y, i), errors = arguments_error(uncertainty, i);
    for (std::size_t g = 0; g < values.size(); ++g) {
      std::vector<Uncertain>& group = in.emplace_back();
      for (Index j = 0; j < values[g].size(); ++j) {
        const Uncertain number = Uncertain::rounded(values[g][j]);
        group.push_back(errors[g].size() == 0 ? number : Uncertain(number.value, errors[g][j]));
      }
    }
    std::vector<const Uncertain*> pointers;
    for (const auto& group : in) pointers.push_back(group.data());
    link_.taylor_with_jacobian(pointers.data(), 0, out.data());
    for (Index e = 0; e < r; ++e) {
      result.value[i * r + e] = out[static_cast<std::size_t>(e)].value;
      result.value_error[i * r + e] = out[static_cast<std::size_t>(e)].error;
    }
    for (Index e = 0; e < link_.nonzeros(); ++e) {
      const Index j = link_.pattern_col()[static_cast<std::size_t>(e)];
      const Index column = j < n       ? x_offset(i) + j
                           : j < 2 * n ? x_offset(i + 1) + j - n
                                       : z_offset(i) + j - 2 * n;
      entries.add(i * r + link_.pattern_row()[static_cast<std::size_t>(e)], column,
                  out[static_cast<std::size_t>(r + e)]);
    }
  }
  entries.fill(result, row_count(k), y.size());
  return result;
}

}  // namespace courant
