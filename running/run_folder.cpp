#include "courant/running/run_folder.hpp"

#include <string>
#include <system_error>

namespace courant {
namespace {

void write_json(const std::filesystem::path& file, const Json& json) {
  write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path path, bool replace, const Json& experiment)
    : path_(std::move(path)) {
  try {
    make_folder(path_);
    for (const char* name : {"summary.json", "trajectory.csv", "trajectory.npy", "columns.json",
                             "experiment.json", "report.html"}) {
      std::error_code error;
      if (!std::filesystem::exists(path_ / name, error)) continue;
      if (!replace)
        throw OutputError(path_.string() +
                          ": there is a run in this folder; expected another folder (-o), or "
                          "--force to replace it");
      std::filesystem::remove(path_ / name, error);
      if (error)
        throw OutputError((path_ / name).string() + ": cannot be replaced: " + error.message());
    }
    write_json(path_ / "experiment.json", experiment);
  } catch (const OutputError& error) {
    throw UnusableFolder(error.what());
  }
}

void RunFolder::write_summary(const Json& summary) const {
  write_json(path_ / "summary.json", summary);
}

}  // namespace courant
