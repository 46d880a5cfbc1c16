#include "courant/running/trajectory_writer.hpp"

#include <charconv>
#include <fstream>

#include "courant/core/files/input_file.hpp"
#include "courant/running/damage_of_lines.hpp"
#include "courant/running/npy_header.hpp"

namespace courant {
namespace {

// Comma-separated numbers, each by the fewest digits that read back to the same double.
class CsvWriter final : public TrajectoryWriter {
 public:
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
      : file_(path) {
    for (const std::string& column : columns) {
      if (!row_.empty()) row_ += ',';
      row_ += column;
    }
    end_row();
    do_flush();
  }
  CsvWriter(const std::filesystem::path& path, const HashedBytes::Record& keep)
      : file_(path, "", keep) {}

 private:
  void do_append(double t, const Eigen::Ref<const VectorXd>& values) override {
    add(t);
    for (const double value : values) {
      row_ += ',';
      add(value);
    }
    end_row();
    if (file_.is_full()) do_flush();
  }
  void do_flush() override { file_.flush(); }
  void do_sync() override { file_.sync(); }
  HashedBytes::Record do_record() const override { return file_.record(); }
  void add(double value) {
    char digits[32];
    row_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void end_row() {
    row_ += '\n';
    file_.append(row_);
    row_.clear();
  }

  GrowingFile file_;
  std::string row_;
};

// The format of NumPy, version 1.0: little-endian float64 by rows, the header saying how many there
// are.
class NpyWriter final : public TrajectoryWriter {
 public:
  NpyWriter(const std::filesystem::path& path, std::size_t columns)
      : columns_(columns), file_(path, header()) {}
  NpyWriter(const std::filesystem::path& path, std::size_t columns, const HashedBytes::Record& keep)
      : columns_(columns),
        rows_(keep.size / (sizeof(double) * columns)),
        file_(path, header(), keep) {}

 private:
  void do_append(double t, const Eigen::Ref<const VectorXd>& values) override {
    add(t);
    for (const double value : values) add(value);
    ++rows_;
    if (file_.is_full()) do_flush();
  }
  // Rows first: the header never promises what is not there.
  void do_flush() override {
    file_.flush();
    file_.replace_head(header());
  }
  void do_sync() override {
    do_flush();
    file_.sync();
  }
  HashedBytes::Record do_record() const override { return file_.record(); }
  void add(double value) { file_.append({reinterpret_cast<const char*>(&value), sizeof value}); }
  std::string header() const { return npy_header({rows_, columns_}); }

  std::size_t columns_;
  std::size_t rows_ = 0;
  GrowingFile file_;
};

// How many columns columns.json names, at least one.
std::size_t column_count(const std::filesystem::path& folder) {
  std::ifstream stream = input_file(folder / "columns.json");
  const Json columns = Json::parse(stream, nullptr, false);
  return columns.is_array() && !columns.empty() ? columns.size() : 1;
}

}  // namespace

const char* trajectory_name(Output::Format format) {
  return format == Output::Format::csv ? "trajectory.csv" : "trajectory.npy";
}

std::unique_ptr<TrajectoryWriter> make_trajectory_writer(Output::Format format,
                                                         const std::filesystem::path& folder,
                                                         const std::vector<std::string>& columns,
                                                         const HashedBytes::Record* keep) {
  const std::filesystem::path file = folder / trajectory_name(format);
  if (format == Output::Format::csv) {
    if (keep != nullptr) return std::make_unique<CsvWriter>(file, *keep);
    return std::make_unique<CsvWriter>(file, columns);
  }
  write_file(folder / "columns.json", Json(columns).dump() + "\n");
  if (keep != nullptr) return std::make_unique<NpyWriter>(file, columns.size(), *keep);
  return std::make_unique<NpyWriter>(file, columns.size());
}

std::optional<std::string> damage(Output::Format format, const std::filesystem::path& folder,
                                  const HashedBytes::Record& record) {
  const std::filesystem::path file = folder / trajectory_name(format);
  if (format == Output::Format::csv) return damage_of_lines(file, record);
  const Difference there = difference(file, kNpyHeader, record);
  if (there.is_none()) return std::nullopt;
  const std::size_t row = column_count(folder) * sizeof(double);
  return damage_of_rows((there.from - kNpyHeader) / row + 1, (there.to - 1 - kNpyHeader) / row + 1);
}

}  // namespace courant
