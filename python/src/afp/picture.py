"""`Picture`: a drawing for notebooks and files."""

from __future__ import annotations

import base64
import os

from ._afp import write_text

__all__ = ["Picture", "address"]


class Picture:
    """A drawing as SVG."""

    svg: str
    """Its text."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it as an SVG file."""
        ending = os.path.splitext(os.fspath(path))[1].lower()
        if ending not in ("", ".svg"):
            raise ValueError(f"a picture is saved as .svg, not as '{ending}'; 'afpc log' and 'afpc graph' write .png")
        write_text("cannot write the picture", path, self.svg)

    def _repr_svg_(self) -> str:
        return self.svg

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Picture) and other.svg == self.svg

    def __hash__(self) -> int:
        return hash(self.svg)

    def __repr__(self) -> str:
        return f"<Picture, {len(self.svg) / 1000:.0f} kB of SVG>"


def address(svg: str) -> str:
    """A drawing as the address of an image, with its own styles."""
    return f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"
