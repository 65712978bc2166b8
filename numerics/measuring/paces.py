"""Paces: what one realisation costs at each N, and how many fit into the time that is left.

Realisations are drawn and measured in chunks, and nothing ends a chunk before it is over. A chunk
is therefore begun only if, at the cost per realisation of the last one, it ends in time; the cost
at an N that has not been measured is foretold from smaller N by c(N) = c(n) (N/n)^p, with p that of
the two largest of them.
"""

from collections.abc import Sequence
from math import log

TRIED = 2
"""Realisations in the first chunk at an N, when their cost is not known; two have a variance."""

SLICE = 0.25
"""Of the budget, the most that one chunk may take."""

_HIGHEST_POWER = 3.5  # p; the costliest samplers here need N³ operations


def chunk_length(size: int, cost: float | None, left: float, budget: float) -> int:
    """Realisations of the next chunk: a power of two up to ``size``; 0 if not one ends in time.

    Parameters
    ----------
    size : int
        Of a chunk for which there is time.
    cost : float or None
        Seconds per realisation; None: not known, so that few are tried.
    left, budget : float
        Seconds.
    """
    if cost is None:
        return min(TRIED, size)
    if cost > left:
        return 0
    if cost * size <= min(SLICE * budget, left):
        return size
    fitting = int(min(max(SLICE * budget, cost), left) / cost)
    return min(size, 1 << max(fitting.bit_length() - 1, 0))


def foretold_cost(known: Sequence[tuple[int, float]], n: int, power: float = 0.0) -> float | None:
    """Seconds per realisation of n points, from those at smaller N; None if there are none.

    Parameters
    ----------
    known : sequence of (N, seconds)
        By increasing N.
    power : float
        p where a single N is known, and the least p.
    """
    if not known:
        return None
    last, cost = known[-1]
    if len(known) > 1:
        first, before = known[-2]
        rise = log(cost / before) / log(last / first) if min(cost, before) > 0 else 0.0
        power = min(max(rise, power), _HIGHEST_POWER)
    return cost * (n / last) ** power


def within(costs: Sequence[float], budget: float) -> int:
    """How many of the costs, from the first on, have a sum within the budget; at least 1."""
    total, count = 0.0, 0
    for cost in costs:
        total += cost
        if total > budget:
            break
        count += 1
    return max(count, 1)
