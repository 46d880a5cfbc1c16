// Expr: the symbolic scalar in which every formula of the project is written once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "courant/core/linear/products.hpp"
#include "courant/core/numbers/op.hpp"
#include "courant/core/numbers/vectors.hpp"

namespace courant {

// One operation: operands are earlier nodes of the same graph, `k` the integer parameter of power,
// stumpff, arccos_factor.
struct Node {
  Op op;
  std::int32_t k;
  std::uint32_t a, b, c;
};

// Number of operands of an operation (0 to 3).
int arity(Op op);

class Expr;
class NodeStore;

void add_reference(NodeStore* nodes);
void drop_reference(NodeStore* nodes);

// The nodes of some expressions, in topological order (operands before results).
//
// A handle: copies are the same graph, and every expression has one, so that the nodes live as long
// as the last graph or expression of them. Graphs are independent of each other, and one graph may
// be extended from several threads: making a node takes a lock, reading one does not. Room for
// 2³² - 256 nodes.
class Graph {
 public:
  Graph();  // a new graph
  Graph(const Graph& other) : nodes_(other.nodes_) {
    if (nodes_ != nullptr) add_reference(nodes_);
  }
  Graph(Graph&& other) noexcept : nodes_(std::exchange(other.nodes_, nullptr)) {}
  Graph& operator=(Graph other) noexcept {
    std::swap(nodes_, other.nodes_);
    return *this;
  }
  ~Graph() {
    if (nodes_ != nullptr) drop_reference(nodes_);
  }

  // That of a constant, which has no nodes: nothing below may be asked of it.
  static Graph none() { return Graph(nullptr); }
  bool is_none() const { return nodes_ == nullptr; }
  // Whether both are the same graph.
  bool operator==(const Graph& other) const { return nodes_ == other.nodes_; }

  // A new variable; two variables of the same name are different.
  Expr variable(std::string name) const;
  // name[0] … name[size-1]
  Eigen::Matrix<Expr, Eigen::Dynamic, 1> variables(const std::string& name, Index size) const;

  // The node that applies op to operands of this graph, without simplification.
  Expr make(Op op, std::int32_t k, const Expr& a) const;
  Expr make(Op op, std::int32_t k, const Expr& a, const Expr& b) const;
  Expr make(Op op, std::int32_t k, const Expr& a, const Expr& b, const Expr& c) const;

  // Reading, by node number < size(). References stay valid as long as the graph.
  std::uint32_t size() const;
  const Node& node(std::uint32_t index) const;
  double constant(std::uint32_t index) const;          // of a node with Op::constant
  const std::string& name(std::uint32_t index) const;  // of a node with Op::variable
  Expr expression(std::uint32_t index) const;          // the handle; constants come back as numbers

 private:
  explicit Graph(NodeStore* nodes) : nodes_(nodes) {}

  NodeStore* nodes_;
};

// A real number known now (a constant), or a node of a Graph.
//
// Expr is a small value with the arithmetic of a scalar, and works as the scalar of an Eigen
// matrix. Operations on constants are carried out at once, in double; so a formula written on Expr
// and given constants *is* its numeric version. Operations that involve a node make a node of the
// same graph; equal subexpressions are one node (hash-consing), and x+0, 1·x, 0·x, x-x, -(-x) and
// the like are simplified as they are made.
//
// There is no conversion to bool: `if (a < b)` does not compile, and a == b asks whether two
// expressions are the same one. Use select(a < b, x, y), smooth where x and y are and both agree.
// An Expr keeps its graph alive. Operands from two graphs throw std::invalid_argument.
class Expr {
 public:
  Expr() : constant_(0.0) {}
  Expr(double value) : constant_(value) {}               // NOLINT: a number is an expression
  Expr(int value) : Expr(static_cast<double>(value)) {}  // NOLINT: and Eigen writes Scalar(0)

  bool is_constant() const { return graph_.is_none(); }
  bool is_constant(double value) const { return is_constant() && constant_ == value; }
  // The number, if constant; throws std::logic_error otherwise.
  double value() const;

  const Graph& graph() const { return graph_; }  // Graph::none() for a constant
  std::uint32_t node() const { return node_; }   // meaningful only with a graph

  Expr& operator+=(const Expr& other);
  Expr& operator-=(const Expr& other);
  Expr& operator*=(const Expr& other);
  Expr& operator/=(const Expr& other);

 private:
  friend class Graph;
  Expr(Graph graph, std::uint32_t node) : graph_(std::move(graph)), node_(node) {}

