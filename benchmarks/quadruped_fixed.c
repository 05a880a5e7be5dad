/* Fixed-step integration of the robot: hydraulics from the generated file that is named by EQUATIONS, see
 * quadruped_equations.py, and MuJoCo by its C interface.
 *
 * usage: program METHOD MODEL.mjb START TICKS STEPS H_MUJOCO EVERY < DATA > STATES
 *
 * METHOD: euler, semi (implicit Euler: velocities first), rk4, ros1, ros2 (linearly implicit), cosim.
 * STEPS a tick of PERIOD; EVERY: steps from one Jacobian to the next; cosim: STEPS of rk4 a tick for the hydraulics,
 * MuJoCo steps once in H_MUJOCO, and in between the joints go on at the speed that they have.
 * DATA: y[NX], y' and algebraic unknowns [NY], then for each tick z[NZ]. STATES: y at the start and at the end of each tick.
 * The CPU time of the loop [s] goes to standard error.
 */
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include EQUATIONS

enum { ITERATIONS = 1 }; /* Newton's, from the values of the stage before */
enum { NIN = NQ + NV + NTAU };

static const mjModel *model;
static mjData *data;
static double z[NZ], w[NY]; /* w: y' and the algebraic unknowns, as they were last */
static int frozen;          /* whether the joints do not accelerate */
static int dof[NTAU] = DOFS, place_q[NQ] = QPOS, place_v[NV] = QVEL;

static casadi_real work[200000];
static casadi_int integers[4096];

static void call(int (*function)(const casadi_real **, casadi_real **, casadi_int *, casadi_real *, int),
                 double t, const double *y, const double *a, double *out, double *out2) {
    const casadi_real *arguments[16] = {&t, y, z, a, w};
    casadi_real *results[16] = {out, out2};
    function(arguments, results, integers, work, 0);
}

static void apply(const double *in) {
    memcpy(data->qpos, in, NQ * sizeof *in);
    memcpy(data->qvel, in + NQ, NV * sizeof *in);
    for (int k = 0; k < NTAU; k++) data->qfrc_applied[dof[k]] = in[NQ + NV + k];
}

static void accelerations(double t, const double *y, double *a) {
    double in[NIN];
    if (frozen) {
        memset(a, 0, NV * sizeof *a);
        return;
    }
    call(forces, t, y, 0, in, 0);
    apply(in);
    mj_forwardSkip(model, data, mjSTAGE_NONE, 1);
    memcpy(a, data->qacc, NV * sizeof *a);
}

static void evaluate(double t, const double *y, double *f) {
    double a[NV], found[NY]; /* generated functions write their results before they have read all arguments */
    accelerations(t, y, a);
    for (int k = 0; k < ITERATIONS; k++) {
        call(rates, t, y, a, found, 0);
        memcpy(w, found, sizeof w);
    }
    memcpy(f, w, NX * sizeof *f);
}

static void euler(double t, double h, double *y) {
    double f[NX];
    evaluate(t, y, f);
    for (int i = 0; i < NX; i++) y[i] += h * f[i];
}

/* Velocities and hydraulics first, then positions with the new velocities. */
static void semi(double t, double h, double *y) {
    double f[NX], p[NX], a[NV] = {0}, moved[NY];
    evaluate(t, y, f);
    memcpy(p, y, sizeof p);
    for (int i = 0; i < NX; i++) y[i] += h * f[i];
    call(rates, t, y, a, moved, 0); /* of the positions, rates are those of kinematics: MuJoCo is not asked */
    for (int k = 0; k < NQ; k++) y[place_q[k]] = p[place_q[k]] + h * moved[place_q[k]];
}

static void rk4(double t, double h, double *y) {
    double a[NX], b[NX], c[NX], d[NX], x[NX];
    evaluate(t, y, a);
    memcpy(x, y, sizeof x);
    for (int i = 0; i < NX; i++) x[i] = y[i] + h / 2 * a[i];
    evaluate(t + h / 2, x, b);
    for (int i = 0; i < NX; i++) x[i] = y[i] + h / 2 * b[i];
    evaluate(t + h / 2, x, c);
    for (int i = 0; i < NX; i++) x[i] = y[i] + h * c[i];
    evaluate(t + h, x, d);
    for (int i = 0; i < NX; i++) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
}

static double lu[NX][NX];
static int pivot[NX];

/* I - gamma_h A, factorised. A: the hydraulics' and kinematics' slopes exactly, and through the torques what the
 * hydraulics do to the accelerations, by differences. */
