static void forget_projections(struct stepper *S) {
  forget_steps(&S->end, &end_places);
  forget_steps(&S->shift, &shift_places);
}

#if HAS_BASIS
static void forget_motion(struct stepper *S) {
  forget_steps(&S->predictor, &step_places);
  forget_projections(S);
}
#endif

static void forget(struct stepper *S) {
  forget_looks(S);
  S->projector.of = &projection_equations;
  forget_matrix(&S->projector);
  forget_projections(S);
#if HAS_BASIS
  S->basis.is_set = 0;
  S->is_turned = 0;
#endif
#if TURNS
  S->directions.are_kept = 0;
  S->directions.turning = INFINITY;
#endif
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
  for (i = UNKNOWNS - MULTIPLIERS; i < UNKNOWNS; ++i) y[i] = 0.0;
}

/* The largest of the velocity before the step, of that in its middle and of that after it, extrapolated. */
static double largest_speed(const struct stepper *S, const struct state *before) {
  double before_it[DISPLACEMENTS + 1], speed = 0.0;
  int i;
#if HAS_BASIS
  find_coordinates(&S->basis, before->v, before_it);
#else
  memcpy(before_it, before->v, DISPLACEMENTS * sizeof *before_it);
#endif
  for (i = 0; i < DISPLACEMENTS; ++i) {
    const double middle = S->p[DISPLACEMENTS + i];
    speed = largest_of(speed, largest_of(fabs(before_it[i]), largest_of(fabs(middle), fabs(2.0 * middle - before_it[i]))));
  }
  return speed;
}

/* Whether the point found is not far from S->near, next to the step and to coordinates of this size; nor the
   displacements from where it was foreseen. */
static int is_nearby(const struct stepper *S, const struct state *before, const double *guess, double path, double size) {
  double step = fabs(path), away = 0.0, moved = 0.0, nearby;
  int i;
  for (i = 0; i < COORDINATES; ++i) {
    step = largest_of(step, fabs(S->near[i] - before->x[i]));
    away = largest_of(away, fabs(guess[i] - S->near[i]));
    moved = largest_of(moved, fabs(S->found[i] - S->near[i]));
  }
  nearby = largest_of(0.5 * step, 1e-10 * size);
  return moved <= nearby && largest(S->p, DISPLACEMENTS) <= nearby + 2.0 * away;
}

#if HAS_BASIS
/* The same vectors in the basis at x. */
static void turn_vectors(struct stepper *S, const double *x) {
  double vectors[VELOCITIES * TANGENT_BLOCKS];
  int k;
  product(S->basis.entries, VELOCITIES, S->p, DIMENSION, TANGENT_BLOCKS, vectors);
  if (!move_basis(&S->basis, x)) S->is_turned = 1;
  for (k = 0; k < TANGENT_BLOCKS; ++k) find_coordinates(&S->basis, vectors + k * VELOCITIES, S->p + k * DIMENSION);
}
#endif

#if TURNS
/* By how much some unknowns differ, relative to their size. */
static double change(const double *from, const double *to, int count) {
  double moved = 0.0;
  int i;
  for (i = 0; i < count; ++i) moved = largest_of(moved, fabs(to[i] - from[i]));
  return moved == 0.0 ? 0.0 : moved / largest(to, count);
}

/* Whether W of the last iterate was that of the point found; `moved` and the change before are those of the point. */
static int is_aimed(const struct stepper *S, const double *aimed, double moved, double previous, int iteration,
                    int goes_on) {
  const double size = largest(S->found, COORDINATES), *const mu = S->p + UNKNOWNS - MULTIPLIERS;
  if (iteration == 0) {
    /* Where steps begin the point moves with W not at all; but the next one begins along W. */
    const double *const of_step = S->y + UNKNOWNS - MULTIPLIERS;
    const int rest = UNKNOWNS - MULTIPLIERS - 2 * DISPLACEMENTS;
    const double length =
        sqrt(largest_of(dot(mu, mu, MULTIPLIERS), dot(of_step, of_step, MULTIPLIERS)));
    const double of_jets = largest_of(change(aimed + DISPLACEMENTS, S->p + DISPLACEMENTS, DISPLACEMENTS),
                                      change(aimed + 2 * DISPLACEMENTS, S->p + 2 * DISPLACEMENTS, rest));
    return goes_on && 10.0 * S->directions.turning * length * largest_of(moved, size * of_jets) <= 1e-16 * size;
  }
  return moved <= 1e-15 * size || moved / previous * moved <= 1e-16 * size ||
         (moved / previous >= 0.5 && moved < 1e-10 * (1.0 + size));
}
#endif

