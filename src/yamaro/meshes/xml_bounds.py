"""Bounds of the formats in XML: COLLADA, and the models in a 3MF archive.

They are read by Expat before another library sees them. What no mesh needs is refused: a document
type, since entities grow, and encodings in which two readers might see two different documents.
"""

from __future__ import annotations

from .bounds import MOST_NAMES, Body, check_placed
from .formats import LARGEST_FILE, MeshFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any
    from zipfile import ZipFile, ZipInfo

DEEPEST = 200
"""Elements in one another."""
_TOO_LARGE = f"unpacked it is larger than {LARGEST_FILE >> 20} MB"
_PIECE = 1 << 20
MOST_ENTRIES = 1_000
"""Files in an archive."""
_ENCODINGS = frozenset(("utf-8", "utf-16", "us-ascii", "ascii", "iso-8859-1", "windows-1252"))


class _Reader:
    """Reads XML through Expat, and calls `opened` and `closed` with the local names."""

    root = ""

    def __init__(self) -> None:
        from pyexpat import ParserCreate

        self.depth = 0
        self.text: list[str] | None = None
        self.parser: Any = ParserCreate()
        self.parser.XmlDeclHandler = self._declared
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end

    def read(self, data: bytes) -> None:
        """Read a document; raise MeshFileError if it is not XML, or not of this kind."""
        from pyexpat import ExpatError

        try:
            self.parser.Parse(data, True)
        except ExpatError as error:
            raise MeshFileError(f"its XML is broken: {error}") from None
        except (ValueError, LookupError) as error:  # of an encoding that there is not
            raise MeshFileError(f"it cannot be decoded: {error}") from None

    def _declared(self, _version: str, encoding: str | None, _standalone: int) -> None:
        if encoding is not None and encoding.lower() not in _ENCODINGS:
            raise MeshFileError("its encoding is not UTF-8")

    @staticmethod
    def _doctype(*_: object) -> None:
        raise MeshFileError("it has a document type, which meshes do not need")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        local = name.rpartition(":")[2]
        if self.depth == 0 and local != self.root:
            raise MeshFileError(f"its root is not <{self.root}>")
        self.depth += 1
        if self.depth > DEEPEST:
            raise MeshFileError(f"it has more than {DEEPEST} elements in one another")
        self.opened(local, attributes)

    def _end(self, name: str) -> None:
        self.depth -= 1
        self.closed(name.rpartition(":")[2])

    def listen(self) -> None:
        """Gather the text from here on."""
        self.text = []
        self.parser.CharacterDataHandler = self.text.append

    def gathered(self) -> str:
        """Return the text since `listen`."""
        text = "".join(self.text or ())
        self.text = None
        self.parser.CharacterDataHandler = None
        return text

    def opened(self, name: str, attributes: dict[str, str]) -> None:
        raise NotImplementedError

    def closed(self, name: str) -> None:
        raise NotImplementedError


class _Collada(_Reader):
    """The nodes of a COLLADA file, and the images that it names."""

    root = "COLLADA"

    def __init__(self) -> None:
        super().__init__()
        self.names: list[str] = []
        self.roots: list[Body] = []
        self.nodes: dict[str, list[Body]] = {}
        self._sizes: dict[str, int] = {}
        self._open: list[Body] = []
        self._geometry = ("", 0)

    def opened(self, name: str, attributes: dict[str, str]) -> None:
        if name in ("node", "visual_scene"):
            body = Body()
            (self._open[-1].inside if self._open else self.roots).append(body)
            self._open.append(body)
            if name == "node" and "id" in attributes:
                self.nodes.setdefault(f"#{attributes['id']}", []).append(body)
        elif name == "instance_node" and self._open:
            self._open[-1].inside.append(attributes.get("url", ""))
        elif name in ("instance_geometry", "instance_controller") and self._open:
            self._open[-1].inside.append(f"geometry {attributes.get('url', '')}")
        elif name == "geometry":
            self._geometry = (attributes.get("id", ""), self.parser.CurrentByteIndex)
        elif name == "init_from" and len(self.names) < MOST_NAMES:
            self.listen()

    def closed(self, name: str) -> None:
        if name in ("node", "visual_scene"):
            self._open.pop()
        elif name == "geometry":
            own, start = self._geometry
            body = Body()
            body.own.append((0, self.parser.CurrentByteIndex - start))
            self.nodes.setdefault(f"geometry #{own}", []).append(body)
        elif name == "init_from" and self.text is not None:
            self.names.append(self.gathered().strip())


