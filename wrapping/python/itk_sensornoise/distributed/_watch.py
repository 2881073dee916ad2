# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Waiting for tasks of Dask, without waiting for ever."""

import logging
import time
from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any

from ._memory import WorkerState, stuck_sentence, worker_states

if TYPE_CHECKING:
    import distributed

_LOG = logging.getLogger(__name__)
_POLL_SECONDS = 0.05  # between two looks at futures, which ask nobody
_LOOK_SECONDS = 2.0  # between two questions to the scheduler, which hears from workers each second or less often
# Longest time without progress. A worker that Dask paused writes results to disk, and goes on soon if that helps.
_PATIENCE_SECONDS = 30.0
_GONE = "Dask's scheduler went away, was restarted or cancelled the tasks"


class Watch:
    """Looks whether tasks of a client may still end."""

    def __init__(self, client: "distributed.Client", advice: str) -> None:
        """`advice`: end of the error sentence that says what to do if the scheduler went away."""
        self._client = client
        self._gone = f"{_GONE}; {advice}"
        self._done = -1
        self._moved = self._looked = time.monotonic()
        self._is_reported = False

    def require_scheduler(self) -> None:
        """Raises RuntimeError if there is none."""
        if self._client.status != "running":
            raise self.gone()

    def workers(self) -> list[WorkerState]:
        """Returns the workers. Raises RuntimeError if there is no scheduler."""
        self.require_scheduler()
        try:
            return worker_states(self._client)
        except OSError as error:
            raise self.gone() from error

    def gone(self) -> RuntimeError:
        return RuntimeError(self._gone)

    def wait(self, futures: "Collection[distributed.Future]", done: int) -> None:
        """Waits a moment. `done`: number of futures that have ended; `futures`: the other futures. Raises RuntimeError
        if they will never end: the scheduler went away, or Dask paused all remaining workers."""
        self.require_scheduler()
        if any(future.cancelled() for future in futures):
            raise self.gone()
        now = time.monotonic()
        if done != self._done:
            self._done, self._moved = done, now
        if now - self._looked >= min(_LOOK_SECONDS, _PATIENCE_SECONDS):
            self._looked = now
            self._look(now)
        time.sleep(_POLL_SECONDS)

    def _look(self, now: float) -> None:
        try:
            workers = worker_states(self._client)
        except OSError:
            return  # the client notices when it is back, and reports it
        is_waiting = not workers or any(worker.is_paused for worker in workers)
        if not is_waiting or any(worker.is_busy for worker in workers):
            self._moved = now
        elif now - self._moved >= _PATIENCE_SECONDS:
            if workers:
                raise RuntimeError(stuck_sentence(workers, now - self._moved))
            if not self._is_reported:
                _LOG.warning("Dask has no worker; waiting for one")
                self._is_reported = True


def wait_for(
    futures: "Sequence[distributed.Future]", watch: Watch, report: Callable[[int], None] = lambda done: None
) -> None:
    """Waits until all futures are done, or one of them failed. `tell` is called with the number of those that are done,
    again and again. Raises as Watch.wait()."""
    pending = list(futures)
    while True:
        pending = [future for future in pending if not future.done()]
        report(len(futures) - len(pending))
        if not pending or any(future.status == "error" for future in futures):
            return
        watch.wait(pending, len(futures) - len(pending))


def results_of(
    client: "distributed.Client",
    futures: "Sequence[distributed.Future]",
    watch: Watch,
    report: Callable[[int], None] = lambda done: None,
) -> list[Any]:
    """Returns the results of all futures. Raises the first exception of a task at once, and the errors of
    Watch.wait()."""
    from distributed import CancelledError
    from distributed.comm import CommClosedError

    wait_for(futures, watch, report)
    watch.require_scheduler()
    try:
        results: list[Any] = client.gather(list(futures))
    except (CancelledError, CommClosedError) as error:
        raise watch.gone() from error
    return results
