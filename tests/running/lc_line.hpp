// A line of LC cells as an experiment of any length, with its modes in closed form.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "courant/reading/json_document.hpp"

namespace courant::test {

// Inductors of 1 H between nodes 0 … N with capacitors of 1 F to ground, 1/2 F at the two ends, of
// which all are open. Its modes are
//
//   u_i = cos(k π i/N) cos(ω t),   ω = 2 sin(k π/(2 N))
//
// The currents are 0 at the start.
struct LcLine {
  int cells;  // N
  int mode;   // k

  double frequency() const { return 2.0 * std::sin(mode * std::numbers::pi / (2.0 * cells)); }
  double capacitance(int i) const { return i == 0 || i == cells ? 0.5 : 1.0; }
  double voltage_at_start(int i) const { return std::cos(mode * std::numbers::pi * i / cells); }

  Json experiment() const {
    Json nodes = {"0"}, elements = Json::array(), initial = Json::object();
    for (int i = 0; i <= cells; ++i) {
      const std::string number = std::to_string(i), node = "n" + number;
      nodes.push_back(node);
      elements.push_back({{"type", "capacitor"},
                          {"name", "C" + number},
                          {"from", node},
                          {"to", "0"},
                          {"value", capacitance(i)}});
      append_member(initial, "q_C" + number, capacitance(i) * voltage_at_start(i));
    }
    for (int i = 0; i < cells; ++i) {
      const std::string number = std::to_string(i);
      elements.push_back({{"type", "inductor"},
                          {"name", "L" + number},
                          {"from", "n" + number},
                          {"to", "n" + std::to_string(i + 1)},
                          {"value", 1}});
      append_member(initial, "phi_L" + number, 0);
    }
    return {{"system", {{"type", "network"}, {"nodes", nodes}, {"elements", elements}}},
            {"initial", initial}};
  }
};

}  // namespace courant::test
