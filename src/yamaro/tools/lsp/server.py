"""The language server: takes the messages of an editor one by one, and answers them."""

from __future__ import annotations

import gc
import os
import queue
import threading
import time

from . import FEATURES, feature
from .protocol import (
    INTERNAL_ERROR,
    INVALID_PARAMS,
    INVALID_REQUEST,
    METHOD_NOT_FOUND,
    NOT_INITIALIZED,
    PARSE_ERROR,
    BrokenMessage,
    RequestFailed,
    agreed_encoding,
    path_of,
)
from .workspace import (
    MANIFEST,
    XML_ENDINGS,
    Settings,
    Workspace,
    folders_of,
    may_be_of_robots,
    scan,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from .builds import Builder, Result
    from .findings import Publisher
    from .protocol import Json, Wire

MOST_OBJECTS = 4_000_000
"""New objects after which those that refer to themselves are freed, whatever else is to be done."""
FEW_OBJECTS = 1_000
PARENT_INTERVAL = 10.0
"""Seconds after which to look whether the editor still runs."""


class Server:
    """One session with an editor."""

    def __init__(self, wire: Wire) -> None:
        """Begin before `initialize`."""
        self._wire = wire
        self._events: queue.SimpleQueue[tuple[str, Json]] = queue.SimpleQueue()
        self._workspace = Workspace()
        self._publisher: Publisher | None = None
        self._builder: Builder | None = None
        self._is_initialized = False
        self._is_shut_down = False
        self._parent: int | None = None
        self._edited: dict[str, None] = {}  # files whose parse is to be published
        self._due: dict[str, float] = {}  # when a main file is to be built
        self._has_new_packages = False  # that a look through the workspace is to find
        self._requests = 0  # that were sent to the editor
        self._busy = threading.RLock()  # held while this thread works, and while another one forks

    def run(self) -> int:
        """Serve until the editor is gone or says so; return the exit status."""
        threading.Thread(target=self._listen, name="listener", daemon=True).start()
        if hasattr(os, "register_at_fork"):
            # A jail that is forked in the midst of an import would wait for it without end.
            os.register_at_fork(
                before=self._busy.acquire,
                after_in_parent=self._busy.release,
                after_in_child=self._busy.release,
            )
        gc.disable()  # looking through a long robot takes longer than to answer; see `_rest`
        while True:
            try:
                patience = 0.0 if self._edited else PARENT_INTERVAL
                if self._due and not self._edited:
                    patience = max(min(self._due.values()) - time.monotonic(), 0.0)
                kind, value = self._events.get(timeout=patience)
            except queue.Empty:
                kind, value = "pause", None
            try:
                with self._busy:
                    status = self._handle(kind, value)
            except OSError:  # nobody reads
                return 1
            if status is not None:
                return status

    def _handle(self, kind: str, value: Json) -> int | None:
        """Handle one event; return the exit status if it is the last."""
        if kind == "message":
            return self._take(value)
        if kind == "end":
            return 0 if self._is_shut_down else 1
        if kind == "pause":
            return None if self._rest() else 1
        if kind == "broken":
            self._send_error(None, PARSE_ERROR, value)
        else:
            self._take_result(value)
        return None

    def _listen(self) -> None:
        while True:
            try:
                message = self._wire.read()
            except BrokenMessage as error:
                self._events.put(("broken", str(error)))
                continue
            except (OSError, ValueError):
                message = None
            if message is None:
                self._events.put(("end", None))
                return
            self._events.put(("message", message))

    # --- what waits -------------------------------------------------------------------------

    def _rest(self) -> bool:
        """Do what has waited for a pause; return whether the editor still runs."""
        edited, self._edited = self._edited, {}
        for path in edited:
            self._publish(path)
            self._touch(path, pause=self._workspace.settings.pause)
        is_idle = not (self._edited or self._due) and gc.get_count()[0] > FEW_OBJECTS
        if is_idle or gc.get_count()[0] > MOST_OBJECTS:
            gc.collect()
        now = time.monotonic()
        for main in [main for main, due in self._due.items() if due <= now]:
            del self._due[main]
            if self._builder is None:
                from .builds import Builder

                self._builder = Builder(
                    self._workspace.settings, lambda result: self._events.put(("done", result))
                )
            self._builder.build(main, self._workspace.texts())
        return edited != {} or self._due != {} or self._has_parent()

    def _has_parent(self) -> bool:
        if self._parent is None or os.name == "nt":
            return True
        try:
            os.kill(self._parent, 0)
        except ProcessLookupError:
            return False
        except OSError:
            return True
        return True

    def _touch(self, path: str, *, pause: float) -> None:
        """Plan the builds that a change of a file calls for, and give up those that run."""
        text = self._workspace.text_of(path)
        if text is not None and text.is_foreign:
            return
        if text is not None:
            self._workspace.note_includes(path, self._workspace.includes_of(text))
        due = time.monotonic() + pause
        for main in self._workspace.mains_of(path):
            if self._builder is not None:
                self._builder.abandon(main)
            if os.path.isabs(main):
                self._due[main] = due

    def _take_result(self, result: Result | dict[str, frozenset[str]]) -> None:
        """Take what a build or the look through the workspace gave."""
        workspace = self._workspace
        if isinstance(result, dict):
            is_news = [workspace.note_includes(path, files) for path, files in result.items()]
            if any(is_news) or self._has_new_packages:
                self._has_new_packages = False
                workspace.forget_packages()
                for path in list(workspace.open):
                    self._touch(path, pause=0.0)
                self._forget_builds()
            return
        if result.fault is not None:
            self._log(f"yamaro: {result.fault}")
        workspace.results[result.main] = result
        if result.root is not None:
            workspace.good[result.main] = result
        for path in workspace.open:  # that this program does not read after all
            for main in workspace.mains_of(path):
                if self._builder is not None and not self._builder.knows(main):
                    self._due.setdefault(main, time.monotonic())
        self._forget_builds()
        self._publish_all()
        if result.main.lower().endswith(XML_ENDINGS):  # what a hover is going to ask
            _ = result.values, result.robot
        hints = (workspace.client.get("workspace") or {}).get("inlayHint") or {}
        if workspace.settings.has_hints and hints.get("refreshSupport"):
            self._requests += 1
            identity = f"refresh {self._requests}"
            self._wire.write({"id": identity, "method": "workspace/inlayHint/refresh"})

    def _forget_builds(self) -> None:
        """Forget the results of files that are parts of other programs, or not needed any more."""
        workspace = self._workspace
        wanted = {main for path in workspace.open for main in workspace.mains_of(path)}
        for main in [main for main in workspace.results if main not in wanted]:
            del workspace.results[main]
            workspace.good.pop(main, None)

    # --- messages to the editor -------------------------------------------------------------

    def _publish(self, path: str) -> None:
        if self._publisher is None:
            from .findings import Publisher

            self._publisher = Publisher(self._workspace)
        message = self._publisher.message(path)
        if message is not None:
            self._wire.write(message)

    def _publish_all(self) -> None:
        from .findings import home_of

        paths = dict.fromkeys(self._workspace.open)
        for result in self._workspace.results.values():
            paths.update(dict.fromkeys(home_of(each, result) for each in result.diagnostics))
        if self._publisher is not None:
            paths.update(dict.fromkeys(self._publisher.shown()))
        for path in paths:
            self._publish(path)

    def _log(self, text: str) -> None:
        self._wire.write({"method": "window/logMessage", "params": {"type": 1, "message": text}})

    def _send_error(self, identity: Json, code: int, text: str) -> None:
        self._wire.write({"id": identity, "error": {"code": code, "message": text}})

    # --- messages of the editor -------------------------------------------------------------

    def _take(self, message: Json) -> int | None:
        """Handle a message; return the exit status if it is the last."""
        if not isinstance(message, dict):
            self._send_error(None, INVALID_REQUEST, "a message is an object")
            return None
        method = message.get("method")
        if method is None:  # the answer to a request of ours
            return None
        if method == "exit":
            return 0 if self._is_shut_down else 1
        parameters = message.get("params")
        if "id" in message:
            self._answer(message["id"], str(method), {} if parameters is None else parameters)
        elif self._is_initialized and not self._is_shut_down and str(method) in _NOTICES:
            try:
                _NOTICES[str(method)](self, parameters)
            except (KeyError, TypeError, AttributeError, ValueError) as error:
                self._log(f"{method}: {type(error).__name__}: {error}")
                if _is_fault(error):
                    self._report(method, error)
            except OSError:
                raise
            except Exception as error:
                self._report(method, error)
        return None

    def _answer(self, identity: Json, method: str, parameters: Json) -> None:
        if self._is_shut_down:
            self._send_error(identity, INVALID_REQUEST, "the server is shut down")
            return
        if not self._is_initialized and method != "initialize":
            self._send_error(identity, NOT_INITIALIZED, "the first request is 'initialize'")
            return
        try:
            result = self._result(method, parameters)
        except RequestFailed as error:
            self._send_error(identity, error.code, str(error))
        except (KeyError, TypeError, AttributeError, ValueError) as error:
            self._send_error(identity, INVALID_PARAMS, f"{type(error).__name__}: {error}")
            if _is_fault(error):
                self._report(method, error)
        except Exception as error:
            self._send_error(identity, INTERNAL_ERROR, f"{type(error).__name__}: {error}")
            self._report(method, error)
        else:
            self._wire.write({"id": identity, "result": result})

    def _report(self, method: str, error: Exception) -> None:
        """Log a fault of the server with its traceback."""
        import traceback

        self._log(f"{method}:\n" + "".join(traceback.format_exception(error)))

    def _result(self, method: str, parameters: Json) -> Json:
        if method == "initialize":
            from ... import __version__
            from .protocol import capabilities

            workspace = self._workspace
            workspace.client = parameters.get("capabilities") or {}
            offered = (workspace.client.get("general") or {}).get("positionEncodings")
            workspace.encoding = agreed_encoding(offered)
            workspace.settings = Settings(parameters.get("initializationOptions"))
            workspace.folders = folders_of(parameters)
            parent = parameters.get("processId")
            self._parent = parent if isinstance(parent, int) else None
            self._is_initialized = True
            return {
                "capabilities": capabilities(workspace.encoding),
                "serverInfo": {"name": "yamaro", "version": __version__},
            }
        if method == "shutdown":
            self._is_shut_down = True
            return None
        if method not in FEATURES:
            raise RequestFailed(f"unknown method '{method}'", METHOD_NOT_FOUND)
        return feature(method)(self._workspace, parameters)

    def _initialized(self, parameters: Json) -> None:
        if self._workspace.folders:
            from .builds import Builder

            self._builder = Builder(
                self._workspace.settings, lambda result: self._events.put(("done", result))
            )
            self._scan()

    def _scan(self) -> None:
        """Look through the workspace, when the builds that wait are done."""
        settings, folders = self._workspace.settings, list(self._workspace.folders)
        if self._builder is not None and folders:
            self._builder.work(lambda: scan(folders, settings))

    def _opened(self, parameters: Json) -> None:
        document = parameters["textDocument"]
        opened = self._workspace.add(document["uri"], document.get("version"), document["text"])
        self._publish(opened.text.path)
        self._touch(opened.text.path, pause=0.0)

    def _changed(self, parameters: Json) -> None:
        document = parameters["textDocument"]
        opened = self._workspace.change(
            document["uri"], document.get("version"), parameters["contentChanges"]
        )
        path = opened.text.path
        for main in self._workspace.mains_of(path):
            if self._builder is not None:
                self._builder.abandon(main)
        self._edited[path] = None

    def _saved(self, parameters: Json) -> None:
        self._touch(path_of(parameters["textDocument"]["uri"]), pause=0.0)

    def _closed(self, parameters: Json) -> None:
        path = path_of(parameters["textDocument"]["uri"])
        mains = self._workspace.mains_of(path)
        self._workspace.open.pop(path, None)
        self._edited.pop(path, None)
        self._forget_builds()
        for main in mains:
            if main in self._workspace.results:
                self._due[main] = time.monotonic()
            else:
                self._due.pop(main, None)
        self._publish_all()

    def _files_changed(self, parameters: Json) -> None:
        workspace = self._workspace
        for change in parameters["changes"]:
            path = path_of(change["uri"])
            if os.path.basename(path) == MANIFEST and not self._has_new_packages:
                self._has_new_packages = True
                self._scan()
            text = workspace.text_of(path) if may_be_of_robots(path) else None
            if text is not None and workspace.note_includes(path, workspace.includes_of(text)):
                for opened in list(workspace.open):
                    self._touch(opened, pause=workspace.settings.pause)
            mains = workspace.mains_of(path)  # a file that was missing is in none of the results
            for main, result in workspace.results.items():
                if (path in result.files or main in mains) and path not in workspace.open:
                    self._due[main] = time.monotonic() + workspace.settings.pause


def _is_fault(error: Exception) -> bool:
    """Return whether an exception is likely one of ours: raised deeper than a request is read."""
    depth, step = 0, error.__traceback__
    while step is not None:
        depth, step = depth + 1, step.tb_next
    return depth > 5


_NOTICES: dict[str, Callable[[Server, Json], None]] = {
    "initialized": Server._initialized,
    "textDocument/didOpen": Server._opened,
    "textDocument/didChange": Server._changed,
    "textDocument/didSave": Server._saved,
    "textDocument/didClose": Server._closed,
    "workspace/didChangeWatchedFiles": Server._files_changed,
}
