"""`gnbv plot` draws: every kind in every format, the same bytes each time, whatever the names are;
its data are as their schema says. GNBV names the program; never skipped, since tools/setup brings
matplotlib."""

import csv
import json
import re
import struct
import sys
from pathlib import Path

import matplotlib
import pytest
from conftest import gnbv, without_packages

sys.path.insert(0, str(Path(__file__).parents[2] / "tools/python/gnbv/plots"))
import _draw as draw  # as the program runs it: without the package

KINDS = "density,coverage,terms,reach,flight,tracking,predictions"
MAGIC = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}
HOSTILE = "a_b^{c} $x^2$ <b>&amp; \\n 100 %"


@pytest.fixture(scope="module")
def runs(tmp_path_factory) -> list[Path]:
    """A tour, and two seeds of the paper's planner, all with a known ceiling."""
    folder = tmp_path_factory.mktemp("runs")
    for name, *options in (("tour", "--utility", "tour"), ("one",), ("two", "--seed", "2")):
        options += ["--set", "planner.termination.max_iterations=8", "--quiet"]
        gnbv("run", "smoke", *options, "--out", folder / name)
        gnbv("score", folder / name, "--update", "--ceiling")
    return [folder / name for name in ("tour", "one", "two")]


def plot(*arguments, **environment) -> list[Path]:
    return [Path(line) for line in gnbv("plot", *arguments, **environment).stdout.splitlines()]


def test_every_kind_in_every_format_has_the_same_bytes_each_time(runs, tmp_path):
    options = ["--plots", KINDS, "--format", "svg,png,pdf,json", "--width", 600]
    (tmp_path / "matplotlibrc").write_text("lines.linewidth: 9\nsavefig.facecolor: red\n")
    first = plot(*runs, *options, "-o", tmp_path / "first")
    again = plot(*runs, *options, "-o", tmp_path / "again", MATPLOTLIBRC=str(tmp_path))
    figures = json.loads((tmp_path / "first/figures.json").read_text())["figures"]
    assert {figure["kind"] for figure in figures} == {*KINDS.split(","), "entropy"}
    assert len(first) == 4 * len(figures) + 1
    for one, other in zip(first, again, strict=True):
        content = one.read_bytes()
        assert content == other.read_bytes(), one.name
        assert content.startswith(MAGIC.get(one.suffix[1:], b"")), one.name
        assert len(content) > 100, one.name
    for figure in figures:
        rows = (tmp_path / f"first/{figure['name']}.csv").read_text().splitlines()
        assert rows[0] == "panel,series,x,y,low,high" and len(rows) > 1
        svg = (tmp_path / f"first/{figure['name']}.svg").read_text()
        for panel in figure["panels"]:  # the words of the data are those of the picture
            for series in panel["series"]:
                assert series["label"].replace("'", "&#39;") in svg.replace("&apos;", "&#39;")


TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int}
TYPES |= {"number": (int, float), "null": type(None)}


def faults(value, rule: dict, root: dict, at: str = "") -> list[str]:
    """What a JSON Schema of our few keywords has against a value; others raise KeyError."""
    found, rule = [], dict(rule)
    if "$ref" in rule:
        return faults(value, root["definitions"][rule["$ref"].rsplit("/", 1)[1]], root, at)
    types = rule.pop("type", list(TYPES))
    types = [types] if isinstance(types, str) else types
    if not any(isinstance(value, TYPES[each]) for each in types):
        return [f"{at}: no {types}"]
    bad = {
        "const": lambda k: value != k,
        "enum": lambda k: value not in k,
        "required": lambda k: not set(k) <= set(value),
        "additionalProperties": lambda k: not set(value) <= set(rule["properties"]),
        "pattern": lambda k: not re.search(k, value),
        "minimum": lambda k: value < k,
        "maximum": lambda k: value > k,
        "exclusiveMinimum": lambda k: value <= k,
        "minItems": lambda k: value is not None and len(value) < k,
        "maxItems": lambda k: value is not None and len(value) > k,
    }
    for word, wanted in rule.items():
        if word == "properties":
            for key in set(value) & set(wanted):
                found += faults(value[key], wanted[key], root, f"{at}/{key}")
        elif word == "items":
            for item in value or []:
                found += faults(item, wanted, root, f"{at}[]")
        elif word not in ("$schema", "title", "description", "definitions") and bad[word](wanted):
            found.append(f"{at}: {word}")
    return found


