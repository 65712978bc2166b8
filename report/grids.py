"""Plain tables of text: aligned for the terminal, as Markdown, CSV or booktabs LaTeX."""

import csv
import io
from collections.abc import Sequence


def aligned(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns padded to one width, a rule below the head; an empty last column is dropped."""
    if rows and not any(r[-1] for r in rows):
        head, rows = head[:-1], [r[:-1] for r in rows]
    widths = [max(len(r[i]) for r in (head, *rows)) for i in range(len(head))]

    def line(cells: Sequence[str]) -> str:
        return "  ".join(c.ljust(w) for c, w in zip(cells, widths, strict=True)).rstrip()

    return "\n".join([line(head), "  ".join("-" * w for w in widths), *map(line, rows)])


def without_repeats(rows: Sequence[Sequence[str]], leading: int) -> list[list[str]]:
    """The first columns once per group of rows: the eye finds the groups by the gaps."""
    found: list[list[str]] = []
    before: Sequence[str] = ()
    for row in rows:
        same = list(row[:leading]) == list(before)
        before = row[:leading]
        found.append([*([""] * leading if same else row[:leading]), *row[leading:]])
    return found


def markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table; vertical bars in cells are escaped."""

    def line(cells: Sequence[str]) -> str:
        return "| " + " | ".join(c.replace("|", r"\|") for c in cells) + " |"

    return "\n".join([line(head), "|" + " --- |" * len(head), *map(line, rows)])


def csv_cell(value: object) -> str:
    """A value of a document as a CSV cell: true, false and nothing as in JSON."""
    return "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


def comma_separated(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """CSV with a head."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerows([head, *rows])
    return out.getvalue().rstrip("\n")


PREAMBLE = "% needs \\usepackage{amsmath} and \\usepackage{booktabs}"
"""First line of every LaTeX output."""


def booktabs(columns: str, head: Sequence[str], rows: Sequence[Sequence[str] | None]) -> str:
    """A LaTeX tabular with booktabs rules; cells are LaTeX, None is a rule between rows."""
    body = [r"\midrule" if r is None else " & ".join(r) + r" \\" for r in rows]
    return "\n".join(
        [
            rf"\begin{{tabular}}{{{columns}}}",
            r"\toprule",
            " & ".join(head) + r" \\",
            r"\midrule",
            *body,
            r"\bottomrule",
            r"\end{tabular}",
        ]
    )


def escaped(text: str) -> str:
    """Text for LaTeX text mode."""
    special = {"\\": r"\textbackslash{}", "<": r"\textless{}", ">": r"\textgreater{}"}
    special |= {c: "\\" + c for c in "&%$#_{}"} | {
        "^": r"\textasciicircum{}",
        "~": r"\textasciitilde{}",
    }
    return "".join(special.get(c, c) for c in text)
