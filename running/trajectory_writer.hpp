// Writing the rows of a trajectory.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/growing_file.hpp"

namespace courant {

// Appends rows t, value, … to the file of a trajectory. Rows are kept back until there are many of
// them, then written together: a kill at any moment leaves whole rows. Throws OutputError.
class TrajectoryWriter {
 public:
  virtual ~TrajectoryWriter() = default;

  // As many values as there are columns but the first, t.
  void append(double t, const Eigen::Ref<const VectorXd>& values) { do_append(t, values); }
  // Everything that was appended is in the file.
  void flush() { do_flush(); }
  // And on the disk.
  void sync() { do_sync(); }
  // Of everything that was appended, whether it is in the file already or not.
  HashedBytes::Record record() const { return do_record(); }

 private:
  virtual void do_append(double t, const Eigen::Ref<const VectorXd>& values) = 0;
  virtual void do_flush() = 0;
  virtual void do_sync() = 0;
  virtual HashedBytes::Record do_record() const = 0;
};

// The name of the file.
const char* trajectory_name(Output::Format format);

// The file (with columns.json for npy) in a folder; `columns` are the names, t first.
// `keep`: not a new file, but that which is there already, as it was when record() was this; what was
// written to it since is cut off.
std::unique_ptr<TrajectoryWriter> make_trajectory_writer(Output::Format format,
                                                         const std::filesystem::path& folder,
                                                         const std::vector<std::string>& columns,
                                                         const HashedBytes::Record* keep = nullptr);

// What is wrong with a file that should be as a record says, by its rows; nothing if it is so.
std::optional<std::string> damage(Output::Format format, const std::filesystem::path& folder,
                                  const HashedBytes::Record& record);

}  // namespace courant
