"""What specrate raises when it is asked for something that cannot be."""


class InputError(ValueError):
    """Unusable input: one line that gives the rule and then the value.

    The command line prints the message on stderr and exits with code 2.
    """


class UndecidedSign(InputError):
    """Two exponents cannot be ordered under the assumptions that the layout carries."""
