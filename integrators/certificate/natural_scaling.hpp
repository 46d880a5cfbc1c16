// Units for the equations and unknowns of a nonlinear system.
#pragma once

#include <functional>

#include "courant/integrators/certificate/prolongation.hpp"

namespace courant {

using LinearizableMap = std::function<Linearization(const VectorXd& y)>;

// F with 0 for what is within the bound of its rounding error: that is no size of anything, and no
// step makes it smaller.
VectorXd significant(const Linearization& at);

// Row and column scales in which a map near y is comparable with 1: diag(r) J diag(c) is
// equilibrated, and in each connected component of its pattern (equations that share unknowns) the
// largest |y_j| / c_j is 1.
//
// Equilibration alone leaves one factor free in each component, r → a r, c → c / a; across
// components a would be arbitrary, and with it every norm that adds them. Where all y_j of a
// component vanish the largest |F_i| r_i is made 1 instead, of those that are significant. In no
// component is the bound of a rounding error more than 10⁻³: a unit that is smaller is itself made of
// such errors.
struct NaturalScaling {
  SparseMatrixXd scaled;
  VectorXd row_scale, column_scale;
  std::vector<Index> row_component, column_component;
  Index component_count = 0;

  static constexpr double kUsualNoise = 1.5e-14;

  // `nominal`: sizes of the unknowns, ≥ 0. Entries of the Jacobian that are at most `noise` times the
  // others of their row and column count as zero, and so do sizes up to `least_size` in the units
  // of equilibration, where they are as small next to the numbers of other components or to the value.
  NaturalScaling(const Linearization& at, const VectorXd& nominal, double noise = kUsualNoise,
                 double least_size = 0.0);

  // max over components of ‖F‖_∞ / ‖ |S| |y| ‖_∞ in these units: the distance from a zero, next to
  // what the equations are made of.
  double defect(const VectorXd& value, const VectorXd& nominal) const;
};

// Among exponentials: what a diode conducts by elsewhere is no size of what it blocks by. Entries of `magnitude` that are
// more than 1000 times what they are at a point, and not round-off there, become what they are there.
void keep_what_is_here(SparseMatrixXd& magnitude, const Linearization& at);

// The largest |J_ij| at y and at points whose unknowns differ from y by up to a tenth of their
// size, or of their natural unit where they vanish at y. An entry that vanishes at y by accident,
// and is 10⁻¹⁷ because of rounding, is small next to that, whatever the units of equations and
// unknowns; at y alone a small number and a large unit could not be told from each other. Where the
// unit of an unknown that vanishes is more than 1000 times what the terms of its equations are made
// of, it moves by these: a closed switch has the difference of two voltages of 3 V, of which a leak
// of 10⁻¹² S beside would make 10⁶ V. `nominal`: sizes of the unknowns, at least |y|; `at`: the map
// at y.
SparseMatrixXd generic_magnitude(const LinearizableMap& map, const VectorXd& y,
                                 const VectorXd& nominal, const Linearization& at);

// The Jacobian of a prolongation at y in units of what its entries are around y: diag(r) J(y)
// diag(c), where diag(r) G diag(c) is equilibrated for G its generic magnitude; y is a zero.
struct GenericScaling {
  SparseMatrixXd scaled, magnitude;
  VectorXd row_scale, column_scale;

  GenericScaling(const Prolongation& array, const VectorXd& y, const VectorXd& nominal);
};

}  // namespace courant
