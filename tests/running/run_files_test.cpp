#include "courant/running/run_files.hpp"

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "vortex_runs.hpp"

// Mistakes that these cases have to notice:
//  * the name of an event is taken for a number
BOOST_AUTO_TEST_SUITE(run_files)

using namespace courant;
using namespace courant::test;

namespace {

// The message of the error, which is one line.
template <class Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const RunFileError& error) {
    std::string message = error.what();
    BOOST_TEST(message.find('\n') == std::string::npos);
    return message;
  }
  return "accepted";
}

std::vector<double> random_doubles(std::size_t count) {
  std::mt19937_64 random(5);
  std::vector<double> values = {0.0, -0.0,    5e-324, std::numeric_limits<double>::max(),
                                0.1, -1.0 / 3};
  while (values.size() < count) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

std::string npy(const std::string& dictionary, const std::vector<double>& numbers) {
  std::string header = dictionary;
  header.append(118 - header.size() - 1, ' ').append("\n");
  std::string bytes =
      std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
  return bytes.append(reinterpret_cast<const char*>(numbers.data()),
                      numbers.size() * sizeof(double));
}

}  // namespace

// The hand-written schemes of the fixture are the ones of the paper: the table of the reading
// notes.
BOOST_AUTO_TEST_CASE(fixture_reproduces_the_table_of_section_6_3) {
  const auto drift = [](const Path& path) {
    double greatest = 0;
    for (const Vortices& q : path)
      greatest = std::max(greatest, std::abs(energy(q) - energy(path[0])));
    return greatest;
  };
  const Path rk2 = rk2_path(300), two_step = two_step_path(300), one_step = one_step_path(300);
  BOOST_TEST(std::abs(energy(leapfrogging) - -0.697421199668691) < 1e-14);
  BOOST_TEST(std::abs(rk2[300][0] - 24.4917867898) < 1e-9);
  BOOST_TEST(std::abs(two_step[300][1] - 22.5201202714) < 1e-9);
  BOOST_TEST(std::abs(one_step[300][4] - 2.1771929466) < 1e-9);
  BOOST_TEST(std::abs(drift(rk2) - 4.117e-4) < 1e-7);
  BOOST_TEST(std::abs(drift(two_step) - 1.921e-4) < 1e-7);
  BOOST_TEST(std::abs(drift(one_step) - 1.596e-4) < 1e-7);
}

