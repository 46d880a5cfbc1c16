/* ---- a step -------------------------------------------------------------------------------------------- */

/* What is kept from step to step; a workspace for each part that a step is made of. */
struct stepper {
  struct newton newton;
  struct predictor predictor;
  double y[UNKNOWNS + 1], guess[UNKNOWNS + 1], advanced[ADVANCED + 1];
  double usual[DISPLACEMENTS + 1]; /* sizes of displacements */
  int is_trusted, is_mild, is_expected;
  int has_stepped, is_prepared;
  struct state before, after; /* of the last step */
  double h;
#if HAS_BASIS
  struct basis basis; /* at the state */
#endif
};

#define STEP_INPUTS(y, state, h) {y, (state)->x, BASIS, h, &(state)->t}

/* What the state alone predicts. */
static void begin(const struct stepper *S, const struct state *before, double h, double *y) {
  const int n = DISPLACEMENTS / TANGENT_BLOCKS;
  double *const moves = y + DISPLACEMENTS - n;
  int i;
#if HAS_BASIS
  find_coordinates(&S->basis, before->v, moves);
#else
  (void)S;
  for (i = 0; i < n; ++i) moves[i] = 0.0 + before->v[i];
#endif
  for (i = 0; i < n; ++i) moves[i] *= h;
  for (i = 0; TANGENT_BLOCKS == 2 && i < n; ++i) y[i] = 0.5 * y[n + i];
  for (i = 0; i < AUXILIARIES; ++i) y[DISPLACEMENTS + i] = before->z[i];
}

