static void forget(struct stepper *S) {
  forget_looks(S);
  S->projector.of = &projection_equations;
  forget_matrix(&S->projector);
  forget_steps(&S->end, &end_places);
  forget_steps(&S->shift, &shift_places);
  memset(S->jets, 0, sizeof S->jets);
  memset(S->shifted, 0, sizeof S->shifted);
}

/* Of the groups of unknowns; `besides` is a size of other coordinates. */
static void set_scales(const struct state *before, double h, double besides, double *scales) {
  const double given = largest_of(largest(before->x, COORDINATES), besides);
  const double size = given > 0.0 ? given : fabs(h) * largest(before->v, VELOCITIES);
  scales[0] = scales[3] = size;
  scales[1] = size / fabs(h);
  scales[2] = 1e7 * largest(before->z, AUXILIARIES) + 1e-3 * size;
}

/* Positions that do not move, and what moves a point onto the constraints: zero in all predictions. */
static void clear_places(double *y) {
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i) y[i] = 0.0;
}

static void clear_shifts(double *y) {
  int i;
  for (i = UNKNOWNS - SHIFTS; i < UNKNOWNS; ++i) y[i] = 0.0;
}

/* From S->near to the constraints; S->p are the unknowns there. `goes_on`: at the end of a step. */
static void project(struct stepper *S, const struct state *before, double h, double t, int goes_on) {
  double guess[COORDINATES + 1], scales[4];
  const double *in[INPUTS] = {S->p, guess, NULL, directions, S->near, &t};
  int i;
  clear_places(S->p);
  clear_shifts(S->p);
  memcpy(guess, S->near, sizeof guess);
  if (goes_on && S->shift.count > 0) {
    const double *from[INPUTS] = {S->near, S->shifted};
    predict(&S->shift, S->shifted);
    shift_from(from, guess);
  }
  memcpy(S->foreseen, guess, sizeof guess);
  if (goes_on && S->end.count > 0) {
    predict(&S->end, S->p);
    clear_places(S->p);
  }
  set_scales(before, h, largest(S->near, COORDINATES), scales);
  if (!solve(&S->projector, S->p, in, scales)) fail("is not projected at once");
  projected(in, S->found);
  if (goes_on && projection_equations.size > 0) {
    double moved = 0.0, length = 0.0, away = 0.0, nearby;
    for (i = 0; i < COORDINATES; ++i) {
      length = largest_of(length, fabs(S->near[i] - before->x[i]));
      away = largest_of(away, fabs(guess[i] - S->near[i]));
      moved = largest_of(moved, fabs(S->found[i] - S->near[i]));
    }
    nearby = largest_of(0.5 * length, 1e-10 * scales[0]);
    if (!(moved <= nearby && largest(S->p, DISPLACEMENTS) <= nearby + 2.0 * away))
      fail("is projected too far");
  }
}

/* What the projection found, as a state. */
static void take(struct stepper *S, struct state *state) {
  memcpy(state->x, S->found, COORDINATES * sizeof *state->x);
  memcpy(state->v, S->found + COORDINATES, VELOCITIES * sizeof *state->v);
  memcpy(state->z, S->found + COORDINATES + VELOCITIES, AUXILIARIES * sizeof *state->z);
}

/* The next step begins where the projection ended. */
static void accept(struct stepper *S) {
  memcpy(S->jets, S->p, sizeof S->jets);
  clear_places(S->jets);
  clear_shifts(S->jets);
}

/* Onto the constraints, where the velocities are found. */
static void prepare(struct stepper *S, struct state *state, double h) {
  int i;
  memcpy(S->p, S->jets, sizeof S->p);
  for (i = 0; i < DISPLACEMENTS; ++i) S->p[DISPLACEMENTS + i] = 0.0 + state->v[i];
  for (i = 0; i < AUXILIARIES; ++i) S->p[TANGENT_BLOCKS * DISPLACEMENTS + i] = state->z[i];
  memcpy(S->near, state->x, sizeof S->near);
  project(S, state, h, state->t, 0);
  accept(S);
  take(S, state);
}

/* The next step begins where that of another part ended. */
static void take_over(struct stepper *S, const struct stepper *other) {
  memcpy(S->jets, other->jets, sizeof S->jets);
}

static void learn_at_stage(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  accompany(&S->predictor, c, &other->predictor, &step_places, times, ratio, DISPLACEMENTS, SHIFTS, UNKNOWNS);
}

static void learn_at_end(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  accompany(&S->end, c, &other->end, &end_places, times, ratio, 0, SHIFTS, UNKNOWNS);
  accompany(&S->shift, c, &other->shift, &shift_places, times, ratio, 0, VELOCITIES, VELOCITIES);
}

static void make_part(struct stepper *S, struct state *state, double h, double end) {
  const struct state before = *state;
  double scales[4], corrected[VELOCITIES + 1];
  const double *from[INPUTS] = {S->near, S->shifted, S->foreseen, S->found};
  if (S->predictor.count == 0)
    begin(S, &before, h, S->y);
  else
    predict(&S->predictor, S->y);
  set_scales(&before, h, 0.0, scales);
  solve_connected(S, &before, scales, h);
  memcpy(S->near, S->advanced, COORDINATES * sizeof *S->near);
  memcpy(S->p, S->y, sizeof S->p);
  project(S, &before, h, end, 1);
  state->t = end;
  take(S, state);
  check_finite(state);
  keep(S, &before, state, h);
  clear_places(S->p);
  if (projection_equations.size > 0) { /* else formulas give what is found: nothing is foreseen */
    record(&S->end, S->p);
    corrected_shift(from, corrected);
    record(&S->shift, corrected);
  }
  accept(S);
}

