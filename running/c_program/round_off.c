/* ---- the equations of the space ------------------------------------------------------------------------ */

/* Moves x, which is on the space up to accumulated round-off, by one step of Gauss and Newton. The gradients are made
   orthonormal by Gram and Schmidt, each the longest of what the earlier ones leave. */
static void keep_to_space(double *x) {
  static double all[SPACE_EQUATIONS + space_entries], gradients[SPACE_EQUATIONS * COORDINATES];
  const double *in[INPUTS] = {x};
  double first = 0.0;
  int i, j, turn;
  space_residual(in, all);
  if (largest(all, SPACE_EQUATIONS) <= 32.0 * DBL_EPSILON * largest_of(1.0, dot(x, x, COORDINATES))) return;
  space_jacobian(in, all);
  for (i = 0; i < SPACE_EQUATIONS + space_entries; ++i)
    if (!isfinite(all[i])) return;
  memset(gradients, 0, sizeof gradients);
  for (i = 0; i < space_entries; ++i)
    gradients[space_column[i] + space_row[i] * COORDINATES] = all[SPACE_EQUATIONS + i];
  for (turn = 0; turn < SPACE_EQUATIONS; ++turn) {
    double square, length, distance, *direction;
    const int longest = longest_column(gradients, COORDINATES, SPACE_EQUATIONS, &square);
    length = sqrt(square);
    if (turn == 0) first = length;
    /* Equations that repeat others leave round-off, which is no direction. */
    if (!(length > 1e-8 * first)) return;
    direction = gradients + longest * COORDINATES;
    for (j = 0; j < COORDINATES; ++j) direction[j] /= length;
    distance = all[longest] / length;
    for (j = 0; j < COORDINATES; ++j) x[j] -= distance * direction[j];
    for (i = 0; i < SPACE_EQUATIONS; ++i) {
      double *const gradient = gradients + i * COORDINATES;
      double part;
      if (i == longest) continue;
      part = dot(direction, gradient, COORDINATES);
      for (j = 0; j < COORDINATES; ++j) gradient[j] -= part * direction[j];
      all[i] -= part * distance;
    }
    for (j = 0; j < COORDINATES; ++j) direction[j] = 0.0;
  }
}

