#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "courant/core/numbers/as_size.hpp"
#include "courant/manifolds/euclidean.hpp"

namespace courant {

// What the constructor computes before its base class is made.
struct StokesDirac::Parts {
  std::shared_ptr<const CellComplex> complex;
  Index degree;
  std::vector<Index> p_cells, flow_cells, effort_cells;
  SparseMatrixXd J, B, bivector;

  Parts(std::shared_ptr<const CellComplex> of, Index k, std::vector<Index> efforts)
      : complex(std::move(of)), degree(k), effort_cells(std::move(efforts)) {
    if (!complex || k < 0 || k >= complex->dimension())
      throw std::invalid_argument(
          "StokesDirac: the degree is " + std::to_string(k) + ", or the complex is missing; " +
          (complex ? "expected 0 to " + std::to_string(complex->dimension() - 1) + "."
                   : "expected a complex."));
    const std::vector<Index> boundary = complex->cells_of(k, complex->boundary());
    std::sort(effort_cells.begin(), effort_cells.end());
    const auto twice = std::adjacent_find(effort_cells.begin(), effort_cells.end());
    if (twice != effort_cells.end())
      throw std::invalid_argument("StokesDirac: the effort cell " + std::to_string(*twice) +
                                  " is there twice; expected each once.");
    for (const Index cell : effort_cells)
      if (!std::binary_search(boundary.begin(), boundary.end(), cell))
        throw std::invalid_argument("StokesDirac: the effort cell " + std::to_string(cell) +
                                    " is no cell of dimension " + std::to_string(k) +
                                    " on the boundary; expected one.");
    std::set_difference(boundary.begin(), boundary.end(), effort_cells.begin(), effort_cells.end(),
                        std::back_inserter(flow_cells));
    std::vector<Index> all(as_size(complex->count(k)));
    std::iota(all.begin(), all.end(), Index{0});
    std::set_difference(all.begin(), all.end(), effort_cells.begin(), effort_cells.end(),
                        std::back_inserter(p_cells));
    make_matrices();
  }

  void make_matrices() {
    const Index p = std::ssize(p_cells), q = complex->count(degree + 1);
    const Index flows = std::ssize(flow_cells), ports = flows + std::ssize(effort_cells);
    // Where a k-cell is among the states or, from N on, among the ports that are efforts.
    std::vector<Index> column(as_size(complex->count(degree)));
    for (Index i = 0; i < p; ++i) column[as_size(p_cells[as_size(i)])] = i;
    for (std::size_t i = 0; i < effort_cells.size(); ++i)
      column[as_size(effort_cells[i])] = p + q + flows + static_cast<Index>(i);
    std::vector<Eigen::Triplet<double>> triplets;
    const auto add = [&](Index row, Index col, double value) {  // and what makes it skew
      triplets.emplace_back(static_cast<int>(row), static_cast<int>(col), value);
      triplets.emplace_back(static_cast<int>(col), static_cast<int>(row), -value);
    };
    const SparseMatrixXd& d = complex->coboundary(degree);
    for (Index cell = 0; cell < d.cols(); ++cell)
      for (SparseMatrixXd::InnerIterator it(d, cell); it; ++it)
        add(p + it.row(), column[as_size(cell)], -it.value());
    for (Index b = 0; b < flows; ++b) add(column[as_size(flow_cells[as_size(b)])], p + q + b, 1.0);
    bivector.resize(p + q + ports, p + q + ports);
    bivector.setFromTriplets(triplets.begin(), triplets.end());
    J = bivector.topLeftCorner(p + q, p + q);
    B = bivector.topRightCorner(p + q, ports);
  }
};

StokesDirac::StokesDirac(std::shared_ptr<const CellComplex> complex, Index degree,
                         std::vector<Index> effort_cells)
    : StokesDirac(Parts(std::move(complex), degree, std::move(effort_cells))) {}

StokesDirac::StokesDirac(Parts parts)
    : DiracStructure("StokesDirac(degree " + std::to_string(parts.degree) + ", " +
                         std::to_string(parts.bivector.rows()) + ")",
                     std::make_shared<Euclidean>(parts.bivector.rows()), 0, parts.bivector.rows()),
      complex_(std::move(parts.complex)),
      degree_(parts.degree),
      p_cells_(std::move(parts.p_cells)),
      flow_cells_(std::move(parts.flow_cells)),
      effort_cells_(std::move(parts.effort_cells)),
      J_(std::move(parts.J)),
      B_(std::move(parts.B)),
      bivector_(std::move(parts.bivector)) {}

CellForm StokesDirac::p_form() const {
  const auto of_cells = [&](const MatrixXd& matrix) {
    MatrixXd rows(p_count(), matrix.cols());
    for (Index i = 0; i < p_count(); ++i) rows.row(i) = matrix.row(p_cells_[as_size(i)]);
    return rows;
  };
  return {degree_ > 0, of_cells(complex_->positions(degree_)),
          of_cells(complex_->directions(degree_)), of_cells(complex_->dual_measures(degree_))};
}

CellForm StokesDirac::q_form() const {
  const Index k = degree_ + 1;
  return {k < complex_->dimension(), complex_->positions(k), complex_->directions(k),
          complex_->measures(k), p_count()};
}

KernelRepresentation<SparseMatrixXd> StokesDirac::kernel_representation() const {
  SparseMatrixXd identity(bivector_.rows(), bivector_.rows());
  identity.setIdentity();
  return {identity, -bivector_};
}

HybridRepresentation<SparseMatrixXd> StokesDirac::hybrid_representation() const {
  std::vector<Index> all(as_size(bivector_.rows()));
  std::iota(all.begin(), all.end(), Index{0});
  return {all, {}, bivector_};
}

ExprVector StokesDirac::do_membership(const ExprVector&, const ExprVector& v,
                                      const ExprVector& alpha, const ExprVector&) const {
  return v - sparse_product(bivector_, alpha);
}

ExprVector sparse_product(const SparseMatrixXd& A, const ExprVector& x) {
  ExprVector y = ExprVector::Zero(A.rows());
  for (Index column = 0; column < A.outerSize(); ++column)
    for (SparseMatrixXd::InnerIterator it(A, column); it; ++it)
      y[it.row()] += it.value() * x[column];
  return y;
}

}  // namespace courant
