"""The playground in Chromium, which can reach nothing but the folder that is served."""

from __future__ import annotations

import contextlib
import gzip
import io
import json
import math
import re
import shutil
import sys
import threading
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path

import pytest

from tests import chromium
from tests.built_site import SITE, build_site
from tests.chromium import Chromium
from tests.consumers.oracles import missing
from tests.serving import served
from yamaro import YamaroError, build

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "web" / "playground"))
import pack  # noqa: E402

LARGEST = 8_000_000
"""Bytes over the wire, compressed."""
BUILT = "Boolean(window.playground?.built) && playground.isReady"
ALONE = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"

pytestmark = pytest.mark.slow


class Playground(Chromium):
    """The page of the playground.

    What takes longer than 10 s is stopped, as a build may on a busy machine: it is asked again.
    """

    address = ""

    def start(self, rest: str = "") -> None:
        """Open the page, and wait until the robot is built."""
        for _ in range(20):
            self.open("about:blank")
            self.open(self.address + rest)
            self.wait_for(BUILT)
            if not self.was_stopped():
                return

    def was_stopped(self) -> bool:
        """Tell whether the build took too long."""
        problems = self.text("#problems")
        return "stopped after 10 s" in problems or "limit-time" in problems

    def load_again(self) -> None:
        """Reload the page, and wait until the robot is built."""
        self.run("window.isOld = true; location.reload()")
        self.wait_for(f"!window.isOld && {BUILT}")

    def choose(self, example: str) -> None:
        """Open an example, and wait until the robot is built."""
        number = [name for name, _, _ in pack.EXAMPLES].index(example)
        choice = "document.getElementById('examples')"
        for _ in range(20):
            before = self.run("playground.built")
            self.run(f"{choice}.value = {number}; {choice}.dispatchEvent(new Event('change'))")
            self.wait_for(f"playground.built > {before} && playground.isReady")
            if not self.was_stopped():
                return

    def write(self, text: str, name: str | None = None) -> None:
        """Write a text in place of a file's, and wait for what comes of it."""
        before = self.run("playground.built")
        if name is not None:
            self.run(f"playground.editor.show({name!r})")
        view = "playground.editor.view"
        changes = f"{{from: 0, to: {view}.state.doc.length, insert: {json.dumps(text)}}}"
        self.run(f"{view}.dispatch({{changes: {changes}}})")
        self.wait_for(f"playground.built > {before} && playground.isReady")

    def text(self, selector: str) -> str:
        """Return what is written in an element that is seen."""
        found: str = self.run(
            f"[...document.querySelectorAll({selector!r})]"
            ".filter(e => e.checkVisibility()).map(e => e.innerText).join('\\n')"
        )
        return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if shutil.which("npm") is None:
        missing("npm")
    build_site(tmp_path_factory)
    return SITE / "playground"


@pytest.fixture(scope="module")
def browser(folder: Path) -> Iterator[Playground]:
    program = chromium.find()
    if program is None:
        missing("Chromium")
        raise AssertionError
    with served(folder) as address:
        page = Playground(program, ALONE, width=1280, height=800)
        page.address = address
        page.start()
        yield page
        page.close()


@pytest.fixture
def page(browser: Playground) -> Iterator[Playground]:
    browser.complaints.clear()
    yield browser
    assert browser.complaints == []


def test_a_viewer_that_is_loaded_before_the_page_shows_the_robot(folder: Path) -> None:
    program = chromium.find()
    assert program is not None
    loaded = threading.Event()
    with served(folder, {"/playground.js": loaded}) as address:
        page = Chromium(program, ALONE, width=1280, height=800)
        page.open(address)
        page.wait_for("Boolean(document.getElementById('viewer')?.contentWindow?.yamaro)")
        loaded.set()
        page.wait_for("document.getElementById('viewer').contentWindow.yamaro.robot?.links.size")
        page.close()


def test_python_that_could_not_be_loaded_is_once_the_text_changes(
    folder: Path, tmp_path: Path
) -> None:
    program = chromium.find()
    assert program is not None
    for path in folder.iterdir():
        (tmp_path / path.name).symlink_to(path)
    (tmp_path / "worker.js").unlink()
    with served(tmp_path) as address:
        page = Playground(program, ALONE, width=1280, height=800)
        page.open(address)
        page.wait_for("Boolean(window.playground?.built)")
        assert "Python could not be started; change the text" in page.text("#problems")
        assert page.text("#status") == "Python is not running"
        (tmp_path / "worker.js").symlink_to(folder / "worker.js")
        page.write("robot: r\nmodel:\n- link/name=$(1 +):\n")
        assert "error[" in page.text("#problems")
        page.close()


