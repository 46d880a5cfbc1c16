/* ---- a step -------------------------------------------------------------------------------------------- */

/* What is kept from step to step; a workspace for each part that a step is made of. */
struct stepper {
  struct newton newton;
  struct predictor predictor;
  double y[UNKNOWNS + 1], guess[UNKNOWNS + 1], advanced[ADVANCED + 1];
  double usual[DISPLACEMENTS + 1]; /* sizes of displacements */
  int is_trusted, is_mild, is_expected;
  int has_stepped;
  struct state before, after; /* of the last step */
  double h;
};

static struct stepper steppers[PARTS];

static void forget(struct stepper *S) {
  S->newton.of = &step_equations;
  forget_matrix(&S->newton);
  forget_steps(&S->predictor);
  S->is_expected = PARTS == 1 && S->is_trusted && S->is_mild;
  S->is_trusted = 1;
  S->is_mild = S->is_expected;
  if (!S->is_expected) memset(S->usual, 0, sizeof S->usual);
  S->has_stepped = 0;
}

/* What the state alone predicts. */
static void begin(const struct state *before, double h, double *y) {
  const int n = DISPLACEMENTS / TANGENT_BLOCKS;
  int i;
  for (i = 0; i < n; ++i) y[DISPLACEMENTS - n + i] = (0.0 + before->v[i]) * h;
  for (i = 0; TANGENT_BLOCKS == 2 && i < n; ++i) y[i] = 0.5 * y[n + i];
  for (i = 0; i < AUXILIARIES; ++i) y[DISPLACEMENTS + i] = before->z[i];
}

static int is_as_predicted(const struct stepper *S, double part, double size) {
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i) {
    const double length = largest_of(fabs(S->y[i]), S->usual[i]);
    if (!(fabs(S->y[i] - S->guess[i]) <= largest_of(part * length, 1e-10 * size))) return 0;
  }
  return 1;
}

/* Whether the solution is the one that is connected to the state: steps of h/1024, h/512, ..., h lead to it. */
static int is_connected(const struct stepper *S, const struct state *before, const double *scales, double h) {
  static struct newton newton;
  double y[UNKNOWNS + 1], last[UNKNOWNS + 1], part = ldexp(h, -10);
  const double *in[INPUTS] = {y, before->x, NULL, &part, &before->t};
  double least;
  int i, halvings;
  newton.of = &step_equations;
  begin(before, part, y);
  for (halvings = 10; halvings >= 0; --halvings) {
    double start[UNKNOWNS + 1];
    part = ldexp(h, -halvings);
    for (i = 0; i < UNKNOWNS; ++i) start[i] = y[i];
    for (i = 0; halvings < 9 && i < UNKNOWNS; ++i) y[i] += 2.0 * (y[i] - last[i]);
    for (i = 0; i < UNKNOWNS; ++i) last[i] = start[i];
    forget_matrix(&newton);
    if (!solve(&newton, y, in, scales)) return 0;
  }
  least = 1e-3 * largest(y, DISPLACEMENTS);
  for (i = 0; i < DISPLACEMENTS; ++i)
    if (!(fabs(y[i] - S->y[i]) <= 1e-3 * (fabs(y[i]) + least) + 1e-10 * scales[0])) return 0;
  return 1;
}

/* Whether the state may lie on the curve of the last steps. */
static int is_near_last(const struct stepper *S, const struct state *state) {
  double distance = 0.0, length = 0.0;
  int i;
  for (i = 0; i < COORDINATES; ++i) {
    distance = largest_of(distance, fabs(state->x[i] - S->after.x[i]));
    length = largest_of(length, fabs(S->after.x[i] - S->before.x[i]));
  }
  return fabs(state->t - S->after.t) <= 16.0 * fabs(S->h) && distance <= 16.0 * length;
}

static int all_finite(const double *x, int count) {
  int i;
  for (i = 0; i < count; ++i)
    if (!isfinite(x[i])) return 0;
  return 1;
}

static void make_part(struct stepper *S, struct state *state, double h, double end) {
  const struct state before = *state;
  const double size = largest(before.x, COORDINATES);
  const double scales[2] = {size, 1e7 * largest(before.z, AUXILIARIES) + 1e-3 * size};
  const double *in[INPUTS] = {S->y, before.x, NULL, &h, &before.t};
  int i;
  if (S->has_stepped && !is_near_last(S, state)) forget(S);

  if (S->predictor.count == 0)
    begin(&before, h, S->y);
  else
    predict(&S->predictor, S->y);
  for (i = 0; i < UNKNOWNS; ++i) S->guess[i] = S->y[i];
  if (!solve(&S->newton, S->y, in, scales)) fail("is not solved at once");
  if (LOOKS_AT_STEPS) {
    const double part = S->is_expected ? 0.25 : S->is_mild ? 0.05 : 1e-3;
    const int is_good = is_as_predicted(S, part, size);
    if (!(is_good && (S->is_trusted || S->newton.factorizations == 0))) {
      if (!is_connected(S, &before, scales, h)) fail("may have the wrong solution");
      S->is_mild = 1;
    }
    S->is_trusted = is_good;
    S->is_expected = 0;
  }

  advance(in, S->advanced);
  state->t = end;
  for (i = 0; i < COORDINATES; ++i) state->x[i] = S->advanced[i];
  for (i = 0; i < VELOCITIES; ++i) state->v[i] = S->advanced[COORDINATES + i];
  for (i = 0; i < AUXILIARIES; ++i) state->z[i] = S->y[DISPLACEMENTS + i];
  if (!all_finite(state->x, COORDINATES) || !all_finite(state->v, VELOCITIES) ||
      !all_finite(state->z, AUXILIARIES))
    fail("leads to a state that is not finite");

  record(&S->predictor, S->y);
  for (i = 0; i < DISPLACEMENTS; ++i) S->usual[i] = largest_of(fabs(S->y[i]), 0.98 * S->usual[i]);
  S->before = before;
  S->after = *state;
  S->h = h;
  S->has_stepped = 1;
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
    share += parts[i];
    make_part(&steppers[i], state, parts[i] * h, i + 1 == PARTS ? end : t + share * h);
#if MEASURES_STEPS
    see_part(&steppers[i].before, &steppers[i].after, parts[i] * h, steppers[i].advanced);
#endif
  }
}

static void begin_epoch(const struct state *state) {
  int i;
  (void)state;
  for (i = 0; i < PARTS; ++i) forget(&steppers[i]);
}

