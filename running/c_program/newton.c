/* ---- equations and Newton's method --------------------------------------------------------------------- */

/* (in[0], in[1], ...) -> out */
typedef void map(const double *const *in, double *out);

/* G(u; p) = 0, for those unknowns u of y that are kept; the others are given by u. */
struct equations {
  int size;             /* equations, and unknowns that they contain */
  int kept;             /* unknowns */
  int groups;           /* of unknowns that are measured by one scale */
  int entries;          /* of the Jacobian */
  int exponentials;     /* in G, by what they are of */
  int matrix_numbers;   /* that dG/du is made of; -1 unless G is affine and they are parameters */
  const int *kept_at;   /* places in y */
  const int *contained; /* places in u of the unknowns that the equations contain */
  const int *group;     /* of each of u */
  const int *row, *column, *contained_column; /* of each entry, in u and among those that are contained */
  const int *matrix_of; /* groups of those numbers, one in each */
  map *value, *value_and_jacobian;
  map *unknowns;  /* u; p -> y, or NULL where all are kept */
  map *arguments; /* u; p -> what exponentials are of, or NULL where there are none */
};

/* Simplified Newton: u <- u - A G(u), A the inverse of an earlier Jacobian as long as it contracts well. */
struct newton {
  const struct equations *of;
  int is_factorized, factorizations;
  double round_off; /* by how much iterates moved when they stalled with a new factorisation */
  double u[MOST_UNKNOWNS];
  double all[MOST_SIZE + MOST_ENTRIES]; /* G and the entries of its Jacobian */
  double change[MOST_SIZE];
  double moved[MOST_SIZE]; /* of each group that the equations contain unknowns of: the largest change, relative to its size */
  double before[MOST_SIZE]; /* the change before, until this solve taught something */
  double of_matrix[INPUTS]; /* the numbers that it is made of, where G is affine */
  double at_matrix[MOST_ARGUMENTS]; /* of exponentials, where the Jacobian is that of */
  double inverse[MOST_SIZE * MOST_SIZE]; /* column by column */
};

static double largest_of(double a, double b) { return a < b ? b : a; }

static double largest(const double *x, int count) {
  double result = 0.0;
  int i;
  for (i = 0; i < count; ++i) result = largest_of(result, fabs(x[i]));
  return result;
}

static __attribute__((unused)) void forget_matrix(struct newton *N) {
  N->is_factorized = 0;
  N->round_off = 0.0;
}

/* Divides a scale by a power of two near the size that it led to. */
static double scaled_to_one(double size, double scale) {
  return size > 0.0 ? ldexp(scale, -ilogb(size)) : scale;
}

static void exchange(double *x, int i, int j) {
  const double number = x[i];
  x[i] = x[j];
  x[j] = number;
}

/* P S = L U in place, with the same exchanges in the rows of X. The ratio of the least pivot to the largest. */
static double factor(double *S, double *X, int n, int columns) {
  double least = INFINITY, most = 0.0;
  int i, j, k, pivot;
  for (k = 0; k < n; ++k) {
    pivot = k;
    for (i = k + 1; i < n; ++i)
      if (fabs(S[i + k * n]) > fabs(S[pivot + k * n])) pivot = i;
    if (S[pivot + k * n] == 0.0) return 0.0;
    for (j = 0; pivot != k && j < n; ++j) exchange(S + j * n, k, pivot);
    for (j = 0; pivot != k && j < columns; ++j) exchange(X + j * n, k, pivot);
    for (i = k + 1; i < n; ++i) S[i + k * n] /= S[k + k * n];
    for (j = k + 1; j < n; ++j)
      for (i = k + 1; i < n; ++i) S[i + j * n] -= S[i + k * n] * S[k + j * n];
    least = fabs(S[k + k * n]) < least ? fabs(S[k + k * n]) : least;
    most = largest_of(most, fabs(S[k + k * n]));
  }
  return n > 0 ? least / most : 1.0;
}

/* X <- U^-1 L^-1 X */
static void substitute(const double *LU, double *X, int n, int columns) {
  int i, j, k;
  for (j = 0; j < columns; ++j) {
    double *const x = X + j * n;
    for (k = 0; k < n; ++k)
      for (i = k + 1; i < n; ++i) x[i] -= LU[i + k * n] * x[k];
    for (k = n - 1; k >= 0; --k) {
      x[k] /= LU[k + k * n];
      for (i = 0; i < k; ++i) x[i] -= LU[i + k * n] * x[k];
    }
  }
}