def expected(main: Path, target: str | None) -> str | None:
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        try:
            return build(main, target=target).xml()
        except YamaroError:
            return None


def test_all_that_is_loaded_is_small(folder: Path) -> None:
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert sum(len(gzip.compress(path.read_bytes())) for path in files) < LARGEST


def differing(one: str | None, other: str | None) -> list[tuple[str, str]]:
    """Return the words that differ, except for the last digit of numbers.

    Sine and cosine of the browser and of this machine may differ in their last bit, which shows
    in the directions of the rays of a lidar.
    """
    words, others = (re.split(r"[\s\"]+", text or "") for text in (one, other))
    pairs = [pair for pair in zip_longest(words, others, fillvalue="") if pair[0] != pair[1]]
    return [pair for pair in pairs if not is_nearly_the_same(*pair)]


def is_nearly_the_same(one: str, other: str) -> bool:
    try:
        return math.isclose(float(one), float(other), rel_tol=2e-14)
    except ValueError:
        return False


def test_every_example_gives_the_same_as_on_cpython(page: Playground) -> None:
    formats: dict[str, str | None] = {"xml": None, "mjcf": "mjcf", "sdf": "sdf"}
    for name, _, main in pack.EXAMPLES:
        example = pack.read_example(name, "", main)
        opened = {"files": example["files"], "main": example["main"], "isTrusted": True}
        page.run(f"playground.ask('open', {json.dumps(opened)})")
        for word, target in formats.items():
            told = page.run(f"playground.ask('write', {{format: {word!r}}})")
            wanted = expected(pack.folder_of(name) / main, target)
            assert (told["text"] is None) == (wanted is None), (name, word)
            assert differing(told["text"], wanted) == [], (name, word)


def test_an_error_is_underlined_and_told_and_a_click_goes_there(page: Playground) -> None:
    page.choose("pan_tilt")
    page.write("robot: r\nvariables: {width: 1}\nmodel:\n- link/name=é😀$(widht):\n")
    assert page.text(".cm-lintRange-error") == "widht"
    assert "error[undefined-name]: name 'widht' is not defined" in page.text("#problems")
    assert "pan_tilt.yaml:4:17" in page.text("#problems")
    page.run(
        "(([box]) => document.querySelector('.cm-lintRange-error').dispatchEvent("
        "new MouseEvent('mousemove', {bubbles: true, clientX: box.x + 3, clientY: box.y + 3})))"
        "(document.querySelector('.cm-lintRange-error').getClientRects())"
    )
    page.wait_for("!!document.querySelector('.cm-tooltip .cm-diagnostic a')")
    assert page.text(".cm-tooltip .cm-diagnostic a") == "undefined-name"
    link = page.run("document.querySelector('.cm-tooltip .cm-diagnostic a').getAttribute('href')")
    assert link == "../diagnostics.html#undefined-name"
    page.run("playground.editor.goTo(1, 1)")
    page.press("#problems .diagnostic")
    head = "playground.editor.view.state.selection.main.head"
    assert page.run(f"playground.editor.view.state.doc.sliceString({head}, {head} + 5)") == "widht"


def test_what_does_not_end_is_stopped_and_the_next_text_is_built(page: Playground) -> None:
    page.choose("pan_tilt")
    page.write("robot: r\nprocess: |\n  while True: pass\nmodel:\n- link/name=a:\n")
    assert "error[limit-time]" in page.text("#problems")
    # A function in C hears of nothing, so the worker is ended.
    page.write("robot: r\nprocess: sum(range(10 ** 12))\nmodel:\n- link/name=a:\n")
    assert "stopped after 10 s" in page.text("#problems")
    page.write("robot: r\nprocess: print('again')\nmodel:\n- link/name=a:\n")
    assert page.text("#problems") == ""
    assert page.run("document.getElementById('printed').textContent") == "again"


def test_recursion_without_end_does_not_end_python(page: Playground) -> None:
    page.choose("pan_tilt")
    for text in (
        "robot: r\nprocess: |\n  def f(n): return f(n + 1)\n  f(0)\nmodel:\n- link/name=a:\n",
        "robot: r\nfunctions:\n- Nest(n): {Nest: $(n + 1)}\nmodel:\n- Nest: 0\n",
    ):
        page.write(text)
        assert "error[too-deep]" in page.text("#problems")
    page.write("robot: r\nmodel:\n- link/name=a:\n")
    assert page.text("#problem-count") == "no problems"


