// Meshes of Gmsh, as an experiment has them in itself.
#pragma once

#include <istream>
#include <stdexcept>
#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// What a file is wrong in: the line, 0 if it is the file as a whole.
class MeshError : public std::runtime_error {
 public:
  MeshError(std::size_t line, const std::string& what) : std::runtime_error(what), line_(line) {}
  std::size_t line() const { return line_; }

 private:
  std::size_t line_;
};

// {"vertices": …, "simplices": …, "facets": …} of a mesh in the text format 2.2 or 4.1 of Gmsh. Simplices are the
// elements of the highest dimension there is, facets those of one dimension less in a physical group, by its name, or
// its number where it has none. Nodes of no simplex are left out. Throws MeshError for other formats, for elements that
// are no simplices of first order, and beyond 10⁶ nodes, elements, or places of elements in groups.
Json read_mesh(std::istream& file);

}  // namespace courant
