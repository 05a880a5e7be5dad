/* The functions of a BodyFunction in C: the same calls of MuJoCo in the same order as in dynamics.py and derivative.py,
   so the same bits. Whatever is rare (a value that is no number, a warning, an error of MuJoCo) is left to those: a
   function here then returns 1, and Python does it again and knows what to tell. */

#include <math.h>
#include <mujoco/mujoco.h>
#include <setjmp.h>
#include <stdint.h>
#include <string.h>

/* FIELDS of native.py. */
typedef struct {
  const mjModel *model;
  mjData *data;
  int64_t n_tau, n_act, n_ctrl, n_wrench, max_age;
  const int64_t *flange, *site; /* degrees of freedom; the sites of wrenches */
  const double *scale;
  double *at; /* the inputs that data stands for, and behind them whether it stands for any */
  double *base, *moved, *value, *tangent, *direction, *kept;
  int64_t age, signature, renewals;
} Body;

enum { DONE, LEFT_TO_PYTHON };

static _Thread_local jmp_buf *trap;
static mjfLogHandler before;

static void told(const mjLogMessage *message) {
  if (trap && message->level == mjLOG_ERROR) longjmp(*trap, 1);
  if (!trap && before) before(message); /* ours are told by Python */
}

static int64_t n_outputs(const Body *b) { return b->model->nv + b->n_act; }
static int64_t n_inputs(const Body *b) {
  return b->model->nq + b->model->nv + b->n_tau + b->n_act + b->n_ctrl + 6 * b->n_wrench;
}

/* See Dynamics.write. */
static void apply(const Body *b, const double *in) {
  const mjModel *m = b->model;
  mjData *d = b->data;
  b->at[n_inputs(b)] = 0.0;
  memcpy(d->qpos, in, (size_t)m->nq * sizeof *in);
  memcpy(d->qvel, in += m->nq, (size_t)m->nv * sizeof *in);
  in += m->nv;
  for (int64_t k = 0; k < b->n_tau; k++) d->qfrc_applied[b->flange[k]] = in[k];
  memcpy(d->act, in += b->n_tau, (size_t)b->n_act * sizeof *in);
  memcpy(d->ctrl, in += b->n_act, (size_t)b->n_ctrl * sizeof *in);
}

/* See Dynamics.forward. */
static int forward(const Body *b, const double *in, int stage) {
  const mjModel *m = b->model;
  mjData *d = b->data;
  for (int k = 0; k < mjNWARNING; k++) d->warning[k].number = 0;
  if (b->n_wrench) {
    const double *tau = in + m->nq + m->nv, *wrench = tau + b->n_tau + b->n_act + b->n_ctrl;
    if (stage == mjSTAGE_NONE) mj_fwdKinematics(m, d);
    memset(d->qfrc_applied, 0, (size_t)m->nv * sizeof *in);
    for (int64_t k = 0; k < b->n_tau; k++) d->qfrc_applied[b->flange[k]] = tau[k];
    for (int64_t k = 0; k < b->n_wrench; k++, wrench += 6)
      mj_applyFT(m, d, wrench, wrench + 3, d->site_xpos + 3 * b->site[k], m->site_bodyid[b->site[k]], d->qfrc_applied);
  }
  mj_forwardSkip(m, d, stage, 1);
  for (int k = 0; k < mjNWARNING; k++)
    if (d->warning[k].number) return LEFT_TO_PYTHON;
  return DONE;
}

/* See Dynamics.compute. */
static int compute(const Body *b, const double *in) {
  int64_t n = n_inputs(b);
  if (b->at[n] && !memcmp(in, b->at, (size_t)n * sizeof *in)) return DONE;
  apply(b, in);
  double sum = 0.0;
  for (int64_t k = 0; k < n; k++) sum += in[k] * in[k];
  if (!isfinite(sum) || forward(b, in, mjSTAGE_NONE)) return LEFT_TO_PYTHON;
  memcpy(b->at, in, (size_t)n * sizeof *in);
  b->at[n] = 1.0;
  return DONE;
}

static void read_out(const Body *b, double *out) {
  memcpy(out, b->data->qacc, (size_t)b->model->nv * sizeof *out);
  memcpy(out + b->model->nv, b->data->act_dot, (size_t)b->n_act * sizeof *out);
}

static const int OFFSETS[] = {1, -2, -1, 1, 2};
static const double WEIGHTS[] = {1.0, 1.0 / 12, -2.0 / 3, 2.0 / 3, -1.0 / 12};

/* See Differences._column; the column's entries are `width` apart. */
static int column(const Body *b, const double *in, int64_t k, double *out, int64_t width, int stage, int exact) {
  int64_t n = n_outputs(b);
  double step = exact ? 1e-5 : 1e-6;
  if (stage) step *= b->scale[k];
  for (int64_t i = 0; i < n; i++) out[i * width] = 0.0;
  for (int s = exact ? 1 : 0; s < (exact ? 5 : 1); s++) {
    memcpy(b->moved, in, (size_t)n_inputs(b) * sizeof *in);
    if (stage) {
      b->moved[k] += OFFSETS[s] * step;
    } else {
      b->direction[k] = 1.0;
      mj_integratePos(b->model, b->moved, b->direction, OFFSETS[s] * step);
      b->direction[k] = 0.0;
    }
    apply(b, b->moved);
    if (forward(b, b->moved, stage)) return LEFT_TO_PYTHON;
    read_out(b, b->value);
    for (int64_t i = 0; i < n; i++)
      out[i * width] += WEIGHTS[s] * (exact ? b->value[i] : b->value[i] - b->base[i]);
  }
  for (int64_t i = 0; i < n; i++) out[i * width] /= step;
  return DONE;
}

