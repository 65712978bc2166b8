"""What a term may fail to be at a point: without a value, or with one that is not found."""


class Undefined(ArithmeticError):
    """The term has no value at the point: a claim that allows the point is false."""


class Undecided(ArithmeticError):
    """Whether the term has a value, or which, is not found here: the point says nothing."""
