// EventFile: events.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/running/growing_file.hpp"

namespace courant {

// A row an occurrence: the name of the event, the time, what is measured there.
class EventFile {
 public:
  // `keep`: not a new file, but that which is there, as it was when record() was this. Throws
  // OutputError.
  EventFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
            const HashedBytes::Record* keep);

  void append(const std::string& name, double t, const Eigen::Ref<const VectorXd>& values);
  // Everything that was appended is in the file; and on the disk.
  void flush() { file_.flush(); }
  void sync() { file_.sync(); }
  // Of everything that was appended.
  HashedBytes::Record record() const { return file_.record(); }

 private:
  GrowingFile file_;
};

}  // namespace courant
