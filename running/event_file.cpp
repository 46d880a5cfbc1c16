#include "courant/running/event_file.hpp"

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

GrowingFile opened(const std::filesystem::path& path, const HashedBytes::Record* keep) {
  if (keep != nullptr) return GrowingFile(path, "", *keep);
  return GrowingFile(path);
}

}  // namespace

EventFile::EventFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
                     const HashedBytes::Record* keep)
    : file_(opened(path, keep)) {
  if (keep != nullptr) return;
  std::string header = "event,t";
  for (const std::string& column : columns) header += ',' + column;
  file_.append(header + '\n');
  file_.flush();
}

void EventFile::append(const std::string& name, double t,
                       const Eigen::Ref<const VectorXd>& values) {
  std::string line = name + ',' + exact_text(t);
  for (const double value : values) line += ',' + exact_text(value);
  file_.append(line + '\n');
  if (file_.is_full()) file_.flush();
}

}  // namespace courant
