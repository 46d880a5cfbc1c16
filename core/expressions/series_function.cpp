#include "courant/core/expressions/series_function.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/expressions/taylor.hpp"
#include "courant/core/numbers/ball.hpp"

namespace courant {
namespace {

bool is_switching(Op op) {
  switch (op) {
    case Op::abs:
    case Op::sign:
    case Op::min:
    case Op::max:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
      return true;
    default:
      return false;
  }
}

int decided_sign_of(double a) { return a > 0 ? 1 : (a < 0 ? -1 : 0); }
int decided_sign_of(const Digits& a) { return a.shrinks() ? 0 : a.sign(); }
int decided_sign_of(const Ball& a) { return a.sign(); }

// The sign of the first of `count` coefficients of a - b that is not zero; b may be null.
template <class Number>
int first_sign(const Number* a, const Number* b, Index count) {
  for (Index i = 0; i < count; ++i)
    if (const int sign = decided_sign_of(b == nullptr ? a[i] : a[i] - b[i]); sign != 0) return sign;
  return 0;
}

// Whether the sign of a - b is known, and not only not to be told from that of 0.
template <class Number>
bool is_known_sign(const Number* a, const Number* b, Index count) {
  if constexpr (std::is_same_v<Number, Ball>)
    for (Index i = 0; i < count; ++i) {
      const Number difference = b == nullptr ? a[i] : a[i] - b[i];
      if (difference.sign() != 0) return true;
      if (!difference.is_zero()) return false;
    }
  return true;
}

// What a switch puts out where the number that decides it has this sign.
template <class Number>
void put_out_switched(Op op, int sign, Index order, const Number* a, const Number* b, Number* out) {
  const auto copy = [&](const Number* from) { std::copy_n(from, order + 1, out); };
  const auto constant = [&](double value) {
    std::fill_n(out, order + 1, Number(0.0));
    out[0] = value;
  };
  switch (op) {
    case Op::abs:
      if (sign == 0) return constant(0.0);
      for (Index i = 0; i <= order; ++i) out[i] = sign > 0 ? a[i] : -a[i];
      return;
    case Op::min:
      return copy(sign > 0 ? b : a);
    case Op::max:
      return copy(sign < 0 ? b : a);
    case Op::sign:
      return constant(sign);
    case Op::less:
      return constant(sign < 0 ? 1.0 : 0.0);
    case Op::less_equal:
      return constant(sign <= 0 ? 1.0 : 0.0);
    default:
      return constant(sign == 0 ? 1.0 : 0.0);
  }
}

template <class Number>
Number number_as_written(double value) {
  if constexpr (std::is_same_v<Number, double>)
    return value;
  else
    return Number::written(value);
}

}  // namespace

SeriesFunction::SeriesFunction(const std::vector<ExprVector>& inputs, const ExprVector& outputs,
                               Index time) {
  const Subgraph subgraph(outputs);
  const Graph& graph = subgraph.graph();
  const std::vector<std::uint32_t>& nodes = subgraph.nodes();
  constexpr std::uint32_t absent = 0xFFFFFFFFU;
  std::vector<std::uint32_t> slot(nodes.size(), absent);
  std::uint32_t next = 0;
  const auto add_constant = [&](double value) {
    constants_.push_back(value);
    return next++;
  };
  for (std::size_t at = 0; at < nodes.size(); ++at)
    if (graph.node(nodes[at]).op == Op::constant)
      slot[at] = add_constant(graph.constant(nodes[at]));
  std::vector<std::uint32_t> constant_outputs;
  for (const Expr& output : outputs)
    if (output.is_constant()) constant_outputs.push_back(add_constant(output.value()));
  std::vector<bool> of_time_alone(nodes.size(), true);  // or constant
  for (std::size_t g = 0; g < inputs.size(); ++g)
    for (Index j = 0; j < inputs[g].size(); ++j) {
      if (inputs[g][j].is_constant() || !subgraph.contains(inputs[g][j])) continue;
      const std::size_t at = subgraph.position(inputs[g][j]);
      loads_.push_back({next, static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(j)});
      slot[at] = next++;
      of_time_alone[at] = static_cast<Index>(g) == time;
    }
  first_step_ = next;
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const Node& node = graph.node(nodes[at]);
    if (node.op == Op::constant) continue;
    if (node.op == Op::variable) {
      if (slot[at] == absent)
        throw std::invalid_argument("SeriesFunction: the variable " + graph.name(nodes[at]) +
                                    " is in no input group.");
      continue;
    }
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    std::uint32_t source[] = {0, 0, 0};
    bool alone = true;
    for (int i = 0; i < arity(node.op); ++i) {
      const std::size_t from = subgraph.position(operand[i]);
      source[i] = slot[from];
      alone = alone && of_time_alone[from];
    }
    of_time_alone[at] = alone;
    has_switches_ = has_switches_ || is_switching(node.op);
    slot[at] = next++;
    steps_.push_back({node.op, node.k, source[0], source[1], source[2], alone});
  }
  auto constant_output = constant_outputs.begin();
  for (const Expr& output : outputs)
    outputs_.push_back(output.is_constant() ? *constant_output++ : slot[subgraph.position(output)]);
}

template <class Number>
bool SeriesFunction::carry_out(const Number* const* in, Index order, Number* out, int side) const {
  const auto width = static_cast<std::size_t>(order + 1);
  std::vector<Number> slots((first_step_ + steps_.size()) * width, Number(0.0));
  std::vector<Number> scratch(static_cast<std::size_t>(taylor::scratch_size(order)), Number(0.0));
  const auto at = [&](std::uint32_t slot) { return slots.data() + slot * width; };
  for (std::size_t i = 0; i < constants_.size(); ++i)
    slots[i * width] = number_as_written<Number>(constants_[i]);
  for (const Load& load : loads_)
    std::copy_n(in[load.group] + load.index * width, width, at(load.slot));
  bool is_at_edge = false;
  std::uint32_t target = first_step_;
  for (const Step& step : steps_) {
    Number* result = at(target++);
    const Number* a = at(step.a);
    if (is_switching(step.op)) {
      const Number* b = arity(step.op) == 1 ? nullptr : at(step.b);
      const Index looked_at = step.of_time_alone ? order + 1 : 1;
      int sign = first_sign(a, b, looked_at);
      if (!is_known_sign(a, b, looked_at)) is_at_edge = true;
      // Equal numbers are no edge: that of sign(0), of min(x, x).
      if (sign == 0 && !step.of_time_alone) {
        is_at_edge = true;
        sign = side != 0 ? side : first_sign(a, b, step.op == Op::sign ? 1 : order + 1);
      }
      put_out_switched(step.op, sign, order, a, b, result);
    } else if (step.op == Op::select) {
      if (!is_known_sign<Number>(a, nullptr, 1)) is_at_edge = true;
      std::copy_n(decided_sign_of(a[0]) != 0 ? at(step.b) : at(step.c), width, result);
    } else {
      taylor::apply(step.op, step.k, order, a, at(step.b), at(step.c), result, scratch.data());
    }
  }
  for (const std::uint32_t slot : outputs_) out = std::copy_n(at(slot), width, out);
  return is_at_edge;
}

bool SeriesFunction::run(const double* const* in, Index order, double* out, int side) const {
  return carry_out(in, order, out, side);
}

bool SeriesFunction::run(const Digits* const* in, Index order, Digits* out, int side) const {
  return carry_out(in, order, out, side);
}

bool SeriesFunction::run(const Ball* const* in, Index order, Ball* out, int side) const {
  return carry_out(in, order, out, side);
}

}  // namespace courant
