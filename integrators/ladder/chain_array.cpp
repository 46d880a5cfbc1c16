#include "courant/integrators/ladder/chain_array.hpp"

#include <stdexcept>

#include "courant/integrators/ladder/local_formulation.hpp"

namespace courant {

ChainArray::ChainArray(std::shared_ptr<const ImplicitSystem> system,
                       std::shared_ptr<const DiscretizationMap> map, double h, double t,
                       const VectorXd& x0)
    : Prolongation(system->manifold()->dimension(), system->auxiliary_size(),
                   system->equation_count()),
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
  const ExprMatrix basis = basis_variables(graph, M);
  const Expr time = graph.variable("t");
  const auto between = map_->inverse(M.chart(origin, basis, xi0), M.chart(origin, basis, xi1));
  const ExprVector v = Expr(1.0 / h) * between.v;
  link_ =
      Function("link",
               {{"xi0", xi0},
                {"xi1", xi1},
                {"z", z},
                {"x0", origin},
                {"basis", basis_parameters(M, basis)},
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
          n == basis_.rows() ? VectorXd(0)
                             : VectorXd(Eigen::Map<const VectorXd>(basis_.data(), basis_.size())),
          VectorXd::Constant(1, t_ + (static_cast<double>(i) + map_->stage_time()) * h_)};
}

VectorXd ChainArray::do_residual(const VectorXd& y, Index k) const {
  VectorXd value(row_count(k));
  for (Index i = 0; i <= k; ++i)
    value.segment(i * equation_count(), equation_count()) = link_(arguments(y, i));
  return value;
}

Linearization ChainArray::do_linearize(const VectorXd& y, Index k) const {
  const Index n = base_size();
  Linearization result{do_residual(y, k), SparseMatrixXd(row_count(k), y.size())};
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i <= k; ++i) {
    const SparseMatrixXd J = link_.sparse_jacobian(arguments(y, i));
    for (Index j = 0; j < J.outerSize(); ++j) {
      const Index column = j < n       ? x_offset(i) + j
                           : j < 2 * n ? x_offset(i + 1) + j - n
                                       : z_offset(i) + j - 2 * n;
      for (SparseMatrixXd::InnerIterator it(J, j); it; ++it)
        entries.emplace_back(static_cast<int>(i * equation_count() + it.row()),
                             static_cast<int>(column), it.value());
    }
  }
  result.jacobian.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace courant
