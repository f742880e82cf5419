"""The part of numpy that safe mode has: that legal code gives what numpy gives, to the byte.

The attacks on it are in tests/hostile/escapes/numpy.txt, and run by tests/safe/test_code.py.
"""

from __future__ import annotations

import math
import statistics
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import yamaro
from tests.effort import examples
from yamaro.safe.code import compile_safe
from yamaro.safe.limits import SafetyError
from yamaro.safe.methods import CHANGING, READING
from yamaro.safe.runtime import SafeRuntime
from yamaro.safe.values import Foreign, Module

np = pytest.importorskip("numpy")
VERSION = tuple(map(int, np.__version__.split(".")[:2]))
IS_OLD = VERSION < (2, 0)
IS_RAGGED = VERSION < (1, 24)

from yamaro.safe import numpy as safe_numpy  # noqa: E402
from yamaro.safe.arrays import Array, Number, Whole, broadcast, extent  # noqa: E402
from yamaro.safe.numpy import FUNCTIONS, LINEAR_ALGEBRA  # noqa: E402

REPOSITORY = Path(__file__).parents[2]
HOSTILE = REPOSITORY / "tests" / "hostile"
MODULES = ("math", "statistics")


def values() -> dict[str, Any]:
    """Return the variables that the expressions use, new each time."""
    return {
        "a": np.array([1, 2, 3]),
        "b": np.array([0.5, 1.25, -2.0]),
        "m": np.array([[1, 2], [3, 4]]),
        "R": np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
        "i": 7,
        "x": 0.25,
    }


def safely(text: str, mode: str = "eval") -> tuple[Any, str]:
    """Return the value and the text of an expression in safe mode, or the names afterwards."""
    runtime = SafeRuntime()
    names = runtime.names() | {name: runtime.module(name) for name in MODULES}
    names["np"] = runtime.module("numpy")
    scope = {"__builtins__": names, **{name: runtime.admit(v) for name, v in values().items()}}
    code = runtime.bind(compile_safe(text, "<test>", mode))
    if mode == "eval":
        value = eval(code, scope, scope)
        return bare(value), runtime.text(value)
    exec(code, scope, scope)
    del scope["__builtins__"]
    return bare(scope), ""


def plainly(text: str, mode: str = "eval") -> tuple[Any, str]:
    """Return the same from Python and numpy as they are."""
    scope = {"np": np, "math": math, "statistics": statistics, **values()}
    if mode == "eval":
        value = eval(text, scope, scope)
        return value, str(value)
    exec(text, scope, scope)
    hidden = ("np", "math", "statistics", "__builtins__")
    return {name: value for name, value in scope.items() if name not in hidden}, ""


def bare(value: Any) -> Any:
    """Return a value with numpy's own objects in place of what stands for them."""
    if isinstance(value, Foreign):
        assert type(value) in (Array, Number, Whole)
        return value.data
    if type(value) in (list, tuple):
        return type(value)(map(bare, value))
    if type(value) is dict:
        return {bare(key): bare(inner) for key, inner in value.items()}
    assert not type(value).__module__.startswith("numpy")
    return value


def seen(value: Any) -> Any:
    """Return all that can be told of a value: its type, and that of its numbers, and its bytes."""
    if isinstance(value, (np.ndarray, np.generic)):
        return type(value), value.dtype.str, value.shape, value.tobytes()
    if type(value) in (list, tuple):
        return type(value), [seen(inner) for inner in value]
    if type(value) is dict:
        return [(seen(key), seen(inner)) for key, inner in value.items()]
    return type(value), repr(value)


def lines_of(name: str) -> list[str]:
    return (HOSTILE / name).read_text(encoding="utf-8").splitlines()


EXPRESSIONS = lines_of("legal-numpy.txt")
STATEMENTS = lines_of("legal-numpy-statements.txt")


def is_missing(error: BaseException) -> bool:
    """Tell whether an old numpy does not have what an expression needs."""
    return IS_OLD and isinstance(error, (AttributeError, TypeError))


