# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""A measured noise model, for the programs that ask for one, in their units."""

import functools
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import _options
from ._names import is_name
from ._pictures import write_file
from ._read import record_of, text_of
from ._types import FileName, ItkObject
from ._values import python_errors, set_numbers, set_values


@dataclass(frozen=True)
class NoiseExport:
    """Files and text of a noise model in one format. Report.export() makes it, and print() shows its text.

    Attributes
    ----------
    format : str
        Name of the format, see export_formats().
    files : dict of str to bytes
        The bytes of each file, by its name.
    note : str
        A sentence about the misfit or the use; it may be empty.
    """

    format: str
    files: dict[str, bytes]
    note: str

    @property
    def text(self) -> str:
        """The text of the only file. Raises ValueError if there are several files, or no text."""
        if len(self.files) != 1:
            raise ValueError(f"{self.format} has {len(self.files)} files; expected a format of one: use files")
        (content,) = self.files.values()
        try:
            return content.decode()
        except UnicodeDecodeError:
            raise ValueError(f"{self.format} has a file that is no text; use files") from None

    def __str__(self) -> str:
        return self.text.rstrip("\n")

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name} ({len(content)} bytes)" for name, content in self.files.items())
        return f"<NoiseExport: {self.format}, {sizes}>"

    def write(self, output: FileName) -> None:
        """Writes the file to `output`, or several files into the folder `output`. Raises OSError if that fails."""
        if not is_name(output):
            raise _options.refuse_type("output", output, "the name of a file, or of a folder for several files")
        target = Path(os.fsdecode(output))
        for name, content in self.files.items():
            write_file(target if len(self.files) == 1 else target / name, content)


@functools.cache
def _formats() -> tuple[dict[str, Any], ...]:
    import itk

    return tuple(json.loads(itk.NoiseModelExporter.GetFormatsAsJson()))


def export_formats() -> list[dict[str, Any]]:
    """Lists the formats of Report.export(): the table of the C++ library.

    Returns
    -------
    list of dict
        `name`, `consumer` (the program), `takes` ("line", "sensor" or "maps"), `exactness` ("exact", "rounded",
        "fitted" or "calibrated"), `fields` (what is written), `is_text`, `least_reports` (how many reports it needs)
        and `takes_several` (whether it takes more).

    Examples
    --------
    >>> [entry["name"] for entry in itk_sensornoise.export_formats()]

    See Also
    --------
    export_noise_model : Writes a report in one of them.
    """
    return [dict(entry) for entry in _formats()]


def export_noise_model(
    reports: Mapping[str, Any] | FileName | Sequence[Mapping[str, Any] | FileName],
    format: str,
    output: FileName | None = None,
    *,
    channel: str = "",
    black: float | None = None,
    white: float | None = None,
    analogue_gain: float = 1.0,
    max_analogue_iso: float | None = None,
    into: FileName | None = None,
) -> NoiseExport:
    """Writes the noise model of a report, or of several, for a program that asks for one, in its units.

    Parameters
    ----------
    reports : Report, ChannelReports, str or os.PathLike, or a sequence of them
        One report, or the name of its JSON file; or for the formats "android" and "darktable" one for each ISO speed.
    format : str
        Name of the format, see export_formats().
    output : str or os.PathLike, optional
        File to write, or an existing folder for a format of several files. Default: nothing is written.
    channel : {"", "R", "G1", "G2", "B"}
        The only channel of a mosaic. Default: all.
    black, white : float, optional
        Black and white level [DN]. Default: the camera settings in the report.
    analogue_gain : float
        Analogue gain of the burst [1], above 0, for "libcamera". Default: 1.
    max_analogue_iso : float, optional
        ISO speed above which the gain is digital, for "android". Default: no ISO speed is digital.
    into : str or os.PathLike, optional
        DNG file, for "dng": the export is then its copy with the tag NoiseProfile, by the levels of the file.

    Returns
    -------
    NoiseExport

    Raises
    ------
    TypeError
        An argument is of another type.
    ValueError
        There is no such format, or the noise cannot be written in it: the sentence says what is missing.
    OSError
        The output cannot be written.

    Examples
    --------
    >>> print(itk_sensornoise.export_noise_model([iso100, iso400], "android", white=4095))

    See Also
    --------
    export_formats : The formats.
    Report.export : Writes one report.
    """
    import itk

    if not isinstance(format, str):
        raise _options.refuse_type("format", format, "the name of a format, see export_formats()")
    is_one = isinstance(reports, Mapping) or is_name(reports)
    several: list[Any] = [reports] if is_one else list(reports)  # type: ignore[arg-type]  # is no name
    given = [record_of(*text_of(report)) if is_name(report) else report for report in several]
    exporter = itk.NoiseModelExporter.New()
    for number, report in enumerate(given, 1):
        _add(exporter, _channel_of(report, channel), str(number) if len(given) > 1 else "of this export")
    if given and format == "maps":
        _set_maps(exporter, getattr(given[0], "maps", {}))
    set_numbers(exporter, black=black, white=white, analogue_gain=analogue_gain, max_analogue_iso=max_analogue_iso)
    if into is not None:
        if not is_name(into):
            raise _options.refuse_type("into", into, "the name of a DNG file")
        exporter.SetDngFile(os.fsdecode(into))
    return export_by(exporter, format, output)


def _channel_of(report: Any, channel: str) -> Any:
    """Returns the report of a channel of a mosaic; the whole report if `channel` is empty."""
    if channel == "":
        return report
    expected = '"R", "G1", "G2" or "B" of a mosaic, or ""'
    if not isinstance(channel, str):
        raise _options.refuse_type("channel", channel, expected)
    found = [each for each in report.get("channels", []) if each.get("channel") == channel]
    if not found:
        raise _options.refuse("channel", channel, expected)
    return found[0]


def _add(exporter: ItkObject, report: Mapping[str, Any], name: str) -> None:
    if not isinstance(report, Mapping):
        raise _options.refuse_type("reports", report, "a report, or a sequence of reports")
    set_values(exporter, report)
    exporter.AddReport(name)


def _set_maps(exporter: ItkObject, maps: Mapping[str, np.ndarray]) -> None:
    """Sets the maps of dark frames, where there are some."""
    import itk

    names = ("pixel_offset", "pixel_read_noise")
    if all(name in maps for name in names):
        exporter.SetMaps(*(itk.image_from_array(np.ascontiguousarray(maps[name], float)) for name in names))


def export_by(exporter: ItkObject, format: str, output: FileName | None, *setting: float) -> NoiseExport:
    """Makes the files by an object of ITK, and writes them if an output is given."""
    with python_errors():
        exporter.Export(format, *setting)
    # SWIG makes a str of std::string; bytes that are no UTF-8 are surrogates.
    files = {
        exporter.GetFileName(index): exporter.GetFileBytes(index).encode("utf-8", "surrogateescape")
        for index in range(exporter.GetNumberOfFiles())
    }
    made = NoiseExport(format, files, exporter.GetNote())
    if output is not None:
        made.write(output)
    return made
