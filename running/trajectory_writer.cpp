#include "courant/running/trajectory_writer.hpp"

#include <bit>
#include <charconv>

namespace courant {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18;  // bytes kept back

// Comma-separated numbers, each by the fewest digits that read back to the same double.
class CsvWriter final : public TrajectoryWriter {
 public:
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
      : file_(path) {
    reserve(columns.size());
    for (const std::string& column : columns) {
      if (!buffer_.empty()) buffer_ += ',';
      buffer_ += column;
    }
    buffer_ += '\n';
    do_flush();
  }
  CsvWriter(const std::filesystem::path& path, std::size_t columns, std::uintmax_t keep)
      : file_(path, OutputFile::Existing{}), written_(keep) {
    reserve(columns);
    file_.cut(keep);
  }

 private:
  void reserve(std::size_t columns) { buffer_.reserve(kBlock + 32 * columns); }
  void do_append(double t, const Eigen::Ref<const VectorXd>& values) override {
    add(t);
    for (const double value : values) {
      buffer_ += ',';
      add(value);
    }
    buffer_ += '\n';
    if (buffer_.size() >= kBlock) do_flush();
  }
  void do_flush() override {
    file_.write(buffer_);
    written_ += buffer_.size();
    buffer_.clear();
  }
  std::uintmax_t do_size() const override { return written_ + buffer_.size(); }
  void add(double value) {
    char digits[32];
    buffer_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }

  OutputFile file_;
  std::uintmax_t written_ = 0;
  std::string buffer_;
};

// The format of NumPy, version 1.0: little-endian float64 by rows, the header saying how many there
// are.
class NpyWriter final : public TrajectoryWriter {
  static_assert(std::endian::native == std::endian::little);

 public:
  static constexpr std::size_t kHeader = 128;  // bytes

  NpyWriter(const std::filesystem::path& path, std::size_t columns)
      : file_(path), columns_(columns) {
    reserve();
    file_.write(header());
  }
  NpyWriter(const std::filesystem::path& path, std::size_t columns, std::uintmax_t keep)
      : file_(path, OutputFile::Existing{}),
        columns_(columns),
        rows_((keep - kHeader) / (sizeof(double) * columns)) {
    reserve();
    file_.overwrite(header());
    file_.cut(keep);
  }

 private:
  void do_append(double t, const Eigen::Ref<const VectorXd>& values) override {
    add(t);
    for (const double value : values) add(value);
    ++kept_back_;
    if (buffer_.size() >= kBlock) do_flush();
  }
  void reserve() { buffer_.reserve(kBlock + sizeof(double) * columns_); }
  // Rows first: the header never promises what is not there.
  void do_flush() override {
    file_.write(buffer_);
    rows_ += kept_back_;
    file_.overwrite(header());
    buffer_.clear();
    kept_back_ = 0;
  }
  std::uintmax_t do_size() const override {
    return kHeader + (rows_ + kept_back_) * columns_ * sizeof(double);
  }
  void add(double value) { buffer_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  std::string header() const {
    std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(rows_) + ", " + std::to_string(columns_) + "), }";
    text.resize(kHeader - 11, ' ');  // as many bytes whatever the number of rows is
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text + '\n';
  }

  OutputFile file_;
  std::string buffer_;
  std::size_t columns_;
  std::size_t rows_ = 0;
  std::size_t kept_back_ = 0;
};

}  // namespace

const char* trajectory_name(Output::Format format) {
  return format == Output::Format::csv ? "trajectory.csv" : "trajectory.npy";
}

std::unique_ptr<TrajectoryWriter> make_trajectory_writer(Output::Format format,
                                                         const std::filesystem::path& folder,
                                                         const std::vector<std::string>& columns,
                                                         std::optional<std::uintmax_t> keep) {
  const std::filesystem::path file = folder / trajectory_name(format);
  if (format == Output::Format::csv) {
    if (keep) return std::make_unique<CsvWriter>(file, columns.size(), *keep);
    return std::make_unique<CsvWriter>(file, columns);
  }
  write_file(folder / "columns.json", Json(columns).dump() + "\n");
  if (keep) return std::make_unique<NpyWriter>(file, columns.size(), *keep);
  return std::make_unique<NpyWriter>(file, columns.size());
}

}  // namespace courant
