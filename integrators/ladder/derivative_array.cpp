#include "courant/integrators/ladder/derivative_array.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/derivative.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"

namespace courant {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Row j: the number a_j as a series of order k.
RowMajorMatrix constant_series(const VectorXd& a, Index k) {
  RowMajorMatrix series = RowMajorMatrix::Zero(a.size(), k + 1);
  series.col(0) = a;
  return series;
}

}  // namespace

// Coefficients 0 … k of the r equations, then of the entries of the Jacobian by (ξ, ξ', z): one
// number a row.
struct DerivativeArray::Series {
  RowMajorMatrix coefficients;
};

DerivativeArray::DerivativeArray(std::shared_ptr<const ImplicitSystem> system, double t,
                                 const VectorXd& x0)
    : Prolongation(system->manifold()->dimension(), system->auxiliary_size(),
                   system->equation_count()),
      system_(std::move(system)) {
  const Manifold& M = *system_->manifold();
  Graph graph;
  const ExprVector origin = graph.variables("x0", M.ambient_dimension());
  const ExprMatrix basis = basis_variables(graph, M);
  const Expr time = graph.variable("t");
  const LocalFormulation local(graph, *system_, origin, basis, time,
                               std::vector<int>(static_cast<std::size_t>(equation_count()), 0));
  const std::vector<Function::Input> inputs = {{"xi", local.xi[0]},
                                               {"xi'", local.xi[1]},
                                               {"z", local.z[0]},
                                               {"x0", origin},
                                               {"basis", basis_parameters(M, basis)},
                                               {"t", ExprVector::Constant(1, time)}};
  equations_ = Function("F", inputs, local.equations, {.differentiate = {"xi", "xi'", "z"}});
  ExprVector state(local.x.size() + local.v.size());
  state << local.x, local.v;
  state_ = Function("state", inputs, state, {.differentiate = {"xi", "xi'"}});

  ExprVector by(2 * base_size() + auxiliary_size());
  by << local.xi[0], local.xi[1], local.z[0];
  const SparseExprMatrix d_equations = courant::jacobian(local.equations, by);
  constant_jacobian_ = std::all_of(d_equations.values.begin(), d_equations.values.end(),
                                   [](const Expr& entry) { return entry.is_constant(); });
  move_to(t, x0);
}

DerivativeArray DerivativeArray::at(double t, const VectorXd& x0) const {
  DerivativeArray result(*this);
  result.move_to(t, x0);
  return result;
}

void DerivativeArray::move_to(double t, const VectorXd& x0) {
  const Manifold& M = *system_->manifold();
  if (x0.size() != M.ambient_dimension())
    throw std::invalid_argument(
        "DerivativeArray::at: x0 has " + std::to_string(x0.size()) +
        " entries, expected ambient_dimension() = " + std::to_string(M.ambient_dimension()) + ".");
  t_ = t;
  origin_ = x0;
  basis_ = M.tangent_basis(x0);
}

VectorXd DerivativeArray::jet(const VectorXd& v, const VectorXd& z) const {
  VectorXd y = VectorXd::Zero(unknown_count(0));
  if (v.size() > 0) y.segment(x_offset(1), base_size()) = basis_.transpose() * v;
  if (z.size() > 0) y.segment(z_offset(0), auxiliary_size()) = z;
  return y;
}

VectorXd DerivativeArray::resized(const VectorXd& y, Index k) const {
  VectorXd result = VectorXd::Zero(unknown_count(k));
  const Index common = std::min(y.size(), result.size());
  result.head(common) = y.head(common);
  return result;
}

