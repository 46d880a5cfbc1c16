#include "courant/core/expressions/program.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/expressions/taylor.hpp"
#include "courant/core/numbers/operation.hpp"
#include "courant/core/numbers/quadruple.hpp"

namespace courant {
namespace {

constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

// One buffer a thread, grown and never shrunk: evaluation is reentrant between threads and doesn't
// allocate.
template <class Number>
Number* workspace(std::size_t size) {
  thread_local std::vector<Number> buffer;
  if (buffer.size() < size) buffer.resize(size);
  return buffer.data();
}

template <class Number>
Number constant_number(double value) {
  if constexpr (std::is_same_v<Number, Uncertain>)
    return Uncertain::rounded(value);
  else
    return value;
}

// Adds the operations among nodes [begin, end) of a subgraph to `order`, operands first and equal
// operations together as far as that lets them.
void schedule(const Subgraph& subgraph, std::size_t begin, std::size_t end,
              std::vector<std::size_t>& order) {
  struct Use {
    std::size_t user,
        next;  // a list of users for each node; next is a place in `uses`, 0 at the end
  };
  std::vector<Use> uses(1);
  std::vector<std::size_t> first_use(end - begin, 0);
  std::vector<int> missing(end - begin, 0);  // operands that aren't carried out yet
  std::map<std::pair<Op, std::int32_t>, std::vector<std::size_t>> ready;

  const auto operation = [&](std::size_t at) -> const Node& {
    return subgraph.graph().node(subgraph.nodes()[at]);
  };
  const auto count = [&](std::size_t at) { return subgraph.operand_count(subgraph.nodes()[at]); };
  for (std::size_t at = begin; at < end; ++at) {
    const Node& node = operation(at);
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    for (int i = 0; i < count(at); ++i) {
      const std::size_t from = subgraph.position(operand[i]);
      if (from < begin || count(from) == 0) continue;
      ++missing[at - begin];
      uses.push_back({at, std::exchange(first_use[from - begin], uses.size())});
    }
    if (count(at) > 0 && missing[at - begin] == 0) ready[{node.op, node.k}].push_back(at);
  }

  for (;;) {
    const auto most = std::max_element(
        ready.begin(), ready.end(),
        [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    if (most == ready.end() || most->second.empty()) return;
    std::vector<std::size_t>& run = most->second;
    for (std::size_t i = 0; i < run.size(); ++i) {  // grows meanwhile
      order.push_back(run[i]);
      for (std::size_t use = first_use[run[i] - begin]; use != 0; use = uses[use].next) {
        const std::size_t user = uses[use].user;
        if (--missing[user - begin] == 0)
          ready[{operation(user).op, operation(user).k}].push_back(user);
      }
    }
    run.clear();
  }
}

std::vector<std::size_t> schedule(const Subgraph& subgraph, Program::Order wanted) {
  // Equal operations are far apart in large programs; windows keep the number of live values small.
  const std::size_t window = wanted == Program::Order::grouped ? 4096 : 1;
  std::vector<std::size_t> order;
  for (std::size_t begin = 0; begin < subgraph.size(); begin += window)
    schedule(subgraph, begin, std::min(begin + window, subgraph.size()), order);
  return order;
}

// Flat: in a large translation unit GCC would leave evaluate() a call with a choice among all operations.
template <Op op, class Instruction>
[[gnu::flatten]] void carry_out(std::int32_t k, const Instruction* begin, const Instruction* end,
                                double* w) {
  for (const Instruction* i = begin; i != end; ++i)
    w[i->target] = evaluate(op, k, w[i->a], w[i->b], w[i->c]);
}

// Fewer instructions are carried out one by one.
constexpr std::size_t kLeastEven = 8;

bool has_even_loop(Op op) {
  return op == Op::negate || op == Op::add || op == Op::subtract || op == Op::multiply ||
         op == Op::divide;
}

// `count` results of operands that are so many slots apart, without instructions to be read. The order is that of the
// instructions: a result may be an operand of a later one.
template <Op op, int stride_a, int stride_b>
[[gnu::flatten]] void carry_out_evenly(std::size_t count, const double* a, const double* b,
                                       double* target) {
  const auto n = static_cast<std::ptrdiff_t>(count);
  for (std::ptrdiff_t i = 0; i < n; ++i)
    target[i] = evaluate(op, 0, a[i * stride_a], b[i * stride_b], 0.0);
}

template <Op op>
void carry_out_evenly(int stride_a, int stride_b, std::size_t count, const double* a,
                      const double* b, double* target) {
  using Loop = void (*)(std::size_t, const double*, const double*, double*);
  constexpr Loop loops[3][3] = {
      {carry_out_evenly<op, -1, -1>, carry_out_evenly<op, -1, 0>, carry_out_evenly<op, -1, 1>},
      {carry_out_evenly<op, 0, -1>, carry_out_evenly<op, 0, 0>, carry_out_evenly<op, 0, 1>},
      {carry_out_evenly<op, 1, -1>, carry_out_evenly<op, 1, 0>, carry_out_evenly<op, 1, 1>}};
  loops[stride_a + 1][stride_b + 1](count, a, b, target);
}

// The same with results that go down the workspace, where one of them may be an operand that came before.
template <Op op>
[[gnu::flatten]] void carry_out_downwards(int stride_a, int stride_b, std::size_t count,
                                          const double* a, const double* b, double* target) {
  for (; count > 0; --count, a += stride_a, b += stride_b, --target)
    *target = evaluate(op, 0, *a, *b, 0.0);
}

// Calls loop<op>().
template <class Loop>
void with_even_operation(Op op, const Loop& loop) {
  switch (op) {
    case Op::negate:
      return loop.template operator()<Op::negate>();
    case Op::add:
      return loop.template operator()<Op::add>();
    case Op::subtract:
      return loop.template operator()<Op::subtract>();
    case Op::multiply:
      return loop.template operator()<Op::multiply>();
    default:
      return loop.template operator()<Op::divide>();
  }
}

// Returns where the copy ends. Of few numbers without a call.
double* copy(const double* from, std::uint32_t count, double* to) {
  constexpr std::uint32_t kFew = 8;
  if (count > kFew) return std::copy_n(from, count, to);
  for (std::uint32_t i = 0; i < count; ++i) *to++ = *from++;
  return to;
}

// One loop for each operation.
template <class Instruction, std::size_t... op>
constexpr auto loops(std::index_sequence<op...>) {
  using Loop = void (*)(std::int32_t, const Instruction*, const Instruction*, double*);
  return std::array<Loop, sizeof...(op)>{carry_out<static_cast<Op>(op), Instruction>...};
}

}  // namespace

Program::Program(std::span<const ExprVector> inputs, const ExprVector& outputs,
                 const ExprVector& held, Order order) {
  const Subgraph subgraph(outputs, held);
  const Graph& graph = subgraph.graph();
  const auto& nodes = subgraph.nodes();
  std::vector<std::uint32_t> slot(nodes.size(), kAbsent);
  std::uint32_t next = 0;

  for (std::size_t at = 0; at < nodes.size(); ++at) {
    if (graph.node(nodes[at]).op != Op::constant) continue;
    slot[at] = next++;
    constants_.push_back(graph.constant(nodes[at]));
  }
  std::vector<std::uint32_t> constant_outputs;
  for (const Expr& output : outputs) {
    if (!output.is_constant()) continue;
    constant_outputs.push_back(next++);
    constants_.push_back(output.value());
  }

  for (std::size_t g = 0; g < inputs.size(); ++g) {
    for (Index j = 0; j < inputs[g].size(); ++j) {
      const Expr& variable = inputs[g][j];
      const auto fail = [&](const std::string& what) {
        throw std::invalid_argument("Program: input " + std::to_string(g) + ", entry " +
                                    std::to_string(j) + " is " + to_string(variable, 40) + what);
      };
      if (variable.is_constant() || variable.graph().node(variable.node()).op != Op::variable)
        fail("; expected a variable.");
      if (!subgraph.contains(variable)) continue;
      std::uint32_t& target = slot[subgraph.position(variable)];
      if (target != kAbsent) fail(", which is an input already; expected each variable once.");
      target = next++;
      load(target, g, j);
    }
  }
  for (Index j = 0; j < held.size(); ++j) {
    if (!subgraph.contains(held[j])) continue;
    slot[subgraph.position(held[j])] = next;
    load(next++, inputs.size(), j);
  }
  for (std::size_t at = 0; at < nodes.size(); ++at)
    if (slot[at] == kAbsent && graph.node(nodes[at]).op == Op::variable)
      throw std::invalid_argument("Program: the variable " + graph.name(nodes[at]) +
                                  " is in no input group.");

  // How often each value is still to be read; outputs are never free.
  std::vector<std::uint32_t> reads(nodes.size(), 0);
  for (const std::uint32_t index : nodes) {
    const Node& node = graph.node(index);
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    for (int i = 0; i < subgraph.operand_count(index); ++i) ++reads[subgraph.position(operand[i])];
  }
  for (const Expr& output : outputs)
    if (!output.is_constant()) ++reads[subgraph.position(output)];

  std::vector<std::uint32_t> free_slots;
  for (const std::size_t at : schedule(subgraph, order)) {
    const Node& node = graph.node(nodes[at]);
    if (runs_.empty() || runs_.back().op != node.op || runs_.back().k != node.k)
      runs_.push_back({node.op, node.k, 0});
    if (free_slots.empty()) free_slots.push_back(next++);
    slot[at] = free_slots.back();
    free_slots.pop_back();
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    std::uint32_t source[] = {0, 0, 0};
    for (int i = 0; i < arity(node.op); ++i) {
      const std::size_t from = subgraph.position(operand[i]);
      source[i] = slot[from];
      if (--reads[from] == 0 && subgraph.operand_count(operand[i]) > 0)
        free_slots.push_back(source[i]);
    }
    instructions_.push_back({slot[at], source[0], source[1], source[2]});
    runs_.back().end = instructions_.size();
  }
  slots_ = next;
  find_stretches();

  auto constant_output = constant_outputs.begin();
  outputs_ = outputs.size();
  for (const Expr& output : outputs) {
    const std::uint32_t from =
        output.is_constant() ? *constant_output++ : slot[subgraph.position(output)];
    if (!stores_.empty() && stores_.back().slot + stores_.back().count == from)
      ++stores_.back().count;
    else
      stores_.push_back({from, 1});
  }
}

// Numbers that are side by side in a group and in the workspace are one load.
void Program::load(std::uint32_t slot, std::size_t group, Index index) {
  const auto g = static_cast<std::uint32_t>(group), i = static_cast<std::uint32_t>(index);
  if (!loads_.empty()) {
    Load& last = loads_.back();
    if (last.group == g && last.slot + last.count == slot && last.index + last.count == i) {
      ++last.count;
      return;
    }
  }
  loads_.push_back({slot, g, i, 1});
}

// The even stretch that instructions [begin, end) of a run are, or one that is not. Where results go down the
// workspace, the last one comes first if no operand is a result of another of these instructions.
Program::Stretch Program::even_stretch(std::size_t begin, std::size_t end, const Run& run) const {
  Stretch result;
  result.op = run.op;
  result.k = run.k;
  result.end = end;
  if (end - begin < kLeastEven || !has_even_loop(run.op)) return result;
  const Instruction &first = instructions_[begin], &next = instructions_[begin + 1],
                    &last = instructions_[end - 1];
  const auto stride = [](std::uint32_t from, std::uint32_t to) {
    return static_cast<std::int64_t>(to) - from;
  };
  const std::int64_t target = stride(first.target, next.target);
  std::int64_t a = stride(first.a, next.a), b = stride(first.b, next.b);
  if (std::abs(target) != 1 || std::abs(a) > 1 || std::abs(b) > 1) return result;
  const auto is_apart = [&](std::uint32_t from, std::uint32_t to) {
    return std::max(from, to) < last.target || std::min(from, to) > first.target;
  };
  const auto is_safe = [&](std::uint32_t from, std::uint32_t to) {
    return is_apart(from, to) || (from == first.target && to == last.target);
  };
  const bool is_turned =
      target < 0 && is_safe(first.a, last.a) && (arity(run.op) == 1 || is_safe(first.b, last.b));
  const Instruction& lowest = is_turned ? last : first;
  if (is_turned) {
    a = -a;
    b = -b;
  }
  result.stride = static_cast<std::int8_t>(is_turned ? 1 : target);
  result.target = lowest.target;
  result.a = lowest.a;
  result.b = lowest.b;
  result.stride_a = static_cast<std::int8_t>(a);
  result.stride_b = static_cast<std::int8_t>(b);
  return result;
}

void Program::find_stretches() {
  std::size_t begin = 0;
  const auto step = [&](std::size_t i) {
    const Instruction &from = instructions_[i - 1], &to = instructions_[i];
    return std::array{to.target - from.target, to.a - from.a, to.b - from.b};
  };
  for (const Run& run : runs_) {
    const auto add = [&](const Stretch& stretch) {
      const bool goes_on = stretch.stride == 0 && begin > 0 && stretches_.back().stride == 0 &&
                           stretches_.back().op == run.op && stretches_.back().k == run.k;
      if (goes_on)
        stretches_.back().end = stretch.end;
      else
        stretches_.push_back(stretch);
    };
    while (begin < run.end) {
      std::size_t end = begin + 1;
      while (end < run.end && step(end) == step(begin + 1)) ++end;
      Stretch stretch = even_stretch(begin, end, run);
      // The last one may belong to the next stretch.
      if (stretch.stride == 0) stretch.end = std::max(begin + 1, end - 1);
      add(stretch);
      begin = stretch.end;
    }
  }
}

void Program::run(const double* const* in, double* out) const {
  constexpr auto loop = loops<Instruction>(std::make_index_sequence<kOpCount>());
  double* w = workspace<double>(slots_);
  std::copy(constants_.begin(), constants_.end(), w);
  for (const auto& [slot, group, index, count] : loads_) copy(in[group] + index, count, w + slot);
  const Instruction* begin = instructions_.data();
  for (const Stretch& x : stretches_) {
    const Instruction* end = instructions_.data() + x.end;
    const auto count = static_cast<std::size_t>(end - begin);
    if (x.stride == 0)
      loop[static_cast<std::size_t>(x.op)](x.k, begin, end, w);
    else
      with_even_operation(x.op, [&]<Op op>() {
        (x.stride > 0 ? carry_out_evenly<op> : carry_out_downwards<op>)(x.stride_a, x.stride_b,
                                                                        count, w + x.a, w + x.b,
                                                                        w + x.target);
      });
    begin = end;
  }
  for (const auto& [slot, count] : stores_) out = copy(w + slot, count, out);
}

template <class Number>
void Program::carry_out_taylor(const Number* const* in, Index order, Number* out) const {
  const auto width = static_cast<std::size_t>(order + 1);
  Number* w =
      workspace<Number>(slots_ * width + static_cast<std::size_t>(taylor::scratch_size(order)));
  Number* scratch = w + slots_ * width;
  for (std::size_t i = 0; i < constants_.size(); ++i) {
    std::fill_n(w + i * width, width, Number(0.0));
    w[i * width] = constant_number<Number>(constants_[i]);
  }
  for (const Load& load : loads_)
    std::copy_n(in[load.group] + load.index * width, load.count * width, w + load.slot * width);
  std::size_t i = 0;
  for (const Run& run : runs_)
    for (; i < run.end; ++i) {
      const Instruction& x = instructions_[i];
      taylor::apply(run.op, run.k, order, w + x.a * width, w + x.b * width, w + x.c * width,
                    w + x.target * width, scratch);
    }
  for (const auto& [slot, count] : stores_) out = std::copy_n(w + slot * width, count * width, out);
}

void Program::run_taylor(const double* const* in, Index order, double* out) const {
  carry_out_taylor(in, order, out);
}

void Program::run_taylor(const Uncertain* const* in, Index order, Uncertain* out) const {
  carry_out_taylor(in, order, out);
}

void Program::run_taylor(const Quadruple* const* in, Index order, Quadruple* out) const {
  carry_out_taylor(in, order, out);
}

}  // namespace courant
