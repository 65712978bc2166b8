"""A sampler of the user, a callable or a scipy QMC engine, drawn in a child process.

Its points are those of the same source in this process, bit for bit; but it cannot hang, crash or
fill this process. Also here, since it needs calls that harm nobody: whether it depends on global
random state.
"""

from dataclasses import dataclass

from .child_processes import Failure, Limits, Points, settled
from .fault_kinds import Fault
from .sampler_processes import SamplerProcess, ask, draw
from .sources import Kind


@dataclass(frozen=True, eq=False)
class ChildSource:
    """A source like the one in this process, which cannot harm it.

    Parameters
    ----------
    process : SamplerProcess
    """

    process: SamplerProcess
    counts: None = None
    realisations: None = None

    @property
    def name(self) -> str:
        """The word that names the sampler."""
        return self.process.word

    @property
    def dim(self) -> int:
        """The dimension."""
        return self.process.dim

    @property
    def kind(self) -> Kind:
        """``callable`` or ``engine``."""
        return self.process.kind

    def admissible(self, n: int) -> int:
        """Nearest number of points that the sampler honours, for n >= 1.

        Raises
        ------
        SamplerFault, OutOfTime
            See `error_of`; the sampler may be called to find out.
        """
        return int(ask(self.process, {"do": "admissible", "n": n})["admissible"])

    def outcome(self, n: int, seed: int, replicates: range) -> Points | Failure:
        """Raw realisations, shape (len(replicates), n, dim), or the first failure among them.

        If the deadline comes between them, those before it.
        """
        return draw(self.process, n, seed, replicates)

    def realise(self, n: int, seed: int, replicates: range) -> Points:
        """Raw realisations, shape (len(replicates), n, dim).

        Raises
        ------
        SamplerFault, OutOfTime
            See `error_of`.
        """
        return settled(self.outcome(n, seed, replicates))


@dataclass(frozen=True)
class Repetition:
    """The same realisation drawn twice, from equal generators.

    Parameters
    ----------
    repeats : bool
        Whether the points were equal.
    moved : tuple of str
        Which of the global states ``numpy.random`` and ``random`` the first call changed.
    """

    repeats: bool
    moved: tuple[str, ...]


def open_child_source(word: str, dim: int, limits: Limits | None = None) -> ChildSource:
    """The source that a word names; its child is started when it is first asked.

    Parameters
    ----------
    word : str
        ``module:callable`` or ``path.py:callable``, with or without ``py:`` in front. One that
        names nothing usable is an `InputError` of the first question.
    dim : int
        At least 1.
    limits : Limits, optional
    """
    return ChildSource(SamplerProcess(word, dim, limits or Limits()))


def repetition(source: ChildSource, n: int, seed: int) -> Repetition:
    """Draw realisation 0 of N = n twice and compare.

    Raises
    ------
    SamplerFault, OutOfTime
        See `error_of`.
    """
    answer = ask(source.process, {"do": "repeat", "n": n, "seed": seed, "start": 0})
    return Repetition(answer["repeats"], tuple(answer["moved"]))


def global_state_fault(source: ChildSource, n: int, seed: int) -> Fault | None:
    """Fault ``global random state``: equal generators do not give equal points.

    A sampler that moves a global state and yet repeats itself, as by seeding that state from its
    generator, has no fault.
    """
    found = repetition(source, n, seed)
    if found.repeats:
        return None
    cause = f"; the call moved the state of {' and of '.join(found.moved)}" if found.moved else ""
    detail = f"equal generators must give equal points: got others for n = {n}{cause}"
    evidence = {"n": n, "realisation": 0, "moved": list(found.moved)}
    return Fault("global random state", detail, evidence)
