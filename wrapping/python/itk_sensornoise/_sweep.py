# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures a camera at all its settings in one call. Each burst is measured separately, and C++ makes the passport."""

import inspect
import json
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from . import _options
from ._errors import InvalidTypeError
from ._estimate import estimate_sensor_noise
from ._names import is_name
from ._passport import Passport, passport_of
from ._sweep_sources import EXPECTED, SweepBurst, bursts_of, bursts_of_files, with_recorded_setting
from ._types import FileName, Frames
from ._version import version_of_package

if TYPE_CHECKING:
    import distributed

KINDS = ("iso", "gain", "exposure")
# Where a report has the setting that its files record.
_RECORDED = {"iso": "iso_speed", "exposure": "exposure_seconds"}
_NOT_OF_SWEEP = ("frames", "dark", "maps", "progress", "method", "exposures")
_NO_OPTIONS_OF_TOOL = ""  # in a passport of estimate-sensor-noise --sweep
_WAITING = "it is not measured yet"


def estimate_sweep(
    sources: Mapping[float, Frames] | FileName | Sequence[FileName],
    client: "distributed.Client | None" = None,
    *,
    kind: Literal["iso", "gain", "exposure"] | None = None,
    dark: Mapping[float, Frames] | None = None,
    output: FileName | None = None,
    **settings: Any,
) -> Passport:
    """Measures a camera at all its ISO speeds, gains or exposures, each burst by estimate_sensor_noise().

    Parameters
    ----------
    sources : mapping of float to frames, str, os.PathLike, or list of these names
        The frames of each setting, as `frames` of estimate_sensor_noise(), or a function without arguments that returns
        them. Or a folder with a folder or a stack for each setting, whose names hold it: iso800, gain2.5, gain6dB, or
        10ms at one gain. Dark frames are in the folder `dark` of a setting's folder. Or a table (.csv) with the column
        iso, gain, gain_db, exposure [s] or exposure_ms, the column frames and, if there are some, dark; names are
        relative to its folder. Or single frames that record their ISO speed, in a folder, a list or a pattern: each ISO
        speed is a burst, or each exposure if all have one ISO speed. The record of the first file of a burst counts
        before its name, the table or the mapping. A burst is not measured, and has a `reason`, if the two differ by
        more than 1 %, if its files record different ISO speeds, or if it is an exposure at another ISO speed.
    client : dask.distributed.Client, optional
        Each setting is a task of its workers, as in distributed.estimate_many(). Default: one setting after the other
        in this process.
    kind : {"iso", "gain", "exposure"}, optional
        Kind of the settings: ISO speeds, gains as factors, or exposure times [s] at one gain. Default: as the names in
        the folder, the table or the frames say; "iso" for a mapping.
    dark : mapping of float to frames, optional
        Dark frames of each setting, of the settings that have some. Only with a mapping.
    output : str or os.PathLike, optional
        File of the passport, written after each setting. If it is there, a setting that it holds with the same options,
        the same version and the same SHA-256 of the frames and dark frames is not measured again: its frames are read
        once. Frames that have changed are measured, and a `mask` in a file has all settings measured. A passport of
        the tool is continued where no options are given. Default: nothing is written.
    **settings
        The options of estimate_sensor_noise() for all settings, but for `dark`, `exposures`, `maps`,
        `method` and `progress`. Reports always have the SHA-256 of their frames (`hash`), by which a passport is
        continued.

    Returns
    -------
    Passport
        The record that `estimate-sensor-noise --sweep --json` writes, with all exports. A burst that cannot be
        measured is an entry with its `reason`. The gains of exposures are tested for equality, and pooled.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value: a setting that is not above 0, a folder without settings, or an output that is no passport.

    See Also
    --------
    Passport : The result.
    itk_sensornoise.distributed.estimate_many : Many bursts that are no sweep.

    Examples
    --------
    >>> passport = itk_sensornoise.estimate_sweep("camera", output="passport.json")
    >>> print(passport)
    >>> passport.export("android", "android.json", black=64, white=4095)
    """
    from .distributed._many import outcomes_of, require_client, require_settings

    require_settings(settings, _NOT_OF_SWEEP)
    require_client(client)
    if kind is not None:
        _options.one_of("kind", kind, KINDS)
    raw = settings.get("raw")
    if isinstance(sources, Mapping):
        if not sources:
            raise ValueError(f"sources is an empty mapping; expected {EXPECTED}")
        meaning: str = kind or "iso"
        bursts = bursts_of(sources, dark or {}, meaning, raw)
    elif is_name(sources) or (isinstance(sources, (list, tuple)) and sources and all(map(is_name, sources))):
        if dark is not None:
            raise InvalidTypeError("dark was given with files; expected a folder dark, or a column dark of a table")
        meaning, bursts = bursts_of_files(sources, kind, raw)
    else:
        raise InvalidTypeError(f"sources is of type {type(sources).__name__}; expected {EXPECTED}")
    _options.true_or_false("hash", settings.get("hash", True))
    options = _options_text(settings)
    stored = {} if is_name(settings.get("mask")) else _stored(output, meaning, options, bursts)
    entries = {burst.name: burst.entry(options, _WAITING) for burst in bursts}
    named = {burst.name: burst for burst in bursts if burst.reason is None}
    for name in named.keys() & stored.keys():
        entries[name] = stored[name]  # so that an interrupted run keeps it in the output
    todo = [(name, burst.source(stored.get(name, {}).get("report"))) for name, burst in named.items()]
    for name, outcome in outcomes_of(client, iter(todo), {**settings, "hash": True}):
        entries[name] = _entry_of(named[name], meaning, outcome, options)
        if output is not None:
            _passport_so_far(meaning, entries).write(output)
    passport = _passport_so_far(meaning, entries)
    if output is not None:
        passport.write(output)
    return passport


