/* ---- the run ------------------------------------------------------------------------------------------- */

static void write_row(double t, const double *row) {
  int i;
  write_number(t);
  for (i = 0; i < COLUMNS; ++i) {
    putchar(',');
    write_number(row[i]);
  }
  putchar('\n');
}

int main(void) {
  struct state state = first;
  puts(heading);
  begin_epoch(&state);
  write_row(start_time, begin_rows(&state));
  for (step_number = 1; step_number <= STEPS; ++step_number) {
    const double t = start_time + (double)step_number * step_size;
    const double *row;
    if (step_number > 1 && (step_number - 1) % EPOCH == 0) {
      begin_rows_again(&state);
      begin_epoch(&state);
    }
    step(&state, step_size, t);
    row = next_row(&state);
    if (step_number % EVERY == 0 || step_number == STEPS) write_row(t, row);
  }
  if (fflush(stdout) != 0 || ferror(stdout)) {
    fputs("the rows cannot be written\n", stderr);
    return 3;
  }
  return 0;
}
