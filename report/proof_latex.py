"""The paper, checked: a LaTeX document of the ledger, every entry with its statements and proof.

A formula is set inline in display style, so that TeX breaks it at its relations and signs. Needs
no more than amsmath, amssymb, geometry, xcolor, longtable, booktabs and hyperref.
"""

import re
from collections.abc import Sequence
from itertools import groupby

from ..proofs.rechecks import Recheck, Rechecks, identifier
from ..proofs.trusted.claims import Claim
from .claim_words import Prose
from .formula_prints import latex
from .formula_prose import latex_text
from .formulas import Formula
from .proof_formats import STATUSES, cited, heading, part_of_paper, word
from .proof_reading import Passage, Reading, proof_parts, read, runs, without_repeats

_HEAD = r"""\documentclass[10pt,a4paper]{article}
\usepackage[utf8]{inputenc}
\usepackage[margin=2.1cm]{geometry}
\usepackage{amsmath,amssymb,booktabs,longtable,array,xcolor}
\usepackage[hidelinks]{hyperref}
\definecolor{muted}{HTML}{59636E}
\definecolor{good}{HTML}{00694E}
\definecolor{bad}{HTML}{A83A00}
\setlength{\parindent}{0pt}
\setlength{\parskip}{0.25em}
\setlength{\emergencystretch}{4em}
\setlength{\jot}{4pt}
\tolerance=4000
\hbadness=10000
\relpenalty=50
\binoppenalty=100
\raggedbottom
\newcommand{\status}[2]{\textcolor{#1}{\normalfont\small\textsc{#2}}}
\newcommand{\fact}[2]{\par{\raggedright\hangindent=6.2em\hangafter=1
  \makebox[6.2em][l]{\textcolor{muted}{#1}}#2\par}}
\newcommand{\given}[1]{\par\smallskip{\raggedright\textit{#1}\par}\nobreak}
\newcommand{\step}[4]{\par{\raggedright\hangindent=2.6em\hangafter=1
  \makebox[2.6em][l]{\hypertarget{#1}{\textcolor{muted}{\small #2}}}#3%
  \hskip 1.4em\textcolor{muted}{\small #4}\par}}
\newcommand{\folded}[1]{\par{\raggedright\hangindent=2.6em\hangafter=0
  \textcolor{muted}{\footnotesize #1}\par}}
\title{The paper, checked}
\author{\texttt{specrate prove}}
\date{}
\begin{document}
\maketitle
"""

_ABOUT = r"""This goes through the numbered equations and the claims of the text of G.~Singh and
W.~Jarosz, \emph{Monte Carlo Convergence Analysis for Anisotropic Sampling Power Spectra} (Dartmouth
TR2016-816); quotations may be shortened. The line \emph{Holds} is what is proved, in steps that a
small program accepts only if the reason given is one of a closed list of rules and can be carried
out. Of an estimator it is proved for the sum or integral that the line writes down: that this is
a sampler's spectrum is shown by the entries named \emph{kernel} only, and a rate with a profile
$\gamma/N$ in it is one in the model of Eqs.~16-18, which its entry says. What is argued besides,
and how a quotation is read, stands in the notes.

A step is told under the hypotheses of its statement; where it needs others they are named before
it; what an earlier entry has shown is not shown again, and its numbers are left out. Steps in
small print only read something off. Numbers in brackets are steps of the same proof;
$(3) - (2)$ is the difference of two equations, or of what lies between their sides.
"""


def paper_checked(found: Rechecks) -> str:
    """The document, complete."""
    parts = [_HEAD, _ABOUT, _counts(found), _overview(found)]
    shown: dict[Claim, str] = {}
    for name, group in groupby(found.found, key=part_of_paper):
        parts.append(rf"\section*{{{latex_text(name)}}}")
        parts += [_entry(r, shown) for r in group]
    return "\n\n".join([*parts, r"\end{document}"])


def _counts(found: Rechecks) -> str:
    accepted = [r for r in found.found if r.is_accepted]
    counts = {s: sum(r.entry.status == s for r in accepted) for s in STATUSES}
    steps = sum(r.steps for r in accepted)
    lines = [
        f"{len(found.found)} entries, {steps} steps: "
        + ", ".join(f"{n} {s}" for s, n in counts.items() if n)
        + "."
    ]
    if len(accepted) < len(found.found):
        lines.append(rf"\textcolor{{bad}}{{{len(found.found) - len(accepted)} refused.}}")
    if found.is_interrupted:
        lines.append(r"\textcolor{bad}{Interrupted: the other entries were not checked.}")
    lines += [
        rf"\emph{{Admitted}} in {latex_text(heading(r))}: {latex_text(a)}."
        for r in accepted
        for a in sorted(r.admitted)
    ]
    lines += [
        rf"\emph{{Cited}}: {latex_text(axiom.name)} ({latex_text(axiom.source)}), "
        rf"in {latex_text(', '.join(numbers))}."
        for axiom, numbers in cited(found)
    ]
    if not any(r.axioms for r in accepted):
        lines.append("No theorem is cited without proof.")
    return "\n\n".join(lines)