def test_a_link_holds_the_files_and_is_not_trusted(page: Playground) -> None:
    page.choose("pan_tilt")
    page.write("robot: r\nimport: [subprocess]\nmodel:\n- link/name=é😀:\n")
    assert page.text("#trust") == ""
    page.press("#share")
    page.wait_for("location.hash.startsWith('#robot=')")
    page.start(page.run("location.hash"))
    assert page.run("document.getElementById('examples').value") == "link"
    assert "import: [subprocess]" in page.run("playground.editor.texts()['pan_tilt.yaml']")
    assert "error[unsafe-code]" in page.text("#problems")
    page.press("#trust-run")
    page.wait_for("playground.isReady && !playground.diagnostics.length")
    assert page.text("#trust") == ""


def test_what_was_written_can_be_chosen_again_after_another_example(page: Playground) -> None:
    page.start()
    page.choose("pan_tilt")
    page.write("robot: mine\nmodel:\n  link/name=base:\n")
    page.choose("arm")
    assert page.run("playground.editor.view.state.doc.line(1).text") != "robot: mine"
    choice = "document.getElementById('examples')"
    before = page.run("playground.built")
    assert page.run(f"{choice}.lastElementChild.textContent") == "Your pan_tilt.yaml"
    page.run(
        f"{choice}.value = {choice}.lastElementChild.value;"
        f"{choice}.dispatchEvent(new Event('change'))"
    )
    page.wait_for(f"playground.built > {before} && playground.isReady")
    assert page.run("playground.editor.view.state.doc.line(1).text") == "robot: mine"


def test_what_was_written_is_kept_when_the_page_is_loaded_again(page: Playground) -> None:
    first_line = "playground.editor.view.state.doc.line(1).text"
    page.start("?example=arm")
    page.write("robot: mine\nmodel:\n  link/name=base:\n")
    for _ in range(2):
        page.load_again()
        assert page.run(first_line) == "robot: mine"
        assert page.run("document.querySelector('#examples :checked').text") == "Your arm.yaml"
    page.start("?example=arm")
    assert page.run(first_line) != "robot: mine"


def test_a_link_stays_untrusted_when_the_page_is_loaded_again(page: Playground) -> None:
    page.choose("pan_tilt")
    page.write("robot: r\nmodel:\n  link/name=a:\n")
    page.press("#share")
    page.wait_for("location.hash.startsWith('#robot=')")
    page.start(page.run("location.hash"))
    page.write("robot: r\nimport: [subprocess]\nmodel:\n- link/name=a:\n")
    page.load_again()
    assert "error[unsafe-code]" in page.text("#problems")


def test_what_python_imports_at_the_start_is_byte_code(page: Playground) -> None:
    page.start()
    page.write(
        "robot: r\nprocess: |\n  import sys\n"
        "  specs = [module.__spec__ for module in sys.modules.values()]\n"
        "  files = [spec.origin or '' for spec in specs if spec]\n"
        "  print(len(files), *[file for file in files if file.endswith('.py')])\n"
        "model:\n  link/name=a:\n"
    )
    count, *sources = page.run("document.getElementById('printed').textContent").split()
    assert int(count) > 100
    assert sources == []


def test_another_example_fills_the_view(page: Playground) -> None:
    distance = "viewer.contentWindow.yamaro.stage.camera.position.length()"
    page.start("?example=arm")
    page.run("window.viewer = document.getElementById('viewer')")
    page.wait_for("viewer.contentWindow.yamaro?.robot?.name === 'arm'")
    far = page.run(distance)
    page.choose("pan_tilt")
    page.wait_for("viewer.contentWindow.yamaro.robot.name === 'pan_tilt'")
    # The arm reaches about a metre, and the camera on two servos is 9 cm high.
    page.wait_for(f"{distance} < {far} / 3")


def test_the_robot_is_seen_before_python_has_started(page: Playground) -> None:
    page.open("about:blank")
    page.open(page.address)
    page.wait_for("Boolean(window.playground?.hasState)")
    assert not page.run("playground.built")
    page.wait_for("playground.built && playground.isReady")


def test_the_viewer_and_the_editor_follow_each_other(page: Playground) -> None:
    view = "document.getElementById('viewer').contentWindow"
    for example in ("arm", "pan_tilt"):  # of a robot that was seen before, no place is opened
        page.choose(example)
        page.wait_for(f"{view}.yamaro?.robot?.name === '{example}'")
    page.run(f"{view}.document.getElementById('tree').querySelector('.row').click()")
    page.wait_for(f"!{view}.document.getElementById('origin').hidden")
    page.run(f"{view}.document.getElementById('origin-open').click()")
    page.wait_for("playground.editor.view.state.selection.main.head > 0")


