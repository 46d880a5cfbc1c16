#include "courant/core/expressions/derivative.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

constexpr Index kNoIndex = -1;

void check_size(const char* function, const char* argument, Index size, Index expected) {
  if (size != expected)
    throw std::invalid_argument(std::string(function) + ": " + argument + " has " +
                                std::to_string(size) + " entries, expected " +
                                std::to_string(expected) + ".");
}

// For each node of y its index in x, or kNoIndex.
std::vector<Index> indices(const char* function, const ExprVector& x, const Subgraph& y) {
  std::vector<Index> result(y.size(), kNoIndex);
  for (Index i = 0; i < x.size(); ++i) {
    const auto fail = [&](const std::string& what) {
      throw std::invalid_argument(std::string(function) + ": x[" + std::to_string(i) + "] is " +
                                  to_string(x[i], 40) + what);
    };
    if (x[i].is_constant() || x[i].graph().node(x[i].node()).op != Op::variable)
      fail("; expected a variable.");
    if (!y.contains(x[i])) continue;
    Index& index = result[y.position(x[i])];
    if (index != kNoIndex)
      fail(", like x[" + std::to_string(index) + "]; expected each variable once.");
    index = i;
  }
  return result;
}

// One node of a subgraph, ready for the chain rule.
struct Operation {
  Operation(const Subgraph& y, std::size_t position)
      : node(y.graph().node(y.nodes()[position])),
        count(arity(node.op)),
        value(y.graph().expression(y.nodes()[position])) {
    const std::uint32_t number[] = {node.a, node.b, node.c};
    for (int i = 0; i < count; ++i) {
      operand[i] = y.graph().expression(number[i]);
      at[i] = y.position(number[i]);
    }
  }

  bool is_square() const { return node.op == Op::multiply && node.a == node.b; }

  Node node;
  int count;
  Expr value;
  Expr operand[3];
  std::size_t at[3] = {0, 0, 0};  // positions of the operands
};

// ∂(operation)/∂(operand i) of all operations that don't choose.
Expr partial(const Operation& operation, int i) {
  const auto& [node, count, y, operand, at] = operation;
  const Expr& a = operand[0];
  const Expr& b = operand[1];
  switch (node.op) {
    case Op::negate:
      return -1.0;
    case Op::add:
      return 1.0;
    case Op::subtract:
      return i == 0 ? 1.0 : -1.0;
    case Op::multiply:
      return i == 0 ? b : a;
    case Op::divide:
      return i == 0 ? 1.0 / b : -(y * (1.0 / b));
    case Op::sqrt:
      return 0.5 / y;
    case Op::exp:
      return y;
    case Op::log:
      return 1.0 / a;
    case Op::sin:
      return cos(a);
    case Op::cos:
      return -sin(a);
    case Op::tan:
      return 1.0 + y * y;
    case Op::asin:
      return 1.0 / sqrt((1.0 - a) * (1.0 + a));
    case Op::acos:
      return -(1.0 / sqrt((1.0 - a) * (1.0 + a)));
    case Op::atan:
      return 1.0 / (1.0 + a * a);
    case Op::sinh:
      return cosh(a);
    case Op::cosh:
      return sinh(a);
    case Op::tanh:
      return 1.0 - y * y;
    case Op::abs:
      return sign(a);
    case Op::power:
      return static_cast<double>(node.k) * pow(a, node.k - 1);
    case Op::pow:
      return i == 0 ? b * pow(a, b - 1.0) : log(a) * y;
    case Op::atan2:
      return (i == 0 ? b : -a) * (1.0 / (a * a + b * b));
    case Op::stumpff:
      return 0.5 * (static_cast<double>(node.k) * stumpff(node.k + 2, a) - stumpff(node.k + 1, a));
    case Op::arccos_factor:
      return arccos_factor(node.k + 1, a);
    default:
      return 0.0;  // piecewise constant: signs and conditions
  }
}

