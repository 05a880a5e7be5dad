"""Kernels on pinned arrays, and compiled functions against the virtual machine, bit by bit."""

from __future__ import annotations

import gc
import subprocess
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

from arthur_acausal.codegen import kernel
from arthur_acausal.codegen.cache import Cache
from arthur_acausal.codegen.kernel import Kernel, c_source, compile_functions, compiler
from arthur_acausal.errors import ArthurError, UsageError

needs_compiler = pytest.mark.skipif(compiler() is None, reason="needs a C compiler")


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


def system(n: int = 30) -> list[ca.Function]:
    """A residual of every common operation, its Jacobian and a few roots."""
    x, p, empty = ca.SX.sym("x", n), ca.SX.sym("p", 3), ca.SX.sym("e", 0)
    rows = []
    for i in range(n):
        a, b = x[i], x[(i + 1) % n]
        rows.append(p[0] * ca.sqrt(ca.fabs(a) + 1) * ca.tanh(b) + ca.if_else(a < b, a**2, ca.exp(-b)))
        rows[-1] += ca.fmin(a, b) / (p[1] ** 2 + ca.fmax(a, 0.1)) ** 0.25 - ca.sin(p[2] * a) + ca.sign(b)
    residual = ca.vertcat(*rows)
    names = ["x", "p", "e"]
    return [
        ca.Function("residual", [x, p, empty], [residual], names, ["r"]),
        ca.Function("jacobian", [x, p, empty], [ca.jacobian(residual, x)], names, ["J"]),
        ca.Function("roots", [x, p, empty], [x[:2] - p[:2], ca.SX(0, 1)], names, ["g", "none"]),
    ]


def arguments(n: int = 30) -> list[np.ndarray[tuple[int], np.dtype[np.float64]]]:
    random = np.random.default_rng(1)
    return [random.normal(size=n), random.random(3) + 0.5, np.zeros(0)]


def test_inputs_are_read_where_they_are() -> None:
    x = ca.SX.sym("x", 2)
    values = np.array([1.0, 2.0])
    square = Kernel(ca.Function("square", [x], [x**2]), [values])
    assert square().tolist() == [1.0, 4.0]
    values[:] = 3.0, 4.0
    result = square()
    assert result is square.outputs[0]
    assert square.outputs[0].tolist() == [9.0, 16.0]


def test_sparse_results_come_column_by_column_and_several_as_a_tuple() -> None:
    x = ca.SX.sym("x", 2)
    matrix = ca.SX(2, 2)
    matrix[0, 0], matrix[0, 1], matrix[1, 1] = x[0], x[1], 7
    both = Kernel(ca.Function("both", [x], [matrix, ca.sum1(x)]), [np.array([1.0, 2.0])])
    both()
    first, second = both.outputs
    assert first.tolist() == [1.0, 2.0, 7.0]
    assert second.tolist() == [3.0]


def test_everything_a_kernel_needs_stays_alive() -> None:
    def make() -> Kernel:
        x = ca.SX.sym("x", 1000)
        return Kernel(ca.Function("twice", [x], [2 * x]), [np.ones(1000)])

    kernels = [make() for _ in range(20)]
    gc.collect()
    assert all((k() == 2.0).all() for k in kernels)


@pytest.mark.parametrize(
    "array",
    [
        np.zeros(1),
        np.zeros(3),
        np.zeros(2, dtype=np.float32),
        np.zeros(2, dtype=np.int64),
        np.zeros(4)[::2],
        [0.0, 0.0],
    ],
)
def test_array_that_does_not_fit_is_refused(array: object) -> None:
    x = ca.SX.sym("x", 2)
    f = ca.Function("f", [x], [x], ["x"], ["y"])
    with pytest.raises(ValueError, match="input x of f needs"):
        Kernel(f, [array])  # type: ignore[list-item]
    with pytest.raises(ValueError, match="1 inputs, not 0"):
        Kernel(f, [])


