"""Where point sets come from: the catalogue, callables and commands in child processes, files."""
