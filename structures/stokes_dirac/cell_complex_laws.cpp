#include "courant/structures/stokes_dirac/cell_complex_laws.hpp"

#include <algorithm>
#include <cmath>

#include "courant/structures/kirchhoff_laws.hpp"

namespace courant {

std::vector<LawResult> check_cell_complex(const CellComplex& complex) {
  const Index n = complex.dimension();
  const std::string subject = "CellComplex of dimension " + std::to_string(n);
  LawMeasurement exact(subject, "X1 d d = 0", 0.0);
  exact.add(0.0, "n = 1");
  for (Index k = 0; k + 2 <= n; ++k)
    exact.add(largest_entry(SparseMatrixXd(complex.coboundary(k + 1) * complex.coboundary(k))),
              "k = " + std::to_string(k));

  LawMeasurement faces(subject, "X2 a facet bounds one or two cells, in opposite ways", 0.0);
  const SparseMatrixXd& last = complex.coboundary(n - 1);
  for (Index facet = 0; facet < last.cols(); ++facet) {
    const Index cells = last.col(facet).nonZeros();
    double sum = 0.0, wrong = cells >= 1 && (cells <= 2 || n == 1) ? 0.0 : 1.0;
    for (SparseMatrixXd::InnerIterator it(last, facet); it; ++it) {
      wrong = std::max(wrong, std::abs(std::abs(it.value()) - 1.0));
      sum += it.value();
    }
    // Neighbours in a space of their own dimension are oriented alike.
    if (n == 3 && cells == 2) wrong = std::max(wrong, std::abs(sum));
    faces.add(wrong, "facet " + std::to_string(facet));
  }

  const double volume = complex.measures(n).sum();
  LawMeasurement sizes(subject, "X3 the sum of |σ||⋆σ| is (n choose k) times the volume", 1e-12);
  double choose = 1.0;
  for (Index k = 0; k <= n; ++k) {
    const double sum = complex.measures(k).dot(complex.dual_measures(k));
    sizes.add(std::abs(sum / (choose * volume) - 1.0), "k = " + std::to_string(k));
    choose = choose * static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return {exact.result(), faces.result(), sizes.result()};
}

std::vector<LawResult> check_stokes_dirac(const StokesDirac& structure) {
  return check_sparse_dirac(structure.name(), structure.kernel_representation(),
                            structure.hybrid_representation());
}

}  // namespace courant
