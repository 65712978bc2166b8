"""The command line: parse the words, call one room, print one document.

Nothing heavy is imported until a command runs, so that ``--help`` is quick. Exit codes: 0 done,
1 contradicted or invalid, 2 unusable input, 3 inconclusive, 130 interrupted.
"""

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from pathlib import Path
from typing import NoReturn, TypeAlias

DONE, CONTRADICTED, UNUSABLE, INCONCLUSIVE, INTERRUPTED = 0, 1, 2, 3, 130

FORMATS = ("terminal", "json", "latex", "markdown", "csv")


class _Parser(argparse.ArgumentParser):
    """Errors in one line, the rule and then the value."""

    def error(self, message: str) -> NoReturn:
        self.exit(UNUSABLE, f"{self.prog}: {message} (see {self.prog} --help)\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    parsed = _parser().parse_args(arguments)
    try:
        return _run(parsed)
    except KeyboardInterrupt:  # also while the rooms are being imported
        print("specrate: interrupted", file=sys.stderr)
        return INTERRUPTED


def _run(parsed: argparse.Namespace) -> int:
    from ..theory.errors import InputError

    code = DONE
    try:
        _check_writable(parsed.output)
        with redirect_stdout(sys.stderr):  # what a sampler prints is no part of the document
            text, code = parsed.run(parsed)
        _write(text, parsed.output)
    except InputError as error:
        print(f"specrate: {error}", file=sys.stderr)
        return UNUSABLE
    except BrokenPipeError:  # the reader, such as head, has closed
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def _check_writable(output: str | None) -> None:
    """Refuse a file that cannot be written before time is spent on what goes there."""
    if output is None:
        return
    from ..theory.errors import InputError

    target = Path(output)
    if target.is_dir() or not target.parent.is_dir():
        raise InputError(f"--output must name a file in an existing directory: got {output}")


def _write(text: str, output: str | None) -> None:
    if output is None:
        print(text)
        sys.stdout.flush()
        return
    from ..theory.errors import InputError

    try:
        Path(output).write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError(f"--output must be writable: got {error.strerror} for {output}") from None


def _parser() -> _Parser:
    parser = _Parser(
        prog="specrate",
        description="How fast does the variance of a sampler fall? Derive it, then check it.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _add_table(commands)
    _add_derive(commands)
    _add_check(commands)
    _add_variance(commands)
    _add_radial(commands)
    _add_recommend(commands)
    _add_stress(commands)
    _add_prove(commands)
    return parser


class _Version(argparse.Action):
    """Looks the version up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib.metadata import version

        print(version("specrate"))
        parser.exit()


Commands: TypeAlias = "argparse._SubParsersAction[_Parser]"  # pyright: ignore[reportPrivateUsage]


def _command(commands: Commands, name: str, run: Callable[..., object], about: str) -> _Parser:
    parser = commands.add_parser(name, help=about, description=about)
    parser.set_defaults(run=run)
    parser.add_argument("--output", metavar="FILE", help="write there instead of to the terminal")
    return parser


def _add_format(parser: _Parser, formats: Sequence[str] = FORMATS) -> None:
    parser.add_argument("--format", choices=formats, default="terminal")


def _add_table(commands: Commands) -> None:
    p = _command(commands, "table", _table, "convergence table, derived from exact spectra")
    p.add_argument("--sampler", action="append", default=[], metavar="S", help="repeatable")
    p.add_argument("--dim", action="append", default=[], metavar="D", help="a number or d")
    p.add_argument(
        "--integrand", action="append", default=[], metavar="CLASS", help="worst, best, p=5/2, disk"
    )
    p.add_argument("--primitive", default="point", help="point, line, segment or K-flat")
    _add_format(p)


def _add_derive(commands: Commands) -> None:
    p = _command(commands, "derive", _derive, "how a rate comes about, with equation numbers")
    p.add_argument("sampler", metavar="S")
    p.add_argument("--dim", default="d", metavar="D")
    p.add_argument("--integrand", default="worst", metavar="CLASS")
    p.add_argument("--region", default="overall", metavar="R")
    p.add_argument("--primitive", default="point")
    _add_format(p, ("terminal", "json", "latex", "markdown"))


def _add_check(commands: Commands) -> None:
    p = _command(commands, "check", _check, "test a sampler design against theory")
    p.add_argument("source", nargs="*", metavar="SOURCE", help="sampler, callable or point files")
    p.add_argument("--dim", type=int, metavar="D")
    p.add_argument("--claim", action="append", default=[], metavar="CLAIM", help="repeatable")
    p.add_argument("--integrand", action="append", default=[], metavar="I", help="repeatable")
    p.add_argument("--n", action="append", default=[], type=int, metavar="N", help="repeatable")
    p.add_argument("--budget", type=float, default=10.0, metavar="SECONDS", help="a cap")
    p.add_argument("--seed", type=int, metavar="S", help="0 unless given")
    p.add_argument("--plan", metavar="FILE", help="replay what a document's check executed")
    p.add_argument("--report", metavar="DIR", help="write the page of the check there")
    _add_format(p)


def _add_variance(commands: Commands) -> None:
    p = _command(commands, "variance", _variance, "exact variance at one N, certified")
    p.add_argument("sampler", metavar="S")
    p.add_argument("integrand", metavar="INTEGRAND", help="such as disk:radius=0.3")
    p.add_argument("--dim", required=True, type=int, metavar="D")
    p.add_argument("--n", required=True, metavar="N", help="number of points, such as 1e30")
    p.add_argument("--digits", type=int, default=15, metavar="K")
    p.add_argument("--method", metavar="M", help="a route, else the first that applies")
    _add_format(p)


def _add_radial(commands: Commands) -> None:
    p = _command(commands, "radial", _radial, "Eq. 17 along one region, certified")
    p.add_argument("--degree", required=True, metavar="B", help="degree b of the profile")
    p.add_argument("--dim", required=True, type=int, metavar="s", help="dimension of the region")
    p.add_argument("--decay", required=True, metavar="p", help="decay of P_f; oo: best case")
    p.add_argument("--n", required=True, metavar="N", help="a number, 1e300 or log:5000")
    p.add_argument("--effective", metavar="e", help="N_k = N^e; 1/s unless given")
    p.add_argument("--alpha", default="1", metavar="A")
    p.add_argument("--gamma", default="1", metavar="G")
    p.add_argument("--rho0", default="1", metavar="R")
    p.add_argument("--discontinuous", action="store_true", help="c2 = c as printed in Eq. 16")
    p.add_argument("--digits", type=int, default=15, metavar="K")
    _add_format(p, ("terminal", "json"))


def _add_stress(commands: Commands) -> None:
    p = _command(commands, "stress", _stress, "stiff and extreme cases: is every error honest?")
    p.add_argument(
        "--diagram", metavar="DIR", help="draw error against time there instead, and time ratios"
    )
    p.add_argument(
        "--budget", type=float, metavar="SECONDS", help="of the diagram; 60 unless given"
    )
    p.add_argument("--seed", type=int, metavar="S", help="of the diagram; 0 unless given")
    _add_format(p)


def _dimension(word: str) -> int:
    """A dimension as a number; a symbol is none."""
    if not (word.isascii() and word.isdigit() and int(word) >= 1):
        raise argparse.ArgumentTypeError(f"must be a whole number of at least 1: got {word}")
    return int(word)


def _add_recommend(commands: Commands) -> None:
    p = _command(commands, "recommend", _recommend, "which layouts reach the rates wanted")
    p.add_argument("wanted", nargs="+", metavar="CLAIM", help='"axis/best ~ 3", repeatable')
    p.add_argument("--dim", required=True, type=_dimension, metavar="D")
    _add_format(p)


def _add_prove(commands: Commands) -> None:
    p = _command(commands, "prove", _prove, "re-check the proofs of the paper's equations")
    p.add_argument("names", nargs="*", metavar="ID", help="ids or equations, such as 25; else all")
    p.add_argument("--errata", action="store_true", help="only what is refuted or corrected")
    _add_format(p, ("terminal", "json", "latex", "markdown", "html"))


def _table(a: argparse.Namespace) -> tuple[str, int]:
    from .table_formats import render

    text = render(
        a.sampler, a.dim or ["d"], a.integrand or ["worst", "best"], a.primitive, a.format
    )
    return text, DONE


def _derive(a: argparse.Namespace) -> tuple[str, int]:
    from .derivation_formats import render

    return render(a.sampler, a.dim, a.integrand, a.region, a.primitive, a.format), DONE


def _check(a: argparse.Namespace) -> tuple[str, int]:
    from ..theory.errors import InputError

    if a.plan is None and (not a.source or a.dim is None):
        absent = [w for w, has in (("SOURCE", a.source), ("--dim", a.dim is not None)) if not has]
        raise InputError(
            f"check needs a SOURCE and --dim (or --plan): got no {' and no '.join(absent)}"
        )
    if a.plan is not None and (a.claim or a.integrand or a.n or a.seed is not None):
        raise InputError("--plan brings its own claims, integrands, N and seed: got others as well")
    from ..numerics.checking.check_documents import check, check_with_pictures
    from .check_formats import render

    folder = None if a.report is None else _report_folder(a.report)
    dim = 1 if a.dim is None else a.dim  # a plan names its own
    asked = (a.claim, a.integrand, a.n, a.budget, a.seed or 0, a.plan, _progress)
    pictures = None
    if folder is None:
        document = check(a.source, dim, *asked)
    else:
        document, pictures = check_with_pictures(a.source, dim, *asked)
    verdicts = {"consistent": DONE, "contradicted": CONTRADICTED, "invalid": CONTRADICTED}
    code = (
        INTERRUPTED if document["interrupted"] else verdicts.get(document["verdict"], INCONCLUSIVE)
    )
    if folder is not None:
        from .check_pages import write_report

        written = write_report(document, folder, pictures)
        print(f"written to {folder}: {', '.join(p.name for p in written)}", file=sys.stderr)
    return render(document, a.format), code


def _report_folder(name: str) -> Path:
    from .work_precision_figures import require_matplotlib

    require_matplotlib()
    return _folder(name)


def _recommend(a: argparse.Namespace) -> tuple[str, int]:
    from .recommendation_formats import render

    return render(a.wanted, a.dim, a.format), DONE


def _radial(a: argparse.Namespace) -> tuple[str, int]:
    from ..numerics import radial
    from .radial_formats import render

    found = radial(
        a.degree,
        a.dim,
        a.decay,
        a.n,
        a.effective,
        a.alpha,
        a.gamma,
        a.rho0,
        a.discontinuous,
        a.digits,
    )
    return render(found, a.format), DONE


def _variance(a: argparse.Namespace) -> tuple[str, int]:
    from ..numerics import variance
    from .variance_formats import render, shortfall

    found = variance(a.sampler, a.integrand, a.dim, a.n, a.digits, a.method)
    if missing := shortfall(found, a.digits):
        print(f"specrate: {missing}", file=sys.stderr)
    return render(found, a.format), DONE


def _stress(a: argparse.Namespace) -> tuple[str, int]:
    from ..theory.errors import InputError

    if a.diagram is not None:
        return _diagram(a)
    if a.budget is not None or a.seed is not None:
        raise InputError("--budget and --seed must come with --diagram: got them without")
    from ..numerics.method_tests import stress_cases
    from ..numerics.method_tests.stress import stress
    from .stress_formats import render

    document = stress(stress_cases.FAMILIES, _progress)
    _progress("")
    code = DONE if document["honest"] else CONTRADICTED
    return render(document, a.format), INTERRUPTED if document["interrupted"] else code


def _diagram(a: argparse.Namespace) -> tuple[str, int]:
    from ..numerics.method_tests.work_precision import work_precision
    from ..theory.errors import InputError
    from .work_precision_figures import draw, require_matplotlib
    from .work_precision_formats import render

    require_matplotlib()
    budget, seed = 60.0 if a.budget is None else a.budget, a.seed or 0
    if not 0 < budget < float("inf") or seed < 0:
        raise InputError(f"a diagram needs 0 < budget and 0 <= seed: got {budget} and {seed}")
    folder = _folder(a.diagram)
    document = work_precision(budget, seed, _progress)
    _progress("")
    for form in ("json", "csv"):
        _write(render(document, form), str(folder / f"work_precision.{form}"))
    draw(document, [folder / f"work_precision.{form}" for form in ("png", "svg")])
    print(f"written to {folder}: work_precision.json, .csv, .png, .svg", file=sys.stderr)
    return render(document, a.format), DONE


def _prove(a: argparse.Namespace) -> tuple[str, int]:
    from ..proofs import prove
    from .proof_formats import render

    found = prove(a.names, a.errata, os.cpu_count() or 1, _progress)
    _progress("")
    code = DONE if found.is_accepted else CONTRADICTED
    text = render(found, a.format, whole=bool(a.names), errata=a.errata)
    return text, INTERRUPTED if found.is_interrupted else code


def _folder(name: str) -> Path:
    """A folder that can be written to, made if need be, before time is spent on what goes there."""
    from ..theory.errors import InputError

    folder = Path(name)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"a folder must be writable: got {error.strerror} for {name}") from None
    return folder


def _progress(text: str) -> None:
    """A line of progress on stderr, replaced by the next one on a terminal."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()


if __name__ == "__main__":
    sys.exit(main())