  Graph graph_ = Graph::none();
  union {
    double constant_;
    std::uint32_t node_;
  };
};

using ExprVector = Eigen::Matrix<Expr, Eigen::Dynamic, 1>;
using ExprMatrix = Eigen::Matrix<Expr, Eigen::Dynamic, Eigen::Dynamic>;

Expr operator-(const Expr& a);
Expr operator+(const Expr& a, const Expr& b);
Expr operator-(const Expr& a, const Expr& b);
Expr operator*(const Expr& a, const Expr& b);
Expr operator/(const Expr& a, const Expr& b);

Expr sqrt(const Expr& a);
Expr exp(const Expr& a);
Expr log(const Expr& a);
Expr sin(const Expr& a);
Expr cos(const Expr& a);
Expr tan(const Expr& a);
Expr asin(const Expr& a);
Expr acos(const Expr& a);
Expr atan(const Expr& a);
Expr sinh(const Expr& a);
Expr cosh(const Expr& a);
Expr tanh(const Expr& a);
Expr abs(const Expr& a);
Expr sign(const Expr& a);  // -1, 0 or 1
Expr pow(const Expr& a, const Expr& b);
Expr pow(const Expr& a, int k);
Expr square(const Expr& a);
Expr atan2(const Expr& y, const Expr& x);
Expr min(const Expr& a, const Expr& b);
Expr max(const Expr& a, const Expr& b);
// What exponentials and logarithms need to be smooth at the zero section, to every order
// (core/numbers/special_functions.hpp):
//   c_k(s) = Σ_{i≥0} (-s)^i / (2i+k)!,  k ≥ 0:  c_0(θ²) = cos θ, c_1(θ²) = sin θ / θ, c_2(θ²) = (1 - cos θ) / θ²
Expr stumpff(int k, const Expr& s);
//   the k-th derivative of g(c) = arccos(c) / √(1 - c²), c > -1:  g(cos θ) = θ / sin θ
Expr arccos_factor(int k, const Expr& c);

// Conditions, as numbers 1 and 0.
Expr operator<(const Expr& a, const Expr& b);
Expr operator<=(const Expr& a, const Expr& b);
Expr operator>(const Expr& a, const Expr& b);
Expr operator>=(const Expr& a, const Expr& b);
Expr equal(const Expr& a, const Expr& b);
Expr logical_and(const Expr& a, const Expr& b);
Expr logical_or(const Expr& a, const Expr& b);
Expr logical_not(const Expr& a);
Expr select(const Expr& condition, const Expr& then, const Expr& otherwise);

// The function named by op, with the simplifications above: how an expression is rebuilt from its
// nodes.
Expr apply(Op op, std::int32_t k, const Expr& a, const Expr& b, const Expr& c);

// Whether a and b are the same expression (the same constant, or after hash-consing the same node),
// not whether their values agree: that is equal(a, b).
bool operator==(const Expr& a, const Expr& b);

// Constants from numbers, and numbers from constants (throws std::logic_error where an entry is not
// constant).
template <class Derived>
auto constants(const Eigen::MatrixBase<Derived>& values) {
  return values.template cast<Expr>().eval();
}
template <class Derived>
auto values(const Eigen::MatrixBase<Derived>& x) {
  return x.unaryExpr([](const Expr& entry) { return entry.value(); }).eval();
}

// Infix form, for people and error messages; shared subexpressions are written out, cut off after
// `max_length` characters.
std::string to_string(const Expr& a, std::size_t max_length = 2000);
std::ostream& operator<<(std::ostream& out, const Expr& a);

}  // namespace courant

namespace Eigen {
template <>
struct NumTraits<courant::Expr> : GenericNumTraits<courant::Expr> {
  using Real = courant::Expr;
  using NonInteger = courant::Expr;
  using Nested = courant::Expr;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 8,
    MulCost = 8
  };
  static Real epsilon() { return std::numeric_limits<double>::epsilon(); }
  static Real dummy_precision() { return 1e-12; }
  static int digits10() { return std::numeric_limits<double>::digits10; }
};
// Numbers and expressions in one formula: 2.0 * x, x / 2.0, VectorXd + ExprVector.
template <class Operation>
struct ScalarBinaryOpTraits<double, courant::Expr, Operation> {
  using ReturnType = courant::Expr;
};
template <class Operation>
struct ScalarBinaryOpTraits<courant::Expr, double, Operation> {
  using ReturnType = courant::Expr;
};
}  // namespace Eigen

namespace courant {

// Products of matrices of expressions, compiled once rather than instantiated from Eigen's in every
// file that multiplies; zeros are skipped. They are evaluated at once, so that A * x may be
// assigned to x.
ExprMatrix product(const ExprMatrix& A, const ExprMatrix& B);
ExprVector product(const ExprMatrix& A, const ExprVector& x);

template <class A>
concept ExprMatrixLike =
    std::is_base_of_v<Eigen::MatrixBase<A>, A> && std::is_same_v<typename A::Scalar, Expr>;

template <class A>
concept NumberMatrixLike =
    std::is_base_of_v<Eigen::MatrixBase<A>, A> && std::is_same_v<typename A::Scalar, double>;

template <ExprMatrixLike A, ExprMatrixLike B>
auto operator*(const A& left, const B& right) {
  if constexpr (B::ColsAtCompileTime == 1)
    return product(ExprMatrix(left), ExprVector(right));
  else
    return product(ExprMatrix(left), ExprMatrix(right));
}
template <NumberMatrixLike A, ExprMatrixLike B>
auto operator*(const A& left, const B& right) {
  return constants(left) * right;
}
template <ExprMatrixLike A, NumberMatrixLike B>
auto operator*(const A& left, const B& right) {
  return left * constants(right);
}

}  // namespace courant
