"""Random edits over the wire: the text is the editor's, and the reports are those of `check`."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.effort import examples
from tests.tools.lsp.editing import edit_at_random

ROOT = Path(__file__).parents[3]
MAINS = ("quadruped/quadruped.yaml", "diff_drive/diff_drive.yaml", "pan_tilt/pan_tilt.yaml")


@pytest.mark.parametrize("main", MAINS)
def test_after_random_edits_text_and_reports_are_right(tmp_path, main):
    """`scripts/bench lsp` makes 10,000 edits."""
    path = ROOT / "examples" / main
    assert edit_at_random(tmp_path, path, examples(300), seed=len(main)) > 0
