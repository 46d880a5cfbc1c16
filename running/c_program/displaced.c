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
};

#define STEP_INPUTS(y, state, h) {y, (state)->x, NULL, h, &(state)->t}

/* What the state alone predicts. */
static void begin(const struct stepper *S, const struct state *before, double h, double *y) {
  const int n = DISPLACEMENTS / TANGENT_BLOCKS;
  int i;
  (void)S;
  for (i = 0; i < n; ++i) y[DISPLACEMENTS - n + i] = (0.0 + before->v[i]) * h;
  for (i = 0; TANGENT_BLOCKS == 2 && i < n; ++i) y[i] = 0.5 * y[n + i];
  for (i = 0; i < AUXILIARIES; ++i) y[DISPLACEMENTS + i] = before->z[i];
}

