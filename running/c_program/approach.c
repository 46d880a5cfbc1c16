/* ---- equations with exponentials, from far away --------------------------------------------------------- */

/* Leads y to where Newton's method contracts, by steps along which no argument of an exponential grows by more than
   1. Zero if that does not end. */
static int approach(struct newton *N, double *y, const double *const *in) {
  const struct equations *const of = N->of;
  const double *of_kept[INPUTS];
  double before[MOST_ARGUMENTS], now[MOST_ARGUMENTS];
  int iteration, i;
  for (i = 1; i < INPUTS; ++i) of_kept[i] = in[i];
  of_kept[0] = N->u;
  for (i = 0; i < of->kept; ++i) N->u[i] = y[of->kept_at[i]];
  for (iteration = 0; iteration < 1000; ++iteration) {
    double grown = 0.0, changed = 0.0;
    of->arguments(of_kept, before);
    if (!factorize(N, of_kept)) return 0;
    multiply(N->inverse, N->all, N->change, of->size);
    for (i = 0; i < of->size; ++i) N->u[of->contained[i]] -= N->change[i];
    of->arguments(of_kept, now);
    for (i = 0; i < of->exponentials; ++i) {
      /* Below -30 exponentials are nothing. */
      const double change = largest_of(now[i], -30.0) - largest_of(before[i], -30.0);
      grown = largest_of(grown, change);
      changed = largest_of(changed, fabs(change));
    }
    if (!isfinite(grown)) return 0;
    if (grown > 1.0) {
      const double back = 1.0 - 1.0 / grown;
      for (i = 0; i < of->size; ++i) N->u[of->contained[i]] += back * N->change[i];
    } else if (changed < 1.0) {
      for (i = 0; i < of->kept; ++i) y[of->kept_at[i]] = N->u[i];
      forget_matrix(N);
      return 1;
    }
  }
  return 0;
}

