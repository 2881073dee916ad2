# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Many bursts, of many cameras or of one from day to day, each measured by itself: a table of their reports."""

import contextlib
import inspect
import json
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._errors import InvalidTypeError
from .._estimate import estimate_sensor_noise
from .._names import is_name
from .._options import refuse, refuse_type
from .._types import FileName
from ._journal import Journal, settings_record
from ._sources import Source, Sources, named
from ._table import Entry, Row, as_table, require_parquet, rows_of, write_parquet
from ._task import Outcome, measure, measure_pickled, reason_of
from ._watch import Watch, wait_for

if TYPE_CHECKING:
    import distributed
    import pandas as pd

# Parameters that differ between sources, or need a person before a screen.
_NOT_OF_MANY = ("frames", "maps", "progress")
_KILLED = Outcome("every worker that measured it was killed: it may need more memory than they have", None)
_ADVICE = "the same call goes on with a new client"  # where the scheduler went away


def estimate_many(
    sources: Sources,
    client: "distributed.Client | None" = None,
    *,
    output: FileName | None = None,
    **settings: Any,
) -> "pd.DataFrame | list[Row]":
    """Measures many bursts, each by estimate_sensor_noise(), and returns one table.

    Parameters
    ----------
    sources
        A mapping of names to frames, or an iterable of pairs (name, frames), of file names, patterns and folders, or of
        lists of file names, which are their own names. Frames are what estimate_sensor_noise() takes, or a function
        without arguments that returns it, called where they are measured: lambda: h5py.File(name)["frames"]. With a
        client they are pickled and sent to a worker: names of files that it can read, lazy arrays, such functions;
        arrays in memory, too, but then all their pixels travel.
        A function of a script or a notebook imports itk inside of it: the module itk cannot be pickled.
    client
        A dask.distributed.Client: each source is a task of its workers, measured by one thread (unless `threads` says
        otherwise). If its worker is killed, another one tries, as often as Dask's setting
        distributed.scheduler.allowed-failures says; then, at the end, as often again with no other task at work: Dask
        counts a failure for all tasks that a killed worker had, also for waiting ones. A task takes the memory that its
        worker's memory_limit leaves, as `memory_limit` of estimate_sensor_noise() does; a burst that needs more is a
        row with its reason. An iterator is not read further ahead than the workers need.
        Default: one source after the other in this process, by all threads; Dask is not needed.
    output
        A file that ends in .jsonl: a line of JSON for each source as soon as it is measured, with `name`, `settings`,
        `reason` and `report`, the whole record. Or in .parquet: the table of all that was written to it, made at the
        end, also of an interrupted run, from such lines in a file beside it, name.parquet.jsonl: a Parquet file cannot
        be read before it is complete, so that it would not show the work of a killed process. If the file is there,
        the run goes on: sources that have a report in it are not measured again, those without one are. A name stands
        for the same frames: their files are not looked at. Default: the table is returned and nothing is written.
    settings
        The options of estimate_sensor_noise() for all sources, but for `maps` and `progress`.

    Returns
    -------
    pandas.DataFrame, or a list of dicts where pandas is not installed
        A row for each source, of a mosaic for each channel, in the order of `sources`: `name`; `channel` ("mono", or R,
        G1, G2, B); `status`, "measured" or "error"; `reason`, why there is no report; `method`; `frames`,
        `frames_distinct`, `width`, `height`; for each quantity of quantity_list() its value, standard error and status,
        with the unit in the name, as gain_DN_per_e, gain_error_DN_per_e, gain_status; `warnings`, their codes with
        spaces between. A value that is not identified is empty (NaN, None), and so are all values of an "error" that
        are not known.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value, and an output that was measured with other settings; says what was found and what was expected.
        An error of one source becomes the reason in its row.
    ImportError
        An output that ends in .parquet without PyArrow.
    RuntimeError
        The scheduler of `client` went away, or Dask paused its workers and nothing goes on for 30 s.
    KeyboardInterrupt
        Ctrl-C. After this and all other errors, what was measured is in `output`; the same call goes on.
    """
    require_settings(settings, _NOT_OF_MANY)
    require_client(client)
    lines, table = _files_of(output)
    defaults = {name: each.default for name, each in inspect.signature(estimate_sensor_noise).parameters.items()}
    record = {} if lines is None else settings_record(settings, defaults)
    listed = named(sources, needs_names=lines is not None)
    if not isinstance(sources, Iterator):
        listed = iter(list(listed))  # so that what is wrong with a name is said before anything is measured
    with contextlib.ExitStack() as opened:
        journal = None if lines is None else opened.enter_context(Journal(lines))
        if journal is not None and table is not None:
            opened.callback(lambda: write_parquet(journal.all_rows(), table))
        rows: dict[str, list[Row]] = {}
        todo = _not_measured(listed, journal, record, rows)
        for name, outcome in outcomes_of(client, todo, settings):
            report = None if outcome.report is None else json.loads(outcome.report)
            entry = Entry(name=name, settings=record, reason=outcome.reason, report=report)
            if journal is not None:
                journal.add(entry)
            rows[name] = rows_of(entry)
    return as_table([row for each in rows.values() for row in each])


