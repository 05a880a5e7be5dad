/* What IDA calls, without the interpreter: the generated residual, Jacobian and root functions on pinned arrays.

   Each function here has a Python twin in callbacks.py, or for external functions in codegen/calls.py, which says what
   it does, and goes to Python for whatever is rare: a value that is no finite number, a relation that has changed,
   progress to report, Ctrl-C. */

#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

typedef int (*eval_t)(const double **, double **, long long *, double *, int);
typedef int (*foreign_t)(void *, const double *, double *);

/* Shared with Python as an array of float64; the order is that of FIELDS in native.py. */
typedef struct {
  double t, h, steps, rejected, residuals, jacobians, roots, halted, max_steps, next_report;
} Counts;

enum { GOING, MAX_STEPS, STALLED_AT, INTERRUPTED };
static const double STALLED = 4e15, TINY = 1e-300;

/* A generated function with its arrays. */
typedef struct {
  eval_t fn;
  const double **arg;
  double **res;
  long long *iw;
  double *w;
} Generated;

enum { NOTHING, OUTPUTS, SLOPES };

/* A call of an external function; see Step in codegen/calls.py. */
typedef struct {
  Generated inputs;
  const double *value; /* of the inputs */
  double *key;
  int64_t *known;
  int64_t bytes; /* of the inputs */
  void *self;
  foreign_t evaluate, derivative; /* none: Python serves */
  double *outputs, *slopes;
} External;

typedef struct {
  const Generated *generated;
  Py_ssize_t n, m; /* unknowns, numbers in the result */
  double *t, *y, *yp, *cj, *value;
  Counts *counts;
  const int64_t *place; /* where a Jacobian entry goes; which relations are watched */
  Py_ssize_t places;
  const double *zero;         /* what is added to a root function */
  const unsigned char *modes; /* truth values at present */
  const External *externals;
  Py_ssize_t externals_count;
  int64_t wanted; /* of the external functions */
  double *tally;  /* their evaluations, and seconds in them */
  PyObject *slow, *progress, *prepare, *keep;
} Call;

static double now(void) {
  struct timespec ts;
  clock_gettime(CLOCK_MONOTONIC, &ts);
  return (double)ts.tv_sec + 1e-9 * (double)ts.tv_nsec;
}

/* Turn KeyboardInterrupt into a halt, so that nothing of what IDA has computed is lost; others pass. */
static int halted_by_exception(Call *c) {
  if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) return -1;
  PyErr_Clear();
  c->counts->halted = INTERRUPTED;
  return 0;
}

/* The time of an argument; IDA gives a float. */
static int time_of(PyObject *o, double *t) {
  *t = PyFloat_AsDouble(o);
  return *t == -1.0 && PyErr_Occurred() ? -1 : 0;
}

static int buffer_of(PyObject *o, Py_buffer *b, Py_ssize_t count, int writable) {
  if (PyObject_GetBuffer(o, b, writable ? PyBUF_WRITABLE : PyBUF_SIMPLE)) return -1;
  if (b->len != count * (Py_ssize_t)sizeof(double)) {
    PyErr_Format(PyExc_ValueError, "an array of %zd bytes, not of %zd numbers", b->len, count);
    PyBuffer_Release(b);
    return -1;
  }
  return 0;
}

/* Copy the arguments to where the generated functions read them. */
static int take(Call *c, PyObject *const *args) {
  Py_buffer b;
  if (time_of(args[0], c->t)) return -1;
  if (buffer_of(args[1], &b, c->n, 0)) return -1;
  memcpy(c->y, b.buf, (size_t)b.len);
  PyBuffer_Release(&b);
  if (buffer_of(args[2], &b, c->n, 0)) return -1;
  memcpy(c->yp, b.buf, (size_t)b.len);
  PyBuffer_Release(&b);
  return 0;
}

static void run(const Generated *g) { g->fn(g->arg, g->res, g->iw, g->w, 0); }

/* Run one function of an external one; nonzero: Python is to do it. */
static int foreign(Call *c, const External *e, foreign_t function, double *out) {
  if (!function) return 1;
  double begun = now();
  int left = function(e->self, e->value, out);
  c->tally[1] += now() - begun;
  return left;
}

