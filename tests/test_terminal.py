"""Nothing that comes from a file reaches a terminal unescaped, by whatever way it gets there."""

from __future__ import annotations

import io
import json
import logging
import os
import subprocess
import sys
import unicodedata
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import yamaro
from tests.tools_there import needs
from yamaro.commands.main import main
from yamaro.sandbox import jail
from yamaro.streams import BINARY, NAMES, XML, NotForTerminal, Streams
from yamaro.terminal import STYLES, harmless, harmless_xml
from yamaro.xml.values import is_xml_character

EVIL = (
    "\x1b]0;TITLE\x07\x1b[31m\x1b]52;c;cm0=\x07\x9b31m\x9d0;T\x9c\x85\x7f\b\r\v\f"
    "\u202a\u202e\u2066\u2069\u200b\u200e\u2028\u2029\ufeff\xad"
)
KINDS = {"Cc", "Cf", "Cs", "Zl", "Zp"}  # of Unicode: control, format, surrogate, separators
LINE_BREAK = "name-with-line-break"
needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")
needs_terminals = pytest.mark.skipif(os.name == "nt", reason="no pseudo-terminals here")


def quoted(text: str) -> str:
    """Return a text as it is written between double quotes in YAML."""
    return text.encode("unicode_escape").decode()


PRINTS = f'robot: r\nmodel:\n  link/name=base:\n  print: "{quoted(EVIL)}"\n'


def steering_in(text: str) -> list[str]:
    """Return the characters in a text that steer a terminal, our own styles left out."""
    for style in STYLES:
        text = text.replace(style, "")
    text = text.replace("\r\n", "")  # as the terminal itself ends lines
    return [char for char in text if unicodedata.category(char) in KINDS and char not in "\t\n"]


def on_terminal(*words: str, status: int | None = 0) -> str:
    """Return what a terminal is sent by a command whose outputs are both the terminal."""
    import pty

    terminal, end = pty.openpty()
    environment = {**os.environ, "PYTHONUTF8": "1", "TERM": "xterm"}
    environment.pop("NO_COLOR", None)
    process = subprocess.Popen(
        [sys.executable, "-m", "yamaro", *words],
        stdin=subprocess.DEVNULL,
        stdout=end,
        stderr=end,
        env=environment,
    )
    os.close(end)
    pieces = []
    try:
        while piece := os.read(terminal, 1 << 16):
            pieces.append(piece)
    except OSError:  # the other end is closed
        pass
    os.close(terminal)
    assert process.wait() == (process.returncode if status is None else status), pieces
    return b"".join(pieces).decode()


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(text: str, name: str = "robot.yaml") -> str:
    Path(name).write_bytes(text.encode("utf-8", "surrogatepass"))
    return name


# --- the commands --------------------------------------------------------------------------------


@needs_terminals
@pytest.mark.parametrize(
    "words",
    [
        ["robot.yaml"],
        ["robot.yaml", "--safe"],
        pytest.param(["robot.yaml", "--jail"], marks=needs_jail),
        ["check", "robot.yaml"],
        ["check", "--trust", "robot.yaml"],
        pytest.param(["tree", "robot.yaml"], marks=needs("tree")),
    ],
    ids=" ".join,
)
def test_what_a_file_prints_does_not_steer_the_terminal(words: list[str]) -> None:
    write(PRINTS)
    shown = on_terminal(*words)
    assert steering_in(shown) == []
    assert r"\x1b]0;TITLE\x07\x1b[31m\x1b]52;c;cm0=\x07\x9b31m" in shown
    assert r"\u202a\u202e\u2066\u2069" in shown


@needs_terminals
def test_what_a_trusted_process_writes_is_escaped_too() -> None:
    write(
        "robot: r\nimport: [sys, logging, warnings]\nmodel:\n  link/name=base:\nprocess: |\n"
        f"  evil = {EVIL!a}\n"
        "  print(evil)\n  print(evil, file=sys.stderr)\n  sys.stdout.write(evil + '\\n')\n"
        "  sys.stderr.writelines([evil])\n  logging.warning(evil)\n"
        "  logging.getLogger('trimesh').addHandler(logging.StreamHandler())\n"
        "  logging.getLogger('trimesh').error(evil)\n"
    )
    shown = on_terminal("robot.yaml")
    assert steering_in(shown) == []
    assert shown.count("TITLE") == 7  # the last one by its own handler, and by the root's
    assert shown.endswith('<robot name="r">\r\n  <link name="base"/>\r\n</robot>\r\n')


