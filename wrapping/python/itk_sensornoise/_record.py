# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""A record of a measurement: a mapping that cannot be changed.

Beside its members a record has a JSON text and a table, which C++ made. They would not have a value that was changed,
so that it would be lost when the record is printed, drawn, written or pickled. Changing a value is therefore an error.
Copies are plain: to_dict(), dict() of it, and copy.copy() or copy.deepcopy() of a member.

It is a dict, as json.dumps() takes no other mapping. To type checkers, and to editors that complete names, it is a
Mapping: the methods of a dict that change it are not among its names.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:

    class _Dict(Mapping[str, Any]):
        """The type of a dict for type checkers."""

        def __init__(self, items: Iterable[tuple[str, Any]] | Mapping[str, Any] = ...) -> None: ...

        def __getitem__(self, name: str) -> Any: ...

        def __iter__(self) -> Iterator[str]: ...

        def __len__(self) -> int: ...

        def __or__(self, other: Mapping[str, Any]) -> dict[str, Any]: ...

else:
    _Dict = dict


def _refuse(self: Any, *_arguments: Any, **_others: Any) -> NoReturn:
    raise TypeError(
        "the record of a measurement cannot be changed; to_dict(), or copy.deepcopy() of a member, is a copy that can"
    )


class _FixedDict(_Dict):
    """A dict that cannot be changed. Its copies, also by pickling, are ordinary dicts."""

    if not TYPE_CHECKING:
        __setitem__ = __delitem__ = clear = pop = popitem = setdefault = update = __ior__ = _refuse

    def __dir__(self) -> Iterable[str]:
        return [name for name in super().__dir__() if getattr(type(self), name, None) is not _refuse]

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


class _FixedList(list[Any]):
    """A list that cannot be changed. Its copies, also by pickling, are ordinary lists."""

    __setitem__ = __delitem__ = append = clear = extend = insert = pop = remove = reverse = sort = _refuse
    __iadd__ = __imul__ = _refuse

    def __dir__(self) -> Iterable[str]:
        return [name for name in super().__dir__() if getattr(type(self), name, None) is not _refuse]

    def __reduce__(self) -> tuple[Any, ...]:
        return list, (list(self),)


def _fixed(value: Any) -> Any:
    if isinstance(value, dict):
        return _FixedDict((name, _fixed(member)) for name, member in value.items())
    if isinstance(value, list):
        return _FixedList(_fixed(item) for item in value)
    return value


class Record(_FixedDict):
    """A measurement of C++, as a mapping with the names of its JSON. A change raises TypeError; to_dict() returns a
    copy that can be changed."""

    def __init__(self, text: str) -> None:
        """`text`: the record as JSON, as C++ writes it."""
        super().__init__(_fixed(json.loads(text)))
        self._text = text

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text,)

    def to_json(self) -> str:
        """Returns the record as C++ writes it, for a file; json.dumps() of the record works, too, and says the same."""
        return self._text

    def to_dict(self) -> dict[str, Any]:
        """Returns the record as dicts and lists that can be changed. Nothing leads back: a dict is no report."""
        record: dict[str, Any] = json.loads(self._text)
        return record
