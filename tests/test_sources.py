"""Sources: every word is a source or one line of complaint; a misbehaving sampler is a fault."""

import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.point_sources.pointfiles import write_text
from specrate.numerics.point_sources.realisations import SamplerFault
from specrate.numerics.point_sources.sources import (
    CallableSource,
    EngineSource,
    FileSource,
    Source,
    load_source,
)
from specrate.numerics.streams import stream
from specrate.theory.errors import InputError

SAMPLERS = '''
"""Samplers for the tests of sources."""
import dataclasses
import numpy as np
from scipy.stats import qmc
import neighbour  # in the same folder

@dataclasses.dataclass
class Jitter:
    power: int = 2
    def __call__(self, n, dim, rng):
        side = round(n ** (1 / dim))
        if side ** dim != n:
            raise ValueError(f"n must be a power: got {n}\\nsecond line")
        cells = np.stack(np.unravel_index(np.arange(n), (side,) * dim), axis=1)
        return (cells + rng.random((n, dim))) / side

class Holder:
    @staticmethod
    def points(n, dim, rng):
        return rng.random((n, dim))

def points(n, dim, rng):
    return rng.random((n, dim))

jitter = Jitter()
engine = qmc.Halton(2)
number = 3

class Seeded(qmc.Halton):
    def __init__(self, d, seed=None):
        super().__init__(d, rng=seed)

class Frozen(qmc.Halton):
    def __init__(self, d):
        super().__init__(d)

class Passing(qmc.Halton):
    def __init__(self, d, **kwargs):
        super().__init__(d, **kwargs)

def odd(n, dim, rng):
    return rng.random((n, dim))
odd.admissible = 7
'''

FILES = {
    "specrate_test_samplers.py": SAMPLERS,
    "neighbour.py": "def points(n, dim, rng):\n    return rng.random((n, dim))\n",
    "random.py": "def points(n, dim, rng):\n    return rng.random((n, dim))\n",
    "two words.py": "from neighbour import points\n",
    "broken.py": "def points(:\n",
    "raising.py": "raise RuntimeError('no\\nluck')\n",
    "leaving.py": "import sys\nsys.exit(0)\n",
    "lacking.py": "import a_module_that_is_absent\n",
    "lazy.py": "def __getattr__(name):\n    raise RuntimeError(name)\n",
    "notes.md": "no points",
    "a.txt": "0.1 0.2\n0.3 0.4\n#\n0.5 0.6\n0.7 0.8\n",
    "b.txt": "0.9 0.2\n0.3 0.4\n",
    "c.csv": "x,y\n0.1,0.2\n0.3,0.4\n0.5,0.6\n",
    "three.txt": "0.1 0.2 0.3\n",
    "bad.txt": "0.1,0.2\n",
}


@pytest.fixture(scope="module", autouse=True)
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sources")
    for name, content in FILES.items():
        (folder / name).write_text(content)
    return folder


@pytest.fixture(autouse=True)
def _inside(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)


