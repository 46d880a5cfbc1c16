#include "courant/reading/mesh_file.hpp"

#include <boost/test/unit_test.hpp>
#include <sstream>

#include "courant/reading/table.hpp"

// Mistakes that these cases have to notice:
//  * nodes are numbered by their order in the file (reading/mesh_file.cpp)
//  * groups of entities are those of another dimension (reading/mesh_file.cpp)
//  * a mesh is read only in the system itself (reading/table.cpp)
BOOST_AUTO_TEST_SUITE(mesh_file_test)

using namespace courant;

namespace {

// Two triangles, a node that is in none, and two groups of edges, one without a name.
const std::string old_mesh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "the left"
2 9 "all"
$EndPhysicalNames
$Nodes
5
3 0 0 0
8 1 0.5 0
4 1 -0.5 0
1 9 9 9
6 2 0 0.25
$EndNodes
$Elements
5
1 15 2 0 1 3
2 1 2 7 1 3 8
3 1 2 5 2 4 6
4 2 2 9 1 3 4 8
5 2 2 9 1 4 6 8
$EndElements
)";

const std::string new_mesh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 "the left"
2 9 "all"
$EndPhysicalNames
$Entities
1 2 1 0
7 0 0 0 1 5
1 0 0 0 1 1 0 1 7 2 1 -2
2 1 0 0 2 0 0 1 5 0
1 0 0 0 2 1 0 1 9 2 1 2
$EndEntities
$Nodes
2 5 1 8
1 1 0 2
3
8
0 0 0
1 0.5 0
2 1 0 3
4
1
6
1 -0.5 0
9 9 9
2 0 0.25
$EndNodes
$Elements
3 4 1 5
1 1 1 1
2 3 8
1 2 1 1
3 4 6
2 1 2 2
4 3 4 8
5 4 6 8
$EndElements
)";

Json mesh(const std::string& text) {
  std::istringstream stream(text);
  return read_mesh(stream);
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  BOOST_REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), by);
}

std::string problem(const std::string& text) {
  try {
    mesh(text);
  } catch (const MeshError& error) {
    return std::to_string(error.line()) + " " + error.what();
  }
  return "";
}

}  // namespace

// Vertices in the order of their numbers in the file: 3, 4, 6, 8.
BOOST_AUTO_TEST_CASE(both_formats) {
  const Json expected = Json::parse(R"json({
    "vertices": [[0.0, 0.0, 0.0], [1.0, -0.5, 0.0], [2.0, 0.0, 0.25], [1.0, 0.5, 0.0]],
    "simplices": [[0, 1, 3], [1, 2, 3]],
    "facets": { "the left": [[0, 3]], "5": [[1, 2]] } })json");
  BOOST_TEST(mesh(old_mesh) == expected);
  BOOST_TEST(mesh(new_mesh) == expected);
}

BOOST_AUTO_TEST_CASE(what_is_wrong) {
  BOOST_TEST(problem("") == "0 does not begin with $MeshFormat; expected a mesh of Gmsh");
  BOOST_TEST(problem(replaced(old_mesh, "2.2 0", "2.2 1"))
                 .starts_with("2 has the format 2.2, not as text"));
  BOOST_TEST(
      problem(replaced(old_mesh, "2.2 0", "3 0")).starts_with("2 has the format 3; expected 2.2"));
  BOOST_TEST(problem(replaced(old_mesh, "8 1 0.5 0", "8 1 half 0")) ==
             "12 has \"half\"; expected a number");
  BOOST_TEST(problem(replaced(old_mesh, "4 2 2 9 1", "4 3 2 9 1"))
                 .starts_with("22 has an element of the type 3"));
  BOOST_TEST(problem(replaced(old_mesh, "3 4 8", "3 4 5")) ==
             "22 has the node 5, which is not there");
  BOOST_TEST(problem(replaced(old_mesh, "1 3 8\n", "1 3 1\n")) ==
             "20 has the node 1, which belongs to no simplex");
  BOOST_TEST(problem(new_mesh.substr(0, new_mesh.find("2 1 2 2")))
                 .ends_with("in the middle of a section"));
  BOOST_TEST(problem(replaced(old_mesh, "$Nodes\n5", "$Nodes\n5000000"))
                 .starts_with("10 has 5000000 parts"));
  BOOST_TEST(problem("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n") ==
             "0 has no edges, triangles or tetrahedra");
  BOOST_TEST(problem(replaced(new_mesh, "0 1 7 2 1 -2", "0 1 -9223372036854775808 2 1 -2")) ==
             "12 has \"-9223372036854775808\"; expected a whole number");
}

// A few bytes that ask for much, and what is little in each section.
BOOST_AUTO_TEST_CASE(bounds) {
  std::string words;
  for (int i = 0; i < 1'000'001; ++i) words += "1 ";
  BOOST_TEST(problem(replaced(old_mesh, "3 0 0 0", words)) ==
             "11 has more than 1000000 words; expected fewer");

  const std::size_t elements = old_mesh.find("$Elements");
  std::string many = old_mesh.substr(0, elements);
  for (int section = 0; section < 2; ++section) {
    many += "$Elements\n600000\n";
    for (int i = 0; i < 600'000; ++i) many += "1 1 0 3 8\n";
  }
  BOOST_TEST(problem(many).ends_with("is beyond 1000000 elements in all; expected fewer"));

  // 2000 groups of an entity, each of its 600 elements in all of them.
  std::string groups = "2000";
  for (int i = 0; i < 2000; ++i) groups += " 7";
  std::string crowded =
      replaced(replaced(new_mesh, "1 7 2 1 -2", groups), "1 1 1 1\n", "1 1 1 600\n");
  std::string edges;
  for (int i = 0; i < 600; ++i) edges += "2 3 8\n";
  BOOST_TEST(problem(replaced(crowded, "2 3 8\n", edges))
                 .ends_with("is beyond 1000000 places of elements in groups in all; expected "
                            "fewer"));
}

// In a system, and in one that is a part of another.
BOOST_AUTO_TEST_CASE(in_an_experiment) {
  const OpenTable open = [](const std::string&, const std::string& file) {
    return TableFile{file,
                     file == "m.msh" ? std::make_unique<std::istringstream>(old_mesh) : nullptr};
  };
  Json document = Json::parse(R"json({ "system": { "complex": { "mesh": "m.msh" },
                                                   "systems": { "a": { "complex": { "mesh": "m.msh" } } } } })json");
  load_tables(document, open);
  BOOST_TEST(document["system"]["complex"] == mesh(old_mesh));
  BOOST_TEST(document["system"]["systems"]["a"]["complex"] == mesh(old_mesh));
  const auto problem_of = [&](const char* text) {
    Json wrong = Json::parse(text);
    try {
      load_tables(wrong, open);
    } catch (const ExperimentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(problem_of(R"({ "system": { "complex": { "mesh": "n.msh" } } })") ==
             "/system/complex/mesh: n.msh cannot be read; expected a mesh of Gmsh");
  BOOST_TEST(problem_of(R"({ "system": { "complex": { "mesh": "m.msh", "vertices": [] } } })") ==
             "/system/complex/vertices: is in m.msh too; expected it once");
}

BOOST_AUTO_TEST_SUITE_END()
