"""Formulas printed: as plain text, as LaTeX, and as MathML that a page can break between terms."""

import re
from html import escape

from .formulas import (
    GREEK,
    Bracket,
    Formula,
    Fraction,
    Large,
    Root,
    Row,
    Script,
    Word,
    tall,
)

LATEX_NAMES: dict[str, str] = {letter: "\\" + name for name, letter in GREEK.items()} | {
    "∞": r"\infty", "−": "-", "≤": r"\le ", "≥": r"\ge ", "≠": r"\ne ", "→": r"\to ",
    "·": r"\cdot ", "∑": r"\sum", "∏": r"\prod", "∫": r"\int", "<": "<", "ε": r"\varepsilon",
    "↦": r"\mapsto ", "∈": r"\in ", "…": r"\dots ",
}  # fmt: skip
_OPERATORS = ("sin", "cos", "exp", "log", "min", "max")
_RAISED = str.maketrans("0123456789−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_SUNK = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def plain(f: Formula) -> str:
    """As text on one line: ∑_{j=0}^{N−1} cos(2π m (j − k)/N)."""
    match f:
        case Word(text, kind):
            spaced = {"binary": f" {text} ", "relation": f" {text} ", "times": " ", "mark": text}
            return ", " if text == "," else spaced.get(kind, text)
        case Row(parts):
            return re.sub(r" {2,}", " ", "".join(map(plain, parts)))
        case Fraction(over, under):
            return f"{_grouped(over, False)}/{_grouped(under, True)}"
        case Script(base, below, above):
            return plain(base) + _sunk(below) + _raised(above)
        case Large(sign, below, above):
            return f"{sign}_{_braced(below)}^{_braced(above)} "
        case Bracket(body, left, right):
            return f"{left}{plain(body)}{right}"
        case Root(body):
            return f"√({plain(body)})"


def _grouped(f: Formula, is_under: bool) -> str:
    is_sum = isinstance(f, Row) and any(isinstance(p, Word) and p.kind == "binary" for p in f.parts)
    is_applied = isinstance(f, Row) and len(f.parts) == 2 and isinstance(f.parts[1], Bracket)
    is_product = is_under and isinstance(f, Row) and not is_applied
    needed = is_sum or isinstance(f, Fraction) or is_product
    return f"({plain(f)})" if needed else plain(f)


def _sunk(f: Formula | None) -> str:
    if f is None:
        return ""
    text = plain(f)
    if text.isdigit():
        return text.translate(_SUNK)
    return f"_{text}" if len(text) == 1 else f"_{{{text.replace(' ', '')}}}"


def _raised(f: Formula | None) -> str:
    if f is None:
        return ""
    text = plain(f)
    if re.fullmatch(r"−?\d+", text):
        return text.translate(_RAISED)
    return f"^{text}" if len(text) == 1 else f"^({text})"


def _braced(f: Formula) -> str:
    text = plain(f).replace(" ", "")
    return text if len(text) == 1 else f"{{{text}}}"


def latex(f: Formula, is_outer: bool = True) -> str:
    """As LaTeX for inline mathematics, in which lines break at relations and signs, and between
    the factors of the outer row."""
    match f:
        case Word():
            if is_outer and f.kind == "times":
                return r"\allowbreak "
            return _latex_word(f) + (r"\allowbreak " if is_outer and f.text == "," else "")
        case Row(parts):
            return "".join(latex(p, is_outer) for p in parts)
        case Fraction(over, under):
            return rf"\frac{{{latex(over, False)}}}{{{latex(under, False)}}}"
        case Script(base, below, above):
            index = f"_{{{latex(below, False)}}}" if below else ""
            return latex(base, is_outer) + index + (f"^{{{latex(above, False)}}}" if above else "")
        case Large(sign, below, above):
            return rf"{LATEX_NAMES[sign]}_{{{latex(below, False)}}}^{{{latex(above, False)}}}"
        case Bracket(body, left, right):
            high = tall(body) > 1
            sizes = (r"\biggl", r"\biggr") if is_outer else (r"\left", r"\right")
            opening, closing = sizes if high else ("", "")
            return rf"{opening}{_fence(left)}{latex(body, is_outer)}{closing}{_fence(right)}"
        case Root(body):
            return rf"\sqrt{{{latex(body, False)}}}"


def _fence(text: str) -> str:
    return r"\vert " if text == "|" else text


def _latex_word(word: Word) -> str:
    text = word.text
    if word.kind == "name":
        return rf"\{text} " if text in _OPERATORS else rf"\mathrm{{{text}}}"
    if word.kind in ("times", "space"):
        return " " if word.kind == "times" else r"\,"
    known = LATEX_NAMES.get(text, text)
    if word.kind == "letter" and known.startswith("\\"):
        return f"{known} "
    return f"{known}\\," if text == "," else known


def mathml(f: Formula, display: bool = False) -> str:
    """As ``math`` elements, one for each stretch between relations and signs of the outer row."""
    parts = f.parts if isinstance(f, Row) else (f,)
    stretches: list[list[Formula]] = [[]]
    for p in parts:
        if isinstance(p, Word) and p.kind in ("relation", "binary") and stretches[-1]:
            stretches.append([])
        stretches[-1].append(p)
        if p == Word(",", "mark"):
            stretches.append([])
    stretches = [s for s in stretches if s]
    style = ' displaystyle="true"' if display else ""
    return " ".join(f"<math{style}>{_stretch(tuple(s))}</math>" for s in stretches)


def _stretch(parts: tuple[Formula, ...]) -> str:
    """A stretch; the blank before it stands for the space before its sign."""
    first = parts[0]
    if len(parts) > 1 and isinstance(first, Word) and first.kind in ("relation", "binary"):
        sign = f'<mo form="infix" lspace="0" rspace="0.28em">{escape(first.text)}</mo>'
        return sign + _math_row(parts[1:])
    return _math_row(parts)


def _math_row(parts: tuple[Formula, ...]) -> str:
    return "".join(map(_math, parts))


def _math(f: Formula) -> str:
    match f:
        case Word():
            return _math_word(f)
        case Row(parts):
            return f"<mrow>{_math_row(parts)}</mrow>"
        case Fraction(over, under):
            return f"<mfrac>{_math(over)}{_math(under)}</mfrac>"
        case Script(base, below, above):
            return _math_script(base, below, above)
        case Large("∫", below, above):
            return f"<msubsup>{_math_large('∫')}{_math(below)}{_math(above)}</msubsup>"
        case Large(sign, below, above):
            return f"<munderover>{_math_large(sign)}{_math(below)}{_math(above)}</munderover>"
        case Bracket(body, left, right):
            ends = [f'<mo stretchy="{str(tall(body) > 1).lower()}">{e}</mo>' for e in (left, right)]
            return f"<mrow>{ends[0]}{_math(body)}{ends[1]}</mrow>"
        case Root(body):
            return f"<msqrt>{_math(body)}</msqrt>"


def _math_large(sign: str) -> str:
    return f'<mo lspace="0.1em" rspace="0.17em">{sign}</mo>'


def _math_script(base: Formula, below: Formula | None, above: Formula | None) -> str:
    if below is not None and above is not None:
        return f"<msubsup>{_math(base)}{_math(below)}{_math(above)}</msubsup>"
    if below is not None:
        return f"<msub>{_math(base)}{_math(below)}</msub>"
    return f"<msup>{_math(base)}{_math(above)}</msup>" if above is not None else _math(base)


def _math_word(word: Word) -> str:
    text = escape(word.text)
    match word.kind:
        case "letter":
            return f'<mi mathvariant="normal">{text}</mi>' if text in "∞πΓ" else f"<mi>{text}</mi>"
        case "name":
            normal = ' mathvariant="normal"' if len(text) == 1 else ""
            return f"<mi{normal}>{text}</mi>"
        case "number":
            return f"<mn>{text}</mn>"
        case "times" | "space":
            return '<mspace width="0.13em"></mspace>'
        case "prefix":
            return f'<mo form="prefix" lspace="0" rspace="0">{text}</mo>'
        case "mark":
            space = "0.25em" if text == "," else "0"
            return f'<mo lspace="0" rspace="{space}">{text}</mo>'
        case _:
            return f'<mo form="infix" lspace="0.25em" rspace="0.25em">{text}</mo>'
