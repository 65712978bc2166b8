"""Machine-checked statements about the paper: the room is laid out, none is in it yet."""
