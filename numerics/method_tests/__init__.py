"""Methods against each other: stress on extreme cases, and error against run time."""
