static double scalar_product(const double *a, const double *b, int count) {
  double sum = 0.0;
  int i;
  for (i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

