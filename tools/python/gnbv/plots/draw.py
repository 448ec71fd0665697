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
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

Data = dict[str, Any]

DPI = 432
COLUMN_PX = 1512  # 3.5 inches: a column of a paper
INK, GREY, SHADE, BAND = "#262c36", "#5c6470", "#dcebf5", "#f2f4f7"
MARKERS = {"circle": "o", "square": "s", "triangle": "^", "downward": "v", "diamond": "D"}
MARKERS["pentagon"] = "p"
METADATA = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {"Software": None}}
TEX = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}


def style(scale: float = 1.0, font: str = "") -> Data:
    """matplotlib's settings: letters of 6 to 7 points in 3.5 inches, files without a date."""
    small, line = 6.5 * scale, 0.5 * scale
    settings: Data = {f"{of}.{key}": 1.5 * scale for of in ("xtick", "ytick") for key in ["major.pad"]}
    settings |= {f"{of}.labelcolor": "#3a424d" for of in ("xtick", "ytick")}
    settings |= {f"{of}.major.size": 2.0 * scale for of in ("xtick", "ytick")}
    settings |= {f"{of}.major.width": line for of in ("xtick", "ytick")}
    settings |= {f"{of}.color": GREY for of in ("xtick", "ytick")}
    sizes = ("font.size", "axes.titlesize", "axes.labelsize", "legend.fontsize")
    settings |= {key: small for key in (*sizes, "xtick.labelsize", "ytick.labelsize")}
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
        "legend.handlelength": 2.4,
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
    step = "post" if mark == "steps" else None
    if mark == "interval":
        _interval(ax, panel, series, scale)
    elif mark == "level":
        ax.axhline(y[0], **_line(series, scale))
    elif mark == "area":
        ax.fill_between(x, low, high, color=series["colour"], linewidth=0)
    else:
        if low:
            ax.fill_between(x, low, high, step=step, color=series["colour"], alpha=0.18, linewidth=0)
        points = _point(series, series["size_pt"] * scale) if mark == "points" else {}
        ax.plot(x, y, drawstyle="steps-post" if step else None, **_line(series, scale), **points)
    if series["end"]:
        end = _point(series, 3.4 * scale, edge="white")
        ax.plot(*[[at] for at in series["end"]], linestyle="none", zorder=4, **end)


def _axis(ax: Axes, which: str, axis: Data) -> None:
    if axis["log"]:
        getattr(ax, f"set_{which}scale")("log")
        getattr(ax, f"{which}axis").minorticks_off()
    ticks = axis["ticks"]
    at, texts = [tick["at"] for tick in ticks], [safe(tick["text"]) for tick in ticks]
    getattr(ax, f"set_{which}ticks")(at, labels=texts)
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


def add_panels(figure: Data, canvas: Figure, scale: float = 1.0) -> list[Axes]:
    """All panels, row by row; those with one x axis share its numbers below the last."""
    panels, axes = iter(figure["panels"]), []
    first = 0
    heights = []
    for count in figure["rows"]:
        heights.append(figure["panels"][first]["height_px"])
        first += count
    grid = canvas.add_gridspec(len(heights), 1, height_ratios=heights)
    is_stack = len(heights) > 1 and all(p["x"] == figure["panels"][0]["x"] for p in figure["panels"])
    for row, count in enumerate(figure["rows"]):
        for column, cell in enumerate(grid[row].subgridspec(1, count)):
            panel = next(panels)
            ax = draw_panel(canvas.add_subplot(cell), panel, scale)
            if is_stack and row + 1 < len(heights):
                ax.set_xlabel("")
                ax.tick_params(labelbottom=False)
            if column > 0:
                ax.tick_params(labelleft=False)
            axes.append(ax)
    canvas.align_ylabels(axes)
    return axes


def draw(figure: Data, scale: float = 1.0, height_in: float | None = None) -> Figure:
    """The whole figure: its title, legend and notes at the top left, and its panels below."""
    canvas = Figure(figsize=(3.5 * scale, 3.0 * scale))
    renderer = FigureCanvasAgg(canvas).get_renderer()
    left, top_in = 0.02, 0.07 * scale

    def below(artist: Any, gap: float) -> tuple[Any, float]:
        """Puts the artist's top there, and the next one's top below it."""
        nonlocal top_in
        place, top_in = top_in, top_in + gap * scale
        top_in += artist.get_window_extent(renderer).height / canvas.dpi
        return artist, place

    header = []
    if figure["title"]:
        header.append(below(canvas.text(left, 1, safe(figure["title"]), va="top"), 0.05))
    axes = add_panels(figure, canvas, scale)
    is_single = len(axes) == 1 or figure["kind"] == "forest"
    for ax, panel in zip(axes, figure["panels"], strict=True):
        handles, labels = legend_of(panel, scale)
        if not handles:
            continue
        if is_single:
            legend = canvas.legend(handles, labels, loc="upper left", bbox_to_anchor=(left, 1.0))
            legend.set_in_layout(False)
            header.append(below(legend, 0.05))
        else:
            place = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "ncol": len(labels)}
            ax.legend(handles, labels, borderaxespad=0.3, **place)
    for note in figure["notes"]:
        text = "\n".join(textwrap.wrap(safe(note), 84))
        header.append(below(canvas.text(left, 1, text, va="top", color=GREY), 0.05))
    heights_px = [max(p["height_px"] for p in row) for row in rows_of(figure)]
    around_px = 130 + sum(70 if row[0]["heading"] else 20 for row in rows_of(figure))
    if figure["kind"] in ("forest", "predictions"):
        around_px += 110 * (len(heights_px) - 1)  # each row has an x axis of its own
    wanted_in = top_in + (sum(heights_px) + around_px) * scale / DPI
    height_in = height_in or wanted_in
    canvas.set_size_inches(3.5 * scale, height_in)
    for artist, place in header:
        if hasattr(artist, "set_bbox_to_anchor"):
            artist.set_bbox_to_anchor((left, 1 - place / height_in), canvas.transFigure)
        else:
            artist.set_y(1 - place / height_in)
            artist.set_in_layout(False)
    pad = 0.02 * scale
    canvas.set_layout_engine(
        "constrained", rect=(0, 0, 1, 1 - top_in / height_in), w_pad=pad, h_pad=pad, hspace=0.02
    )
    return canvas


def rows_of(figure: Data) -> list[list[Data]]:
    """The panels that stand beside each other."""
    panels = iter(figure["panels"])
    return [[next(panels) for _ in range(count)] for count in figure["rows"]]


def font_name(font: str) -> str:
    """Of a font of this machine, by its name or file. Raises ValueError where there is none."""
    if Path(font).suffix in (".ttf", ".otf") and Path(font).is_file():
        font_manager.fontManager.addfont(font)
        return font_manager.FontProperties(fname=font).get_name()
    if font:
        font_manager.findfont(font, fallback_to_default=False)
    return font


def write(figure: Data, path: str, *, width_px: int = COLUMN_PX, height_px: int = 0, font: str = "") -> None:
    """Draws it into an .svg, .png or .pdf, which appears by rename and holds no date."""
    kind, part = Path(path).suffix[1:], f"{path}.part"
    scale = width_px / COLUMN_PX
    with matplotlib.style.context(["default", style(scale, font)]):
        canvas = draw(figure, scale, height_px / DPI or None)
        try:
            canvas.savefig(part, format=kind, dpi=DPI, metadata=METADATA[kind])
            os.replace(part, path)
        except BaseException:
            Path(part).unlink(missing_ok=True)
            raise


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