/* S = diag(row) A diag(column), with rows and columns of comparable size. */
static void equilibrate(const double *A, double *S, double *row, double *column, int n) {
  int i, j, k, sweep;
  for (i = 0; i < n; ++i) row[i] = column[i] = 1.0;
  for (k = 0; k < n * n; ++k) S[k] = A[k];
  for (sweep = 0; sweep < 2; ++sweep) {
    for (j = 0; j < n; ++j) column[j] = scaled_to_one(largest(S + j * n, n), column[j]);
    for (i = 0; i < n; ++i) {
      double size = 0.0;
      for (j = 0; j < n; ++j) size = largest_of(size, fabs(row[i] * (A[i + j * n] * column[j])));
      row[i] = scaled_to_one(size, row[i]);
    }
    for (j = 0; j < n; ++j)
      for (i = 0; i < n; ++i) S[i + j * n] = row[i] * A[i + j * n] * column[j];
  }
}

/* Sizes of the entries of a matrix of n rows and columns, and logarithms of the scales of both, rows first. An entry that is
   none, or is left out, has the size -INFINITY. */
static double scaled_size(const double *sizes, const double *exponent, int n, int i, int j) {
  return sizes[i + j * n] + exponent[i] + exponent[n + j];
}

/* Brings every row and column maximum to 1. */
static void level_maxima(const double *sizes, double *exponent, double *most, int n) {
  int i, j, k, sweep;
  for (sweep = 0; sweep < 8; ++sweep) {
    for (k = 0; k < 2 * n; ++k) most[k] = -INFINITY;
    for (j = 0; j < n; ++j)
      for (i = 0; i < n; ++i) {
        const double size = scaled_size(sizes, exponent, n, i, j);
        most[i] = largest_of(most[i], size);
        most[n + j] = largest_of(most[n + j], size);
      }
    for (k = 0; k < 2 * n; ++k) exponent[k] -= 0.5 * (isfinite(most[k]) ? most[k] : 0.0);
  }
}

/* In two parts, even places and odd ones. */
static double dot(const double *a, const double *b, int n) {
  double even = 0.0, odd = 0.0;
  int i;
  for (i = 0; i + 1 < n; i += 2) {
    even += a[i] * b[i];
    odd += a[i + 1] * b[i + 1];
  }
  if (i < n) even += a[i] * b[i];
  return even + odd;
}

/* The least squares problem of Curtis and Reid by conjugate gradients. space: 12 n numbers. */
static void level_sizes(const double *sizes, double *exponent, double *space, int n) {
  const int both = 2 * n;
  double *const count = space, *const residual = count + both, *const step = residual + both,
         *const direction = step + both, *const image = direction + both, *const weighted = image + both;
  double previous = 1.0, current, length;
  int i, j, k, iteration;
  for (k = 0; k < both; ++k) count[k] = residual[k] = step[k] = direction[k] = 0.0;
  for (j = 0; j < n; ++j)
    for (i = 0; i < n; ++i) {
      const double size = scaled_size(sizes, exponent, n, i, j);
      if (!isfinite(size)) continue;
      count[i] += 1.0;
      residual[i] -= size;
      count[n + j] += 1.0;
      residual[n + j] -= size;
    }
  for (k = 0; k < both; ++k) count[k] = largest_of(count[k], 1.0);
  for (iteration = 0; iteration < 300; ++iteration) {
    for (k = 0; k < both; ++k) weighted[k] = residual[k] / count[k];
    if (largest(weighted, both) < 0.05) break;
    current = dot(residual, weighted, both);
    for (k = 0; k < both; ++k) direction[k] = weighted[k] + (current / previous) * direction[k];
    for (k = 0; k < both; ++k) image[k] = 0.0;
    for (j = 0; j < n; ++j)
      for (i = 0; i < n; ++i)
        if (isfinite(sizes[i + j * n])) {
          const double sum = direction[i] + direction[n + j];
          image[i] += sum;
          image[n + j] += sum;
        }
    length = current / dot(direction, image, both);
    for (k = 0; k < both; ++k) step[k] += length * direction[k];
    for (k = 0; k < both; ++k) residual[k] -= length * image[k];
    previous = current;
  }
  for (k = 0; k < both; ++k) exponent[k] += step[k];
}

static double power_of_two(double exponent) {
  const double whole = round(exponent);
  return exp2(whole < -1022.0 ? -1022.0 : whole > 1022.0 ? 1022.0 : whole);
}

/* The same for entries that are far apart: all of them, but those below 1e-14 of the largest of their row and column, are brought
   near to 1. */
