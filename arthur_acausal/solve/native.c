/* What IDA calls, without the interpreter: the generated residual, Jacobian and root functions on pinned arrays.

   Each function here has a Python twin in callbacks.py, or for external functions in codegen/calls.py, which says what
   it does, and goes to Python for whatever is rare: a value that is no finite number, a relation that has changed,
   progress to report, Ctrl-C.

   The binding makes arrays of NumPy for each call, which takes longer than most residuals. So, where it is the version
   whose memory is known, IDA gets the same functions directly: see attach. */

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

enum { GOING, MAX_STEPS, STALLED_AT, INTERRUPTED, TOLERANCES };
static const double STALLED = 4e15, TINY = 1e-300, WATCHED = 20.0; /* as in callbacks.py */

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
  PyObject *slow, *progress, *prepare, *watch, *refresh, *keep;
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

/* The arguments of a call from Python: t, y, y'. */
typedef struct {
  double t;
  Py_buffer y, yp, out;
} Arguments;

/* -1: an exception. */
static int unpack(Arguments *a, PyObject *const *args, Py_ssize_t n, PyObject *out, Py_ssize_t count) {
  if (time_of(args[0], &a->t)) return -1;
  if (buffer_of(args[1], &a->y, n, 0)) return -1;
  if (buffer_of(args[2], &a->yp, n, 0)) goto y;
  if (buffer_of(out, &a->out, count, 1)) goto yp;
  return 0;
yp:
  PyBuffer_Release(&a->yp);
y:
  PyBuffer_Release(&a->y);
  return -1;
}

static PyObject *released(Arguments *a, int failed) {
  PyBuffer_Release(&a->y);
  PyBuffer_Release(&a->yp);
  PyBuffer_Release(&a->out);
  if (failed) return NULL;
  Py_RETURN_NONE;
}

