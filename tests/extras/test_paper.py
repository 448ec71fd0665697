"""The page of `gnbv paper`: what it shows is the document beside it, and whatever a user's names
are, they stay text. GNBV names the program; never skipped, since tools/setup brings Jinja2."""

import html.parser
import json
import re
from pathlib import Path

import pytest
from conftest import gnbv, without_packages
from test_plots import faults

TINY = ["--scenarios", "lab_model", "--set", "planner.termination.max_iterations=3"]
HOSTILE = "<b>&%_#$ {x}\\^~"


def paper(folder: Path, *words, out="page", **more):
    """Of one seed of the lab, with few views."""
    options = ["-o", out, "--cells", "cells", "--seeds", "1", "--threads", "1", "--quiet"]
    return gnbv("paper", *options, *words, folder=folder, **more)


@pytest.fixture(scope="module")
def flown(tmp_path_factory) -> Path:
    """A folder with the page in a folder of a hostile name."""
    folder = tmp_path_factory.mktemp("paper")
    assert paper(folder, *TINY, out=HOSTILE).stdout == f"{HOSTILE}/index.html\n"
    return folder


@pytest.fixture
def page(flown) -> Path:
    return flown / HOSTILE


@pytest.fixture
def document(page) -> dict:
    return json.loads((page / "paper.json").read_text())


class Reader(html.parser.HTMLParser):
    """The words of a page whose elements are closed in their order, and its links."""

    EMPTY = ("meta", "br", "img")

    def __init__(self, text: str):
        super().__init__()
        self.open, self.words, self.links = [], [], set()
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.links |= {value for name, value in attributes if name in ("href", "src")}
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


def test_the_document_is_as_its_schema_says(document):
    schema = json.loads(gnbv("schema", "paper").stdout)
    assert faults(document, schema, schema) == []
    for key, wrong in (("schema", 2), ("tables", [{}]), ("figures", [{}]), ("mine", 1)):
        assert faults(document | {key: wrong}, schema, schema)


def test_the_page_shows_every_number_and_figure_of_the_document(page, document):
    text = (page / "index.html").read_text()
    read = Reader(text)
    words = " ".join(" ".join(read.words).split())
    tex = (page / "tables/paper.tex").read_text()
    assert "default-src 'none'" in text and not [to for to in read.links if "://" in to]
    files = [each for each in read.links if not each.startswith(("#", "data:"))]
    assert all((page / name).is_file() for name in files)
    assert {"paper.json", "tables/lab_model.md", "tables/lab_model.csv", "tables/paper.tex"} <= {
        *files
    }
    shown = {figure["number"] for figure in document["shown"]}
    assert shown >= {"2", "4", "5", "6", "13", "14", "15"} and "8" not in shown  # the aircraft's
    assert shown == set(re.findall('<section id="fig([0-9]+)">', text))
    assert {each["path"] for figure in document["shown"] for each in figure["pictures"]} <= {*files}
    assert text.count("<svg") == len(document["figures"]) > 0
    for figure in document["figures"]:
        for series in (one for panel in figure["panels"] for one in panel["series"]):
            assert series["label"] in words
    (row,) = document["tables"][0]["rows"]
    for column, figure in zip(document["columns"], row["figures"], strict=True):
        for key in ("printed", "ours") if figure["printed"] is not None else ():
            number = f"{figure[key]:,.{column['decimals']}f}"
            assert number.replace("-", "\N{MINUS SIGN}") in words
            assert number.replace("-", "$-$") in tex
    assert "30,140" in words and "compared after 3 views, where ours ended" in words
    assert document["missions"][0]["command"] in words
    assert not re.search(r"[+\N{MINUS SIGN}]0\.?0*( |$)", words)  # no signed zero


def test_hostile_names_are_text_in_html_and_tex(page, document):
    assert HOSTILE in document["command"]
    text = (page / "index.html").read_text()
    assert HOSTILE not in text and HOSTILE in " ".join(Reader(text).words)
    tex = (page / "tables/paper.tex").read_text()
    assert r"$<$b$>$\&\%\_\#\$ \{x\}\textbackslash{}\textasciicircum{}\textasciitilde{}" in tex
    bare = re.sub(r"\\[%&#_]", "", re.sub(r"(?m)^%.*", "", tex))
    assert not re.search("[%#_]", bare)  # each would be a mark of TeX's
    assert {row.count("&") for row in re.findall(r"(?m)^.*&.*\\\\$", bare)} == {6}


def test_nothing_is_flown_twice_and_the_page_is_the_same(flown, page):
    kept = {path: path.stat().st_mtime_ns for path in flown.rglob("cells/**/summary.json")}
    assert len(kept) == 2  # with images and without
    before = {path: path.read_bytes() for path in page.rglob("*") if path.is_file()}
    paper(flown, *TINY, out=HOSTILE)
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert {path: path.read_bytes() for path in page.rglob("*") if path.is_file()} == before


def test_the_page_says_which_mission_failed(tmp_path):
    start = "start={position_m: [0, 0, 0.5], jitter_m: [0, 0, 0]}"
    sets = ["--set", start, "--set", "planner.validity.z_min_m=0"]
    ended = paper(tmp_path, "--scenarios", "lab_model", *sets, code=1)
    assert "not every mission came to its end" in ended.stderr
    words = " ".join(Reader((tmp_path / "page/index.html").read_text()).words)
    for said in (
        "lab_model, proposed: without a result: exit code 2: gnbv: start",
        "Proposed: no mission came to its end",
        "30,140",
    ):
        assert said in words


@pytest.mark.parametrize("words", [["--scenarios", "moon"], ["--seeds", "0"], ["--jobs", "0"],
                                   ["--set", "planner.utilty.name=isler"]])
def test_bad_input_is_refused_and_leaves_no_page(tmp_path, words):
    paper(tmp_path, *words, code=2)
    assert not (tmp_path / "page/index.html").exists()


def test_without_jinja2_one_line_says_what_installs_it_before_any_mission_flies(tmp_path):
    refused = paper(tmp_path, *TINY, code=2, **without_packages(tmp_path))
    (line,) = refused.stderr.strip().splitlines()
    assert "is not there" in line and "apt-get install python3-matplotlib python3-jinja2" in line
    assert not (tmp_path / "cells").exists() and not (tmp_path / "page").exists()
