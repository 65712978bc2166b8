"""The model of Eqs. 16-18: its words, and how a claim is seen to be of it and not of a sampler.

In the model a variance is a sum of radial integrals over finitely many regions of frequencies,

    V = Σ ∫ ρ^(s−1) P_S(ρ) P_f(ρ) dρ,    P_S of Eq. 18 as an equality, P_f of Eq. 16.

That the spectrum of a sampler is between two such profiles, and that of an integrand between two
such rows, is another matter: it is shown of jitter (Eqs. 18, 34, 36) and of multi-jitter (Eq. 25)
off their axes, and of an interval (Eq. 16), and of no ball in more dimensions.
"""

from ..theory.symbolic import Expr, sympy
from .entry import Entry
from .theorems.radial import rho
from .trusted.claims import Claim

IN_MODEL = "in the model of Eqs. 16-18"
NOTE = "In the model of Eqs. 16-18. "
PLATEAU = "gamma"


def of_model(e: Entry) -> bool:
    """Whether what an entry proves or denies integrates a profile with a plateau γ over ρ."""
    return any(c is not None and _integrates_a_profile(c) for c in (e.holds, e.printed))


def says_so(e: Entry) -> bool:
    """Whether an entry says in its title, or first in its notes, that it is of the model."""
    return IN_MODEL in e.title or e.notes.startswith(NOTE.strip())


def _integrates_a_profile(c: Claim) -> bool:
    return any(_is_radial(i) for side in (c.left, c.right) for i in side.atoms(sympy.Integral))


def _is_radial(integral: Expr) -> bool:
    names = (s.name for s in integral.free_symbols)
    return integral.limits[0][0] == rho and any(n.startswith(PLATEAU) for n in names)
