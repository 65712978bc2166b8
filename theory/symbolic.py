"""SymPy enters the package here; it carries no types, so that its objects are ``Any``."""

from typing import Any, TypeAlias

import sympy as _sympy

sympy: Any = _sympy
"""The sympy module."""

Expr: TypeAlias = Any
"""An exact ``sympy.Expr``."""

Symbol: TypeAlias = Any
"""A ``sympy.Symbol``."""

FracElement: TypeAlias = Any
"""An element of a field of rational functions, ``sympy.polys.fields.FracElement``."""

FracField: TypeAlias = Any
"""A field of rational functions, ``sympy.polys.fields.FracField``."""

Integer: Any = sympy.Integer
Rational: Any = sympy.Rational