@needs_compiler
def test_failure_of_an_external_function_is_raised(tmp_path: Path) -> None:
    source, library = tmp_path / "bad.c", tmp_path / "bad.so"
    source.write_text(
        "static const long long s[3] = {1, 1, 1};\n"
        "int bad(const double** arg, double** res, long long* iw, double* w, int mem) "
        "{ res[0][0] = arg[0][0]; return arg[0][0] > 5; }\n"
        "long long bad_n_in(void) { return 1; }\nlong long bad_n_out(void) { return 1; }\n"
        "const long long* bad_sparsity_in(long long i) { return s; }\n"
        "const long long* bad_sparsity_out(long long i) { return s; }\n"
    )
    subprocess.run([*(compiler() or ()), "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    value = np.array([1.0])
    bad = Kernel(ca.external("bad", str(library)), [value])
    assert bad() == 1.0
    value[0] = 6.0
    with pytest.raises(RuntimeError, match="bad reports failure 1"):
        bad()


@needs_compiler
def test_compiled_functions_agree_to_the_last_bit(cache: Cache) -> None:
    functions, inputs = system(), arguments()
    compiled = compile_functions(functions, mode="always", cache=cache)
    for plain, fast in zip(functions, compiled, strict=True):
        assert fast.is_a("External")
        assert fast.sparsity_out(0) == plain.sparsity_out(0)
        slow, quick = Kernel(plain, inputs), Kernel(fast, inputs)
        slow()
        quick()
        assert all((a == b).all() for a, b in zip(slow.outputs, quick.outputs, strict=True))
    poisoned = arguments()
    poisoned[0][0] = np.nan
    slow, quick = Kernel(functions[0], poisoned), Kernel(compiled[0], poisoned)
    np.testing.assert_array_equal(slow(), quick())


@needs_compiler
def test_second_time_comes_from_the_cache(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    compile_functions(system(), mode="always", cache=cache)
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: pytest.fail("compiled again"))
    again = compile_functions(system(), mode="always", cache=cache)
    result = Kernel(again[0], arguments())()
    np.testing.assert_array_equal(result, Kernel(system()[0], arguments())())


@needs_compiler
def test_several_units_are_compiled_at_once(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: 3)
    monkeypatch.setattr(kernel, "_UNIT", 10)
    compiled = compile_functions(system(), mode="always", cache=cache)
    assert len(list(cache.directory.glob("*.so"))) == 3
    for plain, fast in zip(system(), compiled, strict=True):
        slow, quick = Kernel(plain, arguments()), Kernel(fast, arguments())
        slow()
        quick()
        np.testing.assert_array_equal(slow.outputs[0], quick.outputs[0])


@needs_compiler
def test_absent_array_is_a_failure_not_a_crash(cache: Cache) -> None:
    (residual, *_) = compile_functions(system(), mode="always", cache=cache)
    buffer, trigger = residual.buffer()
    trigger()
    assert buffer.ret() == 1


def test_straightened_code_tests_each_array_once() -> None:
    source = c_source(system())
    assert "? arg[" not in source
    assert "if (res[0]!=0)" not in source
    assert source.count(") return 1;") == 3


def test_code_that_calls_other_functions_is_left_as_it_is() -> None:
    x = ca.MX.sym("x", 30)
    (residual, *_) = system()
    outer = ca.Function("outer", [x], [residual(x, ca.DM([1, 2, 3]), ca.DM(0, 1))])
    assert "if (res[0]!=0)" in c_source([outer])
    assert compile_functions([outer], mode="always") == [outer]


def test_never_and_too_small_and_too_large_stay_as_they_are(cache: Cache) -> None:
    functions = system()
    assert compile_functions(functions, mode="never", cache=cache) == functions
    assert compile_functions(functions[2:], mode="auto", cache=cache) == functions[2:]
    large = system(400)
    assert sum(f.n_instructions() for f in large) > kernel.MOST
    assert compile_functions(large, mode="auto", cache=cache) == large
    assert not cache.directory.exists()


@needs_compiler
def test_auto_compiles_what_is_worth_it(cache: Cache) -> None:
    assert all(f.is_a("External") for f in compile_functions(system(), cache=cache))


@needs_compiler
def test_more_is_compiled_for_long_runs(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    functions = system()
    monkeypatch.setattr(kernel, "MOST", sum(f.n_instructions() for f in functions) - 1)
    assert compile_functions(functions, cache=cache) == functions
    assert all(f.is_a("External") for f in compile_functions(functions, long_runs=True, cache=cache))
    assert all(f.is_a("External") for f in compile_functions(functions, mode="often", cache=cache))


def test_without_a_compiler(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.setenv("CC", "no-such-compiler")
    functions = system()
    assert compile_functions(functions, mode="auto", cache=cache) == functions
    with pytest.raises(UsageError, match="no C compiler"):
        compile_functions(functions, mode="always", cache=cache)


def test_compiler_that_fails(
    cache: Cache, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv("CC", "false --really")
    functions = system()
    assert compile_functions(functions, mode="auto", cache=cache) == functions
    assert "going on with the virtual machine" in caplog.text
    with pytest.raises(ArthurError, match="cannot be used"):
        compile_functions(functions, mode="always", cache=cache)


@needs_compiler
def test_cache_that_cannot_be_written(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "file").touch()
    cache = Cache(tmp_path / "file")
    (residual, *_) = compile_functions(system(), mode="always", cache=cache)
    np.testing.assert_array_equal(Kernel(residual, arguments())(), Kernel(system()[0], arguments())())
    assert "going on without" in caplog.text
