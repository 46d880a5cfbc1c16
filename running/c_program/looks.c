static void forget_looks(struct stepper *S) {
#if HAS_BASIS
  /* A basis that is made afresh has other coordinates. */
  const double size = largest(S->usual, DISPLACEMENTS);
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i) S->usual[i] = size;
#endif
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

/* The solution for a small part of h, from what the state predicts. */
static int is_begun(const struct stepper *S, struct newton *N, const struct state *before, const double *scales,
                    double part, double *y) {
  const double *in[INPUTS] = STEP_INPUTS(y, before, &part);
  begin(S, before, part, y);
  forget_matrix(N);
  if (solve(N, y, in, scales)) return 1;
#if HAS_EXPONENTIALS
  begin(S, before, part, y);
  if (approach(N, y, in)) return solve(N, y, in, scales);
#endif
  return 0;
}

/* Whether displacements are as they were foreseen, to a tenth. */
static int is_near(const double *y, const double *foreseen) {
  const double size = largest(y, DISPLACEMENTS);
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i)
    if (!(fabs(y[i] - foreseen[i]) <= 0.1 * size)) return 0;
  return 1;
}

/* The solution that is connected to the state: steps of h/1024, h/512, ..., h lead to it, each foreseen on the
   straight line through the last two, and shorter ones where that is far off. Zero if they end before h. */
static int follow(const struct stepper *S, const struct state *before, const double *scales, double h, double *y) {
  static struct newton newton;
  double last[UNKNOWNS + 1], former[UNKNOWNS + 1], foreseen[UNKNOWNS + 1];
  double at = 0.0, reached = ldexp(1.0, -10), next, part; /* parts of h: of former, of last */
  const double *in[INPUTS] = STEP_INPUTS(y, before, &part);
  int i;
  newton.of = &step_equations;
  while (!is_begun(S, &newton, before, scales, reached * h, y)) {
    reached *= 0.125;
    if (reached < 1e-12) return 0;
  }
  memcpy(last, y, sizeof last);
  next = 2.0 * reached;
  while (reached < 1.0) {
    for (i = 0; i < UNKNOWNS; ++i) {
      foreseen[i] = last[i];
      if (at > 0.0)
        foreseen[i] += (next - reached) / (reached - at) * (last[i] - former[i]);
      else if (i < DISPLACEMENTS)
        foreseen[i] *= 2.0;
      y[i] = foreseen[i];
    }
    part = next * h;
    forget_matrix(&newton);
    if (solve(&newton, y, in, scales) && (at == 0.0 || is_near(y, foreseen))) {
      memcpy(former, last, sizeof former);
      memcpy(last, y, sizeof last);
      at = reached;
      reached = next;
      next = reached < 0.5 ? 2.0 * reached : 1.0;
    } else {
      next = reached + 0.3 * (next - reached);
      if (next - reached < 1e-4 * reached) return 0;
    }
  }
  return 1;
}

/* Whether the end y of that curve is the solution that was found. */
static int is_same(const struct stepper *S, const double *y, double size) {
  const double least = 1e-3 * largest(y, DISPLACEMENTS);
  int i;
  for (i = 0; i < DISPLACEMENTS; ++i)
    if (!(fabs(y[i] - S->y[i]) <= 1e-3 * (fabs(y[i]) + least) + 1e-10 * size)) return 0;
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

/* Solves from y, and again from what is found, to 24 bits: in these all ways to a solution agree. */
static int is_solved_from(struct stepper *S, const double *y, const double *const *in, const double *scales) {
  int i;
  memcpy(S->y, y, sizeof S->y);
  forget_matrix(&S->newton);
  if (!solve(&S->newton, S->y, in, scales)) return 0;
  for (i = 0; i < UNKNOWNS; ++i)
    if (fabs(S->y[i]) > 1e-30 && fabs(S->y[i]) < 1e30) S->y[i] = (float)S->y[i];
  forget_matrix(&S->newton);
  return solve(&S->newton, S->y, in, scales);
}

/* S->y holds the prediction, then the solution that is connected to the state. */
static void solve_connected(struct stepper *S, const struct state *before, const double *scales, double h) {
  const double *in[INPUTS] = STEP_INPUTS(S->y, before, &h);
  const double part = S->is_expected ? 0.25 : S->is_mild ? 0.05 : 1e-3;
  double y[UNKNOWNS + 1];
  int is_solved, is_good;
  memcpy(S->guess, S->y, sizeof S->guess);
  is_solved = solve(&S->newton, S->y, in, scales);
  if (!LOOKS_AT_STEPS && !is_solved) fail("is not solved at once");
  is_good = is_solved && is_as_predicted(S, part, scales[0]);
  if (LOOKS_AT_STEPS && !(is_good && (S->is_trusted || S->newton.factorizations == 0))) {
    if (!follow(S, before, scales, h, y)) fail("has no solution that can be followed from its state");
    if (!(is_solved && is_same(S, y, scales[0])) &&
        !(is_solved_from(S, y, in, scales) && is_same(S, y, scales[0])))
      fail("may have the wrong solution");
    S->is_mild = 1;
  }
  S->is_trusted = is_good;
  S->is_expected = 0;
  advance(in, S->advanced);
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

