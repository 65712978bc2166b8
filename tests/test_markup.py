"""Markup: what is put in as text comes out as that text, whatever it is."""

from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.report.markup import Html, element, items, joined, marked, prose, table, terms

TEXTS = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=30)


class Reader(HTMLParser):
    """Tags with their attributes, and the text."""

    def __init__(self, markup: Html) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(markup.text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


@given(TEXTS, TEXTS)
def test_texts_and_attributes_come_out_as_they_went_in(text: str, value: str) -> None:
    found = Reader(element("p", text, element("code", text), class_=value))
    assert found.tags == [("p", {"class": value}), ("code", {})]
    assert found.text == 2 * text


def test_markup_is_not_escaped_twice_and_text_always_once() -> None:
    assert element("p", Html("<b>x</b>"), "<b>").text == "<p><b>x</b>&lt;b&gt;</p>"
    assert marked("a & b") == "a &amp; b"
    assert element("meta", name="x", http_equiv="y").text == '<meta name="x" http-equiv="y">'
    assert joined("<", Html("<i>"), between=", ").text == "&lt;, <i>"


@given(TEXTS)
def test_prose_keeps_every_letter_but_the_signs_of_its_formulas(text: str) -> None:
    shown = Reader(prose(text)).text
    for sign in "^_−-":
        text, shown = text.replace(sign, ""), shown.replace(sign, "")
    assert shown == text


@pytest.mark.parametrize(
    ("text", "markup"),
    [
        ("N·P_S = 1", "<i>N</i>·<i>P</i><sub>S</sub> = 1"),
        ("at N = 16, N.", "at <i>N</i> = 16, <i>N</i>."),
        ("m_12 = -1", "<i>m</i><sub>12</sub> = -1"),
        ("10^-6 and N^-3/2", "10<sup>−6</sup> and <i>N</i><sup>−3/2</sup>"),
        ("NaN, n-rooks/N.py, the name", "NaN, n-rooks/N.py, the name"),
        ("<script>", "&lt;script&gt;"),
    ],
)
def test_formulas_of_the_field(text: str, markup: str) -> None:
    assert prose(text).text == markup


def test_tables_scroll_and_name_their_rows_and_columns() -> None:
    found = Reader(table("About N", ("a", "b"), [("<1>", Html("<b>2</b>"))]))
    assert found.tags[0] == (
        "div", {"class": "scroll", "role": "region", "aria-label": "About N", "tabindex": "0"}
    )  # fmt: skip
    assert [a["scope"] for t, a in found.tags if t == "th"] == ["col", "col", "row"]
    assert "<1>" in found.text
    assert [t for t, _ in Reader(items(["x", "y"])).tags] == ["ul", "li", "li"]
    assert [t for t, _ in Reader(terms([("x", "y")])).tags] == ["dl", "div", "dt", "dd"]
