/* ---- bases of tangent spaces --------------------------------------------------------------------------- */

/* An orthonormal basis, column by column, that turns as little as possible along a curve: the last one projected
   to the new tangent space, and made orthonormal. */
struct basis {
  double entries[VELOCITIES * DIMENSION];
  int is_set;
  long times_made; /* afresh */
};

/* The range of the projector: its columns by Gram and Schmidt, each the longest of what the earlier ones leave. */
static void make_basis(struct basis *B, const double *x) {
  double projector[VELOCITIES * VELOCITIES], projected[VELOCITIES * DIMENSION];
  const double *in[INPUTS] = {x, B->entries};
  int first, i, j, k;
  for (first = 0; first < VELOCITIES; first += DIMENSION) {
    const int count = VELOCITIES - first < DIMENSION ? VELOCITIES - first : DIMENSION;
    memset(B->entries, 0, sizeof B->entries);
    for (j = 0; j < count; ++j) B->entries[first + j + j * VELOCITIES] = 1.0;
    on_tangent_space(in, projected);
    memcpy(projector + first * VELOCITIES, projected, count * VELOCITIES * sizeof *projector);
  }
  for (k = 0; k < DIMENSION; ++k) {
    double *const direction = B->entries + k * VELOCITIES;
    double square, length;
    const int longest = longest_column(projector, VELOCITIES, VELOCITIES, &square);
    length = projector[longest * VELOCITIES] > 0.0 ? -sqrt(square) : sqrt(square);
    for (i = 0; i < VELOCITIES; ++i) direction[i] = projector[i + longest * VELOCITIES] / length;
    for (j = 0; j < VELOCITIES; ++j) {
      double *const column = projector + j * VELOCITIES;
      const double part = dot(direction, column, VELOCITIES);
      for (i = 0; i < VELOCITIES; ++i) column[i] -= part * direction[i];
    }
  }
  for (i = 0; i < VELOCITIES * DIMENSION; ++i)
    if (fabs(B->entries[i]) < 1e-15) B->entries[i] = 0.0;
  B->is_set = 1;
  ++B->times_made;
}

/* Zero where it was made afresh: coordinates in it have nothing to do with those before. */
static int move_basis(struct basis *B, const double *x) {
  if (B->is_set) {
    double projected[VELOCITIES * DIMENSION];
    const double *in[INPUTS] = {x, B->entries};
    on_tangent_space(in, projected);
    if (is_made_orthonormal(projected, VELOCITIES, DIMENSION, 0, B->entries)) return 1;
    if (is_made_orthonormal_from_afar(projected, VELOCITIES, DIMENSION, B->entries)) return 1;
  }
  make_basis(B, x);
  return 0;
}

/* Whether coordinates in it are those before, moved along. */
static int take_over_basis(struct basis *B, const struct basis *other) {
  const int goes_on = B->times_made == other->times_made;
  *B = *other;
  return goes_on;
}

static void find_coordinates(const struct basis *B, const double *v, double *coordinates) {
  int j;
  for (j = 0; j < DIMENSION; ++j) coordinates[j] = dot(B->entries + j * VELOCITIES, v, VELOCITIES);
}

