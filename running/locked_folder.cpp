#include "courant/running/locked_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace courant {
namespace {

namespace fs = std::filesystem;

int open_folder(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

// Whether the name leads to what is open.
bool is_same(const fs::path& path, int descriptor) {
  struct stat named {
  }, open{};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 &&
         named.st_dev == open.st_dev && named.st_ino == open.st_ino;
}

fs::path absolute_path(const fs::path& path) {
  std::error_code ignored;
  return fs::absolute(path, ignored).lexically_normal();
}

// The folders of a path that are not there, the innermost first.
std::vector<fs::path> missing_folders(const fs::path& path) {
  std::error_code ignored;
  std::vector<fs::path> missing;
  for (fs::path at = absolute_path(path); !fs::exists(at, ignored) && at.has_relative_path();
       at = at.parent_path())
    missing.push_back(at);
  return missing;
}

// Those that are empty, or become so by this; the innermost are the first.
void remove_empty(const std::vector<fs::path>& folders) {
  std::error_code not_empty;
  for (const fs::path& folder : folders) fs::remove(folder, not_empty);
}

}  // namespace

void refuse_folder(const fs::path& path, const std::string& what) {
  throw UnusableFolder(path.string() + ": " + what);
}

LockedFolder::LockedFolder(fs::path path, const std::string& in_use)
    : path_(std::move(path)), made_(missing_folders(path_)) {
  try {
    make_folder(path_);
  } catch (const OutputError& error) {
    throw UnusableFolder(error.what());
  }
  descriptor_ = open_folder(path_);
  if (descriptor_ < 0) return;  // one that may be written to, and not read
  const bool is_locked = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (is_locked || !is_same(path_, descriptor_)) {
    ::close(descriptor_);
    refuse_folder(path_, in_use);
  }
  remove_unfinished_files(path_);
}

LockedFolder::~LockedFolder() {
  if (descriptor_ < 0) return;
  if (is_same(path_, descriptor_)) remove_empty(made_);
  ::close(descriptor_);
}

void LockedFolder::require_still_there() const {
  if (descriptor_ >= 0 && !is_same(path_, descriptor_))
    throw OutputError(path_.string() +
                      ": the folder was removed, moved or replaced while it was written to");
}

bool LockedFolder::is_in_use(const fs::path& path) {
  const int descriptor = open_folder(path);
  if (descriptor < 0) return false;
  const bool is_locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return is_locked;
}

void LockedFolder::check_place(const fs::path& path) {
  // Only the attempt tells of names that are too long, and of file systems without folders.
  std::vector<fs::path> missing = missing_folders(path), made;
  const fs::path nearest = missing.empty() ? absolute_path(path) : missing.back().parent_path();
  std::error_code error;
  error = fs::is_directory(nearest, error) ? std::error_code()
                                           : make_error_code(std::errc::not_a_directory);
  for (; !error && !missing.empty(); missing.pop_back())
    if (fs::create_directory(missing.back(), error)) made.insert(made.begin(), missing.back());
  remove_empty(made);
  if (error) refuse_folder(path, "the folder cannot be made: " + error.message());
  if (nearest == absolute_path(path) && access(nearest.c_str(), W_OK | X_OK) != 0)
    refuse_folder(path, "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace courant
