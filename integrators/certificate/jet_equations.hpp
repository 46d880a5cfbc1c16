// JetEquations: an implicit system and its time derivatives, on jets in the space around the manifold.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "courant/core/expressions/series_function.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// A jet (t; y) of level k of JetEquations.
struct Jet {
  Index k = 0;
  Digits t;
  std::vector<Digits> y;
};

// F^[k] = (F_0, …, F_k): the Taylor coefficients of
//
//   F(x(s), C(x) dx/ds, z(s), t + s) = 0,   c(x(s)) = 0,   dc(x) dx/ds = 0
//
// of a curve x(s) = Σ x_i sⁱ in the ambient space R^N of M = {c = 0}, with z(s) = Σ z_i sⁱ. On Rⁿ there is no c. A
// curve that solves these is in M, so that no chart and no basis is chosen, and given values are numbers
// of the jet as they stand. Time is a coordinate with the velocity 1 where it is in F: (t, x) is what M_k is
// made of then, and a set that holds for an instant only is seen.
//
// Unknowns: y = (x_0, x_1, z_0, x_2, z_1, …, x_{k+1}, z_k), N + (k+1)(N+m) of them; t comes last among the columns
// of the Jacobian and is no unknown. Rows: r' = r + 2q of each order, q equations of the manifold.
//
//   ∂F_i/∂x_j = (F_x)_{i-j} + j (F_ẋ)_{i-j+1},   ∂F_i/∂z_j = (F_z)_{i-j},   ∂F_i/∂t = (F_t)_i
//
// Traced once for a system. Immutable.
class JetEquations {
 public:
  explicit JetEquations(std::shared_ptr<const ChartEquations> in_chart);
  explicit JetEquations(std::shared_ptr<const ImplicitSystem> system);

  const ImplicitSystem& system() const { return *in_chart_->system(); }
  // The same system in charts, for doubles.
  const std::shared_ptr<const ChartEquations>& in_chart() const { return in_chart_; }
  Index point_size() const { return N_; }
  Index auxiliary_size() const { return m_; }
  Index row_size() const { return rows_; }                         // r'
  Index system_rows() const { return system().equation_count(); }  // r: the first of each order
  bool depends_on_time() const { return of_time_; }
  bool has_switches() const { return equations_.has_switches(); }

  Index row_count(Index k) const { return (k + 1) * rows_; }
  Index unknown_count(Index k) const { return N_ + (k + 1) * (N_ + m_); }
  Index x_offset(Index i) const { return i == 0 ? 0 : N_ + (i - 1) * (N_ + m_); }
  Index z_offset(Index i) const { return 2 * N_ + i * (N_ + m_); }

  struct Entry {
    Index row, column;
  };
  // The places of the Jacobian of level k that are not identically zero, each once, by rows and in a row by columns;
  // column unknown_count(k) is t.
  std::vector<Entry> pattern(Index k) const;

  // F^[k](y), and the entries of its Jacobian at these places, added up as written.
  template <class Number>
  struct Values {
    std::vector<Number> residual, entries;
    bool is_at_edge = false;  // of a switch
  };
  template <class Number>
  Values<Number> at(const Number& t, const std::vector<Number>& y, Index k) const;
  // The residual alone.
  template <class Number>
  std::vector<Number> residual(const Number& t, const std::vector<Number>& y, Index k) const;

  // The same equations where switches at their edge are what they are on one side (SeriesFunction).
  JetEquations on_side(int side) const;

 private:
  // A place of ∂F/∂(x, ẋ, z, t) by its row: the derivatives of F that it is made of, as numbers among the outputs of
  // equations_, -1 where they are identically zero. Of z and t `of_value` alone.
  enum class Argument : std::uint8_t { x, z, t };
  struct Place {
    Argument argument;
    Index column;  // in its argument
    Index of_value = -1, of_rate = -1;
  };
  // add(row, column, place, i, j) for each place of the Jacobian of level k, in the order of pattern().
  template <class Add>
  void each_place(Index k, const Add& add) const;

  template <class Number>
  bool run(const SeriesFunction& f, const Number& t, const std::vector<Number>& y, Index k,
           std::vector<Number>& out) const;

  std::shared_ptr<const ChartEquations> in_chart_;
  SeriesFunction values_;                   // (x, ẋ, z, t) ↦ the equations
  SeriesFunction equations_;                // and their derivatives at the places of jacobian_
  std::vector<std::vector<Place>> places_;  // by row of F: those of x, of z, of t
  std::vector<double> constants_;           // a last group of inputs of both
  std::vector<Digits> written_constants_;
  Index N_, m_, rows_ = 0;
  bool of_time_ = false;
  int side_ = 0;
};

}  // namespace courant
