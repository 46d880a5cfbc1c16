#include "courant/core/files/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <csignal>

#include "temporary_folder.hpp"

namespace courant {

// Mistakes that these cases have to notice:
//  * what is longer stays
//  * half of what does not fit stays
//  * an error has the name of a file on the way
//  * a link is replaced by a file
//  * a file on the way is written through a link
BOOST_AUTO_TEST_SUITE(output_file_test)

BOOST_AUTO_TEST_CASE(writes_and_overwrites) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a");
  file.write("hello ");
  file.write("world");
  file.overwrite("H");
  file.sync();
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

BOOST_AUTO_TEST_CASE(a_file_is_new_and_its_rights_are_kept) {
  const TemporaryFolder folder;
  write_text(folder / "precious", "precious");
  std::filesystem::create_symlink("precious", folder / "rows");
  OutputFile rows(folder / "rows");
  rows.write("1,2\n");
  BOOST_TEST(read_text(folder / "precious") == "precious");
  BOOST_TEST(read_text(folder / "rows") == "1,2\n");
  std::filesystem::create_symlink("precious", folder / "link");
  BOOST_CHECK_THROW(OutputFile(folder / "link", OutputFile::Existing{}), OutputError);
  const auto owner_alone = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  std::filesystem::permissions(folder / "precious", owner_alone);
  write_file(folder / "precious", "new");
  BOOST_TEST((std::filesystem::status(folder / "precious").permissions() == owner_alone));
}

BOOST_AUTO_TEST_CASE(a_file_that_was_removed_meanwhile_is_said) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a");
  file.sync();
  std::filesystem::remove(folder / "a");
  BOOST_CHECK_THROW(file.sync(), OutputError);
}

BOOST_AUTO_TEST_CASE(reserved_space_has_no_name_and_more_than_there_is_is_not_reserved) {
  const TemporaryFolder folder;
  const ReservedSpace some(folder.path(), 1000);
  const ReservedSpace endless(folder.path(), std::size_t{1} << 62);
  const ReservedSpace nowhere(folder / "none", 1000);
  BOOST_TEST(std::filesystem::is_empty(folder.path()));
}

BOOST_AUTO_TEST_CASE(only_what_a_kill_left_half_written_is_removed) {
  const TemporaryFolder folder;
  for (const char* name :
       {".courant-0123456789abcdef", ".courant-0123", ".courant-0123456789abcdeg", "a.new"})
    write_text(folder / name, "x");
  remove_unfinished_files(folder.path());
  BOOST_TEST(!std::filesystem::exists(folder / ".courant-0123456789abcdef"));
  for (const char* name : {".courant-0123", ".courant-0123456789abcdeg", "a.new"})
    BOOST_TEST(std::filesystem::exists(folder / name), name);
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

BOOST_AUTO_TEST_CASE(what_does_not_fit_leaves_no_half) {
  const TemporaryFolder folder;
  rlimit before = {};
  BOOST_TEST_REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  OutputFile file(folder / "rows");
  file.write("1,2\n");
  rlimit limit = before;
  limit.rlim_cur = 6;
  BOOST_TEST_REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  std::string what;
  try {
    file.write("3,4\n");
  } catch (const OutputError& error) {
    what = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  BOOST_TEST(what == (folder / "rows").string() + ": cannot be written: File too large");
  BOOST_TEST(read_text(folder / "rows") == "1,2\n");
  file.write("5,6\n");
  BOOST_TEST(read_text(folder / "rows") == "1,2\n5,6\n");
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_an_error) {
  if (!std::filesystem::exists("/dev/full")) return;
  BOOST_CHECK_THROW(write_file("/dev/full", "x"), OutputError);
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
  // A file beside it is nobody's way.
  write_text(folder / "b.new", "precious");
  write_file(folder / "b", "b");
  BOOST_TEST(read_text(folder / "b.new") == "precious");
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
