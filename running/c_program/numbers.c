/* ---- numbers as text ---------------------------------------------------------------------------------- */

static void fail(const char *what) {
  fflush(stdout);
  fprintf(stderr, "step %ld %s: `courant run` may know another way\n", step_number, what);
  exit(3);
}

/* Adds one to the last digit of d.ddde±xx. Zero if that has no room. */
static int count_up(char *text) {
  char *digit = strchr(text, 'e') - 1;
  while (*digit == '9' || *digit == '.') {
    if (digit == text) return 0;
    if (*digit == '9') *digit = '0';
    --digit;
  }
  if (digit < text) return 0;
  ++*digit;
  return 1;
}

/* The fewest digits that read back to the same double, with an exponent where that is shorter. Below a power
   of two doubles are denser: there the digits that are rounded best may need one more than others. */
static void write_number(double value) {
  char text[40], digits[20];
  int count, exponent, binary_exponent, i, k = 0;
  if (isnan(value)) {
    fputs(signbit(value) ? "-nan" : "nan", stdout);
    return;
  }
  if (signbit(value)) putchar('-');
  value = fabs(value);
  if (isinf(value)) {
    fputs("inf", stdout);
    return;
  }
  if (value == 0.0) {
    putchar('0');
    return;
  }
  for (count = 1; count <= 17; ++count) {
    sprintf(text, "%.*e", count - 1, value);
    if (strtod(text, NULL) == value) break;
    if (frexp(value, &binary_exponent) == 0.5 && count_up(text) && strtod(text, NULL) == value) break;
  }
  exponent = atoi(strchr(text, 'e') + 1) - (count - 1); /* of the digits as an integer */
  if (exponent < -(count + 3) + (count == 1) || exponent > 5 - (count == 1)) {
    fputs(text, stdout);
    return;
  }
  if (exponent >= 0) {
    printf("%.0f", value);
    return;
  }
  for (i = 0; text[i] != 'e'; ++i)
    if (text[i] != '.') digits[k++] = text[i];
  if (count + exponent <= 0) fputs("0.", stdout);
  for (i = count + exponent; i < 0; ++i) putchar('0');
  for (i = 0; i < count; ++i) {
    if (i > 0 && i == count + exponent) putchar('.');
    putchar(digits[i]);
  }
}

