"""Is a LaTeX fragment well formed? Structurally always; compiled where pdflatex is installed."""

import re
import shutil
import subprocess
from pathlib import Path

_DOCUMENT = r"""\documentclass{article}
\usepackage[margin=2cm]{geometry}
\usepackage{amsmath}
\usepackage{booktabs}
\begin{document}
%s
\end{document}
"""


def check_structure(latex: str) -> None:
    """Balanced braces, environments, delimiters and dollars; rows with as many cells as columns."""
    text = re.sub(r"(?m)(?<!\\)%.*$", "", latex)
    bare = re.sub(r"\\[\\{}$&%#_]", "  ", text)
    _check_groups(bare)
    assert bare.count("$") % 2 == 0
    assert text.count(r"\left") - text.count(r"\leftarrow") == text.count(r"\right")
    for columns, body in re.findall(
        r"\\begin\{tabular\}\{(\w+)\}(.*?)\\end\{tabular\}", text, re.S
    ):
        _check_rows(len(columns), body)


def _check_groups(text: str) -> None:
    stack: list[str] = []
    for token in re.finditer(r"\\(begin|end)\{(\w+\*?)\}|[{}]|\\\[|\\\]", text):
        word = token.group()
        if token.group(1) == "end" or word in ("}", r"\]"):
            expected = {"}": "{", r"\]": r"\["}.get(word, token.group(2))
            assert stack, f"nothing open for {word} at {token.start()}"
            assert stack.pop() == expected, f"{word} at {token.start()}"
        else:
            stack.append(token.group(2) or word)
    assert not stack


def _check_rows(columns: int, body: str) -> None:
    inner = re.sub(r"\\begin\{(aligned|cases)\}.*?\\end\{\1\}", "x", body, flags=re.S)
    inner = re.sub(r"\\(top|mid|bottom)rule", "", inner)
    rows = [r for r in re.split(r"\\\\", inner) if r.strip()]
    assert rows
    for row in rows:
        spans = [int(n) for n in re.findall(r"\\multicolumn\{(\d+)\}", row)]
        cells = len(re.findall(r"(?<!\\)&", row)) + 1 + sum(spans) - len(spans)
        assert cells == columns, row


def compile_where_possible(fragments: list[str], folder: Path) -> None:
    """Compile one document of all fragments; does nothing where there is no pdflatex."""
    program = shutil.which("pdflatex")
    if program is None:
        return
    source = folder / "all.tex"
    source.write_text(_DOCUMENT % "\n\n\\clearpage\n".join(fragments), encoding="utf-8")
    command = [program, "-interaction=nonstopmode", "-halt-on-error", source.name]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-3000:]
    assert "Undefined control sequence" not in done.stdout
    assert "Missing character" not in done.stdout
    widest = [float(w) for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", done.stdout)]
    assert max(widest, default=0) < WIDEST_OVERFULL


WIDEST_OVERFULL = 160
"""Points: the exact spectrum of correlated multi-jitter is one product that no sign breaks."""
