"""Plots a sweep: each result against each length, coloured by the cost of transport.

python plot.py runs legs.png
"""

import sys

import matplotlib.pyplot as plt

import yamaro

ACROSS = ("leg_length", "thigh_length", "calf_length")
UP = ("cost_of_transport", "work", "heat", "frequency")
COLOR = "cost_of_transport"


def main(folder: str, output: str) -> None:
    table = yamaro.Sweep(folder).columns(*ACROSS, *UP)
    rows = [row for row, value in enumerate(table[COLOR]) if value is not None]

    def values(name: str) -> list[float]:
        return [table[name][row] for row in rows]

    figure, grid = plt.subplots(
        len(UP), len(ACROSS), sharex="col", sharey="row", figsize=(8, 8), layout="constrained"
    )
    for up, line in zip(UP, grid, strict=True):
        for across, axes in zip(ACROSS, line, strict=True):
            dots = axes.scatter(values(across), values(up), 8, values(COLOR))
            axes.label_outer()
            axes.set(xlabel=across.replace("_", " "), ylabel=up.replace("_", " "))
    figure.suptitle(f"{len(rows)} of {len(table['id'])} variants walk")
    figure.colorbar(dots, ax=grid, label=COLOR.replace("_", " "), shrink=0.5)
    figure.savefig(output, dpi=144)


if __name__ == "__main__":
    main(*sys.argv[1:])
