#include <ostream>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/expressions/function_name.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// How tightly a piece of text binds; an operand that binds less tightly than its place asks for
// gets parentheses.
enum Binding : int { kOr, kAnd, kComparison, kSum, kProduct, kNot, kPower, kAtom };

// What is left to write, the next piece last: a text, or an expression, or its negative.
struct Piece {
  const char* text = nullptr;
  Expr expression = {};
  Binding place = kOr;
  bool negated = false;
  bool first =
      true;  // nothing stands before it inside its parentheses: it may begin with a minus sign
};

Binding binding(const Node& node) {
  switch (node.op) {
    case Op::logical_or:
      return kOr;
    case Op::logical_and:
      return kAnd;
    case Op::less:
    case Op::less_equal:
    case Op::equal:
      return kComparison;
    case Op::add:
    case Op::subtract:
      return kSum;
    case Op::negate:
    case Op::multiply:
    case Op::divide:
      return kProduct;
    case Op::logical_not:
      return kNot;
    case Op::power:
    case Op::pow:
      return kPower;
    default:
      return kAtom;
  }
}

class Printer {
 public:
  explicit Printer(std::size_t max_length) : max_length_(max_length) {}

  std::string print(const Expr& a) {
    pieces_.push_back({.expression = a});
    while (!pieces_.empty() && text_.size() <= max_length_) {
      const Piece piece = pieces_.back();
      pieces_.pop_back();
      if (piece.text != nullptr)
        text_ += piece.text;
      else if (piece.expression.is_constant())
        print_number(piece);
      else
        expand(piece);
    }
    if (text_.size() > max_length_) cut();
    return std::move(text_);
  }

 private:
  void cut() {
    std::size_t end = max_length_;
    while (end > 0 && (text_[end] & '\xC0') == '\x80') --end;  // not inside a UTF-8 character
    text_.resize(end);
    text_ += "…";
  }

  void print_number(const Piece& piece) {
    const std::string number =
        exact_text(piece.negated ? -piece.expression.value() : piece.expression.value());
    const bool minus = number.front() == '-';
    text_ += minus && !(piece.first && piece.place <= kProduct) ? "(" + number + ")" : number;
  }

  // Replaces an expression by the pieces that it is made of.
  void expand(const Piece& piece) {
    const Graph& graph = piece.expression.graph();
    const Node& node = graph.node(piece.expression.node());
    if (node.op == Op::variable) {
      text_ += written_name(graph, piece.expression.node());
      return;
    }
    parts_.clear();
    const Binding own = binding(node);
    const bool minus = node.op == Op::negate;
    const bool enclosed = own < piece.place || (minus && !piece.first);
    const bool first = piece.first || enclosed;
    const Expr a = graph.expression(node.a);
    const Expr b = arity(node.op) > 1 ? graph.expression(node.b) : Expr();
    const auto infix = [&](Binding left, const char* sign, Binding right) {
      add(a, left, first);
      add(sign);
      add(b, right, false);
    };

    if (enclosed) add("(");
    switch (node.op) {
      case Op::negate:
        add("-");
        add(a, kProduct, false);
        break;
      case Op::add:
        add_sum(a, b, first);
        break;
      case Op::subtract:
        infix(kSum, " - ", kProduct);
        break;
      case Op::multiply:
        add_product(a, b, first, piece.negated);
        break;
      case Op::divide:
        infix(kProduct, "/", kNot);
        break;
      case Op::less:
        infix(kSum, " < ", kSum);
        break;
      case Op::less_equal:
        infix(kSum, " <= ", kSum);
        break;
      case Op::equal:
        infix(kSum, " == ", kSum);
        break;
      case Op::logical_and:
        infix(kAnd, " && ", kAnd);
        break;
      case Op::logical_or:
        infix(kOr, " || ", kOr);
        break;
      case Op::logical_not:
        add("!");
        add(a, kNot, false);
        break;
      case Op::power:
        add(a, kAtom, false);
        add("^");
        add(node.k, kAtom, false);
        break;
      case Op::pow:
        add(a, kAtom, false);
        add("^");
        add(b, kPower, false);
        break;
      default:
        add_call(graph, node);
    }
    if (enclosed) add(")");
    pieces_.insert(pieces_.end(), parts_.rbegin(), parts_.rend());
  }

  void add(const char* text) { parts_.push_back({.text = text}); }
  void add(const Expr& operand, Binding place, bool first, bool negated = false) {
    parts_.push_back({.expression = operand, .place = place, .negated = negated, .first = first});
  }

  void add_sum(const Expr& a, const Expr& b, bool first) {
    const bool difference = has_negative_factor(b);
    add(a, kSum, first);
    add(difference ? " - " : " + ");
    add(b, kSum, false, difference);
  }

  // The constant first; a square as such.
  void add_product(const Expr& a, const Expr& b, bool first, bool negated) {
    if (a == b) {
      add(a, kAtom, false);
      add("^2");
      return;
    }
    const bool swapped = b.is_constant();
    add(swapped ? b : a, kProduct, first, negated);
    add("*");
    add(swapped ? a : b, kProduct, false);
  }

  void add_call(const Graph& graph, const Node& node) {
    add(function_name(node.op));
    add("(");
    if (node.op == Op::stumpff || node.op == Op::arccos_factor) {
      add(node.k, kOr, true);
      add(", ");
    }
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    for (int i = 0; i < arity(node.op); ++i) {
      if (i > 0) add(", ");
      add(graph.expression(operand[i]), kOr, true);
    }
    add(")");
  }

  // A negative number, or one times something: x + -2*y is written x - 2*y.
  static bool has_negative_factor(const Expr& a) {
    if (a.is_constant()) return a.value() < 0;
    const Node& node = a.graph().node(a.node());
    if (node.op != Op::multiply) return false;
    for (const std::uint32_t operand : {node.b, node.a}) {
      const Expr factor = a.graph().expression(operand);
      if (factor.is_constant()) return factor.value() < 0;
    }
    return false;
  }

  std::size_t max_length_;
  std::string text_;
  std::vector<Piece> pieces_;
  std::vector<Piece> parts_;
};

}  // namespace

std::string to_string(const Expr& a, std::size_t max_length) {
  return Printer(max_length).print(a);
}

std::ostream& operator<<(std::ostream& out, const Expr& a) { return out << to_string(a); }

}  // namespace courant
