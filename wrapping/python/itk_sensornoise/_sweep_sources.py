# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The bursts of a sweep: of a mapping, a folder, a table, or frames that record their setting."""

import json
import math
import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from . import _options
from ._frames import open_dumps, open_frames
from ._names import expand, is_name, natural_key
from ._rawpy import is_raw, raw_settings
from ._types import FileName, Frames

EXPECTED = (
    "a mapping of settings to frames, a folder with a folder for each setting, for instance iso800, a table (.csv), or "
    "frames that record their ISO speed"
)
_KEYS = ("SensorNoise.IsoSpeed", "SensorNoise.ExposureSeconds")  # as filters/itkSensorNoiseMetaData.h
_SAME = 0.01  # relative; settings are a quarter apart or more
# The columns of a table that hold the setting: its kind, and how the number becomes the setting.
_COLUMNS: dict[str, tuple[str, Callable[[float], float]]] = {
    "iso": ("iso", lambda number: number),
    "gain": ("gain", lambda number: number),
    "gain_db": ("gain", lambda number: 10.0 ** (number / 20.0)),
    "exposure": ("exposure", lambda number: number),
    "exposure_ms": ("exposure", lambda number: 1e-3 * number),
}


@dataclass(frozen=True)
class _Recorded:
    """Settings that a file records."""

    iso: float | None
    exposure: float | None
    frames: int

    def setting(self, kind: str) -> float | None:
        """Returns the setting of a kind; None where a file has none."""
        return {"iso": self.iso, "exposure": self.exposure}.get(kind)


@dataclass
class SweepBurst:
    """The burst of one setting. A burst with a reason is not measured."""

    name: str
    setting: float | None
    frames: Any
    dark: Any = None
    reason: str | None = None
    recorded: _Recorded | None = None  # by the first file; None where the frames are in no files

    @property
    def iso(self) -> float | None:
        """Returns the ISO speed that the first file records."""
        return None if self.recorded is None else self.recorded.iso

    def source(self, stored: dict[str, Any] | None) -> Any:
        """Returns the burst as a task measures it, unless a stored report is of these frames."""
        from .distributed._sources import Burst

        return Burst(self.frames, self.dark, stored)

    def entry(self, options: str, waiting: str) -> dict[str, Any]:
        """Returns the entry of the passport, without a report."""
        reason = waiting if self.reason is None else self.reason
        return {"name": self.name, "setting": self.setting, "reason": reason, "options": options, "report": None}


def bursts_of(
    sources: Mapping[float, Frames], dark: Mapping[float, Frames], kind: str, raw: str | None
) -> list[SweepBurst]:
    """Returns the bursts of a mapping. `raw`: layout of files without a header."""
    bursts = []
    for given, frames in sources.items():
        setting = _options.number("a setting", given, "a number above 0", above=0.0)
        bursts.append(SweepBurst(f"{setting:g}", setting, frames, dark.get(given)))
    unknown = [setting for setting in dark if setting not in sources]
    if unknown:
        raise ValueError(f"dark has the setting {unknown[0]!r}, which sources has not; expected the same settings")
    names = {burst.name for burst in bursts}
    if len(names) < len(bursts):
        raise ValueError("two settings are the same to six digits; expected settings that differ")
    return _planned([_looked_into(burst, raw) for burst in bursts], kind)


def bursts_of_files(
    sources: FileName | Sequence[FileName], kind: str | None, raw: str | None
) -> tuple[str, list[SweepBurst]]:
    """Returns what the settings are, and the bursts of a folder, a table, a pattern of names, or a list of names."""
    if isinstance(sources, (list, tuple)):
        return _bursts_of_names([os.fsdecode(name) for name in sources], kind, "the list", raw)
    name = os.fsdecode(sources)  # type: ignore[arg-type]  # is no list
    if name.lower().endswith(".csv"):
        return _bursts_in_table(Path(name), kind, raw)
    if not os.path.isdir(name):
        names = expand(name)
        if names == name and not os.path.isfile(name):
            raise ValueError(f"{name} is no folder; expected {EXPECTED}")
        return _bursts_of_names([name] if names == name else names, kind, name, raw)
    paths = [path for path in Path(name).iterdir() if not path.name.startswith(".") and path.name != "dark"]
    folders = [path for path in paths if path.is_dir()]
    if not paths:
        raise ValueError(f"there is no burst in {name}; expected {EXPECTED}")
    return _bursts_of_names([os.fspath(path) for path in sorted(folders or paths, key=natural_key)], kind, name, raw)