@needs_terminals
def test_messages_excerpts_and_file_names_are_escaped_between_colours() -> None:
    name = "\x1b]0;a\x07\u202e\x9b1m.yaml"
    write("doc:\n  a: $(nothing)  # \u2066\u202e\n", name)
    shown = on_terminal(name, status=1)
    assert steering_in(shown) == []
    assert "\x1b[1;31merror[undefined-name]\x1b[0m" in shown
    assert r"\x1b]0;a\x07\u202e\x9b1m.yaml:2:" in shown


@needs_terminals
@pytest.mark.parametrize(
    "words",
    [
        ["\x1b[2J.yaml"],
        ["--\x1b[2J"],
        ["--limit", "\x9b2J=1", "a.yaml"],
        ["--package", "\x1b:=\x1b", "a.yaml"],
        ["a.yaml", "\x1b[2J"],
        ["help", "\u202e"],
        ["completion", "\x1b[2J"],
        pytest.param(["watch", "\x1b.yaml", "-o", "\x1b.urdf"], marks=needs("watch")),
        pytest.param(["migrate", "\x1b[2J.urdf"], marks=needs("migrate")),
    ],
    ids=ascii,
)
def test_a_command_line_that_is_wrong_is_repeated_escaped(words: list[str]) -> None:
    assert steering_in(on_terminal(*words, status=2)) == []


@needs_terminals
def test_xml_on_a_terminal_says_the_same_without_steering_it() -> None:
    evil = "\x7f\x85\x9b31m\u202e\u2066\u200b\ufeff é"
    path = write(f'doc:\n  "a/b=\'{quoted(evil)}\'": "{quoted(evil)}"\n')
    shown = on_terminal(path)
    assert steering_in(shown) == []
    assert shown.count("&#x7F;&#x85;&#x9B;31m&#x202E;&#x2066;&#x200B;&#xFEFF; é") == 2
    piped = subprocess.run(
        [sys.executable, "-m", "yamaro", path], capture_output=True, check=True
    ).stdout.decode()
    assert piped.count(evil) == 2  # what is read by programs stays as it is

    from xml.etree.ElementTree import fromstring

    on_screen, in_pipe = fromstring(shown), fromstring(piped)
    assert on_screen[0].attrib == in_pipe[0].attrib == {"b": evil}
    assert on_screen[0].text == in_pipe[0].text == evil


@needs("tree")
@needs_terminals
def test_names_in_tree_and_completion_are_escaped() -> None:
    in_xml = quoted("".join(filter(is_xml_character, EVIL)))
    write(f"robot: r\nmodel:\n  \"link/name='a{in_xml}b'\":\n")
    assert steering_in(on_terminal("tree", "robot.yaml")) == []
    write(f'variables: {{a: "{quoted(EVIL)}", "b{quoted(EVIL)}": 1}}\n')
    shown = on_terminal("completion", "variables", "robot.yaml")
    assert steering_in(shown) == []
    assert shown.count(":=") == 1


@needs("migrate")
@needs_terminals
def test_migration_reports_without_steering() -> None:
    write('<robot name="r"><link name="a"/><a b="\u202e\x9b"/></robot>', "\x1b[2J.urdf")
    assert steering_in(on_terminal("migrate", "\x1b[2J.urdf", status=None)) == []


@needs_terminals
def test_a_traceback_for_developers_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YAMARO_TRACEBACK", "1")
    monkeypatch.setenv("PYTHONPATH", os.getcwd())
    broken = "import yamaro.commands.build as b\n"
    broken += f"def fail(*a, **k):\n    raise RuntimeError({EVIL!a})\nb.convert_file = fail\n"
    write(broken, "sitecustomize.py")
    shown = on_terminal("robot.yaml", status=70)
    assert steering_in(shown) == []
    assert "internal error: RuntimeError: \\x1b]0;TITLE" in shown and "Traceback" in shown


