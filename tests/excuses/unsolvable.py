"""Tasks that are known to be unsolvable go in; what is proven of them comes out, and whatever is said wrongly.

    python3 tests/excuses/unsolvable.py                      # `caveat excuse` and `caveat plan` on unsolvable.txt, 30 s each
    python3 tests/excuses/unsolvable.py --verbs excuse --again
    python3 tests/excuses/unsolvable.py --report

An excuse, and the proof that there is none, are proofs that the task is unsolvable. Rows are kept in target/bench/unsolvable.tsv until
--again. The program is CAVEAT or --caveat; files are looked for in CAVEAT_SHARED, or else in the folder `shared` beside the repository.
"""

import argparse
from pathlib import Path

import measure
import meter
import tables

COLUMNS = ["task", "verb", "verdict", "exit", "status", "cost", "cpu", "program"]
VERBS = ["excuse", "plan"]
SECONDS = 30


def excuse(options, domain, problem):
    """What `caveat excuse` says of a task."""
    run = measure.excuse(options, "--output-format", "json", domain, problem)
    answer = measure.answer_of(run)
    status = answer.get("status", "-")
    if status == "solvable" or run.code == 10:
        verdict = "solvable"
    elif status in ("excuse", "none") or answer.get("unsolvable") is True:
        verdict = "unsolvable"
    else:
        verdict = "unknown" if run.code in (12, None) else "failed"
    return run, {"verdict": verdict, "status": status, "cost": answer.get("cost", "-")}


def plan(options, domain, problem):
    """What `caveat plan` says of a task."""
    with meter.Folder() as folder:
        run = meter.run([options.caveat, "plan", *measure.limits(SECONDS), domain, problem], SECONDS + 5, folder)
    verdicts = {0: "solvable", 1: "solvable", 2: "solvable", 3: "solvable", 10: "unsolvable", 11: "unsolvable"}
    return run, {"verdict": verdicts.get(run.code, "failed" if run.code in (31, 32, 34, 36) else "unknown")}


def report(rows):
    """The table by verb, and the tasks of which something wrong was said."""
    def names(verb, verdict):
        return [row["task"] for row in rows.rows.values() if row["verb"] == verb and row["verdict"] == verdict]

    lines = [["unsolvable, proven", "unsolvable"], ["unknown within the limits", "unknown"], ["could not run", "failed"],
             ["said to be solvable", "solvable"]]
    text = tables.table(["", *(f"`caveat {verb}`" for verb in VERBS)],
                        [[title, *(len(names(verb, verdict)) for verb in VERBS)] for title, verdict in lines])
    excuses = [row for row in rows.rows.values() if row["status"] in ("excuse", "none")]
    text += f"\n\nOf {len({row['task'] for row in rows.rows.values()})} tasks, {sum(row['status'] == 'excuse' for row in excuses)} have an excuse"
    text += f" and {sum(row['status'] == 'none' for row in excuses)} are proven to have none."
    for verb in VERBS:
        for verdict in ("solvable", "failed"):
            text += "".join(f"\n- `caveat {verb}` on {task}: {verdict}" for task in names(verb, verdict))
    return text


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=meter.CAVEAT, help="the program to measure")
    options.add_argument("--verbs", nargs="+", choices=VERBS, default=VERBS)
    options.add_argument("--rows", type=Path, default=meter.BENCH / "unsolvable.tsv")
    options.add_argument("--again", action="store_true", help="forget the rows of these verbs")
    options.add_argument("--report", action="store_true", help="measure nothing")
    options = options.parse_args()
    options.excuse = []
    rows = meter.Rows(options.rows, COLUMNS, keys=2)
    if not options.report:
        program, options.caveat = meter.program(options.caveat), options.caveat.resolve()
        if options.again:
            rows.forget(lambda row: row["verb"] not in options.verbs)
        for verb in options.verbs:
            for name, domain, problem in meter.listed("unsolvable.txt", "unsolvable"):
                if not rows.get(name, verb):
                    run, values = {"excuse": excuse, "plan": plan}[verb](options, domain.resolve(), problem.resolve())
                    rows.add(task=name, verb=verb, exit=measure.code(run), cpu=f"{run.cpu:.3f}", program=program, **values)
    print(report(rows))


if __name__ == "__main__":
    main()
