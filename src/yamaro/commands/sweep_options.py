"""The options that only `yamaro sweep` takes; see `option_table.py`."""

from __future__ import annotations

from .option import Option

SWEEP = ("sweep",)

SWEEP_OPTIONS = (
    Option("samples", "how many variants; a grid knows", SWEEP, value="N", wants="a whole number"),
    Option(
        "method",
        "how variants are chosen: latin (with --samples), grid (the default without), random "
        "or sobol",
        SWEEP,
        value="METHOD",
        wants="grid, random, latin or sobol",
        choices=("grid", "random", "latin", "sobol"),
    ),
    Option("seed", "seed of what is random; 0 by default", SWEEP, value="N", wants="a number"),
    Option(
        "keep",
        "reject variants that do not meet this condition, such as 'thigh + shank < 0.7'",
        SWEEP,
        value="CONDITION",
        wants="a Python expression",
        is_repeatable=True,
    ),
    Option(
        "metrics",
        "measure this of each variant, such as mass,reach or 'stable(5)'",
        SWEEP,
        value="NAMES",
        wants="names of metrics",
        is_repeatable=True,
    ),
    Option(
        "evaluate",
        "evaluate each variant with a Python function of yours",
        SWEEP,
        value="FILE.py:FUNCTION",
        wants="FILE.py:FUNCTION",
    ),
    Option("models", "keep the documents too, in tar files", SWEEP),
    Option(
        "engine",
        "where variants are built: local:8 (processes; the default, with all processors), "
        "dask://HOST:PORT, dask:8 (a cluster on this machine), ray://HOST:PORT or ray:8",
        SWEEP,
        value="ENGINE",
        wants="local:N, dask://HOST:PORT, dask:N, ray://HOST:PORT or ray:N",
        completes="local: dask:// dask: ray:// ray:",
    ),
    Option(
        "x",
        "with 'plot', the columns along x; by default the arguments that vary",
        SWEEP,
        value="COLUMNS",
        wants="names of columns",
        is_repeatable=True,
    ),
    Option(
        "y",
        "with 'plot', the columns along y; by default the results",
        SWEEP,
        value="COLUMNS",
        wants="names of columns",
        is_repeatable=True,
    ),
    Option(
        "metric",
        "with 'plot', colour the variants by this column, and draw the best, the median and "
        "the worst",
        SWEEP,
        value="COLUMN",
        wants="the name of a column",
    ),
    Option("minimize", "with 'plot', the variant with the least '--metric' is the best", SWEEP),
    Option("resume", "go on with the sweep in the folder, which was stopped", SWEEP),
)
