// New Dirac structures from old: images along linear maps, products, interconnection.
#pragma once

#include <span>

#include "courant/structures/linear_dirac.hpp"

namespace courant {

// Along a linear map φ: V → W (matrix dim W × dim V):
//
//   backward image   φ^! U = {(v, φ*β) : (φv, β) ∈ U} ⊂ V ⊕ V*     of U ⊂ W ⊕ W*
//   forward image    φ_! U = {(φv, β) : (v, φ*β) ∈ U} ⊂ W ⊕ W*     of U ⊂ V ⊕ V*
//
// Laws: the image of a Dirac structure is Dirac;  (ψφ)^! = φ^! ψ^!,  (ψφ)_! = ψ_! φ_!;
// φ^!(graph of ω) = graph of φ*ω;  φ_!(graph of Λ) = graph of φ_*Λ.
//
// Where U and φ are within δ of a pair at which the image jumps, rounding is amplified by 1/δ², up
// to δ² = 1e-12. For a Dirac structure the nearest one is returned: isotropy is kept to rounding.
PairedSubspace backward_image(const Eigen::Ref<const MatrixXd>& phi, const PairedSubspace& U);
PairedSubspace forward_image(const Eigen::Ref<const MatrixXd>& phi, const PairedSubspace& U);
LinearDirac backward_image(const Eigen::Ref<const MatrixXd>& phi, const LinearDirac& D);
LinearDirac forward_image(const Eigen::Ref<const MatrixXd>& phi, const LinearDirac& D);

// A × B on V_A ⊕ V_B.
PairedSubspace product(const PairedSubspace& A, const PairedSubspace& B);
LinearDirac product(const LinearDirac& A, const LinearDirac& B);

// {(v, α + β) : (v, α) ∈ A, (v, β) ∈ B}, the backward image of A × B along v ↦ (v, v): the same
// flow, efforts add up. With the graph of a form for B it is the gauge transformation of A; V ⊕ 0
// is the unit.
LinearDirac tensor_product(const LinearDirac& A, const LinearDirac& B);

// A and B joined at the ports (f, e): coordinate ports_of_A[k] of A with ports_of_B[k] of B,
//
//   A ∘ B = {(v_A, α_A, v_B, α_B) :
//            (v_A, α_A, f, e) ∈ A and (-f, e, v_B, α_B) ∈ B for some (f, e)},
//
// on the coordinates that are left, those of A first, each in their order. Sign: flows count into
// each part, so what leaves A enters B (f_A = -f_B), and the effort is common (e_A = e_B); then the
// power of the ports cancels and A ∘ B is Dirac (Cervera, van der Schaft & Baños, Interconnection
// of port-Hamiltonian systems and composition of Dirac structures, 2007).
LinearDirac composition(const LinearDirac& A, std::span<const Index> ports_of_A,
                        const LinearDirac& B, std::span<const Index> ports_of_B);

}  // namespace courant
