"""The colours of a page: enough contrast on both grounds, and apart for colour-blind readers."""

import re
from itertools import combinations

import numpy as np
import pytest
from specrate.report.page_style import DARK, LIGHT, SERIES, TEXTS, stylesheet

THEMES = pytest.mark.parametrize("colours", [LIGHT, DARK], ids=["light", "dark"])

# Linear RGB as a protanope and a deuteranope see it (Viénot, Brettel, Mollon, Digital video
# colourmaps for checking the legibility of displays by dichromats, 1999).
DICHROMATS = {
    "protan": [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]],
    "deutan": [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]],
}
LAB = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def linear(colour):
    values = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def contrast(one, other):
    low, high = sorted(float(linear(c) @ LAB[1]) for c in (one, other))
    return (high + 0.05) / (low + 0.05)


def lab(rgb):
    f = np.cbrt(np.maximum(LAB @ rgb / (LAB @ np.ones(3)), 1e-4))
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def difference(one, other, eyes):
    seen = (lab(np.array(DICHROMATS[eyes]) @ linear(c)) for c in (one, other))
    return np.linalg.norm(np.subtract(*seen))


def test_contrast_is_that_of_the_standard():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@THEMES
def test_text_can_be_read(colours):
    for name in TEXTS:
        for ground in ("paper", "shade"):
            assert contrast(colours[name], colours[ground]) >= 4.5, (name, ground)


@THEMES
def test_data_can_be_seen(colours):
    for name in SERIES:
        assert contrast(colours[name], colours["paper"]) >= 3, name


@THEMES
@pytest.mark.parametrize("eyes", DICHROMATS)
def test_data_colours_stay_apart_for_dichromats(colours, eyes):
    """Differences of 10 in CIELAB are seen at a glance."""
    for one, other in combinations(SERIES, 2):
        assert difference(colours[one], colours[other], eyes) >= 10, (one, other)


def test_a_common_red_and_green_do_not():
    """Those of matplotlib's default cycle."""
    assert difference("#d62728", "#2ca02c", "deutan") < 10


def test_the_sheet_defines_what_it_uses_and_is_balanced():
    sheet = stylesheet()
    assert set(LIGHT) == set(DARK)
    assert len(set(LIGHT.values())) == len(LIGHT)
    assert set(re.findall(r"var\(--([\w]+)\)", sheet)) <= set(LIGHT)
    assert sheet.count("{") == sheet.count("}")
    assert "url(" not in sheet
    assert "@import" not in sheet
    for rule in ("prefers-color-scheme:dark", "@media print", "overflow-x:auto"):
        assert rule in sheet
