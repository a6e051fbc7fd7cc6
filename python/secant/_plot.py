"""Pictures of secant in Matplotlib axes."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from typing import Any

_COMMAND = re.compile(r"([MLHVZ])|(-?\d+(?:\.\d+)?)", re.IGNORECASE)
_COLOURS = {"tangent": "#1a8a4a", "cusp": "#b06a00", "corner": "#c4332b", "open": "#7a4fb5", "p": "#8a8f98"}


def _lines(path: str) -> list[list[tuple[float, float]]]:
    """The stretches of a path of straight lines, with the second axis upwards."""
    lines: list[list[tuple[float, float]]] = []
    command = "M"
    numbers: list[float] = []
    for letter, digits in _COMMAND.findall(path):
        if letter:
            command, numbers = letter, []
            if letter in "Zz" and lines:
                lines[-1].append(lines[-1][0])
            continue
        numbers.append(float(digits))
        if len(numbers) < 2 and command in "MLml":
            continue
        x, y = lines[-1][-1] if lines else (0.0, 0.0)
        if command in "ML":
            x, y = numbers[0], -numbers[1]
        elif command == "H":
            x = numbers[0]
        elif command == "V":
            y = -numbers[0]
        if command == "M":
            lines.append([])
            command = "L"
        lines[-1].append((x, y))
        numbers = []
    return lines


def _colour(classes: str) -> str:
    return next((c for word, c in _COLOURS.items() if f"sc-{word}" in classes.split()), "#1f5fbf")


def draw(svg: str, title: str, ax: Any = None) -> Any:
    """Draws the lines and dots of a picture."""
    import matplotlib.pyplot as plt

    ax = plt.figure().add_subplot() if ax is None else ax
    for element in ElementTree.fromstring(svg).iter():
        classes, kind = element.get("class", ""), element.tag.rsplit("}", 1)[-1]
        style: dict[str, Any] = {"color": _colour(classes), "linewidth": 1.2}
        if "sc-p" in classes.split():
            style["linestyle"] = "--"
        if kind == "path":
            for line in _lines(element.get("d", "")):
                ax.plot([x for x, _ in line], [y for _, y in line], **style)
        elif kind == "circle":
            x, y = float(element.get("cx", "0")), float(element.get("cy", "0"))
            ax.plot([x], [-y], ".", color=style["color"], markersize=4)
    ax.set_title(title)
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax
