/* ---- the vector field ---------------------------------------------------------------------------------- */

/* The velocity v and the unknowns z at x and t, from those of the last evaluation. */
struct field {
  struct newton newton;
  double y[FIELD_UNKNOWNS + 1], sizes[FIELD_UNKNOWNS + 1]; /* the largest that each was */
  double rate[COORDINATES + 1 + VELOCITIES + 1 + AUXILIARIES + 1];
  double left_out[LEFT_OUT + 1]; /* equations that are not used */
#if HAS_BASIS
  struct basis basis; /* of the derivatives of displacements in y, where it is evaluated */
#endif
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
#if HAS_BASIS
  F->basis.is_set = F->basis.is_set && state != NULL;
#endif
  if (state == NULL || FIELD_UNKNOWNS == 0) return;
#if HAS_BASIS
  move_basis(&F->basis, state->x);
  find_coordinates(&F->basis, state->v, F->y);
#else
  for (i = 0; i < VELOCITIES; ++i) F->y[i] = 0.0 + state->v[i];
#endif
  for (i = 0; i < AUXILIARIES; ++i) F->y[FIELD_Z + i] = state->z[i];
}

/* On curved spaces its basis has to be at x. */
static void evaluate_field(struct field *F, const double *x, double t) {
#if HAS_BASIS
  const double *in[INPUTS] = {F->y, x, F->basis.entries, &t};
#else
  const double *in[INPUTS] = {F->y, x, NULL, &t};
#endif
  int i, is_found = FIELD_UNKNOWNS == 0 || solve(&F->newton, F->y, in, F->sizes);
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
  for (i = 0; FIELD_UNKNOWNS == 0 && i < COORDINATES + VELOCITIES + AUXILIARIES; ++i)
    if (!isfinite(F->rate[i])) fail("has a velocity that is not finite");
  field_left_out(in, F->left_out);
}

