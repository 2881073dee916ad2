# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The table of a report that was read from JSON: the text that C++ prints of the same record."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ._catalogue import quantity_list
from ._quantity import member
from ._rounding import end_of_interval, limits_of, measured, of_three_digits, rounded_quantity, shortened, with_signs

# Quantities that the table has only where they say something; all others stand in every table.
_RECORD_ONLY = {"vibration.covariance", "noise_correlation.excess_kurtosis"}
_IF_KNOWN = {"read_noise_median", "noise_correlation.row_noise", "noise_correlation.column_noise"}
# Columns of the table of a mosaic: title and path.
_COLUMNS = (
    ("gain g", "gain"),
    ("offset mu", "offset"),
    ("read noise sigma", "read_noise"),
    ("sigma^2 - g mu", "intercept"),
    ("sigma_alpha", "vibration.sd_x"),
    ("sigma_beta", "vibration.sd_y"),
    ("Cov(alpha, beta)", "vibration.covariance"),
    ("sigma_gamma", "flicker_sd"),
)


def text_of_report(record: Mapping[str, Any]) -> str:
    """Returns the table of one report with its warnings."""
    pixels = record["pixels"]
    used = 100.0 * pixels["used"] / pixels["total"]
    lines = [
        f"{_frames(record)}{_counted(record)} of {record['width']} x {record['height']} pixels{_dn_range(record)}",
        f"{pixels['used']} of {pixels['total']} pixels used ({used:.1f} %), {pixels['clipped']} clipped, "
        f"{pixels['not_finite']} not finite",
        f"method: {record['method']}",
        *_input(record.get("input")),
        "",
        *_quantities(record),
    ]
    line = record["fit"]["line"]
    if line and record["gain"]["value"] is None:
        fitted = f"variance = {line['gain']:.5g} mean {line['intercept']:+.5g}"
        lines += ["", f"indicative: {fitted} (the line through all levels; no measurement)"]
    described: list[str] = [text for text in (say(record) for say in _DESCRIPTIONS) if text]
    lines += ["", *described] if described else []
    return _with_warnings(lines, record["warnings"])


