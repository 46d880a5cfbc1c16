/* The first of the longest columns of A, and the square of its length. */
static int longest_column(const double *A, int rows, int columns, double *square) {
  int j, longest = 0;
  *square = 0.0;
  for (j = 0; j < columns; ++j) {
    const double of_column = dot(A + j * rows, A + j * rows, rows);
    if (of_column <= *square) continue;
    *square = of_column;
    longest = j;
  }
  return longest;
}

