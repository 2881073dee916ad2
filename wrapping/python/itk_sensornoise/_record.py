# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""A record of a measurement: a dict that cannot be changed.

Beside its members a record has a JSON text and a table, which C++ made; a value that was changed would be in none of
them, and be lost without a word when the record is printed, drawn, written or pickled. So changing is an error, and
copies are plain: to_dict(), dict() of it, and copy.copy() or copy.deepcopy() of a member.
"""

import json
from typing import Any, NoReturn


def _refuse(self: Any, *_arguments: Any, **_others: Any) -> NoReturn:
    raise TypeError(
        "the record of a measurement cannot be changed; to_dict(), or copy.deepcopy() of a member, is a copy that can"
    )


class _FixedDict(dict[str, Any]):
    """A dict that cannot be changed; what is made of it by copying or pickling is a dict."""

    __setitem__ = __delitem__ = clear = pop = popitem = setdefault = update = __ior__ = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


class _FixedList(list[Any]):
    """A list that cannot be changed; what is made of it by copying or pickling is a list."""

    __setitem__ = __delitem__ = append = clear = extend = insert = pop = remove = reverse = sort = _refuse
    __iadd__ = __imul__ = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return list, (list(self),)


def _fixed(value: Any) -> Any:
    if isinstance(value, dict):
        return _FixedDict((name, _fixed(member)) for name, member in value.items())
    if isinstance(value, list):
        return _FixedList(_fixed(item) for item in value)
    return value


class Record(_FixedDict):
    """What C++ measured, as a dict of what its JSON says. A change is a TypeError; to_dict() is a copy to change."""

    def __init__(self, text: str) -> None:
        """`text`: the record as JSON, as C++ writes it."""
        super().__init__(_fixed(json.loads(text)))
        self._text = text

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text,)

    def to_json(self) -> str:
        """The record as C++ writes it, for a file; json.dumps() of it works, too, and says the same."""
        return self._text

    def to_dict(self) -> dict[str, Any]:
        """The record as dicts and lists that can be changed. Nothing leads back: what it says is no report any more."""
        record: dict[str, Any] = json.loads(self._text)
        return record
