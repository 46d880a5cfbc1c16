#include "courant/running/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace courant {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": cannot be written: " + reason);
}

std::string last_error() { return std::generic_category().message(errno); }

// The file that links lead to, which is there or not.
std::filesystem::path at_end_of_links(std::filesystem::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(path, error); ++i)
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  return path;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, const std::filesystem::path& asked,
                       int flags)
    : asked_(asked), descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666)) {
  if (descriptor_ < 0) fail();
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : OutputFile(path, path, O_CREAT | O_TRUNC) {}

OutputFile::OutputFile(const std::filesystem::path& path, Existing) : OutputFile(path, path, 0) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::fail() const { refuse_file(asked_, last_error()); }

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      fail();
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

void OutputFile::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail();
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  write_file(path, content, path);
}

void write_file(const std::filesystem::path& path, std::string_view content,
                const std::filesystem::path& asked) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error) &&
      !std::filesystem::is_directory(path, error)) {  // a device, a pipe: it is not replaced
    OutputFile file(path, asked, 0);
    file.write(content);
    return file.close();
  }
  const std::filesystem::path file = at_end_of_links(path);
  std::filesystem::path temporary = file;
  temporary += ".new";
  try {
    // What stands under that name may be a link that somebody else has left.
    std::filesystem::remove(temporary, error);
    OutputFile part(temporary, asked, O_CREAT | O_EXCL);
    part.write(content);
    part.close();
    std::filesystem::rename(temporary, file, error);
    if (error) refuse_file(asked, error.message());
  } catch (const OutputError&) {
    std::filesystem::remove(temporary, error);
    throw;
  }
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw OutputError(path.string() + ": the folder cannot be made: " + error.message());
}

}  // namespace courant
