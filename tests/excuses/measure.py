"""Broken tasks go in; their excuses come out, judged by planning, by the compilation to classical planning and by trying everything smaller.

    python3 tests/excuses/break_tasks.py
    python3 tests/excuses/measure.py                         # all parts, then the table
    python3 tests/excuses/measure.py --parts find verify --only blocks --again
    python3 tests/excuses/measure.py --report                # the table of what has been measured

The parts, each with its rows in target/bench/excuses-PART.tsv:
`find`        `caveat excuse` with 30 s of CPU time and 6 GiB; its answers are kept as target/bench/excuses/NAME.json.
`verify`      The edits of each excuse are made in the text of the problem by this script, and its plan is validated there; on the first one
              `caveat plan` runs, too, and its plan is validated. Edits must not touch atoms of the goal.
`compile`     The task of `caveat excuse --export` is solved by `caveat plan --optimal`, and by Fast Downward with astar(lmcut()) where
              FAST_DOWNWARD names its driver. The costs must be those of `find`. The compilation knows no new objects: where an excuse
              makes one, `caveat excuse --new-objects 0` is asked for the cost to compare with.
`exhaustive`  Everything that `caveat excuse --variables` allows and that costs less than the excuse (everything at all where there is none)
              is tried, if that is at most 3000 states: each must be unsolvable, or break a group of atoms that exclude each other, or
              satisfy the goal at once. New objects are left out here, too.
A run can be stopped and started again. Rows of `verify`, `compile` and `exhaustive` hold as long as what they judge is the same; rows of
`find` stay until --again, or --failed for those without an answer. The program is CAVEAT or --caveat.
"""

import argparse
import json
import sys
from pathlib import Path

import expressions
import meter
import tables

SECONDS = 30
# States to try at most, seconds of CPU time for each, and for all of a task together.
STATES, EACH, TOGETHER = 3000, 5, 600
PARTS = {
    "find": ["name", "exit", "status", "proven", "cost", "excuses", "edits", "objects", "cpu", "seconds", "program", "said"],
    "plain": ["name", "exit", "status", "proven", "cost", "program"],
    "verify": ["name", "input", "applied", "goal", "costs", "own", "exit", "valid", "steps"],
    "compile": ["name", "input", "export", "exit", "cost", "cpu", "peer-exit", "peer-cost", "peer-cpu", "said"],
    "exhaustive": ["name", "input", "limit", "states", "broken", "unsolvable", "satisfied", "unknown", "solvable", "verdict", "cpu"],
}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=meter.CAVEAT, help="the program to measure")
    options.add_argument("--broken", type=Path, default=meter.BENCH / "broken", help="the folder of the broken tasks")
    options.add_argument("--rows", type=Path, default=meter.BENCH, help="the folder of the rows")
    steps = {"find": find, "verify": verify, "compile": compiled, "exhaustive": exhaustive}
    options.add_argument("--parts", nargs="+", choices=steps, default=list(steps))
    options.add_argument("--only", nargs="+", default=[""], help="only tasks with one of these in their names")
    options.add_argument("--again", action="store_true", help="forget the rows of these parts and tasks")
    options.add_argument("--failed", action="store_true", help="forget the rows of tasks where the program crashed")
    options.add_argument("--report", action="store_true", help="measure nothing")
    options.add_argument("--excuse", nargs=argparse.REMAINDER, default=[], help="more options for `caveat excuse`; the last of all")
    options = options.parse_args()
    options.answers = options.rows / "excuses"
    options.answers.mkdir(parents=True, exist_ok=True)
    index = meter.Rows(options.broken / "index.tsv", ["name", "origin", "way", "k", "proof", "tries", "removed"])
    if not index.rows:
        sys.exit("There are no broken tasks; run break_tasks.py")
    chosen = [row["name"] for row in index.rows.values() if row["proof"] != "none" and any(word in row["name"] for word in options.only)]
    rows = {part: meter.Rows(options.rows / f"excuses-{part}.tsv", columns) for part, columns in PARTS.items()}
    if not options.report:
        options.program, options.caveat = meter.program(options.caveat), options.caveat.resolve()
        if options.failed:
            rows["find"].forget(lambda row: row["status"] != "-")
        for part in options.parts:
            if options.again:
                for gone in [part, *(["plain"] if part == "find" else [])]:
                    rows[gone].forget(lambda row: row["name"] not in chosen)
            for name in chosen:
                steps[part](name, rows, options)
    print(tables.broken(index.rows.values(), {part: {name: row for (name,), row in table.rows.items()} for part, table in rows.items()}))


