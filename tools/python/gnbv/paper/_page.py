"""Lays out the page of `gnbv paper` and its tables for LaTeX. All that they say is computed before:
it is a document of paper.schema.json (`gnbv schema paper`). The program runs this file as it is."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup
from PIL import Image

from gnbv.plots import _draw

Data = dict[str, Any]

MINUS = "\N{MINUS SIGN}"
# that LaTeX has without a package, or has otherwise in its first font
SIGNS = {MINUS: "$-$", "±": r"$\pm$", "†": r"$\dagger$", "<": "$<$", ">": "$>$", "|": "$|$"}
TEX_MARKS = {
    "block_start_string": "<%",
    "block_end_string": "%>",
    "variable_start_string": "<<",
    "variable_end_string": ">>",
    "comment_start_string": "<#",
    "comment_end_string": "#>",
}


def amount(value: float | None, decimals: int, sign: str = "-") -> str:
    """As "10,970", with the sign "+" also "+3.0"; a dash where it is not known."""
    if value is None:
        return "-"
    text = f"{round(value, decimals) + 0.0:{sign},.{decimals}f}"
    return text.lstrip("+") if not text.strip("+-0.,") else text.replace("-", MINUS)


def estimate(figure: Data, decimals: int, sign: str = "-") -> str:
    """As "1,396.5 ±12.0"; of one mission without an interval."""
    width = figure["half_width"]
    interval = "" if width is None else f" ±{amount(width, decimals)}"
    return amount(figure["ours"], decimals, sign) + interval


def printed(rows: Sequence[Data]) -> list[int]:
    """The columns that the paper prints of any of these rows."""
    return [
        column
        for column in range(len(rows[0]["figures"]))
        if any(row["figures"][column]["printed"] is not None for row in rows)
    ]


def photo(path: Path) -> str:
    """A picture as the address of a JPEG that is within it."""
    jpeg = io.BytesIO()
    Image.open(path).convert("RGB").save(jpeg, "JPEG", quality=86)
    return "data:image/jpeg;base64," + base64.b64encode(jpeg.getvalue()).decode()


def drawing(path: Path, curve: Data) -> Markup:
    """A curve, drawn into its file, as an <svg> whose letters stay letters."""
    _draw.write(curve, str(path))
    svg = path.read_text(encoding="utf-8")
    return Markup(re.sub(r"<metadata>.*?</metadata>", "", svg[svg.index("<svg") :], flags=re.S))


def tex(value: object) -> str:
    """Text as LaTeX prints it as it is."""
    text = " ".join(str(value).split("\n"))
    return "".join(SIGNS.get(sign) or _draw.safe(sign) for sign in text)


def render(template: str, document: Data, **options: Any) -> str:
    jinja = Environment(trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined, **options)
    jinja.filters |= {"amount": amount, "estimate": estimate, "printed": printed}
    return str(jinja.from_string(template).render(document))


def main(request: Data) -> Data:
    """The page and the tables of a document; nothing of none, which asks whether this can run."""
    if not request:
        return {}
    document = request["document"]
    curves = {figure["name"]: figure for figure in document["figures"]}
    for shown in document["shown"]:
        for each in shown["pictures"]:
            path = Path(request["folder"]) / each["path"]
            name = each["curve"]
            each["drawn"] = photo(path) if name is None else drawing(path, curves[name])
    with matplotlib.rc_context({"text.usetex": True}):  # so that _draw.safe() writes TeX
        tables = render(request["tex"], document, finalize=tex, **TEX_MARKS)
    return {"html": render(request["html"], document, autoescape=True), "tex": tables}
