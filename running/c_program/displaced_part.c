#if HAS_BASIS
static void forget(struct stepper *S) {
  forget_looks(S);
  S->basis.is_set = 0;
}

static void go_to(struct stepper *S, const double *x) {
  if (!move_basis(&S->basis, x)) forget_steps(&S->predictor, &step_places);
}

static void prepare(struct stepper *S, struct state *state, double h) {
  go_to(S, state->x);
  (void)h;
}

static void take_over(struct stepper *S, const struct stepper *other) {
  if (!take_over_basis(&S->basis, &other->basis)) forget_steps(&S->predictor, &step_places);
}
#else
static void forget(struct stepper *S) { forget_looks(S); }

static void prepare(struct stepper *S, struct state *state, double h) { (void)S, (void)state, (void)h; }

static void take_over(struct stepper *S, const struct stepper *other) { (void)S, (void)other; }
#endif

static void learn_at_stage(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  accompany(&S->predictor, c, &other->predictor, &step_places, times, ratio, DISPLACEMENTS, 0, UNKNOWNS);
}

static void learn_at_end(struct stepper *S, int c, const struct stepper *other, double times, double ratio) {
  (void)S, (void)c, (void)other, (void)times, (void)ratio;
}

/* Displacements are solved for next to this. */
static double size_of(const double *x) {
  double size = 0.0;
  int i;
  for (i = 0; i < CONTAINED; ++i) size = largest_of(size, fabs(x[contained[i]]));
  return size > 0.0 ? size : largest(x, COORDINATES);
}

static void make_part(struct stepper *S, struct state *state, double h, double end) {
  const struct state before = *state;
  const double size = size_of(before.x);
  const double scales[2] = {size, 1e7 * largest(before.z, AUXILIARIES) + 1e-3 * size};
  if (S->predictor.count == 0)
    begin(S, &before, h, S->y);
  else
    predict(&S->predictor, S->y);
  solve_connected(S, &before, scales, h);
  state->t = end;
  memcpy(state->x, S->advanced, COORDINATES * sizeof *state->x);
  memcpy(state->v, S->advanced + COORDINATES, VELOCITIES * sizeof *state->v);
  memcpy(state->z, S->y + DISPLACEMENTS, AUXILIARIES * sizeof *state->z);
#if SPACE_EQUATIONS > 0
  keep_to_space(state->x);
#endif
  check_finite(state);
  keep(S, &before, state, h);
#if HAS_BASIS
  go_to(S, state->x);
#endif
}

