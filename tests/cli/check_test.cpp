// `courant check`, on experiments and on what is wrong.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "answer.hpp"
#include "courant/cli/command.hpp"
#include "courant/reading/findings.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a check that failed exits with 0
BOOST_AUTO_TEST_SUITE(check_command)

namespace {

using test::Answer;
using test::courant_command;

// The JSON of a check that has to be passed.
Json checked(const std::string& experiment) {
  const Answer result = courant_command({"check", "experiments/" + experiment + ".json", "--json"});
  BOOST_TEST(result.status == 0, experiment << ": " << result.err << result.out.substr(0, 200));
  return result.status == 0 ? Json::parse(result.out) : Json();
}

Json law(const Json& report, const std::string& name) {
  for (const Json& check : report.at("checks"))
    if (check.at("law") == name) return check;
  return Json();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_json_has_the_names_of_the_contract) {
  const Json report = checked("pendulum");
  for (const char* key : {"passed", "checks", "structure", "method"})
    BOOST_TEST(report.contains(key), key);
  for (const char* key : {"subject", "law", "passed", "defect", "bound"})
    BOOST_TEST(report.at("checks").at(0).contains(key), key);
  for (const char* key : {"dimension", "rank_of_F", "isotropic", "coisotropic", "dirac",
                          "integrable", "integrability_defect"})
    BOOST_TEST(report.at("structure").contains(key), key);
  for (const char* key : {"order", "symmetric", "symplectic", "symplecticity_defect"})
    BOOST_TEST(report.at("method").contains(key), key);
  BOOST_TEST(report.at("checks").at(0).at("subject") == "manifold");
  BOOST_TEST(law(report, "R1").at("passed") == true);
  BOOST_TEST(law(report, "R2").at("passed") == true);
  const Json omega = report.at("structure").at("pair").at("omega");
  BOOST_TEST(omega.size() == 2U);
  BOOST_TEST(std::abs(std::abs(omega.at(0).at(1).get<double>()) - 1.0) < 1e-12);
  BOOST_TEST(omega.at(0).at(1).get<double>() + omega.at(1).at(0).get<double>() == 0.0);
  BOOST_TEST(report.at("method").at("symplectic") == true);
}

// Proposition 7.1: open is coisotropic and not Dirac, closed is Dirac.
BOOST_AUTO_TEST_CASE(proposition_7_1) {
  for (const std::string name : {"port_hamiltonian_open", "port_hamiltonian_closed"}) {
    const Json report = checked(name);
    BOOST_TEST(law(report, "7.1").at("passed") == true);
    BOOST_TEST(report.at("structures").size() == 2U);
    for (const Json& structure : report.at("structures")) {
      const bool open = structure.at("ports") == "open ports";
      BOOST_TEST(structure.at("coisotropic") == true);
      BOOST_TEST(structure.at("dirac") == !open);
      BOOST_TEST(structure.at("isotropic") == !open);
      const int n = structure.at("manifold_dimension");
      BOOST_TEST(structure.at("dimension") == (open ? n + 1 : n));
    }
    BOOST_TEST(report.at("structure").at("ports").get<std::string>() ==
               name.substr(std::string("port_hamiltonian_").size()) + " ports");
  }
}

BOOST_AUTO_TEST_CASE(integrability_is_told_and_where_it_fails) {
  for (const char* name :
       {"structure_two_form", "structure_gauge", "structure_lie_poisson", "structure_bivector",
        "structure_restricted_bivector", "structure_product", "structure_composed",
        "structure_pullback", "structure_pushforward"}) {
    const Json structure = checked(name).at("structure");
    BOOST_TEST(structure.at("integrable") == true, name);
    BOOST_TEST(structure.at("not_integrable_at").is_null(), name);
  }
  for (const char* name : {"structure_distribution", "structure_restricted_two_form"}) {
    const Json structure = checked(name).at("structure");
    BOOST_TEST(structure.at("integrable") == false, name);
    BOOST_TEST(structure.at("integrability_defect").get<double>() > 0.1, name);
    BOOST_TEST(structure.at("not_integrable_at").contains("x"), name);
  }
  const Json top = checked("structure_lie_poisson").at("structure");
  BOOST_TEST(top.at("rank_of_F") == 4);
  BOOST_TEST(top.at("casimirs") == 2);
  // A plane and a sphere; two halves of a symplectic plane; a surface; T*SO(3) reduced to so(3)*.
  const auto rank_of_F = [](const char* name) {
    return checked(name).at("structure").at("rank_of_F").get<int>();
  };
  BOOST_TEST(rank_of_F("structure_product") == 4);
  BOOST_TEST(rank_of_F("structure_composed") == 2);
  BOOST_TEST(rank_of_F("structure_pullback") == 3);
  BOOST_TEST(rank_of_F("structure_pushforward") == 2);
}

BOOST_AUTO_TEST_CASE(methods_are_measured) {
  const Json rk2 = checked("point_vortices_rk2").at("method");
  BOOST_TEST(rk2.at("symplectic") == false);
  BOOST_TEST(rk2.at("symplecticity_defect").get<double>() > 1e-6);
  BOOST_TEST(rk2.at("symmetric") == false);
  const Json method2 = checked("point_vortices").at("method");
  BOOST_TEST(method2.at("symplectic") == true);
  BOOST_TEST(method2.at("symplecticity_defect").get<double>() < 1e-10);
  BOOST_TEST(std::abs(method2.at("measured_order").get<double>() - 2.0) < 0.1);
  // Proposition 6.3: α of the predators is not linear.
  BOOST_TEST(checked("lotka_volterra").at("method").at("symplectic") == false);
}

BOOST_AUTO_TEST_CASE(a_system_without_a_structure_says_so) {
  const Answer text = courant_command({"check", "experiments/pendulum_cartesian.json"});
  BOOST_TEST(text.status == 0);
  BOOST_TEST(text.out.find("without a Dirac structure") != std::string::npos, text.out);
  BOOST_TEST(checked("pendulum_cartesian").at("structure").is_null());
}

BOOST_AUTO_TEST_CASE(the_table_is_readable) {
  const Answer text = courant_command({"check", "experiments/structure_restricted_two_form.json"});
  for (const char* part : {"S2 ", "D4 ", "integrable no", "it fails at x = ",
                           "F_D, a basis in columns", "symplectic", "dH/dt", "All laws hold."})
    BOOST_TEST(text.out.find(part) != std::string::npos, part << " is not in\n" << text.out);
}

BOOST_AUTO_TEST_CASE(exit_status) {
  BOOST_TEST(courant_command({"check", "-"}, "{}").status == 2);
  BOOST_TEST(courant_command({"check", "no such file"}).status == 2);
  // A law that fails: the distribution of x dx is not regular at 0.
  const Answer irregular = courant_command({"check", "-"}, R"json({
    "system": { "type": "hamiltonian", "coordinates": ["x", "y"],
                "structure": { "type": "distribution", "forms": ["x", 0] },
                "hamiltonian": "x^2/2" },
    "initial": { "x": 0, "y": 1 }
  })json");
  BOOST_TEST(irregular.status == 3, irregular.err);
  BOOST_TEST(irregular.out.find("S6 constant ranks") != std::string::npos);
  BOOST_TEST(irregular.out.find("Some laws do not hold.") != std::string::npos);
}

