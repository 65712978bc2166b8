"""A certified value of Eq. 17, printed."""

import json

from ..numerics.equation17.radial_integrals import RadialResult


def render(found: RadialResult, form: str) -> str:
    """The value in one of the formats of the command line."""
    document = {
        "value": found.value.value,
        "error_bound": found.value.error_bound,
        "log_value": found.log_value,
        "leading": None
        if found.leading is None
        else {
            "exponent": str(found.leading.order.exponent),
            "log_power": str(found.leading.order.log_power),
            "constant": str(found.leading.constant),
        },
        "seconds": found.seconds,
    }
    if form == "json":
        return json.dumps(document, indent=1)
    lines = [
        f"V = {found.value.value}",
        f"error at most {found.value.error_bound} (certified by ball arithmetic)",
        f"ln V = {found.log_value}",
    ]
    if found.leading is not None:
        lines.append(f"V ~ ({found.leading.constant}) {found.leading.order} as N -> oo")
    return "\n".join(lines)
