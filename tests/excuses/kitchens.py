"""Kitchens of growing size go in; the costs and times of three ways to find their excuses come out.

    FAST_DOWNWARD=PATH/fast-downward.py python3 tests/excuses/kitchens.py
    python3 tests/excuses/kitchens.py --ways ours --repeat 5 --again
    python3 tests/excuses/kitchens.py --report

`naive`: breadth first over sets of ground atoms that become true or false, all but those of the goal; each set is written as a problem and
    given to a process of Fast Downward (a greedy search), until one has a plan or 240 s are used up. What is larger than a task where
    that happened is left out.
`compile`: the task of `caveat excuse --export`, solved by a process of Fast Downward with astar(lmcut()), 120 s.
`ours`: `caveat excuse`, the whole process and the seconds that it says it has searched.
All times are CPU times, the least of --repeat runs for `ours`. Rows are kept in target/bench/kitchens.tsv until --again. The kitchens are
made by `cargo run -p caveat-domains --example kitchen`, or by the program that --kitchen names. The program is CAVEAT or --caveat.
"""

import argparse
import itertools
import os
import subprocess
import sys
from pathlib import Path

import expressions
import measure
import meter
import tables

TASKS = [(2, "I", 1), (2, "II", 1), (2, "I", 2), (3, "I", 2), (4, "II", 3), (5, "II", 5), (6, "II", 4), (8, "II", 6), (10, "II", 8), (30, "II", 24)]
WAYS = ["naive", "compile", "ours"]
COLUMNS = ["task", "way", "end", "cost", "count", "cpu", "seconds", "program"]
NAIVE, COMPILED, OURS = 240, 120, 60


def make(task, options):
    """The texts of the domain and the problem of a kitchen."""
    with meter.Folder() as folder:
        words = [str(word) for word in task] + [str(folder)]
        cargo = ["cargo", "run", "--quiet", "-p", "caveat-domains", "--example", "kitchen", "--"]
        subprocess.run([str(options.kitchen.resolve()), *words] if options.kitchen else cargo + words, check=True, cwd=meter.ROOT)
        return (folder / "domain.pddl").read_text(), (folder / "problem.pddl").read_text()


def candidates(domain, problem):
    """All ground atoms that the predicates and the types allow, without those of the goal."""
    domain, problem = expressions.read(domain), expressions.read(problem)
    above = {"object": None}
    if types := expressions.section(domain, ":types"):
        above |= {name.word: kind.word if kind else "object" for name, kind in expressions.typed(types.items[1:])}
    members = {}
    for tree, part in ((domain, ":constants"), (problem, ":objects")):
        if found := expressions.section(tree, part):
            for name, kind in expressions.typed(found.items[1:]):
                kind = kind.word if kind else "object"
                while kind:
                    members.setdefault(kind, []).append(name.word)
                    kind = above.get(kind, "object" if kind != "object" else None)
    goal, atoms = set(expressions.patterns(problem)), []
    for predicate in expressions.section(domain, ":predicates").items[1:]:
        kinds = [kind.word if kind else "object" for _, kind in expressions.typed(predicate.items[1:])]
        for names in itertools.product(*(members.get(kind, []) for kind in kinds)):
            atoms.append((predicate.head(), *names))
    return [words for words in atoms if words not in goal]


def naive(domain, problem):
    """One process for each set of changes."""
    atoms = candidates(domain, problem)
    there = {words for words, _ in expressions.facts(expressions.read(problem))}
    calls, cpu = 0, 0.0
    for size in range(1, len(atoms) + 1):
        for chosen in itertools.combinations(atoms, size):
            text = expressions.edited(problem, [(words, None) if words in there else (None, words) for words in chosen])
            run, _ = measure.peer(domain, text, "lazy_greedy([ff()])", 60)
            calls, cpu = calls + 1, cpu + run.cpu
            if run.code == 0:
                return {"end": "found", "cost": size, "count": calls, "cpu": f"{cpu:.2f}"}
            if cpu > NAIVE:
                return {"end": "stopped", "cost": "-", "count": calls, "cpu": f"{cpu:.2f}"}
    return {"end": "none", "count": calls, "cpu": f"{cpu:.2f}"}


def compiled(options, domain, problem):
    """The compilation by Fast Downward."""
    with meter.Folder() as folder:
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)
        export = measure.excuse(options, "--export", folder / "task", folder / "domain.pddl", folder / "problem.pddl")
        try:
            texts = [(folder / "task" / name).read_text() for name in ("domain.pddl", "problem.pddl")]
        except OSError:
            return {"end": f"no export: exit {measure.code(export)}"}
    run, cost = measure.peer(*texts, "astar(lmcut())", COMPILED)
    end = "found" if run.code == 0 else "stopped" if run.code in (None, 21, 22, 23, 24) else f"exit {run.code}"
    expanded = next((line.split("Expanded ")[1].split()[0] for line in run.out.splitlines() if "] Expanded " in line and "until" not in line), "-")
    return {"end": end, "cost": cost or "-", "count": expanded, "cpu": f"{run.cpu:.2f}"}


