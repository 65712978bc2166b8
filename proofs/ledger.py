"""The ledger: every entry in the order of the paper, and then what lies beyond it.

An entry is checked by ``entry.recheck``; ``AXIOMS`` lists the theorems that proofs may cite.
"""

from .entries import (
    appendix_a,
    appendix_b,
    beyond,
    kernels,
    lines,
    rules,
    section3,
    section4,
    section5,
    section6,
    section6_1,
    section6_2,
    section6_2_axes,
    two_classes,
)
from .entry import Entry, Verdict, recheck
from .trusted.claims import Axiom

ENTRIES: tuple[Entry, ...] = (
    *section3.ENTRIES,
    *section4.ENTRIES,
    *section5.ENTRIES,
    *section6_1.ENTRIES,
    *section6.ENTRIES,
    *section6_2_axes.ENTRIES,
    *section6_2.ENTRIES,
    *lines.ENTRIES,
    *appendix_a.ENTRIES,
    *appendix_b.ENTRIES,
    *beyond.ENTRIES,
    *two_classes.ENTRIES,
    *kernels.ENTRIES,
    *rules.ENTRIES,
    *lines.BEYOND,
)

AXIOMS: tuple[Axiom, ...] = ()
"""Theorems of the literature that proofs may cite."""


def rechecked(entries: tuple[Entry, ...] = ENTRIES) -> tuple[Verdict, ...]:
    """Verdicts on all entries, in their order.

    Raises
    ------
    Refused
        At the first entry whose proofs do not bear its status.
    """
    return tuple(recheck(e) for e in entries)