def files(name, options):
    return options.broken.resolve() / name / "domain.pddl", options.broken.resolve() / name / "problem.pddl"


def limits(seconds):
    """The limits as options of the program."""
    return ["--time-limit", f"{seconds}s", "--memory-limit", meter.MEMORY]


def excuse(options, *words, seconds=SECONDS):
    """Runs the program under test. It may take a second more than it was told to, and is stopped after five."""
    with meter.Folder() as folder:
        return meter.run([options.caveat, "excuse", *limits(seconds), *words, *options.excuse], seconds + 5, folder)


def answer_of(run):
    """The answer in the output of a run, with an empty one where there is none."""
    try:
        answer = json.loads(run.out)
    except ValueError:
        answer = None
    return answer if isinstance(answer, dict) else {}


def find(name, rows, options):
    """One task: the answer of the program."""
    if rows["find"].get(name):
        return
    run = excuse(options, "--output-format", "json", *files(name, options))
    answer = answer_of(run)
    excuses = answer.get("excuses", [])
    edits = excuses[0]["edits"] if excuses else []
    (options.answers / f"{name}.json").write_text(run.out)
    rows["find"].add(
        name=name, exit=code(run), status=answer.get("status", "-"), proven=answer.get("proven", "-"), cost=answer.get("cost", "-"),
        excuses=len(excuses), edits=len(edits), objects=sum("object" in edit for edit in edits), cpu=f"{run.cpu:.3f}",
        seconds=answer.get("statistics", {}).get("seconds", "-"), program=options.program, said=run.said() if not answer else "-")


def plain(name, rows, options):
    """The row of `find`, or where its excuse makes objects that of an answer without them."""
    row = rows["find"].get(name)
    if row is None or row["objects"] == "0":
        return row
    if (known := rows["plain"].get(name)) and known["program"] == row["program"]:
        return known
    run = excuse(options, "--output-format", "json", "--new-objects", "0", *files(name, options))
    answer = answer_of(run)
    return rows["plain"].add(name=name, exit=code(run), status=answer.get("status", "-"), proven=answer.get("proven", "-"),
                             cost=answer.get("cost", "-"), program=row["program"])


def code(run):
    return "time" if run.code is None else run.code


def pairs(edits):
    """The edits of an answer as pairs of atoms; the objects that it makes are left out."""
    return [(edit["from"] and expressions.atom(edit["from"]), edit["to"] and expressions.atom(edit["to"]))
            for edit in edits if "object" not in edit]


def changed(problem, edits):
    """The text of a problem after the edits of an answer."""
    for edit in edits:
        if "object" in edit:
            problem = expressions.with_object(problem, edit["object"].lower(), edit["type"].lower())
    return expressions.edited(problem, pairs(edits))


def solve(options, domain, problem, *words, seconds):
    """Plans for a task of two texts: the run, the steps and the cost of the plan, and the exit code of the validator."""
    with meter.Folder() as folder:
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)
        run = meter.run([options.caveat, "plan", *limits(seconds), *words, "domain.pddl", "problem.pddl"], seconds + 5, folder)
        plan = folder / "sas_plan"
        if run.code not in (0, 1, 2) or not plan.exists():
            return run, None, None, None
        steps, cost = read_plan(plan.read_text())
        valid = meter.run([options.caveat, "validate", "domain.pddl", "problem.pddl", "sas_plan"], SECONDS, folder).code
    return run, steps, cost, valid