// An operation that is one of two operands, by a condition: select, min and max. The operand that
// is not chosen may be anything, not a number included, so its derivative is never multiplied by
// zero but left out.
struct Choice {
  Expr condition;
  int then, otherwise;  // which operand
};

std::optional<Choice> choice(const Operation& operation) {
  const Expr& a = operation.operand[0];
  const Expr& b = operation.operand[1];
  switch (operation.node.op) {
    case Op::select:
      return Choice{a, 1, 2};
    case Op::min:
      return Choice{b < a, 1, 0};
    case Op::max:
      return Choice{a < b, 1, 0};
    default:
      return std::nullopt;
  }
}

// What reverse mode knows about a node: the derivative of the result by it, where some choice made
// on the way to the result needs the node; elsewhere `weight` may be anything.
class Adjoint {
 public:
  bool is_zero() const { return weight_.is_constant(0.0); }
  const Expr& weight() const { return weight_; }
  const Expr& needed() const { return needed_; }

  // The derivative, zero where the node isn't needed.
  Expr masked() const { return mask(needed_, weight_); }

  void add(const Expr& weight, const Expr& needed) {
    if (weight.is_constant(0.0)) return;
    if (is_zero()) {
      weight_ = weight;
      needed_ = needed;
    } else if (needed == needed_) {
      weight_ += weight;
    } else if (needed == logical_not(needed_)) {
      weight_ = select(needed_, weight_, weight);
      needed_ = 1.0;
    } else {
      weight_ = masked() + mask(needed, weight);
      needed_ = logical_or(needed_, needed);
    }
  }

 private:
  static Expr mask(const Expr& needed, const Expr& weight) { return select(needed, weight, 0.0); }

  Expr weight_ = 0.0;
  Expr needed_ = 0.0;
};

// weight ∂(operation)/∂(operand i). A known weight over a is one operation, and one rounding.
Expr weighted(const Expr& weight, const Operation& operation, int i) {
  if (operation.node.op == Op::log && weight.is_constant()) return weight / operation.operand[0];
  return weight * partial(operation, i);
}

// 2 a, with the 2 in a factor or dividend that is known: no rounding, and one product less.
Expr doubled(const Expr& a) {
  if (a.is_constant()) return 2.0 * a.value();
  const Node& node = a.graph().node(a.node());
  if (node.op == Op::divide)
    if (const Expr known = a.graph().expression(node.a); known.is_constant())
      return 2.0 * known.value() / a.graph().expression(node.b);
  if (node.op == Op::multiply)
    for (const auto& [factor, other] : {std::pair(node.a, node.b), std::pair(node.b, node.a)})
      if (const Expr known = a.graph().expression(factor); known.is_constant())
        return 2.0 * known.value() * a.graph().expression(other);
  return 2.0 * a;
}

using Row = std::vector<std::pair<Index, Expr>>;  // sorted by column

// The union of two rows: combine(entry or 0, entry or 0) in each column.
template <class Combine>
Row merge(const Row& left, const Row& right, const Combine& combine) {
  Row result;
  result.reserve(std::max(left.size(), right.size()));
  auto i = left.begin();
  auto j = right.begin();
  while (i != left.end() || j != right.end()) {
    const bool from_left = j == right.end() || (i != left.end() && i->first <= j->first);
    const bool from_right = i == left.end() || (j != right.end() && j->first <= i->first);
    const Index column = from_left ? i->first : j->first;
    result.emplace_back(
        column, combine(from_left ? i->second : Expr(0.0), from_right ? j->second : Expr(0.0)));
    if (from_left) ++i;
    if (from_right) ++j;
  }
  return result;
}

Row scaled(const Expr& factor, const Row& row) {
  Row result = row;
  for (auto& entry : result) entry.second = factor * entry.second;
  return result;
}

}  // namespace

ExprVector gradient(const Expr& f, const ExprVector& x) {
  return pull_back(ExprVector::Constant(1, f), x, ExprVector::Constant(1, Expr(1.0)));
}

