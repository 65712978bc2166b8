"""The map of the house, docs/map.md, names every file and what it holds, in the file's own words.

Write it anew with ``python tests/test_map.py``.
"""

import ast
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGES = ("theory", "numerics", "proofs", "report")


def first_line(path: Path) -> str:
    """The first sentence of a module's docstring, on one line."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return " ".join(text.split("\n\n")[0].split())


def drawn() -> str:
    """The map as Markdown: a list per folder."""
    lines = ["# Map", "", "Every file, in the words of its own first line."]
    for package in PACKAGES:
        folders = {p.parent for p in (ROOT / package).rglob("*.py")}
        for folder in sorted(folders):
            lines += ["", f"## {folder.relative_to(ROOT)}/", ""]
            lines += [f"- `{p.name}`: {first_line(p)}" for p in sorted(folder.glob("*.py"))]
    return "\n".join(lines) + "\n"


def test_the_map_is_up_to_date():
    assert (ROOT / "docs" / "map.md").read_text(encoding="utf-8") == drawn()


def test_no_two_files_have_one_name_and_every_file_has_words():
    files = [p for package in PACKAGES for p in (ROOT / package).rglob("*.py")]
    assert all(first_line(p) for p in files)
    words = [first_line(p) for p in files]
    assert len(set(words)) == len(words)


if __name__ == "__main__":
    (ROOT / "docs" / "map.md").write_text(drawn(), encoding="utf-8")
