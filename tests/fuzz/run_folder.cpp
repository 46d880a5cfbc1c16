// Folders of runs: whole commands that read any files. The text is that of all files, each behind a
// line `=== NAME`.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "answer.hpp"

namespace courant::fuzz {

namespace {

constexpr std::array<std::string_view, 5> names = {
    "summary.json", "experiment.json", "trajectory.csv", "columns.json", "trajectory.npy"};

void write_files(std::string_view text, const std::filesystem::path& folder) {
  for (const std::string_view name : names) {
    const std::string head = "=== " + std::string(name) + "\n";
    const std::size_t at = text.find(head);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = text.substr(at + head.size());
    const std::size_t next = rest.find("\n=== ");
    std::ofstream(folder / name, std::ios::binary)
        << (next == std::string_view::npos ? rest : rest.substr(0, next + 1));
  }
}

}  // namespace

}  // namespace courant::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string folder = courant::fuzz::empty_folder();
  const std::string text(reinterpret_cast<const char*>(data), size);
  courant::fuzz::write_files(text, folder);
  if (std::hash<std::string>()(text) % 2 == 0)
    courant::fuzz::require_answer({"report", folder}, text);
  else
    courant::fuzz::require_answer(
        {"plot", folder, "--figure", "energy", "-o", folder + "/energy.svg"}, text);
  return 0;
}