static void equilibrate_sizes(const double *A, double *S, double *row, double *column, int n) {
  static double sizes[MOST_FACTORS], exponent[2 * MOST_FACTORED], space[12 * MOST_FACTORED];
  int i, j, k;
  for (k = 0; k < n * n; ++k) sizes[k] = fabs(A[k]) >= DBL_MIN ? log2(fabs(A[k])) : -INFINITY;
  for (k = 0; k < 2 * n; ++k) exponent[k] = 0.0;
  level_maxima(sizes, exponent, space, n);
  for (j = 0; j < n; ++j)
    for (i = 0; i < n; ++i)
      if (scaled_size(sizes, exponent, n, i, j) <= log2(1e-14)) sizes[i + j * n] = -INFINITY;
  level_sizes(sizes, exponent, space, n);
  level_maxima(sizes, exponent, space, n);
  for (i = 0; i < n; ++i) {
    row[i] = power_of_two(exponent[i]);
    column[i] = power_of_two(exponent[n + i]);
  }
  for (j = 0; j < n; ++j)
    for (i = 0; i < n; ++i) S[i + j * n] = isfinite(sizes[i + j * n]) ? A[i + j * n] * row[i] * column[j] : 0.0;
}

/* The last columns of the inverse of A into X. Zero if A is singular. */
static int invert(const double *A, double *X, int n, int columns) {
  static double S[MOST_FACTORS];
  double row[MOST_FACTORED], column[MOST_FACTORED];
  int i, j, k, is_regular = 0, way;
  for (way = 0; !is_regular && way < 2; ++way) {
    (way == 0 ? equilibrate : equilibrate_sizes)(A, S, row, column, n);
    for (k = 0; k < n * columns; ++k) X[k] = 0.0;
    for (j = 0; j < columns; ++j) X[n - columns + j + j * n] = 1.0;
    is_regular = factor(S, X, n, columns) > (way == 0 ? 1e-7 : 1e-13);
  }
  if (!is_regular) return 0;
  substitute(S, X, n, columns);
  for (j = 0; j < columns; ++j)
    for (i = 0; i < n; ++i) {
      X[i + j * n] = column[i] * X[i + j * n] * row[n - columns + j];
      if (!isfinite(X[i + j * n])) return 0;
    }
  return 1;
}

/* The inverse of the Jacobian. Zero if it is singular, or nearly so. */
static int factorize(struct newton *N, const double *const *in) {
  static double A[MOST_SIZE * MOST_SIZE];
  const int n = N->of->size;
  int k;
  ++N->factorizations;
  N->is_factorized = 0;
  N->of->value_and_jacobian(in, N->all);
  if (N->of->exponentials > 0) N->of->arguments(in, N->at_matrix);
  for (k = 0; k < N->of->matrix_numbers; ++k) N->of_matrix[k] = *in[N->of->matrix_of[k]];
  for (k = 0; k < n * n; ++k) A[k] = 0.0;
  for (k = 0; k < N->of->entries; ++k) {
    if (!isfinite(N->all[n + k])) return 0;
    A[N->of->row[k] + N->of->contained_column[k] * n] = N->all[n + k];
  }
  return N->is_factorized = invert(A, N->inverse, n, n);
}

/* x = A b, column by column; up to eight columns in two parts, even ones and odd ones. */
static void multiply(const double *A, const double *b, double *x, int n) {
  int i, j;
  for (i = 0; i < n; ++i) {
    double even = 0.0, odd = 0.0;
    if (n > 8) {
      for (j = 0; j < n; ++j) even += A[i + j * n] * b[j];
      x[i] = even;
      continue;
    }
    even = A[i] * b[0];
    if (n > 1) odd = A[i + n] * b[1];
    for (j = 2; j < n; ++j) *(j % 2 == 0 ? &even : &odd) += A[i + j * n] * b[j];
    x[i] = n > 1 ? even + odd : even;
  }
}

/* u <- u - A G. The largest change of a group relative to its scale; and of several groups that move by more than
   round-off, the contraction of the one that contracts worst. */
static double improve(struct newton *N, const double *scales, double *slowest) {
  const struct equations *const of = N->of;
  const int n = of->size;
  double result = 0.0, total = 0.0;
  int g, i = 0, group = 0;
  *slowest = 0.0;
  multiply(N->inverse, N->all, N->change, n);
  for (g = 0, i = 0; g < of->groups; ++g) {
    double moved = 0.0, size = scales[g];
    const int begin = i;
    for (; i < n && of->group[of->contained[i]] == g; ++i) {
      double *const unknown = N->u + of->contained[i];
      const double change = fabs(N->change[i]);
      *unknown -= N->change[i];
      moved = largest_of(moved, change);
      size = largest_of(size, fabs(*unknown));
      total += change;
    }
    if (i == begin) continue;
    if (moved > 0.0) moved = size > 0.0 ? moved / size : 1.0;
    if (moved > 2.0 * DBL_EPSILON && i - begin < n) *slowest = largest_of(*slowest, moved / N->moved[group]);
    N->moved[group++] = moved;
    result = largest_of(result, moved);
  }
  return isfinite(total) ? result : INFINITY;
}