def test_files_with_errors_do_not_show_the_robot_of_other_files(page: Playground) -> None:
    page.choose("pan_tilt")
    name = "document.getElementById('viewer').contentWindow.yamaro?.robot?.name"
    page.wait_for(f"{name} === 'pan_tilt'")
    page.write("robot: [\n")
    assert page.run(name) == "pan_tilt"  # the last one that was built
    page.press("#share")
    page.wait_for("location.hash.startsWith('#robot=')")
    link = page.run("location.hash")
    page.choose("arm")
    page.wait_for(f"{name} === 'arm'")
    page.run(f"location.hash = {link!r}")
    page.wait_for("playground.diagnostics.length && playground.isReady")
    page.wait_for(f"document.getElementById('viewer').contentWindow.yamaro && !{name}")
    page.choose("pan_tilt")
    page.wait_for(f"{name} === 'pan_tilt'")


def test_it_can_be_used_on_a_phone(page: Playground) -> None:
    page.resize(390, 800)
    try:
        page.start()  # with the robot, and a way to its text
        width = "document.getElementById('viewer').getBoundingClientRect().width"
        assert page.run(width) == 390
        page.choose("quadruped")
        assert page.run("document.documentElement.scrollWidth") <= 390
        viewer = "document.getElementById('viewer').contentWindow.yamaro"
        page.wait_for(f"{viewer}?.robot?.name === 'quadruped'")
        assert page.run(f"{viewer}.stage.sees({viewer}.robot.outermostPoints())")
        page.press("#sides [data-side=edit]")
        assert page.run(width) == 0
        assert page.run("document.getElementById('editor').getBoundingClientRect().width") > 380
    finally:
        page.resize(1280, 800)


def test_all_that_can_be_pressed_has_a_name(page: Playground) -> None:
    page.choose("pan_tilt")
    nameless = (
        "[...document.querySelectorAll('button, select, a, iframe')].filter(e => "
        "!(e.innerText || e.ariaLabel || e.title || e.labels?.length)).map(e => e.outerHTML)"
    )
    assert page.run(nameless) == []


def test_the_tools_of_the_viewer_work_without_a_server(page: Playground) -> None:
    page.choose("hexapod")
    viewer = "document.getElementById('viewer').contentWindow"
    element = f"{viewer}.document.getElementById"
    page.wait_for(f"{viewer}.yamaro.robot?.name === 'hexapod'")
    page.run(f"{element}('included').open = true")
    page.wait_for(f"{element}('included-files').innerText.includes('coxa_length')")
    page.run(f"{element}('theme').click()")
    assert page.run(f"{viewer}.document.documentElement.dataset.theme") == "light"
    page.wait_for("document.documentElement.dataset.theme === 'light'")  # of the page around it
    page.run(f"{element}('picture').click()")
    page.wait_for(f"{element}('picture-image').naturalWidth > 600")
    page.run(f"{element}('picture-close').click()")
    assert page.run(f"{element}('drag').ariaPressed") == "true"


MJCF = """<mujoco model="pendulum">
  <worldbody>
    <body name="base">
      <geom name="block" type="box" size="0.1 0.1 0.1"/>
      <body name="rod" pos="0 0 0.2">
        <joint name="swing" axis="0 1 0" range="-60 60"/>
        <geom type="capsule" size="0.02" fromto="0 0 0 0 0 0.5"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def test_mjcf_that_is_pasted_is_shown_with_its_lines(page: Playground) -> None:
    page.start("?example=arm")
    page.write(MJCF)
    page.wait_for("Object.keys(playground.editor.texts()).some(name => name.endsWith('.xml'))")
    page.wait_for("playground.isReady && playground.diagnostics.every(d => d.severity !== 'error')")
    page.wait_for("viewer.contentWindow.yamaro?.robot?.name === 'pendulum'")
    page.write(MJCF.replace('type="box"', 'type="bos"'))
    page.wait_for("playground.diagnostics.some(d => d.code === 'bad-mjcf')")
    told = page.run("playground.diagnostics.find(d => d.code === 'bad-mjcf')")
    assert MJCF[: told["from"]].count("\n") == 3


def test_files_that_are_dropped_are_opened(page: Playground) -> None:
    """The robot is the file that no other one names."""
    page.start("?example=arm")
    assets = '<mujoco><asset><material name="red" rgba="1 0 0 1"/></asset></mujoco>'
    files = {
        "assets.xml": assets,
        "main.xml": MJCF.replace("<worldbody>", '<include file="assets.xml"/><worldbody>', 1),
    }
    before = page.run("playground.built")
    page.run(
        f"const given = new DataTransfer(); const files = {json.dumps(files)};"
        " for (const name in files) given.items.add(new File([files[name]], name));"
        " document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: given, bubbles: true}))"
    )
    page.wait_for(f"playground.built > {before} && playground.isReady")
    assert page.run("playground.editor.active") == "main.xml"
    page.wait_for("viewer.contentWindow.yamaro?.robot?.name === 'pendulum'")
