#include "courant/running/c_program.hpp"

#include <algorithm>
#include <sstream>

#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/version.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/running/c_functions.hpp"
#include "courant/running/c_program_limits.hpp"
#include "courant/running/c_program_text.hpp"
#include "courant/running/c_rows.hpp"
#include "courant/running/observed_quantities.hpp"
#include "courant/running/start_moves.hpp"

namespace courant {
namespace {

namespace text = c_program_text;

constexpr const char* kMethod = "/method";

// The lines of a comment, each indented.
std::string comment_lines(const std::string& lines) {
  std::string result;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);)
    result += line.empty() ? "\n" : "   " + c_comment(line) + "\n";
  return result;
}

class CProgram {
 public:
  explicit CProgram(const Experiment& experiment)
      : experiment_(experiment),
        system_(*experiment.model.system),
        ladder_(start(experiment)),
        prepared_(prepare()),
        step_(step_program(*prepared_.integrator)),
        observed_(experiment, ladder_),
        rows_(step_, observed_, *system_.manifold()) {
    if (!step_.solve && rows_.measures_steps())
      throw ExperimentError("/observe",
                            "what goes through ports in explicit steps is measured by a run "
                            "alone; expected no energies and no observables at the stage");
    if (step_.units && (rows_.measures_steps() || (step_.explicit_steps && observed_.field)))
      throw ExperimentError("/observe",
                            "what is measured along steps in other units is measured by a run "
                            "alone; expected observables of the state");
    const Manifold& M = *system_.manifold();
    coordinates_ = M.ambient_dimension();
    velocities_ = M.tangent_dimension();
    dimension_ = M.dimension();
  }

  std::string source() {
    // What is not given is zero, as where steps begin.
    State state = prepared_.initial;
    if (state.v.size() == 0) state.v = VectorXd::Zero(velocities_);
    if (state.z.size() == 0) state.z = VectorXd::Zero(system_.auxiliary_size());

    // What is written last says how large the arrays of the first have to be.
    add_functions();
    const std::string steps = step_.solve    ? solved_steps()
                              : step_.direct ? direct_steps()
                                             : explicit_steps();
    const std::string rows = rows_.measurement(ladder_.point);
    std::string all = head() + sizes(state);
    all += text::numbers();
    all += text::newton();
    all += functions_.source() + space();
    if (field()) all += text::field();
    return all + steps + rows + std::string(text::main());
  }

 private:
  static ConstraintLadder start(const Experiment& experiment) {
    check_exportable(experiment);
    ConstraintLadder ladder = start_of_run(experiment);
    if (ladder.verdict == Verdict::inconsistent)
      throw ExperimentError("/initial",
                            "the system is inconsistent near the initial values. " + ladder.reason);
    return ladder;
  }

  PreparedMethod prepare() const {
    return experiment_.method->prepare({.system = experiment_.model.system,
                                        .ladder = ladder_,
                                        .initial = ladder_.point,
                                        .step = experiment_.time->step,
                                        .backend = Backend::interpreter,
                                        .vocabulary = &experiment_.model.vocabulary});
  }

  // That of the steps or of the rows: for one ladder they are the same.
  const VectorFieldFormulas* field() const {
    if (step_.explicit_steps) return step_.explicit_steps->field;
    return observed_.field ? &*observed_.field : nullptr;
  }

