"""Draws figures of gnbv with matplotlib. A figure is a dict of figures.schema.json (`gnbv schema
figures`): all that is computed is computed before. The program runs this file as it is, without the
package: matplotlib is all that it imports."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.style
from matplotlib import font_manager
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

Data = dict[str, Any]

DPI = 432
COLUMN_PX = 1512  # 3.5 inches: a column of a paper
LEFT = 0.015  # where title and legend begin, as a share of the width
LINE = 62  # letters that fit beside each other in a panel's first line
INK, GREY, SHADE, BAND = "#262c36", "#5c6470", "#dcebf5", "#f2f4f7"
MARKERS = {"circle": "o", "square": "s", "triangle": "^", "downward": "v", "diamond": "D"}
MARKERS["pentagon"] = "p"
METADATA = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {"Software": None}}
TEX = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}


def style(scale: float = 1.0, font: str = "") -> Any:
    """matplotlib's settings: letters of 7.5 points in 3.5 inches, files without a date."""
    small, line = 7.5 * scale, 0.5 * scale
    tick = {"color": GREY, "labelcolor": "#3a424d", "labelsize": small}
    tick |= {"major.pad": 1.5 * scale, "major.size": 2.0 * scale, "major.width": line}
    settings: Data = {f"{of}.{key}": tick[key] for of in ("xtick", "ytick") for key in tick}
    for sized in ("font.size", "axes.titlesize", "axes.labelsize", "legend.fontsize"):
        settings[sized] = small
    return settings | {
        "font.family": [font, "DejaVu Sans"] if font else ["DejaVu Sans"],
        "text.color": INK,
        "axes.labelcolor": INK,
        "axes.edgecolor": GREY,
        "axes.linewidth": line,
        "axes.labelpad": 2.0 * scale,
        "axes.titlepad": 3.0 * scale,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e4e7eb",
        "grid.linewidth": line,
        "legend.frameon": False,
        "legend.handlelength": 2.2,
        "legend.handletextpad": 0.6,
        "legend.labelspacing": 0.35,
        "legend.borderpad": 0.0,
        "legend.borderaxespad": 0.0,
        "legend.columnspacing": 1.2,
        "svg.hashsalt": "gnbv",
        "svg.fonttype": "none",  # letters stay letters
        "pdf.fonttype": 42,  # as journals want them
    }


def safe(text: str) -> str:
    """The text as it is, whatever TeX or matplotlib's mathtext would make of its signs."""
    if matplotlib.rcParams["text.usetex"]:
        return "".join(TEX.get(c, "\\" + c if c in "%$#&_{}" else c) for c in text)
    return text.replace("$", r"\$")


def _dashes(series: Data) -> Any:
    return (0, tuple(series["dashes"])) if series["dashes"] else "solid"


def _line(series: Data, scale: float) -> Data:
    return {
        "color": series["colour"],
        "linewidth": series["width_pt"] * scale,
        "linestyle": _dashes(series) if series["width_pt"] else "none",
        "alpha": series["opacity"],
    }


def _point(series: Data, size_pt: float, edge: str | None = None) -> Data:
    return {
        "marker": MARKERS[series["marker"]],
        "markersize": size_pt,
        "markerfacecolor": series["colour"] if series["filled"] else "white",
        "markeredgecolor": edge or series["colour"],
        "markeredgewidth": 0.16 * size_pt,
    }


def _known(values: Iterable[float | None]) -> list[float]:
    return [float("nan") if value is None else value for value in values]


def _interval(ax: Axes, panel: Data, series: Data, scale: float) -> None:
    """Points with bars along x; an arrow where one goes on beyond the axis."""
    first, last = panel["x"]["low"], panel["x"]["high"]
    colour, width = series["colour"], 0.9 * scale
    for y, low, high in zip(series["y"], series["low"], series["high"], strict=True):
        ax.plot([max(low, first), min(high, last)], [y, y], color=colour, linewidth=width)
        for end, limit, arrow in ((low, first, "<"), (high, last, ">")):
            beyond = end < limit if arrow == "<" else end > limit
            ax.plot(
                [limit if beyond else end],
                [y],
                marker=arrow if beyond else "|",
                color=colour,
                markersize=3.5 * scale,
                markeredgewidth=width,
                clip_on=not beyond,
            )
    ax.plot(series["x"], series["y"], linestyle="none", **_point(series, series["size_pt"] * scale))


