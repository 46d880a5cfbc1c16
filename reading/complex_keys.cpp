#include "courant/reading/complex_keys.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/cell_formulas.hpp"
#include "courant/reading/written_formula.hpp"

namespace courant {
namespace {

// More would not be a mistake, but would take longer than anybody waits.
constexpr Index kMostCells = 1'000'000;

const KindDescription& interval_keys() {
  static const KindDescription keys{
      "",
      "an interval",
      {required_key("length", takes::formula(), "from 0 on x"),
       required_key("cells", takes::formula(), "how many equal ones")}};
  return keys;
}

const KindDescription& rectangle_keys() {
  static const KindDescription keys{
      "",
      "a rectangle",
      {required_key("size", takes::formula_vector(), "from 0 on x and y"),
       required_key("cells", takes::formula_vector(), "how many equal ones on each axis")}};
  return keys;
}

const KindDescription& box_keys() {
  static const KindDescription keys{
      "",
      "a box",
      {required_key("size", takes::formula_vector(), "from 0 on x, y and z"),
       required_key("cells", takes::formula_vector(), "how many equal ones on each axis")}};
  return keys;
}

Takes numbers_in_rows() {
  return {"an array of arrays of numbers",
          {{"type", "array"}, {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}}};
}

Takes rows_by_name() {
  return {"an object of arrays of arrays of numbers",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", numbers_in_rows().schema}}};
}

const KindDescription& graph_keys() {
  static const KindDescription keys{
      "",
      "a graph",
      {required_key("vertices", takes::integer(2), "how many"),
       required_key("edges", numbers_in_rows(), "[from, to], numbers of vertices from 0 on"),
       required_key("lengths", takes::formula_vector(), "of the edges")}};
  return keys;
}

// `count` constant formulas that are all above 0; whole numbers where that is asked for.
std::optional<VectorXd> read_positive(const std::optional<JsonReader>& key, Index count,
                                      bool is_whole, const SymbolTable& constants) {
  const auto formulas = key ? read_formulas(*key) : std::nullopt;
  if (!formulas) return std::nullopt;
  const std::string expected = std::string(is_whole ? "whole numbers" : "numbers") + " above 0";
  if (std::ssize(formulas->formulas) != count) {
    key->problem("has " + std::to_string(formulas->formulas.size()) + " numbers; expected " +
                 std::to_string(count));
    return std::nullopt;
  }
  const auto values = evaluate_constants(*formulas, constants, key->findings());
  if (!values) return std::nullopt;
  for (const double value : *values)
    if (!(value > 0.0) || !std::isfinite(value) || (is_whole && value != std::round(value))) {
      key->problem("has the value " + number_text(value) + "; expected " + expected);
      return std::nullopt;
    }
  if (is_whole && values->prod() > static_cast<double>(kMostCells)) {
    key->problem("makes " + number_text(values->prod()) + " cells; expected at most " +
                 std::to_string(kMostCells));
    return std::nullopt;
  }
  return values;
}

// Rows of numbers of a given width, or of any; whole ones where they are indices.
std::optional<std::vector<VectorXd>> read_rows(const std::optional<JsonReader>& key,
                                               std::pair<Index, Index> width) {
  const auto rows = key ? key->elements() : std::nullopt;
  if (!rows) return std::nullopt;
  std::vector<VectorXd> result;
  for (const JsonReader& row : *rows) {
    const auto entries = row.elements();
    if (!entries) return std::nullopt;
    if (std::ssize(*entries) < width.first || std::ssize(*entries) > width.second) {
      row.problem("has " + std::to_string(entries->size()) + " numbers; expected " +
                  std::to_string(width.first) +
                  (width.first == width.second ? "" : " to " + std::to_string(width.second)));
      return std::nullopt;
    }
    VectorXd values(std::ssize(*entries));
    for (Index i = 0; i < values.size(); ++i) {
      const auto number = (*entries)[static_cast<std::size_t>(i)].number();
      if (!number) return std::nullopt;
      values[i] = *number;
    }
    result.push_back(std::move(values));
  }
  return result;
}

std::optional<std::vector<std::vector<Index>>> read_index_rows(const std::optional<JsonReader>& key,
                                                               std::pair<Index, Index> width) {
  const auto rows = read_rows(key, width);
  if (!rows) return std::nullopt;
  std::vector<std::vector<Index>> result;
  for (const VectorXd& row : *rows) {
    result.emplace_back();
    for (const double number : row) {
      if (number < 0.0 || number != std::round(number) ||
          number > static_cast<double>(kMostCells)) {
        key->problem("has the number " + number_text(number) +
                     "; expected numbers of vertices, from 0 on");
        return std::nullopt;
      }
      result.back().push_back(static_cast<Index>(number));
    }
  }
  return result;
}

std::optional<CellComplex> read_grid(const JsonReader& value, const KindDescription& keys,
                                     Index dimension, const SymbolTable& constants) {
  ObjectReader object(value, keys);
  const auto size_key = object.required(dimension == 1 ? "length" : "size");
  const auto cells_key = object.required("cells");
  const auto size = read_positive(size_key, dimension, false, constants);
  const auto cells = read_positive(cells_key, dimension, true, constants);
  if (!size || !cells) return std::nullopt;
  std::vector<VectorXd> axes;
  for (Index a = 0; a < dimension; ++a)
    axes.push_back(VectorXd::LinSpaced(static_cast<Index>((*cells)[a]) + 1, 0.0, (*size)[a]));
  return CellComplex::grid(axes);
}

std::optional<CellComplex> read_graph(const JsonReader& value, const SymbolTable& constants) {
  ObjectReader object(value, graph_keys());
  const auto vertices_key = object.required("vertices");
  const auto edges = read_index_rows(object.required("edges"), {2, 2});
  const auto lengths_key = object.required("lengths");
  const auto vertices = vertices_key ? vertices_key->integer(2) : std::nullopt;
  if (!edges || !vertices) return std::nullopt;
  if (*vertices > kMostCells) {
    vertices_key->problem("is " + std::to_string(*vertices) + "; expected at most " +
                          std::to_string(kMostCells));
    return std::nullopt;
  }
  const auto lengths = read_positive(lengths_key, std::ssize(*edges), false, constants);
  if (!lengths) return std::nullopt;
  std::vector<std::pair<Index, Index>> pairs;
  for (const std::vector<Index>& edge : *edges) pairs.emplace_back(edge[0], edge[1]);
  return CellComplex::graph(*vertices, pairs, *lengths);
}

std::optional<CellComplex> read_simplices(ObjectReader& object) {
  const auto simplices_key = object.required("simplices");
  const auto facets_key = object.optional("facets");
  const auto rows = read_rows(object.required("vertices"), {1, 3});
  const auto simplices = read_index_rows(simplices_key, {2, 4});
  if (!rows || !simplices) return std::nullopt;
  MatrixXd vertices = MatrixXd::Zero(std::ssize(*rows), 3);
  for (Index i = 0; i < vertices.rows(); ++i) {
    const VectorXd& row = (*rows)[static_cast<std::size_t>(i)];
    vertices.row(i).head(row.size()) = row.transpose();
  }
  std::vector<CellComplex::NamedFacets> regions;
  const auto entries = facets_key ? facets_key->entries() : std::nullopt;
  if (entries)
    for (const auto& [name, facets] : *entries) {
      const auto read = read_index_rows(facets, {1, 3});
      if (!read) return std::nullopt;
      regions.push_back({name, *read});
    }
  return CellComplex::simplicial(vertices, *simplices, regions);
}

}  // namespace

const KindDescription& complex_keys() {
  static const KindDescription keys{
      "",
      "a cell complex",
      {optional_key("interval", takes::one(interval_keys()), "with the regions left and right"),
       optional_key("rectangle", takes::one(rectangle_keys()),
                    "with the regions left, right, bottom and top"),
       optional_key("box", takes::one(box_keys()),
                    "with the regions left, right, bottom, top, back and front"),
       optional_key("graph", takes::one(graph_keys()),
                    "edges with lengths; the vertices of one edge are the regions end<number>"),
       optional_key("mesh", takes::text(), "a file of Gmsh, with its physical groups as regions"),
       optional_key("simplices", numbers_in_rows(),
                    "numbers of vertices: edges, triangles or tetrahedra"),
       optional_key("vertices", numbers_in_rows(), "of the simplices: their coordinates"),
       optional_key("facets", rows_by_name(),
                    "regions of the simplices: vertices of cells of the boundary, by name")},
      {{"interval", "rectangle", "box", "graph", "mesh", "simplices"}}};
  return keys;
}

std::optional<CellComplex> read_complex(const JsonReader& value, const Vocabulary& vocabulary) {
  ObjectReader object(value, complex_keys());
  if (!value.value().is_object()) return std::nullopt;
  const SymbolTable constants = vocabulary.symbols({});
  const auto interval = object.optional("interval"), rectangle = object.optional("rectangle"),
             box = object.optional("box"), graph = object.optional("graph"),
             mesh = object.optional("mesh"), simplices = object.optional("simplices");
  const int kinds = int(interval.has_value()) + int(rectangle.has_value()) + int(box.has_value()) +
                    int(graph.has_value()) + int(mesh.has_value()) + int(simplices.has_value());
  const auto vertices = object.optional("vertices"), facets = object.optional("facets");
  if (kinds != 1) {
    value.problem("says in " + std::to_string(kinds) +
                  " ways what it is; expected one of \"interval\", \"rectangle\", \"box\", "
                  "\"graph\", \"mesh\" or \"simplices\"");
    return std::nullopt;
  }
  if (!simplices)
    for (const auto& key : {vertices, facets})
      if (key) {
        key->problem("is there without \"simplices\"; expected these beside it");
        return std::nullopt;
      }
  try {
    if (interval) return read_grid(*interval, interval_keys(), 1, constants);
    if (rectangle) return read_grid(*rectangle, rectangle_keys(), 2, constants);
    if (box) return read_grid(*box, box_keys(), 3, constants);
    if (graph) return read_graph(*graph, constants);
    if (simplices) return read_simplices(object);
    mesh->problem(
        "is a file, which only the command reads; expected \"vertices\" and "
        "\"simplices\"");
  } catch (const std::invalid_argument& error) {
    value.problem(without_place(error.what()));
  }
  return std::nullopt;
}

std::optional<CellComplex> with_regions(CellComplex complex, const JsonReader& regions,
                                        const Vocabulary& vocabulary) {
  const auto entries = regions.entries();
  if (!entries) return std::nullopt;
  const MatrixXd centres = complex.positions(complex.dimension() - 1);
  const SymbolTable constants = vocabulary.symbols({});
  for (const auto& [name, value] : *entries) {
    auto formula = read_formula(value);
    if (!formula) return std::nullopt;
    formula->text = "if(" + formula->text + ", 1, 0)";
    std::vector<Index> facets;
    for (const Index facet : complex.boundary()) {
      SymbolTable symbols = constants;
      add_place(symbols, centres, facet);
      const auto is_there = evaluate_constants({{}, {*formula}}, symbols, regions.findings());
      if (!is_there) return std::nullopt;
      if ((*is_there)[0] != 0.0) facets.push_back(facet);
    }
    if (facets.empty()) {
      value.problem("is true of no cell of the boundary; expected one at least");
      return std::nullopt;
    }
    if (complex.region(name)) {
      value.problem("is a region of the complex already; expected another name");
      return std::nullopt;
    }
    complex = complex.with_region({name, std::move(facets)});
  }
  return complex;
}

}  // namespace courant
