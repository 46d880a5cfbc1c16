#include "courant/running/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "temporary_folder.hpp"

namespace courant {

BOOST_AUTO_TEST_SUITE(output_file)

BOOST_AUTO_TEST_CASE(writes_and_overwrites) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a");
  file.write("hello ");
  file.write("world");
  file.overwrite("H");
  file.close();
  BOOST_TEST(read_text(folder / "a") == "Hello world");
}

BOOST_AUTO_TEST_CASE(a_file_is_written_whole_or_not_at_all) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  write_file(folder / "a", "new");
  BOOST_TEST(read_text(folder / "a") == "new");
  BOOST_CHECK_THROW(write_file(folder / "none" / "a", "x"), OutputError);
  // A folder in the way: what was there stays, and nothing half-written is left.
  std::filesystem::create_directories(folder / "b" / "c");
  BOOST_CHECK_THROW(write_file(folder / "b", "x"), OutputError);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++entries;
  BOOST_TEST(entries == 2u);
}

// Not that of the file on the way to it.
BOOST_AUTO_TEST_CASE(errors_have_the_name_that_was_asked_for) {
  const TemporaryFolder folder;
  const std::string in_none = (folder / "none" / "a").string();
  const auto names = [](const std::string& name) {
    return [name](const OutputError& error) {
      return std::string(error.what()).starts_with(name + ": cannot be written: ");
    };
  };
  BOOST_CHECK_EXCEPTION(write_file(in_none, "x"), OutputError, names(in_none));
  BOOST_CHECK_EXCEPTION(write_file(in_none, "x", "b.pdf"), OutputError, names("b.pdf"));
  std::filesystem::create_directories(folder / "b" / "c");
  BOOST_CHECK_EXCEPTION(write_file(folder / "b", "x", "c.pdf"), OutputError, names("c.pdf"));
}

BOOST_AUTO_TEST_CASE(a_file_that_is_there_is_written_on) {
  const TemporaryFolder folder;
  write_text(folder / "a", "0123456789");
  OutputFile file(folder / "a", OutputFile::Existing{});
  BOOST_TEST(read_text(folder / "a") == "0123456789");
  file.overwrite("AB");
  file.cut(5);
  file.write("x");
  file.write("y");
  BOOST_TEST(read_text(folder / "a") == "AB234xy");
  BOOST_CHECK_THROW(file.cut(8), OutputError);
  BOOST_CHECK_THROW(OutputFile(folder / "none", OutputFile::Existing{}), OutputError);
  BOOST_TEST(!std::filesystem::exists(folder / "none"));
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) return;
  OutputFile file("/dev/full");
  BOOST_CHECK_THROW(file.write("x"), OutputError);
}

// root may replace a device by a file; nothing but a restart brings it back.
BOOST_AUTO_TEST_CASE(a_pipe_is_written_to_and_stays) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  BOOST_TEST_REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  write_file(pipe, "through");
  BOOST_TEST(std::filesystem::is_fifo(pipe));
  std::string found(16, ' ');
  found.resize(static_cast<std::size_t>(std::max<ssize_t>(read(end, found.data(), 16), 0)));
  BOOST_TEST(found == "through");
  close(end);
}

BOOST_AUTO_TEST_CASE(links_stay_links) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/a", folder / "link");
  for (const char* content : {"new", "newer"}) {
    write_file(folder / "link", content);
    BOOST_TEST(std::filesystem::is_symlink(folder / "link"));
    BOOST_TEST(read_text(folder / "there" / "a") == content);
  }
  // Nor does a link under the name on the way lead anywhere.
  write_text(folder / "precious", "precious");
  std::filesystem::create_symlink("precious", folder / "b.new");
  write_file(folder / "b", "b");
  BOOST_TEST(read_text(folder / "b") == "b");
  BOOST_TEST(read_text(folder / "precious") == "precious");
}

BOOST_AUTO_TEST_CASE(makes_folders) {
  const TemporaryFolder folder;
  make_folder(folder / "a" / "b");
  make_folder(folder / "a" / "b");
  BOOST_TEST(std::filesystem::is_directory(folder / "a" / "b"));
  write_text(folder / "file", "");
  BOOST_CHECK_THROW(make_folder(folder / "file" / "b"), OutputError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