def text_of_channels(record: Mapping[str, Any]) -> str:
    """Returns the table of the channels of a mosaic with all warnings."""
    channels, bayer = record["channels"], record["bayer"]
    first = channels[0]
    units = {entry["path"]: entry["unit"] for entry in quantity_list()}
    rows = [
        ["channel", *(with_signs(title) for title, _ in _COLUMNS)],
        ["", *(with_signs(f"[{units[path]}]") for _, path in _COLUMNS)],
        *([channel["channel"], *(_cell(member(channel, path)) for _, path in _COLUMNS)] for channel in channels),
    ]
    widths = [max(map(len, column)) + 2 for column in zip(*rows, strict=True)]
    aligned = ["".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    joint, motion = record["joint"], record["joint_vibration"]
    lines = [
        f"{_frames(first)}, planes of {first['width']} x {first['height']} pixels of a {bayer['pattern']} "
        f"mosaic ({bayer['source']})",
        f"method: {first['method']}",
        *_input(record.get("input")),
        "",
        *aligned,
        *([""] if joint or motion else []),
        *([_joint_offset(joint)] if joint else []),
        *([_joint_motion(motion)] if motion else []),
    ]
    return _with_warnings(lines, _warnings_of_channels(record))


def _with_warnings(lines: Sequence[str], warnings: Sequence[Mapping[str, Any]]) -> str:
    texts = [f"{warning['severity']}: {with_signs(warning['message'])} [{warning['code']}]" for warning in warnings]
    return "\n".join([*lines, *(["", *texts] if texts else [])]) + "\n"


def _warnings_of_channels(record: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Returns the warnings of all channels together, then each warning of channels once, with the names of its
    channels."""
    channels_of: dict[tuple[str, str, str], list[str]] = {}
    for channel in record["channels"]:
        for warning in channel["warnings"]:
            key = (warning["severity"], warning["message"], warning["code"])
            channels_of.setdefault(key, []).append(channel["channel"])
    return list(record["warnings"]) + [
        {"severity": severity, "message": f"{', '.join(names)}: {message}", "code": code}
        for (severity, message, code), names in channels_of.items()
    ]


def _frames(record: Mapping[str, Any]) -> str:
    return "1 frame" if record["frames"] == 1 else f"{record['frames']} frames"


def _counted(record: Mapping[str, Any]) -> str:
    left_out = len(record["frames_left_out"])
    parts = [f"{left_out} left out"] if left_out else []
    if record["frames_distinct"] + left_out < record["frames"]:
        parts.append(f"{record['frames_distinct']} different")
    return f" ({', '.join(parts)})" if parts else ""


def _dn_range(record: Mapping[str, Any]) -> str:
    text = f", {record['bit_depth']} bits ({record['bit_depth_source']})" if record["bit_depth"] is not None else ""
    step, low, high = (record[name] for name in ("quantisation_step", "clip_low", "clip_high"))
    text += f", quantization step {step:g} DN" if step is not None else ""
    if low is not None or high is not None:
        text += f", levels {shortened(low)} to {shortened(high)} DN ({_clip_source(record['clip_source'])})"
    return text


def _clip_source(source: str) -> str:
    """Returns the source of a clip level of the record in words."""
    return source.replace("code range", "DN range").replace("pile-up", "repeated extreme values")


def _input(record: Mapping[str, Any] | None) -> list[str]:
    if record is None:
        return []
    lines = []
    for what, part in (("frames", record), ("dark frames", record.get("dark"))):
        if part is not None:
            files = "1 file" if part["files"] == 1 else f"{part['files']} files"
            count = "pixels" if part["of"] == "pixels" else files
            lines.append(f"{what}: {count}, {part['bytes']} bytes, SHA-256 {part['sha256'] or 'not computed'}")
    return lines


def _is_shown(path: str, quantity: Mapping[str, Any] | None, record: Mapping[str, Any]) -> bool:
    if quantity is None or path in _RECORD_ONLY:
        return False
    value = quantity["value"]
    if path in _IF_KNOWN:
        return value is not None
    if path == "variance_slope":
        return value is not None and shortened(value) != shortened(record["gain"]["value"])
    if path.startswith("linearity."):
        return value is not None or quantity["status"] == "upper-limit"
    return True


def _quantities(record: Mapping[str, Any]) -> list[str]:
    found = [(entry, member(record, entry["path"])) for entry in quantity_list()]
    rows = [(entry, quantity) for entry, quantity in found if _is_shown(entry["path"], quantity, record)]
    has_errors = any(quantity["standard_error"] is not None for _, quantity in rows)
    error, limits = (f"{'  error':12} ", "95 % interval or limits") if has_errors else (" ", "limits")
    lines = [f"{'quantity':24} {'value':>12} {error}{'unit':8} {'status':17} {limits}"]
    for entry, quantity in rows:
        rounded, ends = rounded_quantity(quantity), limits_of(quantity)
        line = f"{with_signs(entry['label']):24} {rounded.value:>12} "
        line += f"{'± ' + rounded.error if rounded.error else '':12} " if has_errors else " "
        line += f"{with_signs(entry['unit']):8} {quantity['status']:17} "
        line += f"[{', '.join(end_of_interval(end, rounded) for end in ends)}]" if ends else ""
        lines.append(line.rstrip())
    return lines


def _fit(record: Mapping[str, Any]) -> str:
    fit = record["fit"]
    chi2, offset_line = fit.get("reduced_chi2"), fit.get("offset_line_phi")
    if chi2 is None:
        return ""
    text = f"fit: reduced chi2 {chi2:.4g} (1: only sampling noise is left)"
    return text + (
        f", offset line {offset_line:.4g} (1: all pixels have one flicker)" if offset_line is not None else ""
    )


def _response(record: Mapping[str, Any]) -> str:
    nonlinearity = record["fit"].get("nonlinearity")
    if nonlinearity is None:
        return ""
    by = f"up to {100.0 * nonlinearity:.2g} % of itself" if nonlinearity > 0 else "no more than noise"
    return f"response: the variance deviates from its line by {by}"


def _noise(record: Mapping[str, Any]) -> str:
    noise = record.get("noise_correlation")
    if not noise:
        return ""
    kind = noise["kind"]
    if kind == "white":
        lines = any(noise[name]["status"] == "identified" for name in ("row_noise", "column_noise"))
        parts = ["row and column noise"] * lines + ["periodic interference"] * bool(noise.get("interference"))
        if parts:
            return f"noise: white, except for {' and '.join(parts)}"
        return "noise: white (no correlation between neighbours or frames)"
    if kind == "not-linear":
        return "noise: not-linear (not as a sensor or a linear filter leaves it: the gain is not identifiable)"
    if kind == "enlarged":
        return "noise: enlarged (fewer samples than pixels: the gain is not identifiable)"
    who, lags = ("frames", noise["time"]) if kind == "temporal" else ("neighbours", noise["space"])
    most = max((lag["value"] for lag in lags), key=abs, default=None)
    size = "" if most is None else f" up to {100.0 * most:.2g} %"
    tail = "; the gain is from the covariance over all lags" if record["gain"]["value"] is not None else ""
    return f"noise: {kind}, correlation of {who}{size}{tail}"


def _linearity(record: Mapping[str, Any]) -> str:
    found = record["linearity"]
    if not found["levels"]:
        return ""
    if found["reason"]:
        return f"linearity: not identifiable: {found['reason']}"
    used = sum(level["deviation_percent"] is not None for level in found["levels"])
    source = found["offset_source"]
    return (
        f"linearity: {used} of {len(found['levels'])} exposures in the range, saturation "
        f"{found['saturation_dn'] or 0.0:.5g} DN ({_clip_source(found['saturation_source'])}), offset of "
        f"{'the line' if source == 'line' else source}"
    )


_DESCRIPTIONS: tuple[Callable[[Mapping[str, Any]], str], ...] = (_fit, _response, _noise, _linearity)


def _cell(quantity: Mapping[str, Any]) -> str:
    """Returns the text of a quantity of a channel: the value with its error, its limit, or the reason for no value."""
    value, error, limits = quantity["value"], quantity["standard_error"], limits_of(quantity)
    if value is not None:
        return f"{value:.6g}" if error is None else str(measured(value, error))
    if quantity["status"] == "upper-limit" and limits and limits[1] is not None:
        return f"< {of_three_digits(limits[1])}"
    return str(quantity["status"])


def _joint_offset(joint: Mapping[str, Any]) -> str:
    if joint["precision_gain"] is None:
        return "joint offset: none, the channels' differ by more than their errors"
    gain, chi2 = (of_three_digits(joint[name]) for name in ("precision_gain", "reduced_chi2"))
    precision = f"{gain} times as precise as the best channel's (chi2 of the four {chi2})"
    return f"joint offset: {_cell(joint['offset'])} DN, {precision}"


def _joint_motion(motion: Mapping[str, Any]) -> str:
    x, y, covariance = (_cell(motion[name]) for name in ("sd_x", "sd_y", "covariance"))
    return f"joint vibration: x {x}, y {y} pixel of a plane, covariance {covariance} pixel²"
