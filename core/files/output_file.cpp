#include "courant/core/files/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinished = ".courant-";  // and 16 hexadecimal digits

[[noreturn]] void refuse_file(const fs::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": cannot be written: " + reason);
}

std::string last_error() { return std::generic_category().message(errno); }

// The file that links lead to, which is there or not.
fs::path at_end_of_links(fs::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

// In the folder of a file. Its own name might become too long.
fs::path unfinished_name(const fs::path& file) {
  std::random_device random;
  std::string name(kUnfinished);
  for (int i = 0; i < 16; ++i) name += "0123456789abcdef"[random() % 16];
  return file.parent_path() / name;
}

bool is_unfinished_name(const std::string& name) {
  return name.starts_with(kUnfinished) && name.size() == kUnfinished.size() + 16 &&
         name.find_first_not_of("0123456789abcdef", kUnfinished.size()) == std::string::npos;
}

}  // namespace

OutputFile::OutputFile(const fs::path& path, fs::path asked, int flags)
    : asked_(std::move(asked)), descriptor_(::open(path.c_str(), O_CLOEXEC | flags, 0666)) {
  if (descriptor_ < 0) fail();
}

OutputFile::OutputFile(const fs::path& path)
    : OutputFile((::unlink(path.c_str()), path), path, O_WRONLY | O_CREAT | O_EXCL) {}

OutputFile::OutputFile(const fs::path& path, Existing)
    : OutputFile(path, path, O_WRONLY | O_NOFOLLOW) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::fail() const { refuse_file(asked_, last_error()); }

void OutputFile::write(std::string_view bytes) {
  const off_t begin =
      ::lseek(descriptor_, 0, SEEK_CUR);  // -1 of a pipe, which nothing is taken back of
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR) {
      const int reason = errno;
      if (begin >= 0 && ::ftruncate(descriptor_, begin) == 0) ::lseek(descriptor_, begin, SEEK_SET);
      errno = reason;
      fail();
    }
  }
}

void OutputFile::overwrite(std::string_view bytes) {
  if (::pwrite(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    fail();
}

void OutputFile::cut(std::uintmax_t size) {
  const auto there = ::lseek(descriptor_, 0, SEEK_END);
  if (there < 0) fail();
  if (static_cast<std::uintmax_t>(there) < size)
    refuse_file(asked_, "it has " + std::to_string(there) + " bytes, expected at least " +
                            std::to_string(size));
  const auto end = static_cast<off_t>(size);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) fail();
}

void OutputFile::sync() {
  // A pipe and some file systems have nothing to sync.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail();
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && status.st_nlink == 0)
    refuse_file(asked_, "it was removed while it was written");
}

void OutputFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail();
}

ReservedSpace::ReservedSpace(const fs::path& folder, std::size_t bytes) {
  const fs::path name = unfinished_name(folder / "reserved");
  descriptor_ = ::open(name.c_str(), O_CLOEXEC | O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (descriptor_ < 0) return;
  ::unlink(name.c_str());
  if (::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes)) != 0) {
    ::close(descriptor_);  // what there is stays free
    descriptor_ = -1;
  }
}

ReservedSpace::~ReservedSpace() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void write_file(const fs::path& path, std::string_view content) {
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (fs::exists(there) && !fs::is_regular_file(there) && !fs::is_directory(there)) {
    OutputFile file(path, path, O_WRONLY);  // a device, a pipe: it is not replaced
    file.write(content);
    return file.close();
  }
  const fs::path file = at_end_of_links(path);
  const fs::path unfinished = unfinished_name(file);
  OutputFile part(unfinished, path, O_WRONLY | O_CREAT | O_EXCL);
  try {
    if (fs::is_regular_file(there))
      ::fchmod(part.descriptor_, static_cast<mode_t>(there.permissions()));
    part.write(content);
    part.sync();
    part.close();
    fs::rename(unfinished, file, error);
    if (error) refuse_file(path, error.message());
  } catch (const OutputError&) {
    fs::remove(unfinished, error);
    throw;
  }
}

void remove_unfinished_files(const fs::path& folder) {
  std::vector<fs::path> left;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder, error))
    if (is_unfinished_name(item.path().filename().string())) left.push_back(item.path());
  for (const fs::path& file : left) fs::remove(file, error);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw OutputError(path.string() + ": the folder cannot be made: " + error.message());
}

}  // namespace courant