/* Bring the external functions up to date with the arguments; -1: an exception. */
static int prepared(Call *c) {
  const External *end = c->externals + c->externals_count;
  int left = 0;
  for (const External *e = c->externals; !left && e < end; ++e) {
    run(&e->inputs);
    if (*e->known != NOTHING && !memcmp(e->value, e->key, (size_t)e->bytes)) continue;
    *e->known = NOTHING;
    left = foreign(c, e, e->evaluate, e->outputs);
    if (left) break;
    memcpy(e->key, e->value, (size_t)e->bytes);
    *e->known = OUTPUTS;
    c->tally[0] += 1.0;
  }
  for (const External *e = c->externals; !left && e < end; ++e)
    if (*e->known < c->wanted && !(left = foreign(c, e, e->derivative, e->slopes))) *e->known = SLOPES;
  if (!left) return 0;
  PyObject *done = PyObject_CallNoArgs(c->prepare);
  Py_XDECREF(done);
  return done ? 0 : -1;
}

static int attempt(Call *c, double t) {
  Counts *k = c->counts;
  if (t > k->t) {
    k->steps += 1.0;
    if (k->t > -INFINITY) k->h = t - k->t;
    if (k->steps > k->max_steps) k->halted = MAX_STEPS;
  } else {
    k->rejected += 1.0;
  }
  k->t = t;
  if (PyErr_CheckSignals()) return halted_by_exception(c);
  if (c->progress != Py_None && now() > k->next_report) {
    PyObject *done = PyObject_CallFunction(c->progress, "d", t);
    k->next_report = now() + 0.1;
    if (!done) return halted_by_exception(c);
    Py_DECREF(done);
  }
  return 0;
}

static int all_finite(const double *x, Py_ssize_t n) {
  double sum = 0.0; /* 0 * x is 0 for finite x only */
  for (Py_ssize_t i = 0; i < n; ++i) sum += 0.0 * x[i];
  return sum == 0.0;
}

/* Ask Python about the rare case; -1: an exception, else the truth of its answer. */
static int ask(Call *c) {
  PyObject *answer = PyObject_CallNoArgs(c->slow);
  if (!answer) return -1;
  int truth = PyObject_IsTrue(answer);
  Py_DECREF(answer);
  return truth;
}

static Call *call_of(PyObject *self) { return PyCapsule_GetPointer(self, "arthur.call"); }

PyDoc_STRVAR(residual_doc, "residual(t, y, yp, out)\n--\n\n");
static PyObject *residual(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  double t;
  Py_buffer out;
  if (!c || nargs != 4 || time_of(args[0], &t)) return NULL;
  if (t != c->counts->t && attempt(c, t)) return NULL;
  if (buffer_of(args[3], &out, c->n, 1)) return NULL;
  double *r = out.buf;
  int good = 0;
  if (c->counts->halted == GOING) {
    c->counts->residuals += 1.0;
    if (take(c, args)) goto failed;
    int refused = prepared(c);
    if (!refused) {
      run(c->generated);
      if (!all_finite(c->value, c->n)) refused = ask(c);
    }
    if (refused < 0 && halted_by_exception(c)) goto failed;
    good = refused == 0;
  }
  if (good)
    memcpy(r, c->value, (size_t)out.len);
  else
    for (Py_ssize_t i = 0; i < c->n; ++i) r[i] = INFINITY;
  PyBuffer_Release(&out);
  Py_RETURN_NONE;
failed:
  PyBuffer_Release(&out);
  return NULL;
}

PyDoc_STRVAR(jacobian_doc, "jacobian(t, y, yp, res, cj, out)\n--\n\n");
static PyObject *jacobian(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  Counts *k = c ? c->counts : NULL;
  if (!c || nargs != 6) return NULL;
  if (k->halted != GOING) Py_RETURN_NONE;
  k->jacobians += 1.0;
  if (take(c, args) || time_of(args[4], c->cj)) return NULL;
  if (*c->cj * fabs(*c->t) > STALLED) k->halted = STALLED_AT;
  if (prepared(c)) {
    if (halted_by_exception(c)) return NULL;
    Py_RETURN_NONE;
  }
  run(c->generated);
  if (!all_finite(c->value, c->m) && ask(c) < 0 && halted_by_exception(c)) return NULL;
  Py_buffer out;
  if (buffer_of(args[5], &out, c->place ? c->n * c->n : c->m, 1)) return NULL;
  double *j = out.buf;
  if (c->place)
    for (Py_ssize_t i = 0; i < c->m; ++i) j[c->place[i]] = c->value[i];
  else
    memcpy(j, c->value, (size_t)out.len);
  PyBuffer_Release(&out);
  Py_RETURN_NONE;
}

