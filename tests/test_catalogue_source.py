"""The source that words name: a catalogue sampler, a child, a command or point files."""

import pytest
from specrate.numerics.point_sources.catalogue_source import (
    CatalogueSource,
    chunk_size,
    counts_of,
    open_source,
)
from specrate.numerics.point_sources.child_processes import Limits
from specrate.numerics.point_sources.child_source import ChildSource
from specrate.numerics.point_sources.command_source import CommandSource
from specrate.numerics.point_sources.sources import FileSource
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler


@pytest.mark.parametrize(
    ("n", "size"), [(2, 64), (16384, 64), (16385, 32), (1 << 20, 1), (1 << 22, 1)]
)
def test_chunks_are_powers_of_two_and_fit_the_memory(n, size):
    assert chunk_size(n) == size


def test_chunks_of_a_catalogue_source_are_whole():
    source = CatalogueSource(parse_sampler("jitter", 2))
    assert (source.name, source.dim, source.admissible(50)) == ("jitter", 2, 49)
    with pytest.raises(InputError, match="in chunks of 64"):
        source.realise(16, 0, range(1, 2))
    assert source.realise(16, 0, range(64, 70)).shape == (6, 16, 2)
    with pytest.raises(InputError, match="must have points to draw: got 'isotropic:2'"):
        counts_of(parse_sampler("isotropic:2", 2), 16)
    with pytest.raises(InputError, match="must have points to draw"):
        open_source(["isotropic:2"], 2)


@pytest.mark.parametrize(
    ("word", "kind"),
    [
        ("jitter", CatalogueSource),
        ("n-rooks", CatalogueSource),
        ("module:points", ChildSource),
        ("py:jitter:points", ChildSource),
        ("jitterbug", ChildSource),
        ("cmd:echo {n} {seed}", CommandSource),
    ],
)
def test_words_are_told_apart(word, kind):
    """Nothing is started: what names nothing usable shows at the first question."""
    limits = Limits(call=7.0)
    source = open_source([word], 2, limits)
    assert type(source) is kind
    if kind is ChildSource:
        assert (source.process.limits, source.process.running) == (limits, None)
    if kind is CommandSource:
        assert source.limits == limits


def test_point_files_are_read_at_once(tmp_path):
    (tmp_path / "a.txt").write_text("0.1 0.2\n")
    assert type(open_source([str(tmp_path / "a.txt")], 2)) is FileSource
    with pytest.raises(InputError, match="must be readable"):
        open_source([str(tmp_path / "absent.txt")], 2)
    for words in ([], ["jitter", "jitter"], ["cmd:echo {n} {seed}", "a.txt"]):
        with pytest.raises(InputError, match=r"must be named|must all be point files"):
            open_source(words, 2)


@pytest.mark.parametrize("word", ["jitter", "cmd:echo {n} {seed}", "module:points", "a.txt"])
@pytest.mark.parametrize("dim", [0, -3])
def test_dimension_must_be_positive(word, dim):
    with pytest.raises(InputError, match=f"at least 1: got {dim}"):
        open_source([word], dim)


def test_what_names_nothing_is_unusable_when_asked():
    with pytest.raises(InputError, match="got 'jitterbug'"):
        open_source(["jitterbug"], 2).admissible(16)