def _bursts_of_names(
    names: Iterable[str], kind: str | None, where: str, raw: str | None
) -> tuple[str, list[SweepBurst]]:
    """Returns the bursts of folders, stacks, and single frames, which are grouped by the setting that they record."""
    bursts: list[SweepBurst] = []
    found: dict[str, set[str]] = {}
    single: dict[str, _Recorded] = {}
    for name in names:
        path = Path(name)
        named = _setting_in(path.name if path.is_dir() else path.stem)
        recorded = None if path.is_dir() else _recorded_by(name, raw)
        if recorded is not None and recorded.frames == 1:
            single[name] = recorded
            continue
        if named is not None:
            found.setdefault(named["kind"], set()).add(path.name)
        burst = _burst_at(path, None if named is None else named["value"])
        bursts.append(_looked_into(burst, raw) if recorded is None else replace(burst, recorded=recorded))
    if len(found) > 1 or (kind and found and kind not in found):
        kinds = ", ".join(f"{sorted(items)[0]} ({name})" for name, items in sorted(found.items()))
        raise ValueError(f"{where} has the settings {kinds}; expected {kind or 'settings of one kind'}")
    meaning = kind or next(iter(found), None)
    grouped, of_frames = _grouped(single, meaning)
    if meaning is None:
        meaning = of_frames if grouped else "exposure" if _are_exposures(bursts) else "iso"
    return meaning, _planned([*grouped, *bursts], meaning)


def _setting_in(name: str) -> dict[str, Any] | None:
    """Returns the kind and the value of the setting in a name; None without one."""
    import itk

    found: dict[str, Any] | None = json.loads(itk.SensorNoiseSweep.GetSettingInNameAsJson(name))
    return found


def _burst_at(path: Path, setting: float | None) -> SweepBurst:
    if not path.is_dir():
        return SweepBurst(path.name, setting, os.fspath(path))
    dark = path / "dark"
    return SweepBurst(path.name, setting, _frames_in(path), _frames_in(dark) if dark.is_dir() else None)


def _frames_in(folder: Path) -> str:
    """Returns the name of the only file of a folder, a stack, or of the folder."""
    files = [file for file in folder.iterdir() if file.is_file() and not file.name.startswith(".")]
    return os.fspath(files[0] if len(files) == 1 else folder)


def _recorded_by(name: FileName, raw: str | None) -> _Recorded:
    """Returns the settings of the camera in a file. Pixels are not read."""
    if raw is not None:
        return _Recorded(None, None, open_dumps([name], raw).size[2])
    if is_raw(name):
        settings = raw_settings(name)
        return _Recorded(settings["iso_speed"], settings["exposure_seconds"], 1)
    stack = open_frames([name])  # type: ignore[arg-type]  # a list of one name
    numbers = [dict(stack.image).get(key) for key in _KEYS]
    iso, exposure = (float(number) if number and math.isfinite(number) and number > 0 else None for number in numbers)
    return _Recorded(iso, exposure, stack.size[2])


def _looked_into(burst: SweepBurst, raw: str | None) -> SweepBurst:
    """Returns the burst with what its first file records. Frames that are in no files record nothing."""
    are_names = is_name(burst.frames) or (
        isinstance(burst.frames, (list, tuple)) and bool(burst.frames) and all(map(is_name, burst.frames))
    )
    if not are_names:
        return burst
    try:
        names = expand(burst.frames)
        return replace(burst, recorded=_recorded_by(names[0] if isinstance(names, (list, tuple)) else names, raw))
    except (ValueError, RuntimeError, OSError, ImportError) as error:
        # the measurement has the reason of a burst whose setting is known
        return burst if burst.setting is not None else replace(burst, reason=" ".join(str(error).split()))