/* From S->near to the constraints; S->p are the unknowns there. `goes_on`: at the end of a step. */
static void project(struct stepper *S, const struct state *before, double h, double t, int goes_on) {
  double guess[COORDINATES + 1], scales[4], speed;
  const double *in[INPUTS] = {S->p, guess, BASIS, ALONG, S->near, &t};
  int iteration;
#if TURNS
  double previous = INFINITY;
#endif
  clear_places(S->p);
  clear_shifts(S->p);
  memcpy(guess, S->near, sizeof guess);
  speed = goes_on && !IS_EXPLICIT ? largest_speed(S, before) : 0.0;
  if (goes_on && S->shift.count > 0) {
    const double *from[INPUTS] = {S->near, S->shifted};
    predict(&S->shift, S->shifted);
    shift_from(from, guess);
  }
  memcpy(S->foreseen, guess, sizeof guess);
  for (iteration = 0; iteration < 30; ++iteration) {
#if TURNS
    double aimed[UNKNOWNS + 1], moved;
#endif
#if HAS_BASIS
    turn_vectors(S, guess);
#endif
    if (iteration == 0 && goes_on && S->end.count > 0) {
      predict(&S->end, S->p);
      clear_places(S->p);
    }
#if TURNS
    aim(&S->directions, guess, BASIS, S->p, t);
    memcpy(aimed, S->p, sizeof aimed);
#endif
    set_scales(before, h, largest(S->near, COORDINATES), scales);
    if (!solve(&S->projector, S->p, in, scales)) fail("is not projected at once");
    projected(in, S->found);
    if (goes_on && !IS_EXPLICIT && !is_nearby(S, before, guess, h * speed, scales[0])) fail("is projected too far");
#if TURNS
    moved = largest(S->p, DISPLACEMENTS);
    if (is_aimed(S, aimed, moved, previous, iteration, goes_on)) return;
    memcpy(guess, S->found, COORDINATES * sizeof *guess);
    clear_places(S->p);
    previous = moved;
#else
    return;
#endif
  }
  fail("is projected along directions that change too fast");
}

/* What the projection found, as a state. */
static void take(struct stepper *S, struct state *state) {
  memcpy(state->x, S->found, COORDINATES * sizeof *state->x);
  memcpy(state->v, S->found + COORDINATES, VELOCITIES * sizeof *state->v);
  memcpy(state->z, S->found + COORDINATES + VELOCITIES, AUXILIARIES * sizeof *state->z);
}

/* The next step begins where the projection ended; the last one began at x. */
static void accept(struct stepper *S, const double *x) {
#if TURNS
  keep_directions(&S->directions, x, S->found);
#endif
#if HAS_BASIS
  if (!move_basis(&S->basis, S->found)) S->is_turned = 1;
  if (S->is_turned) forget_motion(S);
  S->is_turned = 0;
#endif
  memcpy(S->jets, S->p, sizeof S->jets);
  clear_places(S->jets);
  clear_shifts(S->jets);
  (void)x;
}

/* Onto the constraints, where the velocities are found. */
static void prepare(struct stepper *S, struct state *state, double h) {
  double x[COORDINATES + 1];
  int i;
#if HAS_BASIS
  if (!move_basis(&S->basis, state->x)) forget_motion(S);
#endif
  memcpy(x, state->x, sizeof x);
  memcpy(S->p, S->jets, sizeof S->p);
#if HAS_BASIS
  find_coordinates(&S->basis, state->v, S->p + DISPLACEMENTS);
#else
  for (i = 0; i < DISPLACEMENTS; ++i) S->p[DISPLACEMENTS + i] = 0.0 + state->v[i];
#endif
  for (i = 0; i < AUXILIARIES; ++i) S->p[TANGENT_BLOCKS * DISPLACEMENTS + i] = state->z[i];
  memcpy(S->near, state->x, sizeof S->near);
  project(S, state, h, state->t, 0);
  accept(S, x);
  take(S, state);
}

/* The next step begins where that of another part ended. */
static void take_over(struct stepper *S, const struct stepper *other) {
#if HAS_BASIS
  if (!take_over_basis(&S->basis, &other->basis)) forget_motion(S);
  S->is_turned = 0;
#endif
#if TURNS
  S->directions = other->directions;
#endif
  memcpy(S->jets, other->jets, sizeof S->jets);
}

static void learn_at_stage(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  accompany(&S->predictor, c, &other->predictor, &step_places, times, ratio, DISPLACEMENTS, MULTIPLIERS, UNKNOWNS);
}

static void learn_at_end(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  accompany(&S->end, c, &other->end, &end_places, times, ratio, 0, MULTIPLIERS, UNKNOWNS);
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
#if SPACE_EQUATIONS > 0
  keep_to_space(S->near);
#endif
  memcpy(S->p, S->y, sizeof S->p);
  project(S, &before, h, end, 1);
  state->t = end;
  take(S, state);
  check_finite(state);
  keep(S, &before, state, h);
  clear_places(S->p);
  if (!IS_EXPLICIT) { /* else formulas give what is found: nothing is foreseen */
    record(&S->end, S->p);
    corrected_shift(from, corrected);
    record(&S->shift, corrected);
  }
  accept(S, before.x);
}

