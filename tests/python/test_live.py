"""Pictures of a mission while it flies."""

import io
import sys
import types

import numpy as np
import pytest

import gnbv
from gnbv._picture import png

SET = {"planner.termination.max_iterations": 3}


def test_a_picture_of_each_view_is_shown_and_changes_nothing():
    pictures = []
    run = gnbv.run("smoke", seed=3, set=SET, live=pictures.append)
    assert len(pictures) == len(run.iterations) == 3
    assert all(p.dtype == np.uint8 and p.shape == pictures[0].shape for p in pictures)
    way = [(p == (200, 30, 60)).all(axis=2).sum() for p in pictures]
    assert way[0] == 0 and way[1] > 20 and way[2] > way[1]
    assert gnbv.run("smoke", seed=3, set=SET).sha256 == run.sha256


def test_a_png_holds_the_picture():
    Image = pytest.importorskip("PIL.Image")
    picture = np.random.default_rng(0).integers(0, 256, (7, 5, 3)).astype(np.uint8)
    read = Image.open(io.BytesIO(png(picture)))
    assert read.mode == "RGB" and np.array_equal(np.asarray(read), picture)


def test_in_a_notebook_one_picture_is_drawn_anew(monkeypatch):
    shown = []

    class Handle:
        def update(self, image):
            shown.append(("update", image))

    def display(image, display_id):
        shown.append(("display", image))
        return Handle()

    shell = types.SimpleNamespace(kernel=1)
    fake = types.SimpleNamespace(get_ipython=lambda: shell)
    output = types.SimpleNamespace(Image=lambda data: data, display=display)
    monkeypatch.setitem(sys.modules, "IPython", fake)
    monkeypatch.setitem(sys.modules, "IPython.display", output)
    gnbv.run("smoke", seed=3, set=SET, live=True)
    assert [how for how, _ in shown] == ["display", "update", "update"]
    assert all(data.startswith(b"\x89PNG") for _, data in shown)
    del shell.kernel  # a terminal's IPython
    gnbv.run("smoke", seed=3, set=SET, live=True)
    assert len(shown) == 3


def test_outside_of_one_nothing_is_shown_and_what_a_function_raises_comes_out(capsys):
    gnbv.run("smoke", seed=3, set=SET, live=True)
    assert capsys.readouterr().out == ""

    def fails(picture):
        raise ZeroDivisionError("of the picture")

    with pytest.raises(ZeroDivisionError, match="of the picture"):
        gnbv.run("smoke", seed=3, set=SET, live=fails)
