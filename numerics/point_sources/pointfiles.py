"""Point files: UTK text, UTK binary, CSV and .npy, read as one array (m, n, d).

A text file is read in three steps: (1) keep the lines that hold a point, each with its line
number and its realisation; (2) hand them to numpy in bulk; (3) only when that fails, look for the
first faulty line. Coordinates are read as they stand: nan, inf and values outside [0, 1) are for
the sampler's judge, not for the parser.

References
----------
UTK text: one point a line, blanks between coordinates, realisations separated by a line ``#``.
UTK binary, little-endian: u32 magic; 4 bytes of which byte 0 is the type; u32 m, n, d; then the
m n d values, row-major.
"""

import codecs
import csv
import io
import os
import struct
from array import array
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError

UTK_TEXT = (".txt", ".dat", ".pts")
POINT_SUFFIXES = (*UTK_TEXT, ".csv", ".npy", ".bin")

_MAGIC = 0x214B5455
_BIN_HEADER = struct.Struct("<IB3xIII")
_BIN_TYPES: tuple[str, ...] = ("<i4", "<i8", "<u4", "<u8", "<f4", "<f8")
_LABEL_NAMES = ("realisation", "realization")
_CHUNK = 65536


def read_points(path: str | os.PathLike[str]) -> NDArray[np.float64]:
    """Raw points of one file.

    Parameters
    ----------
    path : str or path
        The ending tells the format: ``.txt``, ``.dat``, ``.pts`` UTK text; ``.csv`` one point a
        row, with an optional header and an optional column ``realisation``; ``.npy`` of shape
        (n, d) or (m, n, d); ``.bin`` UTK binary.

    Returns
    -------
    ndarray of float64, shape (m, n, d)
        m realisations, in the order of their first appearance, of n points in d dimensions.

    Raises
    ------
    InputError
        For everything that is not such a file: names the file, the line where there is one, and
        what was read.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in POINT_SUFFIXES:
        endings = ", ".join(POINT_SUFFIXES)
        raise InputError(f"a point file must end in one of {endings}: got {path}")
    data = _bytes(path)
    if suffix == ".npy":
        points = _npy(path, data)
    elif suffix == ".bin":
        points = _utk_binary(path, data)
    else:
        lines = _lines(path, data)
        points = _stacked(_csv_rows(path, lines) if suffix == ".csv" else _utk_rows(path, lines))
    if points.size == 0:
        raise InputError(f"a point file must hold points: got shape {points.shape} in {path}")
    return points


def write_text(path: str | os.PathLike[str], points: NDArray[np.float64]) -> None:
    """Write points as UTK text with 17 significant digits: `read_points` gives them back exactly.

    Parameters
    ----------
    path : str or path
        The file to write, or to overwrite.
    points : ndarray, shape (n, d) or (m, n, d)
        One or m realisations.

    Raises
    ------
    InputError
        If there is no point, or the array has another rank.
    """
    if points.ndim not in (2, 3) or points.size == 0:
        raise InputError(f"points to write must fill (n, d) or (m, n, d): got shape {points.shape}")
    with Path(path).open("w", encoding="utf-8", newline="\n") as out:
        for index, realisation in enumerate(points if points.ndim == 3 else points[None]):
            if index:
                out.write("#\n")
            np.savetxt(out, realisation, fmt="%.17g")


def _bytes(path: Path) -> bytes:
    """Content of a file that must exist."""
    try:
        return path.read_bytes()
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise InputError(f"a point file must be readable: got '{reason}' for {path}") from error


def _lines(path: Path, data: bytes) -> list[str]:
    """Lines of a UTF-8 text, whatever its line ends."""
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        byte, line = data[error.start], data.count(b"\n", 0, error.start) + 1
        raise InputError(
            f"a text file must be UTF-8: got byte 0x{byte:02x} at line {line} of {path}"
        ) from error
    # Not splitlines: it also splits at form feeds and the like, and line numbers would be off.
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


@dataclass(frozen=True, eq=False)
class _Rows:
    """The lines that hold a point: coordinates, 1-based line number, realisation."""

    path: Path
    delimiter: str | None
    texts: list[str] = field(default_factory=list[str])
    numbers: "array[int]" = field(default_factory=lambda: array("q"))
    groups: "array[int]" = field(default_factory=lambda: array("q"))

    def add(self, text: str, number: int, group: int) -> None:
        self.texts.append(text)
        self.numbers.append(number)
        self.groups.append(group)

    def tokens(self, text: str) -> list[str]:
        return [token.strip() for token in text.split(self.delimiter)]


def _utk_rows(path: Path, lines: list[str]) -> _Rows:
    """Rows of UTK text. Two bare marks in a row enclose a realisation without points: refused."""
    rows = _Rows(path, None)
    group, after_mark, bare_marks = -1, True, 0
    for number, line in enumerate(lines, 1):
        content = line.strip()
        if not content:
            continue
        if content[0] == "#":
            bare_marks = (0 if not after_mark else bare_marks) + (content == "#")
            after_mark = True
            continue
        if after_mark:
            if group >= 0 and bare_marks > 1:
                raise InputError(
                    "realisations must hold equally many points: "
                    f"got one without points before line {number} of {path}"
                )
            group, after_mark = group + 1, False
        rows.add(content, number, group)
    return rows


def _csv_rows(path: Path, lines: list[str]) -> _Rows:
    """Rows of CSV, the column of realisation labels taken out."""
    rows = _Rows(path, ",")
    labels: dict[str, int] = {}
    width, column, seen = 0, -1, False
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        fields = _csv_fields(line)
        if not seen:
            seen, width = True, len(fields)
            if _is_header(fields):
                column = _label_column(path, number, fields)
                continue
        if len(fields) != width:
            raise _ragged(path, number, width, len(fields))
        label = fields.pop(column).strip() if column >= 0 else "0"
        if not any(token.strip() for token in fields):  # numpy would skip such a line in silence
            raise InputError(f"a coordinate must be a number: got '' at line {number} of {path}")
        rows.add(",".join(fields), number, labels.setdefault(label, len(labels)))
    return rows


def _csv_fields(line: str) -> list[str]:
    """Fields of one CSV line; the quotes' parser runs only where there are quotes."""
    return next(csv.reader([line])) if '"' in line else line.split(",")