static void factorise(double t, const double *y, double gamma_h) {
    static double slope[NX][NX], dtau[NTAU][NX];
    double in[NIN], base[NV], a[NV], response[NV];
    accelerations(t, y, base);
    call(forces, t, y, 0, in, 0);
    call(slopes, t, y, base, slope[0], dtau[0]);
    apply(in);
    for (int k = 0; k < NTAU; k++) {
        double *force = &data->qfrc_applied[dof[k]], before = *force, by = 1e-3;
        *force += by;
        mj_forwardSkip(model, data, mjSTAGE_VEL, 1);
        *force = before;
        memcpy(a, data->qacc, sizeof a);
        for (int v = 0; v < NV; v++) response[v] = (a[v] - base[v]) / by;
        for (int v = 0; v < NV; v++)
            for (int j = 0; j < NX; j++) slope[place_v[v]][j] += response[v] * dtau[k][j];
    }
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++) lu[i][j] = (i == j) - gamma_h * slope[i][j];
    for (int k = 0; k < NX; k++) {
        int p = k;
        for (int i = k + 1; i < NX; i++)
            if (fabs(lu[i][k]) > fabs(lu[p][k])) p = i;
        pivot[k] = p;
        if (p != k)
            for (int j = 0; j < NX; j++) {
                double other = lu[k][j];
                lu[k][j] = lu[p][j];
                lu[p][j] = other;
            }
        for (int i = k + 1; i < NX; i++) {
            if (lu[i][k] == 0.0) continue;
            double factor = lu[i][k] /= lu[k][k];
            for (int j = k + 1; j < NX; j++) lu[i][j] -= factor * lu[k][j];
        }
    }
}

static void solve(double *x) {
    for (int k = 0; k < NX; k++) {
        double other = x[pivot[k]];
        x[pivot[k]] = x[k];
        x[k] = other;
    }
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < i; j++) x[i] -= lu[i][j] * x[j];
    for (int i = NX - 1; i >= 0; i--) {
        for (int j = i + 1; j < NX; j++) x[i] -= lu[i][j] * x[j];
        x[i] /= lu[i][i];
    }
}

/* Linearly implicit Euler; of order 1 whatever the matrix. */
static void ros1(double t, double h, double *y) {
    double k[NX];
    evaluate(t, y, k);
    solve(k);
    for (int i = 0; i < NX; i++) y[i] += h * k[i];
}

/* ROS2 of Verwer, Spee, Blom and Hundsdorfer (1999); of order 2 whatever the matrix, so that it may be an old one. */
static void ros2(double t, double h, double *y) {
    double k[NX], l[NX], x[NX];
    evaluate(t, y, k);
    solve(k);
    memcpy(x, y, sizeof x);
    for (int i = 0; i < NX; i++) x[i] += h * k[i];
    evaluate(t + h, x, l);
    for (int i = 0; i < NX; i++) l[i] -= 2 * k[i];
    solve(l);
    for (int i = 0; i < NX; i++) y[i] += h * (1.5 * k[i] + 0.5 * l[i]);
}

/* Hydraulics over H with the joints at the speed that they have; MuJoCo over H with the torques that it is given. */
static void exchange(double t, double H, long steps, double *y) {
    double in[NIN], q[NQ], v[NV];
    call(forces, t, y, 0, in, 0);
    apply(in);
    mj_forwardSkip(model, data, mjSTAGE_NONE, 1);
    memcpy(q, data->qpos, sizeof q);
    for (int k = 0; k < NV; k++) v[k] = data->qvel[k] + H * data->qacc[k];
    mj_integratePos(model, q, v, H);
    frozen = 1;
    for (long k = 0; k < steps; k++) rk4(t + (double)k * H / (double)steps, H / (double)steps, y);
    frozen = 0;
    for (int k = 0; k < NQ; k++) y[place_q[k]] = q[k];
    for (int k = 0; k < NV; k++) y[place_v[k]] = v[k];
}

int main(int count, char **words) {
    static double y[NX];
    if (count != 8 || fread(y, sizeof y, 1, stdin) != 1 || fread(w, sizeof w, 1, stdin) != 1) return 2;
    if (!(model = mj_loadModel(words[2], 0))) return 3;
    data = mj_makeData(model);
    long ticks = atol(words[4]), steps = atol(words[5]), every = atol(words[7]);
    double start = atof(words[3]), h = PERIOD / (double)steps, H = atof(words[6]);
    const char *names[] = {"euler", "semi", "rk4", "ros1", "ros2"};
    void (*methods[])(double, double, double *) = {euler, semi, rk4, ros1, ros2};
    int cosim = !strcmp(words[1], "cosim"), m = 0;
    while (!cosim && strcmp(words[1], names[m])) m++;
    double gamma = m == 3 ? 1.0 : m == 4 ? 1.0 - sqrt(0.5) : 0.0;
    fwrite(y, sizeof y, 1, stdout);
    clock_t spent = 0;
    for (long tick = 0, number = 0; tick < ticks; tick++) {
        if (fread(z, sizeof z, 1, stdin) != 1) return 2;
        clock_t begin = clock();
        double t = start + (double)tick * PERIOD;
        if (cosim) {
            long exchanges = lround(PERIOD / H);
            for (long k = 0; k < exchanges; k++) exchange(t + (double)k * H, H, steps / exchanges, y);
        } else
            for (long k = 0; k < steps; k++, number++) {
                double now = t + (double)k * h;
                if (gamma && number % every == 0) factorise(now, y, gamma * h);
                methods[m](now, h, y);
                if (!(fabs(y[0]) < 1e300)) break;
            }
        spent += clock() - begin;
        fwrite(y, sizeof y, 1, stdout);
    }
    fprintf(stderr, "%.9f\n", (double)spent / CLOCKS_PER_SEC);
    return 0;
}
