"""The doors of the rooms: public functions, loaded when they are first used."""

import importlib

import pytest


@pytest.mark.parametrize("room", ["specrate.theory", "specrate.numerics", "specrate.proofs"])
def test_every_door_opens(room: str) -> None:
    module = importlib.import_module(room)
    assert module.__all__
    for name in module.__all__:
        assert callable(getattr(module, name))
    with pytest.raises(AttributeError, match=f"module '{room}' has no attribute 'window'"):
        _ = module.window
