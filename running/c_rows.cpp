#include "courant/running/c_rows.hpp"

#include <sstream>

#include "courant/running/c_functions.hpp"

namespace courant {

CRows::CRows(const StepProgram& step, const ObservedQuantities& observed, const Manifold& manifold)
    : step_(step),
      observed_(observed),
      coordinates_(manifold.ambient_dimension()),
      velocities_(manifold.tangent_dimension()) {
  if (observed.account) energies_.emplace(*observed.account);
}

bool CRows::measures_steps() const {
  return observed_.account != nullptr || observed_.staged.size() > 0;
}

bool CRows::has_basis() const { return step_.solve && step_.solve->space.has_basis(); }

bool CRows::has_effort() const { return step_.solve && step_.solve->effort.size() > 0; }

void CRows::add_functions(CFunctions& functions) const {
  functions.add("observe", observed_.inputs, observed_.quantities,
                "the rows after the coordinates");
  if (observed_.staged.size() > 0)
    functions.add("observe_stage", observed_.stage_inputs, observed_.staged,
                  "observables at the stage of a step");
  if (!energies_) return;
  const StepEnergies::Formulas& of = *energies_;
  if (has_effort())
    functions.add("powers",
                  {{"x", of.x}, {"v", of.v}, {"alpha", of.alpha}, {"z", of.z}, {"t", of.t}},
                  of.powers, "powers by port, what is supplied first");
  else
    functions.add("powers", {{"x", of.x}, {"v", of.v}, {"z", of.z}, {"t", of.t}},
                  of.powers_at_stage(), "powers by port, what is supplied first");
  if (observed_.staged.size() > 0)
    functions.add("effort", {{"x", of.x}, {"z", of.z}, {"t", of.t}}, of.effort, "dE");
  if (of.has_time)
    functions.add("energy", {{"x", of.x}, {"z", of.z}, {"t", of.t}}, of.generator, "E");
}

std::string CRows::parts() const {
  if (!measures_steps()) return "";
  const StepProgram::Solve& solve = *step_.solve;
  const Index kept = coordinates_ + (solve.projection ? 0 : velocities_);
  std::ostringstream out;
  out << "/* ---- the stage of a step, and the energies through its ports "
         "--------------------------------------------- */\n\n"
      << "static struct state stage; /* where the system was evaluated */\n";
  if (has_effort() || (energies_ && observed_.staged.size() > 0))
    out << "static double stage_effort[VELOCITIES + 1];\n";
  if (energies_) {
    const Index suppliers = std::ssize(energies_->suppliers),
                losses = std::ssize(energies_->dissipators);
    out << c_define("SUPPLIERS", suppliers) << c_define("DISSIPATORS", losses)
        << "static double step_supplied[SUPPLIERS + 1], step_dissipated[DISSIPATORS + 1];\n"
           "static double all_supplied[SUPPLIERS + 1], all_dissipated[DISSIPATORS + 1];\n"
           "static double balance, last_energy;\n\n"
           "static double sum(const double *a, int count) {\n"
           "  double result = 0.0;\n  int i;\n"
           "  for (i = 0; i < count; ++i) result += a[i];\n  return result;\n}\n\n";
    if (energies_->has_time)
      out << "static double energy_at(const struct state *state, double t) {\n"
             "  const double *in[] = {state->x, stage.z, &t};\n  double value;\n"
             "  energy(in, &value);\n  return value;\n}\n\n";
  }
  out << "static void open_step(void) {\n";
  if (energies_)
    out << "  memset(step_supplied, 0, sizeof step_supplied);\n"
           "  memset(step_dissipated, 0, sizeof step_dissipated);\n";
  out << "}\n\n"
      << "static void see_part(const struct state *before, const struct state *after, double h,\n"
         "                     const double *y, const double *advanced) {\n";
  if (energies_)
    out << "  double power[SUPPLIERS + DISSIPATORS + 3];\n  const int ports = SUPPLIERS - "
        << (energies_->has_time ? 1 : 0) << ";\n  int i;\n";
  out << "  stage = *after;\n  stage.t = before->t + " << c_number(solve.stage_time) << " * h;\n";
  if (solve.projection)
    out << "  memcpy(stage.v, advanced + " << coordinates_ + coordinates_
        << ", VELOCITIES * sizeof *stage.v);\n  memcpy(stage.z, y + "
        << solve.tangent_blocks * solve.displacements << ", AUXILIARIES * sizeof *stage.z);\n";
  if (solve.stage_is_advanced)
    out << "  memcpy(stage.x, advanced + " << kept << ", COORDINATES * sizeof *stage.x);\n";
  else
    out << "  {\n    const double *in[] = {before->x, after->x};\n    stage_point(in, "
           "stage.x);\n  }\n";
  if (has_effort())
    out << "  memcpy(stage_effort, advanced + " << solve.advanced.size() - solve.effort.size()
        << ", VELOCITIES * sizeof *stage_effort);\n";
  if (energies_) {
    out << "  {\n    const double *in[] = {stage.x, stage.v, "
        << (has_effort() ? "stage_effort, " : "")
        << "stage.z, &stage.t};\n    powers(in, power);\n  }\n"
        << "  for (i = 0; i < ports; ++i) step_supplied[i] += h * power[i];\n"
           "  for (i = 0; i < DISSIPATORS; ++i) step_dissipated[i] += h * power[ports + i];\n";
    if (energies_->has_time)
      out << "  step_supplied[ports] += energy_at(after, after->t) - energy_at(after, stage.t) "
             "+\n"
             "                          energy_at(before, stage.t) - energy_at(before, "
             "before->t);\n";
  }
  out << "  (void)before, (void)y, (void)advanced;\n}\n\n";
  return out.str();
}

std::string CRows::measurement(const State& first_asked) const {
  std::ostringstream out;
  const bool has_field = observed_.field.has_value();
  const Index energies = observed_.inputs.back().variables.size();
  const Index staged = observed_.staged.size();
  out << "/* ---- rows "
         "---------------------------------------------------------------------------------------"
         "--------- */\n\n"
      << "static double row[" << coordinates_ + observed_.quantities.size() + 1 << "];\n";
  if (has_field)
    out << "static struct field observed;\n/* Where the run asks first what rows are. */\n"
        << "static const struct state ladder_point = " << c_state(first_asked) << ";\n";
  if (energies > 0) out << "static double energies[" << energies << "];\n";
  if (staged > 0) out << "static double at_stage[" << staged << "];\n";
  out << "\nstatic void measure(const struct state *state) {\n";
  const bool of_field = observed_.is_field;
  if (has_field && !of_field) out << "  start_field(&observed, state);\n";
  if (of_field && has_basis()) out << "  move_basis(&observed.basis, state->x);\n";
  if (has_field) out << "  evaluate_field(&observed, state->x, state->t);\n";
  out << "  {\n    const double *in[] = {state->x, "
      << (of_field ? "observed.rate + COORDINATES, observed.rate + COORDINATES + VELOCITIES"
                   : "state->v, state->z")
      << ", &state->t, " << (has_field ? "observed.left_out" : "NULL") << ", "
      << (energies > 0 ? "energies" : "NULL") << "};\n"
      << "    memcpy(row, state->x, COORDINATES * sizeof *row);\n"
         "    observe(in, row + COORDINATES);\n  }\n";
  if (observed_.balance) out << "  row[" << *observed_.balance << "] = balance;\n";
  for (Index i = 0; i < staged; ++i)
    out << "  row[" << observed_.stage_places[static_cast<std::size_t>(i)] << "] = at_stage[" << i
        << "];\n";
  out << "}\n\n";
  if (staged > 0) {
    out << "static void measure_stage(int has_effort) {\n";
    if (energies_)
      out << "  if (!has_effort) {\n    const double *in[] = {stage.x, stage.z, &stage.t};\n"
             "    effort(in, stage_effort);\n  }\n";
    out << "  {\n    const double *in[] = {stage.x, stage.v, stage.z, &stage.t, "
        << (energies_ ? "stage_effort" : "NULL") << "};\n    observe_stage(in, at_stage);\n  }\n"
        << "  (void)has_effort;\n}\n\n";
  }
  out << "/* Of the first state. */\nstatic const double *begin_rows(const struct state *state) "
         "{\n";
  if (has_field) out << "  start_field(&observed, NULL);\n  measure(&ladder_point);\n";
  if (staged > 0) out << "  stage = *state;\n  measure_stage(0);\n";
  out << "  measure(state);\n";
  if (energies_) out << "  last_energy = row[" << *observed_.H << "];\n";
  out << "  return row;\n}\n\n/* Where an epoch begins. */\n"
      << "static void begin_rows_again(const struct state *state) {\n"
      << (has_field ? "  start_field(&observed, NULL);\n  start_field(&observed, state);\n"
                    : "  (void)state;\n")
      << "}\n\n"
      << "/* Of the state that the last step led to. */\n"
      << "static const double *next_row(const struct state *state) {\n";
  if (energies_) {
    out << "  int i;\n"
           "  for (i = 0; i < SUPPLIERS; ++i) all_supplied[i] += step_supplied[i];\n"
           "  for (i = 0; i < DISSIPATORS; ++i) all_dissipated[i] += step_dissipated[i];\n";
    if (energies > 0)
      out << "  energies[0] = sum(all_supplied, SUPPLIERS);\n"
             "  energies[1] = sum(all_dissipated, DISSIPATORS);\n"
             "  memcpy(energies + 2, all_supplied, SUPPLIERS * sizeof *energies);\n"
             "  memcpy(energies + 2 + SUPPLIERS, all_dissipated, DISSIPATORS * sizeof "
             "*energies);\n";
  }
  if (staged > 0) out << "  measure_stage(" << (has_effort() ? 1 : 0) << ");\n";
  out << "  measure(state);\n";
  if (energies_) {
    const Index H = *observed_.H;
    out << "  balance = row[" << H << "] - last_energy - sum(step_supplied, SUPPLIERS) +\n"
        << "            sum(step_dissipated, DISSIPATORS);\n  last_energy = row[" << H << "];\n";
    if (observed_.balance) out << "  row[" << *observed_.balance << "] = balance;\n";
  }
  out << "  return row;\n}\n\n";
  return out.str();
}

}  // namespace courant