  void add_functions() {
    if (const auto& direct = step_.direct) {
      functions_.add("begin_steps", direct->beginning.inputs, direct->beginning.outputs,
                     "what is known where a step begins");
      functions_.add("make_step", direct->step.inputs, direct->step.outputs,
                     "where it leads, and what is known there");
      functions_.add("end_step", direct->ending.inputs, direct->ending.outputs, "v and z there");
    }
    if (const auto* field = this->field()) {
      functions_.add(
          {.symbol = "field",
           .inputs = field->inputs,
           .equations = field->equations,
           .groups = std::vector<Index>(static_cast<std::size_t>(field->start.size()), 1)});
      functions_.add("field_rate", field->inputs, field->rate, "x', v, z");
      functions_.add("field_left_out", field->inputs, field->left_out,
                     "equations that the velocity is not found from");
    }
    if (step_.solve) {
      const StepProgram::Solve& solve = *step_.solve;
      add_space(solve.space);
      const auto [sought, left, has_exponentials] = functions_.add(
          {.symbol = "step",
           .inputs = solve.formulas.inputs,
           .equations = solve.formulas.equations,
           .groups = groups(),
           .elimination = solve.formulas.eliminates ? &solve.formulas.elimination : nullptr});
      has_exponentials_ = has_exponentials;
      for (Index i = 0; i < solve.formulas.inputs[0].variables.size(); ++i)
        if (std::ranges::find(sought, i) != sought.end() ||
            (!solve.is_affine && i < solve.displacements))
          predicted_.push_back(i);
      if (solve.projection) add_projection(*solve.projection);
      functions_.add("advance", solve.formulas.inputs, solve.advanced,
                     "where the step leads: x, v, what is known of the stage");
      if (rows_.measures_steps() && !solve.stage_is_advanced)
        functions_.add("stage_point", solve.stage_inputs, solve.stage,
                       "the point between x0 and x1 that the system is evaluated at");
    }
    rows_.add_functions(functions_);
  }
  void add_space(const SpaceFormulas& space) {
    if (space.has_basis())
      functions_.add("on_tangent_space", space.basis.inputs, space.basis.outputs,
                     "a basis projected to the tangent space");
    if (space.has_equations())
      functions_.add_zeros("space", space.constraint, "the equations of the space");
  }
  void add_turning(const StepProgram::Solve::Projection::Turning& of) {
    const MatrixPattern& A = of.conormals.A;
    if (!has_plain_factors(A))
      throw std::invalid_argument(
          "solves " + std::to_string(A.rows) + " equations for " + std::to_string(A.columns) +
          " unknowns, by least squares or sparse factors, for directions that change from point to "
          "point; expected fewer, or directions that do not change");
    functions_.add("conormal_matrices", of.conormals.matrices.inputs, of.conormals.matrices.outputs,
                   "the matrices of the equations for covectors that annihilate what is tangent to "
                   "the constraints");
    if (of.span.outputs.size() > 0)
      functions_.add("span", of.span.inputs, of.span.outputs,
                     "vectors along which points are projected");
  }
  std::string turning_sizes(const StepProgram::Solve::Projection::Turning& of) const {
    const auto& [constraints, matrices, A, P, sizes] = of.conormals;
    std::vector<Index> row = A.row, column = A.column;
    row.insert(row.end(), P.row.begin(), P.row.end());
    column.insert(column.end(), P.column.begin(), P.column.end());
    VectorXd references(0);
    for (const MatrixXd& reference : of.references) {
      references.conservativeResize(references.size() + reference.size());
      references.tail(reference.size()) = reference.reshaped();
    }
    return c_define("CONORMAL_SIZE", A.rows) + c_define("CONORMAL_OF_A", std::ssize(A.row)) +
           c_define("CONORMAL_ENTRIES", std::ssize(row)) +
           c_define("HAS_SPAN", of.span.outputs.size() > 0 ? 1 : 0) +
           c_define("IS_ALWAYS_COMPLEMENT", of.is_always_complement ? 1 : 0) +
           "static const int conormal_row[] = " + c_array(row) +
           ";\nstatic const int conormal_column[] = " + c_array(column) +
           ";\n/* Covectors near which those of the first point are looked for. */\n" +
           c_define("REFERENCES", std::ssize(of.references)) +
           "static const double references[] = " + c_array(references) + ";\n";
  }
  void add_projection(const StepProgram::Solve::Projection& of) {
    const auto [sought, left, has_exponentials] = functions_.add(
        {.symbol = "projection",
         .inputs = of.formulas.inputs,
         .equations = of.formulas.equations,
         .groups = groups(),
         .elimination = of.formulas.eliminates ? &of.formulas.elimination : nullptr});
    ends_predicted_ = sought;
    if (of.turning) add_turning(*of.turning);
    if (of.multipliers == 0 || of.turning) {  // then all unknowns that are found are predicted
      ends_predicted_.clear();
      for (Index i = 0; i < of.formulas.inputs[0].variables.size(); ++i)
        if (!std::ranges::binary_search(left, i)) ends_predicted_.push_back(i);
    }
    functions_.add("projected", of.formulas.inputs, of.projected, "x, v and z where it leads");
    functions_.add("shift_from", of.shift_inputs, of.shifted, "where the vector s leads from near");
    functions_.add("corrected_shift", of.correction_inputs, of.corrected,
                   "the vector that leads to x, if s leads to x0");
  }
  // Of unknowns with one scale.
  std::vector<Index> groups() const {
    const StepProgram::Solve& solve = *step_.solve;
    const Index n = solve.displacements;
    if (!solve.projection) return {n, solve.auxiliaries};
    return {n, n, (solve.tangent_blocks - 2) * n + solve.auxiliaries,
            solve.projection->multipliers};
  }
  // The unknowns that are predicted, in a group of their own up to `end`.
  static std::string places(const std::string& name, const std::vector<Index>& at, Index end) {
    std::vector<Index> group;
    for (const Index place : at) group.push_back(place < end ? 0 : 1);
    return "static const int " + name + "_places_at[] = " + c_array(at) + ";\n" +
           "static const int " + name + "_places_group[] = " + c_array(group) + ";\n" +
           "static const struct places " + name + "_places = {" + std::to_string(at.size()) + ", " +
           name + "_places_at, " + name + "_places_group};\n";
  }
  std::string head() const {
    std::ostringstream out;
    out << "/* " << c_comment(experiment_.title.empty() ? "A run of Courant" : experiment_.title)
        << "\n\n"
        << comment_lines(experiment_.model.description + "\n" + experiment_.method->description)
        << "\n   Writes the rows of its trajectory.csv. Written by courant " COURANT_VERSION_STRING
           "; compile with\n\n"
           "     cc -std=c99 -O2 -ffp-contract=off FILE.c -lm\n\n"
           "   Status 3: a step needs more than Newton's method, and the rows end before it.\n";
    if (step_.solve)
      out << "\n   The equations of a step, with its unknowns those of the arrays y:\n\n"
          << comment_lines(explanation(step_.solve->formulas));
    out << "\n   x = (" << c_comment(word_list(system_.names().coordinates)) << ")\n";
    if (system_.auxiliary_size() > 0)
      out << "   z = (" << c_comment(word_list(system_.names().auxiliary)) << ")\n";
    out << "*/\n\n#include <float.h>\n"
        << functions_.prelude().substr(0, functions_.prelude().find('\n') + 1)
        << "#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"
        << functions_.prelude().substr(functions_.prelude().find('\n') + 1);
    return out.str();
  }

