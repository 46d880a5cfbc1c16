#include "courant/systems/ladder_json.hpp"

namespace courant {
namespace {

Json known(Index value) { return value < 0 ? Json() : Json(value); }

}  // namespace

Json ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  Json json{{"verdict", to_string(ladder.verdict)},
            {"index", known(ladder.index)},
            {"gauge_dimension", ladder.gauge_dimension},
            {"degrees_of_freedom", known(ladder.degrees_of_freedom)},
            {"levels", Json::array()},
            {"consistent_point", Json::object()},
            {"moved", ladder.moved},
            {"moves", Json::array()},
            {"ambiguous", ladder.is_ambiguous()},
            {"reason", ladder.reason}};
  for (const LadderLevel& level : ladder.levels) {
    const auto found = [&](const Json& value) { return level.is_empty ? Json() : value; };
    json["levels"].push_back({{"k", level.k},
                              {"dim_S", found(level.dim_S)},
                              {"dim_M", found(level.dim_M)},
                              {"fibre", found(level.fibre())},
                              {"gap", found(level.gap())},
                              {"residual", level.residual}});
  }
  const auto& names = system.names().coordinates;
  for (Index i = 0; i < ladder.point.x.size(); ++i)
    json["consistent_point"][names[static_cast<std::size_t>(i)]] = ladder.point.x[i];
  for (const Movement& move : ladder.moves)
    json["moves"].push_back({{"name", move.name}, {"from", move.from}, {"to", move.to}});
  return json;
}

}  // namespace courant
