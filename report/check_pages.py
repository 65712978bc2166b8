"""The page of a check: one self-contained HTML file, and its pieces for a paper beside it.

The page needs no network and no script, and says so to the browser (Content-Security-Policy);
whatever comes from outside is escaped. The same document and pictures give the same bytes.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..numerics.measuring.spectrum_pictures import SpectrumPictures
from ..theory.errors import InputError
from . import check_sections as sections
from .check_figures import CheckFigure, figures
from .check_formats import render
from .check_latex import figure_environments
from .check_tables import tables_of
from .figure_panels import inline, save
from .markup import Content, Html, element, joined, prose
from .page_style import stylesheet
from .work_precision_figures import require_matplotlib

Document = dict[str, Any]

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"


def write_report(
    document: Document, folder: Path, pictures: SpectrumPictures | None = None
) -> tuple[Path, ...]:
    """Write the page of a check and its pieces.

    Parameters
    ----------
    document : dict
        As ``numerics.check`` gives it.
    folder : Path
        Made if need be. Figures of an earlier check there that this one does not have are removed.
    pictures : SpectrumPictures, optional
        What was measured of the spectrum beside the document.

    Returns
    -------
    tuple of Path
        The files: index.html, check.json, table.tex, figures.tex, and .png and .svg of each figure.

    Raises
    ------
    InputError
        If matplotlib is missing or the folder cannot be written to.
    """
    require_matplotlib()
    shown = pictures or SpectrumPictures()
    drawn = figures(document, shown)
    texts = {
        "index.html": _whole(document, shown, drawn),
        "check.json": render(document, "json") + "\n",
        "table.tex": render(document, "latex") + "\n",
        "figures.tex": figure_environments(drawn),
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        files = [folder / name for name in texts]
        for figure in drawn:
            files += _save(figure, folder)
    except OSError as error:
        raise InputError(f"--report must be writable: got {error.strerror} for {folder}") from None
    return tuple(files)


def _save(figure: CheckFigure, folder: Path) -> list[Path]:
    paths = [folder / f"{figure.stem}.{form}" for form in ("png", "svg")]
    if not figure.panels:
        for path in paths:
            path.unlink(missing_ok=True)
        return []
    save(figure.panels, paths, figure.paired)
    return paths


def page(document: Document, pictures: SpectrumPictures | None = None) -> str:
    """The page alone, as HTML; see `write_report`."""
    shown = pictures or SpectrumPictures()
    return _whole(document, shown, figures(document, shown))


def _whole(document: Document, pictures: SpectrumPictures, drawn: Sequence[CheckFigure]) -> str:
    sources = " ".join(document["plan"]["sources"])
    title = f"{document['verdict']}: {sources} in {document['plan']['dim']}D"
    head = element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="color-scheme", content="light dark"),
        element("title", f"{title} - specrate check"),
        element("style", Html(stylesheet())),
    )
    body = element("body", _header(document), _main(document, pictures, drawn), _footer(drawn))
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en').text}\n"


def _header(document: Document) -> Html:
    plan = document["plan"]
    return element(
        "header",
        element("p", "specrate check", class_="eyebrow"),
        element("h1", sections.listed(plan["sources"]), f" in {plan['dim']}D"),
        sections.verdict(document),
    )


def _main(document: Document, pictures: SpectrumPictures, drawn: Sequence[CheckFigure]) -> Html:
    parts: list[tuple[str, Content]] = [
        ("Claims", sections.claims(document)),
        ("Faults", sections.faults(document)),
        ("Figures", joined(*(_figure(document, pictures, f) for f in drawn))),
        ("Structure", sections.structure(document)),
        ("Neighbours in the catalogue", sections.neighbours(document)),
        ("Left out", sections.left_out(document, pictures.left_out)),
        ("Plan", sections.plan(document)),
    ]
    return element(
        "main", *(element("section", element("h2", name), content) for name, content in parts)
    )


def _figure(document: Document, pictures: SpectrumPictures, figure: CheckFigure) -> Html:
    heading = element("h3", figure.heading)
    notes = joined(*(element("p", prose(m), class_="note") for m in figure.missing))
    if not figure.panels:
        return joined(heading, notes)
    panels = element(
        "div",
        *(inline(p, f"{figure.stem}{i}") for i, p in enumerate(figure.panels, 1)),
        class_="panels pairs" if figure.paired else "panels",
    )
    files = [element("a", form.upper(), href=f"{figure.stem}.{form}") for form in ("png", "svg")]
    caption = element(
        "figcaption", prose(figure.caption), " Files: ", joined(*files, between=", "), "."
    )
    drawn = element("figure", panels, caption, id=figure.stem)
    return joined(heading, drawn, notes, tables_of(document, pictures, figure.stem))


def _footer(drawn: Sequence[CheckFigure]) -> Html:
    names = ["check.json", "table.tex", *(["figures.tex"] if any(f.panels for f in drawn) else [])]
    links = joined(*(element("a", n, href=n) for n in names), between=", ")
    return element("footer", element("p", "Beside this page: ", links, "."))
