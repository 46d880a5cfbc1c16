#include <bit>
#include <stdexcept>

#include "courant/core/expr.hpp"

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

Graph::Graph() : table_(std::size_t{1} << table_bits_) {}

Graph::~Graph() = default;

const Node& Graph::node(std::uint32_t index) const {
  // Chunk i starts at 2^(8+i) - 2^8: with j = index + 2^8, its highest bit names the chunk.
  const std::uint32_t j = index + (1U << kFirstBits);
  const int top = std::bit_width(j) - 1;
  return chunks_[top - kFirstBits][j - (1U << top)];
}

double Graph::constant(std::uint32_t index) const {
  const Node& n = node(index);
  return std::bit_cast<double>((static_cast<std::uint64_t>(n.a) << 32) | n.b);
}

const std::string& Graph::name(std::uint32_t index) const {
  const std::lock_guard lock(mutex_);
  return names_[node(index).a];
}

Expr Graph::expression(std::uint32_t index) {
  return node(index).op == Op::constant ? Expr(constant(index)) : Expr(this, index);
}

Expr Graph::variable(std::string name) {
  const std::lock_guard lock(mutex_);
  names_.push_back(std::move(name));
  return Expr(this, append({Op::variable, 0, static_cast<std::uint32_t>(names_.size() - 1), 0, 0}));
}

ExprVector Graph::variables(const std::string& name, Index size) {
  ExprVector result(size);
  for (Index i = 0; i < size; ++i) result[i] = variable(name + "[" + std::to_string(i) + "]");
  return result;
}

Expr Graph::make(Op op, std::int32_t k, const Expr& a, const Expr& b, const Expr& c) {
  const std::lock_guard lock(mutex_);
  const int operands = arity(op);
  const Node node{op, k, operands > 0 ? operand(a) : 0, operands > 1 ? operand(b) : 0,
                  operands > 2 ? operand(c) : 0};
  return Expr(this, intern(node));
}

std::uint32_t Graph::operand(const Expr& a) {
  if (a.graph_ == this) return a.node_;
  if (a.graph_ != nullptr)
    throw std::invalid_argument(
        "Graph::make: operand is an expression of another graph; expected one graph. Use "
        "substitute.");
  const auto bits = std::bit_cast<std::uint64_t>(a.constant_);
  return intern({Op::constant, 0, static_cast<std::uint32_t>(bits >> 32),
                 static_cast<std::uint32_t>(bits & 0xFFFFFFFFU), 0});
}

std::uint32_t Graph::intern(const Node& wanted) {
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

std::uint32_t Graph::append(const Node& node) {
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
void Graph::grow_table() {
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

}  // namespace courant