M = "specrate_test_samplers"


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        ([f"{M}:points"], "callable"),
        ([f"{M}:jitter"], "callable"),
        ([f"{M}:Jitter"], "callable"),
        ([f"{M}:Holder.points"], "callable"),
        ([f"py:{M}:points"], "callable"),
        ([f"{M}.py:points"], "callable"),
        ([f"./{M}.py:jitter"], "callable"),
        ([f"py:{M}.py:points"], "callable"),
        (["random.py:points"], "callable"),
        (["two words.py:points"], "callable"),
        (["neighbour:points"], "callable"),
        (["math:sqrt"], "callable"),
        (["os.path:join"], "callable"),
        (["scipy.stats.qmc:Sobol"], "engine"),
        (["py:scipy.stats.qmc:Halton"], "engine"),
        (["scipy.stats:qmc.LatinHypercube"], "engine"),
        (["scipy.stats.qmc:PoissonDisk"], "engine"),
        ([f"{M}:Seeded"], "engine"),
        ([f"{M}.py:Passing"], "engine"),
        (["a.txt"], "file"),
        (["./a.txt", "b.txt", "c.csv"], "file"),
    ],
)
def test_usable_words(words: list[str], kind: str) -> None:
    source = load_source(words, 2)
    assert (source.kind, source.dim, source.name) == (kind, 2, " ".join(words))
    assert (source.counts is None) == (kind != "file")
    assert (source.realisations is None) == (kind != "file")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "must be named: got no word"),
        ([""], "a source must be .* got ''"),
        (["points"], "a source must be .* got 'points'"),
        (["py:jitter"], "a source must be .* got 'py:jitter'"),
        (["py:a.txt"], "a source must be .* got 'py:a.txt'"),
        ([":points"], "a source must be .* got ':points'"),
        ([f"{M}:"], "a source must be"),
        ([f"{M}:points()"], "a source must be .* got"),
        (["os;import x:f"], "a source must be"),
        ([".relative:points"], "a source must be"),
        (["folder/module:points"], "a source must be"),
        (["notes.md"], "a source must be .* got 'notes.md'"),
        (["absent_module:points"], "must name a module: got no module 'absent_module'"),
        (["absent.deeper:points"], "got no module 'absent'"),
        (["os.absent:points"], "got no module 'os.absent'"),
        (["absent.py:points"], "must name a Python file: got no file 'absent.py'"),
        (["folder.py/x.py:points"], "got no file 'folder.py/x.py'"),
        ([f"{M}:absent"], f"an attribute of {M}: got 'absent'"),
        ([f"{M}.py:Holder.absent"], "got 'Holder.absent'"),
        ([f"{M}:number"], "must be callable: got int"),
        (["neighbour:__name__"], "must be callable: got str"),
        ([f"{M}:odd"], "'admissible' must be callable: got int"),
        (["broken.py:points"], "without error: got SyntaxError: invalid syntax"),
        (["raising:points"], "without error: got RuntimeError: no luck for"),
        (["raising.py:points"], "without error: got RuntimeError: no luck for"),
        (["leaving.py:points"], "without error: got SystemExit: 0"),
        (["leaving:points"], "without error: got SystemExit: 0"),
        (["lacking:points"], "without error: got ModuleNotFoundError: .*a_module_that_is_absent"),
        (["lazy.py:points"], "without error: got RuntimeError: points"),
        ([f"{M}:engine"], "must be given as its class, Halton"),
        ([f"{M}:Frozen"], "must take rng= or seed="),
        (["scipy.stats.qmc:QMCEngine"], "must not be abstract"),
        (["absent.txt"], "must be readable: got 'No such file"),
        (["bad.txt"], "got a comma at line 1 of bad.txt"),
        (["three.txt"], "must have 2 columns: got 3 in three.txt"),
        (["a.txt", "three.txt"], "must have 2 columns: got 3 in three.txt"),
        (["a.txt", f"{M}:points"], "several words must all be point files"),
        ([f"{M}:points", f"{M}:jitter"], "several words must all be point files"),
        (["cmd:prog {n} {seed}"], "a source must be .* got 'cmd:prog {n} {seed}'"),
        (["cmd:prog", "{n}", "points.txt"], "several words must all be point files"),
    ],
)
def test_unusable_words(words: list[str], message: str) -> None:
    before = list(sys.path)
    with pytest.raises(InputError, match=message) as caught:
        load_source(words, 2)
    assert "\n" not in str(caught.value)
    assert sys.path == before


@pytest.mark.parametrize("dim", [0, -1])
def test_dimension_must_be_positive(dim: int) -> None:
    with pytest.raises(InputError, match=f"at least 1: got {dim}"):
        load_source(["a.txt"], dim)


def test_neither_scipy_nor_sympy_for_a_plain_callable() -> None:
    """Else every child process that draws points would pay for them."""
    code = (
        "import sys; from specrate.numerics.point_sources.sources import load_source; "
        "load_source(['neighbour:points'], 2); sys.exit(len({'scipy', 'sympy'} & {*sys.modules}))"
    )
    subprocess.run([sys.executable, "-P", "-c", code], check=True)


ANY_N = [
    f"{M}:points",
    f"{M}:Seeded",
    f"{M}:Passing",
    "scipy.stats.qmc:Halton",
    "scipy.stats.qmc:LatinHypercube",
    "scipy.stats.qmc:PoissonDisk",
]


@pytest.mark.parametrize("word", [*ANY_N, "scipy.stats.qmc:Sobol"])
def test_realisations_depend_on_seed_n_and_replicate_only(word: str) -> None:
    source = load_source([word], 3)
    together = source.realise(16, 5, range(4))
    assert together.shape == (4, 16, 3)
    assert together.dtype == np.float64
    np.testing.assert_array_equal(source.realise(16, 5, range(2, 4)), together[2:])
    assert len(np.unique(together[:, 0, 0])) == 4
    assert not np.array_equal(source.realise(16, 6, range(4)), together)
    assert source.realise(16, 5, range(0)).shape == (0, 16, 3)


def test_the_callable_gets_the_stream_of_its_realisation() -> None:
    points = load_source([f"{M}:points"], 2).realise(8, 3, range(1, 2))
    np.testing.assert_array_equal(points[0], stream(3, 8, 1).random((8, 2)))


@pytest.mark.parametrize("word", ANY_N)
def test_any_n_is_admissible(word: str) -> None:
    assert load_source([word], 2).admissible(37) == 37


