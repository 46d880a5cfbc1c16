// Folders of runs, sweeps, studies and ensembles: whole commands that read any files, and go on with what
// is there. The text is that of all files, each behind a line `=== NAME`.
#include <algorithm>
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

// Files of a folder and of the folders in it, and nowhere else.
bool is_name_inside(std::string_view name) {
  constexpr std::string_view letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_=/";
  return !name.empty() && name.size() < 60 && name.find_first_not_of(letters) == name.npos &&
         name.find("..") == name.npos && !name.starts_with('/') && !name.ends_with('/') &&
         std::ranges::count(name, '/') < 2;
}

void write_files(std::string_view text, const std::filesystem::path& folder) {
  constexpr std::string_view mark = "=== ";
  while (text.starts_with(mark)) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view name = text.substr(mark.size(), end - mark.size());
    text.remove_prefix(end + 1);
    const std::size_t next = text.find("\n=== ");
    const std::string_view content = text.substr(0, next == text.npos ? next : next + 1);
    text.remove_prefix(content.size());
    if (!is_name_inside(name)) continue;
    std::error_code in_the_way;  // a file where a folder should be
    std::filesystem::create_directories((folder / name).parent_path(), in_the_way);
    std::ofstream(folder / name, std::ios::binary) << content;
  }
}

}  // namespace

}  // namespace courant::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string folder = courant::fuzz::empty_folder();
  const std::string text(reinterpret_cast<const char*>(data), size);
  courant::fuzz::write_files(text, folder);
  const std::string experiment = folder + "/experiment.json", table = folder + "/cases.csv";
  const std::vector<std::string> further = {"--quiet", "--backend", "interpreter", "--set",
                                            "/time={\"step\": 0.1, \"end\": 2}"};
  std::vector<std::vector<std::string>> commands = {
      {"report", folder},
      {"plot", folder, "--figure", "energy", "-o", folder + "/energy.svg"},
      {"plot", folder, "--figure", "sweep", "-o", folder + "/sweep.svg"},
      {"run", experiment, "--resume", "-o", folder},
      {"run", experiment, "--force", "-o", folder},
      {"run", experiment, "--resume", "-o", folder, "--sweep", table, "--jobs", "1"},
      {"run", experiment, "-o", folder + "/cases", "--sweep", table, "--jobs", "1"},
      {"sweep", "--merge", folder, "-o", folder + "/merged"}};
  std::vector<std::string>& command = commands[std::hash<std::string>()(text) % commands.size()];
  if (command.front() == "run") command.insert(command.end(), further.begin(), further.end());
  courant::fuzz::require_answer(command, text);
  return 0;
}
