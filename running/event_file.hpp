// EventFile: events.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/running/output_file.hpp"

namespace courant {

// A row an occurrence: the name of the event, the time, what is measured there.
class EventFile {
 public:
  // `keep`: not a new file, but that which is there, cut off at this size. Throws OutputError.
  EventFile(const std::filesystem::path& path, const std::vector<std::string>& columns,
            std::optional<std::uintmax_t> keep);

  void append(const std::string& name, double t, const Eigen::Ref<const VectorXd>& values);
  std::uintmax_t size() const { return size_; }  // bytes

 private:
  void write(const std::string& line);

  OutputFile file_;
  std::uintmax_t size_ = 0;
};

}  // namespace courant