def _series(ax: Axes, panel: Data, series: Data, scale: float) -> None:
    mark = series["mark"]
    x, y = _known(series["x"]), _known(series["y"])
    low, high = _known(series["low"]), _known(series["high"])
    step: Any = "post" if mark == "steps" else None
    if mark == "interval":
        _interval(ax, panel, series, scale)
    elif mark == "level":
        ax.axhline(y[0], clip_on=False, **_line(series, scale))
    elif mark == "area":
        ax.fill_between(x, low, high, color=series["colour"], linewidth=0)
    else:
        if low:
            ax.fill_between(
                x, low, high, step=step, color=series["colour"], alpha=0.18, linewidth=0
            )
        points = _point(series, series["size_pt"] * scale) if mark == "points" else {}
        ax.plot(x, y, drawstyle="steps-post" if step else None, **_line(series, scale), **points)
    if series["end"]:
        end = _point(series, 3.4 * scale, edge="white")
        ax.plot(*[[at] for at in series["end"]], linestyle="none", zorder=4, **end)


def _axis(ax: Axes, which: str, axis: Data) -> None:
    if axis["log"]:
        getattr(ax, f"set_{which}scale")("log")
    ticks = axis["ticks"]
    at, texts = [tick["at"] for tick in ticks], [safe(tick["text"]) for tick in ticks]
    getattr(ax, f"set_{which}ticks")(at, labels=texts)
    getattr(ax, f"set_{which}ticks")([], minor=True)
    getattr(ax, f"set_{which}lim")(axis["low"], axis["high"])
    getattr(ax, f"set_{which}label")(safe(axis["label"]))


def draw_panel(ax: Axes, panel: Data, scale: float = 1.0) -> Axes:
    """One panel of a figure, without its legend."""
    for low, high in panel["shades"]["spans"]:
        ax.axvspan(low, high, color=SHADE, linewidth=0, zorder=0.5)
    for series in panel["series"]:
        _series(ax, panel, series, scale)
    for which in ("x", "y"):
        _axis(ax, which, panel[which])
    if panel["categories"]:
        ax.yaxis.grid(False)
        ax.tick_params(axis="y", length=0)
        for tick in panel["y"]["ticks"][::2]:
            ax.axhspan(tick["at"] - 0.5, tick["at"] + 0.5, color=BAND, linewidth=0, zorder=0.4)
    if panel["heading"]:
        ax.set_title(safe(panel["heading"]), loc="left", color=GREY)
    return ax


def legend_of(panel: Data, scale: float = 1.0) -> tuple[list[Any], list[str]]:
    """Handles and labels, of shades, then of the series that are named."""
    handles: list[Any] = []
    labels: list[str] = []
    if panel["shades"]["label"]:
        handles.append(Patch(color=SHADE))
        labels.append(safe(panel["shades"]["label"]))
    # what lies behind is explained below what lies before it
    named = [series for series in panel["series"] if series["label"]]
    for series in sorted(named, key=lambda one: one["mark"] == "level"):
        line: Artist = Line2D([], [], **_line(series, scale))
        if series["mark"] == "area":
            line = Patch(color=series["colour"])
        elif series["end"] or series["mark"] == "points":
            line = Line2D([], [], **_line(series, scale), **_point(series, 3.0 * scale))
        band = Line2D([], [], color=series["colour"], alpha=0.25, linewidth=4.5 * scale)
        band.set_solid_capstyle("butt")
        is_band = series["low"] and series["mark"] in ("line", "steps")
        handles.append((band, line) if is_band else line)
        labels.append(safe(series["label"]))
    return handles, labels


