#include "courant/integrators/certificate/jet_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/numbers/ball.hpp"

namespace courant {
namespace {

// Formulas with variables for the constants whose products doubles may round.
struct NamedConstants {
  ExprVector formulas;
  std::vector<Expr> variables;
  std::vector<double> values;
};

// Whether products of a few such numbers are exact.
bool is_short_number(double value) {
  constexpr double grid = 1024.0, most = 1048576.0;
  return std::fabs(value) <= most && value * grid == std::floor(value * grid);
}

// The same formulas: derivatives of them multiply numbers as they were written, which derivatives of formulas
// with numbers in them would round first.
NamedConstants with_named_constants(const ExprVector& formulas) {
  NamedConstants result{formulas, {}, {}};
  const Subgraph subgraph(formulas);
  const Graph& graph = subgraph.graph();
  std::vector<Expr> made(subgraph.size());
  std::map<double, Expr> named;
  std::vector<bool> is_exponent(subgraph.size(), false);
  for (const std::uint32_t index : subgraph.nodes())
    if (graph.node(index).op == Op::pow) is_exponent[subgraph.position(graph.node(index).b)] = true;
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    const std::uint32_t index = subgraph.nodes()[at];
    const Node& node = graph.node(index);
    if (node.op == Op::variable) {
      made[at] = graph.expression(index);
    } else if (node.op == Op::constant) {
      const double value = graph.constant(index);
      made[at] = value;
      if (is_short_number(value) || !std::isfinite(value) || is_exponent[at]) continue;
      const auto [place, is_new] = named.try_emplace(value);
      if (is_new) {
        place->second = graph.variable("constant");
        result.variables.push_back(place->second);
        result.values.push_back(value);
      }
      made[at] = place->second;
    } else {
      const auto operand = [&](std::uint32_t from, int i) {
        return i < arity(node.op) ? made[subgraph.position(from)] : Expr();
      };
      made[at] = apply(node.op, node.k, operand(node.a, 0), operand(node.b, 1), operand(node.c, 2));
    }
  }
  for (Expr& formula : result.formulas)
    if (!formula.is_constant()) formula = made[subgraph.position(formula)];
  return result;
}

}  // namespace

JetEquations::JetEquations(std::shared_ptr<const ImplicitSystem> system)
    : JetEquations(std::make_shared<const ChartEquations>(std::move(system))) {}

JetEquations::JetEquations(std::shared_ptr<const ChartEquations> in_chart)
    : in_chart_(std::move(in_chart)),
      N_(system().manifold()->ambient_dimension()),
      m_(system().auxiliary_size()) {
  const Manifold& M = *system().manifold();
  const Graph graph;
  const ExprVector x = graph.variables("x", N_), rate = graph.variables("x'", N_),
                   z = graph.variables("z", m_);
  const ExprVector time = ExprVector::Constant(1, graph.variable("t"));
  const ExprVector v = M.has_identity_frame() ? rate : ExprVector(M.coframe(x) * rate);
  ExprVector equations = system().residual(x, v, z, time[0]);
  if (M.dimension() < N_) {
    const ExprVector c = M.constraint(x);
    equations = joined(equations, c, tangent(c, x, rate));
  }
  rows_ = equations.size();
  of_time_ = depends(equations, time);
  const NamedConstants named = with_named_constants(equations);
  equations = named.formulas;
  for (const double value : named.values) {
    constants_.push_back(value);
    written_constants_.push_back(Digits::written(value));
  }
  const SparseExprMatrix derivative = jacobian(equations, joined(x, rate, z, time));
  const std::vector<ExprVector> inputs = {
      x, rate, z, time,
      Eigen::Map<const ExprVector>(named.variables.data(), std::ssize(named.variables))};
  constexpr Index time_group = 3;
  values_ = SeriesFunction(inputs, equations, time_group);
  equations_ = SeriesFunction(inputs, joined(equations, derivative.values), time_group);
  places_.resize(static_cast<std::size_t>(rows_));
  for (std::size_t e = 0; e < derivative.row.size(); ++e) {
    std::vector<Place>& row = places_[static_cast<std::size_t>(derivative.row[e])];
    const auto output = static_cast<Index>(e) + rows_;
    const Index column = derivative.col[e];
    const bool of_rate = column >= N_ && column < 2 * N_;
    const Place place = column < 2 * N_        ? Place{Argument::x, of_rate ? column - N_ : column}
                        : column < 2 * N_ + m_ ? Place{Argument::z, column - 2 * N_}
                                               : Place{Argument::t, 0};
    auto found = std::find_if(row.begin(), row.end(), [&](const Place& other) {
      return other.argument == place.argument && other.column == place.column;
    });
    if (found == row.end()) found = row.insert(row.end(), place);
    (of_rate ? found->of_rate : found->of_value) = output;
  }
  for (std::vector<Place>& row : places_)
    std::sort(row.begin(), row.end(), [](const Place& a, const Place& b) {
      return std::pair(a.argument, a.column) < std::pair(b.argument, b.column);
    });
}

JetEquations JetEquations::on_side(int side) const {
  JetEquations result(*this);
  result.side_ = side;
  return result;
}

