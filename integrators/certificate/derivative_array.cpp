#include "courant/integrators/certificate/derivative_array.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "courant/core/numbers/quadruple.hpp"
#include "courant/core/solve/limited_newton.hpp"

namespace courant {
namespace {

// Series of order k: one a row.
template <class Number>
class SeriesTable {
 public:
  SeriesTable(Index rows, Index k)
      : width_(k + 1), numbers_(static_cast<std::size_t>(rows * (k + 1)), Number(0.0)) {}
  Number& operator()(Index row, Index i) {
    return numbers_[static_cast<std::size_t>(row * width_ + i)];
  }
  Number* data() { return numbers_.data(); }
  const Number* data() const { return numbers_.data(); }
  const std::vector<Number>& numbers() const { return numbers_; }

 private:
  Index width_;
  std::vector<Number> numbers_;
};

// The arguments of F along a jet. `unknown(j)` is the j-th number of the jet; `rounded(a)` is one of
// the constants x₀, t, `basis` an entry of the basis.
template <class Number>
struct Arguments {
  SeriesTable<Number> xi, rate, z, origin, basis, time;

  template <class Unknown, class Rounded, class Direction>
  Arguments(const DerivativeArray& array, Index k, const VectorXd& basis_entries,
            const Unknown& unknown, const Rounded& rounded, const Direction& direction)
      : xi(array.base_size(), k),
        rate(array.base_size(), k),
        z(array.auxiliary_size(), k),
        origin(array.origin().size(), k),
        basis(basis_entries.size(), k),
        time(1, k) {
    for (Index i = 0; i <= k; ++i) {
      for (Index j = 0; j < array.base_size(); ++j) {
        xi(j, i) = unknown(array.x_offset(i) + j);
        rate(j, i) = static_cast<double>(i + 1) * unknown(array.x_offset(i + 1) + j);
      }
      for (Index j = 0; j < array.auxiliary_size(); ++j) z(j, i) = unknown(array.z_offset(i) + j);
    }
    for (Index j = 0; j < array.origin().size(); ++j) origin(j, 0) = rounded(array.origin()[j]);
    for (Index j = 0; j < basis_entries.size(); ++j) basis(j, 0) = direction(basis_entries[j]);
    time(0, 0) = rounded(array.t());
    if (k >= 1) time(0, 1) = 1.0;
  }