def _overview(found: Rechecks) -> str:
    """A table of all entries over as many pages as it needs."""
    rows = [
        rf"\hyperlink{{{_anchor(r)}}}{{{latex_text(heading(r))}}} & {_status(r)} & "
        rf"{latex_text(r.entry.title)} \\"
        for r in found.found
    ]
    widths = r">{\raggedright\arraybackslash}p{3.1cm}l>{\raggedright\arraybackslash}p{10.2cm}"
    return "\n".join(
        [
            rf"{{\small\begin{{longtable}}{{@{{}}{widths}@{{}}}}",
            r"\toprule Entry & Status & Statement \\ \midrule \endhead \bottomrule \endfoot",
            *rows,
            r"\end{longtable}}",
        ]
    )


def _status(r: Recheck) -> str:
    colour = "good" if r.is_accepted and r.entry.status in ("proved", "definition") else "bad"
    return rf"\status{{{colour}}}{{{word(r).lower()}}}"


def _anchor(r: Recheck, number: int = 0) -> str:
    name = re.sub(r"[^\w.-]", "-", identifier(r.entry)).replace("_", "-")
    return f"{name}.{number}"


def _entry(r: Recheck, shown: dict[Claim, str]) -> str:
    plural = "" if r.steps == 1 else "s"
    title = rf"{latex_text(heading(r))}\quad {latex_text(r.entry.title)}\quad {_status(r)}"
    lines = [
        rf"\subsection*{{\raggedright\hypertarget{{{_anchor(r)}}}{{}}{title}}}",
        rf"\textcolor{{muted}}{{\small {latex_text(r.entry.source)}, {r.steps} step{plural}}}",
    ]
    if not r.is_accepted:
        return "\n".join([*lines, rf"\fact{{Refused}}{{{latex_text(r.refusal or '')}}}"])
    reading = without_repeats(read(r.entry), heading(r), shown)
    lines += [rf"\fact{{{name}}}{{{said}}}" for name, said in _facts(r, reading) if said]
    if reading.short_names:
        told = ", ".join(map(_formula, reading.short_names))
        lines.append(rf"\fact{{In the proof}}{{{told}}}")
    for name, chosen in proof_parts(reading):
        lines += [rf"\medskip\textbf{{{name}.}}", *_proof(r, chosen)]
    return "\n".join(lines)


def _facts(r: Recheck, reading: Reading) -> list[tuple[str, str]]:
    return [
        ("As printed", latex_text(r.entry.as_printed)),
        ("that is" if r.entry.as_printed else "As printed", _set(reading.printed)),
        ("Holds", _set(reading.holds)),
        ("Given", _set(reading.given or reading.printed_given)),
        ("Where", ", ".join(map(_formula, reading.names))),
        ("Fails", _set(reading.witness)),
        ("Note", latex_text(r.entry.notes)),
    ]


def _proof(r: Recheck, passages: Sequence[Passage]) -> list[str]:
    lines: list[str] = []
    for under, is_trivial, steps in runs(passages):
        if under is not None:
            told = _set(under, display=False) if under else "the hypotheses of the statement"
            lines.append(rf"\given{{Given {told}:}}")
        if is_trivial:
            lines.append(rf"\folded{{{'; '.join(_small(r, p) for p in steps)}.}}")
        else:
            lines += [
                rf"\step{{{_anchor(r, p.number)}}}{{({p.number})}}"
                rf"{{{_set(p.claim)}}}{{{_reason(r, p)}}}"
                for p in steps
            ]
    return lines


def _small(r: Recheck, p: Passage) -> str:
    target = rf"\hypertarget{{{_anchor(r, p.number)}}}{{({p.number})}}"
    return rf"{target} {_set(p.claim, display=False)}, {_reason(r, p)}"


def _reason(r: Recheck, p: Passage) -> str:
    """The reason, its numbers as links."""

    def linked(match: re.Match[str]) -> str:
        number = int(match.group(1))
        return rf"\hyperlink{{{_anchor(r, number)}}}{{({number})}}"

    return "".join(
        re.sub(r"\((\d+)\)", linked, latex_text(part))
        if isinstance(part, str)
        else f"${latex(part)}$"
        for part in p.reason
    )


def _formula(f: Formula, display: bool = True) -> str:
    style = r"\displaystyle " if display else ""
    return f"${style}{latex(f)}$"


def _set(prose: Prose, display: bool = True) -> str:
    return "".join(latex_text(p) if isinstance(p, str) else _formula(p, display) for p in prose)