template <class Add>
void JetEquations::each_place(Index k, const Add& add) const {
  for (Index i = 0; i <= k; ++i)
    for (Index r = 0; r < rows_; ++r) {
      const std::vector<Place>& places = places_[static_cast<std::size_t>(r)];
      const auto of_argument = [&](Argument argument, Index j) {
        for (const Place& place : places) {
          if (place.argument != argument) continue;
          const bool is_x = argument == Argument::x;
          if (is_x && !(place.of_value >= 0 && j <= i) && !(place.of_rate >= 0 && j >= 1)) continue;
          const Index offset = is_x                      ? x_offset(j)
                               : argument == Argument::z ? z_offset(j)
                                                         : unknown_count(k);
          add(i * rows_ + r, offset + place.column, place, i, j);
        }
      };
      of_argument(Argument::x, 0);
      for (Index j = 0; j <= i; ++j) {
        of_argument(Argument::x, j + 1);
        of_argument(Argument::z, j);
      }
      of_argument(Argument::t, 0);
    }
}

std::vector<JetEquations::Entry> JetEquations::pattern(Index k) const {
  std::vector<Entry> result;
  each_place(k, [&](Index row, Index column, const Place&, Index, Index) {
    result.push_back({row, column});
  });
  return result;
}

template <class Number>
bool JetEquations::run(const SeriesFunction& f, const Number& t, const std::vector<Number>& y,
                       Index k, std::vector<Number>& out) const {
  const Index width = k + 1;
  std::vector<Number> x(static_cast<std::size_t>(N_ * width)), rate(x.size()),
      z(static_cast<std::size_t>(m_ * width)), time(static_cast<std::size_t>(width), Number(0.0));
  const auto number = [&](Index j) -> const Number& { return y[static_cast<std::size_t>(j)]; };
  for (Index i = 0; i <= k; ++i) {
    for (Index j = 0; j < N_; ++j) {
      x[static_cast<std::size_t>(j * width + i)] = number(x_offset(i) + j);
      rate[static_cast<std::size_t>(j * width + i)] =
          Number(static_cast<double>(i + 1)) * number(x_offset(i + 1) + j);
    }
    for (Index j = 0; j < m_; ++j)
      z[static_cast<std::size_t>(j * width + i)] = number(z_offset(i) + j);
  }
  time[0] = t;
  if (k >= 1) time[1] = 1.0;
  std::vector<Number> constants(constants_.size() * static_cast<std::size_t>(width), Number(0.0));
  for (std::size_t c = 0; c < constants_.size(); ++c) {
    Number& value = constants[c * static_cast<std::size_t>(width)];
    if constexpr (std::is_same_v<Number, Digits>)
      value = written_constants_[c];
    else if constexpr (std::is_same_v<Number, Ball>)
      value = Ball::written(constants_[c]);
    else
      value = constants_[c];
  }
  const std::array<const Number*, 5> in = {x.data(), rate.data(), z.data(), time.data(),
                                           constants.data()};
  out.assign(static_cast<std::size_t>(f.output_size() * width), Number(0.0));
  return f.run(in.data(), k, out.data(), side_);
}

template <class Number>
std::vector<Number> JetEquations::residual(const Number& t, const std::vector<Number>& y,
                                           Index k) const {
  std::vector<Number> series;
  run(values_, t, y, k, series);
  std::vector<Number> result(static_cast<std::size_t>(row_count(k)));
  for (Index i = 0; i <= k; ++i)
    for (Index e = 0; e < rows_; ++e)
      result[static_cast<std::size_t>(i * rows_ + e)] =
          series[static_cast<std::size_t>(e * (k + 1) + i)];
  return result;
}

template <class Number>
JetEquations::Values<Number> JetEquations::at(const Number& t, const std::vector<Number>& y,
                                              Index k) const {
  std::vector<Number> series;
  Values<Number> result;
  result.is_at_edge = run(equations_, t, y, k, series);
  result.residual.resize(static_cast<std::size_t>(row_count(k)));
  for (Index i = 0; i <= k; ++i)
    for (Index e = 0; e < rows_; ++e)
      result.residual[static_cast<std::size_t>(i * rows_ + e)] =
          series[static_cast<std::size_t>(e * (k + 1) + i)];
  each_place(k, [&](Index, Index, const Place& place, Index i, Index j) {
    const auto coefficient = [&](Index output, Index order) -> const Number& {
      return series[static_cast<std::size_t>(output * (k + 1) + order)];
    };
    Number entry(0.0);
    if (place.of_value >= 0 && j <= i) entry = coefficient(place.of_value, i - j);
    if (place.of_rate >= 0 && j >= 1) {
      const Number& rate = coefficient(place.of_rate, i - j + 1);
      entry += j == 1 ? rate : Number(static_cast<double>(j)) * rate;
    }
    result.entries.push_back(entry);
  });
  return result;
}

template std::vector<double> JetEquations::residual(const double&, const std::vector<double>&,
                                                    Index) const;
template std::vector<Digits> JetEquations::residual(const Digits&, const std::vector<Digits>&,
                                                    Index) const;
template std::vector<Ball> JetEquations::residual(const Ball&, const std::vector<Ball>&,
                                                  Index) const;
template JetEquations::Values<double> JetEquations::at(const double&, const std::vector<double>&,
                                                       Index) const;
template JetEquations::Values<Digits> JetEquations::at(const Digits&, const std::vector<Digits>&,
                                                       Index) const;
template JetEquations::Values<Ball> JetEquations::at(const Ball&, const std::vector<Ball>&,
                                                     Index) const;

}  // namespace courant
