"""The figures of a check for a paper: LaTeX environments with their captions."""

import re
from collections.abc import Sequence

from .check_figures import CheckFigure
from .grids import escaped

NEEDS = "% needs \\usepackage{graphicx}"
"""First line of what is written."""

_FORMULAS = {
    r"γ min\(1, \(\|m\|/\(α N\^e\)\)\^b\)": r"\gamma\min(1, (|m|/(\alpha N^e))^b)",
    r"N·P_S": r"N P_S",
    r"N\|F\|²": r"N|F|^2",
    r"\|m\|": r"|m|",
    r"m = 0": r"m = 0",
    r"N → ∞": r"N \to \infty",
    r"10\^(-?\d+)": r"10^{\1}",
    r"(?<= )γ(?=[ ,.;])": r"\gamma",
    r"(?<= )b(?=[ ,.;])": r"b",
    r"(?<= )N(?=[ ,.;])": r"N",
    r"(?<= )m(?=[ ,.;])": r"m",
}
_ANY = re.compile("|".join(_FORMULAS))


def figure_environments(drawn: Sequence[CheckFigure]) -> str:
    """A ``figure`` for each figure that is drawn; its picture is looked for in the same folder."""
    parts = [NEEDS, *(_environment(f) for f in drawn if f.panels)]
    return "\n\n".join(parts) + "\n"


def _environment(figure: CheckFigure) -> str:
    size = r"width=\linewidth,height=0.8\textheight,keepaspectratio"
    return "\n".join(
        [
            r"\begin{figure}",
            r"\centering",
            rf"\includegraphics[{size}]{{{figure.stem}.png}}",
            rf"\caption{{{latex_prose(figure.caption)}}}",
            rf"\label{{fig:{figure.stem.replace('_', '-')}}}",
            r"\end{figure}",
        ]
    )


def latex_prose(text: str) -> str:
    """Text for LaTeX, the formulas of captions as mathematics."""
    found, last = "", 0
    for match in _ANY.finditer(text):
        found += escaped(text[last : match.start()]) + f"${_formula(match.group())}$"
        last = match.end()
    return found + escaped(text[last:])


def _formula(text: str) -> str:
    for pattern, latex in _FORMULAS.items():
        if match := re.fullmatch(pattern.replace("(?<= )", "").replace("(?=[ ,.;])", ""), text):
            return match.expand(latex.replace("\\", "\\\\").replace("\\\\1", "\\1"))
    return text
