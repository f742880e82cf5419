"""Writes the GitHub workflow that a page of the documents shows."""

import re
import sys
from pathlib import Path

page = Path(sys.argv[1]).read_text(encoding="utf-8")
blocks = re.findall(r"```yaml not-run\n(.*?)```", page, re.DOTALL)
(workflow,) = [block for block in blocks if ".github/workflows" in block]
sys.stdout.write(workflow)
