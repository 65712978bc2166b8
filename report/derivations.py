"""Derivations, printed as numbered steps."""

import json

from ..theory.derivations import Derivation, derive, document, latex_label


def render(sampler: str, dim: str, integrand: str, region: str, primitive: str, form: str) -> str:
    """The derivation in one of the formats of the command line."""
    found = derive(sampler, dim, integrand, region, primitive)
    if form == "json":
        return json.dumps(document(found), indent=1)
    if form == "latex":
        return _latex(found)
    return _markdown(found) if form == "markdown" else _text(found)


def _title(found: Derivation) -> str:
    return f"{found.sampler} × {found.integrand}, d = {found.dim}, sampled by {found.primitive}s"


def _text(found: Derivation) -> str:
    lines, region = [_title(found)], ""
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
    """An enumeration of displayed formulas; needs amsmath."""
    lines, region = [r"\begin{enumerate}"], ""
    for s in found.steps:
        if s.region != region:
            lines.append(rf"\item[] \textbf{{{latex_label(s.region)}}}")
            region = s.region
        lines += [rf"\item ({s.equation}) {_prose(s.reason)}", r"\[", s.latex, r"\]"]
    return "\n".join([*lines, r"\end{enumerate}"])


def _prose(reason: str) -> str:
    from .grids import escaped

    return escaped(reason)