def read_plan(text):
    """The number of steps of a plan, and its cost where that is said."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    costs = [line.split("=")[1].split()[0] for line in lines if line.startswith("; cost")]
    return sum(not line.startswith(";") for line in lines), costs[-1] if costs else None


def verify(name, rows, options):
    """The excuses of one task: are they what they say?"""
    path = options.answers / f"{name}.json"
    if not rows["find"].get(name) or rows["find"].get(name)["status"] != "excuse" or not path.exists():
        return
    answer = json.loads(path.read_text())
    answer.pop("statistics", None)
    domain, problem = (path.read_text() for path in files(name, options))
    stamp = meter.digest(json.dumps(answer, sort_keys=True), domain, problem)
    if (known := rows["verify"].get(name)) and known["input"] == stamp:
        return
    goal = expressions.patterns(expressions.read(problem))
    applied, touched, costs, good = "yes", [], "as said", 0
    for one in answer["excuses"]:
        try:
            text = changed(problem, one["edits"])
        except (ValueError, KeyError) as error:
            applied = f"no: {error}"
            continue
        touched += [word for edit in pairs(one["edits"]) for word in edit if word and any(expressions.matches(pattern, word) for pattern in goal)]
        if not one["cost"] == sum(edit["cost"] for edit in one["edits"]) == answer["cost"]:
            costs = f"{one['cost']} is not the sum, or not least"
        with meter.Folder() as folder:
            (folder / "domain.pddl").write_text(domain)
            (folder / "problem.pddl").write_text(text)
            (folder / "plan").write_text("\n".join(one["plan"]) + "\n")
            good += bool(one["plan"]) and meter.run([options.caveat, "validate", "domain.pddl", "problem.pddl", "plan"], SECONDS, folder).code == 0
    run = steps = valid = None
    if applied == "yes":
        run, steps, _, valid = solve(options, domain, changed(problem, answer["excuses"][0]["edits"]), seconds=SECONDS)
    rows["verify"].add(
        name=name, input=stamp, applied=applied, goal=expressions.written(touched[0]) if touched else "free", costs=costs,
        own=f"{good}/{len(answer['excuses'])}", exit=code(run) if run else "-", valid=shown(valid), steps=shown(steps))


def shown(value):
    return "-" if value is None else value


def compiled(name, rows, options):
    """One task by the compilation."""
    if not rows["find"].get(name):
        return
    with meter.Folder() as folder:
        run = excuse(options, "--export", folder / "task", *files(name, options))
        try:
            domain, problem = ((folder / "task" / file).read_text() for file in ("domain.pddl", "problem.pddl"))
        except OSError:
            domain = problem = ""
    stamp = meter.digest(domain, problem)
    known = rows["compile"].get(name)
    if known and known["input"] == stamp and (known["peer-exit"] != "-" or not meter.PEER):
        plain(name, rows, options)
        return
    values = {"name": name, "input": stamp, "export": code(run), "said": run.said() if run.code else "-"}
    if domain:
        own, _, cost, _ = solve(options, domain, problem, "--optimal", seconds=SECONDS)
        values |= {"exit": code(own), "cost": shown(cost), "cpu": f"{own.cpu:.3f}"}
        if meter.PEER:
            there, cost = peer(domain, problem, "astar(lmcut())", SECONDS)
            values |= {"peer-exit": code(there), "peer-cost": shown(cost), "peer-cpu": f"{there.cpu:.3f}"}
    plain(name, rows, options)
    rows["compile"].add(**values)


def peer(domain, problem, search, seconds):
    """Runs Fast Downward on a task of two texts: the run, and the cost of its plan."""
    with meter.Folder() as folder:
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)
        driver = [sys.executable, meter.PEER] if meter.PEER.endswith(".py") else [meter.PEER]
        run = meter.run([*driver, "--overall-time-limit", f"{seconds}s", "domain.pddl", "problem.pddl", "--search", search], seconds, folder)
        plan = folder / "sas_plan"
        return run, read_plan(plan.read_text())[1] if run.code == 0 and plan.exists() else None


def states(variables, most, cost=0, place=0, chosen=()):
    """All sets of edits, one of a variable at most, that together cost at most so much; without bound where that is nothing."""
    yield chosen
    for here in range(place, len(variables)):
        variable = variables[here]
        for value in variable["values"]:
            if value["to"] != variable["from"] and (most is None or cost + value["cost"] <= most):
                edit = (variable["from"], value["to"])
                yield from states(variables, most, cost + value["cost"], here + 1, (*chosen, edit))


def breaks(groups, initial, edits):
    """Whether edits lead to a state that breaks a group of which they change something."""
    gone, come = {before for before, _ in edits if before}, {after for _, after in edits if after}
    state = (initial - gone) | come
    for atoms, exactly in groups:
        if atoms & (gone | come):
            count = len(atoms & state)
            if count > 1 or exactly and count == 0:
                return True
    return False


def exhaustive(name, rows, options):
    """One task: everything that is smaller than its excuse."""
    row = plain(name, rows, options)
    if row is None or row["status"] not in ("excuse", "none") or row["proven"].lower() != "true":
        return
    most = None if row["status"] == "none" else int(row["cost"]) - 1
    domain, problem = (path.read_text() for path in files(name, options))
    cpu = 0.0
    run = excuse(options, "--variables", 1_000_000_000 if most is None else max(most, 1), "--output-format", "json", *files(name, options))
    try:
        answer = json.loads(run.out)
        variables = answer["variables"] if isinstance(answer, dict) else answer
        groups = [({expressions.atom(word) for word in group["atoms"]}, group["exactly"])
                  for group in (answer.get("groups", []) if isinstance(answer, dict) else [])]
    except (ValueError, KeyError, TypeError):
        rows["exhaustive"].add(name=name, input="-", limit=shown(most), verdict=f"no variables: exit {code(run)}")
        return
    stamp = meter.digest(json.dumps(answer, sort_keys=True), domain, problem, str(most))
    if (known := rows["exhaustive"].get(name)) and known["input"] == stamp:
        return
    tried = []
    for edits in states(variables, most):
        tried.append(edits)
        if len(tried) > STATES:
            rows["exhaustive"].add(name=name, input=stamp, limit=shown(most), states=f">{STATES}", verdict="too many")
            return
    initial = {words for words, _ in expressions.facts(expressions.read(problem))}
    count = {"broken": 0, "unsolvable": 0, "satisfied": 0, "unknown": 0}
    solvable, verdict = None, None
    for edits in tried:
        edits = [(before and expressions.atom(before), after and expressions.atom(after)) for before, after in edits]
        if breaks(groups, initial, edits):
            count["broken"] += 1
            continue
        if cpu > TOGETHER:
            verdict = "stopped"
            break
        run, steps, _, _ = solve(options, domain, expressions.edited(problem, edits), seconds=EACH)
        cpu += run.cpu
        if run.code in (10, 11):
            count["unsolvable"] += 1
        elif run.code == 0 and steps == 0:
            count["satisfied"] += 1
        elif run.code == 0:
            solvable = " ".join(f"{expressions.written(before) if before else 'nothing'}>{expressions.written(after) if after else 'nothing'}"
                                for before, after in edits) or "as it is"
            break
        else:
            count["unknown"] += 1
    verdict = "refuted" if solvable else verdict or ("confirmed" if not count["unknown"] else "partly")
    rows["exhaustive"].add(name=name, input=stamp, limit=shown(most), states=len(tried), solvable=shown(solvable), verdict=verdict,
                           cpu=f"{cpu:.1f}", **count)


if __name__ == "__main__":
    main()
