// The engine of the laboratory: questions and answers as JSON.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "courant/reading/findings.hpp"
#include "courant/running/run_in_memory.hpp"
#include "courant/running/run_watchers.hpp"

namespace courant::lab {

// What a page asks of the library. A question is an object with a `task`:
//
//   start     {style, chapters, kinds}      what the page needs once; the words of chapters are markup
//   ladder    {text}                        the constraint algorithm: {ladder, title, page}; `page` is markup
//   discrete  {text}                        the same of the steps of its method, Remark 6.1: {ladder, page}
//   document  {text, form}                  {document}: the ladder as "html", "latex", "markdown", the integrator as "c"
//   import    {text}                        {document, remarks}: the experiment that a netlist of SPICE describes
//   new       {kind}                        {document}: a commented experiment of this kind
//   run       {texts, rows}                 runs of experiments, side by side: {runs, figures, tables}; each figure has a
//                                           `name`, `markup`, `caption` and, for a file, `svg`
//
// Where an experiment names tables, or a netlist files that it includes, the question has them as
// `files`, {name: text}.
//
// Where a task cannot be done the answer is {problems: [{where, what}]}, `where` being what ExperimentError gives.
// Nothing is thrown.
class Engine {
 public:
  // Is called some ten times a second while a run goes on.
  using Watch = std::function<void(const Progress&)>;
  explicit Engine(Watch watch = {}) : watch_(std::move(watch)) {}

  Json answer(const Json& question);
  // Of the last runs, in the order in which they were asked for.
  std::span<const RunInMemory> runs() const { return runs_; }

 private:
  Json run(const Json& question);

  Watch watch_;
  std::vector<RunInMemory> runs_;
};

}  // namespace courant::lab