  // Of the largest matrix that is factored.
  std::string factored_sizes() const {
    Index most = functions_.most_size();
    if (step_.solve && step_.solve->projection && step_.solve->projection->turning)
      most = std::max(most, step_.solve->projection->turning->conormals.A.rows);
    return c_define("MOST_FACTORED", most) + c_define("MOST_FACTORS", most * most);
  }

  std::string sizes(const State& first) const {
    const TimeSpan& time = *experiment_.time;
    std::vector<std::string> names = observed_.names;
    names.resize(observed_.written_count);
    names.insert(names.begin(), "t");
    for (std::string& name : names) name = experiment_.output.heading(name);
    std::string all = c_define("COORDINATES", coordinates_) + c_define("VELOCITIES", velocities_) +
                      c_define("AUXILIARIES", system_.auxiliary_size()) +
                      c_define("COLUMNS", static_cast<Index>(observed_.written_count)) +
                      c_define("STEPS", time.steps) + c_define("EVERY", experiment_.output.every) +
                      "/* After so many steps nothing but the state is known, as in a run that is "
                      "resumed there. */\n" +
                      c_define("EPOCH", experiment_.output.epoch) +
                      "/* What the arrays of Newton's method hold. */\n" +
                      c_define("MOST_UNKNOWNS", functions_.most_unknowns()) +
                      c_define("MOST_SIZE", functions_.most_size()) +
                      c_define("MOST_ENTRIES", functions_.most_entries()) +
                      c_define("MOST_ARGUMENTS", functions_.most_arguments()) +
                      c_define("INPUTS", 6) + factored_sizes();
    if (const auto* field = this->field())
      all += c_define("FIELD_UNKNOWNS", field->start.size()) +
             c_define("FIELD_Z", field->z_offset) + c_define("LEFT_OUT", field->left_out.size());
    all +=
        "\nstruct state {\n  double t, x[COORDINATES + 1], v[VELOCITIES + 1], z[AUXILIARIES + "
        "1];\n};\n\n";
    all += "static const double start_time = " + c_number(time.start) +
           ", step_size = " + c_number(time.step) + ";\n";
    all += "static const struct state first = " + c_state(first) + ";\n";
    if (const auto* field = this->field())
      all += "static const double field_start[] = " + c_array(field->start) + ";\n";
    all += c_define("HAS_UNITS", step_.units ? 1 : 0) +
           "static const double time_unit = " + c_number(step_.units ? step_.units->time : 1.0) +
           ";\n";
    if (step_.units)
      all +=
          "/* Powers of two, in which steps are made. */\nstatic const double coordinate_units[] "
          "= " +
          c_array(step_.units->coordinates) +
          ";\nstatic const double velocity_units[] = " + c_array(step_.units->tangent) +
          ";\nstatic const double auxiliary_units[] = " + c_array(step_.units->auxiliary) + ";\n";
    all += "static const char heading[] = " + c_string(word_list(names, ",")) + ";\n\n";
    return all + "static long step_number = 0;\n\n";
  }

