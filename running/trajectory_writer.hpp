// Writing the rows of a trajectory.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "courant/core/expr.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/output_file.hpp"

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

 private:
  virtual void do_append(double t, const Eigen::Ref<const VectorXd>& values) = 0;
  virtual void do_flush() = 0;
};

// The file (with columns.json for npy) in a folder; `columns` are the names, t first.
std::unique_ptr<TrajectoryWriter> make_trajectory_writer(Output::Format format,
                                                         const std::filesystem::path& folder,
                                                         const std::vector<std::string>& columns);

}  // namespace courant