/* The inverse learns from two changes s and r that it made, so that A (G(u) - G(u - s)) = s (Broyden): A <- A
   + r (s^T W A) / (s^T W (s - r)), with the sizes of groups for units. */
static void learn(struct newton *N, const double *scales) {
  const struct equations *const of = N->of;
  const int n = of->size;
  double weighted[MOST_SIZE], length, along, factor;
  int g, i = 0, j;
  for (g = 0; g < of->groups; ++g) {
    double size = scales[g];
    const int begin = i;
    for (; i < n && of->group[of->contained[i]] == g; ++i)
      size = largest_of(size, fabs(N->u[of->contained[i]]));
    for (j = begin; j < i; ++j) weighted[j] = size > 0.0 ? N->before[j] * (1.0 / size) * (1.0 / size) : 0.0;
  }
  length = dot(weighted, N->before, n);
  along = dot(weighted, N->change, n);
  if (!(fabs(along) <= 0.5 * length && length > 0.0 && isfinite(length))) return;
  factor = 1.0 / (length - along);
  for (j = 0; j < n; ++j) {
    double *const column = N->inverse + j * n;
    const double part = dot(weighted, column, n) * factor;
    for (i = 0; i < n; ++i) column[i] += N->change[i] * part;
  }
}

/* The terms J_ij u_j of each residual. */
static void terms(const struct newton *N, const double *scales, double *magnitude) {
  const struct equations *const of = N->of;
  int i, k;
  for (i = 0; i < of->size; ++i) magnitude[i] = 0.0;
  for (k = 0; k < of->entries; ++k) {
    const double scale = scales[of->group[of->column[k]]];
    const double size = largest_of(fabs(N->u[of->column[k]]), scales[0] < scale ? scales[0] : scale);
    magnitude[of->row[k]] += fabs(N->all[of->size + k]) * size;
  }
}

/* The largest part that a residual is of these. */
static double largest_part(const struct newton *N, const double *magnitude) {
  double result = 0.0;
  int i;
  for (i = 0; i < N->of->size; ++i)
    if (!(fabs(N->all[i]) <= result * magnitude[i])) result = fabs(N->all[i]) / magnitude[i];
  return result;
}

static double unsolved_part(const struct newton *N, const double *scales) {
  double magnitude[MOST_SIZE];
  terms(N, scales, magnitude);
  return largest_part(N, magnitude);
}

/* Whether the last change left the arguments of exponentials where they were, by a matrix that was made near
   there, or the equations hold next to their terms, by the matrix at u. */
static int is_settled(struct newton *N, const double *const *in, int fresh) {
  const struct equations *const of = N->of;
  double now[MOST_ARGUMENTS], before[MOST_ARGUMENTS], last[MOST_UNKNOWNS], change = 0.0, away = 0.0;
  double magnitude[MOST_SIZE];
  const double *at_last[INPUTS];
  int i, k;
  if (of->exponentials == 0) return 1;
  for (i = 1; i < INPUTS; ++i) at_last[i] = in[i];
  at_last[0] = last;
  for (i = 0; i < of->kept; ++i) last[i] = N->u[i];
  for (i = 0; i < of->size; ++i) last[of->contained[i]] += N->change[i];
  of->arguments(in, now);
  of->arguments(at_last, before);
  for (i = 0; i < of->exponentials; ++i) {
    /* Below -30 exponentials are nothing. */
    const double at = largest_of(now[i], -30.0);
    change = largest_of(change, fabs(at - largest_of(before[i], -30.0)));
    away = largest_of(away, fabs(at - largest_of(N->at_matrix[i], -30.0)));
  }
  if (away <= 1.0 && change * largest_of(change, away) <= 1e-13) return 1;
  if (!fresh) return 0;
  of->value_and_jacobian(in, N->all);
  for (i = 0; i < of->size; ++i) magnitude[i] = 0.0;
  for (k = 0; k < of->entries; ++k)
    magnitude[of->row[k]] += fabs(N->all[of->size + k] * N->u[of->column[k]]);
  return largest_part(N, magnitude) <= 2e-14;
}

