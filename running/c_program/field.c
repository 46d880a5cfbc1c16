/* ---- the vector field ---------------------------------------------------------------------------------- */

/* The velocity v and the unknowns z at x and t, from those of the last evaluation. */
struct field {
  struct newton newton;
  double y[FIELD_UNKNOWNS + 1], sizes[FIELD_UNKNOWNS + 1]; /* the largest that each was */
  double rate[COORDINATES + 1 + VELOCITIES + 1 + AUXILIARIES + 1];
  double left_out[LEFT_OUT + 1]; /* equations that are not used */
};

/* The next evaluation begins at this state, or (NULL) where the run did. */
static void start_field(struct field *F, const struct state *state) {
  int i;
  F->newton.of = &field_equations;
  forget_matrix(&F->newton);
  for (i = 0; i < FIELD_UNKNOWNS; ++i) {
    F->y[i] = field_start[i];
    F->sizes[i] = 0.0;
  }
  if (state == NULL) return;
  for (i = 0; i < VELOCITIES; ++i) F->y[i] = 0.0 + state->v[i];
  for (i = 0; i < AUXILIARIES; ++i) F->y[FIELD_Z + i] = state->z[i];
}

static void evaluate_field(struct field *F, const double *x, double t) {
  const double *in[INPUTS] = {F->y, x, NULL, &t};
  int i, is_found = solve(&F->newton, F->y, in, F->sizes);
  if (!is_found) {
    /* From where the run begins, all unknowns measured alike. */
    forget_matrix(&F->newton);
    for (i = 0; i < FIELD_UNKNOWNS; ++i) {
      F->y[i] = field_start[i];
      F->sizes[i] = largest(field_start, FIELD_UNKNOWNS);
    }
    is_found = solve(&F->newton, F->y, in, F->sizes);
  }
  if (!is_found) fail("has a velocity that is not found");
  for (i = 0; i < FIELD_UNKNOWNS; ++i) {
    if (!isfinite(F->y[i])) fail("has a velocity that is not finite");
    F->sizes[i] = largest_of(F->sizes[i], fabs(F->y[i]));
  }
  field_rate(in, F->rate);
  field_left_out(in, F->left_out);
}