def rows_of(figure: Data, items: Sequence[Any]) -> list[list[Any]]:
    """What belongs to its panels, by the rows in which these stand."""
    left = iter(items)
    return [[next(left) for _ in range(count)] for count in figure["rows"]]


def add_panels(figure: Data, canvas: Figure, scale: float = 1.0) -> list[Axes]:
    """All panels, row by row; those below each other with one x axis share its numbers."""
    rows = rows_of(figure, figure["panels"])
    heights = [row[0]["height_px"] for row in rows]
    is_stack = all(row[0]["x"] == rows[-1][0]["x"] for row in rows)
    grid = canvas.add_gridspec(len(rows), max(figure["rows"]), height_ratios=heights)
    axes = []
    for place, row in enumerate(rows):
        for column, panel in enumerate(row):
            cell = grid[place, column] if len(row) > 1 else grid[place, :]
            ax = draw_panel(canvas.add_subplot(cell), panel, scale)
            if is_stack and place + 1 < len(rows):
                ax.set_xlabel("")
                ax.tick_params(labelbottom=False)
            if column > 0:
                ax.tick_params(labelleft=False)
            axes.append(ax)
    return axes


class _Header:
    """Title, legends and notes from the top left downwards, in inches from the top."""

    def __init__(self, canvas: Figure, scale: float) -> None:
        self.canvas, self.scale = canvas, scale
        renderer: Any = FigureCanvasAgg(canvas)
        self.renderer = renderer.get_renderer()
        self.end_in = 0.07 * scale
        self.artists: list[tuple[Any, float]] = []

    def _add(self, artist: Any) -> None:
        self.artists.append((artist, self.end_in))
        height_px = artist.get_window_extent(self.renderer).height
        self.end_in += height_px / self.canvas.dpi + 0.05 * self.scale

    def _share(self, artist: Any) -> float:
        """Of the figure's width."""
        return float(artist.get_window_extent(self.renderer).width / self.canvas.bbox.width)

    def _broken(self, text: str, most: float) -> str:
        """Into lines none of which is wider than that share of the figure."""
        letters = len(text)
        while True:
            lines = "\n".join(textwrap.wrap(text, letters))
            probe = self.canvas.text(0, 0, lines)
            share = self._share(probe)
            probe.remove()
            if share <= most or letters < 9:
                return lines
            letters = int(letters * min(0.95, most / share))

    def add_text(self, text: str, colour: str) -> None:
        if text:
            lines = self._broken(safe(text), 1 - 2 * LEFT)
            self._add(self.canvas.text(LEFT, 1, lines, va="top", color=colour))

    def add_legend(self, handles: list[Any], labels: list[str]) -> None:
        """In one row where that is wide enough, else an entry a row."""
        corner: Any = {"loc": "upper left", "bbox_to_anchor": (LEFT, 1.0)}
        legend = self.canvas.legend(handles, labels, ncol=len(labels), **corner)
        if self._share(legend) > 1 - 2 * LEFT:
            legend.remove()
            lines = [self._broken(label, 0.88 - 2 * LEFT) for label in labels]  # beside their marks
            legend = self.canvas.legend(handles, lines, **corner)
        self._add(legend)

    def place(self, height_in: float) -> None:
        for artist, top_in in self.artists:
            if isinstance(artist, Legend):
                place = (LEFT, 1 - top_in / height_in)
                artist.set_bbox_to_anchor(place, self.canvas.transFigure)
            else:
                artist.set_y(1 - top_in / height_in)


