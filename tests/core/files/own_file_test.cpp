#include "courant/core/files/own_file.hpp"

#include <boost/test/unit_test.hpp>
#include <filesystem>

#include "courant/core/files/content_hash.hpp"
#include "courant/core/files/output_file.hpp"
#include "temporary_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * what was edited is still ours
//  * a file that is not ours is replaced through a link
BOOST_AUTO_TEST_SUITE(own_file_test)

namespace {

const std::string png = std::string("\x89PNG\r\n\x1a\n", 8) + "pixels" +
                        std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12);
const std::vector<std::string> contents = {"<svg></svg>\n",
                                           "{\n  \"a\": 1\n}\n",
                                           "%PDF-1.5\n%%EOF\n",
                                           ".TH X\n",
                                           "# Title\n",
                                           "\\documentclass{article}\n",
                                           "int main(void) { return 0; }\n",
                                           png};

}  // namespace

BOOST_AUTO_TEST_CASE(a_mark_is_read_back_from_every_format) {
  for (const std::string& content : contents)
    for (const std::string& beside : {std::string(), content_hash("1,2\n")}) {
      const FileMark mark{.command = "plot", .beside = beside};
      const std::string marked = mark.on(content);
      BOOST_TEST(marked.size() > content.size());
      const auto found = FileMark::of(marked);
      BOOST_TEST_REQUIRE(found.has_value());
      BOOST_TEST(found->command == "plot");
      BOOST_TEST(found->beside == beside);
      BOOST_TEST(!FileMark::of(content));
    }
}

BOOST_AUTO_TEST_CASE(whatever_byte_is_edited_it_is_no_longer_ours) {
  for (const std::string& content : contents) {
    const std::string marked = FileMark{.command = "plot"}.on(content);
    for (std::size_t i = 0; i < marked.size(); ++i) {
      std::string edited = marked;
      edited[i] = static_cast<char>(edited[i] ^ 1);
      BOOST_TEST(!FileMark::of(edited), "byte " << i << " of " << content);
    }
    BOOST_TEST(!FileMark::of(marked + "x"));
    BOOST_TEST(!FileMark::of("x" + marked));
    BOOST_TEST(!FileMark::of(marked.substr(0, marked.size() - 1)));
  }
}

// Its pictures are looked at by others.
BOOST_AUTO_TEST_CASE(a_marked_png_has_a_whole_chunk_more) {
  const std::string marked = FileMark{.command = "plot"}.on(png);
  BOOST_TEST(marked.ends_with(png.substr(png.size() - 12)));
  const std::size_t chunk = marked.find("tEXt");
  BOOST_TEST_REQUIRE(chunk == png.size() - 12 + 4);
  std::size_t length = 0;
  for (std::size_t i = chunk - 4; i < chunk; ++i)
    length = 256 * length + static_cast<unsigned char>(marked[i]);
  BOOST_TEST(chunk + 4 + length + 4 + 12 == marked.size());
}

BOOST_AUTO_TEST_CASE(files_of_others_are_refused_unless_forced) {
  const TemporaryFolder folder;
  const auto file = folder / "a.svg";
  const OwnFiles plot("plot"), forced("plot", true);
  plot.write(file, "<svg/>");
  plot.write(file, "<svg>2</svg>");
  BOOST_TEST(mark_of(file).has_value());
  write_text(file, "<svg>mine</svg>\n");
  BOOST_CHECK_EXCEPTION(plot.check(file), RefusedOutput, [&](const RefusedOutput& error) {
    return error.what() == file.string() +
                               ": is there already, and is not as courant wrote it; expected "
                               "another name (-o), or --force to replace it";
  });
  BOOST_CHECK_THROW(plot.write(file, "<svg/>"), RefusedOutput);
  BOOST_TEST(read_text(file) == "<svg>mine</svg>\n");
  forced.write(file, "<svg/>");
  plot.check(file);
  plot.check(folder / "none");
  plot.write("/dev/null", "<svg/>");
}

BOOST_AUTO_TEST_CASE(force_replaces_by_name_and_not_through_a_link) {
  const TemporaryFolder folder;
  write_text(folder / "theirs", "mine\n");
  std::filesystem::create_symlink("theirs", folder / "link");
  const OwnFiles forced("plot", true);
  BOOST_CHECK_EXCEPTION(
      forced.write(folder / "link", "<svg/>"), RefusedOutput, [&](const RefusedOutput& error) {
        return error.what() == (folder / "link").string() +
                                   ": is a link to theirs, which is not as courant wrote it; "
                                   "expected the name of the file itself";
      });
  BOOST_TEST(read_text(folder / "theirs") == "mine\n");
  forced.write(folder / "theirs", "<svg/>");
  OwnFiles("plot").write(folder / "link", "<svg>2</svg>");
  BOOST_TEST(std::filesystem::is_symlink(folder / "link"));
  BOOST_TEST(read_text(folder / "theirs").starts_with("<svg>2</svg>"));
}

BOOST_AUTO_TEST_CASE(content_is_read_whole_and_what_cannot_be_read_is_empty) {
  const TemporaryFolder folder;
  const std::string bytes("two\r\nlines\0", 11);
  write_text(folder / "file", bytes);
  BOOST_TEST((content_of(folder / "file") == bytes));
  BOOST_TEST(content_of(folder / "none") == "");
  BOOST_TEST(content_of(folder.path()) == "");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