/* Whether A is the inverse of the matrix of affine equations. */
static int is_exact(const struct newton *N, const double *const *in) {
  int k;
  for (k = 0; k < N->of->matrix_numbers; ++k)
    if (*in[N->of->matrix_of[k]] != N->of_matrix[k]) return 0;
  return N->of->matrix_numbers >= 0;
}

/* Iterates to round-off: until changes are so small, or contract so well, that nothing is left, or until they
   only move by round-off. Zero if that fails. */
static int iterate(struct newton *N, const double *const *in, const double *scales) {
  const double tolerance = 1e-17, round_off = 1e-9, brief = 1e-4;
  double previous = INFINITY, contraction, slowest, moved = INFINITY;
  int iteration, i, exact, learned = 0, compared = 0;
  int fresh = 0; /* A belongs to a point of this solve */
  int close = 0; /* which a short change led to */
  double unsolved = -1.0, first[MOST_SIZE]; /* where changes stalled before, and first */
  int evaluated = 0; /* G is that of u */
  if (!N->is_factorized) {
    fresh = evaluated = 1;
    if (!factorize(N, in)) return 0;
  }
  exact = is_exact(N, in);
  for (iteration = 0; iteration < 60; ++iteration) {
    if (!evaluated) N->of->value(in, N->all);
    evaluated = 0;
    moved = improve(N, scales, &slowest);
    if (!isfinite(moved)) return 0;
    if (moved <= tolerance) {
      if (is_settled(N, in, fresh)) return 1;
      fresh = evaluated = 1;
      close = moved <= brief;
      compared = 0;
      if (!factorize(N, in)) return 0;
      continue;
    }
    /* What affine equations are left with after a short change is nothing next to the rounding of their residual. */
    if (exact && compared == 0 && moved <= 1e-3) return 1;
    if (compared > 0) {
      int stalled, stagnant, rounded, slow, still;
      contraction = moved / previous;
      if (moved < 0.5 * previous && previous <= 1e-2 &&
          largest_of(moved, previous * previous) * moved <= (previous - moved) * tolerance &&
          slowest * moved <= (1.0 - slowest) * tolerance &&
          is_settled(N, in, fresh))
        return 1;
      stalled = contraction > 0.5;
      stagnant = fresh && compared == 1 && contraction > 0.9 && moved <= brief;
      rounded = stalled && (moved > round_off
                                ? stagnant || unsolved_part(N, scales) <= 16.0 * DBL_EPSILON
                                : close || moved <= largest_of(2.0 * DBL_EPSILON, 2 * N->round_off));
      slow = contraction > 0.2 && moved > 1e3 * tolerance;
      still = 1;
      if (rounded && !(slow && !fresh)) {
        /* Down the flank of an exponential steps are as small and as equal, but residuals fall. */
        double part = unsolved_part(N, scales);
        still = part <= 1e-9;
        if (!still) {
          if (unsolved < 0.0)
            terms(N, scales, first);
          else
            part = largest_part(N, first);
          still = unsolved >= 0.0 && !(part < 0.5 * unsolved);
          unsolved = part;
        }
        if (still) still = is_settled(N, in, fresh);
      }
      if ((slow && !fresh) || (stalled && !rounded) || !still) {
        fresh = evaluated = 1;
        close = moved <= brief;
        compared = 0;
        if (!factorize(N, in)) return 0;
        continue;
      }
      if (rounded) {
        N->round_off = close && moved <= round_off ? moved : 0.998 * N->round_off;
        return 1;
      }
    }
    if (N->of->exponentials == 0 && !learned) {
      learned = compared > 0 && previous > 1e-12 && moved > 0.01 * previous;
      if (learned)
        learn(N, scales);
      else
        for (i = 0; i < N->of->size; ++i) N->before[i] = N->change[i];
    }
    previous = moved;
    ++compared;
  }
  return 0;
}

/* in[0] is y, which holds what the iteration begins with, and in the end the solution. */
static __attribute__((unused)) int solve(struct newton *N, double *y, const double *const *in, const double *scales) {
  const double *of_kept[INPUTS];
  int i, converged;
  for (i = 1; i < INPUTS; ++i) of_kept[i] = in[i];
  of_kept[0] = N->u;
  for (i = 0; i < N->of->kept; ++i) N->u[i] = y[N->of->kept_at[i]];
  N->factorizations = 0;
  converged = iterate(N, of_kept, scales);
  if (N->of->unknowns != NULL)
    N->of->unknowns(of_kept, y);
  else
    for (i = 0; i < N->of->kept; ++i) y[N->of->kept_at[i]] = N->u[i];
  return converged;
}