  std::array<const Number*, 6> pointers() const {
    return {xi.data(), rate.data(), z.data(), origin.data(), basis.data(), time.data()};
  }
};

// An entry of an orthonormal basis: a few roundings of 1 are lost, except where nothing was computed.
Uncertain direction(double entry) {
  return {entry, entry == 0.0 || std::fabs(entry) == 1.0 ? 0.0 : 8.0 * Uncertain::unit};
}

}  // namespace

DerivativeArray::DerivativeArray(std::shared_ptr<const ChartEquations> equations, double t,
                                 const VectorXd& x0)
    : Prolongation(equations->system()->manifold()->dimension(),
                   equations->system()->auxiliary_size(), equations->system()->equation_count()),
      equations_(std::move(equations)) {
  move_to(t, x0);
}

DerivativeArray::DerivativeArray(std::shared_ptr<const ImplicitSystem> system, double t,
                                 const VectorXd& x0)
    : DerivativeArray(std::make_shared<const ChartEquations>(std::move(system)), t, x0) {}

DerivativeArray DerivativeArray::at(double t, const VectorXd& x0) const {
  DerivativeArray result(*this);
  result.move_to(t, x0);
  return result;
}

void DerivativeArray::move_to(double t, const VectorXd& x0) {
  const Manifold& M = *system()->manifold();
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

std::optional<VectorXd> DerivativeArray::beyond_exponentials(const VectorXd& y) const {
  if (equations_->of_rates().count() == 0) return std::nullopt;
  const Index n = base_size(), m = auxiliary_size();
  VectorXd rates(n + m);
  rates << y.segment(x_offset(1), n), y.segment(z_offset(0), m);
  const VectorXd xi = y.head(n), basis = basis_entries();
  const Inputs in(rates.data(), {xi.data(), origin_.data(), basis.data(), &t_});
  if (!LimitedNewton(equations_->of_rates()).solve(in)) return std::nullopt;
  VectorXd there = y;
  there.segment(x_offset(1), n) = rates.head(n);
  there.segment(z_offset(0), m) = rates.tail(m);
  return there;
}

VectorXd DerivativeArray::resized(const VectorXd& y, Index k) const {
  VectorXd result = VectorXd::Zero(unknown_count(k));
  const Index common = std::min(y.size(), result.size());
  result.head(common) = y.head(common);
  return result;
}

VectorXd DerivativeArray::carried(const VectorXd& y, double later) const {
  const Index k = level_of(y);
  VectorXd result = y;
  // The i-th coefficient of a polynomial of degree `last` at s + later, by Horner's rule.
  const auto carry = [&](Index last, Index size, const auto& offset) {
    for (Index i = 0; i < last; ++i)
      for (Index j = last - 1; j >= i; --j)
        result.segment(offset(j), size) += later * result.segment(offset(j + 1), size);
  };
  carry(k + 1, base_size(), [&](Index i) { return x_offset(i); });
  carry(k, auxiliary_size(), [&](Index i) { return z_offset(i); });
  return result;
}

VectorXd DerivativeArray::basis_entries() const { return basis_.entries().reshaped(); }

VectorXd DerivativeArray::origin_size() const {
  const LinearMap<double> coframe = system()->manifold()->coframe(origin_);
  const VectorXd size = (basis_.transpose() * (coframe * origin_)).cwiseAbs();
  const VectorXd terms =
      absolute(basis_).transpose() * (absolute(coframe) * origin_.cwiseAbs().eval());
  constexpr double round_off = 16.0 * Uncertain::unit;
  return (size.array() > round_off * terms.array()).select(size, 0.0);
}

VectorXd DerivativeArray::do_residual(const VectorXd& y, Index k) const {
  const auto as_it_is = [](double number) { return number; };
  const Arguments<double> in(
      *this, k, basis_entries(), [&](Index j) { return y[j]; }, as_it_is, as_it_is);
  SeriesTable<double> series(equation_count(), k);
  equations_->equations().taylor(in.pointers().data(), k, series.data());
  VectorXd value(row_count(k));  // F_0 first
  for (Index i = 0; i <= k; ++i)
    for (Index e = 0; e < equation_count(); ++e) value[i * equation_count() + e] = series(e, i);
  return value;
}

// add(row, column, coefficient) for each term of an entry of the Jacobian of level k, from the series of F and of
// its Jacobian.
template <class Number, class Add>
void DerivativeArray::each_entry(const std::vector<Number>& coefficients, Index k,
                                 const Add& add) const {
  const Index n = base_size(), r = equation_count();
  for (Index e = 0; e < equations_->equations().nonzeros(); ++e) {
    const Index equation = equations_->equations().pattern_row()[static_cast<std::size_t>(e)];
    const Index variable = equations_->equations().pattern_col()[static_cast<std::size_t>(e)];
    const Number* series = coefficients.data() + (r + e) * (k + 1);
    for (Index i = 0; i <= k; ++i) {
      for (Index j = 0; j <= i; ++j) {
        const Number& coefficient = series[i - j];
        const Index row = i * r + equation;
        if (variable < n)
          add(row, x_offset(j) + variable, coefficient);
        else if (variable < 2 * n)
          add(row, x_offset(j + 1) + variable - n, static_cast<double>(j + 1) * coefficient);
        else
          add(row, z_offset(j) + variable - 2 * n, coefficient);
      }
    }
  }
}

Linearization DerivativeArray::do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                                            Index k) const {
  const Index r = equation_count();
  const Arguments<Uncertain> in(
      *this, k, basis_entries(), [&](Index j) { return Uncertain(y[j], uncertainty[j]); },
      Uncertain::rounded, direction);
  SeriesTable<Uncertain> series(r + equations_->equations().nonzeros(), k);
  equations_->equations().taylor_with_jacobian(in.pointers().data(), k, series.data());

  Linearization result;
  result.value.resize(row_count(k));
  result.value_error.resize(row_count(k));
  for (Index i = 0; i <= k; ++i) {
    for (Index e = 0; e < r; ++e) {
      result.value[i * r + e] = series(e, i).value;
      result.value_error[i * r + e] = series(e, i).error;
    }
  }
  UncertainEntries entries;
  each_entry(series.numbers(), k, [&](Index row, Index column, const Uncertain& coefficient) {
    entries.add(row, column, coefficient);
  });
  entries.fill(result, row_count(k), y.size());
  return result;
}

Linearization DerivativeArray::linearize(const std::vector<Quadruple>& y) const {
  const Index r = equation_count(), k = level_of(VectorXd::Zero(std::ssize(y)));
  const auto as_it_is = [](double number) { return Quadruple(number); };
  const Arguments<Quadruple> in(
      *this, k, basis_entries(), [&](Index j) { return y[static_cast<std::size_t>(j)]; }, as_it_is,
      as_it_is);
  SeriesTable<Quadruple> series(r + equations_->equations().nonzeros(), k);
  equations_->equations().taylor_with_jacobian(in.pointers().data(), k, series.data());

  Linearization result;
  result.value.resize(row_count(k));
  for (Index i = 0; i <= k; ++i)
    for (Index e = 0; e < r; ++e) result.value[i * r + e] = static_cast<double>(series(e, i));
  // Terms of one entry cancel, so that they are added before they are rounded.
  std::map<std::pair<Index, Index>, Quadruple> sums;
  each_entry(series.numbers(), k, [&](Index row, Index column, const Quadruple& coefficient) {
    sums[{row, column}] += coefficient;
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [place, sum] : sums)
    entries.emplace_back(static_cast<int>(place.first), static_cast<int>(place.second),
                         static_cast<double>(sum));
  result.jacobian.resize(row_count(k), std::ssize(y));
  result.jacobian.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Linearization DerivativeArray::state_map(const VectorXd& y) const {
  const Index n = base_size(), m = auxiliary_size();
  const VectorXd xi = y.head(n), rate = y.segment(n, n), z = y.segment(2 * n, m);
  const VectorXd time = VectorXd::Constant(1, t_);
  const std::vector<VectorXd> in = {xi, rate, z, origin_, basis_entries(), time};
  const VectorXd point = equations_->state()(in);
  const SparseMatrixXd d_point = equations_->state().sparse_jacobian(in);

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
  const Manifold& M = *system()->manifold();
  const VectorXd value = state_map(y).value;
  return {t_, value.head(M.ambient_dimension()),
          value.segment(M.ambient_dimension(), M.tangent_dimension()),
          value.tail(auxiliary_size())};
}

}  // namespace courant
