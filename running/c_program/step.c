static struct stepper steppers[PARTS];

/* Whether the state is where the last step of this part ended. */
static int is_last(const struct stepper *S, const struct state *state) {
  int i, same = S->is_prepared && state->t == S->after.t;
  for (i = 0; i < COORDINATES; ++i) same = same && state->x[i] == S->after.x[i];
  for (i = 0; i < VELOCITIES; ++i) same = same && state->v[i] == S->after.v[i];
  for (i = 0; i < AUXILIARIES; ++i) same = same && state->z[i] == S->after.z[i];
  return same;
}

/* From t to the time `end`. */
static void step(struct state *state, double h, double end) {
  const double t = state->t;
  double share = 0.0;
  int i;
#if MEASURES_STEPS
  open_step();
#endif
  for (i = 0; i < PARTS; ++i) {
    const struct stepper *const previous = &steppers[i == 0 ? PARTS - 1 : i - 1];
    share += parts[i];
    if (!is_last(&steppers[i], state)) {
      if (steppers[i].has_stepped && !is_near_last(&steppers[i], state)) forget(&steppers[i]);
      if (PARTS > 1 && is_last(previous, state))
        take_over(&steppers[i], previous);
      else
        prepare(&steppers[i], state, parts[i] * h);
    }
    make_part(&steppers[i], state, parts[i] * h, i + 1 == PARTS ? end : t + share * h);
#if MEASURES_STEPS
    see_part(&steppers[i].before, &steppers[i].after, parts[i] * h, steppers[i].y,
             steppers[i].advanced);
#endif
  }
}

/* Nothing but the state is known. */
static void begin_epoch(struct state *state) {
  int i, c;
  for (i = 0; PARTS > 1 && i < PARTS; ++i)
    for (c = 0; c < 2; ++c) {
      const struct nearby stage = near_stage[i][c], end = near_end[i][c];
      learn_at_stage(&steppers[i], c, &steppers[stage.part], stage.times, parts[i] / parts[stage.part]);
      learn_at_end(&steppers[i], c, &steppers[end.part], end.times, parts[i] / parts[end.part]);
    }
  for (i = 0; i < PARTS; ++i) forget(&steppers[i]);
  prepare(&steppers[0], state, parts[0] * (step_size / time_unit));
  steppers[0].after = *state;
  steppers[0].is_prepared = 1;
}
