// Products of matrices and vectors of numbers, compiled once.
#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace courant {

// Eigen makes some fifteen types of each A * B, and compiles them anew in every file that multiplies:
// that was a third of the compiler's time. In this namespace products of matrices whose sizes are
// known at run time are calls of these functions. They are evaluated at once, by the same kernels, so
// that A * x may be assigned to x. Products of other operands (fixed sizes, diagonals, multiples) are
// Eigen's.
//
// Each call allocates its result. What runs in every step names the operator of Eigen, by the same
// kernels into numbers that are there already: y.noalias() = A.operator*(x).

namespace products {

using ConstMatrixRef = Eigen::Ref<const Eigen::MatrixXd>;
using ConstVectorRef = Eigen::Ref<const Eigen::VectorXd>;

Eigen::VectorXd plain(const ConstMatrixRef& A, const ConstVectorRef& x);       // A x
Eigen::VectorXd transposed(const ConstMatrixRef& A, const ConstVectorRef& x);  // Aᵀ x
Eigen::MatrixXd outer(const ConstVectorRef& x, const ConstVectorRef& y);       // x yᵀ

// A B, where `left_transposed` says that Aᵀ is meant, `right_transposed` Bᵀ.
Eigen::MatrixXd of(const ConstMatrixRef& A, bool left_transposed, const ConstMatrixRef& B,
                   bool right_transposed);

enum class Kind { other, vector, matrix };

// What a type of Eigen is: columns that lie side by side in memory, or something else.
template <class A>
inline constexpr Kind kind = Kind::other;
template <class A>
inline constexpr Kind kind<const A> = kind<A>;
template <>
inline constexpr Kind kind<Eigen::VectorXd> = Kind::vector;
template <>
inline constexpr Kind kind<Eigen::MatrixXd> = Kind::matrix;
template <class A>
inline constexpr Kind kind<Eigen::Ref<A>> = kind<A>;
template <class A>
inline constexpr Kind kind<Eigen::Map<A>> = kind<A>;
template <class A>
inline constexpr Kind kind<Eigen::VectorBlock<A, Eigen::Dynamic>> =
    kind<A> == Kind::vector ? Kind::vector : Kind::other;
template <class A, bool whole_columns>
inline constexpr Kind kind<Eigen::Block<A, Eigen::Dynamic, Eigen::Dynamic, whole_columns>> =
    kind<A> == Kind::matrix ? Kind::matrix : Kind::other;
template <class A, bool whole_columns>
inline constexpr Kind kind<Eigen::Block<A, Eigen::Dynamic, 1, whole_columns>> =
    kind<A> == Kind::other ? Kind::other : Kind::vector;

// Sums, differences and absolute values of such are evaluated first, as Eigen does.
template <class A, class B>
inline constexpr Kind
    kind<Eigen::CwiseBinaryOp<Eigen::internal::scalar_sum_op<double, double>, A, B>> = kind<A>;
template <class A, class B>
inline constexpr Kind
    kind<Eigen::CwiseBinaryOp<Eigen::internal::scalar_difference_op<double, double>, A, B>> =
        kind<A>;
template <class A>
inline constexpr Kind kind<Eigen::CwiseUnaryOp<Eigen::internal::scalar_abs_op<double>, A>> =
    kind<A>;
template <class A>
inline constexpr Kind kind<Eigen::CwiseUnaryOp<Eigen::internal::scalar_abs2_op<double>, A>> =
    kind<A>;

// A factor of a product: what its numbers are, and the matrix that a transposed one is the transpose of.
template <class A>
struct Factor {
  static constexpr Kind kind = products::kind<A>;
  static constexpr bool is_transposed = false;
  static const A& of(const A& a) { return a; }
};
template <class A>
struct Factor<Eigen::Transpose<A>> {
  static constexpr Kind kind = products::kind<A>;
  static constexpr bool is_transposed = true;
  static decltype(auto) of(const Eigen::Transpose<A>& a) { return a.nestedExpression(); }
};

template <class A>
inline constexpr bool is_row = Factor<A>::kind == Kind::vector&& Factor<A>::is_transposed;
template <class A>
inline constexpr bool is_column = Factor<A>::kind == Kind::vector && !Factor<A>::is_transposed;

// Of which the product is one of the functions above: xᵀ y, a number, is not.
template <class A, class B>
concept Factors = Factor<A>::kind != Kind::other&& Factor<B>::kind != Kind::other &&
                  (is_column<A> ? is_row<B> : !(is_row<A> && is_column<B>)&&!is_row<B>);

}  // namespace products

// Of this project's own code alone (cmake/CourantSettings.cmake): what A * B is in a program that uses the library is
// not ours to say, even where it says `using namespace courant`.
#ifdef COURANT_CALLS_PRODUCTS
template <class A, class B>
requires products::Factors<A, B>
auto operator*(const A& left, const B& right) {
  using Left = products::Factor<A>;
  using Right = products::Factor<B>;
  if constexpr (products::is_column<A>)
    return products::outer(Left::of(left), Right::of(right));
  else if constexpr (products::is_row<A>)
    return Eigen::RowVectorXd((Right::is_transposed
                                   ? products::plain(Right::of(right), Left::of(left))
                                   : products::transposed(Right::of(right), Left::of(left)))
                                  .transpose());
  else if constexpr (!products::is_column<B>)
    return products::of(Left::of(left), Left::is_transposed, Right::of(right),
                        Right::is_transposed);
  else if constexpr (Left::is_transposed)
    return products::transposed(Left::of(left), Right::of(right));
  else
    return products::plain(Left::of(left), Right::of(right));
}
#endif

}  // namespace courant