def _set_frames(
    figure: Data, axes: list[Axes], header: _Header, scale: float, height_in: float | None
) -> None:
    """Sets the canvas's height, and all frames so that their words have room and edges align."""
    canvas, width_in = header.canvas, 3.5 * scale
    panels, rows = rows_of(figure, figure["panels"]), rows_of(figure, axes)
    left_in = 0.09 * scale + max(
        ax.yaxis.get_tightbbox(header.renderer).width / canvas.dpi for ax, *_ in rows
    )
    at_edge = any(row[-1]["x"]["ticks"][-1]["at"] > 0.999 * row[-1]["x"]["high"] for row in panels)
    right_in = (0.17 if at_edge else 0.09) * scale
    above_in = [(0.19 if row[0]["heading"] else 0.06) * scale for row in panels]
    below_in = [(0.32 if ax.get_xlabel() else 0.04) * scale for ax, *_ in rows]
    frames_in = [row[0]["height_px"] / DPI * scale for row in panels]
    words_in = header.end_in + sum(above_in) + sum(below_in)
    if height_in is not None:
        share = max(height_in - words_in, 0.1 * height_in) / sum(frames_in)
        frames_in = [frame_in * share for frame_in in frames_in]
    height_in = height_in or words_in + sum(frames_in)
    canvas.set_size_inches(width_in, height_in)
    header.place(height_in)
    gap_in, top_in = 0.12 * scale, header.end_in
    for row, above, frame, below in zip(rows, above_in, frames_in, below_in, strict=True):
        each_in = (width_in - left_in - right_in - gap_in * (len(row) - 1)) / len(row)
        top_in += above + frame
        for column, ax in enumerate(row):
            x_in = left_in + column * (each_in + gap_in)
            bottom = 1 - top_in / height_in
            ax.set_position((x_in / width_in, bottom, each_in / width_in, frame / height_in))
        top_in += below


def draw(figure: Data, scale: float = 1.0, height_in: float | None = None) -> Figure:
    """The whole figure: its title, legend and notes at the top left, and its panels below."""
    canvas = Figure(figsize=(3.5 * scale, 3.0 * scale), dpi=DPI)  # letters are as wide as drawn
    header = _Header(canvas, scale)
    header.add_text(figure["title"], INK)
    axes = add_panels(figure, canvas, scale)
    for ax, panel in zip(axes, figure["panels"], strict=True):
        handles, labels = legend_of(panel, scale)
        words = len(panel["heading"]) + sum(len(label) + 6 for label in labels)
        if labels and (len(axes) == 1 or not panel["heading"] or words > LINE):
            header.add_legend(handles, labels)
        elif labels:
            corner: Any = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "ncol": len(labels)}
            ax.legend(handles, labels, borderaxespad=0.3, **corner)
    for note in figure["notes"]:
        header.add_text(note, GREY)
    _set_frames(figure, axes, header, scale, height_in)
    return canvas


def font_name(font: str) -> str:
    """Of a font of this machine, by its name or file. Raises ValueError where there is none."""
    if Path(font).suffix in (".ttf", ".otf") and Path(font).is_file():
        font_manager.fontManager.addfont(font)
        return font_manager.FontProperties(fname=font).get_name()
    if font:
        font_manager.findfont(font, fallback_to_default=False)
    return font


def write(
    figure: Data, path: str, *, width_px: int = COLUMN_PX, height_px: int = 0, font: str = ""
) -> None:
    """Draws it into an .svg, .png or .pdf, which appears by rename and holds no date."""
    kind, scale = Path(path).suffix[1:], width_px / COLUMN_PX
    # named as the program names what it renames
    name = f".{Path(path).stem}.part-{os.uname().nodename}-{os.getpid()}.{kind}"
    part = Path(path).with_name(name)
    with matplotlib.style.context(["default", style(scale, font)]):
        canvas = draw(figure, scale, height_px / DPI or None)
        try:
            canvas.savefig(part, format=kind, dpi=DPI, metadata=METADATA[kind])
            part.replace(path)
        except OSError as error:
            error.filename = path
            raise
        finally:
            part.unlink(missing_ok=True)


def main(request: Data) -> int:
    """Of the program: figures, a path for each, and how they look (figure_files.cpp)."""
    look = {"width_px": request["width_px"], "height_px": request["height_px"]}
    try:
        look["font"] = font_name(request["font"])
    except ValueError as error:
        raise OSError(f"--font {request['font']}: this machine has no such font") from error
    for figure, path in zip(request["figures"], request["paths"], strict=True):
        write(figure, path, **look)
    return len(request["paths"])
