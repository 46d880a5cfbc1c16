#include "courant/core/program.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "courant/core/operation.hpp"
#include "courant/core/quadruple.hpp"
#include "courant/core/subgraph.hpp"
#include "courant/core/taylor.hpp"

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

template <Op op, class Instruction>
void carry_out(std::int32_t k, const Instruction* begin, const Instruction* end, double* w) {
  for (const Instruction* i = begin; i != end; ++i)
    w[i->target] = evaluate(op, k, w[i->a], w[i->b], w[i->c]);
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
      loads_.push_back({target, static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(j)});
    }
  }
  for (Index j = 0; j < held.size(); ++j) {
    if (!subgraph.contains(held[j])) continue;
    slot[subgraph.position(held[j])] = next;
    loads_.push_back(
        {next++, static_cast<std::uint32_t>(inputs.size()), static_cast<std::uint32_t>(j)});
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

  auto constant_output = constant_outputs.begin();
  for (const Expr& output : outputs)
    outputs_.push_back(output.is_constant() ? *constant_output++ : slot[subgraph.position(output)]);
}

void Program::run(const double* const* in, double* out) const {
  constexpr auto loop = loops<Instruction>(std::make_index_sequence<kOpCount>());
  double* w = workspace<double>(slots_);
  std::copy(constants_.begin(), constants_.end(), w);
  for (const Load& load : loads_) w[load.slot] = in[load.group][load.index];
  const Instruction* begin = instructions_.data();
  for (const Run& run : runs_) {
    const Instruction* end = instructions_.data() + run.end;
    loop[static_cast<std::size_t>(run.op)](run.k, begin, end, w);
    begin = end;
  }
  for (const std::uint32_t slot : outputs_) *out++ = w[slot];
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
    std::copy_n(in[load.group] + load.index * width, width, w + load.slot * width);
  std::size_t i = 0;
  for (const Run& run : runs_)
    for (; i < run.end; ++i) {
      const Instruction& x = instructions_[i];
      taylor::apply(run.op, run.k, order, w + x.a * width, w + x.b * width, w + x.c * width,
                    w + x.target * width, scratch);
    }
  for (const std::uint32_t slot : outputs_) {
    std::copy_n(w + slot * width, width, out);
    out += width;
  }
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
