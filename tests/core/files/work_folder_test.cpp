#include "courant/core/files/work_folder.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/files/output_file.hpp"
#include "temporary_folder.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(work_folder_test)

BOOST_AUTO_TEST_CASE(is_gone_with_its_object) {
  const TemporaryFolder folder;
  std::filesystem::path path;
  {
    const WorkFolder work(folder.path());
    path = work.path();
    write_text(path / "inside" / "file", "x");
    BOOST_TEST(WorkFolder::is_name(path.filename().string()));
    BOOST_TEST((std::filesystem::status(path).permissions() == std::filesystem::perms::owner_all));
  }
  BOOST_TEST(!std::filesystem::exists(path));
  BOOST_CHECK_THROW(WorkFolder(folder / "none"), OutputError);
}

BOOST_AUTO_TEST_CASE(of_what_was_left_behind_only_its_own_names_are_removed) {
  const TemporaryFolder folder;
  const WorkFolder in_use(folder.path());
  for (const char* name :
       {"courant-work-aB3dE5", "courant-work-aB3dE56", "courant-work-aB-dE5", "work"})
    std::filesystem::create_directory(folder / name);
  for (const auto& item : std::filesystem::directory_iterator(folder.path()))
    std::filesystem::last_write_time(
        item, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  WorkFolder::remove_left_behind(folder.path());
  BOOST_TEST(!std::filesystem::exists(folder / "courant-work-aB3dE5"));
  for (const char* name : {"courant-work-aB3dE56", "courant-work-aB-dE5", "work"})
    BOOST_TEST(std::filesystem::exists(folder / name), name);
  BOOST_TEST(std::filesystem::exists(in_use.path()));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
