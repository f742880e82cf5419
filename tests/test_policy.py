"""How far a file is trusted: modes, limits, time-outs and what may be read, from the API down."""

from __future__ import annotations

import inspect
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.waiting import PATIENCE
from yamaro import Policy, YamaroError, confined, pipeline
from yamaro.commands.main import main
from yamaro.policy import Limits, limit_names, limit_range
from yamaro.sandbox import jail
from yamaro.sandbox.jail import JailLimits

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")
COMMAND = [sys.executable, "-m", "yamaro"]


def write(folder: Path, text: str, name: str = "robot.yaml") -> str:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def codes(path: str, policy: Policy) -> list[str]:
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, policy=policy)
    return [diagnostic.code for diagnostic in caught.value.diagnostics]


# --- policies -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (["trust"], {}, "unknown mode 'trust'; the modes are trusted, jail, safe"),
        (["safe"], {"limits": {"step": 1}}, "unknown limit 'step'"),
        (
            ["safe"],
            {"limits": {"steps": 0}},
            "the limit 'steps' is a whole number from 1 to 1,125,899,906,842,624",
        ),
        (
            ["safe"],
            {"limits": {"steps": True}},
            "the limit 'steps' is a whole number from 1 to 1,125,899,906,842,624",
        ),
        (["safe"], {"limits": {"xml_depth": 2.5}}, "the limit 'xml-depth' is a whole number"),
        (["trusted"], {"limits": {"steps": 9}}, "the limit 'steps' applies only in safe mode"),
        (["jail"], {"timeout": 0}, "a time-out is a number of seconds greater than 0"),
        (["jail"], {"timeout": float("nan")}, "a time-out is a number of seconds greater than 0"),
        (["jail"], {"timeout": float("inf")}, "a time-out is a number of seconds greater than 0"),
    ],
)
def test_a_policy_that_makes_no_sense_is_refused(
    arguments: list[str], options: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Policy(*arguments, **options)


def test_what_is_not_trusted_has_a_time() -> None:
    assert Policy().timeout is None
    assert Policy("safe").timeout == Policy("jail").timeout == 60
    assert Policy("safe", timeout=5).timeout == Policy(timeout=5).timeout == 5


def test_every_limit_is_described_and_named() -> None:
    documented = inspect.cleandoc(Limits.__doc__ or "")  # Python 3.13 takes the indent out
    for name in Limits.__slots__:
        assert f"\n    {name}: " in documented
        assert name.replace("_", "-") in limit_names()
        assert getattr(Limits("safe"), name) > 0


def test_each_limit_can_be_set() -> None:
    for name in Limits.__slots__:
        least, most = limit_range(name)
        for value in (least, least + 6, most):
            assert getattr(Limits("safe", **{name: value}), name) == value
        for value in (least - 1, most + 1, 10**30):
            with pytest.raises(ValueError, match=f"whole number from {least:,} to {most:,}$"):
                Limits("safe", **{name: value})


@pytest.mark.parametrize("mode", ["trusted", pytest.param("jail", marks=needs_jail), "safe"])
@pytest.mark.parametrize("name", ["file", "memory", "output", "text", "xml-depth"])
def test_a_robot_is_built_with_the_largest_value_of_each_limit(
    name: str, mode: str, tmp_path: Path
) -> None:
    path = write(tmp_path, "robot: r\nmodel:\n  link/name=a:\n")
    most = limit_range(name)[1]
    words = [*COMMAND, path, "--limit", f"{name}={most}", f"--{mode}".replace("trusted", "trust")]
    done = subprocess.run(words, capture_output=True, check=False, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, b"")


@needs_jail
def test_a_jail_works_with_the_least_memory(tmp_path: Path) -> None:
    path = write(tmp_path, "robot: r\nmodel:\n  link/name=a:\n")
    least = limit_range("memory")[0]
    words = [*COMMAND, path, "--limit", f"memory={least}", "--jail"]
    done = subprocess.run(words, capture_output=True, check=False, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize("mode", ["trusted", "safe"])
@pytest.mark.parametrize(
    ("name", "text"),
    [("r.urdf", "<a>" * 4999 + "</a>" * 4999), ("r.yaml", "a: " + "{a: " * 4998 + "}" * 4998)],
)
def test_the_deepest_files_that_a_limit_can_allow_are_built(
    name: str, text: str, mode: str, tmp_path: Path
) -> None:
    path = write(tmp_path, text, name)
    policy = Policy(mode, limits={"xml-depth": 5000, "yaml-depth": 5000})
    assert (
        yamaro.build(path, policy=policy).xml().count("<a>")
        == text.count("a") // (2 if name == "r.urdf" else 1) - 1
    )


# --- time ---------------------------------------------------------------------------------------

ENDLESS = "process: |\n  while True: 1\nout: null\n"
LONG_CALL = "out: $(sum(range(10**12)))\n"


@pytest.mark.usefixtures("untraced")
@pytest.mark.parametrize("mode", ["trusted", pytest.param("jail", marks=needs_jail)])
def test_an_endless_loop_is_shown_where_it_is(
    tmp_path: Path, mode: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(confined, "GRACE", PATIENCE)  # it ends by itself
    path = write(tmp_path, ENDLESS)
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, policy=Policy(mode, timeout=1))
    (found,) = caught.value.diagnostics
    assert found.code == "limit-time"
    assert found.span.location()[0] == 2


@needs_jail
def test_a_long_call_is_ended_with_its_jail(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(confined, "GRACE", 0.2)
    assert codes(write(tmp_path, LONG_CALL), Policy("jail", timeout=0.2)) == ["limit-time"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only there it is promised")
def test_a_long_call_is_ended_in_trusted_mode_too(tmp_path: Path) -> None:
    path = write(tmp_path, LONG_CALL)
    finished = subprocess.run(
        [*COMMAND, "--timeout", "0.2", path, "-o", str(tmp_path / "out.urdf")],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert finished.returncode == -15
    assert finished.stderr.startswith("error[limit-time]: timed out: this takes more than")
    assert finished.stdout == ""
    assert os.listdir(tmp_path) == ["robot.yaml"]


def test_a_time_out_does_not_hold_up_who_reads_the_output(tmp_path: Path) -> None:
    path = write(tmp_path, "out: 1\n")
    command = [*COMMAND, "--timeout", str(100 * PATIENCE), path]
    xml = subprocess.check_output(command, text=True, timeout=PATIENCE)
    assert xml.endswith("<out>1</out>\n")


# --- memory -------------------------------------------------------------------------------------


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only there it is promised")
@pytest.mark.parametrize("mode", ["--trust", pytest.param("--jail", marks=needs_jail)])
def test_a_text_of_ten_gigabytes_is_an_error_at_its_place(tmp_path: Path, mode: str) -> None:
    path = write(tmp_path, "out:\n  a: $('a' * 10**10)\n")
    finished = subprocess.run(
        [*COMMAND, mode, path], capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    assert finished.returncode == 1
    lines = finished.stderr.splitlines()
    assert lines[0] == "error[limit-memory]: there is not enough memory for this"
    assert lines[1].endswith("robot.yaml:2:8")


# --- jails --------------------------------------------------------------------------------------


def test_without_a_jail_there_is_an_error_and_nothing_is_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    path = write(tmp_path, "print: this was run\nout: 1\n")
    assert codes(path, Policy("jail")) == ["no-jail"]
    assert main(["--jail", path]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == (
        f"error[no-jail]: the jail is not available: the jail needs Linux\n --> {path}:1:1\n"
        "  = hint: --safe works everywhere; the file was not run\n"
    )


def test_without_a_jail_safe_mode_works_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    path = write(tmp_path, "variables: {a: 2}\nout: $(a + 1)\n")
    assert "<out>3</out>" in yamaro.build(path, policy=Policy("safe")).xml()
    assert codes(write(tmp_path, "out: $(open(1))\n"), Policy("safe")) == ["unsafe-code"]


@needs_jail
@pytest.mark.parametrize("mode", ["trusted", "safe", "jail"])
@pytest.mark.parametrize("path", ["~/.bashrc", "~/a/../.bashrc"])
def test_the_home_folder_is_known_where_nothing_tells_it(
    path: str, mode: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a jail HOME is hidden and the user database closed: it must not be asked there."""
    import pwd

    def getpwuid(_: int) -> None:
        raise KeyError("the user database cannot be read")

    monkeypatch.setattr(pwd, "getpwuid", getpwuid)
    monkeypatch.setenv("HOME", "/home/someone")
    file = write(tmp_path, f"model:\n  include: {path}\n")
    with pytest.raises(YamaroError) as caught:
        yamaro.build(file, policy=Policy(mode))
    (found,) = caught.value.diagnostics
    expected = "missing-file" if mode == "trusted" else "path-outside"
    assert found.code == expected
    assert "searched for /home/someone" in found.notes[0]


OWN_FILES = {
    "a loop in process": "process: |\n  n = 0\n  for i in range(3):\n    n += i\nout: $(n)\n",
    "a condition in process": "process: |\n  if True: n = 3\nout: $(n)\n",
    "a function in process": "process: |\n  def three(): return 3\nout: $(three())\n",
    "a module": "import: os\nout: $(len(os.path.basename('/a/bcd')))\n",
    "a module under another name": "import: [os.path as p]\nout: $(len(p.basename('/a/bcd')))\n",
    "a module beside the file": "import: three\nout: $(three.THREE)\n",
    "a method": "out: $('{}'.format(3))\n",
    "a class in a module": "import: collections\nout: $(collections.Counter('aaa')['a'])\n",
    "an included file": "model: {include: loop.yaml}\n",
    "a file included late": "model:\n  for: {iterator: i, range: 1, body: {include: late.yaml}}\n",
}


@needs_jail
@pytest.mark.parametrize("kind", OWN_FILES)
def test_what_safe_mode_refuses_is_looked_at_in_the_jail(
    kind: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path, "THREE = 3\n", "three.py")
    write(tmp_path, "process: |\n  for n in [3]: pass\nmodel:\n  link/name=$(n):\n", "loop.yaml")
    write(tmp_path, "model:\n  process: |\n    while True: break\n  link/name=3:\n", "late.yaml")
    path = write(tmp_path, "print: hello\n" + OWN_FILES[kind])
    expected = yamaro.build(path, on_message=lambda line: None).xml()
    said: list[str] = []
    program = yamaro.load(path, policy=Policy.looking())
    for _ in range(2):
        build = program.build(on_message=said.append)
        assert (build.xml(), build.warnings) == (expected, [])
        assert ">3<" in expected or '"3"' in expected
    assert said == ["hello", "hello"]
    assert set(codes(path, Policy("safe"))) == {"unsafe-code"}
    capfd.readouterr()
    assert main(["check", path]) == 0
    assert capfd.readouterr() == (f"{path}: ok\n", "hello\n")
    assert main(["check", "--safe", path]) == 1


@needs_jail
def test_what_the_jail_refuses_is_refused_when_a_file_is_looked_at(tmp_path: Path) -> None:
    path = write(tmp_path, "process: |\n  open('ran', 'w')\nout: null\n")
    assert codes(path, Policy.looking()) == ["python-error"]
    assert os.listdir(tmp_path) == ["robot.yaml"]
    path = write(tmp_path, "import: os\nout: $(missing)\n")
    assert codes(path, Policy.looking()) == ["undefined-name"]


def test_what_safe_mode_allows_is_looked_at_in_safe_mode(tmp_path: Path) -> None:
    path = write(tmp_path, "out: $([0] * 2000)\n")
    policy = Policy.looking(limits={"sequence": 1000, "steps": 1000})
    assert codes(path, policy) == ["limit-sequence"]
    assert policy.fallback is not None
    assert policy.fallback.limits.sequence == 1000
    path = write(tmp_path, "out: $([i for i in range(10**5)])\n")
    assert codes(path, Policy.looking(limits={"steps": 1000})) == ["limit-steps"]


@needs_jail
def test_looking_takes_no_longer_for_a_file_that_was_looked_at(tmp_path: Path) -> None:
    """Once refused, a program is run in the jail at once."""
    path = write(tmp_path, OWN_FILES["a loop in process"])
    program = yamaro.load(path, policy=Policy.looking())
    first = program._in_jail
    assert first is not None
    program.build()
    assert program._in_jail is first


@pytest.mark.parametrize("why", ["no jail here", "none this time"])
def test_without_a_jail_looking_is_safe_mode(
    why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> bytes:
        raise jail.JailUnavailable("a container is in the way")

    if why == "no jail here":
        monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    else:
        monkeypatch.setattr(jail, "check_available", lambda: None)
        monkeypatch.setattr(jail, "run_jailed", fail)
    path = write(tmp_path, "import: os\nout: null\n")
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, policy=Policy.looking())
    (found,) = caught.value.diagnostics
    assert found.code == "unsafe-code"
    assert found.hint is not None
    assert "--jail runs the file confined" in found.hint


@pytest.mark.parametrize("mode", ["safe", pytest.param("jail", marks=needs_jail)])
def test_within_a_folder_nothing_else_is_read(mode: str, tmp_path: Path) -> None:
    """Neither its repository, nor packages, nor what a link leads to; an allowed path is."""
    (tmp_path / ".git").mkdir()
    inside, outside = tmp_path / "robots", tmp_path / "others"
    for folder in (inside / "deep", outside):
        folder.mkdir(parents=True)
        (folder / "leg.yaml").write_text("model:\n- b: found\n")
    (inside / "link.yaml").symlink_to(outside / "leg.yaml")

    def found(name: str, **options: Any) -> list[str]:
        main = inside / "robot.yaml"
        main.write_text(f"model:\n- include: {name}\n")
        try:
            yamaro.build(main, policy=Policy(mode, **options), on_message=lambda line: None)
        except YamaroError as error:
            return [diagnostic.code for diagnostic in error.diagnostics]
        return []

    bound = {"within": str(inside)}
    assert found("../others/leg.yaml") == []
    assert found("deep/leg.yaml", **bound) == []
    assert found("../others/leg.yaml", **bound) == ["path-outside"]
    assert found("link.yaml", **bound) == ["path-outside"]
    assert found("../others/leg.yaml", **bound, allowed_paths=[str(outside)]) == []
    assert found("leg.yaml", within=str(outside)) == ["path-outside"]


@needs_jail
@pytest.mark.parametrize(
    "attempt", ["open('new', 'w')", "open('/etc/passwd')", "os.fork()", "subprocess.run('true')"]
)
def test_what_a_jail_refuses_is_told_at_its_place(tmp_path: Path, attempt: str) -> None:
    path = write(tmp_path, f'import: [os, subprocess]\nout:\n  a: "$({attempt})"\n')
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, policy=Policy("jail"))
    (found,) = caught.value.diagnostics
    assert found.code == "python-error"
    assert found.span.location()[0] == 3
    assert "PermissionError" in found.message
    assert found.hint is not None
    assert found.hint.startswith("in a jail, a file can read its folder")
    assert os.listdir(tmp_path) == ["robot.yaml"]


@needs_jail
def test_a_jail_that_cannot_be_set_up_is_no_bar_to_safe_mode(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> bytes:
        raise jail.JailUnavailable("a container is in the way")

    monkeypatch.setattr(jail, "run_jailed", fail)
    path = write(tmp_path, "out: $(1 + 1)\n")
    assert "<out>2</out>" in yamaro.build(path, policy=Policy("safe")).xml()
    assert codes(path, Policy("jail")) == ["no-jail"]


@needs_jail
@pytest.mark.parametrize(
    "answer",
    [
        b"",
        b"\0" * 7,
        jail.pack([b"", b"\0" * 7]),
        jail.pack([b"x", b""]),
        *(jail.pack([b"", jail.pack(parts)]) for parts in ([b""] * 8, [b"x"] * 8, [b""] * 3)),
    ],
)
def test_an_answer_that_is_none_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: bytes
) -> None:
    monkeypatch.setattr(jail, "run_jailed", lambda *_, **__: answer)
    found = codes(write(tmp_path, "out: 1\n"), Policy("jail"))
    assert found == ["jail-broken"]


@needs_jail
@pytest.mark.parametrize(
    ("limit", "code"),
    [
        ("open_files", "jail-broken"),
        ("threads", "jail-broken"),
        ("answer", "limit-output"),
        ("memory", "limit-memory"),
    ],
)
def test_each_limit_of_a_jail_has_a_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str, code: str
) -> None:
    def fail(*_: object, **__: object) -> bytes:
        error = jail.JailError("it is over")
        error.limit = limit
        raise error

    assert hasattr(JailLimits(), limit)
    monkeypatch.setattr(jail, "run_jailed", fail)
    assert codes(write(tmp_path, "out: 1\n"), Policy("jail")) == [code]


@needs_jail
@pytest.mark.parametrize("words", [[], ["check"]])
def test_a_fault_of_ours_in_a_jail_is_reported_as_ours(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise AttributeError("no \x1b[2J such thing")

    monkeypatch.setattr(pipeline, "write_pieces", fail)
    path = write(tmp_path, "out: 1\n")
    assert main([*words, "--jail", path]) == 70
    told = capsys.readouterr()
    assert told.out == ""
    first, second = told.err.splitlines()
    assert first.startswith("yamaro: internal error: AttributeError: no \\x1b[2J such thing (test_")
    assert second.startswith("this is a bug in Yamaro")
    with pytest.raises(confined.FaultInJail, match="such thing"):
        yamaro.build(path, policy=Policy("jail"))


@needs_jail
def test_a_file_that_claims_a_fault_of_ours_gains_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (
        "process: |\n  import yamaro.pipeline\n"
        "  def fail(*a):\n    raise type('\\x1b]0;E\\n', (Exception,), {})('\\x9b' * 10**7)\n"
        "  yamaro.pipeline.write_pieces = fail\nout: 1\n"
    )
    path = write(tmp_path, text)
    assert main(["--jail", path]) == 70
    told = capsys.readouterr()
    assert told.out == "" and len(told.err) < 3000
    assert (
        told.err.replace("…", "").isascii() and "\x1b" not in told.err and told.err.count("\n") == 2
    )


@needs_jail
@pytest.mark.parametrize("end", ["SystemExit(3)", "KeyboardInterrupt()", "GeneratorExit()"])
def test_a_file_that_ends_its_jail_is_no_fault_of_ours(tmp_path: Path, end: str) -> None:
    code = f"  def fail(*a):\n    raise {end}\n  yamaro.pipeline.write_pieces = fail\n"
    text = f"process: |\n  import yamaro.pipeline\n{code}out: 1\n"
    assert codes(write(tmp_path, text), Policy("jail")) == ["jail-broken"]


def test_convert_does_not_take_a_policy_for_a_variable(tmp_path: Path) -> None:
    path = write(tmp_path, "out: 1\n")
    with pytest.raises(TypeError, match="load"):
        yamaro.convert(path, policy=Policy("safe"))
    assert "<out>1</out>" in yamaro.load(path, policy=Policy("safe")).convert()


def test_standard_input_that_cannot_be_read_is_wrong_usage(tmp_path: Path) -> None:
    with open(tmp_path / "written", "wb") as file:
        finished = subprocess.run(
            [*COMMAND, "-"], stdin=file, capture_output=True, text=True, check=False
        )
    assert finished.returncode == 2
    assert finished.stderr.startswith("yamaro: error: cannot read standard input: Bad file")


def test_a_robot_that_is_nested_deeply_leaves_the_jail(tmp_path: Path) -> None:
    inner = "<a>" * 1400 + "</a>" * 1400
    path = tmp_path / "deep.urdf"
    path.write_text(f'<robot name="r"><link name="l"/>{inner}</robot>')
    assert yamaro.build(path, policy=Policy.looking()).robot.name == "r"
