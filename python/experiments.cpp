// Experiments, and what is asked of them without a run.
#include "courant/extensions/importing/included_text.hpp"
#include "courant/extensions/robots/import_robot.hpp"
#include "courant/extensions/spice/netlist.hpp"
#include "courant/plotting/palette.hpp"
#include "courant/python/objects.hpp"
#include "courant/reading/catalogue.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reporting/formula_typesetting.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_explanation.hpp"
#include "courant/reporting/ladder_page.hpp"
#include "courant/running/branch_report.hpp"
#include "courant/running/check.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/other_values.hpp"
#include "courant/running/study.hpp"

namespace courant::python {
namespace {

// The certificate of an experiment: the one place that knows which engine finds it.
Json certificate(const Experiment& experiment, bool prove) {
  const ConsistentStart start =
      consistent_start(experiment, prove ? Decider::proof : Decider::both);
  return with_branches(courant::to_json(report_of_start(experiment, start)),
                       branch_reports(experiment));
}

Json described(const KindDescription& kind) {
  Json keys = Json::array();
  for (const Key& key : kind.keys)
    keys.push_back({{"key", key.name},
                    {"takes", key.takes.text},
                    {"summary", key.summary},
                    {"required", key.required},
                    {"default", key.otherwise}});
  return {
      {"type", kind.type}, {"summary", kind.sentence()}, {"keys", keys}, {"example", kind.example}};
}

}  // namespace

void bind_experiments(py::module_& module) {
  py::class_<Experiment, std::shared_ptr<Experiment>>(module, "Experiment")
      .def_property_readonly(
          "document", [](const Experiment& experiment) { return to_python(experiment.document); })
      .def_property_readonly("title", [](const Experiment& e) { return e.title; })
      .def_property_readonly(
          "coordinates", [](const Experiment& e) { return e.model.system->names().coordinates; })
      .def_property_readonly("unknowns",
                             [](const Experiment& e) { return e.model.system->names().auxiliary; })
      .def_property_readonly("method", [](const Experiment& e) {
        return e.method ? e.method->description : std::string();
      });
  module.def(
      "read",
      [](const py::object& document, const py::list& objects) {
        const ObjectsOfExperiment scope(objects);
        if (py::isinstance<py::str>(document))
          return std::make_shared<Experiment>(read_experiment(document.cast<std::string>()));
        return std::make_shared<Experiment>(read_experiment_document(to_json(document)));
      },
      py::arg("document"), py::arg("objects") = py::list());
  module.def(
      "certificate",
      [](const Experiment& experiment, bool prove) {
        Json found;
        {
          const py::gil_scoped_release free;
          found = certificate(experiment, prove);
        }
        return to_python(found);
      },
      py::arg("experiment"), py::arg("prove") = false);
  module.def("check", [](const Experiment& experiment) {
    Json found;
    {
      const py::gil_scoped_release free;
      found = check_experiment(experiment);
    }
    return to_python(found);
  });
  module.def(
      "study",
      [](const std::vector<std::shared_ptr<Experiment>>& experiments, int steps,
         const std::vector<std::string>& quantities) {
        std::vector<StudySubject> subjects;
        for (const auto& experiment : experiments)
          subjects.push_back({experiment->title, *experiment});
        Json found;
        {
          const py::gil_scoped_release free;
          found = courant::to_json(study(subjects, {.steps = steps, .quantities = quantities}));
        }
        return to_python(found);
      },
      py::arg("experiments"), py::arg("steps") = 5,
      py::arg("quantities") = std::vector<std::string>());
  module.def("ladder_words", [](const py::object& found) {
    const LadderReport ladder = read_ladder_report(to_json(found));
    py::dict words;
    words["verdict"] = verdict_in_words(ladder);
    words["diagram"] = ladder_diagram(ladder).str();
    py::list explanation;
    for (const Prose& line : ladder_explanation(ladder)) explanation.append(line.str());
    words["explanation"] = explanation;
    words["html"] = ladder_in_words(ladder).str();
    return words;
  });
  module.def("latex_formula", [](const std::string& formula) { return latex_math(formula); });
  module.def("palette", [] {
    std::vector<std::string> colours;
    for (const plot::PaletteColour& colour : plot::palette()) colours.emplace_back(colour.light);
    return colours;
  });
  module.def("imported_netlist",
             [](const std::string& text) { return import_netlist(text).dump(); });
  module.def("imported_robot", [](const std::string& text, const std::string& folder) {
    std::vector<Problem> notes;
    const Json experiment = import_robot(text, &notes, files_below(folder));
    std::vector<std::string> lines;
    for (const Problem& note : notes) lines.push_back(note.line());
    return std::pair(experiment.dump(), lines);
  });
  module.def("catalogue", [] {
    Json all = Json::object();
    for (const Shelf& shelf : courant::catalogue()) {
      Json& kinds = all[shelf.name] = Json::array();
      for (const KindDescription& kind : shelf.kinds) kinds.push_back(described(kind));
    }
    return to_python(all);
  });
}

}  // namespace courant::python
