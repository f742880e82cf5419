"""What the playground's worker asks of Yamaro: to build the files of its editor.

The viewer shows them as `yamaro view` does. This runs in Pyodide, and in the tests on CPython.
What it returns is JSON.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping

from yamaro import Policy, YamaroError
from yamaro.codes import anchor_of
from yamaro.diagnostics import ERROR, Diagnostic
from yamaro.options import Options, UsageError
from yamaro.rebuilding import Rebuilder
from yamaro.rendering import render
from yamaro.source import Span
from yamaro.targets.losses import diagnostics_of
from yamaro.tools.view.session import Session
from yamaro.tools.view.variables import WrongValue

SECONDS = 10.0
"""How long a conversion may take."""
PRINTED = 10_000
"""Characters of what a file prints that are shown."""
UNSAFE = "unsafe-code"

Json = dict[str, object]


class Playground:
    """The files of the editor, and the robot that they describe."""

    def __init__(self, folder: str) -> None:
        """Begin with an empty folder, which need not exist."""
        self._folder = folder
        self._main = ""
        self._printed: list[str] = []
        self._session: Session | None = None
        self._is_trusted = False

    def open(self, files: Mapping[str, str], main: str, *, is_trusted: bool) -> None:
        """Take files in place of those before.

        Args:
            files: their texts by name; a name may contain folders.
            main: the one to compile.
            is_trusted: compile it with all of Python; otherwise in safe mode.
        """
        if os.path.isdir(self._folder):
            os.chdir(os.path.dirname(self._folder))  # the folder we are in may not be removed
            shutil.rmtree(self._folder)
        os.makedirs(self._folder)
        os.chdir(self._folder)
        for name, text in files.items():
            self._write(name, text)
        self._main, self._is_trusted = main, is_trusted
        self._session = Session(
            Rebuilder(
                main,
                Options(
                    policy=Policy(
                        "trusted" if is_trusted else "safe",
                        timeout=SECONDS,
                        allowed_paths=[self._folder],  # main may be in a folder of it
                    ),
                    on_message=self._print,
                ),
            ),
            editor="the editor",
        )

    def change(self, name: str, text: str) -> None:
        """Change a file."""
        self._write(name, text)
        if self._session is not None:
            self._session.rebuild()

    def _write(self, name: str, text: str) -> None:
        path = os.path.normpath(os.path.join(self._folder, name))
        if not path.startswith(os.path.join(self._folder, "")):
            raise ValueError(f"a file of the playground lies in its folder, and {name} does not")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(text)

    def _print(self, line: str) -> None:
        self._printed.append(line)

    # --- what the page asks for -----------------------------------------------------------------

    def build(self) -> str:
        """Build the robot; return what the viewer and the editor show of it."""
        assert self._session is not None
        self._printed.clear()
        try:
            turn = self._session.build()
        except UsageError as error:
            return json.dumps({"state": None, "diagnostics": [], "fault": str(error)})
        return json.dumps(
            {
                "state": json.loads(self._session.state()),
                "diagnostics": [self._told(one) for one in turn.diagnostics],
                "fault": turn.fault,
                "printed": "\n".join(self._printed)[:PRINTED],
                "isUnsafe": any(one.code == UNSAFE for one in turn.diagnostics),
            }
        )

    def write(self, format: str) -> str:
        """Write the robot in a format, or the document itself as "xml"; tell what is lost."""
        assert self._session is not None
        is_document = format == "xml"
        try:
            build = self._session.document(None if is_document else format)
            losses = [] if is_document else diagnostics_of(build.losses, format)
            text = build.xml()
        except YamaroError as error:
            told = [self._told(one) for one in error.diagnostics if one.severity == ERROR]
            return json.dumps({"text": None, "diagnostics": told})
        except UsageError as error:
            return json.dumps({"text": None, "diagnostics": [], "fault": str(error)})
        stem = os.path.splitext(os.path.basename(self._main))[0]
        name = stem + os.path.splitext(build.file_name)[1]
        told = [self._told(one) for one in losses]
        return json.dumps({"text": text, "name": name, "diagnostics": told})

    def act(self, action: str, content: str) -> str:
        """Do what the viewer asks for; return its answer."""
        assert self._session is not None
        given = json.loads(content)
        if action == "variables":
            try:
                self._session.set_variables(given)
            except WrongValue as error:
                return json.dumps({"fault": str(error)})
            return "{}"
        if action == "download":
            return self._session.download(given["format"]).decode()
        if action == "included":
            return self._session.included().decode()
        if action == "open":
            return json.dumps(self._place(given))
        return "{}"

    def _place(self, given: Mapping[str, object]) -> Json:
        session = self._session
        assert session is not None
        if "variable" in given:
            found = session.place_of_variable(str(given["variable"]))
        else:
            number, version = given["place"], given["version"]
            assert isinstance(number, int)
            assert isinstance(version, int)
            found = session.place(number, version=version, is_fault=bool(given.get("isFault")))
        if found is None:
            return {"fault": "the text has changed since"}
        path, line, column = found
        return {"file": self._name(path), "line": line, "column": column}

    def fetch(self, key: str) -> bytes | None:
        """Return the content of what was downloaded last, if that has this key."""
        assert self._session is not None
        found = self._session.downloads.fetch(key)
        return None if found is None else found[1]

    # --- diagnostics ----------------------------------------------------------------------------

    def _name(self, path: str) -> str:
        return os.path.relpath(path, self._folder)

    def _told(self, diagnostic: Diagnostic) -> Json:
        span = diagnostic.span
        start, end = _utf16(span)
        fix = diagnostic.fix
        edits = [] if fix is None else [self._edit(edit.span, edit.text) for edit in fix.edits]
        return {
            "file": self._name(span.source.path) if span.source.path else "",
            "from": start,
            "to": end,
            "severity": diagnostic.severity,
            "code": diagnostic.code,
            "page": f"../diagnostics.html#{anchor_of(diagnostic.code)}",
            "message": diagnostic.message,
            "hint": diagnostic.hint,
            "text": render(diagnostic),
            "fix": None if fix is None else {"title": fix.title, "edits": edits},
        }

    def _edit(self, span: Span, text: str) -> Json:
        start, end = _utf16(span)
        return {"file": self._name(span.source.path), "from": start, "to": end, "insert": text}


def _utf16(span: Span) -> tuple[int, int]:
    """Return where a span begins and ends as JavaScript counts characters."""
    text = span.source.text
    start = len(text[: span.start].encode("utf-16-le")) // 2
    return start, start + len(text[span.start : span.end].encode("utf-16-le")) // 2
