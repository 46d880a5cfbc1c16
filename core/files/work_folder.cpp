#include "courant/core/files/work_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "courant/core/files/output_file.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "courant-work-";
constexpr std::size_t kRandom = 6;

}  // namespace

fs::path WorkFolder::temporary_folder() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  return error ? "/tmp" : folder;
}

WorkFolder::WorkFolder(const fs::path& parent)
    : path_((parent / (std::string(kPrefix) + std::string(kRandom, 'X'))).string()) {
  if (mkdtemp(path_.data()) == nullptr)
    throw OutputError(parent.string() +
                      ": no folder can be made in it: " + std::generic_category().message(errno));
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

bool WorkFolder::is_name(const std::string& name) {
  return name.starts_with(kPrefix) && name.size() == kPrefix.size() + kRandom &&
         std::all_of(name.end() - kRandom, name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

void WorkFolder::remove_left_behind(const fs::path& parent) {
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  for (const auto& item : fs::directory_iterator(parent, ignored)) {
    if (!is_name(item.path().filename().string())) continue;
    const int descriptor =
        ::open(item.path().c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) continue;
    // A folder is locked in the moment after it is made.
    const auto age = fs::file_time_type::clock::now() - item.last_write_time(ignored);
    if (age > std::chrono::seconds(10) && flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      abandoned.push_back(item.path());
    ::close(descriptor);
  }
  for (const fs::path& folder : abandoned) fs::remove_all(folder, ignored);
}

}  // namespace courant
