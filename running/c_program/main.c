/* ---- the run ------------------------------------------------------------------------------------------- */

static void write_row(double t, const double *row) {
  int i;
  write_number(t);
  for (i = 0; i < COLUMNS; ++i) {
    putchar(',');
    write_number(row[i]);
  }
  putchar('\n');
}

#if HAS_UNITS
static void to_units(struct state *state) {
  int i;
  state->t /= time_unit;
  for (i = 0; i < COORDINATES; ++i) state->x[i] /= coordinate_units[i];
  for (i = 0; i < VELOCITIES; ++i) state->v[i] = state->v[i] / velocity_units[i] * time_unit;
  for (i = 0; i < AUXILIARIES; ++i) state->z[i] /= auxiliary_units[i];
}

static void from_units(struct state *state) {
  int i;
  state->t *= time_unit;
  for (i = 0; i < COORDINATES; ++i) state->x[i] *= coordinate_units[i];
  for (i = 0; i < VELOCITIES; ++i) state->v[i] = state->v[i] * velocity_units[i] / time_unit;
  for (i = 0; i < AUXILIARIES; ++i) state->z[i] *= auxiliary_units[i];
}
#else
static void to_units(struct state *state) { (void)state; }
static void from_units(struct state *state) { (void)state; }
#endif

int main(void) {
  struct state state = first;
  puts(heading);
  to_units(&state);
  begin_epoch(&state);
  from_units(&state);
  write_row(start_time, begin_rows(&state));
  for (step_number = 1; step_number <= STEPS; ++step_number) {
    const double t = start_time + (double)step_number * step_size;
    const double *row;
    if (step_number > 1 && (step_number - 1) % EPOCH == 0) {
      begin_rows_again(&state);
      to_units(&state);
      begin_epoch(&state);
      from_units(&state);
    }
    to_units(&state);
    step(&state, step_size / time_unit, t / time_unit);
    from_units(&state);
    row = next_row(&state);
    if (step_number % EVERY == 0 || step_number == STEPS) write_row(t, row);
  }
  if (fflush(stdout) != 0 || ferror(stdout)) {
    fputs("the rows cannot be written\n", stderr);
    return 3;
  }
  return 0;
}
