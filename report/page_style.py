"""How a page looks: colours on white and on dark, type, tables that scroll, panels that reflow.

The colours of data are those of Okabe and Ito, which stay apart for colour-blind readers; where one
is too pale on white or too dark on black, its neighbour in their palette stands in. Every data
colour has a contrast of 3 at least with its ground, every text colour one of 4.5 (WCAG 2.2, 1.4.11
and 1.4.3).

References
----------
M. Okabe, K. Ito, Color Universal Design (CUD), 2002, revised 2008.
"""

from collections.abc import Mapping

LIGHT: Mapping[str, str] = {
    "paper": "#ffffff",
    "ink": "#1b1f24",
    "muted": "#59636e",
    "rule": "#d6dbe1",
    "grid": "#e3e7eb",
    "shade": "#f5f7f9",
    "link": "#005a9c",
    "good": "#00694e",
    "bad": "#a83a00",
    "data1": "#0072b2",
    "data2": "#d55e00",
    "data3": "#009e73",
    "data4": "#cc79a7",
    "data5": "#6b7480",
}
"""Names of the colours and their values on white; figures are drawn with these."""

DARK: Mapping[str, str] = {
    "paper": "#14171a",
    "ink": "#e7eaed",
    "muted": "#a3adb8",
    "rule": "#363d45",
    "grid": "#2b3138",
    "shade": "#1c2025",
    "link": "#7cc4f5",
    "good": "#4fd1a5",
    "bad": "#ffa366",
    "data1": "#56b4e9",
    "data2": "#e69f00",
    "data3": "#00b383",
    "data4": "#cc79a7",
    "data5": "#b4bec8",
}
"""The same names on a dark ground."""

SERIES = ("data1", "data2", "data3", "data4", "ink", "data5")
"""Colours of the curves of one panel, in their order."""

TEXTS = ("ink", "muted", "link", "good", "bad")
"""Colours that text is written in."""


def stylesheet() -> str:
    """The style of a page, with both sets of colours; paper is white whatever the screen is."""
    return (
        f":root{{color-scheme:light dark;{_variables(LIGHT)}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{_variables(DARK)}}}}}\n{_RULES}"
    )


def _variables(colours: Mapping[str, str]) -> str:
    return "".join(f"--{name}:{value};" for name, value in colours.items())


_RULES = """\
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem 1rem 3rem;max-width:74rem;background:var(--paper);
color:var(--ink);font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
header,main>section>:not(h2,figure,.scroll,details){max-width:46rem}
h1{font-size:1.75rem;line-height:1.25;margin:.25rem 0 .75rem}
h2{font-size:1.3rem;line-height:1.3;margin:2.75rem 0 .75rem;padding-top:.75rem;
border-top:1px solid var(--rule)}
h3{font-size:1.05rem;margin:1.75rem 0 .4rem}
p,ul,dl{margin:.5rem 0}
h1,h2,h3,p,li,dd,dt,figcaption,summary,a{overflow-wrap:anywhere}
a{color:var(--link)}
ul{padding-left:1.25rem}
code,pre{font-family:ui-monospace,"SF Mono","Cascadia Mono","DejaVu Sans Mono",monospace;
font-size:.9em}
pre{background:var(--shade);border:1px solid var(--rule);border-radius:.4rem;
padding:.7rem .9rem;white-space:pre-wrap;overflow-wrap:anywhere}
.eyebrow,figcaption,caption,.note{color:var(--muted);font-size:.92rem}
.eyebrow{margin:0}
.verdict{font-size:1.15rem;line-height:1.5;border-left:.3rem solid var(--muted);padding-left:.9rem}
.verdict.good{border-color:var(--good)}
.verdict.bad{border-color:var(--bad)}
.word{font-weight:700}
.good .word,.word.good{color:var(--good)}
.bad .word,.word.bad{color:var(--bad)}
.card{border:1px solid var(--rule);border-radius:.5rem;padding:.2rem 1rem .6rem;margin:1rem 0;
background:var(--shade)}
.card h3{margin-top:.7rem}
dl>div{display:grid;grid-template-columns:minmax(7rem,11rem) 1fr;gap:0 1rem;padding:.2rem 0}
dt{color:var(--muted)}
dd{margin:0}
figure{margin:1rem 0 2.5rem}
figcaption{max-width:46rem}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,21.5rem),1fr));
gap:1.25rem 1.5rem;margin:.5rem 0 .9rem}
.panels.pairs{max-width:50rem}
.panels svg{display:block;width:100%;max-width:32rem;height:auto;color:var(--ink)}
.panels svg *{stroke-linejoin:round;stroke-linecap:butt}
.scroll{overflow-x:auto;max-width:100%;margin:.75rem 0}
.scroll:focus-visible,summary:focus-visible,a:focus-visible{outline:2px solid var(--link);
outline-offset:2px}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
caption{text-align:left;padding:.3rem 0}
caption span{display:block;position:sticky;left:0;max-width:min(46rem,calc(100vw - 2rem))}
th,td{text-align:left;font-weight:400;padding:.3rem .9rem .3rem 0;white-space:nowrap;
vertical-align:baseline;border-bottom:1px solid var(--rule)}
thead th{color:var(--muted);border-bottom-color:var(--muted)}
td.wrap{white-space:normal;min-width:14rem;overflow-wrap:anywhere}
summary{cursor:pointer;color:var(--link);padding:.3rem 0}
sup,sub{line-height:0;font-size:.75em}
footer{margin-top:3rem;padding-top:.75rem;border-top:1px solid var(--rule);color:var(--muted);
font-size:.92rem}
@media (max-width:34rem){dl>div{grid-template-columns:1fr}h1{font-size:1.45rem}}
@media print{body{max-width:none;padding:0;font-size:10pt}h2,h3,caption,thead{break-after:avoid}
figure,.card,tr,.panels svg{break-inside:avoid}.panels{grid-template-columns:1fr 1fr}
.scroll{overflow:visible}th,td{white-space:normal}}
"""
