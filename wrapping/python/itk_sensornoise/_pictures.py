# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Page, noise curve and numbers of the figures of a report, drawn by the C++ library."""

import base64
import json
import os
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from . import _options
from ._html import page, with_title
from ._names import is_name
from ._record import Record
from ._types import FileName, ItkObject

if TYPE_CHECKING:
    from ._export import NoiseExport

_ENDINGS = (".html", ".htm")


def pack(text: str) -> bytes:
    """Returns compressed text, a tenth of the size or less: a page is 100 kB to 1 MB."""
    return zlib.compress(text.encode())


def unpack(packed: bytes) -> str:
    return zlib.decompress(packed).decode()


@dataclass(frozen=True)
class Pictures:
    """The pictures of one report, packed."""

    page: bytes
    curve: bytes
    numbers: bytes

    @classmethod
    def of(cls, estimator: ItkObject) -> "Pictures":
        """Returns the pictures of an ITK estimator that is up to date and has one report."""
        numbers = estimator.GetFigureAsJson()
        return cls(pack(estimator.GetReportAsHtml()), pack(estimator.GetReportAsSvg()), pack(numbers))

    @classmethod
    def of_channels(cls, estimator: ItkObject) -> "dict[str, Pictures]":
        """Returns the pictures of each channel of a mosaic, by its name."""
        return {
            name: cls(
                pack(estimator.GetChannelReportAsHtml(name)),
                pack(estimator.GetChannelReportAsSvg(name)),
                pack(json.dumps(numbers)),
            )
            for name, numbers in json.loads(estimator.GetFigureAsJson()).items()
        }

    def figure_data(self) -> dict[str, Any]:
        """Returns a copy of the numbers of the figures, as dicts and lists."""
        data: dict[str, Any] = json.loads(unpack(self.numbers))
        return data

    def curve_element(self, width: int) -> str:
        """Returns the noise curve as an HTML element, an image with its own style. Its colours follow the reader's
        light or dark mode."""
        source = base64.b64encode(unpack(self.curve).encode()).decode()
        return f'<img alt="noise curve" width="{width}" src="data:image/svg+xml;base64,{source}">'


class PagedRecord(Record):
    """A record that has a page, and can be exported."""

    def __init__(self, text: str, page: bytes | None) -> None:
        """`text`: the record as JSON. `page`: packed."""
        super().__init__(text)
        self._page = page

    @overload
    def to_html(self, path: FileName, *, title: str | None = None) -> None: ...

    @overload
    def to_html(self, path: None = None, *, title: str | None = None) -> str: ...

    def to_html(self, path: FileName | None = None, *, title: str | None = None) -> str | None:
        """Makes the page that `estimate-sensor-noise --plot report.html` writes.

        It has the verdict in one sentence, gain, read noise and offset, the noise curve, each warning with its action,
        all quantities, and the maps of the pixels. It needs no other file, no network and no matplotlib. The page of a
        report that was read from JSON has the table, the warnings and the noise curve alone.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Name of a file that ends in .html or .htm. It has the whole page, or is left as it was; its folder has to
            exist. Default: the text of the page is returned.
        title : str, optional
            Title and first heading of the page. Default: the camera if the frames name it, else the kind of the sensor.

        Returns
        -------
        str or None
            The text of the page; None where it was written to a file.

        Raises
        ------
        TypeError
            The path is no name, or the title no str.
        ValueError
            The path is another name.
        OSError
            The file cannot be written.
        """
        return write_page(self._page_text(), path, title)

    def export(
        self,
        format: str,
        output: FileName | None = None,
        *,
        channel: str = "",
        black: float | None = None,
        white: float | None = None,
        analogue_gain: float = 1.0,
        into: FileName | None = None,
    ) -> "NoiseExport":
        """Writes the noise model for a program that asks for one, in its units. Parameters, result and errors are the
        same as in export_noise_model().

        Examples
        --------
        >>> print(report.export("dng", black=64, white=4095))
        """
        from ._export import export_noise_model

        return export_noise_model(
            self, format, output, channel=channel, black=black, white=white, analogue_gain=analogue_gain, into=into
        )

    def _page_text(self) -> str:
        return page("Noise of an image sensor", self._notebook_html()) if self._page is None else unpack(self._page)

    def _notebook_html(self) -> str:
        raise NotImplementedError


def write_page(text: str, path: FileName | None, title: str | None) -> str | None:
    """Writes a page to a file, or returns the page; `title` replaces its title."""
    if title is not None and not isinstance(title, str):
        raise _options.refuse_type("title", title, "a str")
    text = with_title(text, title)
    if path is None:
        return text
    write_file(_target(path), text.encode())
    return None


def _target(path: FileName) -> Path:
    """Returns the file that is written: the target of a link, else `path`."""
    expected = "the name of a file that ends in .html or .htm"
    if not is_name(path):
        raise _options.refuse_type("path", path, expected)
    name = os.fsdecode(path)
    if os.path.isdir(name):
        raise ValueError(f"path is {name!r}, a folder; expected {expected}")
    if not name.lower().endswith(_ENDINGS):
        raise _options.refuse("path", name, expected)
    return Path(os.path.realpath(name))


def write_file(target: Path, content: bytes) -> None:
    """Writes the complete file, or none: it gets its name when it is complete."""
    temporary = target.parent / f".{target.name}.{os.getpid()}"
    try:
        temporary.write_bytes(content)
        os.replace(temporary, target)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(target)) from error  # the name that the caller knows
    finally:
        temporary.unlink(missing_ok=True)
