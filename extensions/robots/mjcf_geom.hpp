// Masses of the geoms of MuJoCo.
#pragma once

#include "courant/extensions/robots/mjcf_document.hpp"

namespace courant::robots {

// The inertia of a geom with its defaults, in the frame that its pose is given in: by its mass, or its density (1000
// kg/m³ without) and the volume of the sphere, capsule, cylinder, ellipsoid or box that it is. Nothing of a plane or a
// height field. `unknown` is why it is not known: of a mesh, or a shell. Throws LineError.
struct GeomInertia {
  Inertia inertia = {};
  std::string unknown = {};
};
GeomInertia geom_inertia(const Element& geom, const MjcfDocument& document);

}  // namespace courant::robots