def _passport_so_far(kind: str, entries: Mapping[str, dict[str, Any]]) -> Passport:
    """Returns the passport of the settings that were measured, or cannot be."""
    return passport_of(kind, [entry for entry in entries.values() if entry["reason"] != _WAITING])


def _entry_of(burst: SweepBurst, kind: str, outcome: Any, options: str) -> dict[str, Any]:
    """Returns the entry of a burst that was measured, or could not be."""
    entry = burst.entry(options, _WAITING)
    report = None if outcome.report is None else json.loads(outcome.report)
    entry["reason"] = outcome.reason if report is None else _reason_of(report)
    camera = None if report is None else report.get("channels", [report])[0].get("camera")
    entry["setting"], reason = with_recorded_setting(burst, kind, (camera or {}).get(_RECORDED.get(kind, "")))
    entry["reason"] = entry["reason"] or reason
    entry["report"] = report if entry["reason"] is None else None
    return entry


def _reason_of(report: Mapping[str, Any]) -> str | None:
    """Returns why a report has no result: its first error. None: it has one."""
    channels = report.get("channels", [report])
    if any(channel[name]["status"] == "identified" for channel in channels for name in ("gain", "intercept")):
        return None
    errors = (warning for channel in channels for warning in channel["warnings"] if warning["severity"] == "error")
    first = next(errors, {"message": "neither its gain nor its intercept is identified"})
    return str(first["message"])


def _options_text(settings: dict[str, Any]) -> str:
    from .distributed._journal import settings_record

    defaults = {name: each.default for name, each in inspect.signature(estimate_sensor_noise).parameters.items()}
    given = {name: value for name, value in settings.items() if name != "hash"}
    return json.dumps(settings_record(given, defaults), sort_keys=True)


def _stored(
    output: FileName | None, kind: str, options: str, bursts: Sequence[SweepBurst]
) -> dict[str, dict[str, Any]]:
    """Returns the entries of an existing passport that were measured with these options, by the names of the bursts."""
    if output is None:
        return {}
    if not is_name(output):
        raise _options.refuse_type("output", output, "the name of a file")
    if not os.path.exists(output):
        return {}
    try:
        passport = Passport.from_json(output)
    except ValueError as error:
        raise type(error)(f"{error}. It is not overwritten: name another file as output") from None
    if passport["setting"] != kind or passport["version"] != version_of_package():
        return {}
    same = (options, _NO_OPTIONS_OF_TOOL) if options == "{}" else (options,)
    known = [entry for entry in passport["settings"] if entry["reason"] is None and entry["options"] in same]
    by_setting = {entry["setting"]: entry for entry in known}
    by_name = {entry["name"]: entry for entry in known}
    found = {burst.name: by_setting.get(burst.setting, by_name.get(burst.name)) for burst in bursts}
    return {name: entry for name, entry in found.items() if entry is not None}