ExprVector pull_back(const ExprVector& y, const ExprVector& x, const ExprVector& w) {
  check_size("pull_back", "w", w.size(), y.size());
  const Subgraph subgraph(y);
  const auto index = indices("pull_back", x, subgraph);
  ExprVector result = ExprVector::Zero(x.size());

  std::vector<Adjoint> adjoint(subgraph.size());
  for (Index i = 0; i < y.size(); ++i)
    if (!y[i].is_constant()) adjoint[subgraph.position(y[i])].add(w[i], 1.0);
  for (std::size_t at = subgraph.size(); at-- > 0;) {
    const Adjoint& here = adjoint[at];
    if (here.is_zero()) continue;
    if (index[at] != kNoIndex) result[index[at]] = here.masked();
    const Operation operation(subgraph, at);
    if (const auto chosen = choice(operation)) {
      adjoint[operation.at[chosen->then]].add(here.weight(),
                                              logical_and(here.needed(), chosen->condition));
      adjoint[operation.at[chosen->otherwise]].add(
          here.weight(), logical_and(here.needed(), logical_not(chosen->condition)));
    } else if (operation.is_square()) {
      adjoint[operation.at[0]].add(doubled(here.weight()) * operation.operand[0], here.needed());
    } else {
      for (int i = 0; i < operation.count; ++i)
        if (!operation.operand[i].is_constant())
          adjoint[operation.at[i]].add(weighted(here.weight(), operation, i), here.needed());
    }
  }
  return result;
}

bool is_affine(const ExprVector& y, const ExprVector& x) {
  const Subgraph subgraph(y);
  const auto index = indices("is_affine", x, subgraph);
  std::vector<char> contains(subgraph.size(), 0);  // an x
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    if (index[at] != kNoIndex) contains[at] = 1;
    const Operation operation(subgraph, at);
    bool of[3] = {};
    for (int i = 0; i < operation.count; ++i)
      of[i] = !operation.operand[i].is_constant() && contains[operation.at[i]] != 0;
    if (!of[0] && !of[1] && !of[2]) continue;
    contains[at] = 1;
    switch (operation.node.op) {
      case Op::negate:
      case Op::add:
      case Op::subtract:
        break;
      case Op::multiply:
        if (of[0] && of[1]) return false;
        break;
      case Op::divide:
        if (of[1]) return false;
        break;
      case Op::select:
        if (of[0]) return false;
        break;
      default:
        return false;
    }
  }
  return true;
}

ExprVector tangent(const ExprVector& y, const ExprVector& x, const ExprVector& dx) {
  check_size("tangent", "dx", dx.size(), x.size());
  const Subgraph subgraph(y);
  const auto index = indices("tangent", x, subgraph);
  std::vector<Expr> dot(subgraph.size());
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    if (index[at] != kNoIndex) dot[at] = dx[index[at]];
    const Operation operation(subgraph, at);
    if (const auto chosen = choice(operation)) {
      dot[at] = select(chosen->condition, dot[operation.at[chosen->then]],
                       dot[operation.at[chosen->otherwise]]);
    } else {
      for (int i = 0; i < operation.count; ++i)
        if (!dot[operation.at[i]].is_constant(0.0))
          dot[at] += partial(operation, i) * dot[operation.at[i]];
    }
  }
  ExprVector result = ExprVector::Zero(y.size());
  for (Index i = 0; i < y.size(); ++i)
    if (!y[i].is_constant()) result[i] = dot[subgraph.position(y[i])];
  return result;
}

ExprMatrix SparseExprMatrix::dense() const {
  ExprMatrix result = ExprMatrix::Zero(rows, cols);
  for (std::size_t k = 0; k < row.size(); ++k)
    result(row[k], col[k]) = values[static_cast<Index>(k)];
  return result;
}