def check_same(text: str, mode: str) -> None:
    if not text.startswith("! "):
        try:
            expected, expected_text = plainly(text, mode)
        except Exception as error:
            if is_missing(error):
                pytest.skip("not in this version of numpy")
            raise
        found, found_text = safely(text, mode)
        assert seen(found) == seen(expected)
        assert found_text == expected_text
        return
    if "[[1, 2], [3]]" in text or "[1, [2]]" in text:
        if IS_RAGGED:
            pytest.skip("this version of numpy makes it an array of objects")
    expected_error = error_of(plainly, text[2:], mode)
    found_error = error_of(safely, text[2:], mode)
    assert not issubclass(found_error, SafetyError)
    # Where numpy raises a subclass of an error of Python, Python's own may come.
    assert issubclass(expected_error, found_error)


def error_of(run: Any, text: str, mode: str) -> type[BaseException]:
    try:
        run(text, mode)
    except Exception as error:
        return type(error)
    pytest.fail("it raises no error")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("text", EXPRESSIONS)
def test_legal_expressions_give_what_numpy_gives(text: str) -> None:
    check_same(text, "eval")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("text", STATEMENTS)
def test_legal_statements_do_what_they_do_with_numpy(text: str) -> None:
    check_same(text, "exec")


def test_every_function_and_method_is_tried() -> None:
    tried = "\n".join((*EXPRESSIONS, *STATEMENTS))
    runtime = SafeRuntime()
    members = runtime.module("numpy").members
    names = [f"np.{name}" for name in members if type(members[name]) is not Module]
    names += [f"np.linalg.{name}" for name in members["linalg"].members]
    newer = {"np.acos", "np.acosh", "np.asin", "np.asinh", "np.atan", "np.atan2", "np.atanh"}
    newer |= {"np.pow"}  # other names of old functions
    names += [f".{name}(" for name in READING[Array]]
    assert [name for name in names if name not in tried and name not in newer] == []
    assert len(names) > 180


# --- random expressions -----------------------------------------------------------------------

LEAVES = st.sampled_from(
    "1 2.5 -3 True 0 i x a b m R a[0] b[1] m[0] R[:2,:2] np.float64(0.1) np.int64(5) [1,2,3] "
    "(0.5,2) np.pi np.bool_(1) np.zeros((0,3)) np.array(2.5) a[:,None] range(3) [] 1j".split()
)