def _is_header(fields: list[str]) -> bool:
    """A header names the column of labels, or holds no number at all.

    "0.1 0.2" and "0.1;0.2" count as numbers, so that files with other separators are refused
    and not read as a header.
    """
    if any(name.strip().lower() in _LABEL_NAMES for name in fields):
        return True
    words = (name.replace(";", " ").split() for name in fields)
    return not any(tokens and all(map(_is_number, tokens)) for tokens in words)


def _label_column(path: Path, number: int, fields: list[str]) -> int:
    """Position of the column ``realisation``, or -1."""
    found = [i for i, name in enumerate(fields) if name.strip().lower() in _LABEL_NAMES]
    if len(found) > 1:
        raise InputError(
            "a CSV file must have at most one column 'realisation': "
            f"got {len(found)} at line {number} of {path}"
        )
    return found[0] if found else -1


def _stacked(rows: _Rows) -> NDArray[np.float64]:
    """Shape (m, n, d) from rows in any order of their realisations."""
    if not rows.texts:
        raise InputError(f"a point file must hold at least one point: got none in {rows.path}")
    values = _values(rows)
    groups = np.frombuffer(rows.groups, dtype=np.int64)
    sizes = np.bincount(groups)
    if (odd := np.flatnonzero(sizes != sizes[0])).size:
        line = rows.numbers[int(np.argmax(groups == odd[0]))]
        raise InputError(
            f"realisations must hold equally many points: got {sizes[0]} in the first and "
            f"{sizes[odd[0]]} in the one that starts at line {line} of {rows.path}"
        )
    order = np.argsort(groups, kind="stable")
    return values[order].reshape(sizes.size, int(sizes[0]), values.shape[1])


