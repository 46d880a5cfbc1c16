#include <stdexcept>

#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

Element parse_xml(std::string_view) {
  throw std::runtime_error(
      "is XML, which this build does not read; expected one with COURANT_WITH_PUGIXML");
}

}  // namespace courant::robots
