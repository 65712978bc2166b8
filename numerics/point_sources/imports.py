"""Python objects named by ``module:name`` or ``path.py:name``, imported without being evaluated.

The name may be dotted. Whatever goes wrong on the way, also inside the module, is an `InputError`
of one line. And back: `word_of` names a function so that another interpreter finds it.
"""

import contextlib
import hashlib
import importlib
import importlib.util
import inspect
import os
import sys
from collections.abc import Generator, Sequence
from importlib.machinery import PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any, cast

from ...theory.errors import InputError
from .pointfiles import POINT_SUFFIXES

# Code that leaves by sys.exit(0) must not end a check with "nothing contradicted".
RAISED = (Exception, SystemExit)


def load_attribute(word: str) -> object:
    """What ``module:name`` or ``path.py:name`` stands for; the name may be dotted."""
    place, colon, name = word.removeprefix("py:").rpartition(":")
    is_path = place.endswith(".py")
    named = all(part.isidentifier() for part in name.split("."))
    if not colon or not named or not (is_path or _is_module_name(place)):
        raise InputError(
            "a source must be a sampler of the catalogue, module:callable, path.py:callable or "
            f"point files ({', '.join(POINT_SUFFIXES)}): got '{word}'"
        )
    target: object = _import_path(Path(place), word) if is_path else _import_module(place, word)
    for part in name.split("."):
        try:
            target = getattr(target, part)
        except AttributeError as error:
            raise InputError(f"a source must name an attribute of {place}: got '{name}'") from error
        except RAISED as error:  # a module may import lazily
            raise _import_fault(error, word) from error
    return target


def _is_module_name(name: str) -> bool:
    return all(part.isidentifier() for part in name.split("."))


def _import_module(name: str, word: str) -> ModuleType:
    """Import a module; the current directory counts, as for ``python -m``."""
    try:
        with _importable(Path.cwd()):
            return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and (name + ".").startswith(error.name + "."):
            raise InputError(
                f"a source must name a module: got no module '{error.name}' for '{word}'"
            ) from error
        raise _import_fault(error, word) from error
    except RAISED as error:
        raise _import_fault(error, word) from error


def _import_path(path: Path, word: str) -> ModuleType:
    """Import a file under a name of its own, so that random.py does not hide the library's."""
    if not path.is_file():
        raise InputError(f"a source must name a Python file: got no file '{path}' for '{word}'")
    path = path.resolve()
    digest = hashlib.blake2b(os.fsencode(path), digest_size=6).hexdigest()
    name = f"specrate_source_{path.stem}_{digest}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"a source must be a file that Python can import: got '{path}'")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and pickle look their module up while it runs
    try:
        with _importable(path.parent):
            spec.loader.exec_module(module)
    except RAISED as error:
        del sys.modules[name]
        raise _import_fault(error, word) from error
    return module


@contextlib.contextmanager
def _importable(folder: Path) -> Generator[None]:
    """Put a folder in front of sys.path for the time of an import."""
    importlib.invalidate_caches()  # the sampler may have been written a moment ago
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        with contextlib.suppress(ValueError):  # the module may have rearranged sys.path itself
            sys.path.remove(str(folder))


def _import_fault(error: BaseException, word: str) -> InputError:
    return InputError(f"a source must import without error: got {one_line(error)} for '{word}'")


def one_line(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())}".rstrip(": ")


def word_of(sampler: object) -> str | None:
    """``module:name`` or ``path.py:name`` by which another interpreter finds a function.

    Returns
    -------
    str or None
        None for a lambda, a local function, a bound method, or what its module does not hold
        under its own name.
    """
    name, module = getattr(sampler, "__qualname__", None), getattr(sampler, "__module__", None)
    if not (
        inspect.isfunction(sampler) and name and all(p.isidentifier() for p in name.split("."))
    ):
        return None
    holder: Any = sys.modules.get(module or "")
    for part in name.split("."):
        holder = getattr(holder, part, None)
    if holder is not sampler or module is None:
        return None
    file = Path(inspect.getfile(sampler)).resolve()
    if module != "__main__" and _is_found(module, file):
        return f"py:{module}:{name}"
    return f"py:{file}:{name}" if file.suffix == ".py" and file.is_file() else None


def _is_found(module: str, file: Path) -> bool:
    """Whether a fresh import of the module leads to the file."""
    search, origin = None, None
    parts = module.split(".")
    for i in range(len(parts)):
        spec = PathFinder.find_spec(".".join(parts[: i + 1]), search)
        if spec is None:
            return False
        search, origin = spec.submodule_search_locations, spec.origin
    return origin is not None and Path(origin).resolve() == file


def refuse_unless_source(source: Any) -> None:
    """Refuse what is neither a function nor a word nor words.

    Raises
    ------
    InputError
        As when None is given.
    """
    if callable(source) or isinstance(source, str):
        return
    if isinstance(source, Sequence) and all(
        isinstance(word, str) for word in cast("Sequence[object]", source)
    ):
        return
    raise InputError(f"a sampler must be a function, a word or a list of words: got {source!r}")