def _are_exposures(bursts: Sequence[SweepBurst]) -> bool:
    """Returns whether all record one ISO speed, and exposures that differ."""
    exposures = {each.recorded.exposure for each in bursts if each.recorded is not None and each.iso is not None}
    is_known = None not in exposures and len(exposures) == len(bursts) > 1
    return is_known and len({each.iso for each in bursts}) == 1


def _planned(bursts: Sequence[SweepBurst], kind: str) -> list[SweepBurst]:
    """Returns the bursts with the settings that their files record, and with the reasons not to measure them, as
    --sweep decides (examples/tools/SweepSettings.cxx)."""
    of_exposures = _with_one_gain(bursts) if kind == "exposure" else list(bursts)
    planned = []
    for burst in of_exposures:
        recorded = None if burst.recorded is None else burst.recorded.setting(kind)
        setting, reason = with_recorded_setting(burst, kind, recorded)
        is_other = recorded is not None and reason is not None
        planned.append(replace(burst, setting=setting, reason=reason if is_other else burst.reason or reason))
    return [_with_one_iso(burst) for burst in _without_repetition(planned)]


def _with_one_gain(bursts: Sequence[SweepBurst]) -> list[SweepBurst]:
    """Returns exposures with a reason where they record another ISO speed than the first one: their gain differs."""
    first = next((each for each in bursts if each.iso is not None), None)
    found = []
    for burst in bursts:
        reason = burst.reason
        if first is not None and burst.iso not in (None, first.iso) and reason is None:
            others = f"the files of {first.name} ISO {first.iso:g}; expected exposures at one ISO speed"
            reason = f"its files record ISO {burst.iso:g}, and {others}"
        found.append(replace(burst, reason=reason))
    return found


def _with_one_iso(burst: SweepBurst) -> SweepBurst:
    """Returns the burst with a reason where its raw files record different ISO speeds."""
    if burst.reason is not None or burst.recorded is None:
        return burst
    names = expand(burst.frames)
    if not isinstance(names, (list, tuple)) or not all(map(is_raw, names)):
        return burst  # other files record no ISO speed
    first = burst.recorded.iso
    for name in names[1:]:
        try:
            iso = raw_settings(name)["iso_speed"]
        except (ValueError, OSError):
            return burst  # the measurement has the reason
        if first and iso and iso != first:
            return replace(
                burst,
                reason=f"the frames record different ISO speeds, {first:g} ({os.fsdecode(names[0])}) and {iso:g} "
                f"({os.fsdecode(name)}); expected one setting",
            )
    return burst


def _grouped(single: Mapping[str, _Recorded], kind: str | None) -> tuple[list[SweepBurst], str]:
    """Returns a burst of all frames of each ISO speed, or of each exposure if all have one ISO speed."""
    for name, recorded in single.items():
        if recorded.iso is None:
            raise ValueError(
                f"{name} records no ISO speed, so that its burst is not known; expected a folder for each setting, for "
                "instance iso800, a table (.csv) or a mapping"
            )
    first = next(iter(single.values()), None)
    exposures = {each.exposure for each in single.values()}
    of_one_iso = first is not None and all(each.iso == first.iso for each in single.values())
    meaning = kind or ("exposure" if of_one_iso and len(exposures) > 1 and None not in exposures else "iso")
    groups: dict[float, list[str]] = {}
    for name, recorded in single.items():
        setting = recorded.setting(meaning)
        if setting is None:
            raise ValueError(f"{name} records no {meaning}; expected frames that do, or a mapping")
        groups.setdefault(setting, []).append(name)
    bursts = [
        SweepBurst(_text(meaning, setting), setting, names, recorded=single[names[0]])
        for setting, names in sorted(groups.items())
    ]
    return bursts, meaning


