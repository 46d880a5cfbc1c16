/* ---- prediction ---------------------------------------------------------------------------------------- */

enum { KEPT = 12, DEGREES = 8, ALTERNATING_ORDERS = 4, JUDGED = 3, STEPS_BETWEEN_CHOICES = 64 };

/* Places in y, each in one of two groups. */
struct places {
  int count;
  const int *at, *group;
};

/* A polynomial of degree order - 1 through the last unknowns, or through every second one. */
struct rule {
  int order, spacing;
};

/* The next unknowns by extrapolation of the last ones, for each group of them by the rule that would have
   been best for the last steps. The parts of a step are near each other in time: predictions are corrected by what
   those of two others were wrong by, as long as it would have made the last one better. */
struct predictor {
  const struct places *of;
  int newest, count, steps_to_choice;
  double history[KEPT][MOST_PREDICTED + 1]; /* a ring */
  double weights[2][DEGREES + 1]; /* of the rule */
  struct rule rule[2];
  int is_uncorrected[2];
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
    P->rule[i].order = P->rule[i].spacing = 1;
    P->companion[i] = before.companion[i];
    memcpy(P->times[i], before.times[i], sizeof P->times[i]);
  }
}

/* Those that were recorded so many steps ago. */
static const double *recorded(const struct predictor *P, int age) {
  return P->history[(P->newest + KEPT - age) % KEPT];
}

/* What those of P that were recorded so many steps ago, and before, tell of the next unknown i by the rule. The oldest
   come first. */
static double extrapolated(const struct predictor *P, int i, int age, const double *weights, const struct rule *rule) {
  int j = rule->order - 1;
  double sum = weights[j] * recorded(P, age + (j + 1) * rule->spacing - 1)[i];
  while (--j >= 0) sum += weights[j] * recorded(P, age + (j + 1) * rule->spacing - 1)[i];
  return sum;
}

/* Those of `displacements` go like steps, which have this ratio, and those of the last `multipliers` unknowns like their
   squares. */
static void accompany(struct predictor *P, int c, const struct predictor *other, const struct places *of,
                      double times, double ratio, int displacements, int multipliers, int unknowns) {
  int i;
  P->companion[c] = other;
  for (i = 0; i < of->count; ++i) {
    P->times[c][i] = times;
    if (of->at[i] < displacements) P->times[c][i] *= ratio;
    if (of->at[i] >= unknowns - multipliers) P->times[c][i] *= ratio * ratio;
  }
}

/* Where a companion cannot tell yet nothing is corrected. */
static void correct(struct predictor *P, int group) {
  int i, c;
  for (i = 0; i < P->of->count; ++i)
    if (P->of->group[i] == group) P->corrections[i] = 0.0;
  for (c = 0; c < 2; ++c)
    if (P->companion[c]->count < P->rule[group].order * P->rule[group].spacing + 1) return;
  for (c = 0; c < 2; ++c) {
    const struct predictor *const of = P->companion[c];
    for (i = 0; i < P->of->count; ++i)
      if (P->of->group[i] == group)
        P->corrections[i] += P->times[c][i] * (recorded(of, 0)[i] -
                                               extrapolated(of, i, 1, P->weights[group], &P->rule[group]));
  }
}

static void predict(struct predictor *P, double *y) {
  int i, group;
  for (i = 0; i < P->of->count; ++i) {
    group = P->of->group[i];
    y[P->of->at[i]] = extrapolated(P, i, 0, P->weights[group], &P->rule[group]);
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

/* What the rule would have been wrong by, for the newest unknowns. */
static double largest_error(const struct predictor *P, int group, int order, int spacing) {
  const int judged = P->count - order * spacing < JUDGED ? P->count - order * spacing : JUDGED;
  double largest = 0.0, differences[KEPT];
  int i, age, power;
  for (i = 0; i < P->of->count; ++i) {
    if (P->of->group[i] != group) continue;
    for (age = 0; age < order * spacing + judged; ++age) differences[age] = recorded(P, age)[i];
    for (power = 1; power <= order; ++power)
      for (age = 0; age < (order - power) * spacing + judged; ++age) differences[age] -= differences[age + spacing];
    for (age = 0; age < judged; ++age) largest = largest_of(largest, fabs(differences[age]));
  }
  return largest;
}

static struct rule best_rule(const struct predictor *P, int group) {
  const int most = P->count - 1 < DEGREES + 1 ? P->count - 1 : DEGREES + 1;
  struct rule best = {1, 1};
  double least, error;
  int order;
  if (most == 0) return best;
  least = largest_error(P, group, 1, 1);
  for (order = 2; order <= most; ++order) {
    error = largest_error(P, group, order, 1);
    if (error < least) {
      best.order = order;
      least = error;
    }
  }
  least *= 0.25;
  for (order = 1; order <= ALTERNATING_ORDERS && 2 * order + JUDGED <= P->count; ++order) {
    error = largest_error(P, group, order, 2);
    if (error < least) {
      best.order = order;
      best.spacing = 2;
      least = error;
    }
  }
  if (best.spacing == 1 && best.order == most && best.order < DEGREES + 1) ++best.order;
  return best;
}

static void record(struct predictor *P, const double *y) {
  int i, group;
  if (P->has_predicted) judge(P, y);
  P->has_predicted = 0;
  P->newest = (P->newest + 1) % KEPT;
  for (i = 0; i < P->of->count; ++i) P->history[P->newest][i] = y[P->of->at[i]];
  if (P->count == 0) P->steps_to_choice = 0;
  if (P->count < KEPT) ++P->count;
  if (--P->steps_to_choice > 0) return;
  for (group = 0; group < 2; ++group) {
    const struct rule rule = best_rule(P, group);
    double *const weights = P->weights[group], binomial = 1.0;
    P->rule[group] = rule;
    for (i = 0; i < rule.order; ++i) {
      binomial *= (double)(rule.order - i) / (i + 1);
      weights[i] = i % 2 == 0 ? binomial : -binomial;
    }
  }
  P->steps_to_choice = P->count < KEPT ? 1 : STEPS_BETWEEN_CHOICES;
}

