// Linear Dirac structures, to play with. docs/linear-dirac-structures.md tells what is seen.
#include "courant/structures/linear_dirac.hpp"

#include <array>
#include <iostream>

#include "courant/structures/dirac_interconnection.hpp"

using namespace courant;

int main() {
  // A plane in R³ and its annihilator, the graph of a two-form, the graph of a bivector.
  const LinearDirac plane = LinearDirac::annihilator_sum(MatrixXd{{1, 0}, {0, 1}, {0, 0}});
  const LinearDirac form = LinearDirac::graph_of_form(MatrixXd{{0, 2, 0}, {-2, 0, 0}, {0, 0, 0}});
  const LinearDirac bivector =
      LinearDirac::graph_of_bivector(MatrixXd{{0, 2, 0}, {-2, 0, 0}, {0, 0, 0}});
  std::cout << plane << form << bivector;

  // The pair (F_D, ω_D) determines D (Proposition 2.3), and so do four other representations.
  const FormOnSubspace pair = bivector.form();
  const HybridRepresentation<MatrixXd> hybrid = bivector.hybrid_representation();
  std::cout << std::boolalpha << "dim F_D = " << pair.F.cols()
            << ", from the pair: " << (distance(LinearDirac(pair), bivector) < 1e-14)
            << ", from the hybrid form: " << (distance(LinearDirac(hybrid), bivector) < 1e-14)
            << '\n';

  // The line of e₀ in V is isotropic. Its orthogonal is coisotropic; neither is Dirac.
  const PairedSubspace line = PairedSubspace::image(MatrixXd{{1}, {0}}, MatrixXd{{0}, {0}});
  for (const PairedSubspace& U : {line, line.orthogonal()})
    std::cout << "dimension " << U.dimension() << ": isotropic " << U.is_isotropic()
              << ", coisotropic " << U.is_coisotropic() << ", Dirac " << U.is_dirac() << '\n';

  // Restricted to a plane the form becomes its pull-back; seen through a map the bivector is pushed
  // forward.
  const MatrixXd inclusion{{1, 0}, {0, 1}, {1, 1}};
  std::cout << backward_image(inclusion, form);
  const MatrixXd projection{{1, 0, 0}, {1, 1, 0}};
  std::cout << forward_image(projection, bivector);

  // Two gyrators in a row are a transformer: flows are related to flows.
  const LinearDirac two = LinearDirac::graph_of_bivector(MatrixXd{{0, 2}, {-2, 0}});
  const LinearDirac six = LinearDirac::graph_of_bivector(MatrixXd{{0, 6}, {-6, 0}});
  const std::array<Index, 1> second{1}, first{0};
  std::cout << composition(two, second, six, first);
}
