/* A run without events, wholly in C: consistent values by Newton's method, then SUNDIALS IDA from output to output.

   SUNDIALS is not linked: its functions come as addresses, out of the libraries of the binding, in the order of Api.
   Every run has memory of its own, so that nothing of an earlier one is in it. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifndef INDEX
#define INDEX int /* sunindextype */
#endif

typedef int (*Generated)(const double **arg, double **res, long long *iw, double *w, int mem);
typedef int (*ResFn)(double, void *, void *, void *, void *);
typedef int (*JacFn)(double, double, void *, void *, void *, void *, void *, void *, void *, void *);

typedef struct {
  int (*context_create)(int, void **);
  int (*context_clear)(void *);
  int (*context_free)(void **);
  void *(*vector)(INDEX, double *, void *);
  void (*vector_free)(void *);
  double *(*vector_data)(void *);
  void *(*matrix)(INDEX, INDEX, void *);
  double *(*matrix_data)(void *);
  void (*matrix_free)(void *);
  void *(*linear)(void *, void *, void *);
  int (*linear_free)(void *);
  void *(*create)(void *);
  int (*init)(void *, ResFn, double, void *, void *);
  int (*tolerances)(void *, double, void *);
  int (*set_linear)(void *, void *, void *);
  int (*set_jacobian)(void *, JacFn);
  int (*set_data)(void *, void *);
  int (*set_order)(void *, int);
  int (*set_steps)(void *, long);
  int (*set_stop)(void *, double);
  int (*solve)(void *, double, double *, void *, void *, int);
  int (*get_steps)(void *, long *);
  int (*get_rejected)(void *, long *);
  int (*get_residuals)(void *, long *);
  int (*get_jacobians)(void *, long *);
  void (*free)(void **);
} Api;

typedef struct {
  const Api *api;
  Generated residual, jacobian;
  long long n, entries;
  const long long *place; /* of each entry of the Jacobian in a dense matrix, column by column */
  const char *differential;
  const double *u, *z, *m, *atol;
  double rtol;
  long long order, max_steps;
  long long *iw;
  double *w;
} Problem;

typedef struct {
  const Problem *problem;
  const double *p;
  double *values; /* of the Jacobian's entries */
} Run;

static int evaluate(const Run *run, Generated f, double t, const double *y, const double *yp, const double *cj,
                    double *out) {
  const Problem *c = run->problem;
  const double *arg[16] = {&t, y, yp, run->p, c->u, c->z, c->m, cj};
  double *res[8] = {out};
  return f(arg, res, c->iw, c->w, 0);
}

static int residual(double t, void *y, void *yp, void *out, void *data) {
  const Run *run = data;
  const Api *api = run->problem->api;
  double *value = api->vector_data(out), sum = 0.0;
  evaluate(run, run->problem->residual, t, api->vector_data(y), api->vector_data(yp), NULL, value);
  for (long long i = 0; i < run->problem->n; ++i) sum += value[i] * value[i];
  return isfinite(sum) ? 0 : 1; /* 1: IDA tries a shorter step */
}

static void scatter(const Run *run, double *matrix) {
  const Problem *c = run->problem;
  memset(matrix, 0, sizeof(double) * c->n * c->n);
  for (long long k = 0; k < c->entries; ++k) matrix[c->place[k]] = run->values[k];
}

static int jacobian(double t, double cj, void *y, void *yp, void *r, void *matrix, void *data, void *a, void *b,
                    void *d) {
  const Run *run = data;
  const Api *api = run->problem->api;
  evaluate(run, run->problem->jacobian, t, api->vector_data(y), api->vector_data(yp), &cj, run->values);
  scatter(run, api->matrix_data(matrix));
  return 0;
}

/* Solve a x = b in place by elimination with the largest pivots; 1 where a is singular. */
static int solve(long long n, double *a, double *b) {
  for (long long k = 0; k < n; ++k) {
    long long best = k;
    for (long long i = k + 1; i < n; ++i)
      if (fabs(a[k * n + i]) > fabs(a[k * n + best])) best = i;
    if (!(fabs(a[k * n + best]) > 0.0)) return 1;
    if (best != k) {
      for (long long j = 0; j < n; ++j) {
        double kept = a[j * n + k];
        a[j * n + k] = a[j * n + best];
        a[j * n + best] = kept;
      }
      double kept = b[k];
      b[k] = b[best];
      b[best] = kept;
    }
    for (long long i = k + 1; i < n; ++i) {
      double part = a[k * n + i] / a[k * n + k];
      if (part == 0.0) continue;
      for (long long j = k + 1; j < n; ++j) a[j * n + i] -= part * a[j * n + k];
      b[i] -= part * b[k];
    }
  }
  for (long long k = n - 1; k >= 0; --k) {
    b[k] /= a[k * n + k];
    for (long long i = 0; i < k; ++i) b[i] -= a[k * n + i] * b[k];
  }
  return 0;
}

