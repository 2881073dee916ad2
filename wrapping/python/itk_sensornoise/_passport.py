# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The noise of a camera over its settings: one record with the reports of all of them."""

import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _options
from ._channels import ChannelReports
from ._errors import itk_errors
from ._export import NoiseExport, export_by
from ._names import is_name
from ._pictures import write_file, write_page
from ._read import text_of
from ._record import Record
from ._report import Report
from ._rounding import with_signs
from ._types import FileName, ItkObject
from ._values import set_numbers, set_values
from ._version import version_of_package

SCHEMA = "itk-sensornoise-passport/1"
_EXPECTED = "the JSON of a passport, or the name of its file"


class Passport(Record):
    """The noise of a camera at all its settings: the record of estimate_sweep() and `estimate-sensor-noise --sweep`.

        passport["setting"]                 "iso", "gain" or "exposure": what the settings are
        passport["settings"]                by rising setting: `name`, `setting`, `status`, `reason`, the numbers of
                                            the table as `channels`, and the whole `report`
        passport["gain_line"]               the line gain = scale x setting, and how each gain deviates from it
        passport["conversion_gain_switch"]  None where no switch was found
        passport["common_gain"]             of exposures: the test of equal gains, and their mean, for each channel
        passport["findings"]                the results as sentences
        passport.report(800)                the Report or the ChannelReports of a setting
        passport.export("fits", setting=800)

    print() shows the table and the findings. It is a dict that cannot be changed, as a report, and can be pickled.

    See Also
    --------
    estimate_sweep : Measures it.
    """

    @classmethod
    def from_json(cls, source: str | FileName) -> "Passport":
        """Reads a passport that was written as JSON: by to_json() or `estimate-sensor-noise --sweep --json`.

        Parameters
        ----------
        source : str or os.PathLike
            The JSON text, or the name of its file.

        Returns
        -------
        Passport

        Raises
        ------
        TypeError
            The source is neither.
        ValueError
            The file cannot be read, or is no passport.
        """
        text, name = text_of(source, "passport")
        try:
            record = json.loads(text)
        except ValueError as error:
            raise ValueError(f"{name} is no JSON ({error}); expected {_EXPECTED}") from None
        if not isinstance(record, dict) or record.get("schema") != SCHEMA:
            raise ValueError(f'{name} is no passport; expected the schema "{SCHEMA}", as estimate_sweep() writes it')
        for member, kind in (("setting", str), ("settings", list)):
            if not isinstance(record.get(member), kind):
                raise ValueError(f"{name} has no {member} as estimate_sweep() writes it; expected a whole passport")
        return cls(text)

    def report(self, setting: float) -> Report | ChannelReports:
        """Returns the report of a measured setting. Raises KeyError if there is none."""
        for entry in _measured(self["settings"]):
            if math.isclose(entry["setting"], setting, rel_tol=1e-6):
                text = json.dumps(entry["report"])
                return ChannelReports(text) if "channels" in entry["report"] else Report(text)
        known = ", ".join(f"{entry['setting']:g}" for entry in _measured(self["settings"]))
        raise KeyError(f"{setting!r} was not measured; expected one of {known}")

    def export(
        self,
        format: str,
        output: FileName | None = None,
        *,
        setting: float | None = None,
        channel: str = "",
        black: float | None = None,
        white: float | None = None,
        analogue_gain: float = 1.0,
        max_analogue_iso: float | None = None,
    ) -> NoiseExport:
        """Writes the noise model for a program that asks for one, in its units: of one setting, or of all.

        Parameters
        ----------
        format : str
            Name of the format, see export_formats().
        output : str or os.PathLike, optional
            File to write, or an existing folder for a format of several files. Default: nothing is written.
        setting : float, optional
            ISO speed, gain or exposure. ISO speeds and gains between measured ones are interpolated, with a note.
            Default: all measured settings, for a format that takes several.
        channel : {"", "R", "G1", "G2", "B"}
            The only channel of a mosaic. Default: all.
        black, white, analogue_gain, max_analogue_iso
            As in export_noise_model().

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
        """
        if not isinstance(format, str):
            raise _options.refuse_type("format", format, "the name of a format, see export_formats()")
        sweep = sweep_of(self["setting"], self["settings"])
        sweep.SetChannel(channel)
        set_numbers(sweep, black=black, white=white, analogue_gain=analogue_gain, max_analogue_iso=max_analogue_iso)
        at = math.nan if setting is None else _options.number("setting", setting, "a number above 0", above=0.0)
        return export_by(sweep, format, output, at)

    def write(self, output: FileName) -> None:
        """Writes the passport as a JSON file. Raises OSError if that fails."""
        if not is_name(output):
            raise _options.refuse_type("output", output, "the name of a file")
        write_file(Path(os.fsdecode(output)), self.to_json().encode())

    def to_html(self, path: FileName | None = None, *, title: str | None = None) -> str | None:
        """Makes the page of the sweep: the findings, each number against the setting, and the table.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Name of a file that ends in .html or .htm. Default: the text of the page is returned.
        title : str, optional
            Title and first heading of the page.

        Returns
        -------
        str or None
            The text of the page; None where it was written to a file.
        """
        return write_page(_summarised(self).GetSummaryAsHtml(), path, title)

    def __str__(self) -> str:
        return with_signs(_summarised(self).GetSummaryAsText().rstrip("\n"))

    def __repr__(self) -> str:
        count = sum(1 for _ in _measured(self["settings"]))
        return f"<Passport: {self['camera'] or 'a camera'}, {count} of {len(self['settings'])} settings measured>"


def passport_of(kind: str, entries: Sequence[Mapping[str, Any]]) -> Passport:
    """Makes the passport of settings: `name`, `setting`, `reason`, `options` and `report` of each. C++ makes the
    numbers."""
    ordered = sorted(entries, key=lambda entry: math.inf if entry["setting"] is None else entry["setting"])
    sweep = sweep_of(kind, ordered)
    with itk_errors():
        sweep.Summarise()
    found = json.loads(sweep.GetSummaryAsJson())
    channels = iter(found.pop("channels"))
    for program in ("android", "darktable"):
        if found[program]["model"] is not None:
            found[program]["model"] = json.loads(found[program]["model"])
    settings = [
        {
            "name": entry["name"],
            "setting": entry["setting"],
            "status": "measured" if entry["reason"] is None else "failed",
            "reason": entry["reason"],
            "options": entry["options"],
            "channels": next(channels) if entry["reason"] is None else [],
            "report": entry["report"],
        }
        for entry in ordered
    ]
    record = {"schema": SCHEMA, "version": version_of_package(), "setting": kind, "settings": settings, **found}
    return Passport(json.dumps(record, indent=1, sort_keys=True, ensure_ascii=False) + "\n")


def sweep_of(kind: str, settings: Sequence[Mapping[str, Any]]) -> ItkObject:
    """Gives the settings of a passport to C++."""
    import itk

    sweep = itk.SensorNoiseSweep.New()
    sweep.SetSettingKind(kind)
    for entry in settings:
        if entry["reason"] is None:
            set_values(sweep, entry["report"])
            sweep.AddReport(entry["name"], float(entry["setting"]))
        else:
            sweep.AddUnmeasured(
                entry["name"], math.nan if entry["setting"] is None else float(entry["setting"]), entry["reason"]
            )
    return sweep


def _summarised(passport: Passport) -> ItkObject:
    sweep = sweep_of(passport["setting"], passport["settings"])
    with itk_errors():
        sweep.Summarise()
    return sweep


def _measured(settings: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    return [entry for entry in settings if entry["reason"] is None]
