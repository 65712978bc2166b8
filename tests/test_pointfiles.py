"""Point files: what is written is read back exactly, and what is unusable is named by its line."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from specrate.numerics.point_sources.pointfiles import POINT_SUFFIXES, read_points, write_text
from specrate.theory.errors import InputError

MAGIC = 0x214B5455

point_arrays = hnp.arrays(
    np.float64,
    hnp.array_shapes(min_dims=3, max_dims=3, max_side=5),
    elements=st.floats(allow_nan=True, allow_infinity=True, allow_subnormal=True),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("points")


def put(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def utk_binary(m: int, n: int, d: int, values: bytes, kind: int = 5, magic: int = MAGIC) -> bytes:
    return struct.pack("<IB3xIII", magic, kind, m, n, d) + values


def csv_text(points: np.ndarray, column: int, header: bool = True) -> str:
    """CSV with its rows interleaved over realisations and the label in the given column."""
    m, n, d = points.shape
    names = [f"x{i}" for i in range(d)]
    names.insert(column, "realisation")
    lines = [",".join(names)] if header else []
    for i in range(n):
        for r in range(m):
            fields = [repr(x) for x in points[r, i].tolist()]
            fields.insert(column, f"set {r}")
            lines.append(",".join(fields))
    return "\n".join(lines) + "\n"


@settings(deadline=None)
@given(points=point_arrays, suffix=st.sampled_from([".txt", ".dat", ".pts", ".TXT"]))
def test_text_round_trip_is_exact(folder: Path, points: np.ndarray, suffix: str) -> None:
    path = folder / f"round{suffix}"
    write_text(path, points)
    np.testing.assert_array_equal(read_points(path), points)


@settings(deadline=None)
@given(points=point_arrays)
def test_npy_round_trip_is_exact(folder: Path, points: np.ndarray) -> None:
    path = folder / "round.npy"
    np.save(path, points)
    np.testing.assert_array_equal(read_points(path), points)
    np.save(path, points[0])
    np.testing.assert_array_equal(read_points(path), points[:1])


@settings(deadline=None)
@given(points=point_arrays, data=st.data())
def test_csv_keeps_realisations_apart(
    folder: Path, points: np.ndarray, data: st.DataObject
) -> None:
    column = data.draw(st.integers(0, points.shape[2]))
    path = put(folder, "round.csv", csv_text(points, column))
    np.testing.assert_array_equal(read_points(path), points)


@settings(deadline=None)
@given(
    points=hnp.arrays(
        np.float64,
        hnp.array_shapes(min_dims=3, max_dims=3, max_side=4),
        elements=st.integers(0, 100).map(float),
    ),
    kind=st.integers(0, 5),
)
def test_binary_of_every_type(folder: Path, points: np.ndarray, kind: int) -> None:
    values = points.astype(("<i4", "<i8", "<u4", "<u8", "<f4", "<f8")[kind]).tobytes()
    path = put(folder, "round.bin", utk_binary(*points.shape, values, kind))
    np.testing.assert_array_equal(read_points(path), points)


@settings(deadline=None)
@given(content=st.binary(max_size=200), suffix=st.sampled_from(POINT_SUFFIXES))
def test_any_bytes_are_points_or_one_line_of_complaint(
    folder: Path, content: bytes, suffix: str
) -> None:
    path = put(folder, f"noise{suffix}", content)
    try:
        points = read_points(path)
    except InputError as error:
        complaint = str(error)
    else:
        complaint = None
        assert points.ndim == 3
        assert points.dtype == np.float64
        assert points.size
    assert complaint is None or (str(path) in complaint and "\n" not in complaint)


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("plain.txt", "0.1 0.2\n0.3 0.4\n", [[[0.1, 0.2], [0.3, 0.4]]]),
        ("tabs.dat", "\t0.1\t 0.2  \n\n  0.3 0.4", [[[0.1, 0.2], [0.3, 0.4]]]),
        ("marks.pts", "# made by hand\n#\n1\n#\n2\n#\n\n#\n", [[[1.0]], [[2.0]]]),
        ("comment.txt", "1\n#\n# second\n2\n# end\n", [[[1.0]], [[2.0]]]),
        ("windows.txt", "1 2\r\n#\r\n3 4\r\n", [[[1.0, 2.0]], [[3.0, 4.0]]]),
        ("bom.txt", "\ufeff0.5\n", [[[0.5]]]),
        ("special.txt", "nan inf -inf 1.5 -1e-3\n", [[[np.nan, np.inf, -np.inf, 1.5, -1e-3]]]),
        ("bare.csv", "0.1,0.2\n 0.3 ,0.4\n", [[[0.1, 0.2], [0.3, 0.4]]]),
        ("header.csv", "x 1,y\n0.1,0.2\n", [[[0.1, 0.2]]]),
        ("numbered.csv", "0,1,Realisation\n0.1,0.2,7\n", [[[0.1, 0.2]]]),
        ("order.csv", "realisation,x\n9,0.1\n2,0.2\n", [[[0.1]], [[0.2]]]),
        ("quoted.csv", '"x",realization\n"0.1","a,b"\n0.2,"c"\n', [[[0.1]], [[0.2]]]),
        ("gap.csv", "\n0.1\n\n0.2\n", [[[0.1], [0.2]]]),
    ],
)
def test_text_forms(folder: Path, name: str, content: str, expected: list[list[float]]) -> None:
    np.testing.assert_array_equal(read_points(put(folder, name, content)), np.array(expected))


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        (
            "comma.txt",
            "0.1,0.2\n",
            "UTK text separates coordinates by blanks: got a comma at line 1",
        ),
        ("late.txt", "# x\n0.1 0.2\n0.3, 0.4\n", "by blanks: got a comma at line 3"),
        ("ragged.txt", "0.1 0.2\n#\n\n0.3\n", "2 columns on every line.*got 1 at line 4"),
        ("wide.txt", "0.1\n0.3 0.4\n", "1 columns on every line.*got 2 at line 2"),
        ("word.txt", "0.1 0.2\n0.3 zero\n", "must be a number: got 'zero' at line 2"),
        ("header.txt", "x y\n0.1 0.2\n", "must be a number: got 'x' at line 1"),
        ("under.txt", "0.1_0\n", "must be a number: got '0.1_0' at line 1"),
        ("after.txt", "0.1 0.2 # here\n", "must be a number: got '#' at line 1"),
        (
            "unequal.txt",
            "1\n2\n#\n3\n",
            "got 2 in the first and 1 in the one that starts at line 4",
        ),
        ("hollow.txt", "1\n#\n#\n2\n", "got one without points before line 4"),
        ("empty.txt", "", "at least one point: got none"),
        ("marks.txt", "# only\n#\n", "at least one point: got none"),
        ("latin.txt", b"0.1\n0.2 \xe9\n", "must be UTF-8: got byte 0xe9 at line 2"),
        ("utf16.csv", "0.1\n".encode("utf-16"), "must be UTF-8: got byte 0xff at line 1"),
        ("blank.csv", "0.1 0.2\n", "by commas: got '0.1 0.2' at line 1"),
        ("semicolon.csv", "x;y\n0.1;0.2\n", "by commas: got '0.1;0.2' at line 2"),
        ("ragged.csv", "x,y\n0.1,0.2\n0.3\n", "2 columns.*got 1 at line 3"),
        ("hole.csv", "0.1,0.2\n0.3,\n", "must be a number: got '' at line 2"),
        ("void.csv", "realisation,x\n1,\n", "must be a number: got '' at line 2"),
        ("labels.csv", "realisation\n1\n", "must be a number: got '' at line 2"),
        ("mixed.csv", "0.1,y\n", "must be a number: got 'y' at line 1"),
        ("twice.csv", "realisation,x,realisation\n", "at most one column 'realisation': got 2"),
        ("unequal.csv", "realisation,x\n1,0\n2,0\n1,0\n", "got 2 in the first and 1 .* at line 3"),
        ("head.csv", "x,y\n", "at least one point: got none"),
        ("short.bin", b"\x55\x54", "20-byte header: got 2 bytes"),
        ("magic.bin", utk_binary(1, 1, 1, bytes(8), magic=1), "magic 0x214b5455: got 0x00000001"),
        ("kind.bin", utk_binary(1, 1, 1, bytes(8), kind=6), "type byte of 0 to 5: got 6"),
        ("less.bin", utk_binary(1, 2, 1, bytes(8)), "must have 36 bytes: got 28"),
        ("more.bin", utk_binary(1, 1, 1, bytes(9)), "must have 28 bytes: got 29"),
        ("none.bin", utk_binary(1, 0, 2, b""), r"must hold points: got shape \(1, 0, 2\)"),
        ("huge.bin", utk_binary(*[2**32 - 1] * 3, b""), "must have .* bytes: got 20"),
        ("noise.npy", b"no array", "array of numbers: got '.*' in"),
        ("points.json", "[]", "must end in one of .txt, .dat.*: got"),
        ("points", "0.1", "must end in one of"),
    ],
)
def test_unusable_files_are_named(
    folder: Path, name: str, content: str | bytes, message: str
) -> None:
    path = put(folder, name, content)
    with pytest.raises(InputError, match=message) as caught:
        read_points(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros(3), r"shape \(n, d\) or \(m, n, d\): got \(3,\)"),
        (np.zeros((1, 1, 1, 1)), r"got \(1, 1, 1, 1\)"),
        (np.zeros((0, 2)), r"must hold points: got shape \(1, 0, 2\)"),
        (np.zeros((2, 2), complex), "real numbers: got dtype complex128"),
        (np.zeros((2, 2), bool), "real numbers: got dtype bool"),
        (np.array([["a"]]), "real numbers: got dtype <U1"),
        (np.array([[None]]), "array of numbers: got 'Object arrays cannot be loaded"),
    ],
)
def test_unusable_npy_arrays(folder: Path, array: np.ndarray, message: str) -> None:
    path = folder / "array.npy"
    np.save(path, array)
    with pytest.raises(InputError, match=message):
        read_points(path)


def test_npy_of_the_wrong_length(folder: Path) -> None:
    path = folder / "length.npy"
    np.save(path, np.zeros((4, 2)))
    whole = path.read_bytes()
    with pytest.raises(InputError, match="array of numbers"):
        read_points(put(folder, "cut.npy", whole[:-1]))
    with pytest.raises(InputError, match="got 1 more bytes"):
        read_points(put(folder, "long.npy", whole + b"x"))


def test_integers_and_short_floats_are_read_as_float64(folder: Path) -> None:
    for dtype in (np.int8, np.uint64, np.float16, np.float32):
        np.save(folder / "short.npy", np.ones((2, 2), dtype))
        assert read_points(folder / "short.npy").dtype == np.float64


def test_missing_file_and_folder(folder: Path) -> None:
    with pytest.raises(InputError, match="must be readable: got 'No such file or directory'"):
        read_points(folder / "absent.txt")
    (folder / "folder.txt").mkdir()
    with pytest.raises(InputError, match="must be readable: got 'Is a directory'"):
        read_points(folder / "folder.txt")


def test_fault_far_into_a_long_file_is_found(folder: Path) -> None:
    """The bulk parser works in chunks of 65536 rows: faults on both sides of a border."""
    good = "0.25 0.5\n" * 70000
    for bad, message in (("0.25\n", "got 1 at line 70001"), ("0.25 x\n", "'x' at line 70001")):
        with pytest.raises(InputError, match=message):
            read_points(put(folder, "long.txt", good + bad + good))
    # A whole chunk of another width is consistent in itself.
    with pytest.raises(InputError, match="got 1 at line 65537"):
        read_points(put(folder, "chunk.txt", "0.25 0.5\n" * 65536 + "0.25\n" * 10))
    assert read_points(put(folder, "good.txt", good)).shape == (1, 70000, 2)


@pytest.mark.parametrize("shape", [(3,), (0, 2), (1, 1, 1, 1)])
def test_write_refuses_other_shapes(folder: Path, shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match=r"must fill \(n, d\) or \(m, n, d\)"):
        write_text(folder / "never.txt", np.zeros(shape))
    assert not (folder / "never.txt").exists()
