// Classes of Python as words of experiments.
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/python/objects.hpp"
#include "courant/python/step_inputs.hpp"
#include "courant/reading/method_kinds.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant::python {
namespace {

// Those of the experiment that is being read; the GIL is held while one is.
py::list& objects_now() {
  static py::list& objects = *new py::list();
  return objects;
}

// What makes the object that a place of an experiment asks for: an entry of the list, or a factory that was
// registered, called with the keys that are there.
using Source = std::function<py::object(ObjectReader&)>;

py::object entry(ObjectReader& reader) {
  const Index k = reader.integer("object", 0, 0);
  if (k >= static_cast<Index>(py::len(objects_now()))) {
    reader.place().problem("is an object of a program in Python, which is not there");
    throw py::index_error("no such object");
  }
  return objects_now()[static_cast<std::size_t>(k)];
}

// Another method, with inputs that a function of Python says.
std::optional<MethodChoice> method_with_inputs(ObjectReader& reader) {
  const py::gil_scoped_acquire locked;
  const StepInputs inputs = entry(reader).cast<StepInputs>();
  auto choice = method_kinds().read_key(reader, "method");
  if (!choice) return std::nullopt;
  return MethodChoice{choice->description + ", with numbers of functions of Python",
                      [choice = *choice, inputs](const MethodSetting& at) {
                        PreparedMethod prepared = choice.prepare(at);
                        return PreparedMethod{
                            .integrator = with_inputs(prepared.integrator, inputs),
                            .initial = prepared.initial,
                            .map = prepared.map,
                            .metric = prepared.metric};
                      }};
}

// An object, or what a class or a function makes of the argument.
py::object made(const py::object& object, const py::object& argument) {
  return PyCallable_Check(object.ptr()) != 0 ? object(argument) : object;
}

template <class Class>
std::shared_ptr<const Class> expected(const py::object& object, const char* noun) {
  if (!py::isinstance<Class>(object))
    throw py::type_error(std::string(py::repr(object)) + " is no " + noun +
                         ": its class has to be derived from courant." + noun);
  return kept<Class>(object);
}

void add_manifold(const KindDescription& description, const Source& source) {
  manifold_kinds().add({description, [source](ObjectReader& reader, const Vocabulary&) {
                          const py::gil_scoped_acquire locked;
                          return std::optional(expected<Manifold>(source(reader), "Manifold"));
                        }});
}

void add_structure(const KindDescription& description, const Source& source) {
  structure_kinds().add({description, [source](ObjectReader& reader, const StructureSite&) {
                           const py::gil_scoped_acquire locked;
                           return std::optional(
                               expected<DiracStructure>(source(reader), "DiracStructure"));
                         }});
}

void add_system(const KindDescription& description, const Source& source) {
  system_kinds().add({description, [source](ObjectReader& reader) -> std::optional<Model> {
                        const py::gil_scoped_acquire locked;
                        const py::object object = source(reader);
                        const std::string name = py::str(py::type::of(object).attr("__name__"));
                        return model_of(expected<ImplicitSystem>(object, "ImplicitSystem"), name);
                      }});
}

using MapPointer = std::shared_ptr<const DiscretizationMap>;

// The map itself where it is on M, its cotangent lift where it is on the Q of M = T*Q; a class or a function makes one
// on M or on Q.
MapPointer map_on(const std::shared_ptr<const Manifold>& M, const py::object& object) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(M);
  const auto base = bundle ? bundle->base() : M;
  const auto map = expected<DiscretizationMap>(
      made(object, py::cast(std::const_pointer_cast<Manifold>(base))), "DiscretizationMap");
  if (bundle && *map->manifold() != *M) return std::make_shared<CotangentLift>(bundle, map);
  return map;
}

void add_map(const KindDescription& description, const Source& source) {
  discretization_kinds().add({description, [source](ObjectReader& reader) {
                                const py::gil_scoped_acquire locked;
                                const auto object = held(source(reader));
                                const std::string text = py::str(*object);
                                return std::optional(DiscretizationChoice{
                                    text, [object](const std::shared_ptr<const Manifold>& M) {
                                      const py::gil_scoped_acquire again;
                                      return map_on(M, *object);
                                    }});
                              }});
}

