/* ---- orthonormal matrices ------------------------------------------------------------------------------ */

/* E = 1 - P^T P for P of so many columns; the sum of the squares of its entries. */
static double defect(const double *P, int rows, int columns, double *E) {
  double sum = 0.0;
  int a, b, i;
  for (a = 0; a < columns; ++a)
    for (b = 0; b <= a; ++b) {
      double entry = a == b ? 1.0 : 0.0;
      for (i = 0; i < rows; ++i) entry -= P[i + a * rows] * P[i + b * rows];
      E[a + b * columns] = E[b + a * columns] = entry;
      sum += (a == b ? 1.0 : 2.0) * (entry * entry);
    }
  return sum;
}

/* C = A B, A with so many rows and B with so many. */
static void product(const double *A, int rows, const double *B, int inner, int columns, double *C) {
  int i, j, k;
  for (j = 0; j < columns; ++j)
    for (i = 0; i < rows; ++i) {
      double entry = A[i] * B[j * inner];
      for (k = 1; k < inner; ++k) entry += A[i + k * rows] * B[k + j * inner];
      C[i + j * rows] = entry;
    }
}

/* B = P (P^T P)^(-1/2) by the power series in E. Zero, and B as it was, unless P is nearly orthonormal. */
static int is_made_orthonormal(const double *P, int rows, int columns, double *B) {
  static double E[MOST_COLUMNS * MOST_COLUMNS], root[MOST_COLUMNS * MOST_COLUMNS],
      power[MOST_COLUMNS * MOST_COLUMNS], next[MOST_COLUMNS * MOST_COLUMNS];
  const int count = columns * columns;
  const double size = defect(P, rows, columns, E);
  double coefficient = 0.5, of_term = size * size;
  int j, k;
  if (!(size < 0.25)) return 0;
  for (k = 0; k < count; ++k) {
    root[k] = 0.5 * E[k];
    power[k] = E[k];
  }
  for (k = 0; k < count; k += columns + 1) root[k] += 1.0;
  for (j = 2; of_term > 1e-32; ++j, of_term *= size) {
    coefficient *= 1.0 - 0.5 / j;
    product(power, columns, E, columns, columns, next);
    memcpy(power, next, count * sizeof *power);
    for (k = 0; k < count; ++k) root[k] += coefficient * power[k];
  }
  product(P, rows, root, columns, columns, B);
  return 1;
}

/* The same for P far from orthonormal, which changes: P <- P (1 + E/2) (Newton and Schulz) until it is near. */
static int is_made_orthonormal_from_afar(double *P, int rows, int columns, double *B) {
  static double E[MOST_COLUMNS * MOST_COLUMNS];
  double square = 0.0, size;
  int i, k;
  for (i = 0; i < rows * columns; ++i) square += P[i] * P[i];
  if (!(square > 0.0) || !isfinite(square)) return 0;
  size = sqrt(square);
  for (i = 0; i < rows * columns; ++i) P[i] /= size;
  for (k = 0; k < 24; ++k) {
    if (is_made_orthonormal(P, rows, columns, B)) return 1;
    defect(P, rows, columns, E);
    for (i = 0; i < columns * columns; ++i) E[i] *= 0.5;
    for (i = 0; i < columns * columns; i += columns + 1) E[i] += 1.0;
    product(P, rows, E, columns, columns, B);
    memcpy(P, B, rows * columns * sizeof *P);
  }
  return 0;
}

