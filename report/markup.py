"""HTML elements: whatever is a plain string is escaped, only what is marked up is not."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

_EMPTY = ("br", "meta", "link")
_SYMBOL = re.compile(
    r"N·P_S|P_S|(?<=[\w)])\^-?\w+(?:/\d+)?|\bm_\d+|\bm(?= =|\||,)"
    r"|(?<![\w/.:-])N(?=[\s,;:)|^]|\.?(?:\s|$))"
)


@dataclass(frozen=True)
class Html:
    """Markup that is ready to be written."""

    text: str


Content = Html | str


def marked(content: Content) -> str:
    """The markup of a content; a plain string is escaped."""
    return content.text if isinstance(content, Html) else escape(content, quote=True)


def element(tag: str, *content: Content, **attributes: str) -> Html:
    """An element; ``class_`` and ``aria_label`` stand for ``class`` and ``aria-label``."""
    written = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{escape(value, quote=True)}"'
        for name, value in attributes.items()
    )
    if tag in _EMPTY:
        return Html(f"<{tag}{written}>")
    return Html(f"<{tag}{written}>{''.join(map(marked, content))}</{tag}>")


def joined(*content: Content, between: Content = "") -> Html:
    """Contents one after the other."""
    return Html(marked(between).join(map(marked, content)))


def prose(text: str) -> Html:
    """Text with the formulas of the field set as such: N·P_S, N = 16, m_4 = 1, 10^-5."""
    found, last = "", 0
    for match in _SYMBOL.finditer(text):
        found += escape(text[last : match.start()]) + _set(match.group())
        last = match.end()
    return Html(found + escape(text[last:]))


def _set(symbol: str) -> str:
    if symbol.startswith("^"):
        return f"<sup>{symbol[1:].replace('-', '−')}</sup>"
    symbol = re.sub(r"[NPm]", lambda match: f"<i>{match.group()}</i>", symbol.replace("P_S", "P~"))
    return re.sub(r"_(\d+)", r"<sub>\1</sub>", symbol.replace("~", "<sub>S</sub>"))


def items(entries: Sequence[Content]) -> Html:
    """An unordered list."""
    return element("ul", *(element("li", e) for e in entries))


def terms(entries: Sequence[tuple[Content, Content]]) -> Html:
    """Names and their values."""
    rows = (element("div", element("dt", name), element("dd", value)) for name, value in entries)
    return element("dl", *rows)


def table(caption: str, head: Sequence[Content], rows: Sequence[Sequence[Content]]) -> Html:
    """A table that scrolls in a frame of its own where it is wider than the page."""
    top = element("tr", *(element("th", h, scope="col") for h in head))
    body = (element("tr", *_cells(row)) for row in rows)
    title = element("caption", element("span", prose(caption)))
    whole = element("table", title, element("thead", top), element("tbody", *body))
    return element("div", whole, class_="scroll", role="region", aria_label=caption, tabindex="0")


def _cells(row: Sequence[Content]) -> list[Html]:
    first, *others = row
    return [element("th", first, scope="row"), *(element("td", c) for c in others)]
