"""Derivations, printed as numbered steps."""

import json
import re

from ..theory.derivations import Derivation, Step, derive, document
from ..theory.spelling import label_latex
from .grids import PREAMBLE, escaped

_WIDEST = 82  # characters of a formula, roughly, that fit on a line of LaTeX

_SYMBOLS = (
    "P_S, P_f: power spectra of the samples and of the integrand; rho = |m|: frequency",
    "s: dimension of the region; N_k: effective number of samples along it; nu = alpha N_k",
    "b, gamma: degree and plateau of N P_S; p: decay of P_f beyond rho_0; V: variance there",
)

_MATHEMATICS = {
    "[rho, 2 rho)": r"$[\rho,2\rho)$",
    "rho^(s-1)": r"$\rho^{s-1}$",
    "rho^(d-1)": r"$\rho^{d-1}$",
    "rho^-q": r"$\rho^{-q}$",
    "gamma/alpha^b": r"$\gamma/\alpha^b$",
    "rho_0 <= nu": r"$\rho_0\le\nu$",
    "b = q": "$b=q$",
    "p = s + 1": "$p=s+1$",
    "1 + e min(b, q)": r"$1+e\min(b,q)$",
    "N_k = N^e": "$N_k=N^e$",
    "N P_S": "$NP_S$",
    "N - 1": "$N-1$",
}
_FORMULA = re.compile(r"\b[\w_]+ = (?:sqrt\([^()]*\)|[\w^+*/.-]|\([^()]*(?:\([^()]*\))?[^()]*\))+")


def render(sampler: str, dim: str, integrand: str, region: str, primitive: str, form: str) -> str:
    """The derivation in one of the formats of the command line."""
    found = derive(sampler, dim, integrand, region, primitive)
    if form == "json":
        return json.dumps(document(found), indent=1)
    if form == "latex":
        return _latex(found)
    return _markdown(found) if form == "markdown" else _text(found)


def _title(found: Derivation) -> str:
    dim = "d dimensions" if found.dim == "d" else f"{found.dim}D"
    return f"{found.sampler} × {found.integrand} in {dim}, sampled by {found.primitive}s"


def _text(found: Derivation) -> str:
    lines, region = [_title(found), *(f"  {line}" for line in _SYMBOLS)], ""
    for number, s in enumerate(found.steps, 1):
        if s.region != region:
            lines += ["", s.region]
            region = s.region
        lines += [f"  {number:2d}. {s.expression}", f"      {s.equation}: {s.reason}"]
    return "\n".join(lines)


def _markdown(found: Derivation) -> str:
    lines, region = [f"## {_title(found)}"], ""
    for number, s in enumerate(found.steps, 1):
        if s.region != region:
            lines += ["", f"### {s.region}", ""]
            region = s.region
        lines.append(f"{number}. ({s.equation}) $${s.latex}$$ {s.reason}")
    return "\n".join(lines)


def _latex(found: Derivation) -> str:
    """An enumeration of displayed formulas, a heading before each region."""
    lines, region = [PREAMBLE, r"\begin{enumerate}"], ""
    for s in found.steps:
        if s.region != region:
            lines.append(rf"\item[] \textbf{{{label_latex(s.region)}}}")
            region = s.region
        lines += [rf"\item ({s.equation}) {_prose(s)}", r"\[", _display(s.latex), r"\]"]
    return "\n".join([*lines, r"\end{enumerate}"])


def _prose(step: Step) -> str:
    """The reason in LaTeX, the formulas in it as mathematics."""
    known = "|".join(map(re.escape, sorted(_MATHEMATICS, key=len, reverse=True)))
    pieces = re.split(f"({known})", step.reason)
    return "".join(_MATHEMATICS[p] if i % 2 else _counts(p) for i, p in enumerate(pieces))


def _counts(text: str) -> str:
    """Text whose formulas ``n = N^(1/d)`` are set as mathematics."""
    found, last = "", 0
    for match in _FORMULA.finditer(text):
        found += escaped(text[last : match.start()]) + f"${_set(match.group())}$"
        last = match.end()
    return found + escaped(text[last:])


def _set(formula: str) -> str:
    formula = re.sub(r"sqrt\(([^()]*)\)", r"\\sqrt{\1}", formula)
    formula = re.sub(r"\^\(((?:[^()]|\([^()]*\))*)\)", r"^{\1}", formula)
    return re.sub(r"_(\w+)", r"_{\1}", formula).replace("*", r"\,")


def _display(latex: str) -> str:
    """A formula, broken before top-level signs where it is too wide for a line."""
    left, equals, right = latex.partition(" = ")
    if not equals or _width(latex) <= _WIDEST:
        return latex
    lines, length = [""], _width(left)
    for term in _terms(right):
        if lines[-1] and length + _width(term) > _WIDEST:
            lines.append("")
            length = _width(left)
        lines[-1] += term
        length += _width(term)
    if len(lines) == 1:
        return latex
    body = r" \\ &{}".join(line.strip() for line in lines)
    return rf"\begin{{aligned}} {left} ={{}}& {body} \end{{aligned}}"


def _terms(latex: str) -> list[str]:
    """A sum split before the signs, and equalities, that stand in no group."""
    found, depth, start = list[str](), 0, 0
    tokens = re.finditer(r"\\left\b|\\right\b|\\begin|\\end|[{}]| [=+-] ", latex)
    for t in tokens:
        word = t.group()
        if word in ("{", r"\left", r"\begin"):
            depth += 1
        elif word in ("}", r"\right", r"\end"):
            depth -= 1
        elif word.startswith(" ") and depth == 0:
            found.append(latex[start : t.start()])
            start = t.start()
    return [*found, latex[start:]]


def _width(latex: str) -> int:
    """Rough number of characters set on the line: of a fraction only the wider half."""
    text = re.sub(r"\\(left|right|mathrm|mathcal|text|,|;)", "", latex)
    text = re.sub(r"\\[a-z]+(?=\W|$)(?<!frac)", "x", text)
    return len(_halved(text).replace("{", "").replace("}", "").replace("^", "").replace("_", ""))


def _halved(text: str) -> str:
    """The text with every fraction replaced by its wider half."""
    at = text.find(r"\frac{")
    if at < 0:
        return text
    over, end = _group(text, at + 5)
    under, end = _group(text, end)
    wider = max(_halved(over), _halved(under), key=len)
    return text[:at] + wider + _halved(text[end:])


def _group(text: str, at: int) -> tuple[str, int]:
    """What stands in the braces that open at a place, and where they have closed."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == "{") - (text[i] == "}")
        if depth == 0:
            return text[at + 1 : i], i + 1
    return text[at + 1 :], len(text)
