#include <atomic>
#include <bit>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {
namespace {

constexpr std::uint32_t kMaxNodes = std::numeric_limits<std::uint32_t>::max() - 256;

std::uint64_t mix(std::uint64_t h, std::uint64_t value) {
  h ^= value;
  h *= 0x9E3779B97F4A7C15ULL;
  return h ^ (h >> 29);
}

bool commutes(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::equal || op == Op::logical_and ||
         op == Op::logical_or;
}

// The same for a + b and b + a, which are one node, written as it was first.
std::uint64_t hash(const Node& node) {
  const bool swapped = commutes(node.op) && node.b < node.a;
  const std::uint64_t a = swapped ? node.b : node.a;
  const std::uint64_t b = swapped ? node.a : node.b;
  std::uint64_t h = static_cast<std::uint64_t>(node.op) + 1;
  h = mix(h, static_cast<std::uint32_t>(node.k));
  h = mix(h, (a << 32) | b);
  return mix(h, node.c) * 0x9E3779B97F4A7C15ULL;
}

bool same(const Node& x, const Node& y) {
  if (x.op != y.op || x.k != y.k || x.c != y.c) return false;
  return (x.a == y.a && x.b == y.b) || (commutes(x.op) && x.a == y.b && x.b == y.a);
}

// A number, or a node of the graph.
struct Operand {
  bool is_node;
  std::uint32_t node = 0;
  double value = 0.0;
};

}  // namespace

int arity(Op op) {
  switch (op) {
    case Op::constant:
    case Op::variable:
      return 0;
    case Op::select:
      return 3;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::pow:
    case Op::atan2:
    case Op::min:
    case Op::max:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::logical_and:
    case Op::logical_or:
      return 2;
    default:
      return 1;
  }
}

// Where the nodes are; never moves, as chunks never do.
class NodeStore {
 public:
  NodeStore() : table_(std::size_t{1} << table_bits_) {}

  std::uint32_t size() const { return size_.load(std::memory_order_acquire); }
  const Node& node(std::uint32_t index) const {
    // Chunk i starts at 2^(8+i) - 2^8: with j = index + 2^8, its highest bit names the chunk.
    const std::uint32_t j = index + (1U << kFirstBits);
    const int top = std::bit_width(j) - 1;
    return chunks_[top - kFirstBits][j - (1U << top)];
  }
  const std::string& name(std::uint32_t index) const {
    const std::lock_guard lock(mutex_);
    return names_[node(index).a];
  }

  std::uint32_t add_variable(std::string name) {
    const std::lock_guard lock(mutex_);
    names_.push_back(std::move(name));
    return append({Op::variable, 0, static_cast<std::uint32_t>(names_.size() - 1), 0, 0});
  }
  // The node op(operands), for as many operands as the operation has.
  std::uint32_t add_operation(Op op, std::int32_t k, const Operand (&operands)[3]) {
    const std::lock_guard lock(mutex_);
    std::uint32_t number[3] = {0, 0, 0};
    for (int i = 0; i < arity(op); ++i)
      number[i] = operands[i].is_node ? operands[i].node : constant(operands[i].value);
    return intern({op, k, number[0], number[1], number[2]});
  }

