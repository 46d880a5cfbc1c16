/* ---- prediction ---------------------------------------------------------------------------------------- */

enum { KEPT = 12, DEGREES = 8, JUDGED = 3, STEPS_BETWEEN_CHOICES = 32 };

/* Places in y, each in one of two groups. */
struct places {
  int count;
  const int *at, *group;
};

/* The next unknowns by extrapolation of the last ones, for each group of them by the polynomial that would have
   been best for the last steps. The parts of a step are near each other in time: predictions are corrected by what
   those of two others were wrong by, as long as it would have made the last one better. */
struct predictor {
  const struct places *of;
  int newest, count, steps_to_choice;
  double history[KEPT][MOST_PREDICTED + 1]; /* a ring */
  double weights[2][DEGREES + 1]; /* of unknowns so many steps old */
  int degree[2], is_uncorrected[2];
  const struct predictor *companion[2]; /* or NULL */
  double times[2][MOST_PREDICTED + 1];
  double extrapolated[MOST_PREDICTED + 1], corrections[MOST_PREDICTED + 1]; /* of the last prediction */
  int has_predicted;
};

static void forget_steps(struct predictor *P, const struct places *of) {
  const struct predictor before = *P;
  int i;
  memset(P, 0, sizeof *P);
  P->of = of;
  for (i = 0; i < 2; ++i) {
    P->companion[i] = before.companion[i];
    memcpy(P->times[i], before.times[i], sizeof P->times[i]);
  }
}

/* Those that were recorded so many steps ago. */
static const double *recorded(const struct predictor *P, int age) {
  return P->history[(P->newest + KEPT - age) % KEPT];
}

/* What those of P that were recorded so many steps ago, and before, tell of the next unknown i. */
static double extrapolated(const struct predictor *P, int i, int age, const double *weights, int degree) {
  double sum = weights[0] * recorded(P, age)[i];
  int j;
  for (j = 1; j <= degree; ++j) sum += weights[j] * recorded(P, age + j)[i];
  return sum;
}

/* Those of `displacements` go like steps, which have this ratio, and those of the last `shifts` unknowns like their
   squares. */
static void accompany(struct predictor *P, int c, const struct predictor *other, const struct places *of,
                      double times, double ratio, int displacements, int shifts, int unknowns) {
  int i;
  P->companion[c] = other;
  for (i = 0; i < of->count; ++i) {
    P->times[c][i] = times;
    if (of->at[i] < displacements) P->times[c][i] *= ratio;
    if (of->at[i] >= unknowns - shifts) P->times[c][i] *= ratio * ratio;
  }
}

/* Where a companion cannot tell yet nothing is corrected. */
static void correct(struct predictor *P, int group) {
  int i, c;
  for (i = 0; i < P->of->count; ++i)
    if (P->of->group[i] == group) P->corrections[i] = 0.0;
  for (c = 0; c < 2; ++c)
    if (P->companion[c]->count < P->degree[group] + 2) return;
  for (c = 0; c < 2; ++c) {
    const struct predictor *const of = P->companion[c];
    for (i = 0; i < P->of->count; ++i)
      if (P->of->group[i] == group)
        P->corrections[i] += P->times[c][i] * (recorded(of, 0)[i] -
                                               extrapolated(of, i, 1, P->weights[group], P->degree[group]));
  }
}

static void predict(struct predictor *P, double *y) {
  int i, group;
  for (i = 0; i < P->of->count; ++i) {
    group = P->of->group[i];
    y[P->of->at[i]] = extrapolated(P, i, 0, P->weights[group], P->degree[group]);
  }
  if (P->companion[0] == NULL) return;
  for (group = 0; group < 2; ++group) correct(P, group);
  for (i = 0; i < P->of->count; ++i) {
    double *const predicted = y + P->of->at[i];
    P->extrapolated[i] = *predicted;
    if (!P->is_uncorrected[P->of->group[i]]) *predicted += P->corrections[i];
  }
  P->has_predicted = 1;
}

static void judge(struct predictor *P, const double *y) {
  double plain[2] = {0.0, 0.0}, corrected[2] = {0.0, 0.0};
  int i, group;
  for (i = 0; i < P->of->count; ++i) {
    const double error = y[P->of->at[i]] - P->extrapolated[i];
    group = P->of->group[i];
    plain[group] = largest_of(plain[group], fabs(error));
    corrected[group] = largest_of(corrected[group], fabs(error - P->corrections[i]));
  }
  for (group = 0; group < 2; ++group) P->is_uncorrected[group] = !(corrected[group] <= plain[group]);
}

static int best_degree(const struct predictor *P, int group) {
  double largest_difference[DEGREES + 1] = {0}, differences[KEPT];
  const int degrees = P->count - 1 < DEGREES + 1 ? P->count - 1 : DEGREES + 1;
  int i, d, age, best = 0;
  for (i = 0; i < P->of->count; ++i) {
    if (P->of->group[i] != group) continue;
    for (age = 0; age < P->count; ++age)
      differences[age] = recorded(P, age)[i];
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
  if (P->has_predicted) judge(P, y);
  P->has_predicted = 0;
  P->newest = (P->newest + 1) % KEPT;
  for (i = 0; i < P->of->count; ++i) P->history[P->newest][i] = y[P->of->at[i]];
  if (P->count == 0) P->steps_to_choice = 0;
  if (P->count < KEPT) ++P->count;
  if (--P->steps_to_choice > 0) return;
  for (group = 0; group < 2; ++group) {
    const int degree = best_degree(P, group);
    double *const weights = P->weights[group], binomial = 1.0;
    P->degree[group] = degree;
    for (age = 0; age <= degree; ++age) {
      binomial *= (double)(degree + 1 - age) / (age + 1);
      weights[age] = age % 2 == 0 ? binomial : -binomial;
    }
  }
  P->steps_to_choice = P->count < KEPT ? 1 : STEPS_BETWEEN_CHOICES;
}