def test_data_are_as_their_schema_says_and_the_csv_holds_them(runs, tmp_path):
    plot(*runs, "--plots", KINDS, "--title", HOSTILE, "--format", "json", "-o", tmp_path / "runs")
    bench = ["--seeds", 2, "--no-ceiling", "--quiet", "--out", tmp_path / "bench"]
    bench += ["--set", "planner.termination.max_iterations=2", "--plots", tmp_path / "bench_plots"]
    gnbv("compare", "smoke", "--utilities", "proposed,isler", *bench)
    schema = json.loads(gnbv("schema", "figures").stdout)
    kinds = set()
    for folder in (tmp_path / "runs", tmp_path / "bench_plots"):
        document = json.loads((folder / "figures.json").read_text())
        assert faults(document, schema, schema) == []
        for figure in document["figures"]:
            kinds.add(figure["kind"])
            with open(folder / f"{figure['name']}.csv", newline="") as file:
                rows = csv.DictReader(file)
                for series in (one for panel in figure["panels"] for one in panel["series"]):
                    for i in range(len(series["y"])):
                        row = next(rows)
                        assert row["series"] == series["name"]
                        for key in ("x", "y", "low", "high"):
                            known = series[key][i] if i < len(series[key]) else None
                            assert (float(row[key]) if row[key] else None) == known
                assert list(rows) == []
    drawn_alone = {"standings"}  # by `bench table`, whose CSV has the numbers
    assert kinds == set(schema["definitions"]["figure"]["properties"]["kind"]["enum"]) - drawn_alone
    for key, wrong in (("schema", 2), ("figures", [{}]), ("mine", 1)):
        assert faults(document | {key: wrong}, schema, schema)


def test_words_are_the_users_and_mean_nothing_to_matplotlib(runs, tmp_path):
    labels = ["--labels", "1=Ours", "--labels", f"2={HOSTILE}", "--colors", "1=#123456"]
    drawn = plot(*runs, "--plots", "coverage", "--title", HOSTILE, *labels, "-o", tmp_path)
    svg = next(file for file in drawn if file.name == "coverage-metres.svg").read_text()
    words = HOSTILE.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    assert svg.count(words) == 2
    assert "Ours (1 seed)" in svg and "#123456" in svg
    bad = gnbv("plot", runs[0], "--font", "No Such Font", "-o", tmp_path / "none", code=2)
    assert "--font No Such Font" in bad.stderr
    assert not (tmp_path / "none").exists()


def test_no_word_is_cut_at_the_edge(runs, tmp_path):
    words = ["--title", 9 * "a long title ", "--labels", "1=" + 30 * "word", "--format", "json"]
    plot(*runs, "--plots", KINDS, *words, "-o", tmp_path)
    for figure in json.loads((tmp_path / "figures.json").read_text())["figures"]:
        with matplotlib.style.context(["default", draw.style()]):
            canvas = draw.draw(figure)
            renderer = draw.FigureCanvasAgg(canvas).get_renderer()
        for words in [*canvas.texts, *canvas.legends]:
            assert words.get_window_extent(renderer).x1 <= canvas.bbox.x1, figure["name"]


def test_tex_gets_its_own_escapes():
    with matplotlib.rc_context({"text.usetex": True}):
        assert draw.safe("80 % of a_b") == r"80 \% of a\_b"
        assert draw.safe("\\") == r"\textbackslash{}"
    assert draw.safe("80 %, $5") == r"80 %, \$5"


def test_a_picture_is_as_large_as_asked_for(runs, tmp_path):
    size = ["--width", 700, "--height", 500, "--format", "png", "--plots", "coverage"]
    for file in plot(runs[0], *size, "-o", tmp_path):
        if file.suffix == ".png":
            assert struct.unpack(">II", file.read_bytes()[16:24]) == (700, 500)


def test_without_matplotlib_one_line_says_what_installs_it(runs, tmp_path):
    bare = without_packages(tmp_path)
    refused = gnbv("plot", runs[0], "-o", tmp_path / "plots", code=2, **bare)
    line, *more = refused.stderr.strip().splitlines()
    assert "matplotlib is not there" in line and "apt-get install python3-matplotlib" in line
    assert not more and not (tmp_path / "plots").exists()
    data = plot(runs[0], "--format", "json", "-o", tmp_path / "data", **bare)
    assert (tmp_path / "data/figures.json") in data  # data takes no Python


def test_what_cannot_be_written_is_named(runs, tmp_path):
    (tmp_path / "coverage-views.svg").mkdir()
    refused = gnbv("plot", runs[0], "--plots", "coverage", "-o", tmp_path, code=2)
    assert "coverage-views.svg" in refused.stderr
    assert not list(tmp_path.glob(".*.part-*"))
