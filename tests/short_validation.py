"""Short form of the long validation of `check`: 256 realisations of 64 points of each design.

Realisations are drawn in this process and checked as point files. Programs, exponents and many
dimensions are left to the long form.
"""

import numpy as np
from specrate.numerics.checking.check_documents import check
from specrate.numerics.point_sources.catalogue_source import chunk_size, open_source
from specrate.numerics.point_sources.sources import load_source
from specrate.theory.samplers import family_of

REALISATIONS = 256


def files(truth, folder, seed):
    """Point files of the design."""
    source = truth.source
    if not isinstance(source, str):
        return truth.words(folder, seed)
    is_own = family_of(source) is not None
    opened = open_source([source], truth.dim) if is_own else load_source([source], truth.dim)
    words = []
    for n in truth.counts or (64,):
        count = opened.admissible(n)
        path = folder / f"{count}.npy"
        step = chunk_size(count)
        parts = [
            opened.realise(count, seed, range(r, r + step)) for r in range(0, REALISATIONS, step)
        ]
        np.save(path, np.concatenate(parts))
        words.append(str(path))
    return words


def short_form(truth, folder, seed=0):
    return check(files(truth, folder, seed), truth.dim, truth.claims, budget=60, seed=seed)


def is_short(truth):
    """Not a program, which must be started for each realisation, no exponent, few dimensions."""
    is_program = isinstance(truth.source, str) and truth.source.startswith("cmd:")
    return not is_program and truth.dim <= 4 and not any("~" in claim for claim in truth.claims)