/* Copy the arguments to where the generated functions read them; inputs that vary are Python's. -1: an exception. */
static int take(Call *c, double t, const double *y, const double *yp) {
  *c->t = t;
  memcpy(c->y, y, (size_t)c->n * sizeof *y);
  memcpy(c->yp, yp, (size_t)c->n * sizeof *yp);
  if (c->refresh == Py_None) return 0;
  PyObject *done = PyObject_CallFunction(c->refresh, "d", t);
  Py_XDECREF(done);
  return done ? 0 : -1;
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
static int ask(PyObject *question) {
  PyObject *answer = PyObject_CallNoArgs(question);
  if (!answer) return -1;
  int truth = PyObject_IsTrue(answer);
  Py_DECREF(answer);
  return truth;
}

/* These return -1 after an exception. */
static int residual_at(Call *c, double t, const double *y, const double *yp, double *r) {
  int good = 0;
  if (t != c->counts->t && attempt(c, t)) return -1;
  if (c->counts->halted == GOING) {
    c->counts->residuals += 1.0;
    int refused = take(c, t, y, yp) ? -1 : prepared(c);
    if (!refused) {
      run(c->generated);
      if (!all_finite(c->value, c->n)) refused = ask(c->slow);
    }
    if (refused < 0 && halted_by_exception(c)) return -1;
    good = refused == 0;
  }
  if (good)
    memcpy(r, c->value, (size_t)c->n * sizeof *r);
  else
    for (Py_ssize_t i = 0; i < c->n; ++i) r[i] = INFINITY;
  return 0;
}

/* Write the entries to their places, 0: one after the other. */
static int jacobian_at(Call *c, double t, const double *y, const double *yp, double cj, const int64_t *place, double *j) {
  Counts *k = c->counts;
  if (k->halted != GOING) return 0;
  k->jacobians += 1.0;
  if (take(c, t, y, yp)) return halted_by_exception(c);
  if (cj * fabs(t) > STALLED) k->halted = STALLED_AT;
  if (fmod(k->jacobians, WATCHED) == 0.0) {
    int widened = ask(c->watch);
    if (widened < 0) return halted_by_exception(c);
    if (widened) k->halted = TOLERANCES;
  }
  *c->cj = cj; /* a look changes it */
  if (prepared(c)) return halted_by_exception(c);
  run(c->generated);
  if (!all_finite(c->value, c->m) && ask(c->slow) < 0) return halted_by_exception(c);
  if (place)
    for (Py_ssize_t i = 0; i < c->m; ++i) j[place[i]] = c->value[i];
  else
    memcpy(j, c->value, (size_t)c->m * sizeof *j);
  return 0;
}

static int roots_at(Call *c, double t, const double *y, const double *yp, double *g) {
  int differs = 0, going = c->counts->halted == GOING;
  if (going) {
    c->counts->roots += 1.0;
    going = !take(c, t, y, yp) && !prepared(c);
    if (!going && halted_by_exception(c)) return -1;
  }
  if (!going) {
    for (Py_ssize_t i = 0; i < c->places; ++i) g[i] = c->modes[i] ? TINY : -TINY;
    return 0;
  }
  run(c->generated);
  for (Py_ssize_t i = 0; i < c->places; ++i) {
    g[i] = c->value[c->place[i]] + c->zero[i];
    differs |= (g[i] > 0.0) != c->modes[i];
  }
  if (!differs) return 0;
  PyObject *out = PyMemoryView_FromMemory((char *)g, c->places * (Py_ssize_t)sizeof *g, PyBUF_WRITE);
  PyObject *done = out ? PyObject_CallFunction(c->slow, "dO", t, out) : NULL;
  Py_XDECREF(out);
  Py_XDECREF(done);
  return done ? 0 : halted_by_exception(c);
}

static Call *call_of(PyObject *self) { return PyCapsule_GetPointer(self, "arthur.call"); }

PyDoc_STRVAR(residual_doc, "residual(t, y, yp, out)\n--\n\n");
static PyObject *residual(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  Arguments a;
  if (!c || nargs != 4 || unpack(&a, args, c->n, args[3], c->n)) return NULL;
  return released(&a, residual_at(c, a.t, a.y.buf, a.yp.buf, a.out.buf));
}

PyDoc_STRVAR(jacobian_doc, "jacobian(t, y, yp, res, cj, out)\n--\n\n");
static PyObject *jacobian(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  Arguments a;
  double cj;
  if (!c || nargs != 6 || time_of(args[4], &cj)) return NULL;
  if (unpack(&a, args, c->n, args[5], c->place ? c->n * c->n : c->m)) return NULL;
  return released(&a, jacobian_at(c, a.t, a.y.buf, a.yp.buf, cj, c->place, a.out.buf));
}

PyDoc_STRVAR(roots_doc, "roots(t, y, yp, out)\n--\n\n");
static PyObject *roots(PyObject *self, PyObject *const *args, Py_ssize_t nargs) {
  Call *c = call_of(self);
  Arguments a;
  if (!c || nargs != 4 || unpack(&a, args, c->n, args[3], c->places)) return NULL;
  return released(&a, roots_at(c, a.t, a.y.buf, a.yp.buf, a.out.buf));
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
  Py_XDECREF(c->watch);
  Py_XDECREF(c->refresh);
  Py_XDECREF(c->keep);
  PyMem_Free(c);
}

static double *address(unsigned long long a) { return (double *)(uintptr_t)a; }

/* bind(kind, generated, n, m, t, y, yp, cj, value, counts, place, places, zero, modes, externals, count, wanted, tally,
   slow, progress, prepare, watch, refresh, keep): addresses as integers, 0 for none; `keep` holds the arrays. */
static PyObject *bind(PyObject *module, PyObject *args) {
  unsigned long long generated, t, y, yp, cj, value, counts, place, zero, modes, externals, tally;
  Py_ssize_t n, m, places, externals_count;
  int kind, wanted;
  PyObject *slow, *progress, *prepare, *watch, *refresh, *keep;
  if (!PyArg_ParseTuple(args, "iKnnKKKKKKKnKKKniKOOOOOO", &kind, &generated, &n, &m, &t, &y, &yp, &cj, &value, &counts,
                        &place, &places, &zero, &modes, &externals, &externals_count, &wanted, &tally, &slow, &progress,
                        &prepare, &watch, &refresh, &keep))
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
  c->watch = Py_NewRef(watch);
  c->refresh = Py_NewRef(refresh);
  c->keep = Py_NewRef(keep);
  PyObject *capsule = PyCapsule_New(c, "arthur.call", release);
  if (!capsule) return NULL;
  PyObject *function = PyCFunction_NewEx(&functions[kind], capsule, NULL);
  Py_DECREF(capsule);
  return function;
}

/* What IDA has of one engine; the names are those of SUNDIALS. */
typedef struct {
  PyObject *functions[3];
  Call *calls[3];
  int64_t *place; /* of the Jacobian, by columns */
  double *(*N_VGetArrayPointer)(void *);
  double *(*SUNDenseMatrix_Data)(void *);
} Direct;

static int direct_residual(double t, void *y, void *yp, void *r, void *data) {
  Direct *d = data;
  return residual_at(d->calls[0], t, d->N_VGetArrayPointer(y), d->N_VGetArrayPointer(yp), d->N_VGetArrayPointer(r));
}

/* IDA has set the matrix to zero. */
static int direct_jacobian(double t, double cj, void *y, void *yp, void *r, void *matrix, void *data, void *a, void *b,
                           void *c) {
  Direct *d = data;
  (void)r, (void)a, (void)b, (void)c;
  return jacobian_at(d->calls[1], t, d->N_VGetArrayPointer(y), d->N_VGetArrayPointer(yp), cj, d->place,
                     d->SUNDenseMatrix_Data(matrix));
}

static int direct_roots(double t, void *y, void *yp, double *g, void *data) {
  Direct *d = data;
  return roots_at(d->calls[2], t, d->N_VGetArrayPointer(y), d->N_VGetArrayPointer(yp), g);
}

static void release_direct(PyObject *capsule) {
  Direct *d = PyCapsule_GetPointer(capsule, "arthur.direct");
  for (int k = 0; k < 3; k++) Py_XDECREF(d->functions[k]);
  PyMem_Free(d->place);
  PyMem_Free(d);
}

/* attach(engine, residual, jacobian, roots, N_VGetArrayPointer, SUNDenseMatrix_Data, IDASetUserData, IDASetNlsResFn,
   IDASetJacFn, IDARootInit): let IDA call functions of bind directly, roots may be None; the others are addresses. What
   is returned must live as long as the engine; None where its memory is not as expected. */
static PyObject *attach(PyObject *module, PyObject *args) {
  PyObject *engine, *functions[3];
  unsigned long long vector, matrix, set_data, set_residual, set_jacobian, set_roots;
  if (!PyArg_ParseTuple(args, "OOOOKKKKKK", &engine, &functions[0], &functions[1], &functions[2], &vector, &matrix,
                        &set_data, &set_residual, &set_jacobian, &set_roots))
    return NULL;
  /* the fields of a class of Cython stand behind the table of its methods: IDA's memory, SUNDIALS' context */
  void **fields = (void **)((char *)engine + sizeof(PyObject) + sizeof(void *));
  void *ida = fields[0], *context = fields[1];
  if (!ida || !context || *(void **)ida != context) Py_RETURN_NONE; /* the context is what IDA's memory begins with */
  Direct *d = PyMem_Calloc(1, sizeof(Direct));
  if (!d) return PyErr_NoMemory();
  PyObject *capsule = PyCapsule_New(d, "arthur.direct", release_direct);
  for (int k = 0; k < 3; k++) {
    d->functions[k] = Py_NewRef(functions[k]);
    if (functions[k] != Py_None) d->calls[k] = call_of(PyCFunction_GET_SELF(functions[k]));
  }
  const Call *j = d->calls[1];
  d->place = PyMem_Calloc((size_t)j->m, sizeof *d->place);
  for (Py_ssize_t i = 0; i < j->m; ++i) d->place[i] = j->place[i] % j->n * j->n + j->place[i] / j->n;
  d->N_VGetArrayPointer = (double *(*)(void *))(uintptr_t)vector;
  d->SUNDenseMatrix_Data = (double *(*)(void *))(uintptr_t)matrix;
  int failed = ((int (*)(void *, void *))(uintptr_t)set_data)(ida, d);
  failed |= ((int (*)(void *, void *))(uintptr_t)set_residual)(ida, (void *)direct_residual);
  failed |= ((int (*)(void *, void *))(uintptr_t)set_jacobian)(ida, (void *)direct_jacobian);
  if (d->calls[2])
    failed |= ((int (*)(void *, int, void *))(uintptr_t)set_roots)(ida, (int)d->calls[2]->places, (void *)direct_roots);
  if (!failed) return capsule;
  Py_DECREF(capsule);
  PyErr_SetString(PyExc_RuntimeError, "IDA refuses its functions");
  return NULL;
}

static PyMethodDef methods[] = {{"bind", bind, METH_VARARGS, "bind(...) -> callable"},
                                {"attach", attach, METH_VARARGS, "attach(...) -> what keeps the functions alive"},
                                {NULL, NULL, 0, NULL}};
static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, "arthur_native", NULL, -1, methods, NULL, NULL, NULL, NULL};
PyMODINIT_FUNC PyInit_arthur_native(void) { return PyModule_Create(&definition); }
