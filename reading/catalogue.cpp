#include "courant/reading/catalogue.hpp"

#include "courant/reading/method_kinds.hpp"
#include "courant/reading/network_element.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {

std::vector<Shelf> catalogue() {
  return {{"systems", "system", "A catalogue entry, or a description by formulas.",
           system_kinds().descriptions()},
          {"elements", "element", "An element of a network.", element_kinds().descriptions()},
          {"manifolds", "manifold", "A space.", manifold_kinds().descriptions()},
          {"structures", "structure", "A Dirac structure.", structure_kinds().descriptions()},
          {"methods", "method", "How the system is integrated.", method_kinds().descriptions()},
          {"discretizations", "discretization",
           "A discretization map; on a cotangent bundle the cotangent lift of that on the base.",
           discretization_kinds().descriptions()},
          {"projectors", "projector", "How points are brought to the final constraint set.",
           projector_kinds().descriptions()}};
}

std::string marked_table(const Shelf& shelf) {
  return "<!-- " + shelf.name + ", as courant list --markdown prints them -->\n" +
         markdown_table(shelf.kinds) + "<!-- end of " + shelf.name + " -->\n";
}

Json experiment_schema(Json frame) {
  for (const Shelf& shelf : catalogue())
    frame["$defs"][shelf.noun] = schema_of(shelf.description, shelf.kinds);
  return frame;
}

}  // namespace courant
