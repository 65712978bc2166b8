"""The look at pages in a browser finds what it is for: each defect, planted, is complained of."""

import importlib.util
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[1] / ".ci" / "chromium.py"

SVG = (
    '<svg viewBox="0 0 100 100" width="200" height="200" style="color:currentColor">{about}'
    '<g id="{name}text_1"><defs><path id="{name}g" d="M 0 0 L 9 0 L 9 9 z"/></defs>'
    '<use href="#{name}g" x="{x}" y="50" style="fill:{ink}"/></g></svg>'
)
WORDS = "<title>t</title><desc>d</desc>"
GOOD = SVG.format(about=WORDS, name="a", x=50, ink="currentColor")
STYLE = (
    "body{margin:1rem;background:#fff;color:#111}"
    "@media (prefers-color-scheme:dark){body{background:#111;color:#eee}}"
)

DEFECTS = {
    "": ("<p>all is well</p>" + GOOD, ""),
    "wide": ('<p style="width:30rem">x</p>', "wide on a screen of 400"),
    "cut": ('<p style="width:3rem;overflow:hidden"><span>Donaudampfschiff</span></p>', "cut: <p>"),
    "script": ("<script>1</script>", "the page has a script"),
    "error": ("<script>console.error('no')</script>", "console: "),
    "thrown": ("<script>throw new Error('no')</script>", "exception: "),
    "network": ('<img src="http://localhost:9/x.png" alt="">', "asked of the network: "),
    "dark": ('<p style="color:#111">ink</p>', "ink 0.0"),
    "twice": (GOOD + '<p id="ag">x</p>', "twice: id ag"),
    "figure": ("<figure></figure>", "no picture in <figure>"),
    "empty": (f'<svg width="200" height="200">{WORDS}</svg>', "not drawn: t"),
    "silent": (SVG.format(about="", name="a", x=50, ink="currentColor"), "without words"),
    "label": (SVG.format(about=WORDS, name="a", x=97, ink="currentColor"), "text cut: atext_1"),
    "black": (SVG.format(about=WORDS, name="a", x=50, ink="#000"), "ink 0: atext_1"),
    "folded": ('<details><p style="width:30rem">x</p></details>', "wide on a screen of 400"),
}


@pytest.fixture(scope="module")
def chromium():
    found = importlib.util.spec_from_file_location("chromium", SCRIPT)
    module = importlib.util.module_from_spec(found)
    sys.modules["chromium"] = module  # where its dataclass looks for itself
    found.loader.exec_module(module)
    try:
        module.executable()
    except SystemExit as none:
        pytest.skip(str(none))
    return module


@pytest.fixture(scope="module")
def browser(chromium, tmp_path_factory):
    running = chromium.start(str(tmp_path_factory.mktemp("profile")))
    yield running
    running.close()


@pytest.mark.parametrize("name", DEFECTS)
def test_a_planted_defect_is_complained_of(chromium, browser, tmp_path, name):
    body, complaint = DEFECTS[name]
    page = tmp_path / "index.html"
    head = f"<!DOCTYPE html><html lang=en><meta charset=utf-8><style>{STYLE}</style>"
    view = '<meta name="viewport" content="width=device-width, initial-scale=1"><title>x</title>'
    page.write_text(f"{head}{view}<body>{body}</body></html>")
    _, found = chromium.look(browser, page, "dark", None)
    if complaint:
        assert any(complaint in line for line in found), found
    else:
        assert found == []
