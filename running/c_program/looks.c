static void forget_looks(struct stepper *S) {
  S->newton.of = &step_equations;
  forget_matrix(&S->newton);
  forget_steps(&S->predictor, &step_places);
  S->is_expected = PARTS == 1 && S->is_trusted && S->is_mild;
  S->is_trusted = 1;
  S->is_mild = S->is_expected;
  if (!S->is_expected) memset(S->usual, 0, sizeof S->usual);
  S->has_stepped = S->is_prepared = 0;
}

static int is_as_predicted(const struct stepper *S, double part, double size) {
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i) {
    const double length = largest_of(fabs(S->y[i]), S->usual[i]);
    if (!(fabs(S->y[i] - S->guess[i]) <= largest_of(part * length, 1e-10 * size))) return 0;
  }
  return 1;
}

/* The solution that is connected to the state: steps of h/1024, h/512, ..., h lead to it. Zero if they end before. */
static int follow(const struct stepper *S, const struct state *before, const double *scales, double h, double *y) {
  static struct newton newton;
  double last[UNKNOWNS + 1], part = ldexp(h, -10);
  const double *in[INPUTS] = STEP_INPUTS(y, before, &part);
  int i, halvings;
  newton.of = &step_equations;
  begin(S, before, part, y);
  for (halvings = 10; halvings >= 0; --halvings) {
    double start[UNKNOWNS + 1];
    part = ldexp(h, -halvings);
    for (i = 0; i < UNKNOWNS; ++i) start[i] = y[i];
    for (i = 0; halvings < 9 && i < UNKNOWNS; ++i) y[i] += 2.0 * (y[i] - last[i]);
    for (i = 0; i < UNKNOWNS; ++i) last[i] = start[i];
    forget_matrix(&newton);
    if (!solve(&newton, y, in, scales)) return 0;
  }
  return 1;
}

static int is_connected(const struct stepper *S, const struct state *before, const double *scales, double h) {
  double y[UNKNOWNS + 1], least;
  int i;
  if (!follow(S, before, scales, h, y)) return 0;
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

/* Once. */
static void tell(const char *what) {
  static int is_told;
  if (!is_told) fprintf(stderr, "step %ld %s\n", step_number, what);
  is_told = 1;
}

/* S->y holds the prediction, then the solution that is connected to the state. */
static void solve_connected(struct stepper *S, const struct state *before, const double *scales, double h) {
  const double *in[INPUTS] = STEP_INPUTS(S->y, before, &h);
  const double part = S->is_expected ? 0.25 : S->is_mild ? 0.05 : 1e-3;
  int i, is_good, is_second = 0;
  for (i = 0; i < UNKNOWNS; ++i) S->guess[i] = S->y[i];
  if (!solve(&S->newton, S->y, in, scales)) {
    is_second = LOOKS_AT_STEPS && follow(S, before, scales, h, S->y);
    forget_matrix(&S->newton);
    if (!is_second || !solve(&S->newton, S->y, in, scales)) fail("is not solved at once");
    tell("is made in a second attempt: from here on rows differ from those of `courant run` by round-off");
  }
  advance(in, S->advanced);
  if (!LOOKS_AT_STEPS) return;
  if (is_second) {
    S->is_mild = 1;
    S->is_trusted = S->is_expected = 0;
    return;
  }
  is_good = is_as_predicted(S, part, scales[0]);
  if (!(is_good && (S->is_trusted || S->newton.factorizations == 0))) {
    if (!is_connected(S, before, scales, h)) fail("may have the wrong solution");
    S->is_mild = 1;
  }
  S->is_trusted = is_good;
  S->is_expected = 0;
}

static void check_finite(const struct state *state) {
  if (!all_finite(state->x, COORDINATES) || !all_finite(state->v, VELOCITIES) ||
      !all_finite(state->z, AUXILIARIES))
    fail("leads to a state that is not finite");
}

/* The step stands. */
static void keep(struct stepper *S, const struct state *before, const struct state *after, double h) {
  int i;
  record(&S->predictor, S->y);
  for (i = 0; i < DISPLACEMENTS; ++i) S->usual[i] = largest_of(fabs(S->y[i]), 0.98 * S->usual[i]);
  S->before = *before;
  S->after = *after;
  S->h = h;
  S->has_stepped = S->is_prepared = 1;
}