def ours(options, domain, problem):
    """The program under test."""
    best = None
    with meter.Folder() as folder:
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)
        for _ in range(options.repeat):
            run = measure.excuse(options, "--output-format", "json", folder / "domain.pddl", folder / "problem.pddl", seconds=OURS)
            if best is None or run.cpu < best.cpu:
                best = run
    answer = measure.answer_of(best)
    seconds = answer.get("statistics", {}).get("seconds")
    proven = "" if answer.get("proven", True) else ", not proven"
    return {"end": answer.get("status", f"exit {measure.code(best)}") + proven, "cost": answer.get("cost", "-"),
            "count": len(answer.get("excuses", [])), "cpu": f"{best.cpu:.4f}", "seconds": "-" if seconds is None else f"{seconds:.5f}"}


def label(task):
    return ",".join(map(str, task))


def report(rows):
    """The table of the three ways, and what ours gains."""
    def cell(row):
        if row is None:
            return "·"
        time = f"{float(row['cpu']):.2f} s" if row["cpu"] != "-" else ""
        cost = f", cost {row['cost']}" if row["end"] == "found" else ""
        if row["way"] == "naive":
            return f"{'>' if row['end'] == 'stopped' else ''}{time}, {row['count']} calls{cost}"
        if not cost:
            return f"{row['end']} {time}".strip()
        return time + cost + (f", {row['count']} expanded" if row["count"] != "-" else "")

    def gain(row, mine):
        if not row or not mine or row["cpu"] == "-" or row["end"] not in ("found", "stopped") or not mine["end"].startswith("excuse"):
            return "·"
        return f"{'>' if row['end'] == 'stopped' else ''}{float(row['cpu']) / max(float(mine['cpu']), 0.0001):.0f}×"

    lines = []
    for task in map(label, TASKS):
        simple, compilation, mine = (rows.get(task, way) for way in WAYS)
        if mine and mine["end"].startswith("excuse"):
            seconds = mine["seconds"] if mine["seconds"] == "-" else f"{float(mine['seconds']):.4f} s"
            here = [f"{float(mine['cpu']):.3f} s", seconds, f"{mine['cost']}, {mine['count']} shown"]
        else:
            here = [mine["end"] if mine else "·", "·", "·"]
        lines.append([task, cell(simple), cell(compilation), *here, gain(simple, mine), gain(compilation, mine)])
    head = ["kitchen (n, scenario, goals)", "naive + Fast Downward", "compilation + `astar(lmcut())`", "ours, process", "ours, search", "cost, excuses",
            "naive / ours", "compilation / ours"]
    return tables.table(head, lines)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=meter.CAVEAT, help="the program to measure")
    options.add_argument("--kitchen", type=Path, default=os.environ.get("KITCHEN"), help="the built generator")
    options.add_argument("--ways", nargs="+", choices=WAYS, default=WAYS)
    options.add_argument("--rows", type=Path, default=meter.BENCH / "kitchens.tsv")
    options.add_argument("--repeat", type=int, default=5, help="take the least of so many runs of ours")
    options.add_argument("--again", action="store_true", help="forget the rows of these ways")
    options.add_argument("--report", action="store_true", help="measure nothing")
    options = options.parse_args()
    options.kitchen, options.excuse = options.kitchen and Path(options.kitchen), []
    rows = meter.Rows(options.rows, COLUMNS, keys=2)
    if options.again and not options.report:
        rows.forget(lambda row: row["way"] not in options.ways)
    if not options.report:
        program, options.caveat = meter.program(options.caveat), options.caveat.resolve()
        if not meter.PEER and options.ways != ["ours"]:
            sys.exit("name the driver of Fast Downward in FAST_DOWNWARD, or measure `--ways ours` only")
        for way in options.ways:
            for task in TASKS:
                row = rows.get(label(task), way)
                if row is None or row["end"].startswith("no export"):
                    domain, problem = make(task, options)
                    values = {"naive": lambda: naive(domain, problem), "compile": lambda: compiled(options, domain, problem),
                              "ours": lambda: ours(options, domain, problem)}[way]()
                    row = rows.add(task=label(task), way=way, program=program, **values)
                if way == "naive" and row["end"] == "stopped":
                    break
    print(report(rows))


if __name__ == "__main__":
    main()
