/* ---- the directions of the projection ------------------------------------------------------------------ */

/* An orthonormal basis of the covectors that annihilate what is tangent to the constraints, and one of the directions W
   in which points are moved to these. Both turn as little as possible along a curve; those that are kept are of where
   the last step ended. */
struct directions {
  double conormals[DIRECTIONS], kept_conormals[DIRECTIONS];
  double W[DIRECTIONS], kept[DIRECTIONS];
  double V[DIRECTIONS], combination[MULTIPLIERS * MULTIPLIERS], turned[DIRECTIONS]; /* W is nearest to V times the combination */
  int are_kept;
  double turning; /* |change of W| / |change of x| of the last steps, INFINITY before the first */
};

static double distance(const double *a, const double *b, int count) {
  double sum = 0.0;
  int i;
  for (i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum);
}

#if HAS_BASIS || HAS_SPAN || !IS_ALWAYS_COMPLEMENT
/* C = A^T B for A and B of so many rows. */
static void transposed_product(const double *A, int columns, const double *B, int of_B, int rows, double *C) {
  int i, j;
  for (j = 0; j < of_B; ++j)
    for (i = 0; i < columns; ++i) C[i + j * columns] = dot(A + i * rows, B + j * rows, rows);
}
#endif

/* Those covectors whose parts along the old ones are unit vectors, by linear equations. in[4]: the old ones. Zero where
   these are at right angles to them. */
static int are_conormals_found(struct directions *D, const double *const *in) {
  static double entries[CONORMAL_ENTRIES], A[CONORMAL_SIZE * CONORMAL_SIZE], u[CONORMAL_SIZE * MULTIPLIERS];
  double covectors[DIRECTIONS];
  const int n = CONORMAL_SIZE;
  int j, k;
  conormal_matrices(in, entries);
  memset(A, 0, sizeof A);
  for (k = 0; k < CONORMAL_OF_A; ++k) {
    if (!isfinite(entries[k])) return 0;
    A[conormal_row[k] + conormal_column[k] * n] = entries[k];
  }
  if (!invert(A, u, n, MULTIPLIERS)) return 0;
  memset(covectors, 0, sizeof covectors);
  for (j = 0; j < MULTIPLIERS; ++j)
    for (k = CONORMAL_OF_A; k < CONORMAL_ENTRIES; ++k)
      covectors[conormal_row[k] + j * DIMENSION] += entries[k] * u[conormal_column[k] + j * n];
  return is_made_orthonormal(covectors, DIMENSION, MULTIPLIERS, 0, D->conormals) ||
         is_made_orthonormal_from_afar(covectors, DIMENSION, MULTIPLIERS, D->conormals);
}

static void find_conormals(struct directions *D, const double **in) {
  int k, are_found = D->are_kept;
  if (are_found) {
    in[4] = D->kept_conormals;
    are_found = are_conormals_found(D, in);
  }
  for (k = 0; !D->are_kept && !are_found && k < REFERENCES; ++k) {
    const double *const reference = references + k * VELOCITIES * MULTIPLIERS;
#if HAS_BASIS
    double first[DIRECTIONS];
    transposed_product(in[2], DIMENSION, reference, MULTIPLIERS, VELOCITIES, first);
    in[4] = first;
#else
    in[4] = reference;
#endif
    are_found = are_conormals_found(D, in);
  }
  if (!are_found) fail("has constraints that turn too far");
}

#if HAS_SPAN
/* The combination of V that is nearest to W. */
static void combine(struct directions *D, const double *W) {
  double gram[MULTIPLIERS * MULTIPLIERS];
  transposed_product(D->V, MULTIPLIERS, D->V, MULTIPLIERS, DIMENSION, gram);
  transposed_product(D->V, MULTIPLIERS, W, MULTIPLIERS, DIMENSION, D->combination);
  if (factor(gram, D->combination, MULTIPLIERS, MULTIPLIERS) == 0.0) fail("has dependent directions");
  substitute(gram, D->combination, MULTIPLIERS, MULTIPLIERS);
  product(D->V, DIMENSION, D->combination, MULTIPLIERS, MULTIPLIERS, D->turned);
}

static int is_nearest_to(struct directions *D, const double *W) {
  double far[DIRECTIONS];
  combine(D, W);
  if (is_made_orthonormal(D->turned, DIMENSION, MULTIPLIERS, 0, D->W)) return 1;
  memcpy(far, D->turned, sizeof far);
  if (!is_made_orthonormal_from_afar(far, DIMENSION, MULTIPLIERS, D->W)) return 0;
  combine(D, D->W);
  return is_made_orthonormal(D->turned, DIMENSION, MULTIPLIERS, 0, D->W);
}
#endif

/* At x, with the unknowns y of the equations there. */
static void aim(struct directions *D, const double *x, const double *basis, const double *y, double t) {
  const double *in[INPUTS] = {y, x, basis, &t};
  find_conormals(D, in);
#if HAS_SPAN
  {
    const double *at[INPUTS] = {x, basis, D->conormals, &t};
    span(at, D->V);
    if (D->are_kept) product(D->V, DIMENSION, D->combination, MULTIPLIERS, MULTIPLIERS, D->turned);
    if (!(D->are_kept && is_made_orthonormal(D->turned, DIMENSION, MULTIPLIERS, 0, D->W)) &&
        !is_nearest_to(D, D->are_kept ? D->kept : D->conormals))
      fail("has directions that turn too far");
  }
#if !IS_ALWAYS_COMPLEMENT
  {
    double seen[MULTIPLIERS * MULTIPLIERS], determinant = 1.0;
    int i;
    transposed_product(D->conormals, MULTIPLIERS, D->W, MULTIPLIERS, DIMENSION, seen);
    factor(seen, NULL, MULTIPLIERS, 0);
    for (i = 0; i < MULTIPLIERS; ++i) determinant *= seen[i + i * MULTIPLIERS];
    if (!(fabs(determinant) > 1e-6)) fail("has directions along the constraints");
  }
#endif
#else
  memcpy(D->W, D->conormals, sizeof D->W);
#endif
}

/* The next step begins where these are found; the last one began at x, and led to `found`. */
static void keep_directions(struct directions *D, const double *x, const double *found) {
  const double moved = distance(found, x, COORDINATES);
  if (D->are_kept && moved > 1e-7 * largest(x, COORDINATES)) {
    const double turning = distance(D->W, D->kept, DIRECTIONS) / moved;
    D->turning = isfinite(D->turning) ? largest_of(turning, 0.9 * D->turning) : turning;
  }
#if HAS_SPAN
  {
    double next[MULTIPLIERS * MULTIPLIERS], before[MULTIPLIERS * MULTIPLIERS];
    int i;
    transposed_product(D->turned, MULTIPLIERS, D->W, MULTIPLIERS, DIMENSION, next);
    for (i = 0; i < MULTIPLIERS * MULTIPLIERS; ++i) next[i] = -next[i];
    for (i = 0; i < MULTIPLIERS * MULTIPLIERS; i += MULTIPLIERS + 1) next[i] += 2.0;
    memcpy(before, D->combination, sizeof before);
    product(before, MULTIPLIERS, next, MULTIPLIERS, MULTIPLIERS, D->combination);
  }
#endif
  memcpy(D->kept, D->W, sizeof D->kept);
  memcpy(D->kept_conormals, D->conormals, sizeof D->kept_conormals);
  D->are_kept = 1;
}