@needs_terminals
def test_a_picture_is_not_written_to_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.setattr(sys, "stdout", Terminal())
    with pytest.raises(NotForTerminal):
        Streams(quiet=False).write_result([b"\x89PNG\x1b"], BINARY)


# --- names, one a line ---------------------------------------------------------------------------


@pytest.mark.skipif(os.name == "nt", reason="no such names")
@pytest.mark.parametrize("char", ["\n", "\r", "\v", "\f", "\x1c", "\x85", "\u2028", "\u2029"])
def test_a_name_with_a_line_break_forges_no_second_name(
    char: str, capsys: pytest.CaptureFixture[str]
) -> None:
    name = f"a{char}b.yaml"
    write("variables: {}\n", name)
    write(f'doc:\n  include: "{quoted(name)}"\n')
    assert main(["robot.yaml", "--deps"]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert f"error[{LINE_BREAK}]: --deps lists one name a line" in captured.err
    assert main(["robot.yaml"]) == 0


def test_a_mesh_with_a_line_break_forges_no_second_name(
    capsys: pytest.CaptureFixture[str],
) -> None:
    mesh = "visual: {geometry: {\"mesh/filename='/m\\n/etc/shadow'\": }}"
    write(f"robot: r\nmodel:\n  link/name=base:\n    {mesh}\n")
    assert main(["robot.yaml", "--deps"]) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and f"error[{LINE_BREAK}]" in captured.err


@needs_terminals
def test_names_of_files_are_escaped_on_a_terminal_only() -> None:
    write("doc:\n", "\x1b[2J\u202e.yaml")
    assert steering_in(on_terminal("--deps", "\x1b[2J\u202e.yaml")) == []
    piped = subprocess.run(
        [sys.executable, "-m", "yamaro", "--deps", "\x1b[2J\u202e.yaml"],
        capture_output=True,
        check=True,
    ).stdout
    assert piped == os.fsencode(os.path.abspath("\x1b[2J\u202e.yaml")) + b"\n"


# --- the one place -------------------------------------------------------------------------------


def test_what_a_file_prints_in_a_python_program_is_escaped_unless_it_is_taken(
    capsys: pytest.CaptureFixture[str],
) -> None:
    yamaro.convert(write(PRINTS))
    assert steering_in(capsys.readouterr().err) == []
    taken: list[str] = []
    yamaro.build("robot.yaml", on_message=taken.append)
    assert taken == [EVIL]  # what a program takes is data
    assert capsys.readouterr().err == ""


def test_our_styles_pass_only_where_there_is_colour() -> None:
    assert harmless("a\tb\n\x1b[1mc\x1b[0m") == "a\tb\n\\x1b[1mc\\x1b[0m"
    assert harmless("\x1b[1;31mc\x1b[0m\x1b[32m", colored=True) == "\x1b[1;31mc\x1b[0m\\x1b[32m"
    for almost in ("\x1b[1", "\x1b[", "\x1b", "\x1b[1;31", "\x1b[1;31;5m", "\x1b]1m", "\x9b1m"):
        assert "\x1b" not in harmless(almost, colored=True)
        assert "\x9b" not in harmless(almost, colored=True)


def is_harmless(char: str) -> bool:
    return char.isprintable() or char in "\t\n"


def test_every_character_is_harmless_or_escaped() -> None:
    for start in range(0, 0x110000, 256):
        chars = [chr(code) for code in range(start, start + 256)]
        shown, fine = harmless("".join(chars)), [each for each in chars if is_harmless(each)]
        assert [each for each in shown if not each.isascii()] == [
            each for each in fine if not each.isascii()
        ]
        assert all(is_harmless(each) for each in shown)
        assert harmless_xml("".join(chars)) == "".join(
            each if is_harmless(each) else f"&#x{ord(each):X};" for each in chars
        )


def test_what_python_prints_is_escaped_while_a_command_runs(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    err = io.StringIO()
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    monkeypatch.setattr(sys, "stderr", err)
    streams = Streams(quiet=False)
    streams.divert()
    print(EVIL)
    print(EVIL, file=sys.stderr)
    sys.stderr.writelines([EVIL, "\n"])
    log = logging.Logger("trimesh")
    log.addHandler(logging.StreamHandler())
    log.warning("%s", EVIL)
    with pytest.raises(TypeError):
        sys.stderr.write(b"bytes")  # type: ignore[arg-type]
    assert sys.stderr.isatty() is False  # all else is the stream's own
    streams.restore()
    assert steering_in(err.getvalue()) == []
    assert err.getvalue().count("TITLE") == 4
    assert sys.stderr is err


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8", "utf-16"])
def test_a_terminal_that_lacks_a_character_is_shown_its_code(
    encoding: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Terminal(io.TextIOWrapper):
        def isatty(self) -> bool:
            return True

    def shown(chunk: bytes | str, form: str) -> str:
        data = io.BytesIO()
        monkeypatch.setattr(sys, "stdout", Terminal(data, encoding=encoding))
        Streams(quiet=False).write_result([chunk], form)
        return data.getvalue().decode(encoding)

    text = "é…\x9b\udcff" if encoding.startswith("utf") else "…\x9b\udcff"
    assert steering_in(shown(text, NAMES)) == []
    assert steering_in(shown(text.encode("utf-8", "surrogatepass"), XML)) == []
    assert steering_in(shown(os.fsencode(text.replace("\x9b", "")), NAMES)) == []


@needs_terminals
def test_libraries_are_silent_while_an_untrusted_file_is_read(tmp_path: Path) -> None:
    code = (
        "import os, sys\nfrom yamaro.streams import ProcessStreams\n"
        "streams = ProcessStreams(quiet=False)\nstreams.divert()\nstreams.silence_libraries()\n"
        "os.write(2, b'\\x1b[2J'); os.write(1, b'\\x1b[2J'); os.system('echo $0 >&2')\n"
        "print('printed \\x1b')\nstreams.say('said \\x1b')\nstreams.write_result(['result\\n'])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"result\n", b"printed \\x1b\nsaid \\x1b\n")


@pytest.mark.parametrize(
    ("pieces", "shown"),
    [
        (["::error::x"], ":\\x3aerror::x"),
        (["a\n \t::error::x"], "a\n \t:\\x3aerror::x"),
        ([":", ":error::x"], ":\\x3aerror::x"),
        (["  ", "::error::x"], "  :\\x3aerror::x"),
        (["a", "::error::x"], "a::error::x"),
        (["a ##[error]x"], "a ##\\x5berror]x"),
        (["###", "[error]x"], "###\\x5berror]x"),
        (["##vs", "o[task]", "##[a]"], "##vso\\x5btask]##\\x5ba]"),
        (["::", ":", "a::b"], ":\\x3a:a::b"),
        (["x" * 1000 + "##", "[error]"], "x" * 1000 + "##\\x5berror]"),
        (["a::b", "\n", "::c"], "a::b\n:\\x3ac"),
        (["# text # [x] C++::f"], "# text # [x] C++::f"),
    ],
)
def test_a_log_holds_no_commands_to_runners_of_ci(
    pieces: list[str], shown: str, capsys: pytest.CaptureFixture[str]
) -> None:
    streams = Streams(quiet=False)
    streams.divert()
    try:
        for piece in pieces:
            sys.stdout.write(piece)
    finally:
        streams.restore()
    assert capsys.readouterr().err == shown


@pytest.mark.parametrize("form", ["json", "sarif", "junit"])
def test_a_report_holds_no_commands_to_runners_of_ci(
    form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text("robot: r\nmodel:\n- \"$('##[error]')x##[b]\\n::error::y\":\n")
    assert main(["check", str(path), "--format", form]) == 1
    out = capsys.readouterr().out
    assert "##[" not in out
    assert not [line for line in out.splitlines() if line.lstrip().startswith("::")]
    if form != "junit":
        assert "##[error]" in json.dumps(json.loads(out))
    else:
        assert "##[error]" in "".join(ET.fromstring(out).itertext())