  // What steps and the vector field know of the space.
  std::string space() const {
    if (!step_.solve) return c_define("HAS_BASIS", 0) + "\n";
    const StepProgram::Solve& solve = *step_.solve;
    const bool has_basis = solve.space.has_basis(), has_equations = solve.space.has_equations();
    const bool turns = solve.projection && solve.projection->turning;
    std::string all = c_define("HAS_BASIS", has_basis ? 1 : 0) + "#define BASIS " +
                      (has_basis ? "S->basis.entries" : "NULL") + "\n" +
                      c_define("SPACE_EQUATIONS", solve.space.constraint.outputs.size());
    if (has_basis || turns)
      all += c_define("DIMENSION", dimension_) +
             c_define("MOST_COLUMNS", has_basis ? dimension_ : solve.projection->multipliers);
    all += "\n";
    if (has_basis || has_equations) all += text::longest_column();
    if (has_equations) all += text::round_off();
    if (has_basis || turns) all += text::orthonormal();
    if (has_basis) all += text::basis();
    return all;
  }

  // The parts whose last steps are nearest in time to each, see Composition.
  std::string nearby_parts(const std::string& name, double part) const {
    std::string all =
        name == "near_stage" ? "struct nearby {\n  int part;\n  double times;\n};\n" : "";
    all += "static const struct nearby " + name + "[PARTS][2] = {\n";
    if (step_.substeps.size() == 1) return all + "  {{0, 0.0}, {0, 0.0}}};\n";
    for (const auto& pair : Composition::nearby_stages(step_.substeps, part)) {
      all += "  {";
      for (const auto& [stage, times] : pair)
        all += "{" + std::to_string(stage) + ", " + c_number(times) + "}, ";
      all += "},\n";
    }
    return all + "};\n";
  }

  static std::string contained_coordinates(const std::vector<Index>& contained) {
    std::string list;
    for (const Index i : contained) list += (list.empty() ? "" : ", ") + std::to_string(i);
    return c_define("CONTAINED", std::ssize(contained)) +
           "/* The coordinates that the equations of a step contain. */\n"
           "static const int contained[] = {" +
           (list.empty() ? "0" : list) + "};\n";
  }