/* y' of states and algebraic y from the states: 0 where Newton's method converges. */
static int consistent(const Run *run, double t, double *y, double *yp, double *work) {
  const Problem *c = run->problem;
  long long n = c->n;
  double *matrix = work, *other = work + n * n, *step = work + 2 * n * n, zero = 0.0, one = 1.0, last = INFINITY;
  for (int iteration = 0; iteration < 20; ++iteration) {
    evaluate(run, c->residual, t, y, yp, NULL, step);
    evaluate(run, c->jacobian, t, y, yp, &zero, run->values);
    scatter(run, matrix);
    evaluate(run, c->jacobian, t, y, yp, &one, run->values);
    scatter(run, other);
    for (long long j = 0; j < n; ++j)
      if (c->differential[j])
        for (long long i = 0; i < n; ++i) matrix[j * n + i] = other[j * n + i] - matrix[j * n + i];
    if (solve(n, matrix, step)) return 1;
    double moved = 0.0, size = 0.0;
    for (long long j = 0; j < n; ++j) {
      double *x = c->differential[j] ? yp + j : y + j;
      *x -= step[j];
      moved += fabs(step[j]);
      size += fabs(*x);
    }
    if (!isfinite(moved)) return 1;
    if (moved <= 1e-10 * size && !(moved < 0.5 * last && moved > 1e-15 * size)) return 0;
    last = moved;
  }
  return 1;
}

/* Integrate to times[0..nt-1]; y and yp begin as guesses (states as they are) and hold the start at last; rows of
   out_y, out_yp are filled for each time. counts: steps, rejected, residuals, Jacobians. 0: all went well. */
static int integrate(const Problem *c, const double *p, double t0, const double *times, long long nt, double *y,
                     double *yp, double *out_y, double *out_yp, double *counts) {
  const Api *api = c->api;
  long long n = c->n;
  double *work = malloc(sizeof(double) * (2 * n * n + n + c->entries));
  void *context = NULL, *mem = NULL, *linear = NULL, *matrix = NULL, *vy = NULL, *vyp = NULL, *va = NULL;
  int failed = 1;
  if (work == NULL) return 1;
  Run run = {c, p, work + 2 * n * n + n};
  if (consistent(&run, t0, y, yp, work) || api->context_create(0, &context)) goto done;
  api->context_clear(context); /* nothing is printed: where this fails, the run is made another way */
  double *now = out_y + (nt - 1) * n, *rate = out_yp + (nt - 1) * n;
  memcpy(now, y, sizeof(double) * n);
  memcpy(rate, yp, sizeof(double) * n);
  vy = api->vector(n, now, context);
  vyp = api->vector(n, rate, context);
  va = api->vector(n, (double *)c->atol, context);
  matrix = api->matrix(n, n, context);
  linear = api->linear(vy, matrix, context);
  mem = api->create(context);
  if (!vy || !vyp || !va || !matrix || !linear || !mem) goto done;
  if (api->init(mem, residual, t0, vy, vyp) || api->tolerances(mem, c->rtol, va) ||
      api->set_linear(mem, linear, matrix) || api->set_jacobian(mem, jacobian) || api->set_data(mem, &run) ||
      api->set_order(mem, (int)c->order) || api->set_steps(mem, (long)c->max_steps) ||
      api->set_stop(mem, times[nt - 1]))
    goto done;
  for (long long k = 0; k < nt; ++k) {
    double reached;
    if (api->solve(mem, times[k], &reached, vy, vyp, 1) < 0) goto done;
    if (k < nt - 1) {
      memcpy(out_y + k * n, now, sizeof(double) * n);
      memcpy(out_yp + k * n, rate, sizeof(double) * n);
    }
  }
  long count[4] = {0};
  api->get_steps(mem, count);
  api->get_rejected(mem, count + 1);
  api->get_residuals(mem, count + 2);
  api->get_jacobians(mem, count + 3);
  for (int k = 0; k < 4; ++k) counts[k] = (double)count[k];
  failed = 0;
done:
  if (mem) api->free(&mem);
  if (linear) api->linear_free(linear);
  if (matrix) api->matrix_free(matrix);
  if (va) api->vector_free(va);
  if (vyp) api->vector_free(vyp);
  if (vy) api->vector_free(vy);
  if (context) api->context_free(&context);
  free(work);
  return failed;
}

/* Several runs, one after the other: row k of p, y, yp, out_y (nt, n), out_yp, counts is that of run k. */
void arthur_straight(const Problem *c, long long runs, long long size_of_p, const double *p, double t0,
                     const double *times, long long nt, double *y, double *yp, double *out_y, double *out_yp,
                     double *counts, char *failed) {
  long long n = c->n;
  for (long long k = 0; k < runs; ++k)
    failed[k] = (char)integrate(c, p + k * size_of_p, t0, times, nt, y + k * n, yp + k * n, out_y + k * nt * n,
                                out_yp + k * nt * n, counts + 4 * k);
}
