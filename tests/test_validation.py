"""The long validation of `check`: its file, its tables, its exit code, and that it continues."""

import inspect
import json
from pathlib import Path

import pytest
from specrate.numerics.checking import validation
from specrate.numerics.checking.check_documents import check
from specrate.numerics.checking.known_truths import FAILING, HOLDING
from specrate.numerics.checking.validation import (
    DEFAULT_BUDGET,
    Ended,
    Task,
    append,
    code_digest,
    held,
    main,
    run,
    table,
    title,
)

RIGHT, WRONG = HOLDING[0], FAILING[0]
ONLY = ["--only", title(RIGHT), "--only", title(WRONG), "--budget", "2", "--jobs", "1"]
FINE = {True: Ended("consistent", (), 1.0), False: Ended("contradicted", ("region 2",), 0.5)}


def of_truth(task):
    return FINE[task.design == title(RIGHT)]


@pytest.fixture
def ran(monkeypatch):
    """Tasks that were run: none is, all end as they should but for what ``answers`` says."""
    tasks = []

    def instead(answers=None, last=None):
        def results(run, wanted, jobs):
            for task in wanted:
                if last is not None and len(tasks) == last:
                    raise KeyboardInterrupt
                tasks.append(task)
                yield task, (answers or {}).get(task, of_truth(task))

        monkeypatch.setattr(validation, "results", results)
        return tasks

    return instead


def rows(text, design):
    """Cells of the rows on a design, one for each part."""
    lines = [line for line in text.splitlines() if line.startswith(f"| {design}")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_the_default_budget_is_that_of_a_check():
    assert inspect.signature(check).parameters["budget"].default == DEFAULT_BUDGET


def test_every_design_once_then_over_seeds(ran, capsys):
    tasks = ran()
    assert main([*ONLY, "--seeds", "3", "--defect-seeds", "2"]) == 0
    both = (title(RIGHT), title(WRONG))
    first = [Task(d, DEFAULT_BUDGET, 0) for d in both]
    second = [Task(d, 2.0, seed) for seed in range(2) for d in both]
    assert tasks == [*first, *second, Task(title(RIGHT), 2.0, 2)]
    text = capsys.readouterr().out
    assert [r[3] for r in rows(text, "random, 2D")] == ["1", "3"]
    # Clopper and Pearson: 0 of 3 leaves probabilities up to 1 - 0.025^(1/3).
    assert rows(text, "random, 2D")[1][4:] == [
        *("3", "0", "0", "0"),
        *("100 [29.2, 100]", "0 [0, 70.8]", "1.00"),
    ]
    assert rows(text, "all others")[1][3:8] == ["2", "0", "0", "2", "0"]
    assert "no verdict is wrong" in text


def test_an_interrupt_loses_nothing_and_the_next_run_continues(ran, tmp_path, capsys):
    path = tmp_path / "results.jsonl"
    arguments = [*ONLY, "--seeds", "4", "--defect-seeds", "4", "--output", str(path)]
    tasks = ran(last=3)
    assert main(arguments) == 130
    assert "the same command continues" in capsys.readouterr().err
    assert len(path.read_text().splitlines()) == 3
    with path.open("a") as file:
        file.write('{"design": "cut sh')
    first = list(tasks)
    tasks.clear()
    ran()
    assert main(arguments) == 0
    assert not set(tasks) & set(first)
    assert len(tasks) + len(first) == 10
    tasks.clear()
    assert main(arguments) == 0
    assert tasks == []
    assert [r[3] for r in rows(capsys.readouterr().out, "random, 2D")[-2:]] == ["1", "4"]


def test_results_of_other_code_do_not_count(tmp_path):
    path, task = tmp_path / "results.jsonl", Task("a", 2.0, 0)
    append(path, task, FINE[True])
    assert held(path) == {task: FINE[True]}
    row = json.loads(path.read_text())
    path.write_text(json.dumps(row | {"code": code_digest()[::-1]}))
    assert held(path) == {}
    assert held(tmp_path / "absent.jsonl") == held(None) == {}


@pytest.mark.parametrize(
    ("task", "ended", "line"),
    [
        (
            Task(title(RIGHT), 2.0, 1),
            Ended("contradicted", ("region 1",), 1.0),
            f"wrong: {title(RIGHT)}, budget 2 s, seed 1: contradicted for region 1",
        ),
        (
            Task(title(WRONG), DEFAULT_BUDGET, 0),
            Ended("consistent", (), 1.0),
            f"wrong: {title(WRONG)}, budget 10 s, seed 0: consistent for nothing",
        ),
        (
            Task(title(WRONG), DEFAULT_BUDGET, 0),
            Ended("inconclusive", (), 9.9),
            f"missed: {title(WRONG)}, budget 10 s",
        ),
    ],
)
def test_wrong_and_missed_verdicts_are_told(ran, capsys, task, ended, line):
    ran({task: ended})
    assert main([*ONLY, "--seeds", "2"]) == 1
    assert line in capsys.readouterr().out.splitlines()


def test_a_small_budget_may_leave_a_defect_open(ran):
    ran({Task(title(WRONG), 2.0, 0): Ended("inconclusive", (), 2.0)})
    assert main([*ONLY, "--seeds", "2"]) == 0


def test_a_table_without_results_has_no_shares():
    *_, last = table([WRONG], {}, 2.0)
    assert last.split("|")[4:-1] == [" 0 "] * 5 + [" - "] * 3


def test_processes_run_what_a_process_runs():
    """Files of one set are judged in milliseconds; interrupts are left to the parent."""
    truth = next(t for t in FAILING if t.name == "jitter, files of one set")
    task = Task(title(truth), 5.0, 0)
    ((told, ended),) = validation.results(validation.run, [task], 1)
    here = run(task)
    assert told == task
    assert (ended.verdict, ended.reasons) == (here.verdict, here.reasons)
    assert (ended.verdict, ended.is_wrong_on(truth)) == ("invalid", False)


def test_the_digest_is_that_of_the_code(monkeypatch, tmp_path):
    """A changed file in a room that a check rests on changes it."""
    for room in ("theory", "numerics"):
        (tmp_path / room / "checking").mkdir(parents=True)
    monkeypatch.setattr(validation, "__file__", str(tmp_path / "numerics" / "checking" / "v.py"))
    digests = set()
    for text in ("a = 1", "a = 2"):
        Path(tmp_path / "theory" / "a.py").write_text(text)
        code_digest.cache_clear()
        digests.add(code_digest())
    code_digest.cache_clear()
    assert len(digests) == 2
