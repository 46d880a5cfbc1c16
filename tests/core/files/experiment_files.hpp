// The experiments of the repository.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "../campaign.hpp"

namespace courant::test {

// The files of experiments that are trials of the campaign, by their names.
inline std::vector<std::filesystem::path> experiment_files(const Campaign& campaign = {}) {
  std::vector<std::filesystem::path> all, result;
  for (const auto& entry : std::filesystem::directory_iterator("experiments"))
    if (entry.path().extension() == ".json" && entry.path().stem() != "schema")
      all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (campaign.has(static_cast<long>(k))) result.push_back(all[k]);
  return result;
}

}  // namespace courant::test
