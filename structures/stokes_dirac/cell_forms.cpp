#include "courant/structures/stokes_dirac/cell_forms.hpp"

#include "courant/structures/interconnection.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac_system.hpp"

namespace courant {

std::vector<CellForm> cell_forms(const ImplicitSystem& system) {
  if (const auto* fields = dynamic_cast<const StokesDiracSystem*>(&system)) return fields->forms();
  std::vector<CellForm> all;
  if (const auto* whole = dynamic_cast<const Interconnection*>(&system)) {
    Index first = 0;
    for (const Interconnection::Part& part : whole->parts()) {
      for (CellForm form : cell_forms(*part.system)) {
        form.first += first;
        all.push_back(std::move(form));
      }
      first += part.system->manifold()->ambient_dimension();
    }
  }
  return all;
}

}  // namespace courant
