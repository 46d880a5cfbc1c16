#include "courant/running/structure_description.hpp"

#include "courant/manifolds/measurement.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/integrability.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/rank_profile.hpp"

namespace courant {
namespace {

Json rows(const MatrixXd& matrix) {
  Json json = Json::array();
  for (Index i = 0; i < matrix.rows(); ++i) {
    const VectorXd row = matrix.row(i);
    json.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return json;
}

}  // namespace

Json structure_description(const std::string& ports, const DiracStructure& structure,
                           const std::vector<VectorXd>& points,
                           const std::vector<std::string>& coordinates) {
  const auto point = [&](const VectorXd& x) {
    Json json = Json::object();
    for (Index i = 0; i < x.size(); ++i) json[coordinates[static_cast<std::size_t>(i)]] = x[i];
    return json;
  };
  const VectorXd& x = points.front();
  const PairedSubspace D = structure.fibre(x);
  const RankProfile ranks = rank_profile(structure, points);
  const FibreRanks& here = ranks.at.front();
  const bool dirac = D.is_dirac();
  Json json{{"name", structure.name()},
            {"ports", ports},
            {"dimension", D.dimension()},
            {"manifold_dimension", structure.manifold()->dimension()},
            {"rank_of_F", here.vector_range},
            {"isotropic", D.is_isotropic()},
            {"isotropy_defect", D.isotropy_defect()},
            {"coisotropic", D.is_coisotropic()},
            {"coisotropy_defect", D.coisotropy_defect()},
            {"dirac", dirac},
            {"claims_dirac", structure.is_dirac()},
            {"kind", Json()},
            {"rank_of_form", Json()},
            {"casimirs", Json()},
            {"pair", Json()},
            {"integrable", Json()},
            {"integrability_defect", Json()},
            {"integrability", ""},
            {"not_integrable_at", Json()},
            {"rank_jumps_at", Json::array()},
            {"gap", ranks.generic.gap}};
  for (const std::size_t i : ranks.jumps) json["rank_jumps_at"].push_back(point(points[i]));
  if (!dirac) {
    json["integrability"] = "not defined: D is not a Dirac structure";
    return json;
  }
  const LinearDirac linear(D);
  const auto [F, omega] = linear.form();
  json["kind"] = linear.kind();
  json["rank_of_form"] = here.rank_of_form();
  json["casimirs"] = here.casimirs();
  json["pair"] = {{"F", rows(F)}, {"omega", rows(omega)}};
  const IntegrabilitySurvey survey = integrability(structure, points);
  if (survey.undefined == survey.points) {
    json["integrability"] = "not defined: " + survey.worst.undefined;
    return json;
  }
  json["integrable"] = survey.integrable();
  json["integrability_defect"] = survey.worst.defect;
  json["integrability"] = "Courant's condition at " +
                          std::to_string(survey.points - survey.undefined) + " of " +
                          std::to_string(survey.points) + " points";
  if (!survey.integrable()) json["not_integrable_at"] = point(survey.worst.x);
  return json;
}

std::vector<LawResult> proposition_7_1(const DiracStructure& structure,
                                       const std::vector<VectorXd>& points) {
  const bool open = dynamic_cast<const OpenPortHamiltonian*>(&structure) != nullptr;
  if (!open && !dynamic_cast<const ClosedPortHamiltonian*>(&structure)) return {};
  LawMeasurement law(structure.name(),
                     open ? "7.1 coisotropic, and Dirac only where B = 0 (1 where not)"
                          : "7.1 Dirac (1 where not)",
                     0.0);
  for (const VectorXd& x : points)
    law.add(
        [&] {
          const PairedSubspace D = structure.fibre(x);
          const bool no_input = fibre_ranks(structure, x).ports == 0;
          const bool holds = open ? D.is_coisotropic() && D.is_dirac() == no_input : D.is_dirac();
          return holds ? 0.0 : 1.0;
        },
        courant::describe("x", x));
  return {law.result()};
}

}  // namespace courant