// Failures and words: no codes of laws.
BOOST_AUTO_TEST_CASE(brief_is_a_few_lines) {
  const Answer brief = courant_command({"check", "experiments/pendulum.json", "--brief"});
  BOOST_TEST(brief.status == 0);
  for (const char* part : {"manifold: all ", " laws hold\n", " is Dirac and integrable.\n",
                           "has order 2, is symmetric and is symplectic.\n", "All laws hold.\n"})
    BOOST_TEST(brief.out.find(part) != std::string::npos, part << " is not in\n" << brief.out);
  BOOST_TEST(std::count(brief.out.begin(), brief.out.end(), '\n') < 15);
  for (const char* code : {" R1 ", " S2 ", " D3 "})
    BOOST_TEST(brief.out.find(code) == std::string::npos);
  BOOST_TEST(courant_command({"check", "experiments/pendulum.json", "--brief", "--json"}).status ==
             2);
}

// The diode of a rectifier at rest makes 10⁻⁸ s of a circuit that is run in steps of 10⁻⁵: the order shows
// in shorter ones, and the circuit goes back in time by shorter ones alone.
BOOST_AUTO_TEST_CASE(the_order_of_a_stiff_system_shows_in_short_steps) {
  const Json report = checked("network_rectifier");
  BOOST_TEST(law(report, "P1").at("passed") == true);
  BOOST_TEST(law(report, "P6").at("passed") == true);
  BOOST_TEST(std::abs(report.at("method").at("measured_order").get<double>() - 2.0) < 0.15);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
