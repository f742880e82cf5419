"""A program that is loaded once gives in each conversion what the files give afresh."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest

import yamaro
from tests.effort import is_tried
from tests.golden import CASES
from yamaro.rendering import render

AREAS = sorted(path.name for path in CASES.iterdir() if path.is_dir())


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder: Path, text: str, name: str = "robot.yaml") -> str:
    (folder / name).write_text(text, encoding="utf-8")
    return name


class Counting(yamaro.MemoryLoader):
    """Counts how often each file is read."""

    __slots__ = ("times",)

    def __init__(self, files: dict[str, str]) -> None:
        super().__init__(files)
        self.times: dict[str, int] = {}

    def read(self, path: str) -> bytes:
        self.times[path] = self.times.get(path, 0) + 1
        return super().read(path)


# --- the same as from the files ---------------------------------------------------------------


def outcome(build: object, **options: object) -> tuple[object, ...]:
    """Return all that can be seen of a build."""
    messages: list[str] = []
    assert callable(build)
    try:
        result = build(**options, on_message=messages.append)
    except yamaro.YamaroError as error:
        return "failed", [render(d) for d in error.diagnostics], messages
    except yamaro.UsageError as error:
        return "refused", str(error), messages
    told = [render(d) for d in result.warnings]
    return result.xml(), told, result.files, result.meshes, messages


@pytest.mark.parametrize("area", AREAS)
def test_every_case_comes_out_the_same_again_and_again(
    area: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(CASES / area)
    policy = yamaro.Policy("safe" if area == "safe" else "trusted")
    for path in sorted(Path().glob("*.yaml")):
        if not is_tried(f"{area}/{path.stem}", quick=8, usual=3):
            continue
        fresh = outcome(partial(yamaro.build, str(path), policy=policy))
        program = yamaro.Program(str(path), policy=policy)
        strict = outcome(program.build, strict=True)
        assert strict[0] == "failed" or strict == fresh, path
        assert outcome(program.build) == fresh, path
        assert outcome(program.build) == fresh, path


def test_the_example_of_many_files_comes_out_the_same() -> None:
    path = Path(__file__).parent.parent / "examples" / "hexapod" / "hexapod.yaml"
    program = yamaro.load(path)
    for design in ({}, {"tibia_length": 0.2}, {}, {"payload": 2}):
        assert program.convert(**design) == yamaro.convert(path, **design)


# --- what is read once ------------------------------------------------------------------------

CHOICE = {
    "/r/main.yaml": "launch:\n  include: $(part).yaml\n",
    "/r/a.yaml": "model:\n  a: a\n  b: ${x}\n",
    "/r/b.yaml": "model: {b: b}\n",
}


def test_files_are_read_once_and_when_they_are_needed() -> None:
    loader = Counting(CHOICE)
    program = yamaro.load("/r/main.yaml", loader=loader)
    assert loader.times == {"/r/main.yaml": 1}
    for part in ("a", "a", "b", "a", "b"):
        assert f"<{part}>{part}</{part}>" in program.build(variables={"part": part}).xml()
    assert loader.times == {"/r/main.yaml": 1, "/r/a.yaml": 1, "/r/b.yaml": 1}


def test_each_conversion_warns_of_the_files_it_runs() -> None:
    program = yamaro.load("/r/main.yaml", loader=yamaro.MemoryLoader(CHOICE))
    counts = [len(program.build(variables={"part": part}).warnings) for part in "abab"]
    assert counts == [1, 0, 1, 0]


def test_a_file_that_was_missing_or_faulty_is_looked_at_again() -> None:
    loader = yamaro.MemoryLoader(CHOICE)
    program = yamaro.load("/r/main.yaml", loader=loader)
    for text in (None, "model: {a: $(1 +)}\n"):
        if text is not None:
            loader.files["/r/c.yaml"] = text
        with pytest.raises(yamaro.YamaroError):
            program.build(variables={"part": "c"})


def test_changes_on_the_disk_are_seen_by_the_next_load(folder: Path) -> None:
    file = write(folder, "import: own\nlaunch: {a: $(own.number)}\n")
    (folder / "own.py").write_text("number = 1\n")
    program = yamaro.load(file)
    before = program.convert()
    write(folder, "import: own\nlaunch: {changed: $(own.number)}\n")
    (folder / "own.py").write_text("number = 2\n")
    assert program.convert() == before
    assert "<changed>2</changed>" in yamaro.load(file).convert()


# --- what begins anew -------------------------------------------------------------------------


def test_what_a_conversion_sets_is_gone_in_the_next(folder: Path) -> None:
    (folder / "own.py").write_text("seen = []\n")
    file = write(
        folder,
        "import: own\n"
        "variables: {n/global: 0, list: [1]}\n"
        "process: |\n  n += 1\n  own.seen.append(n)\n  list.append(2)\n  extra = 5\n"
        "launch: {a: $(n), b: $(own.seen), c: $(list)}\n",
    )
    program = yamaro.load(file)
    assert program.convert() == program.convert() == yamaro.convert(file)


def test_what_is_read_late_means_in_each_conversion_what_it_is(folder: Path) -> None:
    file = write(
        folder,
        "functions:\n"
        "  Call: {body: {called: }}\n"
        "  Value: {input: Given, body: {value: $(Given(unseen))}}\n"
        "launch:\n"
        "  $(key): {a: $(1 / 0)}\n"
        "  Value: {Given: '$(lambda x: 1 / x)'}\n",
    )
    program = yamaro.load(file)
    for key in ("Call", "Nowhere", "Call", "plain", "Call"):
        for unseen in (0, 1):
            words = [f"key:={key}", f"unseen:={unseen}"]
            expected = outcome(lambda words=words, **o: yamaro.build(file, command_line=words, **o))
            assert outcome(program.build, command_line=words) == expected


def test_a_strict_build_leaves_the_warnings_of_others_alone(folder: Path) -> None:
    program = yamaro.load(write(folder, "launch:\n  a: ${x}\n"))
    first = program.build()
    with pytest.raises(yamaro.YamaroError):
        program.build(strict=True)
    assert [d.severity for d in first.warnings + program.build().warnings] == ["warning"] * 2


def test_the_tree_of_a_build_is_its_own(folder: Path) -> None:
    program = yamaro.load(write(folder, "launch: {a/b=1: {c: text}}\n"))
    before = program.convert()
    element = program.build().root.elements()[0]
    element.attributes["b"] = "2"
    element.children.clear()
    assert program.convert() == before


# --- errors and warnings ----------------------------------------------------------------------


def test_loading_tells_errors_of_the_main_file(folder: Path) -> None:
    file = write(folder, "launch:\n  a: ${x}\n  b: $(1 +)\n")
    with pytest.raises(yamaro.YamaroError) as loaded:
        yamaro.load(file)
    with pytest.raises(yamaro.YamaroError) as built:
        yamaro.build(file)
    assert str(loaded.value) == str(built.value)
    assert [d.code for d in loaded.value.diagnostics] == ["xacro-syntax", "python-syntax"]


def test_loading_runs_nothing(folder: Path) -> None:
    yamaro.load(
        write(folder, "import: nowhere\nprocess: open('ran', 'w')\nlaunch: {a: $(1 / 0)}\n")
    )
    assert not os.path.exists("ran")


def test_a_missing_main_file_is_a_file_not_found_error(folder: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"nowhere\.yaml"):
        yamaro.load("nowhere.yaml")


def test_a_malformed_assignment_is_a_value_error(folder: Path) -> None:
    program = yamaro.load(write(folder, "launch: {a: $(n)}\n"))
    with pytest.raises(ValueError, match="n=1"):
        program.convert("n=1")


def test_warnings_are_issued_and_point_at_the_caller(folder: Path) -> None:
    program = yamaro.load(write(folder, "launch:\n  a: ${x}\n"))
    for _ in range(2):
        with pytest.warns(yamaro.YamaroWarning, match="xacro-syntax") as caught:
            program.convert()
        assert [warning.filename for warning in caught] == [__file__]


# --- threads ----------------------------------------------------------------------------------


def test_threads_may_share_a_program(folder: Path) -> None:
    (folder / "own.py").write_text("count = 0\n")
    write(folder, "model:\n  for: {iterator: i, range: n, body: {a/b=$(i): $(n)}}\n", "part.yaml")
    file = write(
        folder,
        "import: own\n"
        "variables: {total/global: 0}\n"
        "functions: {F: {input: N, body: {process: 'total += N; own.count += N'}}}\n"
        "launch:\n"
        "  for: {iterator: i, range: 30, body: {F: {N: $(n)}}}\n"
        "  include: {path: part.yaml, n: $(n)}\n"
        "  sum: $(total) $(own.count)\n",
    )
    sizes = [n % 7 for n in range(100)]
    expected = [yamaro.convert(file, n=n) for n in sizes]
    program = yamaro.load(file)
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda n: program.convert(n=n), sizes)) == expected
