"""Architecture: imports run one way, the theory has no floats, modules say what they are."""

import ast
import doctest
import importlib
import pkgutil
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROOMS = ("theory", "numerics", "proofs", "report")
LONGEST = 400
FILES = sorted(p for room in ROOMS for p in (ROOT / room).rglob("*.py"))
IDS = [str(p.relative_to(ROOT)) for p in FILES]


def imported(path: Path) -> list[str]:
    """Absolute names of all modules that a file imports; ours begin with ``specrate``."""
    package = ("specrate", *path.relative_to(ROOT).parts[:-1])
    names: list[str] = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            stem = ".".join((*base, *([node.module] if node.module else ())))
            names += [f"{stem}.{alias.name}" for alias in node.names]
    return names


@pytest.mark.parametrize("path", FILES, ids=IDS)
def test_imports_run_one_way(path):
    own = ROOMS.index(path.relative_to(ROOT).parts[0])
    for name in imported(path):
        parts = name.split(".")
        if parts[0] == "specrate":
            assert parts[1] in ROOMS[: own + 1], name


@pytest.mark.parametrize("path", FILES, ids=IDS)
def test_no_file_imports_a_bare_room(path):
    """``import theory`` works by accident in the root and makes a second copy of every class."""
    assert not [n for n in imported(path) if n.split(".")[0] in ROOMS]


@pytest.mark.parametrize("path", [p for p in FILES if p.is_relative_to(ROOT / "theory")], ids=str)
def test_the_theory_has_no_floats_and_no_chance(path):
    assert not [
        n for n in imported(path) if n.split(".")[0] in ("numpy", "scipy", "random", "mpmath")
    ]
    constants = [
        n.value for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.Constant)
    ]
    assert not [c for c in constants if isinstance(c, float)]


@pytest.mark.parametrize("path", FILES, ids=IDS)
def test_modules_have_a_docstring(path):
    assert ast.get_docstring(ast.parse(path.read_text()))


@pytest.mark.parametrize("path", FILES, ids=IDS)
def test_files_are_short(path):
    assert len(path.read_text().splitlines()) <= LONGEST


def test_the_walk_finds_every_file():
    found = {name.replace(".", "/") for name in modules()}
    files = {str(p.relative_to(ROOT).with_suffix("")).removesuffix("/__init__") for p in FILES}
    assert {f"specrate/{f}" for f in files} == found


def modules() -> list[str]:
    names: list[str] = []
    for room in ROOMS:
        package = importlib.import_module(f"specrate.{room}")
        names.append(package.__name__)
        names += [m.name for m in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")]
    return names


@pytest.mark.parametrize("name", modules())
def test_doctests(name):
    result = doctest.testmod(importlib.import_module(name))
    assert result.failed == 0


def test_the_folders_of_the_numerics_have_no_cycle():
    """Each folder knows only those before it; the order is what the imports say."""
    known: dict[str, set[str]] = {}
    for path in (ROOT / "numerics").glob("*/*.py"):
        used = {
            name.split(".")[2] for name in imported(path) if name.startswith("specrate.numerics.")
        }
        folders = {name for name in used if (ROOT / "numerics" / name).is_dir()}
        known.setdefault(path.parent.name, set()).update(folders - {path.parent.name})
    assert len(list(TopologicalSorter(known).static_order())) == len(known) >= 10