PyDoc_STRVAR(roots_doc, "roots(t, y, yp, out)\n--\n\n");
static PyObject *roots(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  Py_buffer out;
  if (!c || nargs != 4 || buffer_of(args[3], &out, c->places, 1)) return NULL;
  double *g = out.buf;
  int differs = 0, going = c->counts->halted == GOING;
  if (going) {
    c->counts->roots += 1.0;
    if (take(c, args)) goto failed;
    if (prepared(c)) {
      if (halted_by_exception(c)) goto failed;
      going = 0;
    }
  }
  if (going) {
    run(c->generated);
    for (Py_ssize_t i = 0; i < c->places; ++i) {
      g[i] = c->value[c->place[i]] + c->zero[i];
      differs |= (g[i] > 0.0) != c->modes[i];
    }
    if (differs) {
      PyObject *done = PyObject_CallFunctionObjArgs(c->slow, args[0], args[3], NULL);
      if (!done && halted_by_exception(c)) goto failed;
      Py_XDECREF(done);
    }
  } else {
    for (Py_ssize_t i = 0; i < c->places; ++i) g[i] = c->modes[i] ? TINY : -TINY;
  }
  PyBuffer_Release(&out);
  Py_RETURN_NONE;
failed:
  PyBuffer_Release(&out);
  return NULL;
}

static PyMethodDef functions[] = {
    {"residual", (PyCFunction)(void (*)(void))residual, METH_FASTCALL, residual_doc},
    {"jacobian", (PyCFunction)(void (*)(void))jacobian, METH_FASTCALL, jacobian_doc},
    {"roots", (PyCFunction)(void (*)(void))roots, METH_FASTCALL, roots_doc},
    {NULL, NULL, 0, NULL}};

static void release(PyObject *capsule) {
  Call *c = call_of(capsule);
  Py_XDECREF(c->slow);
  Py_XDECREF(c->progress);
  Py_XDECREF(c->prepare);
  Py_XDECREF(c->keep);
  PyMem_Free(c);
}

static double *address(unsigned long long a) { return (double *)(uintptr_t)a; }

/* bind(kind, generated, n, m, t, y, yp, cj, value, counts, place, places, zero, modes, externals, count, wanted, tally,
   slow, progress, prepare, keep): addresses as integers, 0 for none; `keep` holds the arrays. */
static PyObject *bind(PyObject *module, PyObject *args) {
  unsigned long long generated, t, y, yp, cj, value, counts, place, zero, modes, externals, tally;
  Py_ssize_t n, m, places, externals_count;
  int kind, wanted;
  PyObject *slow, *progress, *prepare, *keep;
  if (!PyArg_ParseTuple(args, "iKnnKKKKKKKnKKKniKOOOO", &kind, &generated, &n, &m, &t, &y, &yp, &cj, &value, &counts,
                        &place, &places, &zero, &modes, &externals, &externals_count, &wanted, &tally, &slow, &progress,
                        &prepare, &keep))
    return NULL;
  Call *c = PyMem_Calloc(1, sizeof(Call));
  if (!c) return PyErr_NoMemory();
  c->generated = (const Generated *)(uintptr_t)generated;
  c->n = n;
  c->m = m;
  c->t = address(t);
  c->y = address(y);
  c->yp = address(yp);
  c->cj = address(cj);
  c->value = address(value);
  c->counts = (Counts *)(uintptr_t)counts;
  c->place = (const int64_t *)(uintptr_t)place;
  c->places = places;
  c->zero = address(zero);
  c->modes = (const unsigned char *)(uintptr_t)modes;
  c->externals = (const External *)(uintptr_t)externals;
  c->externals_count = externals_count;
  c->wanted = wanted;
  c->tally = address(tally);
  c->slow = Py_NewRef(slow);
  c->progress = Py_NewRef(progress);
  c->prepare = Py_NewRef(prepare);
  c->keep = Py_NewRef(keep);
  PyObject *capsule = PyCapsule_New(c, "arthur.call", release);
  if (!capsule) return NULL;
  PyObject *function = PyCFunction_NewEx(&functions[kind], capsule, NULL);
  Py_DECREF(capsule);
  return function;
}

static PyMethodDef methods[] = {{"bind", bind, METH_VARARGS, "bind(...) -> callable"}, {NULL, NULL, 0, NULL}};
static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, "arthur_native", NULL, -1, methods, NULL, NULL, NULL, NULL};
PyMODINIT_FUNC PyInit_arthur_native(void) { return PyModule_Create(&definition); }
