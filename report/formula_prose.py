"""Prose with formulas in it, N^-3, b_k, α, <=, cut into letters, scripts, signs and words."""

import re
import unicodedata
from typing import Literal, TypeAlias

from .formula_prints import LATEX_NAMES
from .grids import escaped

Kind: TypeAlias = Literal["text", "letter", "above", "below"]

_ACCENTS = {
    "\u0302": "hat", "\u0303": "tilde", "\u0304": "bar", "\u0305": "bar", "\u0306": "breve",
    "\u0307": "dot", "\u0308": "ddot", "\u030c": "check", "\u0332": "underline",
}  # fmt: skip
_SIGNS = {"<=": "≤", ">=": "≥", "!=": "≠", "->": "→", "...": "…"}
_ASCII = {
    "−": "$-$", "–": "--", "—": "---", "’": "'", "‘": "`", "“": "``", "”": "''", "×": r"$\times$",
    "±": r"$\pm$", "√": r"$\surd$", "≈": r"$\approx$", "∼": r"$\sim$", "ℤ": r"$\mathbf{Z}$",
    "ℝ": r"$\mathbf{R}$", "∂": r"$\partial$", "⌊": r"$\lfloor$", "⌋": r"$\rfloor$", "§": r"\S{}",
    "⟨": r"$\langle$", "⟩": r"$\rangle$", "∝": r"$\propto$", "‖": r"$\|$", "ℓ": r"$\ell$",
    "∧": r"$\wedge$", "∩": r"$\cap$", "∪": r"$\cup$", "⇒": r"$\Rightarrow$", "∀": r"$\forall$",
    "∣": r"$\mid$", "|": "$|$", "½": r"$\tfrac12$", "°": r"$^\circ$", "∅": r"$\emptyset$",
    "⊂": r"$\subset$", "⊆": r"$\subseteq$", "≡": r"$\equiv$", "≪": r"$\ll$", "≫": r"$\gg$",
    "≲": r"$\lesssim$", "≳": r"$\gtrsim$", "⇔": r"$\Leftrightarrow$", "∗": "$*$", "⋅": r"$\cdot$",
    "′": r"$'$", "⁻": "$^-$", "ϕ": r"$\phi$", "ϵ": r"$\epsilon$", "∆": r"$\Delta$",
    "∉": r"$\notin$",
    "∥": r"$\parallel$", "⊥": r"$\perp$",
    "←": r"$\leftarrow$", "⌈": r"$\lceil$", "⌉": r"$\rceil$", "†": r"$\dagger$", "µ": r"$\mu$",
}  # fmt: skip

_GROUP = r"[−+-]?\((?:[^()]|\([^()]*\))*\)|\{[^{}]*\}|[−+-]?(?:\w(?![\w])|\d+|\w+)|[∥⊥∗*′∞]"
_TOKEN = re.compile(
    r"(?P<hat>[A-Za-zα-ωΑ-Ω][\u0300-\u036f]|f\^(?=[(|]))"
    rf"|(?P<script>(?<=[\w)\]|}}²∞∫∏\u0300-\u036f])[\^_](?:{_GROUP}))"
    r"|(?P<indexed>[α-ωc]\d(?!\w))|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)|(?P<sunk>[₀₁₂₃₄₅₆₇₈₉]+)"
    r"|(?P<sign><=|>=|!=|->|\.\.\.)"
    r"|(?P<letter>(?<![\w'’.])(?:A(?! [a-z])|(?<!Appendix )[B-Zb-zα-ωΓΔΘΛΞΠΣΦΨΩ])"
    r"(?![A-Za-z0-9'’])(?!\.\w))"
)


def pieces(text: str) -> list[tuple[Kind, str]]:
    """The text cut where a letter of a formula, an index or an exponent stands."""
    found: list[tuple[Kind, str]] = []
    last = 0
    for match in _TOKEN.finditer(text):
        found.append(("text", text[last : match.start()]))
        found += _cut(match.group(), match.lastgroup or "")
        last = match.end()
    found.append(("text", text[last:]))
    return [p for p in found if p[1]]


def _cut(word: str, name: str) -> list[tuple[Kind, str]]:
    """The pieces of one match."""
    match name:
        case "script":
            return [("above" if word[0] == "^" else "below", _opened(word[1:]))]
        case "hat":
            return [("letter", word.replace("^", "\u0302"))]
        case "indexed":
            return [("letter", word[0]), ("below", word[1:])]
        case "raised" | "sunk":
            return [("above" if name == "raised" else "below", unicodedata.normalize("NFKD", word))]
        case "letter" if word != "I":
            return [("letter", word)]
        case _:
            return [("text", _SIGNS.get(word, word))]


def _opened(group: str) -> str:
    """An index or exponent without its brackets, a minus sign as such."""
    is_bracketed = group[0] + group[-1] in ("()", "{}")
    return (group[1:-1] if is_bracketed else group).replace("-", "−")


def latex_text(text: str) -> str:
    """Prose for LaTeX text mode, its formulas as mathematics."""
    found = ""
    for kind, word in pieces(text):
        if kind == "text":
            found += "".join(map(_latex_character, unicodedata.normalize("NFC", word)))
        elif kind == "letter":
            letter, accent = LATEX_NAMES.get(word[0], word[0]), _ACCENTS.get(word[1:])
            found += rf"$\{accent}{{{letter}}}$" if accent else f"${letter}$"
        else:
            mark = "^" if kind == "above" else "_"
            inner = _INDEX.sub(r"_{\1}", "".join(map(_in_mathematics, word)))
            found += f"${mark}{{{inner}}}$"
    return re.sub(r"(?<!\\)\$\$", " ", found)


_INDEX = re.compile(r"\\_ (\w+)")
"""An index within an index or exponent, as its escaped sign stands there."""


def _in_mathematics(character: str) -> str:
    known = _latex_character(character)
    inner = known[1:-1] if known.startswith("$") and known.endswith("$") else known
    return inner + (" " if inner.startswith("\\") else "")


def _latex_character(character: str) -> str:
    if character in _ASCII:
        return _ASCII[character]
    if character in LATEX_NAMES and not character.isascii():
        return f"${LATEX_NAMES[character].strip()}$"
    if character.isascii():
        return escaped(character)
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return escaped(plain) or "?"