DerivativeArray::Series DerivativeArray::evaluate(const VectorXd& y, Index k,
                                                  bool with_jacobian) const {
  const Index n = base_size(), m = auxiliary_size();
  RowMajorMatrix xi(n, k + 1), rate(n, k + 1), z(m, k + 1);
  for (Index i = 0; i <= k; ++i) {
    xi.col(i) = y.segment(x_offset(i), n);
    rate.col(i) = static_cast<double>(i + 1) * y.segment(x_offset(i + 1), n);
    z.col(i) = y.segment(z_offset(i), m);
  }
  const RowMajorMatrix origin = constant_series(origin_, k);
  const RowMajorMatrix basis = constant_series(
      n == basis_.rows() ? VectorXd(0)
                         : VectorXd(Eigen::Map<const VectorXd>(basis_.data(), basis_.size())),
      k);
  RowMajorMatrix time = constant_series(VectorXd::Constant(1, t_), k);
  if (k >= 1) time(0, 1) = 1.0;
  const double* in[] = {xi.data(), rate.data(), z.data(), origin.data(), basis.data(), time.data()};

  Series series;
  series.coefficients.resize(equation_count() + (with_jacobian ? equations_.nonzeros() : 0), k + 1);
  with_jacobian ? equations_.taylor_with_jacobian(in, k, series.coefficients.data())
                : equations_.taylor(in, k, series.coefficients.data());
  return series;
}

VectorXd DerivativeArray::origin_size() const {
  const VectorXd in_frame = system_->manifold()->coframe(origin_) * origin_;
  return (basis_.transpose() * in_frame).cwiseAbs();
}

VectorXd DerivativeArray::do_residual(const VectorXd& y, Index k) const {
  const MatrixXd by_equation = evaluate(y, k, false).coefficients;  // column-major: F_0 first
  return Eigen::Map<const VectorXd>(by_equation.data(), by_equation.size());
}

Linearization DerivativeArray::do_linearize(const VectorXd& y, Index k) const {
  const Index n = base_size(), r = equation_count();
  const RowMajorMatrix series = evaluate(y, k, true).coefficients;
  Linearization result;
  const MatrixXd values = series.topRows(r);
  result.value = Eigen::Map<const VectorXd>(values.data(), values.size());

  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index i, Index equation, Index column, double value) {
    if (value != 0.0)
      entries.emplace_back(static_cast<int>(i * r + equation), static_cast<int>(column), value);
  };
  for (Index e = 0; e < equations_.nonzeros(); ++e) {
    const Index equation = equations_.pattern_row()[static_cast<std::size_t>(e)];
    const Index variable = equations_.pattern_col()[static_cast<std::size_t>(e)];
    const auto coefficient = series.row(r + e);
    for (Index i = 0; i <= k; ++i) {
      for (Index j = 0; j <= i; ++j) {
        if (variable < n)
          add(i, equation, x_offset(j) + variable, coefficient[i - j]);
        else if (variable < 2 * n)
          add(i, equation, x_offset(j + 1) + variable - n,
              static_cast<double>(j + 1) * coefficient[i - j]);
        else
          add(i, equation, z_offset(j) + variable - 2 * n, coefficient[i - j]);
      }
    }
  }
  result.jacobian.resize(row_count(k), y.size());
  result.jacobian.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Linearization DerivativeArray::state_map(const VectorXd& y) const {
  const Index n = base_size(), m = auxiliary_size();
  const VectorXd xi = y.head(n), rate = y.segment(n, n), z = y.segment(2 * n, m);
  const VectorXd basis = n == basis_.rows()
                             ? VectorXd(0)
                             : VectorXd(Eigen::Map<const VectorXd>(basis_.data(), basis_.size()));
  const VectorXd time = VectorXd::Constant(1, t_);
  const std::vector<VectorXd> in = {xi, rate, z, origin_, basis, time};
  const VectorXd point = state_(in);
  const SparseMatrixXd d_point = state_.sparse_jacobian(in);

  Linearization result;
  result.value.resize(point.size() + m);
  result.value << point, z;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index j = 0; j < d_point.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(d_point, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
  for (Index i = 0; i < m; ++i)
    entries.emplace_back(static_cast<int>(point.size() + i), static_cast<int>(2 * n + i), 1.0);
  result.jacobian.resize(result.value.size(), 2 * n + m);
  result.jacobian.setFromTriplets(entries.begin(), entries.end());
  return result;
}

State DerivativeArray::state(const VectorXd& y) const {
  const Manifold& M = *system_->manifold();
  const VectorXd value = state_map(y).value;
  return {t_, value.head(M.ambient_dimension()),
          value.segment(M.ambient_dimension(), M.tangent_dimension()),
          value.tail(auxiliary_size())};
}

}  // namespace courant
