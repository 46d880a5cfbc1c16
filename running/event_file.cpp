#include "courant/running/event_file.hpp"

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

OutputFile opened(const std::filesystem::path& path, bool is_there) {
  if (is_there) return OutputFile(path, OutputFile::Existing{});
  return OutputFile(path);
}

}  // namespace

EventFile::EventFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
                     std::optional<std::uintmax_t> keep)
    : file_(opened(path, keep.has_value())) {
  if (keep) {
    file_.cut(*keep);
    size_ = *keep;
    return;
  }
  std::string header = "event,t";
  for (const std::string& column : columns) header += ',' + column;
  write(header + '\n');
}

void EventFile::append(const std::string& name, double t,
                       const Eigen::Ref<const VectorXd>& values) {
  std::string line = name + ',' + exact_text(t);
  for (const double value : values) line += ',' + exact_text(value);
  write(line + '\n');
}

void EventFile::write(const std::string& line) {
  file_.write(line);
  size_ += line.size();
}

}  // namespace courant