/* See Differences._to_coordinates and turning. */
static void to_coordinates(const Body *b, const double *in, double *out, int64_t width) {
  const mjModel *m = b->model;
  for (int j = 0; j < m->njnt; j++) {
    int q = m->jnt_qposadr[j], v = m->jnt_dofadr[j], kind = m->jnt_type[j];
    int straight = kind == mjJNT_FREE ? 3 : kind == mjJNT_BALL ? 0 : 1;
    const double *p = in + q + straight, w = p[0], x = p[1], y = p[2], z = p[3];
    const double rows[3][4] = {{-x, w, z, -y}, {-y, -z, w, x}, {-z, y, -x, w}};
    for (int64_t i = 0; i < n_outputs(b); i++) {
      const double *t = b->tangent + i * m->nv + v;
      double *o = out + i * width + q;
      for (int k = 0; k < straight; k++) o[k] = t[k];
      if (kind != mjJNT_FREE && kind != mjJNT_BALL) continue;
      double factor = 2.0 / (w * w + x * x + y * y + z * z);
      for (int k = 0; k < 4; k++)
        o[straight + k] = t[straight] * (factor * rows[0][k]) + t[straight + 1] * (factor * rows[1][k]) +
                          t[straight + 2] * (factor * rows[2][k]);
    }
  }
}

/* See Differences.write; `in` has been computed. */
static int differences(const Body *b, const double *in, double *out, int exact) {
  const mjModel *m = b->model;
  int64_t width = n_inputs(b), first = m->nq + m->nv;
  read_out(b, b->base);
  for (int64_t k = m->nq; k < first; k++)
    if (column(b, in, k, out + k, width, mjSTAGE_POS, exact)) return LEFT_TO_PYTHON;
  apply(b, in);
  if (forward(b, in, mjSTAGE_POS)) return LEFT_TO_PYTHON;
  for (int64_t k = first; k < width; k++)
    if (column(b, in, k, out + k, width, mjSTAGE_VEL, exact)) return LEFT_TO_PYTHON;
  for (int64_t k = 0; k < m->nv; k++)
    if (column(b, in, k, b->tangent + k, m->nv, mjSTAGE_NONE, exact)) return LEFT_TO_PYTHON;
  to_coordinates(b, in, out, width);
  return DONE;
}

static int64_t mixed(int64_t h, int64_t x) { return (int64_t)(((uint64_t)h ^ (uint64_t)x) * 0x9E3779B97F4A7C15u); }

/* Which contacts and limits act, and how; see Stale._acting. */
static int64_t acting(const mjData *d) {
  int64_t h = mixed(d->nefc, d->ncon);
  for (int k = 0; k < d->nefc; k++) h = mixed(h, d->efc_state[k]);
  for (int k = 0; k < d->ncon; k++) h = mixed(mixed(h, d->contact[k].geom[0]), d->contact[k].geom[1]);
  return h;
}

/* Run a function with errors of MuJoCo caught, as the binding for Python does. */
static int guarded(int (*function)(Body *, const double *, double *), Body *b, const double *in, double *out) {
  jmp_buf here;
  mjfLogHandler usual = mju_setLogHandler(told);
  before = usual;
  int left;
  if (setjmp(here)) {
    mj_resetData(b->model, b->data);
    b->at[n_inputs(b)] = 0.0;
    left = LEFT_TO_PYTHON;
  } else {
    trap = &here;
    left = function(b, in, out);
  }
  trap = 0;
  mju_setLogHandler(usual);
  return left;
}

static int evaluated(Body *b, const double *in, double *out) {
  if (compute(b, in)) return LEFT_TO_PYTHON;
  read_out(b, out);
  return DONE;
}

static int exactly(Body *b, const double *in, double *out) {
  return compute(b, in) || differences(b, in, out, 1);
}

static int stale(Body *b, const double *in, double *out) {
  if (compute(b, in)) return LEFT_TO_PYTHON;
  int64_t now = acting(b->data);
  if (b->age >= b->max_age || b->signature != now) {
    b->age = b->max_age;
    if (differences(b, in, b->kept, 0)) return LEFT_TO_PYTHON;
    b->age = 0;
    b->renewals++;
    b->signature = now;
  }
  b->age++;
  memcpy(out, b->kept, (size_t)(n_outputs(b) * n_inputs(b)) * sizeof *out);
  return DONE;
}

int arthur_evaluate(void *b, const double *in, double *out) { return guarded(evaluated, b, in, out); }
int arthur_derivative(void *b, const double *in, double *out) { return guarded(stale, b, in, out); }
int arthur_exact_derivative(void *b, const double *in, double *out) { return guarded(exactly, b, in, out); }
