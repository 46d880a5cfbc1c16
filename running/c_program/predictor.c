/* ---- prediction ---------------------------------------------------------------------------------------- */

enum { KEPT = 12, DEGREES = 8, JUDGED = 3, STEPS_BETWEEN_CHOICES = 32 };

/* Places in y, each in one of two groups. */
struct places {
  int count;
  const int *at, *group;
};

/* The next unknowns by extrapolation of the last ones, for each group of them by the polynomial that would have
   been best for the last steps. */
struct predictor {
  const struct places *of;
  int newest, count, steps_to_choice;
  double history[MOST_PREDICTED + 1][KEPT];
  double weights[2][2 * KEPT]; /* of unknowns so many steps old, twice over */
};

static void forget_steps(struct predictor *P, const struct places *of) {
  memset(P, 0, sizeof *P);
  P->of = of;
}

static void predict(const struct predictor *P, double *y) {
  int i, j;
  for (i = 0; i < P->of->count; ++i) {
    const double *const a = P->history[i], *const b = P->weights[P->of->group[i]] + (KEPT - P->newest);
    double even = 0.0, odd = 0.0;
    for (j = 0; j < KEPT; j += 2) {
      even += a[j] * b[j];
      odd += a[j + 1] * b[j + 1];
    }
    y[P->of->at[i]] = even + odd;
  }
}

static int best_degree(const struct predictor *P, int group) {
  double largest_difference[DEGREES + 1] = {0}, differences[KEPT];
  const int degrees = P->count - 1 < DEGREES + 1 ? P->count - 1 : DEGREES + 1;
  int i, d, age, best = 0;
  for (i = 0; i < P->of->count; ++i) {
    if (P->of->group[i] != group) continue;
    for (age = 0; age < P->count; ++age)
      differences[age] = P->history[i][(P->newest + KEPT - age) % KEPT];
    for (d = 0; d < degrees; ++d) {
      const int remaining = P->count - d - 1;
      for (age = 0; age < remaining; ++age) differences[age] -= differences[age + 1];
      for (age = 0; age < remaining && age < JUDGED; ++age)
        largest_difference[d] = largest_of(largest_difference[d], fabs(differences[age]));
    }
  }
  if (degrees == 0) return 0;
  for (d = 1; d < degrees; ++d)
    if (largest_difference[d] < largest_difference[best]) best = d;
  return best == degrees - 1 && best < DEGREES ? best + 1 : best;
}

static void record(struct predictor *P, const double *y) {
  int i, group, age;
  P->newest = (P->newest + 1) % KEPT;
  for (i = 0; i < P->of->count; ++i) P->history[i][P->newest] = y[P->of->at[i]];
  if (P->count == 0) P->steps_to_choice = 0;
  if (P->count < KEPT) ++P->count;
  if (--P->steps_to_choice > 0) return;
  for (group = 0; group < 2; ++group) {
    const int degree = best_degree(P, group);
    double *const weights = P->weights[group], binomial = 1.0;
    for (i = 0; i < 2 * KEPT; ++i) weights[i] = 0.0;
    for (age = 0; age <= degree; ++age) {
      binomial *= (double)(degree + 1 - age) / (age + 1);
      weights[KEPT - age] = age % 2 == 0 ? binomial : -binomial;
      weights[(2 * KEPT - age) % (2 * KEPT)] = weights[KEPT - age];
    }
  }
  P->steps_to_choice = P->count < KEPT ? 1 : STEPS_BETWEEN_CHOICES;
}

