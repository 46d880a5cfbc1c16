#include "courant/extensions/importing/included_text.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace courant {

IncludedText files_below(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  return [root = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder)](
             const std::string& file) -> std::string {
    constexpr std::uintmax_t largest = std::uintmax_t{16} << 20;  // bytes
    std::error_code error;
    const fs::path path = fs::weakly_canonical(root / file, error);
    const fs::path below = path.lexically_relative(root);
    if (error || below.empty() || *below.begin() == "..")
      throw std::runtime_error(
          "is outside of the folder of the file that includes it; expected one below it");
    if (!fs::is_regular_file(path, error)) throw std::runtime_error("is not there");
    if (fs::file_size(path, error) > largest) throw std::runtime_error("is larger than 16 MB");
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  };
}

}  // namespace courant
