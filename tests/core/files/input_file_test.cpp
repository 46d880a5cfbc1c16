#include "courant/core/files/input_file.hpp"

#include <sys/stat.h>

#include <boost/test/unit_test.hpp>
#include <iterator>
#include <string>

#include "temporary_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a pipe is opened, and waited for
BOOST_AUTO_TEST_SUITE(input_file_test)

BOOST_AUTO_TEST_CASE(a_file_is_read_byte_by_byte_also_behind_a_link) {
  const TemporaryFolder folder;
  const std::string bytes("two\r\nlines\0", 11);
  write_text(folder / "file", bytes);
  std::filesystem::create_symlink("file", folder / "link");
  for (const char* name : {"file", "link"}) {
    std::ifstream stream = input_file(folder / name);
    BOOST_TEST((std::string(std::istreambuf_iterator<char>(stream), {}) == bytes), name);
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_file_is_not_waited_for) {
  const TemporaryFolder folder;
  BOOST_TEST_REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::filesystem::create_symlink("pipe", folder / "link");
  std::filesystem::create_symlink("itself", folder / "itself");
  for (const char* name : {"pipe", "link", "itself", "none", "."})
    BOOST_TEST(!input_file(folder / name), name);
  BOOST_TEST(!input_file("/dev/zero"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
