"""The output of `render_mode="human"`: a notebook cell or a window."""

from __future__ import annotations

import struct
import time
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import notebook
from .setting import gymnasium

__all__ = ["Screen", "png"]

ENLARGED = 2
"""The number of window pixels for each pixel of the picture."""


class Screen:
    """Shows pictures one after the other, each for some seconds."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._next = 0.0
        self._output: Any = None

    def show(self, picture: NDArray[np.uint8]) -> None:
        """Show a picture, after the previous one has been shown for long enough."""
        left = self._next - time.monotonic()
        if left > 0:
            time.sleep(left)
        self._next = time.monotonic() + self._seconds
        if self._output is None:
            self._output = _Cell() if notebook.is_here() else _Window()
        self._output.show(picture)

    def close(self) -> None:
        """Close the window; a cell keeps its last picture."""
        if self._output is not None:
            self._output.close()
            self._output = None


class _Cell:
    """The output of a notebook cell."""

    def __init__(self) -> None:
        self._cell = notebook.Cell()

    def show(self, picture: NDArray[np.uint8]) -> None:
        self._cell.show({"image/png": png(picture)})

    def close(self) -> None:
        """The picture stays."""


class _Window:
    """A system window. If the user closes it, the episode continues without pictures."""

    _window: Any

    def __init__(self) -> None:
        try:
            import tkinter

            self._window = tkinter.Tk()
        except Exception as why:
            # Checkers make such environments on machines without a display, too.
            gymnasium.logger.warn(f'render_mode="human" shows nothing without a display and tkinter ({why})')
            self._window = None
            return
        self._tkinter: Any = tkinter
        self._window.title("Carbot")
        self._window.protocol("WM_DELETE_WINDOW", self.close)
        self._label: Any = tkinter.Label(self._window)
        self._label.pack()
        self._image: Any = None

    def show(self, picture: NDArray[np.uint8]) -> None:
        if self._window is None:
            return
        rows, columns, _ = picture.shape
        image = self._tkinter.PhotoImage(data=b"P6 %d %d 255\n" % (columns, rows) + picture.tobytes(), format="PPM")
        self._image = image.zoom(ENLARGED)
        self._label.configure(image=self._image)
        self._window.update()

    def close(self) -> None:
        if self._window is not None:
            self._window.destroy()
        self._window = None


def png(picture: NDArray[np.uint8]) -> bytes:
    """A picture as a PNG file."""
    rows, columns, _ = picture.shape
    # Each row begins with its filter type: none.
    raw = np.hstack([np.zeros((rows, 1), np.uint8), picture.reshape(rows, -1)]).tobytes()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b"")
