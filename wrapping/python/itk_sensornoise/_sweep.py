# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures a camera at all its settings in one call. Each burst is measured separately, and C++ makes the passport."""

import inspect
import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _options
from ._errors import InvalidTypeError
from ._estimate import estimate_sensor_noise
from ._names import is_name, natural_key
from ._passport import Passport, passport_of
from ._types import FileName, Frames
from ._version import version_of_package

if TYPE_CHECKING:
    import distributed

KINDS = ("iso", "gain", "exposure")
_EXPECTED = "a mapping of settings to frames, or a folder with a folder for each setting, for instance iso800"
_SAME = 0.01  # relative; settings are a quarter apart or more
# Where a report has the setting that its files record.
_RECORDED = {"iso": "iso_speed", "exposure": "exposure_seconds"}
_NOT_OF_SWEEP = ("frames", "dark", "maps", "progress", "method", "exposures")
_NO_OPTIONS_OF_TOOL = ""  # in a passport of estimate-sensor-noise --sweep
_WAITING = "it is not measured yet"


def estimate_sweep(
    sources: Mapping[float, Frames] | FileName,
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
    sources : mapping of float to frames, str or os.PathLike
        The frames of each setting, as `frames` of estimate_sensor_noise(), or a function without arguments that returns
        them. Or a folder with a folder or a stack for each setting, whose names hold it: iso800, gain2.5, gain6dB, or
        10ms at one gain. Dark frames are in the folder `dark` of a setting's folder.
    client : dask.distributed.Client, optional
        Each setting is a task of its workers, as in distributed.estimate_many(). Default: one setting after the other
        in this process.
    kind : {"iso", "gain", "exposure"}, optional
        What the settings are: ISO speeds, gains as factors, or exposure times [s] at one gain. Default: as the names in
        the folder say; "iso" for a mapping.
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
        The same record as `estimate-sensor-noise --sweep --json` writes, which has all exports. A burst that cannot be
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
    if is_name(sources):
        if dark is not None:
            raise InvalidTypeError("dark was given with a folder, whose dark frames are in its folders; expected none")
        meaning, bursts = _bursts_in(Path(os.fsdecode(sources)), kind)
    elif isinstance(sources, Mapping):
        if not sources:
            raise ValueError(f"sources is an empty mapping; expected {_EXPECTED}")
        meaning, bursts = kind or "iso", _bursts_of(sources, dark or {})
    else:
        raise InvalidTypeError(f"sources is of type {type(sources).__name__}; expected {_EXPECTED}")
    _options.true_or_false("hash", settings.get("hash", True))
    options = _options_text(settings)
    stored = {} if is_name(settings.get("mask")) else _stored(output, meaning, options, bursts)
    entries = {burst.name: burst.entry(options) for burst in bursts}
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


class _Burst:
    """The burst of one setting."""

    def __init__(self, name: str, setting: float | None, frames: Any, dark: Any, reason: str | None = None) -> None:
        self.name, self.setting, self.reason = name, setting, reason
        self._frames, self._dark = frames, dark

    def source(self, stored: dict[str, Any] | None) -> Any:
        """Returns the burst as a task measures it, unless a stored report is of these frames."""
        from .distributed._sources import Burst

        return Burst(self._frames, self._dark, stored)

    def entry(self, options: str) -> dict[str, Any]:
        """Returns the entry of the passport, without a report."""
        reason = _WAITING if self.reason is None else self.reason
        return {"name": self.name, "setting": self.setting, "reason": reason, "options": options, "report": None}


def _bursts_of(sources: Mapping[float, Frames], dark: Mapping[float, Frames]) -> list[_Burst]:
    bursts = []
    for given, frames in sources.items():
        setting = _options.number("a setting", given, "a number above 0", above=0.0)
        bursts.append(_Burst(f"{setting:g}", setting, frames, dark.get(given)))
    unknown = [setting for setting in dark if setting not in sources]
    if unknown:
        raise ValueError(f"dark has the setting {unknown[0]!r}, which sources has not; expected the same settings")
    names = {burst.name for burst in bursts}
    if len(names) < len(bursts):
        raise ValueError("two settings are the same to six digits; expected settings that differ")
    return bursts


def _bursts_in(folder: Path, kind: str | None) -> tuple[str, list[_Burst]]:
    """Returns what the settings are, and the bursts of a folder, whose names hold their settings."""
    import itk

    if not folder.is_dir():
        raise ValueError(f"{folder} is no folder; expected {_EXPECTED}")
    paths = [path for path in folder.iterdir() if not path.name.startswith(".") and path.name != "dark"]
    folders = [path for path in paths if path.is_dir()]
    found: dict[str, set[str]] = {}
    bursts = []
    for path in sorted(folders or paths, key=natural_key):
        name = path.name if path.is_dir() else path.stem
        named = json.loads(itk.SensorNoiseSweep.GetSettingInNameAsJson(name))
        if named is not None:
            found.setdefault(named["kind"], set()).add(path.name)
        bursts.append(_burst_at(path, None if named is None else named["value"]))
    if not bursts:
        raise ValueError(f"there is no burst in {folder}; expected {_EXPECTED}")
    if len(found) > 1 or (kind and found and kind not in found):
        kinds = ", ".join(f"{sorted(names)[0]} ({name})" for name, names in sorted(found.items()))
        raise ValueError(f"{folder} has the settings {kinds}; expected {kind or 'settings of one kind'}")
    return kind or next(iter(found), "iso"), _without_repetition(bursts)


def _burst_at(path: Path, setting: float | None) -> _Burst:
    if not path.is_dir():
        return _Burst(path.name, setting, os.fspath(path), None)
    dark = path / "dark"
    return _Burst(path.name, setting, _frames_in(path), _frames_in(dark) if dark.is_dir() else None)


def _frames_in(folder: Path) -> str:
    """Returns the name of the only file of a folder, a stack, or of the folder."""
    files = [file for file in folder.iterdir() if file.is_file() and not file.name.startswith(".")]
    return os.fspath(files[0] if len(files) == 1 else folder)


def _without_repetition(bursts: list[_Burst]) -> list[_Burst]:
    """Sets the reason of bursts whose setting was already measured."""
    known: dict[float, str] = {}
    for burst in bursts:
        if burst.setting in known:
            burst.reason = (
                f"{known[burst.setting]} has the same setting and is measured; expected one burst for each setting"
            )
        elif burst.setting is not None:
            known[burst.setting] = burst.name
    return bursts


def _entry_of(burst: _Burst, kind: str, outcome: Any, options: str) -> dict[str, Any]:
    """Returns the entry of a burst that was measured, or could not be."""
    entry = burst.entry(options)
    report = None if outcome.report is None else json.loads(outcome.report)
    entry["reason"] = outcome.reason if report is None else _reason_of(report)
    camera = None if report is None else report.get("channels", [report])[0].get("camera")
    recorded = (camera or {}).get(_RECORDED.get(kind, ""))
    if recorded is not None and burst.setting is None:
        entry["setting"] = float(recorded)
    elif recorded is not None and not math.isclose(recorded, burst.setting or 0.0, rel_tol=_SAME):
        entry["reason"] = entry["reason"] or (
            f"its files record {recorded:g}, but {burst.setting:g} was given; expected the same setting"
        )
    elif burst.setting is None:
        entry["reason"] = entry["reason"] or (
            "its setting is not known: neither its files nor its name have one. Name it for instance iso800, gain2.5 "
            "or 10ms, or give a mapping"
        )
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


def _stored(output: FileName | None, kind: str, options: str, bursts: Sequence[_Burst]) -> dict[str, dict[str, Any]]:
    """Returns the entries of an existing passport that were measured with these options, by the names of the bursts."""
    if output is None:
        return {}
    if not is_name(output):
        raise _options.refuse_type("output", output, "the name of a file")
    if not os.path.exists(output):
        return {}
    passport = Passport.from_json(output)
    if passport["setting"] != kind or passport["version"] != version_of_package():
        return {}
    same = (options, _NO_OPTIONS_OF_TOOL) if options == "{}" else (options,)
    known = [entry for entry in passport["settings"] if entry["reason"] is None and entry["options"] in same]
    by_setting = {entry["setting"]: entry for entry in known}
    by_name = {entry["name"]: entry for entry in known}
    found = {
        burst.name: by_name.get(burst.name) if burst.setting is None else by_setting.get(burst.setting)
        for burst in bursts
    }
    return {name: entry for name, entry in found.items() if entry is not None}