def combine(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from("+ - * / // % ** @ & | ^ << >> < <= > >= == != in".split())
    functions = st.sampled_from(
        "np.sin np.sqrt np.abs np.sum np.mean np.array np.asarray np.round np.max np.argmax "
        "np.sort np.cumsum np.transpose np.ravel np.isnan np.sign np.diag np.median np.trace "
        "np.flip np.linalg.norm np.linalg.det np.atleast_2d np.unique np.diff np.std np.where "
        "np.any abs len float int bool str repr sum max sorted list tuple round "
        "np.float64 np.int64".split()
    )
    of_two = st.sampled_from(
        "np.dot np.cross np.outer np.add np.arctan2 np.maximum np.isclose np.hypot np.append "
        "np.matmul np.inner np.power np.kron np.multiply divmod np.full_like".split()
    )
    methods = st.sampled_from(
        "sum() T shape min() mean() tolist() copy() reshape(-1) ravel() round(1) any() item() "
        "astype(int) astype(float) size ndim real imag std() argmin() cumsum() transpose() "
        "clip(0,1) dot(a) squeeze() conj() max(0)".split()
    )
    indices = st.sampled_from(
        "0 -1 1: ::-1 :,0 None [0,1] a[:1]-1 0,0 ...,0 1:,None (0,) a>1".replace("...,", "").split()
    )
    return st.one_of(
        st.tuples(inner, operators, inner).map(lambda t: f"({t[0]} {t[1]} {t[2]})"),
        st.tuples(functions, inner).map(lambda t: f"{t[0]}({t[1]})"),
        st.tuples(of_two, inner, inner).map(lambda t: f"{t[0]}({t[1]}, {t[2]})"),
        st.tuples(inner, methods).map(lambda t: f"({t[0]}).{t[1]}"),
        st.tuples(inner, indices).map(lambda t: f"({t[0]})[{t[1]}]"),
        st.tuples(inner, inner).map(lambda t: f"[{t[0]}, {t[1]}]"),
        st.tuples(inner, inner).map(lambda t: f"np.stack([{t[0]}, {t[1]}])"),
        st.tuples(inner, inner).map(lambda t: f"np.concatenate(({t[0]}, {t[1]}))"),
        st.tuples(st.sampled_from("-+~"), inner).map("".join),
        inner.map(lambda t: f"[k for k in {t}]"),
        inner.map(lambda t: f"f'{{{t}}} {{{t}!r}}'" if "'" not in t else t),
        inner.map(lambda t: f"({t} if {t} else 0)"),
    )


REFUSED_ON_PURPOSE = (
    "an array of more than",
    "an item of a number",
    "comparing an array with",
    "the attribute `",
    "the method `",
    "in numpy",
    "a whole number of more than 64 bits",
    "a truth value as an index",
    "such an index",
    "a slice in several dimensions",
    "as this argument",
    "an array of the type",
    "so many arguments",
    "formatting a text",
    "a value of the type",
)


@pytest.mark.filterwarnings("ignore")
@settings(max_examples=examples(300))
@given(st.recursive(LEAVES, combine, max_leaves=6))
def test_random_expressions_give_what_numpy_gives(text: str) -> None:
    try:
        expected = plainly(text)
    except (SyntaxError, MemoryError):
        return
    except Exception:
        assert error_of(safely, text, "eval")
        return
    refusal = None
    try:
        found = safely(text)
    except SafetyError as error:
        refusal = error
    if refusal is not None:
        is_meant = any(words in refusal.construct for words in REFUSED_ON_PURPOSE)
        assert is_meant or refusal.code.startswith("limit-")
        return
    assert seen(found[0]) == seen(expected[0])
    assert found[1] == expected[1]


# --- the wrappers ------------------------------------------------------------------------------


def test_every_operator_of_numpy_is_ours_or_not_there() -> None:
    ours = set(dir(Array)) | set(dir(Number))
    numbers = {name for kind in (int, float, list) for name in dir(kind) if name[:2] == "__"}
    theirs = {name for name in dir(np.ndarray) if name in numbers} - set(dir(object))
    # An item is not deleted, nothing is repeated or joined: these are methods of lists.
    assert theirs - ours <= {"__delitem__", "__class_getitem__"}


def test_nothing_of_numpys_is_inherited() -> None:
    for kind in (Array, Number, Whole):
        assert not issubclass(kind, (np.ndarray, np.generic))
        assert kind.__module__ == "numpy"  # the writer of XML asks


def test_numpy_itself_leaves_operators_to_us() -> None:
    array = SafeRuntime().admit(np.array([1.0]))
    with pytest.raises(TypeError, match="does not support ufuncs"):
        np.sin(array)
    for other in (np.float64(1), np.ones(1)):
        with pytest.raises(TypeError, match="unsupported operand"):
            other * array


def test_arrays_from_outside_are_copied() -> None:
    original = np.array([1.0, 2.0])
    admitted = SafeRuntime().admit(original)
    admitted[0] = 5
    assert original.tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    "value",
    [
        np.array(["a"]),
        np.array([None]),
        np.array([1, [2]], dtype=object),
        np.str_("a"),
        np.datetime64(1, "s"),
        np.zeros(2, dtype=[("a", int)]),
        np.dtype(int),
        np.sin,
        [np.zeros(2)],
        {"a": np.float64(1)},
        np.zeros((1,) * 5),
        np.ma.array([1]),
        np.float64,
    ],
)
def test_other_things_of_numpys_are_not_let_in(value: Any) -> None:
    with pytest.raises(SafetyError):
        SafeRuntime().admit(value)


def test_a_large_array_from_outside_is_not_let_in() -> None:
    with pytest.raises(SafetyError, match="1,000,001 numbers"):
        SafeRuntime().admit(np.zeros(1_000_001))


@pytest.mark.parametrize(
    ("shapes", "expected"),
    [
        ([(3,), (2, 3)], (2, 3)),
        ([(4, 1), (3,)], (4, 3)),
        ([(), (2,)], (2,)),
        ([], ()),
        ([(1,), (7, 1, 5), (6, 1)], (7, 6, 5)),
    ],
)
def test_the_shape_of_a_result_is_foretold(shapes: Any, expected: Any) -> None:
    assert broadcast(*shapes) == expected == np.broadcast_shapes(*shapes)


def test_an_array_without_numbers_is_as_large_as_what_it_may_become() -> None:
    assert extent((0, 1000)) == 1000
    assert extent((3, 4)) == 12
    assert extent(()) == 1