void add_projector(const KindDescription& description, const Source& source) {
  projector_kinds().add({description, [source](ObjectReader& reader) {
                           const py::gil_scoped_acquire locked;
                           const py::object object = source(reader);
                           const std::string text = py::str(object);
                           const auto projector = expected<Projector>(object, "Projector");
                           return std::optional(ProjectorChoice{
                               text, [projector](const MethodSetting&) {
                                 return ProjectorChoice::Made{.projector = projector};
                               }});
                         }});
}

// A class or function that makes the integrator of a system: called with the coordinates' names and the system.
void add_method(const KindDescription& description, const Source& source) {
  method_kinds().add(
      {description, [source](ObjectReader& reader) {
         const py::gil_scoped_acquire locked;
         const auto object = held(source(reader));
         const std::string text = py::str(*object);
         return std::optional(MethodChoice{
             text, [object](const MethodSetting& at) {
               const py::gil_scoped_acquire again;
               const auto system = std::const_pointer_cast<ImplicitSystem>(at.system);
               return PreparedMethod{.integrator = expected<Integrator>(
                                         made(*object, py::cast(system)), "Integrator"),
                                     .initial = at.initial};
             }});
       }});
}

void add(const std::string& noun, const KindDescription& description, const Source& source) {
  if (noun == "manifold")
    add_manifold(description, source);
  else if (noun == "structure")
    add_structure(description, source);
  else if (noun == "system")
    add_system(description, source);
  else if (noun == "discretization")
    add_map(description, source);
  else if (noun == "projector")
    add_projector(description, source);
  else if (noun == "method")
    add_method(description, source);
  else
    throw py::value_error("\"" + noun +
                          "\" has no kinds; expected manifold, structure, system, discretization, "
                          "projector or method");
}

Takes any_value() { return {.text = "a value", .schema = Json::object()}; }

}  // namespace

ObjectsOfExperiment::ObjectsOfExperiment(py::list objects)
    : before_(std::exchange(objects_now(), std::move(objects))) {}

ObjectsOfExperiment::~ObjectsOfExperiment() { objects_now() = std::move(before_); }

void bind_kinds(py::module_& module) {
  for (const char* noun :
       {"manifold", "structure", "system", "discretization", "projector", "method"})
    add(noun,
        {"python",
         "an object of a program in Python",
         {required_key("object", takes::integer(0), "its number")}},
        entry);
  method_kinds().add(
      {{"python-inputs",
        "a method of a system in which functions of a program in Python stand",
        {required_key("object", takes::integer(0), "the number of its inputs"),
         default_key("method", takes::kind("method"), "discretize-first", "the method")}},
       method_with_inputs});
  module.def(
      "register",
      [](const std::string& noun, const std::string& word, py::object factory, const py::dict& keys,
         const std::string& summary) {
        KindDescription description{.type = word, .summary = summary};
        std::vector<std::string> names;
        for (const auto& [key, otherwise] : keys) {
          names.push_back(key.cast<std::string>());
          description.keys.push_back(
              otherwise.is_none() ? required_key(names.back(), any_value(), "given to the class")
                                  : default_key(names.back(), any_value(), to_json(otherwise),
                                                "given to the class"));
        }
        const auto made_by = held(std::move(factory));
        add(noun, description, [made_by, names](ObjectReader& reader) {
          py::dict arguments;
          for (const std::string& name : names) {
            const auto value = reader.optional(name);
            arguments[py::str(name)] =
                to_python(value ? value->value() : reader.declared_default(name));
          }
          return (*made_by)(**arguments);
        });
      },
      py::arg("noun"), py::arg("word"), py::arg("factory"), py::arg("keys") = py::dict(),
      py::arg("summary") = "a class of Python");
}

}  // namespace courant::python