def _not_measured(
    sources: Iterable[tuple[str, Source]], journal: Journal | None, settings: dict[str, Any], rows: dict[str, list[Row]]
) -> Iterator[tuple[str, Source]]:
    """Yields the sources without rows. Fills `rows` with all names in order, and with the rows of the other sources."""
    for name, frames in sources:
        found = None if journal is None else journal.rows(name, settings)
        rows[name] = found or []
        if found is None:
            yield name, frames


def outcomes_of(
    client: "distributed.Client | None", todo: Iterator[tuple[str, Source]], settings: dict[str, Any]
) -> Iterator[tuple[str, Outcome]]:
    """Measures sources, by the workers of a client or one after the other, and yields each result as it comes."""
    return _here(todo, settings) if client is None else _by_workers(client, todo, settings)


def _here(todo: Iterator[tuple[str, Source]], settings: dict[str, Any]) -> Iterator[tuple[str, Outcome]]:
    for name, frames in todo:
        yield name, measure(frames, settings)


def _by_workers(
    client: "distributed.Client", todo: Iterator[tuple[str, Source]], settings: dict[str, Any]
) -> Iterator[tuple[str, Outcome]]:
    """Yields the results of the workers as they come. Tasks whose worker was killed run once more at the end, each
    alone, because any of the tasks of a worker may have killed it."""
    suspects: list[tuple[str, Source]] = []
    for name, frames, outcome in _by_tasks(client, todo, settings):
        if outcome is _KILLED:
            suspects.append((name, frames))
        else:
            yield name, outcome
    for suspect in suspects:
        for name, _, outcome in _by_tasks(client, iter([suspect]), settings):
            yield name, outcome


def _by_tasks(
    client: "distributed.Client", todo: Iterator[tuple[str, Source]], settings: dict[str, Any]
) -> Iterator[tuple[str, Source, Outcome]]:
    """Yields the results of the workers as they come. No more tasks wait than keep every worker busy."""
    import cloudpickle
    import distributed

    completed = distributed.as_completed(loop=client.loop)
    watch = Watch(client, _ADVICE)
    done = 0
    tasks: dict[distributed.Future, tuple[str, Source]] = {}
    try:
        while True:
            taken = 0
            for name, frames in islice(todo, max(_tasks_wanted(client, watch) - len(tasks), 0)):
                taken += 1
                try:
                    pickled = cloudpickle.dumps(frames)
                except Exception as error:  # noqa: BLE001 - of whatever package the source is of
                    reason = f"it cannot be pickled and sent to a worker: {reason_of(error)}"
                    yield name, frames, Outcome(reason, None)
                    continue
                watch.require_scheduler()
                future = client.submit(measure_pickled, pickled, settings, pure=False)
                tasks[future] = name, frames
                completed.add(future)
            if tasks:
                while not completed.has_ready():  # next() would wait for ever where the scheduler goes away
                    watch.wait(tasks, done)
                future = next(completed)
                done += 1
                yield *tasks.pop(future), _outcome(future, watch)
            elif not taken:
                return
    finally:
        if client.status == "running":
            client.cancel(list(tasks))


def _tasks_wanted(client: "distributed.Client", watch: Watch) -> int:
    """Returns the number of tasks that keep all workers busy; 2 without a worker. Raises RuntimeError if there is no
    scheduler."""
    watch.require_scheduler()
    try:
        return 2 * max(sum(client.nthreads().values()), 1)
    except OSError as error:
        raise watch.gone() from error


def _outcome(future: "distributed.Future", watch: Watch) -> Outcome:
    """Returns the result of a task. Raises RuntimeError if the task has none."""
    import distributed

    wait_for([future], watch)  # its worker may have ended since
    try:
        outcome: Outcome = future.result()
    except distributed.KilledWorker:
        return _KILLED
    except distributed.CancelledError as error:
        raise watch.gone() from error
    except Exception as error:  # noqa: BLE001 - of Dask, or of a worker without this package
        return Outcome(f"the worker failed: {reason_of(error)}", None)
    return outcome


def require_settings(settings: dict[str, Any], not_of_many: tuple[str, ...]) -> None:
    """Raises TypeError for a keyword that is no setting of estimate_sensor_noise(), or one of `not_of_many`."""
    known = [name for name in inspect.signature(estimate_sensor_noise).parameters if name not in not_of_many]
    for name in settings:
        if name not in known:
            raise InvalidTypeError(f"{name} is no setting of many sources; expected some of {', '.join(known)}")


def require_client(client: Any) -> None:
    """Raises TypeError or ValueError unless it is None or a client that waits."""
    if client is None:
        return
    if not (hasattr(client, "submit") and hasattr(client, "nthreads")):
        raise InvalidTypeError(f"client is of type {type(client).__name__}; expected a dask.distributed.Client")
    if client.asynchronous:
        raise ValueError("client is asynchronous; expected a dask.distributed.Client that waits")


def _files_of(output: FileName | None) -> tuple[Path | None, Path | None]:
    """Returns the file of JSON lines and the file of the table; None: no such file."""
    if output is None:
        return None, None
    if is_name(output):
        name = Path(output)
        if name.suffix == ".jsonl":
            return name, None
        if name.suffix == ".parquet":
            require_parquet()
            return name.with_name(f"{name.name}.jsonl"), name
    expected = "the name of a file that ends in .jsonl or .parquet"
    raise (refuse if is_name(output) else refuse_type)("output", output, expected)
