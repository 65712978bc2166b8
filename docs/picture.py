"""The picture of the README: python docs/picture.py (needs matplotlib).

Left, the spectrum of 2D n-rooks along two regions; right, what it does to an integrand.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from specrate.numerics.exact_variances.crossovers import crossovers, region_constants
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.generators import generate
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.measuring.moments import (
    Moments,
    estimates,
    shifted,
    update,
    variance_interval,
)
from specrate.numerics.measuring.probes import amplitudes
from specrate.numerics.streams import stream
from specrate.theory.rates import profile_of
from specrate.theory.regions import select
from specrate.theory.samplers import parse_sampler

BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#555555"  # Okabe and Ito
REALISATIONS = 2000
N = 256


def spectrum(axes, sampler) -> None:
    """Exact, derived and measured N·P_S on the axis and on the diagonal."""
    counts = sampler.counts_at(N)
    points = generate(sampler, counts, REALISATIONS, stream(1, N))
    for region, direction, colour, name in (
        ("axis", (1, 0), BLUE, "axis"),
        ("generic", (1, 1), ORANGE, "diagonal"),
    ):
        m = np.arange(1, 3 * N)[:, None] * np.array(direction)
        rho = np.hypot(*m.T)
        axes.loglog(
            rho, N * power_array(sampler, counts, m), color=colour, lw=1.2, label=f"{name}, exact"
        )
        (monomial,) = profile_of(sampler, select(sampler.layout, region)[0])
        b, e, c = (float(v) for v in (monomial.degree, monomial.effective, monomial.coefficient))
        profile = np.minimum(1.0, c * (rho / N**e) ** b)
        axes.loglog(
            rho, profile, "--", color=colour, lw=1.2, label=f"{name}, derived profile: b = {b:g}"
        )
        chosen = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512]
        wanted = [(k * direction[0], k * direction[1]) for k in chosen]
        for k, amplitude in zip(wanted, amplitudes(points, wanted), strict=True):
            found = variance_interval(update(Moments(), np.abs(amplitude)), 0.05)
            bar(axes, float(np.hypot(*k)), N * np.array(found), colour)
    axes.set(
        xlabel="frequency |m|", ylabel="$N\\,P_S(m)$", title=f"2D n-rooks, N = {N}", ylim=(1e-5, 4)
    )
    axes.legend(frameon=False, fontsize=8, loc="lower right")


def variance(axes, sampler, integrand) -> None:
    """Exact, predicted and measured variance of an anisotropic Gaussian."""
    counts = np.unique(np.geomspace(4, 2**14, 60).astype(int))
    exact = [float(exact_variance(sampler, {"N": int(n)}, integrand).value) for n in counts]
    axes.loglog(counts, exact, color=GREEN, lw=1.4, label="exact")
    for found, style in zip(region_constants(sampler, integrand), ("--", ":"), strict=True):
        power = float(found.order.exponent)
        axes.loglog(
            counts,
            float(found.constant) * counts**-power,
            style,
            color=GREY,
            lw=1.2,
            label=f"{found.region}: ${scientific(float(found.constant))}\\,N^{{-{power:g}}}$",
        )
    for n in (4, 16, 64, 256, 1024, 4096):
        rng = stream(2, n)
        points = generate(sampler, {"N": n}, REALISATIONS, rng)
        errors = estimates(integrand, shifted(points, rng.random((REALISATIONS, 2)))) - float(
            integrand.mean(17)
        )
        bar(axes, n, np.array(variance_interval(update(Moments(), errors), 0.05)), GREEN)
    (meeting,) = crossovers(sampler, integrand)
    axes.axvline(float(meeting.count), color=GREY, lw=0.8)
    axes.text(
        float(meeting.count) * 1.1,
        exact[0],
        f"$N^*$ = {float(meeting.count):.0f}",
        color=GREY,
        fontsize=9,
        va="top",
    )
    axes.set(
        xlabel="samples N",
        ylabel="variance",
        title="on an anisotropic Gaussian",
        ylim=(exact[-1] / 4, exact[0] * 2),
    )
    axes.legend(frameon=False, fontsize=8, loc="lower left")


def scientific(value: float) -> str:
    """Two digits for mathematics: 1.9 x 10^-5."""
    digits, _, power = f"{value:.1e}".partition("e")
    return digits if int(power) == 0 else rf"{digits}\times10^{{{int(power)}}}"


def bar(axes, x, interval, colour) -> None:
    """A measured point with its 95 % interval."""
    middle, low, high = interval
    axes.errorbar(
        x, middle, [[middle - low], [high - middle]], fmt="o", ms=3.5, color=colour, capsize=2, lw=1
    )


def main() -> None:
    """Draw both panels and save them beside this file."""
    sampler = parse_sampler("n-rooks", 2)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.7), layout="constrained")
    spectrum(left, sampler)
    variance(right, sampler, parse_integrand("anisotropic-gaussian:sigma=(0.1,0.5)", 2))
    for axes in (left, right):
        axes.spines[["top", "right"]].set_visible(False)
        axes.title.set_fontsize(10)
    figure.suptitle(
        f"dots: measured, {REALISATIONS} realisations, 95 % intervals",
        fontsize=8,
        color=GREY,
        y=-0.02,
    )
    figure.savefig(Path(__file__).with_name("picture.png"), dpi=150, bbox_inches="tight")


if __name__ == "__main__":
    main()
