#include "courant/core/files/content_hash.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <set>

#include "temporary_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * parts that changed places are the same
BOOST_AUTO_TEST_SUITE(content_hash_test)

namespace {

std::string random_bytes(std::size_t count) {
  std::mt19937 generator(3);
  std::string bytes(count, ' ');
  for (char& byte : bytes) byte = static_cast<char>(generator());
  return bytes;
}

}  // namespace

// As xxhsum -H2 prints them.
BOOST_AUTO_TEST_CASE(is_that_of_xxhash) {
  BOOST_TEST(content_hash("") == "99aa06d3014798d86001c324468d497f");
  BOOST_TEST(content_hash("abc").size() == 32u);
  BOOST_TEST(content_hash("abc") != content_hash("abd"));
}

BOOST_AUTO_TEST_CASE(the_pieces_that_bytes_came_in_do_not_matter) {
  const std::string bytes = random_bytes(3'000'000);  // parts of several leaves
  HashedBytes whole, pieces;
  whole.append(bytes);
  std::mt19937 generator(4);
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = std::min<std::size_t>(generator() % 9000, bytes.size() - at);
    pieces.append(std::string_view(bytes).substr(at, size));
    pieces.record();  // asking changes nothing
    at += size;
  }
  BOOST_TEST((whole.record() == pieces.record()));
  BOOST_TEST(whole.record().size == bytes.size());
  BOOST_TEST(whole.record().hashes.size() <= HashedBytes::kMostParts);
  BOOST_TEST(whole.record().part == 16384u);
}

BOOST_AUTO_TEST_CASE(a_byte_that_changed_is_found_in_its_part) {
  const TemporaryFolder folder;
  for (const std::size_t size : {1u, 4096u, 4097u, 100'000u, 2'000'000u}) {
    const std::string bytes = random_bytes(size);
    HashedBytes hashed;
    hashed.append(bytes);
    const auto record = hashed.record();
    const auto file = folder / "file";
    write_text(file, "head" + bytes + "tail");
    HashedBytes found;
    BOOST_TEST(difference(file, 4, record, &found).is_none());
    BOOST_TEST((found.record() == record));
    for (const std::size_t at : {std::size_t{0}, size / 2, size - 1}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] + 1);
      write_text(file, "head" + other);
      const Difference there = difference(file, 4, record);
      BOOST_TEST(there.from <= at + 4);
      BOOST_TEST(at + 4 < there.to);
      BOOST_TEST(there.to - there.from <= record.part);
    }
    write_text(file, "head" + bytes.substr(0, size / 2));
    BOOST_TEST(!difference(file, 4, record).is_none());
    BOOST_TEST(!difference(folder / "none", 4, record).is_none());
  }
}

// Two leaves that changed places are not the same sum.
BOOST_AUTO_TEST_CASE(places_matter) {
  const std::string a(4096, 'a'), b(4096, 'b');
  HashedBytes one, other;
  for (int i = 0; i < 300; ++i) one.append(i % 2 == 0 ? a : b);
  for (int i = 0; i < 300; ++i) other.append(i % 2 == 0 ? b : a);
  BOOST_TEST((one.record() != other.record()));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
