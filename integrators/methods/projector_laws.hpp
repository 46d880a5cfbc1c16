// The laws of Projector, measured.
#pragma once

#include <span>
#include <vector>

#include "courant/integrators/step/projector.hpp"
#include "courant/manifolds/laws.hpp"

namespace courant {

// A point of M_f with conormals of M_f there: rows of Ñ numbers, independent.
struct ConstrainedPoint {
  VectorXd x;
  MatrixXd conormals;
};

// Every law of `projector` (J1 to J3 in the comment of Projector) at points of one M_f in
// `manifold`.
//
// Does not throw for a wrong projector: what it throws counts as an infinite defect of the law, and
// `where` says what it was.
std::vector<LawResult> check_projector(const Projector& projector, const Manifold& manifold,
                                       std::span<const ConstrainedPoint> points,
                                       const LawOptions& options = {});

}  // namespace courant