@pytest.mark.parametrize(("n", "nearest"), [(1, 1), (3, 2), (5, 4), (6, 4), (7, 8), (1000, 1024)])
def test_sobol_honours_powers_of_two(n: int, nearest: int) -> None:
    assert load_source(["scipy.stats.qmc:Sobol"], 2).admissible(n) == nearest


@pytest.mark.parametrize(
    ("dim", "n", "nearest"), [(2, 50, 49), (2, 64, 64), (3, 50, 64), (5, 100, 32), (1, 7, 7)]
)
def test_a_value_error_makes_it_try_nearby_powers(dim: int, n: int, nearest: int) -> None:
    assert load_source([f"{M}:jitter"], dim).admissible(n) == nearest


def of(function: Callable[..., object], dim: int = 2) -> CallableSource:
    return CallableSource("test", function, dim)


def test_a_callable_may_say_what_it_honours() -> None:
    def points(n: int, dim: int, rng: np.random.Generator) -> np.ndarray:
        raise AssertionError("not to be called")

    points.admissible = lambda n: np.int64(n // 10 * 10)  # pyright: ignore[reportFunctionMemberAccess]
    assert of(points).admissible(47) == 40
    for wrong in (3.5, None, "4", 0, -2):
        points.admissible = lambda n, wrong=wrong: wrong  # pyright: ignore[reportFunctionMemberAccess]
        with pytest.raises(SamplerFault, match=f"positive whole number: got {wrong}") as caught:
            of(points).admissible(47)
        assert caught.value.kind == "type"


def test_no_power_helps_a_sampler_that_always_refuses() -> None:
    def points(n: int, dim: int, rng: np.random.Generator) -> np.ndarray:
        raise ValueError(f"never {n}")

    rule = r"test must honour n = 50 or one near it \(49, 64, 32\): got ValueError: never 50 at "
    with pytest.raises(SamplerFault, match=rule) as caught:
        of(points).admissible(50)
    assert caught.value.kind == "not honoured"
    assert caught.value.evidence["tried"] == [49, 64, 32]


def test_another_exception_is_a_fault_at_once() -> None:
    with pytest.raises(SamplerFault, match="ZeroDivisionError"):
        of(lambda n, dim, rng: 1 // 0).admissible(50)


GOOD = np.full((4, 2), 0.5)


def changed(row: int, axis: int, value: float) -> np.ndarray:
    points = GOOD.copy()
    points[row, axis] = value
    return points


@pytest.mark.parametrize(
    ("raw", "kind", "evidence"),
    [
        (None, "type", {"got": "NoneType of object"}),
        ("points", "type", {"got": "str of <U6"}),
        (GOOD.astype(complex), "type", {"got": "ndarray of complex128"}),
        (GOOD > 0, "type", {"got": "ndarray of bool"}),
        ([[0.1, 0.2], [0.3]], "type", {"got": "list"}),
        ((GOOD, np.ones(4)), "type", {"got": "tuple"}),
        (np.ma.masked_array(GOOD), "type", {"got": "MaskedArray"}),
        (0.5, "shape", {"got": [], "asked": [4, 2]}),
        (GOOD[:, 0], "shape", {"got": [4]}),
        (GOOD.T, "shape", {"got": [2, 4]}),
        (GOOD[None], "shape", {"got": [1, 4, 2]}),
        (np.full((4, 3), np.nan), "shape", {"got": [4, 3]}),
        (GOOD[:3], "count", {"asked": 4, "got": 3}),
        (np.full((9, 2), np.nan), "count", {"asked": 4, "got": 9}),
        (changed(2, 1, np.nan), "not finite", {"row": 2, "axis": 2, "value": "nan"}),
        (changed(0, 0, -np.inf), "not finite", {"row": 0, "axis": 1, "value": "-inf"}),
        (changed(1, 0, 1.0), "outside", {"row": 1, "axis": 1, "value": 1.0, "values": 1}),
        (changed(3, 1, -1e-300), "outside", {"row": 3, "axis": 2, "value": -1e-300}),
        (np.ones((4, 2), int), "outside", {"row": 0, "values": 8}),
    ],
)
def test_faults_of_what_is_returned(raw: object, kind: str, evidence: dict[str, object]) -> None:
    def points(n: int, dim: int, rng: np.random.Generator) -> object:
        # The first realisation is in order; the fault names the second.
        return raw if rng.random() == stream(0, 4, 1).random() else GOOD

    with pytest.raises(SamplerFault) as caught:
        of(points).realise(4, 0, range(3))
    fault = caught.value
    assert fault.kind == kind
    assert fault.evidence.items() >= (evidence | {"realisation": 1}).items()
    assert str(fault) == f"{kind}: {fault.detail}"
    assert "\n" not in fault.detail


@pytest.mark.parametrize("raw", [GOOD, GOOD.tolist(), GOOD.astype("f4"), changed(0, 0, -0.0)])
def test_arrays_of_reals_pass(raw: object) -> None:
    np.testing.assert_array_equal(of(lambda n, dim, rng: raw).realise(4, 0, range(1))[0], raw)


def test_a_reused_buffer_is_copied() -> None:
    buffer = np.empty((4, 2))

    def points(n: int, dim: int, rng: np.random.Generator) -> np.ndarray:
        buffer[:] = rng.random((n, dim))
        return buffer

    drawn = of(points).realise(4, 0, range(3))
    assert len(np.unique(drawn)) == 24
    drawn[:] = 0
    assert buffer.any()


@pytest.mark.parametrize("error", [RuntimeError("first\nsecond"), SystemExit(0), TypeError()])
def test_an_exception_is_a_fault_with_its_place(error: BaseException) -> None:
    def points(n: int, dim: int, rng: np.random.Generator) -> np.ndarray:
        raise error

    with pytest.raises(SamplerFault) as caught:
        of(points).realise(4, 0, range(7, 9))
    fault = caught.value
    assert fault.kind == "exception"
    assert fault.evidence["type"] == type(error).__name__
    assert fault.evidence["message"] == " ".join(str(error).split())
    assert fault.evidence["place"].startswith(f"{__file__}:")
    assert fault.evidence["realisation"] == 7
    assert "\n" not in fault.detail
    assert fault.__cause__ is error


def test_an_interruption_is_no_fault() -> None:
    def points(n: int, dim: int, rng: np.random.Generator) -> np.ndarray:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        of(points).realise(4, 0, range(1))


def test_a_fault_survives_pickling() -> None:
    fault = SamplerFault("count", "too few", {"asked": 4})
    copy = pickle.loads(pickle.dumps(fault))
    assert (copy.kind, copy.detail, copy.evidence) == (fault.kind, fault.detail, fault.evidence)


def test_poisson_disk_that_fills_up_gives_fewer_points() -> None:
    with pytest.raises(SamplerFault, match="must have the 2000 points asked for") as caught:
        load_source(["scipy.stats.qmc:PoissonDisk"], 2).realise(2000, 0, range(1))
    assert caught.value.kind == "count"
    assert caught.value.evidence["got"] < 2000


def test_an_engine_may_take_seed_as_before_scipy_1_15() -> None:
    class Old:
        def __init__(self, d: int, seed: np.random.Generator) -> None:
            self.d, self.rng = d, seed

        def random(self, n: int) -> np.ndarray:
            return self.rng.random((n, self.d))

    points = EngineSource("old", Old, 2).realise(4, 9, range(1))
    np.testing.assert_array_equal(points[0], stream(9, 4, 0).random((4, 2)))


def test_files_join_realisations_of_one_n() -> None:
    source = load_source(["a.txt", "c.csv", "b.txt"], 2)
    assert isinstance(source, FileSource)
    assert source.counts == (2, 3)
    assert source.realisations == {2: 3, 3: 1}
    drawn = source.realise(2, 0, range(3))
    np.testing.assert_array_equal(drawn[:, 0, 0], [0.1, 0.5, 0.9])
    assert source.realise(2, 0, range(2, 3)).shape == (1, 2, 2)
    assert source.realise(2, 0, range(0)).shape == (0, 2, 2)
    assert [source.admissible(n) for n in (1, 2, 3, 100)] == [2, 2, 3, 3]
    drawn[:] = 0
    assert source.realise(2, 0, range(3)).any()


def test_files_hold_no_more_than_they_hold() -> None:
    source = load_source(["a.txt"], 2)
    with pytest.raises(InputError, match=r"hold the N asked for \(2\): got 3"):
        source.realise(3, 0, range(1))
    with pytest.raises(InputError, match=r"one of its 2 realisations of 2 points.*: got 2"):
        source.realise(2, 0, range(1, 4))
    with pytest.raises(InputError, match="got -1"):
        source.realise(2, 0, range(-1, 1))


def test_faults_in_files_are_the_samplers(folder: Path) -> None:
    points = np.full((2, 3, 2), 0.5)
    points[1, 2, 0] = 1.0
    write_text(folder / "edge.txt", points)
    source: Source = load_source(["edge.txt"], 2)
    assert source.realise(3, 0, range(1)).shape == (1, 3, 2)
    with pytest.raises(SamplerFault, match=r"must lie in \[0, 1\): got 1.0 on axis 1, row 2"):
        source.realise(3, 0, range(2))