  void add_reference() { references_.fetch_add(1, std::memory_order_relaxed); }
  // Whether that was the last one.
  bool drop_reference() { return references_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

 private:
  static constexpr int kFirstBits = 8;  // chunk i holds 2^(8+i) nodes, so that nodes never move

  struct Entry {
    std::uint32_t tag = 0;   // upper half of the hash; its upper bits are the slot to look at first
    std::uint32_t node = 0;  // number + 1; 0: empty
  };

  std::uint32_t constant(double value);
  std::uint32_t intern(const Node& node);
  std::uint32_t append(const Node& node);
  void grow_table();
  std::size_t first_slot(std::uint32_t tag) const { return tag >> (32 - table_bits_); }

  std::atomic<std::size_t> references_ = 1;
  mutable std::mutex mutex_;
  std::atomic<std::uint32_t> size_ = 0;
  std::unique_ptr<Node[]> chunks_[32 - kFirstBits];
  int table_bits_ = 8;
  std::vector<Entry> table_;  // 2^table_bits_ slots, open addressing
  std::deque<std::string> names_;
};

std::uint32_t NodeStore::constant(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return intern({Op::constant, 0, static_cast<std::uint32_t>(bits >> 32),
                 static_cast<std::uint32_t>(bits & 0xFFFFFFFFU), 0});
}

std::uint32_t NodeStore::intern(const Node& wanted) {
  if (2 * static_cast<std::size_t>(size()) >= table_.size() && table_bits_ < 32) grow_table();
  const auto tag = static_cast<std::uint32_t>(hash(wanted) >> 32);
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = first_slot(tag);
  while (table_[slot].node != 0) {
    const std::uint32_t index = table_[slot].node - 1;
    if (table_[slot].tag == tag && same(node(index), wanted)) return index;
    slot = (slot + 1) & mask;
  }
  const std::uint32_t index = append(wanted);
  table_[slot] = {tag, index + 1};
  return index;
}

std::uint32_t NodeStore::append(const Node& node) {
  const std::uint32_t index = size_.load(std::memory_order_relaxed);
  if (index >= kMaxNodes) throw std::length_error("Graph: more than 2^32 - 256 nodes.");
  const std::uint32_t j = index + (1U << kFirstBits);
  const int top = std::bit_width(j) - 1;
  auto& chunk = chunks_[top - kFirstBits];
  if (!chunk) chunk = std::make_unique_for_overwrite<Node[]>(std::size_t{1} << top);
  chunk[j - (1U << top)] = node;
  size_.store(index + 1, std::memory_order_release);
  return index;
}

// Slots are in the order of tags, so this goes through both tables from front to back.
void NodeStore::grow_table() {
  std::vector<Entry> old(2 * table_.size());
  old.swap(table_);
  ++table_bits_;
  const std::size_t mask = table_.size() - 1;
  for (const Entry& entry : old) {
    if (entry.node == 0) continue;
    std::size_t slot = first_slot(entry.tag);
    while (table_[slot].node != 0) slot = (slot + 1) & mask;
    table_[slot] = entry;
  }
}

void add_reference(NodeStore* nodes) { nodes->add_reference(); }

void drop_reference(NodeStore* nodes) {
  if (nodes->drop_reference()) delete nodes;
}

Graph::Graph() : nodes_(new NodeStore) {}

std::uint32_t Graph::size() const { return nodes_->size(); }

const Node& Graph::node(std::uint32_t index) const { return nodes_->node(index); }

double Graph::constant(std::uint32_t index) const {
  const Node& n = node(index);
  return std::bit_cast<double>((static_cast<std::uint64_t>(n.a) << 32) | n.b);
}

const std::string& Graph::name(std::uint32_t index) const { return nodes_->name(index); }

Expr Graph::expression(std::uint32_t index) const {
  return node(index).op == Op::constant ? Expr(constant(index)) : Expr(*this, index);
}

Expr Graph::variable(std::string name) const {
  return Expr(*this, nodes_->add_variable(std::move(name)));
}

ExprVector Graph::variables(const std::string& name, Index size) const {
  ExprVector result(size);
  for (Index i = 0; i < size; ++i) result[i] = variable(name + "[" + std::to_string(i) + "]");
  return result;
}

Expr Graph::make(Op op, std::int32_t k, const Expr& a) const { return make(op, k, a, {}, {}); }

Expr Graph::make(Op op, std::int32_t k, const Expr& a, const Expr& b) const {
  return make(op, k, a, b, {});
}

Expr Graph::make(Op op, std::int32_t k, const Expr& a, const Expr& b, const Expr& c) const {
  const auto operand = [&](const Expr& x) -> Operand {
    if (x.is_constant()) return {.is_node = false, .value = x.constant_};
    if (x.graph_ == *this) return {.is_node = true, .node = x.node_};
    throw std::invalid_argument(
        "Graph::make: operand is an expression of another graph; expected one graph. Use "
        "substitute.");
  };
  return Expr(*this, nodes_->add_operation(op, k, {operand(a), operand(b), operand(c)}));
}

}  // namespace courant