class _Model(_Reader):
    """The objects of a 3MF model, and the parts that it places."""

    root = "model"

    def __init__(self, path: str, objects: dict[str, list[Body]]) -> None:
        super().__init__()
        self.build = Body()
        self._path = path
        self._objects = objects
        self._object = Body()
        self._start_of_object = 0

    def _key(self, attributes: dict[str, str], name: str) -> str:
        """Return the key of an object, which may be in another model of the archive."""
        paths = [value for key, value in attributes.items() if key.rpartition(":")[2] == "path"]
        return f"{(paths[0] if paths else self._path).lstrip('/')}#{attributes.get(name, '')}"

    def opened(self, name: str, attributes: dict[str, str]) -> None:
        if name == "object":
            self._object = Body()
            self._start_of_object = self.parser.CurrentByteIndex
            self._objects.setdefault(self._key({}, "") + attributes.get("id", ""), []).append(
                self._object
            )
        elif name == "component":
            self._object.inside.append(self._key(attributes, "objectid"))
        elif name == "item":
            self.build.inside.append(self._key(attributes, "objectid"))

    def closed(self, name: str) -> None:
        if name == "object":
            self._object.own.append((0, self.parser.CurrentByteIndex - self._start_of_object))


def check_collada(data: bytes) -> list[str]:
    """Return the names of images in a COLLADA file; raise MeshFileError if it is out of bounds."""
    reader = _Collada()
    reader.read(data)
    check_placed(reader.roots, reader.nodes)
    return [name for name in dict.fromkeys(reader.names) if name]


def _broken() -> tuple[type[Exception], ...]:
    """Return what is raised for an archive that is broken; zlib and zipfile take time to load."""
    from zipfile import BadZipFile, LargeZipFile
    from zlib import error

    unusual = (NotImplementedError, RuntimeError, EOFError, KeyError, ValueError, OSError)
    return (BadZipFile, LargeZipFile, error, *unusual)


def stored_threemf(data: bytes) -> bytes:
    """Return a 3MF archive with its models and relations, which are not compressed.

    A library unpacks an entry whole, and finds out afterwards that it is larger than it says.

    Raises:
        MeshFileError: it is broken, or larger than a file may be.
    """
    from io import BytesIO
    from zipfile import ZipFile

    stored, size = BytesIO(), 0
    try:
        with ZipFile(BytesIO(data)) as archive, ZipFile(stored, "w") as copy:
            named = {each.filename: each for each in archive.infolist()}
            for name, entry in named.items():
                if name.endswith((".model", ".rels")):
                    content = _entry(archive, entry)
                    size += len(content)
                    if size > LARGEST_FILE:
                        raise MeshFileError(_TOO_LARGE)
                    copy.writestr(name, content)
    except _broken() as error:
        raise MeshFileError(f"it is not a ZIP archive: {error}") from None
    return stored.getvalue()


def _entry(archive: ZipFile, entry: ZipInfo) -> bytes:
    """Return the content of an entry, which is unpacked by pieces up to the size it says."""
    from zipfile import ZIP_DEFLATED, ZIP_STORED

    if entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):  # others are not unpacked by pieces
        raise MeshFileError("its archive is compressed in a way that 3MF does not have")
    if entry.file_size > LARGEST_FILE:
        raise MeshFileError(_TOO_LARGE)
    with archive.open(entry) as file:
        return b"".join(iter(lambda: file.read(_PIECE), b""))


def check_threemf(data: bytes) -> list[str]:
    """Raise MeshFileError if a 3MF archive or a model in it is out of bounds."""
    from io import BytesIO
    from zipfile import ZipFile

    try:
        with ZipFile(BytesIO(data)) as archive:
            entries = archive.infolist()
            if len(entries) > MOST_ENTRIES:
                raise MeshFileError(f"it holds more than {MOST_ENTRIES:,} files")
            if sum(entry.file_size for entry in entries) > LARGEST_FILE:
                raise MeshFileError(_TOO_LARGE)
            models = [each.filename for each in entries if each.filename.endswith(".model")]
            objects: dict[str, list[Body]] = {}
            readers = [_Model(name, objects) for name in dict.fromkeys(models)]
            for name, reader in zip(dict.fromkeys(models), readers, strict=True):
                reader.read(_entry(archive, archive.getinfo(name)))
            check_placed([reader.build for reader in readers], objects)
            check_placed((each for found in objects.values() for each in found), objects)
    except _broken() as error:
        raise MeshFileError(f"it is not a ZIP archive: {error}") from None
    if not models:
        raise MeshFileError("it holds no model")
    return []