BOOST_AUTO_TEST_CASE(reads_a_run) {
  const TemporaryFolder folder;
  const Path path = one_step_path(20);
  write_run(folder / "a run", path, "constrain-first");
  for (const std::string name : {"a run", "a run/", "a run/."}) {
    const Run run = read_run(folder / name);
    BOOST_TEST(run.name == "a run");
    BOOST_TEST(run.trajectory.rows() == 21);
    BOOST_TEST(run.summary.method == "constrain-first");
    BOOST_TEST(run.experiment.at("system").at("type") == "point-vortices");
    BOOST_TEST(run.trajectory.column("x[2]")[20] == path[20][2]);
    BOOST_TEST(run.coordinates() == (std::vector<std::string>{"x[0]", "x[1]", "x[2]", "x[3]",
                                                              "y[0]", "y[1]", "y[2]", "y[3]"}),
               boost::test_tools::per_element());
    BOOST_TEST(run.observables() == (std::vector<std::string>{"H", "spread"}),
               boost::test_tools::per_element());
    BOOST_TEST(run.constraints().empty());
    BOOST_CHECK_THROW(run.trajectory.column("z"), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(doubles_come_back_bit_for_bit) {
  const TemporaryFolder folder;
  const std::vector<double> values = random_doubles(5000);
  std::string text = "t,q,constraint[0]\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += shortest(values[i]) + "," + shortest(values[values.size() - 1 - i]) + ",nan\n";
  }
  write_text(folder / "trajectory.csv", text);
  const TrajectoryTable table = read_trajectory_csv(folder / "trajectory.csv");
  BOOST_TEST(same_bits(table.column("t"), values));
  BOOST_TEST(same_bits(table.column("q"), std::vector<double>(values.rbegin(), values.rend())));
  BOOST_TEST(std::isnan(table.column("constraint[0]")[7]));

  std::vector<double> by_row;
  for (std::size_t i = 0; i < values.size(); ++i) {
    by_row.push_back(values[i]);
    by_row.push_back(values[values.size() - 1 - i]);
  }
  write_text(folder / "rows.npy",
             npy("{'descr': '<f8', 'fortran_order': False, 'shape': (5000, 2), }", by_row));
  std::vector<double> by_column = values;
  by_column.insert(by_column.end(), values.rbegin(), values.rend());
  write_text(folder / "columns.npy",
             npy("{'descr': '<f8', 'fortran_order': True, 'shape': (5000, 2), }", by_column));
  for (const char* file : {"rows.npy", "columns.npy"}) {
    const TrajectoryTable same = read_trajectory_npy(folder / file, {"t", "q"});
    BOOST_TEST(same_bits(same.column("t"), table.column("t")));
    BOOST_TEST(same_bits(same.column("q"), table.column("q")));
  }
}

BOOST_AUTO_TEST_CASE(malformed_csv_is_refused_in_one_line) {
  const TemporaryFolder folder;
  const auto file = folder / "trajectory.csv";
  const auto said = [&](const std::string& text) {
    write_text(file, text);
    const std::string message = refusal([&] { read_trajectory_csv(file); });
    BOOST_TEST(message.starts_with(file.string()));
    return message.substr(std::min(message.size(), file.string().size()));
  };
  BOOST_TEST(said("") == ":1: the header is missing or cut off.");
  BOOST_TEST(said("t,x") == ":1: the header is missing or cut off.");
  BOOST_TEST(said("t,x\n0,1\n1,abc\n") == ":3: field 2 is \"abc\", expected a number.");
  BOOST_TEST(said("t,x\n0,1\n1,2.5x\n") == ":3: field 2 is \"2.5x\", expected a number.");
  BOOST_TEST(said("t,x\n0,\n") == ":2: field 2 is \"\", expected a number.");
  BOOST_TEST(said("t,x\n0\n") == ":2: the row has 1 field, expected 2 as in the header.");
  BOOST_TEST(said("t,x\n0,1,2\n") == ":2: the row has 3 fields, expected 2 as in the header.");
  BOOST_TEST(said("t,x\n0,1\n\n2,3\n") == ":3: field 1 is \"\", expected a number.");
  BOOST_TEST(said("t,x\n0,1\n1,2") == ":3: the row has no line end: the file is cut off.");
  BOOST_TEST(said("x,t\n0,1\n")
                 .starts_with(":1: TrajectoryTable: the first column is \"x\", expected t."));
  BOOST_TEST(
      said("t,x,x\n0,1,2\n").starts_with(":1: TrajectoryTable: two columns have the name \"x\"."));
  BOOST_TEST(said("t,x\n0,\x1b[31mred\n") == ":2: field 2 is \"?[31mred\", expected a number.");
  BOOST_TEST(refusal([&] {
               read_trajectory_csv(folder / "none.csv");
             }).ends_with("none.csv: cannot be read."));
}

BOOST_AUTO_TEST_CASE(malformed_npy_is_refused_in_one_line) {
  const TemporaryFolder folder;
  const auto file = folder / "trajectory.npy";
  const auto said = [&](const std::string& bytes) {
    write_text(file, bytes);
    return refusal([&] { read_trajectory_npy(file, {"t", "q"}); });
  };
  const std::string good =
      npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", {0, 1, 2, 3});
  BOOST_TEST(said(good) == "accepted");
  BOOST_TEST(said("PK").ends_with("is not an .npy file."));
  BOOST_TEST(said(good.substr(0, 60)).ends_with("the header is cut off."));
  BOOST_TEST(said(good.substr(0, good.size() - 3))
                 .ends_with("has 29 bytes of numbers, expected 32 for its shape."));
  BOOST_TEST(said(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }", {0, 1}))
                 .ends_with("the numbers are \"'<f4'\", expected '<f8', float64."));
  BOOST_TEST(said(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }", {0, 1, 2, 3}))
                 .ends_with("the shape is \"(4,\", expected (rows, columns)."));
  BOOST_TEST(said(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4), }", {0, 1, 2, 3}))
                 .ends_with("has 4 columns, expected 2 as in columns.json."));
  BOOST_TEST(said(npy("{}", {})).ends_with("expected '<f8', float64."));
}

BOOST_AUTO_TEST_CASE(malformed_json_is_refused_with_its_line) {
  const TemporaryFolder folder;
  const auto file = folder / "summary.json";
  const auto line = [&](const std::string& text) {
    write_text(file, text);
    const std::string message = refusal([&] { read_json(file); });
    BOOST_TEST(message.starts_with(file.string() + ":"));
    BOOST_TEST(message.find("is not JSON: syntax error") != std::string::npos);
    return std::stoi(message.substr(file.string().size() + 1));
  };
  BOOST_TEST(line("") == 1);
  BOOST_TEST(line("{\n  \"a\": 1,\n  b\n}") == 3);
  BOOST_TEST(line("{\n\"a\": \"two\nlines\"}") == 2);
  BOOST_TEST(line("{\"a\": [1,\n2\n") == 3);
  BOOST_TEST(line("{\"a\": \"\xff\"}") == 1);

  write_text(file, "{\"a\":\n1e999}");
  const std::string message = refusal([&] { read_json(file); });
  BOOST_TEST(message.starts_with(file.string()));
  BOOST_TEST(message.find("line 2, column") != std::string::npos, message);
  BOOST_TEST(message.find("1e999") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(incomplete_folders_are_refused) {
  const TemporaryFolder folder;
  const auto said = [&] { return refusal([&] { read_run(folder / "run"); }); };
  BOOST_TEST(said().ends_with("run: is not a folder; expected that of a run."));
  write_run(folder / "run", rk2_path(3), "rk2");
  BOOST_TEST(said() == "accepted");
  write_text(folder / "run/summary.json", "{\"status\": \"completed\", \"system\": 3}");
  BOOST_TEST(said().ends_with("summary.json: /system: is number, expected a string."));
  write_text(folder / "run/summary.json",
             R"({"status": "", "system": "", "method": "", "steps": 1, "final": {"a\nb": ""}})");
  BOOST_TEST(said().ends_with("summary.json: /final/a?b: is string, expected a number."));
  std::filesystem::remove(folder / "run/summary.json");
  BOOST_TEST(said().ends_with("summary.json: cannot be read."));
  std::filesystem::remove(folder / "run/trajectory.csv");
  BOOST_TEST(said().ends_with("run: has no trajectory.csv or trajectory.npy."));
  write_text(folder / "run/summary.json",
             R"({"status": "completed", "system": "", "method": "", "steps": 1, "final": {}})");
  write_text(folder / "run/trajectory.npy", "");
  write_text(folder / "run/columns.json", "[\"t\", 3]");
  BOOST_TEST(said().ends_with("columns.json: is not an array of names."));
}

// A kill leaves a summary that says "running", and perhaps half of a row.
BOOST_AUTO_TEST_CASE(a_run_that_did_not_end_is_read_as_far_as_it_got) {
  const TemporaryFolder folder;
  write_run(folder / "run", rk2_path(3), "rk2");
  const std::string rows = read_text(folder / "run/trajectory.csv");
  write_text(folder / "run/trajectory.csv", rows.substr(0, rows.size() - 7));
  BOOST_TEST(refusal([&] { read_run(folder / "run"); }).find("cut off") != std::string::npos);
  auto summary = nlohmann::ordered_json::parse(read_text(folder / "run/summary.json"));
  summary["status"] = "running";
  write_text(folder / "run/summary.json", summary.dump());
  const Run run = read_run(folder / "run");
  BOOST_TEST(run.trajectory.rows() == 3u);
  BOOST_TEST(run.summary.message == "The run did not end: it was killed.");
  BOOST_TEST(run.summary.steps == 2);  // from the first to the third row

  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
  write_text(folder / "a.npy", npy(header, {0, 1, 2, 3, 4}));
  BOOST_TEST(refusal([&] { read_trajectory_npy(folder / "a.npy", {"t", "q"}); }) != "accepted");
  BOOST_TEST(read_trajectory_npy(folder / "a.npy", {"t", "q"}, true).rows() == 2u);
}

BOOST_AUTO_TEST_CASE(files_of_two_runs_are_refused) {
  const TemporaryFolder folder;
  write_run(folder / "run", rk2_path(3), "rk2");
  auto summary = nlohmann::ordered_json::parse(read_text(folder / "run/summary.json"));
  auto experiment = nlohmann::ordered_json::parse(read_text(folder / "run/experiment.json"));
  summary["id"] = "a";
  experiment["$run"] = "a";
  summary["status"] = "completed";
  const auto said = [&] {
    write_text(folder / "run/summary.json", summary.dump());
    write_text(folder / "run/experiment.json", experiment.dump());
    return refusal([&] { read_run(folder / "run"); });
  };
  BOOST_TEST(said() == "accepted");
  summary["final"]["x[0]"] = 17.0;
  BOOST_TEST(said().ends_with("is of another run than summary.json: x[0] ends elsewhere."));
  experiment["$run"] = "b";
  BOOST_TEST(said().ends_with("experiment.json: is of another run than summary.json."));
}

BOOST_AUTO_TEST_CASE(events_are_read_by_their_names) {
  const TemporaryFolder folder;
  write_run(folder / "run", rk2_path(3), "rk2");
  BOOST_TEST(read_run(folder / "run").events.empty());
  const auto file = folder / "run/events.csv";
  write_text(file, "event,t,x [m]\npass,0.5,1\nturn,0.75,-2\npass,1.5,3\n");
  const auto events = read_run(folder / "run").events;
  BOOST_TEST_REQUIRE(events.size() == 2U);
  BOOST_TEST_REQUIRE(events.at("pass").rows() == 2U);
  BOOST_TEST(events.at("pass").column("t")[1] == 1.5);
  BOOST_TEST(events.at("pass").column("x")[1] == 3);
  BOOST_TEST(events.at("turn").column("x")[0] == -2);

  const auto said = [&](const std::string& text) {
    write_text(file, text);
    const std::string message = refusal([&] { read_events_csv(file); });
    return message.substr(std::min(message.size(), file.string().size()));
  };
  BOOST_TEST(said("") == ":1: the header is missing or cut off.");
  BOOST_TEST(said("t,x\n") == ":1: the first column is \"t\", expected event.");
  BOOST_TEST(said("event,t\npass,red\n") == ":2: field 1 is \"red\", expected a number.");
  BOOST_TEST(said("event,t\npass\n") == ":2: field 1 is \"\", expected a number.");
  BOOST_TEST(said("event,x\npass,1\n").starts_with(":1: TrajectoryTable: the first column is"));
  BOOST_TEST(said("event,t\npass,1") == ":2: the row has no line end: the file is cut off.");
  BOOST_TEST(read_events_csv(file, true).empty());
}

BOOST_AUTO_TEST_CASE(units_in_the_heads_of_columns_are_no_part_of_the_names) {
  const TemporaryFolder folder;
  write_text(folder / "a.csv", "t [s],x[0] [m],p [kg m/s],H\n0,1,2,3\n");
  const TrajectoryTable table = read_trajectory_csv(folder / "a.csv");
  BOOST_CHECK(table.names() == (std::vector<std::string>{"t", "x[0]", "p", "H"}));
  write_text(folder / "b.csv", "t,q [m],q [km]\n0,1,2\n");
  BOOST_CHECK_THROW(read_trajectory_csv(folder / "b.csv"), RunFileError);
}

BOOST_AUTO_TEST_SUITE_END()