SparseExprMatrix jacobian(const ExprVector& y, const ExprVector& x) {
  const Subgraph subgraph(y);
  const auto index = indices("jacobian", x, subgraph);
  std::vector<Row> rows(subgraph.size());
  // The rows of a sum of n terms, one term longer each, are n²/2 numbers: each is kept until its last use.
  constexpr std::size_t always = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> last_use(subgraph.size(), 0);
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    const Node node = subgraph.graph().node(subgraph.nodes()[at]);
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    for (int i = 0; i < arity(node.op); ++i) last_use[subgraph.position(operands[i])] = at;
  }
  for (Index i = 0; i < y.size(); ++i)
    if (!y[i].is_constant()) last_use[subgraph.position(y[i])] = always;
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    if (index[at] != kNoIndex) rows[at] = {{index[at], 1.0}};
    const Operation operation(subgraph, at);
    if (const auto chosen = choice(operation)) {
      rows[at] =
          merge(rows[operation.at[chosen->then]], rows[operation.at[chosen->otherwise]],
                [&](const Expr& a, const Expr& b) { return select(chosen->condition, a, b); });
    } else {
      for (int i = 0; i < operation.count; ++i) {
        if (rows[operation.at[i]].empty()) continue;
        const Row row = scaled(partial(operation, i), rows[operation.at[i]]);
        rows[at] = merge(rows[at], row, [](const Expr& a, const Expr& b) { return a + b; });
      }
    }
    for (int i = 0; i < operation.count; ++i)
      if (last_use[operation.at[i]] == at) Row().swap(rows[operation.at[i]]);
  }

  SparseExprMatrix result;
  result.rows = y.size();
  result.cols = x.size();
  std::vector<Expr> entries;
  for (Index i = 0; i < y.size(); ++i) {
    if (y[i].is_constant()) continue;
    for (const auto& [column, value] : rows[subgraph.position(y[i])]) {
      if (value.is_constant(0.0)) continue;
      result.row.push_back(i);
      result.col.push_back(column);
      entries.push_back(value);
    }
  }
  result.values = Eigen::Map<ExprVector>(entries.data(), static_cast<Index>(entries.size()));
  return result;
}

namespace {

// The parameter of the same name in another graph; itself where there is none.
Expr moved_parameter(const Expr& parameter, const Graph& target) {
  const std::vector<std::string> names = parameter_names(parameter.graph());
  return parameter_of(target, names[parameter.node()], parameter);
}

}  // namespace

ExprVector substitute(const ExprVector& y, const ExprVector& x, const ExprVector& replacement) {
  check_size("substitute", "replacement", replacement.size(), x.size());
  const Subgraph subgraph(y);
  const auto index = indices("substitute", x, subgraph);
  // Parameters of the graph are those of the graph that this leads to.
  const Graph target = graph_of(replacement);
  std::size_t parameters = 0;
  if (!target.is_none() && !subgraph.graph().is_none() && !(target == subgraph.graph()))
    parameters = parameter_names(subgraph.graph()).size();
  std::vector<Expr> image(subgraph.size());
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    const Operation operation(subgraph, at);
    if (operation.count == 0 && index[at] == kNoIndex && subgraph.nodes()[at] < parameters)
      image[at] = moved_parameter(operation.value, target);
    else if (operation.count == 0)
      image[at] = index[at] != kNoIndex ? replacement[index[at]] : operation.value;
    else
      image[at] = apply(operation.node.op, operation.node.k, image[operation.at[0]],
                        operation.count > 1 ? image[operation.at[1]] : Expr(),
                        operation.count > 2 ? image[operation.at[2]] : Expr());
  }
  ExprVector result = y;
  for (Expr& entry : result)
    if (!entry.is_constant()) entry = image[subgraph.position(entry)];
  return result;
}

Expr substitute(const Expr& y, const ExprVector& x, const ExprVector& replacement) {
  return substitute(ExprVector::Constant(1, y), x, replacement)[0];
}

}  // namespace courant
