// Writing the rows of a trajectory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
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
  // Bytes of the file with everything that was appended, whether it is there already or not.
  std::uintmax_t size() const { return do_size(); }

 private:
  virtual void do_append(double t, const Eigen::Ref<const VectorXd>& values) = 0;
  virtual void do_flush() = 0;
  virtual std::uintmax_t do_size() const = 0;
};

// The name of the file.
const char* trajectory_name(Output::Format format);

// The file (with columns.json for npy) in a folder; `columns` are the names, t first.
// `keep`: not a new file, but that which is there already, as it was when size() was this; what was
// written to it since is cut off.
std::unique_ptr<TrajectoryWriter> make_trajectory_writer(Output::Format format,
                                                         const std::filesystem::path& folder,
                                                         const std::vector<std::string>& columns,
                                                         std::optional<std::uintmax_t> keep = {});

}  // namespace courant
