// GrowingFile: what is appended, and how it is known again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/output_file.hpp"

namespace courant {

// A file that is appended to, behind a head that may change. Bytes are kept back until there are many
// of them, then written together: a kill leaves whole pieces of append(). Hashes of all of them tell
// whether the file is still what it was. Throws OutputError.
class GrowingFile {
 public:
  // A new file. The head is no part of what is appended.
  explicit GrowingFile(const std::filesystem::path& path, std::string_view head = "");
  // The file that is there, as it was when record() was this; what was appended since is cut off.
  // Throws OutputError if it has other bytes now.
  GrowingFile(const std::filesystem::path& path, std::string_view head,
              const HashedBytes::Record& kept);

  void append(std::string_view bytes);
  // Whether many bytes are kept back.
  bool is_full() const { return buffer_.size() >= kBlock; }
  // Everything that was appended is in the file.
  void flush();
  // And on the disk.
  void sync();
  // Of the same size as before.
  void replace_head(std::string_view head) { file_.overwrite(head); }

  // Of everything that was appended, whether it is in the file already or not.
  HashedBytes::Record record() const { return appended_.record(); }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 18;  // bytes kept back

  OutputFile file_;
  HashedBytes appended_;
  std::string buffer_;
};

}  // namespace courant