def _bursts_in_table(file: Path, kind: str | None, raw: str | None) -> tuple[str, list[SweepBurst]]:
    """Returns the bursts of a table with a header: the column of the setting, frames and, if there are some, dark."""
    try:
        text = file.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeError) as error:
        raise ValueError(
            f"the table {file} cannot be read ({error}); expected a text file with a header such as iso,frames,dark"
        ) from None
    rows = [
        (f"line {number} of {file}", [cell.strip() for cell in re.split("[,;\t]", line)])
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and line.strip()[0] != "#"
    ]
    if len(rows) < 2:
        raise ValueError(f"{file} has no line with a setting; expected a header such as iso,frames,dark and such lines")
    where, header = rows[0]
    header = [cell.lower() for cell in header]
    column = next((name for name in _COLUMNS if name in header), None)
    if column is None or "frames" not in header:
        missing = " or ".join(_COLUMNS) if column is None else "frames"
        raise ValueError(f"{where} has no column {missing}; expected a header such as iso,frames,dark")
    _require_known_columns(header, column, where)
    meaning, setting_of = _COLUMNS[column]
    if kind not in (None, meaning):
        raise ValueError(f"{file} has the settings {column}; expected {kind}")
    bursts = []
    for where, cells in rows[1:]:
        if len(cells) != len(header):
            raise ValueError(f"{where} has {len(cells)} columns; expected {len(header)}, as the header")
        row = dict(zip(header, cells, strict=True))
        setting = setting_of(_number(row[column], where))
        if not (math.isfinite(setting) and setting > 0.0):
            raise ValueError(f"{where} has the setting {row[column]!r}; expected a finite number above 0")
        if not row["frames"]:
            raise ValueError(f"{where} has no frames; expected a file, a folder or a pattern")
        bursts.append(
            SweepBurst(
                Path(row["frames"]).name,
                setting,
                _frames_at(file.parent / row["frames"]),
                _frames_at(file.parent / row["dark"]) if row.get("dark") else None,
            )
        )
    return meaning, _planned([_looked_into(burst, raw) for burst in bursts], meaning)


def _require_known_columns(header: list[str], setting: str, where: str) -> None:
    """Raises ValueError unless the header has one column for the setting, frames, and dark at most once."""
    for name in header:
        if name not in (setting, "frames", "dark"):
            raise ValueError(
                f"{where} has the columns {setting} and {name[:40]!r}; expected {setting}, frames and, if there are "
                "dark frames, dark. There is no other column: leave it out, or rename it"
            )
        if header.count(name) > 1:
            raise ValueError(f"{where} has the column {name} twice; expected each column once")


def _number(text: str, where: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{where} has the setting {text[:40]!r}; expected a finite number") from None


def _frames_at(path: Path) -> str:
    return _frames_in(path) if path.is_dir() else os.fspath(path)


def _without_repetition(bursts: list[SweepBurst]) -> list[SweepBurst]:
    """Returns the bursts with different names, and with a reason if the setting is the setting of an earlier burst."""
    known: dict[float, str] = {}
    names: dict[str, int] = {}
    found = []
    for burst in bursts:
        names[burst.name] = names.get(burst.name, 0) + 1
        name = burst.name if names[burst.name] == 1 else f"{burst.name} ({names[burst.name]})"
        reason = burst.reason
        if reason is None and burst.setting is not None:
            first = known.setdefault(burst.setting, name)
            if first != name:
                reason = f"{first} has the same setting and is measured; expected one burst for each setting"
        found.append(replace(burst, name=name, reason=reason))
    return found


def with_recorded_setting(burst: SweepBurst, kind: str, recorded: float | None) -> tuple[float | None, str | None]:
    """Returns the setting of a burst, which its files record or its name has, and why it is not used; None: it is."""
    if recorded is not None:
        if burst.setting is not None and abs(burst.setting / recorded - 1) > _SAME:
            given = f"but {_text(kind, burst.setting)} was given; expected the same. Correct the name or the table"
            return recorded, f"its files record {_text(kind, recorded)}, {given}"
        return recorded, None
    if burst.setting is None:
        return None, (
            "its setting is not known: neither the files record an ISO speed, nor does the name hold one. Name it for "
            "instance iso800, gain2.5 or 10ms, or give a table (.csv) or a mapping"
        )
    return burst.setting, None


def _text(kind: str, setting: float) -> str:
    """Returns a setting as SettingText() of sweep/Setting.cxx."""
    return {"iso": "ISO {:g}", "gain": "gain {:g}", "exposure": "exposure {:g} s"}[kind].format(setting)
