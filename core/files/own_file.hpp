// Whose a file is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace courant {

// The mark of a file that this program wrote for somebody: which command wrote it, and a hash of all
// that it wrote. It stands where the format has a place for remarks: a comment at the end of SVG,
// HTML, Markdown, LaTeX, C, PDF and manual pages, a text of PNG, a comment "// mark" of an experiment.
//
// A file is ours if it has a mark and is, to the last byte, what was written then. So what somebody
// else made, or edited, is theirs, whatever its name is.
struct FileMark {
  std::string command;  // "plot", "report", …: one word
  std::string beside =
      {};  // content_hash of a file beside it that belongs to it, for formats without a place for a mark

  // The content with this mark.
  std::string on(std::string content) const;
  // The mark of a content; nothing if there is none, or it was changed since.
  static std::optional<FileMark> of(const std::string& content);
};

// The mark of a file; nothing if it is not ours, or not there.
std::optional<FileMark> mark_of(const std::filesystem::path& file);

// How a command writes files that somebody names.
class OwnFiles {
 public:
  // `force`: a file is replaced though it is not ours, by its own name: not through a link.
  explicit OwnFiles(std::string command, bool force = false)
      : command_(std::move(command)), force_(force) {}

  // Throws RefusedOutput if there is a file of this name that is not ours. Devices and pipes are
  // nobody's. To be asked before anything is computed.
  void check(const std::filesystem::path& file) const;

  // Checks, then writes the file with a mark. `beside`: the content of a file that belongs to it and has no place for a
  // mark.
  void write(const std::filesystem::path& file, const std::string& content,
             const std::string& beside = "") const;

 private:
  std::string command_;
  bool force_;
};

// Throws RefusedOutput: the file is there, and not ours.
[[noreturn]] void refuse_foreign(const std::filesystem::path& file, const std::string& expected);

// Whether the file is there, as far as one may see.
bool file_exists(const std::filesystem::path& file);

// The content of a file, empty if it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace courant
