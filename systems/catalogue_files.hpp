// The part of the catalogue that formulas can express: one file of this folder a system.
#pragma once

#include <span>
#include <string_view>

namespace courant {

// A system as data: the text of `<name>.json`, which reading/catalogue_system.hpp reads.
struct CatalogueFile {
  std::string_view name;  // with hyphens, "heavy-top" of heavy_top.json
  std::string_view text;
};

// In the order of their names. They are compiled in.
std::span<const CatalogueFile> catalogue_files();

}  // namespace courant
