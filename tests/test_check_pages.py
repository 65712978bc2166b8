"""The page of a check: whole, escaped, self-contained, the same each time, with its pieces."""

import copy
import importlib.util
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import pytest
from check_examples import example, pictures
from latex import check_structure

pytest.importorskip("matplotlib")

from specrate.numerics.measuring.spectrum_pictures import SpectrumPictures
from specrate.report.check_figures import figures
from specrate.report.check_latex import latex_prose
from specrate.report.check_pages import page, write_report
from specrate.theory.errors import InputError

EMPTY = {"meta", "br", "link"}
SECTIONS = [
    "Claims",
    "Faults",
    "Figures",
    "Structure",
    "Neighbours in the catalogue",
    "Left out",
    "Plan",
]
SHOWN = {
    "consistent": None,
    "contradicted": pictures(),
    "raising": None,
    "exponent": SpectrumPictures(left_out=(("planes", "only exponents are claimed"),)),
}


class Reader(HTMLParser):
    """A page taken apart; tags must nest."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.tags, self.texts = [], [], {}
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open:
            self.texts.setdefault(self.open[-1], []).append(data)


def document_of(name):
    """The example; of the contradicted one a region and two integrands, which draw faster."""
    document = example(name)
    if name != "contradicted":
        return document
    kept = ("bernoulli:k=1", "disk:radius=0.3")
    points = [p for p in document["points"] if p["integrand"] in kept]
    return {**document, "points": points, "regions": document["regions"][:1]}


@pytest.fixture(scope="module")
def pages():
    return {name: Reader(page(document_of(name), shown)) for name, shown in SHOWN.items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A report with two figures."""
    found = tmp_path_factory.mktemp("report") / "new"
    write_report(example("exponent"), found)
    return found


def slimmed(name):
    """A document without figures, to be changed."""
    document = copy.deepcopy(example(name))
    return {**document, "points": [], "regions": [], "rates": []}


@pytest.mark.parametrize("name", SHOWN)
def test_sections_come_in_their_order(pages, name):
    found = pages[name]
    assert found.texts["h2"] == SECTIONS
    tags = [t for t, _ in found.tags]
    assert tags.count("h1") == tags.count("main") == tags.count("header") == 1
    assert tags[0] == "html"
    assert found.tags[0][1] == {"lang": "en"}


@pytest.mark.parametrize("name", SHOWN)
def test_nothing_is_asked_of_the_network_and_nothing_runs(pages, name):
    found = pages[name]
    assert not {"script", "iframe", "object", "link", "img", "audio", "video"} & {
        t for t, _ in found.tags
    }
    for _, attributes in found.tags:
        for key, value in attributes.items():
            assert not key.startswith("on")
            if key in ("href", "xlink:href", "src"):
                assert re.fullmatch(r"#[\w-]+|data:image/png;base64,[\w+/=\s]+|[\w.]+", value), (
                    value
                )
    policy = [a["content"] for t, a in found.tags if a.get("http-equiv")]
    assert policy == ["default-src 'none'; style-src 'unsafe-inline'; img-src data:"]


@pytest.mark.parametrize("name", SHOWN)
def test_pictures_have_words_and_ids_are_unique(pages, name):
    found = pages[name]
    ids = [a["id"] for _, a in found.tags if "id" in a]
    assert len(set(ids)) == len(ids)
    pictured = [a for t, a in found.tags if t == "svg"]
    assert len(pictured) == {"consistent": 3, "contradicted": 7, "raising": 0, "exponent": 2}[name]
    for a in pictured:
        assert a["role"] == "img"
        assert set(a["aria-labelledby"].split()) <= set(ids)
    assert len(found.texts.get("desc", [])) == len(pictured)
    assert len([t for t, _ in found.tags if t == "figcaption"]) == len(
        [t for t, _ in found.tags if t == "figure"]
    )


def test_the_numbers_of_figures_are_tables_too(pages):
    text = " ".join(pages["contradicted"].texts["td"] + pages["contradicted"].texts["th"])
    document = example("contradicted")
    assert text.count("bernoulli:k=1") == 0  # codes of their own
    codes = pages["contradicted"].texts["code"]
    assert codes.count("bernoulli:k=1") == 1 + len(document["plan"]["ladder"])
    assert "−3/2" in text
    listed = " ".join(pages["contradicted"].texts["li"])
    assert "b = 2.00 [1.90, 2.10], e = 1.00 [0.950, 1.05], γ = 1.00" in listed


