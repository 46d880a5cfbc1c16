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

}  // namespace

void refuse_folder(const fs::path& path, const std::string& what) {
  throw UnusableFolder(path.string() + ": " + what);
}

LockedFolder::LockedFolder(fs::path path, const std::string& in_use) : path_(std::move(path)) {
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
  if (descriptor_ >= 0) ::close(descriptor_);
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
  std::error_code error;
  std::vector<fs::path> missing;
  fs::path nearest = fs::absolute(path, error).lexically_normal();
  for (; !fs::exists(nearest, error) && nearest.has_relative_path();
       nearest = nearest.parent_path())
    missing.push_back(nearest);
  error = fs::is_directory(nearest, error) ? std::error_code()
                                           : make_error_code(std::errc::not_a_directory);
  std::vector<fs::path> made;
  while (!error && !missing.empty()) {
    if (fs::create_directory(missing.back(), error)) made.push_back(missing.back());
    missing.pop_back();
  }
  for (std::error_code ignored; !made.empty(); made.pop_back()) fs::remove(made.back(), ignored);
  if (error) refuse_folder(path, "the folder cannot be made: " + error.message());
  if (nearest == fs::absolute(path, error).lexically_normal() &&
      access(nearest.c_str(), W_OK | X_OK) != 0)
    refuse_folder(path, "cannot be written: " + std::generic_category().message(errno));
}

}  // namespace courant
