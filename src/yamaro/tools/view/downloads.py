"""The robot that is shown, as the files that `yamaro FILE --to FORMAT -o FOLDER/` writes."""

from __future__ import annotations

import io
import secrets
import threading
import zipfile

from ...allowances import set_aside
from ...confined import FaultInJail
from ...diagnostics import ERROR, YamaroError
from ...options import UsageError
from ...targets.losses import diagnostics_of
from ...targets.output import marked
from ...targets.writers import ENDINGS
from .description import diagnostic_data

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...result import Build
    from ..rebuilding import Rebuilder

    Json = dict[str, object]

FORMATS = tuple(ENDINGS)
_DATE = (1980, 1, 1, 0, 0, 0)
"""Of all files in an archive, so that the same robot gives the same bytes."""
_MODE = 0o644 << 16


class Downloads:
    """Writes a robot in the formats that are asked for, and keeps the last until it is fetched."""

    def __init__(self, rebuilder: Rebuilder) -> None:
        """Download what that builds."""
        self._rebuilder = rebuilder
        self._lock = threading.Lock()
        self._kept: tuple[str, str, bytes] | None = None  # key, name, content

    def prepare(self, format: str, values: Mapping[str, object]) -> Json:
        """Write the robot in a format; return what the page shows of it, as data for JSON.

        Args:
            format: one of `FORMATS`.
            values: the variables that the page sets.
        """
        with self._lock:  # one at a time: the page asks for one, and it may take long
            try:
                build = self._rebuilder.build_as(format, values)
                name, content = packed(build)
            except YamaroError as error:
                errors = [each for each in error.diagnostics if each.severity == ERROR]
                return {"diagnostics": [diagnostic_data(each) for each in errors]}
            except UsageError as error:
                return {"diagnostics": [], "fault": str(error)}
            except OSError as error:
                reason = error.strerror or str(error)
                return {"diagnostics": [], "fault": f"a mesh cannot be read: {reason}"}
            except FaultInJail as error:
                return {"diagnostics": [], "fault": f"internal error: {error}"}
            key = secrets.token_urlsafe(9)
            self._kept = (key, name, content)
        losses = diagnostics_of(build.losses, format)
        set_aside(losses)
        return {
            "key": key,
            "name": name,
            "bytes": len(content),
            "diagnostics": [diagnostic_data(each) for each in losses],
        }

    def fetch(self, key: str) -> tuple[str, bytes] | None:
        """Return name and content of what was prepared last, if that has this key."""
        kept = self._kept
        return None if kept is None or kept[0] != key else kept[1:]


def packed(build: Build) -> tuple[str, bytes]:
    """Return the document of a build with its name; with files beside it they are an archive.

    Raises:
        OSError: a mesh cannot be read any more.
    """
    document = marked(b"".join(build.encoded()))
    assets = build.assets
    if not assets:
        return build.file_name, document
    stem = build.file_name.removesuffix(ENDINGS[build.format])
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in {build.file_name: document, **assets}.items():
            entry = zipfile.ZipInfo(f"{stem}/{name}", _DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = _MODE
            file.writestr(entry, content)
    return f"{stem}-{build.format}.zip", archive.getvalue()