def test_what_a_page_leaves_out_it_names(pages):
    text = " ".join(pages["exponent"].texts["p"] + pages["exponent"].texts["li"])
    assert "averaged no periodogram on a plane of frequencies" in text
    assert "No spectrum was measured: only exponents are claimed." in text
    assert ": only exponents are claimed" in text


def test_whatever_comes_from_outside_is_escaped():
    bad = "<script>alert('1')</script>\"&<img src=x onerror=y>"
    document = slimmed("invalid")
    document["plan"]["sources"] = [bad, "$x$ --> {"]
    document["faults"][0] |= {"kind": bad, "detail": bad, "evidence": {bad: bad, "list": [bad]}}
    document["left_out"].append({"what": bad, "why": bad})
    found = Reader(page(document, SpectrumPictures(left_out=((bad, bad),))))
    tags = {t for t, _ in found.tags}
    assert not {"script", "img"} & tags
    everything = " ".join(t for texts in found.texts.values() for t in texts)
    assert everything.count(bad) >= 9
    assert found.texts["title"] == [f"invalid: {bad} $x$ --> {{ in 2D - specrate check"]


def test_the_same_document_gives_the_same_bytes(folder, tmp_path):
    again = tmp_path / "again"
    files = write_report(json.loads(json.dumps(example("exponent"))), again)
    assert sorted(p.name for p in files) == sorted(p.name for p in folder.iterdir())
    for path in files:
        assert path.read_bytes() == (folder / path.name).read_bytes(), path.name


def test_the_pieces(folder):
    names = {p.name for p in folder.iterdir()}
    figures = {f"{s}.{f}" for s in ("convergence", "error_time") for f in ("png", "svg")}
    assert names == {"index.html", "check.json", "table.tex", "figures.tex"} | figures
    assert json.loads((folder / "check.json").read_text("utf-8")) == example("exponent")
    html = (folder / "index.html").read_text("utf-8")
    linked = set(re.findall(r'href="([\w.]+)"', html))
    assert linked == names - {"index.html"}
    latex = (folder / "figures.tex").read_text("utf-8")
    assert re.findall(r"\{(\w+\.png)\}", latex) == ["convergence.png", "error_time.png"]
    for name in ("table.tex", "figures.tex"):
        check_structure((folder / name).read_text("utf-8"))


def test_the_pieces_compile(folder, tmp_path):
    program = shutil.which("pdflatex")
    if program is None:
        pytest.skip("there is no pdflatex")
    packages = "".join(rf"\usepackage{{{p}}}" for p in ("amsmath", "booktabs", "graphicx"))
    body = r"\input{table.tex}\input{figures.tex}"
    source = rf"\documentclass{{article}}{packages}\begin{{document}}{body}\end{{document}}"
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    (tmp_path / "all.tex").write_text(source)
    command = [program, "-interaction=nonstopmode", "-halt-on-error", "-draftmode", "all.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-3000:]
    assert "Missing character" not in done.stdout


def test_captions_are_latex_whatever_is_drawn():
    text = "N·P_S at |m|, γ min(1, (|m|/(α N^e))^b), N → ∞, against N. Below 10^-6; 95 % of N|F|²"
    assert latex_prose(text) == (
        r"$N P_S$ at $|m|$, $\gamma\min(1, (|m|/(\alpha N^e))^b)$, $N \to \infty$, against $N$. "
        r"Below $10^{-6}$; 95 \% of $N|F|^2$"
    )
    for name, shown in SHOWN.items():
        for figure in figures(example(name), shown or SpectrumPictures()):
            assert latex_prose(figure.caption).isascii(), figure.caption


def test_figures_of_an_earlier_check_do_not_stay(tmp_path):
    (tmp_path / "spectrum.png").write_bytes(b"old")
    (tmp_path / "mine.png").write_bytes(b"mine")
    write_report(slimmed("raising"), tmp_path)
    assert {p.name for p in tmp_path.iterdir()} == {
        "index.html", "check.json", "table.tex", "figures.tex", "mine.png"
    }  # fmt: skip


def test_without_matplotlib_or_a_folder_there_is_one_line(tmp_path, monkeypatch):
    occupied = tmp_path / "file"
    occupied.write_text("")
    with pytest.raises(InputError, match=r"--report must be writable: got File exists for .*file$"):
        write_report(slimmed("raising"), occupied)
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "matplotlib" else find(name)
    )
    with pytest.raises(InputError, match="need matplotlib") as caught:
        write_report(slimmed("raising"), tmp_path / "other")
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "other").exists()