  std::string solved_steps() const {
    const StepProgram::Solve& solve = *step_.solve;
    const bool projects = solve.projection.has_value();
    const Index n = solve.displacements;
    const Index tangent = projects ? solve.tangent_blocks * n : n;
    const Index unknowns = solve.formulas.inputs[0].variables.size();
    std::string all =
        "/* Of a step: its unknowns are displacements" +
        std::string(projects ? ", their derivatives, z, and what moves the start" : ", then z") +
        ". */\n" + c_define("UNKNOWNS", unknowns) + c_define("DISPLACEMENTS", n) +
        c_define("TANGENT_BLOCKS", solve.tangent_blocks) +
        c_define("ADVANCED", solve.advanced.size()) +
        c_define("PARTS", std::ssize(step_.substeps)) +
        c_define("MOST_PREDICTED", std::max(unknowns, velocities_)) +
        c_define("LOOKS_AT_STEPS", solve.is_affine ? 0 : 1) +
        c_define("HAS_EXPONENTIALS", has_exponentials_ ? 1 : 0) +
        c_define("MEASURES_STEPS", rows_.measures_steps() ? 1 : 0);
    const bool turns = projects && solve.projection->turning;
    if (projects)
      all += c_define("TURNS", turns ? 1 : 0) +
             "#define IS_EXPLICIT (projection_equations.size == 0 && !TURNS && !HAS_BASIS)\n";
    if (!projects) all += contained_coordinates(solve.formulas.contained(1));
    if (projects)
      all += c_define("MULTIPLIERS", solve.projection->multipliers) +
             c_define("DIRECTIONS", n * solve.projection->multipliers);
    if (turns) all += turning_sizes(*solve.projection->turning);
    all += "\n" + std::string(text::predictor()) + places("step", predicted_, tangent);
    if (projects) {
      std::vector<Index> shift;
      for (Index i = 0; i < velocities_; ++i) shift.push_back(i);
      all += places("end", ends_predicted_, tangent) + places("shift", shift, velocities_);
    }
    all +=
        "/* A step is made of steps of these parts of it. */\nstatic const double parts[PARTS] = " +
        c_array(Eigen::Map<const VectorXd>(step_.substeps.data(), std::ssize(step_.substeps))) +
        ";\n\n" + nearby_parts("near_stage", 0.5) + nearby_parts("near_end", 1.0) + rows_.parts();
    if (has_exponentials_) all += text::approach();
    if (turns) all += text::turning();
    for (const std::string_view part :
         {projects ? text::projected() : text::displaced(), text::looks(),
          projects ? text::projected_part() : text::displaced_part(), text::step()})
      all += part;
    return all;
  }

