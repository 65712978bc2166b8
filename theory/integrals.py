"""Eq. 17 spelled out: its integrals between the breaks 0, rho_0, nu, oo, as text and LaTeX."""

from .radial import Radial
from .spelling import expression_latex, expression_text
from .symbolic import Expr


def integral_text(problem: Radial, best: bool) -> str:
    """``V = (gamma/N) [int_0^rho_0 (rho/nu)^2 c_f d rho + ...]``; ``best``: no power beyond."""
    return f"V = (gamma/N) [{' + '.join(_pieces(problem, best))}]"


def _pieces(problem: Radial, best: bool) -> list[str]:
    rho = "" if problem.dimension == 1 else f"{raised('rho', problem.dimension - 1)} "
    falling = f" {raised('rho', -problem.decay)}"
    if problem.degree == 0:
        whole = [f"int_0^rho_0 {rho}c_f d rho", f"int_rho_0^oo {rho}c_f{falling} d rho"]
        return whole[:1] if best else whole
    rising = raised("(rho/nu)", problem.degree)
    low = f"int_0^rho_0 {rho}{rising} c_f d rho"
    middle = f"int_rho_0^nu {rho}{rising} c_f{falling} d rho"
    return [low] if best else [low, middle, f"int_nu^oo {rho}c_f{falling} d rho"]


def integral_latex(problem: Radial, best: bool) -> str:
    """The same in LaTeX."""
    rho, falling = raised_latex(problem.dimension - 1), ""
    if not best:
        falling = raised_latex(-problem.decay)
    rising = ""
    if problem.degree != 0:
        rising = raised_latex(problem.degree, r"\left(\frac{\rho}{\nu}\right)")
    pieces = [_integral("0", r"\rho_0", rho, rising, "c_f")]
    if not best and problem.degree != 0:
        pieces.append(_integral(r"\rho_0", r"\nu", rho, rising, "c_f", falling))
    if not best:
        start = r"\rho_0" if problem.degree == 0 else r"\nu"
        pieces.append(_integral(start, r"\infty", rho, "c_f", falling))
    whole = " + ".join(pieces)
    return r"V = \frac{\gamma}{N}" + (whole if best else rf"\left[{whole}\right]")


def _integral(lower: str, upper: str, *factors: str) -> str:
    return rf"\int_{{{lower}}}^{{{upper}}}" + r"\,".join([*filter(None, factors), r"d\rho"])


def raised(base: str, power: Expr) -> str:
    """``base^power``, brackets where they are needed."""
    if power == 1:
        return base
    if power.is_Integer or (power.is_Symbol and power.is_positive):
        return f"{base}^{power}"
    return f"{base}^({expression_text(power)})"


def raised_latex(power: Expr, base: str = r"\rho") -> str:
    """The same in LaTeX; nothing for the power 0."""
    if power == 0:
        return ""
    return base if power == 1 else rf"{base}^{{{expression_latex(power)}}}"
