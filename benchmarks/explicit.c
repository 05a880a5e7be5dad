/* Explicit Euler and the classical Runge-Kutta method of order 4 on x' = f(t, x), compiled with the
 * generated file that is named by RATES. Its one function
 *     rates(t, x[NX], z) -> dx[NX], z_next
 * takes one Newton step on the algebraic variable z before it evaluates the rates; z comes from the
 * stage before, which at these steps is as good as solving for it.
 *
 * usage: explicit euler|rk4 STEPS STOP_TIME < START > END; START and END hold x and z as doubles.
 * Prints the wall time of the loop [s] on standard error.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include RATES

static casadi_real work[rates_SZ_W + 1];
static casadi_int integers[rates_SZ_IW + 1];

static void evaluate(double t, const double *x, double *z, double *dx) {
    const casadi_real *arguments[rates_SZ_ARG];
    casadi_real *results[rates_SZ_RES];
    arguments[0] = &t;
    arguments[1] = x;
    arguments[2] = z;
    results[0] = dx;
    results[1] = z;
    rates(arguments, results, integers, work, 0);
}

static void euler(double t, double h, double *x, double *z) {
    double dx[NX];
    evaluate(t, x, z, dx);
    for (int i = 0; i < NX; i++) x[i] += h * dx[i];
}

static void rk4(double t, double h, double *x, double *z) {
    double a[NX], b[NX], c[NX], d[NX], y[NX];
    evaluate(t, x, z, a);
    for (int i = 0; i < NX; i++) y[i] = x[i] + h / 2 * a[i];
    evaluate(t + h / 2, y, z, b);
    for (int i = 0; i < NX; i++) y[i] = x[i] + h / 2 * b[i];
    evaluate(t + h / 2, y, z, c);
    for (int i = 0; i < NX; i++) y[i] = x[i] + h * c[i];
    evaluate(t + h, y, z, d);
    for (int i = 0; i < NX; i++) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
}

int main(int count, char **words) {
    double state[NX + 1];
    if (count != 4 || fread(state, sizeof state, 1, stdin) != 1) return 2;
    long steps = atol(words[2]);
    double h = atof(words[3]) / (double)steps;
    void (*step)(double, double, double *, double *) = strcmp(words[1], "rk4") ? euler : rk4;
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    for (long k = 0; k < steps; k++) {
        step((double)k * h, h, state, state + NX);
        if (!(state[0] - state[0] == 0)) break; /* no longer finite */
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    fprintf(stderr, "%.9f\n", (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec));
    return fwrite(state, sizeof state, 1, stdout) != 1;
}
