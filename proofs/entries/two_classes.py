"""Beyond the paper: the unified rate of two classes of directions, in all nine cases."""

from functools import partial

from ..entry import Entry
from ..model import NOTE
from ..theorems import two_classes
from ..theorems.radial import Case

_CASES: tuple[Case, ...] = ("b>q", "b=q", "b<q")
_RATES = {"b>q": "N^−(1+eq)", "b=q": "N^−(1+eb) log N", "b<q": "N^−(1+eb)"}


def _order(first: Case, second: Case) -> Entry:
    return Entry(
        number=f"two classes, {first}, {second}",
        title=f"the slower class, {first}, decides: V = Θ({_RATES[first]}) of it",
        source="Section 6.1 with Eqs. 16-18, two classes",
        status="proved",
        holds=two_classes.order(first, second).claim,
        proof=partial(two_classes.order, first, second),
        notes=NOTE + "r_k = e_k min(b_k, q_k), r_1 < r_2: not the class with the smallest b_k. "
        "Equal exponents, r_1 = r_2, are left out: there both classes count, and so does a "
        "logarithm of either (6.1, classes).",
    )


ENTRIES = tuple(_order(first, second) for first in _CASES for second in _CASES)
