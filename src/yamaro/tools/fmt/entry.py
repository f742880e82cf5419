"""`yamaro fmt FILE|FOLDER...`: brings YAML files into one style, without running them."""

from __future__ import annotations

from ...commands.arguments import make_policy
from ...commands.command_table import Command
from ...commands.conversion import read_bytes
from ...commands.option_table import Option
from ...commands.reports import DONE, INPUT_ERROR, USAGE_ERROR, WrongUsage, quote, show
from ...source import STANDARD_INPUT, STANDARD_INPUT_NAME

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...policy import Limits
    from ...streams import Streams

COMMAND = Command(
    "fmt",
    ("FILE|FOLDER...",),
    "format YAML files in one style",
    "Bring YAML files into one style: indentation, spaces and blank lines. Comments, "
    "order, quotes and numbers stay as they are written. The files are not run.",
    words=(
        ("FILE", "a YAML file; - formats standard input to standard output"),
        ("FOLDER", "formats the files *.urdf.yaml and *.yamaro.yaml in it and below"),
    ),
    looks=True,
    endings=("yaml", "yml"),
    examples=(
        "yamaro fmt robot.yaml leg.yaml",
        "yamaro fmt --check *.yaml",
        "yamaro fmt .",
    ),
    takes_several=True,
    place=14,
    options=(
        Option("check", "change no file; exit with 1 if one is not formatted"),
        Option("diff", "change no file; show what would change, and exit with 1 if anything"),
        "quiet",
        "limit",
        "color",
    ),
    help_of={"quiet": "do not name the files"},
)

_MARK = b"\xef\xbb\xbf"


class _Text:
    """A file before and after.

    Attributes:
        path: as it was written on the command line.
        name: what it is called in messages.
        old: its text.
        new: its text in Yamaro's style.
        has_mark: whether it begins with a byte order mark.
    """

    __slots__ = ("has_mark", "name", "new", "old", "path")

    def __init__(self, path: str, name: str, old: str, new: str, *, has_mark: bool) -> None:
        self.path = path
        self.name = name
        self.old = old
        self.new = new
        self.has_mark = has_mark

    def data(self) -> bytes:
        """Return what the file has to hold."""
        return (_MARK if self.has_mark else b"") + self.new.encode()


def run(arguments: Arguments, streams: Streams) -> int:
    """Format files, and those of folders; return the exit status, the worst of them."""
    from ...diagnostics import YamaroError
    from ...files.loader import LoadError
    from ...layout import LayoutFault

    if arguments.assignments:
        raise WrongUsage("the style of a file does not depend on 'name:=value'")
    limits = make_policy(arguments).limits
    status = DONE
    for path in _files(arguments.words):
        try:
            text = _formatted(path, limits)
            status = max(status, _deliver(text, arguments, streams))
        except YamaroError as error:
            show(error.diagnostics, arguments, streams)
            status = max(status, INPUT_ERROR)
        except LoadError as error:
            streams.say(f"yamaro: error: cannot read {quote(path)}: {error}")
            status = USAGE_ERROR
        except LayoutFault as error:
            streams.say(
                f"yamaro: internal error: {quote(path)}: {error}; it was left as it is\n"
                "this is a bug in Yamaro, not in your file; please report it with the file"
            )
            status = max(status, INPUT_ERROR)
    return status


def _files(words: list[str]) -> list[str]:
    """Return the files that words name: for a folder, those below it that are Yamaro's by name.

    Raises:
        WrongUsage: there is none in a folder.
    """
    import os

    from ...files.regular import ROBOT_ENDINGS, files_below

    found: list[str] = []
    for word in words:
        if not os.path.isdir(word):
            found.append(word)
            continue
        below = [path for path in files_below(word, ROBOT_ENDINGS) if not os.path.islink(path)]
        if not below:
            example = os.path.join(os.path.normpath(word), "*.yaml")
            raise WrongUsage(
                f"no file in the folder {quote(word)} is named '*.urdf.yaml' or '*.yamaro.yaml', "
                "and other YAML files may not be for Yamaro; to format others, name them: "
                f"yamaro fmt {example}"
            )
        found += below
    return list(dict.fromkeys(found))


def _formatted(path: str, limits: Limits) -> _Text:
    """Return a file before and after.

    Raises:
        YamaroError: it is not YAML.
        LoadError: it cannot be read.
        LayoutFault: the formatter would change what it means.
    """
    import os

    from ...files.loader import FileLoader, check_size, decode
    from ...layout import formatted
    from ...source import holds_xml

    data = read_bytes(path, limits.file + 1)
    if data is None:
        data = FileLoader(limits).read(os.path.abspath(path))
    check_size(len(data), limits)
    is_input = path == STANDARD_INPUT
    name = STANDARD_INPUT_NAME if is_input else path
    source = decode(data, name=name, path="" if is_input else os.path.abspath(path))
    if holds_xml(path, source.text):
        raise WrongUsage(f"{quote(name)} is XML; 'yamaro fmt' formats YAML files")
    new = formatted(source, limits)
    return _Text(path, name, source.text, new, has_mark=data.startswith(_MARK))


def _deliver(text: _Text, arguments: Arguments, streams: Streams) -> int:
    """Write a file, or say how it differs; return the exit status."""
    differs = text.new != text.old
    if arguments.has("diff"):
        if differs:
            import difflib

            from ...streams import NAMES

            old, new = (each.splitlines(keepends=True) for each in (text.old, text.new))
            lines = [
                line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
                for line in difflib.unified_diff(old, new, text.name, f"{text.name} formatted")
            ]
            streams.write_result(["".join(lines).encode()], NAMES)
        return INPUT_ERROR if differs else DONE
    if arguments.has("check"):
        if differs and not streams.quiet:
            streams.say(f"{text.name}: not formatted")
        return INPUT_ERROR if differs else DONE
    if text.path == STANDARD_INPUT:
        streams.write_result([text.data()])
        return DONE
    if not differs:
        return DONE
    import os

    from ...output import write_file

    if not os.path.isfile(text.path):
        streams.say(
            f"yamaro: error: cannot write {quote(text.path)}: it is not a regular file; "
            "'yamaro fmt -' formats standard input"
        )
        return INPUT_ERROR
    try:
        write_file(text.path, [text.data()])
    except OSError as error:
        streams.say(f"yamaro: error: cannot write {quote(text.path)}: {error.strerror or error}")
        return INPUT_ERROR
    if not streams.quiet:
        streams.say(f"{text.name}: formatted")
    return DONE