# --- warnings, files ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("np.array([1.0]) / 0", "divide by zero encountered in divide"),
        ("np.float64(1) / 0", "divide by zero encountered in scalar divide"),
        ("np.log(-1.0)", "invalid value encountered in log"),
    ],
)
def test_warnings_name_the_place_in_the_file(text: str, words: str) -> None:
    if IS_OLD:
        words = words.replace("scalar divide", "")
    with pytest.warns(RuntimeWarning, match=words) as plain:
        eval(compile(text, "<test>", "eval"), {"np": np})
    with pytest.warns(RuntimeWarning, match=words) as safe:
        safely(text)
    assert [str(one.message) for one in safe] == [str(one.message) for one in plain]
    assert [(one.filename, one.lineno) for one in safe] == [("<test>", 1)]


def test_warnings_that_are_off_stay_off() -> None:
    with np.errstate(all="ignore"), warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        safely("np.array([1.0]) / 0")
    assert caught == []


def test_errors_of_the_floating_point_unit_that_are_asked_for_come() -> None:
    with np.errstate(divide="raise"), pytest.raises(FloatingPointError):
        safely("np.array([1.0]) / 0")


FILE = """
import: [numpy as np, from numpy import sin, numpy.linalg as la]
variables:
  R: $(np.array([[0, -1.0], [1, 0]]))
model:
  process: |
    v = R @ [1, 2]
    v[0] += 1 / 3
    R[:, 1] = v
  link/name=a:
    pose: $(v)
    matrix: $(R)
    norm: $(la.norm(v)) $(sin(0.5)) $(v > 0) $(v[0] > 5)
    numbers: $(np.int64(5) // 2) and $(v) $(np.array(1.5)) $([v[0], 1])
    nothing: $(np.nan)
  for:
    iterator: k
    in: $(R @ R)
    body:
      row/name=$(k[0]): $(k)
  for:
    iterator: [k, l]
    in: $(R)
    body:
      pair: $(k) $(l)
  for:
    iterator: k
    range: $(np.int64(2)), $(np.argmax([1, 5, 3]) + 3)
    body:
      turn: $(k)
  if:
    condition: $(v[0] < 0)
    body:
      negative: 1
  print: $(v) $(R) $(np.float64(1)) $(np.array([True])) $([v])
"""


def test_a_file_gives_the_same_in_safe_mode() -> None:
    outputs = {}
    for mode in ("trusted", "safe"):
        said: list[str] = []
        policy = yamaro.Policy(mode)
        built = yamaro.build("robot.yaml", text=FILE, policy=policy, on_message=said.append)
        outputs[mode] = (built.xml(), said)
    assert outputs["safe"] == outputs["trusted"]
    assert "-1.66666666666667 1.0" in outputs["safe"][0]
    printed = "[-1.6666666666666667, 1.0] [[0.0, -1.6666666666666667], [1.0, 1.0]] 1.0 [True]"
    assert outputs["safe"][1] == [f"{printed} [array([-1.66666667,  1.        ])]"]


def test_only_files_that_import_numpy_load_it() -> None:
    script = (
        "import sys, yamaro\n"
        "from yamaro.safe.runtime import SafeRuntime\n"
        "runtime = SafeRuntime()\n"
        "runtime.module('math'), runtime.admit([1.5])\n"
        "print('numpy' in sys.modules)\n"
        "runtime.module('numpy')\n"
        "print('numpy' in sys.modules)\n"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["False", "True"]


def test_without_numpy_the_error_is_that_of_trusted_mode(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in list(sys.modules):
        if name == "numpy" or name.startswith("yamaro.safe."):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "numpy", None)
    from yamaro.safe.runtime import SafeRuntime as Fresh

    with pytest.raises(Exception, match="the Python module 'numpy' is not found") as caught:
        Fresh().module("numpy")
    assert getattr(caught.value, "code", None) == "unknown-module"


def test_a_name_that_is_not_there_suggests_one_that_is() -> None:
    with pytest.raises(SafetyError) as caught:
        safely("np.linspac(0, 1, 3)")
    assert "linspace" in str(caught.value.hint)


def test_the_documentation_lists_every_name() -> None:
    page = (REPOSITORY / "docs" / "safety.md").read_text(encoding="utf-8")
    words = set(page.replace("`", " ").split())
    tables = (FUNCTIONS, LINEAR_ALGEBRA, safe_numpy.CONSTANTS)
    names = [name for table in tables for name in table] + list(safe_numpy.TYPES)
    names += list(READING[Array]) + list(CHANGING[Array])
    assert [name for name in names if name not in words] == []