  // x <- x + h (a_0 k_0 + …)
  static std::string stage_sum(const std::string& to,
                               const std::vector<std::optional<double>>& row) {
    std::string sum = "1.0 * state->x[i]";
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j]) sum += " + h * " + c_number(*row[j]) + " * k[" + std::to_string(j) + "][i]";
    return "  for (i = 0; i < COORDINATES; ++i) " + to + "[i] = " + sum + ";\n";
  }

  std::string direct_steps() const {
    const Index known = step_.direct->beginning.outputs.size();
    return "/* ---- a step "
           "---------------------------------------------------------------------------------------"
           "-----"
           " */\n\n" +
           c_define("KNOWN", known) + c_define("PARTS", std::ssize(step_.substeps)) +
           "/* A step is made of steps of these parts of it. */\nstatic const double parts[PARTS] "
           "= " +
           c_array(Eigen::Map<const VectorXd>(step_.substeps.data(), std::ssize(step_.substeps))) +
           ";\n"
           "static double known[KNOWN + 1]; /* at the state */\n\n"
           "/* From t to the time `end`. */\n"
           "static void step(struct state *state, double h, double end) {\n"
           "  static double points[2][COORDINATES + KNOWN + 1];\n"
           "  double rates[VELOCITIES + AUXILIARIES + 1], share = 0.0;\n  int i, k;\n"
           "  memcpy(points[0], state->x, COORDINATES * sizeof(double));\n"
           "  memcpy(points[0] + COORDINATES, known, KNOWN * sizeof(double));\n"
           "  for (k = 0; k < PARTS; ++k) {\n"
           "    const double part = parts[k] * h, t = state->t + share * h;\n"
           "    const double *from = points[k % 2];\n"
           "    double *to = points[(k + 1) % 2];\n"
           "    const double *in[INPUTS] = {from, from + COORDINATES, &part, &t};\n"
           "    make_step(in, to);\n"
           "    share += parts[k];\n"
           "    if (k + 1 == PARTS) {\n"
           "      const double *of_end[INPUTS] = {from, from + COORDINATES, to + COORDINATES, "
           "&part, "
           "&t};\n"
           "      end_step(of_end, rates);\n"
           "    }\n"
           "  }\n"
           "  memcpy(state->x, points[PARTS % 2], COORDINATES * sizeof(double));\n"
           "  memcpy(known, points[PARTS % 2] + COORDINATES, KNOWN * sizeof(double));\n"
           "  memcpy(state->v, rates, VELOCITIES * sizeof(double));\n"
           "  memcpy(state->z, rates + VELOCITIES, AUXILIARIES * sizeof(double));\n"
           "  for (i = 0; i < COORDINATES; ++i)\n"
           "    if (!isfinite(state->x[i])) fail(\"leads to a state that is not finite\");\n"
           "  state->t = end;\n}\n\n"
           "static void begin_epoch(struct state *state) {\n"
           "  const double *in[INPUTS] = {state->x, &state->t};\n"
           "  begin_steps(in, known);\n}\n\n";
  }

  std::string explicit_steps() const {
    const StepProgram::Explicit& of = *step_.explicit_steps;
    const std::size_t stages = of.times.size();
    std::string body =
        "/* ---- a step "
        "------------------------------------------------------------------------------------------"
        "--"
        " */\n\n"
        "static struct field stepped;\n"
        "static double k[" +
        std::to_string(stages) +
        "][COORDINATES + 1]; /* rates */\n"
        "static int has_rate; /* k[0] is that of the state */\n\n"
        "static void find_rate(const double *x, double t, double *rate) {\n"
        "  evaluate_field(&stepped, x, t);\n"
        "  memcpy(rate, stepped.rate, COORDINATES * sizeof *rate);\n}\n\n"
        "/* From t to the time `end`. */\n"
        "static void step(struct state *state, double h, double end) {\n"
        "  double x[COORDINATES + 1];\n  const double t = state->t;\n  int i;\n"
        "  if (!has_rate) find_rate(state->x, t, k[0]);\n";
    for (std::size_t i = 0; i + 1 < stages; ++i)
      body += stage_sum("x", of.rows[i]) + "  find_rate(x, t + " + c_number(of.times[i + 1]) +
              " * h, k[" + std::to_string(i + 1) + "]);\n";
    body += stage_sum("state->x", of.rows[stages - 1]);
    if (of.keeps_rate) body += "  find_rate(state->x, t + h, k[0]);\n  has_rate = 1;\n";
    return body +
           "  memcpy(state->v, stepped.rate + COORDINATES, VELOCITIES * sizeof *state->v);\n"
           "  memcpy(state->z, stepped.rate + COORDINATES + VELOCITIES, AUXILIARIES * sizeof "
           "*state->z);\n"
           "  for (i = 0; i < COORDINATES; ++i)\n"
           "    if (!isfinite(state->x[i])) fail(\"leads to a state that is not finite\");\n"
           "  state->t = end;\n}\n\n"
           "static void begin_epoch(struct state *state) {\n"
           "  has_rate = 0;\n  start_field(&stepped, state);\n}\n\n";
  }

  const Experiment& experiment_;
  const ImplicitSystem& system_;
  const ConstraintLadder ladder_;
  const PreparedMethod prepared_;
  const StepProgram step_;
  const ObservedQuantities observed_;
  const CRows rows_;
  Index coordinates_, velocities_, dimension_;
  CFunctions functions_;
  std::vector<Index> predicted_, ends_predicted_;
  bool has_exponentials_ = false;  // the equations of a step
};

}  // namespace

std::string c_program(const Experiment& experiment) {
  try {
    return CProgram(experiment).source();
  } catch (const ExperimentError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw ExperimentError(kMethod, "cannot be exported: " + without_place(error.what()));
  }
}

}  // namespace courant
