"""Biases: E exp(−2πi m·x) ≠ 0 for some whole m ≠ 0, tested on R realisations by betting.

Two kinds of fault:

- ``bias``: on an axis, so that its marginal is not uniform;
- ``not homogenised``: at any of the frequencies whose amplitudes are given. A uniform random shift
  of each realisation makes all of them vanish and leaves every |F_S(m)| as it is.

References
----------
I. Waudby-Smith, A. Ramdas, Estimating means of bounded random variables by betting, JRSS B 86
(2024): the capital of a bettor is the test. It needs no more than |Z| <= 1.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..measuring.moments import Moments
from ..point_sources.fault_kinds import Fault

# Stakes 0.98, 0.49, ..., 0.0153 on either sign: below 1, so that no single loss ruins a bettor.
_BETS = tuple(sign * 0.98 / 2**halvings for halvings in range(7) for sign in (1, -1))
_CHUNK_VALUES = 1 << 17
_MOST_FACTORS = 8  # of the first wave, of which higher ones are products
_MANY, _SURE, _ROUNDING = 1024, 7.0, 1e-12  # realisations, standard errors, error of an estimate
_SHOWN = 8  # coefficients that the evidence holds, the worst first

Reals = NDArray[np.float64]
Amplitudes = Mapping[tuple[int, ...], NDArray[np.complex128]]


def biases(
    points: Reals, places: Sequence[int], level: float, amplitudes: Amplitudes
) -> list[Fault]:
    """One fault if a marginal is not uniform, and one if an amplitude has another mean than 0.

    Parameters
    ----------
    points : ndarray of float64, shape (R, N, d)
        Independent realisations.
    places : sequence of int
        Frequencies along an axis that are tested besides 1, 2 and 3: those of fixed places.
    level : float
        False-alarm probability of all tests of this call together.
    amplitudes : mapping of frequency to complex array of shape (R,)
        F_S(m) of the same realisations.
    """
    count, _, dim = points.shape
    if count < 2:
        return []
    frequencies = sorted(k for k in {1, 2, 3, *places} if k > 0)
    threshold = math.log(2 * (len(frequencies) * dim + len(amplitudes)) / level)
    found = [
        _bias(frequencies, set(places), axis_means(points, frequencies), threshold),
        _inhomogeneity(amplitudes, threshold),
    ]
    shared = {"realisations": count, "level": level}
    return [Fault(f.kind, f.detail, f.evidence | shared) for f in found if f is not None]


def frozen(count: int) -> Fault:
    """The fault of realisations that are all the same point set: no mean over them is 0."""
    detail = (
        f"realisations must be homogenised by random shifts: got one point set in all {count}; its "
        "|F_S(m)|^2 is that of one realisation, and variances are judged on its shifted points"
    )
    return Fault("not homogenised", detail, {"realisations": count, "distinct": 1})


def _bias(
    frequencies: Sequence[int], places: set[int], means: NDArray[np.complex128], threshold: float
) -> Fault | None:
    """The fault of marginals; means of shape (R, number of frequencies, d)."""
    capital = np.maximum(log_capital(means.real), log_capital(means.imag))
    failing = _beyond(capital, threshold)
    if not failing:
        return None
    coefficients = means.mean(axis=0)
    worst, axis = failing[0]
    k, z = frequencies[worst], complex(coefficients[worst, axis])
    what = "the density along the axis is not uniform"
    if k in places:
        what = f"points {'sit at' if abs(z) > 0.9 else 'prefer'} fixed places of {k} cells"
    axes = sorted({axis + 1 for _, axis in failing})
    others = f", on {len(axes)} axes in all" if len(axes) > 1 else ""
    rule = f"marginals must be uniform, E exp(-2 pi i {k} x) = 0"
    shown = [
        {"axis": axis + 1, **_listed(frequencies[i], complex(coefficients[i, axis]))}
        for i, axis in failing[:_SHOWN]
    ]
    return Fault(
        "bias",
        f"{rule}: got {_text(z)} on axis {axis + 1}; {what}{others}",
        {"axes": axes, "coefficients": shown},
    )


def _beyond(capital: Reals, threshold: float) -> list[tuple[int, ...]]:
    """Indices of the tests that fail, the worst first."""
    failing = [tuple(map(int, index)) for index in np.argwhere(capital > threshold)]
    return sorted(failing, key=lambda index: -capital[index])


def measured_bias(n: int, raw: Mapping[str, Moments]) -> Fault | None:
    """The fault of a mean error on raw points that is 7 standard errors from 0, or more.

    Where the search on the first realisations has too few for a small bias. By the normal law the
    probability is 3e-12 an integrand; from 1024 realisations on, which are asked for.

    Parameters
    ----------
    n : int
    raw : mapping of name to Moments
        Of the errors of integrands that are bounded and have their power spread out.
    """
    found: list[tuple[float, str]] = []
    for name, moments in raw.items():
        telling = moments.count >= _MANY and moments.bias_error > 0
        if telling and abs(moments.bias) > max(_SURE * moments.bias_error, _ROUNDING):
            found.append((abs(moments.bias) / moments.bias_error, name))
    if not found:
        return None
    errors, name = max(found)
    detail = (
        f"the mean of raw estimates must be I: got {raw[name].bias:.3g} beside it for {name}, "
        f"{errors:.1f} standard errors of {raw[name].count} realisations"
    )
    evidence = {"integrand": name, "bias": raw[name].bias, "standard_errors": errors}
    return Fault("bias", detail, {**evidence, "n": n})


def _inhomogeneity(amplitudes: Amplitudes, threshold: float) -> Fault | None:
    """The fault of means of F_S(m) that are not 0, and what it leaves of a verdict."""
    if not amplitudes:
        return None
    wanted = list(amplitudes)
    values = np.stack([amplitudes[m] for m in wanted], axis=1)
    capital = np.maximum(log_capital(values.real), log_capital(values.imag))
    failing = [i for (i,) in _beyond(capital, threshold)]
    if not failing:
        return None
    means = values.mean(axis=0)
    m, z = wanted[failing[0]], complex(means[failing[0]])
    detail = (
        f"E exp(-2 pi i m.x) must be 0 for all m != 0: got {_text(z)} at m = {_frequency(m)}, and "
        f"not 0 at {len(failing)} of {len(wanted)} frequencies; measured spectra hold, since a "
        "shift leaves them as they are, and variances are judged on shifted points"
    )
    shown = [_listed(list(wanted[i]), complex(means[i])) for i in failing[:_SHOWN]]
    evidence = {"failing": len(failing), "tested": len(wanted), "coefficients": shown}
    return Fault("not homogenised", detail, evidence)


def _text(z: complex) -> str:
    return f"{z.real:.3f}" + (f"{z.imag:+.3f}i" if abs(z.imag) >= 5e-4 else "")


def _frequency(m: tuple[int, ...]) -> str:
    """The frequency; in many dimensions its nonzero coordinates alone."""
    if len(m) <= 4:
        return "(" + ", ".join(map(str, m)) + ")"
    return "(" + ", ".join(f"m_{i} = {k}" for i, k in enumerate(m, 1) if k) + ")"


def _listed(frequency: int | list[int], z: complex) -> dict[str, object]:
    return {"frequency": frequency, "real": z.real, "imaginary": z.imag}


def axis_means(points: Reals, frequencies: Sequence[int]) -> NDArray[np.complex128]:
    """Means of exp(−2πi k x) over the N points, shape (R, number of frequencies, d).

    Parameters
    ----------
    frequencies : sequence of int
        Positive, in increasing order.
    """
    count, n, dim = points.shape
    means = np.empty((count, len(frequencies), dim), np.complex128)
    step = max(1, _CHUNK_VALUES // (n * dim))
    for start in range(0, count, step):
        part = slice(start, start + step)
        x = np.ascontiguousarray(points[part].transpose(0, 2, 1))
        first, power, exponent = _wave(x, 1), np.ones(x.shape, np.complex128), 0
        for index, k in enumerate(frequencies):
            if k > _MOST_FACTORS:
                means[part, index] = _wave(x, k).mean(axis=2)
                continue
            for _ in range(k - exponent):
                power *= first
            exponent = k
            means[part, index] = power.mean(axis=2)
    return means


def _wave(x: Reals, k: int) -> NDArray[np.complex128]:
    """exp(−2πi k x)."""
    turns = k * x
    turns -= np.rint(turns)  # keeps the angle small and its sine exact
    turns *= -2 * np.pi
    wave = np.empty(x.shape, np.complex128)
    np.cos(turns, out=wave.real)
    np.sin(turns, out=wave.imag)
    return wave


def log_capital(z: Reals) -> Reals:
    """Log of the mean capital of the bettors on E Z ≠ 0, along the first axis.

    A bettor of stake s ends with the product of 1 + s Z_r >= 0. If the Z_r in [-1, 1] are
    independent and of mean 0, its expectation is 1; so is that of the mean over stakes, and by
    Markov it exceeds 1/a with probability at most a.
    """
    bounded = np.clip(z, -1.0, 1.0)  # rounding may leave |z| = 1 + 1e-16
    logs = np.stack([np.log1p(bet * bounded).sum(axis=0) for bet in _BETS])
    return np.logaddexp.reduce(logs, axis=0) - math.log(len(_BETS))
