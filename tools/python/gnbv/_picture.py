"""The map from above, the way flown, where the vehicle is and looks: of an environment, and of a
mission while it flies."""

from __future__ import annotations

import struct
import sys
import zlib
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

Picture = npt.NDArray[np.uint8]
Live = Callable[[Picture], None]
SIDE_PX = 480  # the longer side at least
_UNKNOWN, _FREE = np.array([70.0, 75.0, 85.0]), np.array([235.0, 237.0, 240.0])
_LOW, _HIGH = np.array([40.0, 90.0, 170.0]), np.array([245.0, 180.0, 60.0])
_WAY, _HERE = (200, 30, 60), (20, 120, 60)


def _line(picture: Picture, a: Any, b: Any, colour: tuple[int, int, int], width: int) -> None:
    """From pixel a to b (column, row); what is outside of the picture is left out."""
    count = int(np.ceil(np.abs(np.subtract(b, a)).max())) + 1
    along = np.rint(np.linspace(a, b, count)).astype(int)
    for dx in range(width):
        for dy in range(width):
            x, y = along[:, 0] + dx - width // 2, along[:, 1] + dy - width // 2
            is_in = (x >= 0) & (x < picture.shape[1]) & (y >= 0) & (y < picture.shape[0])
            picture[y[is_in], x[is_in]] = colour


def from_above(
    top: npt.NDArray[np.float32],
    low_m: Sequence[float],
    high_m: Sequence[float],
    way: Sequence[npt.NDArray[np.float64]],
) -> Picture:
    """`top`: (y, x, 2) as _core's, of the x and y from low_m to high_m; `way`: x, y, z, yaw, pitch
    of each view. North is up. Surface is blue below and orange above; grey is not yet seen."""
    height, unknown = top[::-1, :, 0, None], top[::-1, :, 1, None]
    ground = _FREE + unknown * (_UNKNOWN - _FREE)
    cells = np.where(height < 0.0, ground, _LOW + np.clip(height, 0.0, 1.0) * (_HIGH - _LOW))
    factor = -(-SIDE_PX // max(cells.shape[:2]))
    picture: Picture = np.rint(cells).astype(np.uint8).repeat(factor, axis=0).repeat(factor, axis=1)
    scale = np.array([picture.shape[1], picture.shape[0]]) / np.subtract(high_m, low_m)

    def pixel(x: float, y: float) -> Any:
        column, row = (np.array([x, y]) - low_m) * scale
        return column - 0.5, picture.shape[0] - row - 0.5

    for a, b in pairwise(way):
        _line(picture, pixel(a[0], a[1]), pixel(b[0], b[1]), _WAY, 2)
    x, y, _, yaw, _ = way[-1]
    ahead_m = 24.0 / scale[0]
    for turned in (-0.5, 0.5):  # two edges of where it looks
        tip = pixel(x + ahead_m * np.cos(yaw + turned), y + ahead_m * np.sin(yaw + turned))
        _line(picture, pixel(x, y), tip, _HERE, 3)
    return picture


def png(picture: Picture) -> bytes:
    """As a PNG file."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    height, width, _ = picture.shape
    rows = b"".join(b"\0" + row.tobytes() for row in picture)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + data


def _in_notebook() -> Live | None:
    """Shows pictures in place of each other below the cell; None outside of Jupyter."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if not hasattr(shell, "kernel"):
        return None
    from IPython.display import (  # type: ignore[import-not-found,unused-ignore]
        Image,
        display,
    )

    handle = None

    def show(picture: Picture) -> None:
        nonlocal handle
        image = Image(data=png(picture))
        if handle is None:
            handle = display(image, display_id=True)
        else:
            handle.update(image)

    return show


def live_picture(live: bool | Live) -> Callable[[dict[str, Any]], None] | None:
    """What _core.run tells of each view."""
    show = live if callable(live) else _in_notebook() if live else None
    if show is None:
        return None
    way: list[npt.NDArray[np.float64]] = []

    def on_view(view: dict[str, Any]) -> None:
        way.append(np.array([view[k] for k in ("x", "y", "z", "yaw", "gimbal_pitch")]))
        cells = view["top"].reshape(len(view["top"]), -1, 2)
        show(from_above(cells, view["top_low_m"], view["top_high_m"], way))

    return on_view
