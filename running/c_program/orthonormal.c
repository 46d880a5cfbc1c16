/* ---- orthonormal matrices ------------------------------------------------------------------------------ */

/* E = 1 - P^T P for P of so many columns; the sum of the squares of its entries. */
static double defect(const double *P, int rows, int columns, double *E) {
  double sum = 0.0;
  int a, b;
  for (a = 0; a < columns; ++a)
    for (b = 0; b <= a; ++b) {
      const double entry = (a == b ? 1.0 : 0.0) - dot(P + a * rows, P + b * rows, rows);
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

/* B = P (P^T P)^(-1/2) by steps P <- P (1 + E/2 + 3/8 E^2). Zero, and B as it was, if P is so far from orthonormal that
   it takes more than so many steps to come near. */
static int is_made_orthonormal(const double *P, int rows, int columns, int most_from_afar, double *B) {
  static double E[MOST_COLUMNS * MOST_COLUMNS], root[MOST_COLUMNS * MOST_COLUMNS], square[MOST_COLUMNS * MOST_COLUMNS];
  const int count = columns * columns;
  const double *from = P;
  int far = 0, i, j, k;
  for (;; from = B) {
    const double size = defect(from, rows, columns, E);
    if (!(size < 0.25) && (++far > most_from_afar || !isfinite(size))) return 0;
    for (k = 0; k < count; ++k) root[k] = 0.5 * E[k];
    if (size > 1e-16) {
      product(E, columns, E, columns, columns, square);
      for (k = 0; k < count; ++k) root[k] += 0.375 * square[k];
    }
    for (k = 0; k < count; k += columns + 1) root[k] += 1.0;
    for (i = 0; i < rows; ++i) {
      double row[MOST_COLUMNS];
      for (j = 0; j < columns; ++j) {
        row[j] = from[i] * root[j * columns];
        for (k = 1; k < columns; ++k) row[j] += from[i + k * rows] * root[k + j * columns];
      }
      for (j = 0; j < columns; ++j) B[i + j * rows] = row[j];
    }
    if (size <= 3e-11) return 1;
  }
}

/* The same for P far from orthonormal, which changes. */
static int is_made_orthonormal_from_afar(double *P, int rows, int columns, double *B) {
  double square = 0.0, size;
  int i;
  for (i = 0; i < rows * columns; ++i) square += P[i] * P[i];
  if (!(square > 0.0) || !isfinite(square)) return 0;
  size = sqrt(square);
  for (i = 0; i < rows * columns; ++i) P[i] /= size;
  return is_made_orthonormal(P, rows, columns, 16, B);
}

