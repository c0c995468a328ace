"""Solvable tasks go in; the same tasks made unsolvable in three ways come out, with an index of what was removed.

    python3 tests/excuses/break_tasks.py                       # the tasks of tests/excuses/broken.tsv
    python3 tests/excuses/break_tasks.py --search INDEX.tsv    # another choice, written to INDEX.tsv

The ways: `facts` removes k facts of the initial state, with k = 1, 2, 3 in turn; `operator` removes an action; `object` removes an object
that the goal does not name, with all that the initial state says of it. The tasks are written to target/bench/broken/NAME/ (or --out) as
domain.pddl and problem.pddl, and target/bench/broken/index.tsv has a row for each. The search takes tasks of `opt.txt` that
`caveat plan` solves in 5 s of CPU time: rounds go over the families of domains (`openstacks-opt08-adl` and `openstacks` are one), with at
most two tasks of a folder. Each way tries up to 40 removals in an order drawn by --seed until `caveat plan` proves the task unsolvable,
and as many of one predicate where `facts` finds none. What never becomes unsolvable stays in the index without a task, and further tasks
are taken until each way has 60. A search can be stopped and started again. The program is CAVEAT or
--caveat; files are looked for in CAVEAT_SHARED, or else in the folder `shared` beside the repository.
"""

import argparse
import math
import random
import re
from pathlib import Path

import expressions
import meter

COLUMNS = ["name", "origin", "way", "k", "proof", "tries", "removed"]
WAYS = ["facts", "operator", "object"]
TASKS, TRIES, SECONDS, EACH = 60, 40, 5, 2
UNSOLVABLE = {10: "relaxed", 11: "exhausted"}


def family(name):
    """`openstacks` of `openstacks-opt08-adl/p11`."""
    return re.split(r"[-\d]", name.split("/")[0])[0]


def plan(caveat, domain, problem):
    """The exit code of the planner on two texts."""
    with meter.Folder() as folder:
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)
        return meter.run([caveat, "plan", "--time-limit", f"{SECONDS}s", "domain.pddl", "problem.pddl"], SECONDS + 2, folder).code


def origins(options):
    """The solvable tasks to start from, in the order of the choice."""
    rows = meter.Rows(options.search.with_suffix(".origins.tsv"), ["name", "exit"])
    families, folders = {}, {}
    for name, domain, problem in meter.listed("opt.txt", "ipc"):
        families.setdefault(family(name), []).append((name, domain, problem))

    def solved(name, domain, problem):
        row = rows.get(name)
        if row is None:
            row = rows.add(name=name, exit=plan(options.caveat, domain.read_text(), problem.read_text()))
        return row["exit"] == "0"

    # A round takes the next solvable task of each family, from the folder that has given least.
    while any(families.values()):
        for waiting in families.values():
            while waiting:
                task = min(waiting, key=lambda task: folders.get(task[1].parent, 0))
                waiting.remove(task)
                folder = task[1].parent
                if folders.get(folder, 0) < EACH and solved(*task):
                    folders[folder] = folders.get(folder, 0) + 1
                    yield task
                    break


def removals(way, k, domain, problem, chance):
    """What could be removed, in the order to try: tuples of names, or of facts."""
    domain, problem = expressions.read(domain), expressions.read(problem)
    if way == "operator":
        found = [(name,) for name, _ in expressions.actions(domain)]
        chance.shuffle(found)
        return found[:TRIES]
    if way == "object":
        named = {word for pattern in expressions.section(problem, ":goal").items for word in pattern.words()}
        found = [(name,) for name in dict.fromkeys(expressions.objects(problem)) if name not in named]
        chance.shuffle(found)
        return found[:TRIES]
    facts = list(dict.fromkeys(words for words, _ in expressions.facts(problem)))
    if len(facts) < k:
        return []
    found = [tuple(chance.sample(facts, k)) for _ in range(min(TRIES, 4 * math.comb(len(facts), k)))]
    # Then facts of one predicate at a time, the rarest predicates first: what is rare is needed.
    kinds = {}
    for fact in facts:
        kinds.setdefault(fact[0], []).append(fact)
    for kind in sorted(kinds.values(), key=len):
        found += [tuple(chance.sample(kind, min(k, len(kind)))) for _ in range(4)]
    return list(dict.fromkeys(tuple(sorted(one)) for one in found))[:2 * TRIES]


def removed(way, what, domain, problem):
    """Both texts after a removal."""
    if way == "operator":
        return expressions.without_action(domain, what[0]), problem
    if way == "object":
        return domain, expressions.without_object(problem, what[0])
    return domain, expressions.without_facts(problem, what)


def search(options):
    """Chooses the tasks and what is removed, until each way has its tasks."""
    index, broken = meter.Rows(options.search, COLUMNS), dict.fromkeys(WAYS, 0)
    for place, (origin, domain, problem) in enumerate(origins(options)):
        domain, problem = domain.read_text(), problem.read_text()
        for way in WAYS:
            if broken[way] == TASKS:
                continue
            name, k = f"{origin.replace('/', '-')}-{way}", place % 3 + 1 if way == "facts" else 1
            row = index.get(name)
            if row is None:
                row = {"name": name, "origin": origin, "way": way, "k": k, "tries": 0, "proof": "none"}
                for what in removals(way, k, domain, problem, random.Random(f"{options.seed} {name}")):
                    row["tries"] += 1
                    code = plan(options.caveat, *removed(way, what, domain, problem))
                    if code in UNSOLVABLE:
                        words = map(expressions.written, what) if way == "facts" else what
                        row |= {"proof": UNSOLVABLE[code], "k": len(what), "removed": " ".join(words)}
                        break
                index.add(**row)
            broken[way] += row["proof"] != "none"
        if min(broken.values()) == TASKS:
            break
    return index


def write(index, options):
    """Writes the tasks of an index."""
    origins = {name: (domain, problem) for name, domain, problem in meter.listed("opt.txt", "ipc")}
    copy = meter.Rows(options.out / "index.tsv", COLUMNS)
    copy.rows = index.rows
    copy.write()
    for row in index.rows.values():
        if row["proof"] == "none":
            continue
        domain, problem = (path.read_text() for path in origins[row["origin"]])
        what = row["removed"]
        if row["way"] == "facts":
            what = [item.atom() for item in expressions.read(f"({what})").items]
        else:
            what = [what]
        domain, problem = removed(row["way"], what, domain, problem)
        folder = options.out / row["name"]
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "domain.pddl").write_text(domain)
        (folder / "problem.pddl").write_text(problem)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=meter.CAVEAT, help="the program that plans")
    options.add_argument("--search", type=Path, metavar="INDEX", help="choose the tasks anew, into this index")
    options.add_argument("--index", type=Path, default=Path(__file__).with_name("broken.tsv"), help="the index to follow")
    options.add_argument("--out", type=Path, default=meter.BENCH / "broken", help="where the tasks are written")
    options.add_argument("--seed", default="1", help="the seed of the order of removals")
    options = options.parse_args()
    if options.search:
        meter.program(options.caveat)
        options.caveat = options.caveat.resolve()
        index = search(options)
    else:
        index = meter.Rows(options.index, COLUMNS)
    write(index, options)
    for way in WAYS:
        rows = [row for row in index.rows.values() if row["way"] == way]
        proofs = {proof: sum(row["proof"] == proof for row in rows) for proof in [*UNSOLVABLE.values(), "none"]}
        print(f"{way}: " + ", ".join(f"{count} {proof}" for proof, count in proofs.items()))


if __name__ == "__main__":
    main()
