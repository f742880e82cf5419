"""The work of a migration grows with the size of what is migrated, and hardly faster."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.counting import lines_of
from yamaro.policy import Limits, Policy
from yamaro.tools.migrate.job import Job
from yamaro.tools.migrate.urdf import read_file

LARGE = 200

MIGRATED: dict[str, tuple[Callable[[int], str], bool]] = {
    "brackets without an end": (lambda n: f"<link name='{'$(' * n}'/>", False),
    "braces without an end": (lambda n: f"<link name='{'${' * n}'/>", False),
    "elements in one another": (
        lambda n: f"<link name='a'>{'<x>' * (n // 4)}{'</x>' * (n // 4)}</link>", False,
    ),
    "expressions in a text": (lambda n: f"<link name='a'><x v='{'${1} ' * n}'/></link>", True),
    "properties in reverse": (
        lambda n: "".join(
            f"<xacro:property name='p{i}' value='${{p{i + 1} + 1}}'/>" for i in range(n)
        ) + f"<xacro:property name='p{n}' value='0'/>",
        True,
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", MIGRATED)
def test_migration_grows_with_the_size_and_hardly_faster(case: str, tmp_path: Path) -> None:
    text, is_xacro = MIGRATED[case]

    def lines(count: int) -> int:
        path = tmp_path / ("r.xacro" if is_xacro else "r.urdf")
        words = " xmlns:xacro='http://www.ros.org/wiki/xacro'" if is_xacro else ""
        path.write_text(f"<robot name='r'{words}>{text(count)}</robot>")
        source = read_file(str(path), Limits())
        return lines_of(Job(source, str(tmp_path), policy=Policy("trusted")).run)

    lines(1)  # what has to be imported is, then
    few, many = lines(LARGE), lines(2 * LARGE)
    assert many < 2.6 * few, (few, many)
