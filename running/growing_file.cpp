#include "courant/running/growing_file.hpp"

namespace courant {

GrowingFile::GrowingFile(const std::filesystem::path& path, std::string_view head) : file_(path) {
  file_.write(head);
}

GrowingFile::GrowingFile(const std::filesystem::path& path, std::string_view head,
                         const HashedBytes::Record& kept)
    : file_(path, OutputFile::Existing{}) {
  if (!difference(path, head.size(), kept, &appended_).is_none())
    throw OutputError(path.string() + ": has other bytes than the run wrote");
  file_.overwrite(head);
  file_.cut(head.size() + kept.size);
}

void GrowingFile::append(std::string_view bytes) {
  appended_.append(bytes);
  buffer_ += bytes;
}

void GrowingFile::flush() {
  file_.write(buffer_);
  buffer_.clear();
}

void GrowingFile::sync() {
  flush();
  file_.sync();
}

}  // namespace courant