def _values(rows: _Rows) -> NDArray[np.float64]:
    """Coordinates of all rows in the order of the file, parsed in bulk."""
    width = len(rows.tokens(rows.texts[0]))
    parts: list[NDArray[np.float64]] = []
    for start in range(0, len(rows.texts), _CHUNK):
        try:
            part = _parsed(rows.texts[start : start + _CHUNK], rows.delimiter)
        except ValueError as error:
            raise _first_fault(rows, start, width) from error
        if part.shape[1] != width:  # numpy checks widths within a chunk only
            raise _first_fault(rows, start, width)
        parts.append(part)
    return np.concatenate(parts)


def _parsed(texts: list[str], delimiter: str | None) -> NDArray[np.float64]:
    return np.loadtxt(texts, dtype=np.float64, comments=None, delimiter=delimiter, ndmin=2)


def _is_number(token: str) -> bool:
    # The bulk parser itself decides: Python's float() also takes "1_0" and foreign digits.
    if not token or token.isspace():
        return False
    try:
        return _parsed([token], None).size == 1
    except ValueError:
        return False


def _first_fault(rows: _Rows, start: int, width: int) -> InputError:
    """What is wrong with the first faulty row at or after `start`."""
    for text, number in zip(rows.texts[start:], rows.numbers[start:], strict=True):
        tokens = rows.tokens(text)
        wrong = next((token for token in tokens if not _is_number(token)), None)
        where = f"at line {number} of {rows.path}"
        if wrong is not None and rows.delimiter is None and "," in text:
            return InputError(f"UTK text separates coordinates by blanks: got a comma {where}")
        if wrong is not None and rows.delimiter and (";" in wrong or len(wrong.split()) > 1):
            return InputError(f"CSV separates coordinates by commas: got '{wrong[:40]}' {where}")
        if wrong is not None:
            return InputError(f"a coordinate must be a number: got '{wrong[:40]}' {where}")
        if len(tokens) != width:
            return _ragged(rows.path, number, width, len(tokens))
    raise AssertionError(f"bulk parser and locator disagree on {rows.path}")


def _ragged(path: Path, number: int, width: int, got: int) -> InputError:
    return InputError(
        f"a point file must have {width} columns on every line, as on its first: "
        f"got {got} at line {number} of {path}"
    )


def _npy(path: Path, data: bytes) -> NDArray[np.float64]:
    """Real array of rank 2 or 3; nothing is unpickled."""
    stream = io.BytesIO(data)
    try:
        array = np.lib.format.read_array(stream, allow_pickle=False)
    except Exception as error:  # a damaged header can raise nearly anything
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InputError(
            f"a .npy file must hold an array of numbers: got '{reason}' in {path}"
        ) from error
    if array.dtype.kind not in "fiu":
        raise InputError(f"a .npy file must hold real numbers: got dtype {array.dtype} in {path}")
    if array.ndim not in (2, 3):
        raise InputError(
            f"a .npy file must have shape (n, d) or (m, n, d): got {array.shape} in {path}"
        )
    if extra := len(data) - stream.tell():
        raise InputError(f"a .npy file must end with its array: got {extra} more bytes in {path}")
    return np.array(array if array.ndim == 3 else array[None], dtype=np.float64, order="C")


def _utk_binary(path: Path, data: bytes) -> NDArray[np.float64]:
    """UTK binary; its length must be exactly what its header announces."""
    if len(data) < _BIN_HEADER.size:
        raise InputError(
            f"a UTK .bin file must have a 20-byte header: got {len(data)} bytes in {path}"
        )
    header: tuple[int, int, int, int, int] = _BIN_HEADER.unpack_from(data)
    magic, kind, m, n, d = header
    if magic != _MAGIC:
        raise InputError(
            f"a UTK .bin file must start with the magic 0x{_MAGIC:08x}: got 0x{magic:08x} in {path}"
        )
    if kind >= len(_BIN_TYPES):
        raise InputError(f"a UTK .bin file must have a type byte of 0 to 5: got {kind} in {path}")
    dtype = np.dtype(_BIN_TYPES[kind])
    expected = _BIN_HEADER.size + m * n * d * dtype.itemsize
    if len(data) != expected:
        raise InputError(
            f"a UTK .bin file of m, n, d = {m}, {n}, {d} must have {expected} bytes: "
            f"got {len(data)} in {path}"
        )
    return np.frombuffer(data, dtype, offset=_BIN_HEADER.size).astype(np.float64).reshape(m, n, d)
