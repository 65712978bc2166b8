"""Tasks in processes of their own, as they end; an interrupt loses nothing that has begun."""

import multiprocessing
import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from typing import TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")


def results(
    run: Callable[[Task], Result], tasks: Iterable[Task], jobs: int
) -> Iterator[tuple[Task, Result]]:
    """Tasks with their results, as they end.

    Parameters
    ----------
    run : callable
        Of a module, so that another process finds it.
    tasks : iterable
    jobs : int
        Processes, at least 1.

    Raises
    ------
    KeyboardInterrupt
        After the tasks under way have ended; no others begin.
    """
    context = multiprocessing.get_context("spawn")  # a fork would share the threads of libraries
    with ProcessPoolExecutor(jobs, context, _leave_interrupts_to_the_parent) as pool:
        waiting, running, is_stopped = iter(tasks), dict[Future[Result], Task](), False
        while True:
            try:
                while not is_stopped and len(running) < 2 * jobs:
                    try:
                        task = next(waiting)
                    except StopIteration:
                        break
                    running[pool.submit(run, task)] = task
                if not running:
                    break
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    yield running.pop(future), future.result()
            except KeyboardInterrupt:
                is_stopped = True
                for future in [f for f in running if f.cancel()]:
                    del running[future]
        if is_stopped:
            raise KeyboardInterrupt


def _leave_interrupts_to_the_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
