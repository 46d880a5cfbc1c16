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
  /* of the projection onto the points that have a velocity */
  struct newton projector;
  struct predictor end, shift; /* of its unknowns; of the vector along which it leads */
  double p[UNKNOWNS + 1];
  double jets[UNKNOWNS + 1]; /* velocities, z and their derivatives at the state */
  double near[COORDINATES + 1], foreseen[COORDINATES + 1], shifted[VELOCITIES + 1];
  double found[COORDINATES + VELOCITIES + AUXILIARIES + 1];
#if HAS_BASIS
  struct basis basis; /* at the state */
  int is_turned;      /* it was made afresh */
#endif
#if TURNS
  struct directions directions;
#endif
};

#if TURNS
#define ALONG S->directions.W
#else
static const double ALONG[DIRECTIONS + 1] = {0}; /* they are numbers in the formulas */
#endif

#define STEP_INPUTS(y, state, h) {y, (state)->x, BASIS, ALONG, h, &(state)->t}

/* What the state alone predicts. */
static void begin(const struct stepper *S, const struct state *before, double h, double *y) {
  int i;
  (void)before;
  for (i = 0; i < UNKNOWNS; ++i) y[i] = S->jets[i];
  for (i = 0; i < DISPLACEMENTS; ++i) y[i] = 0.5 * h * S->jets[DISPLACEMENTS + i];
}

