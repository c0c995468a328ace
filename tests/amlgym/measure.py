"""Learned domains go in; how many problems are solved with them, and how many plans are false in the true domain, comes out.

    cargo build --release && cargo build --release -p caveat-learner --example amlgym
    python3 tests/amlgym/measure.py                      # the eight domains of ../shared/corpus/traces/amlgym
    python3 tests/amlgym/measure.py --only ferry --rules both changed

The example `amlgym` learns each domain from its ten traces and writes it by each rule. With each of them `caveat plan` looks for plans for the
ten problems, within --seconds of CPU time each, and `caveat validate` judges the plans in the true domain. A problem is *solved* if there is a
plan and it is valid there, a plan that is not is *false*. Where FAST_DOWNWARD names a driver of Fast Downward, it plans too, with AMLGym's
search (lazy greedy search with the FF and the context-enhanced additive heuristic).
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "excuses"))
import meter

SEARCH = "let(hff,ff(),let(hcea,cea(),lazy_greedy([hff,hcea],preferred=[hff,hcea])))"
RULES = ["both", "changed", "negative"]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=meter.CAVEAT, help="the program that plans and validates")
    options.add_argument("--learner", type=Path, default=meter.CAVEAT.parent / "examples/amlgym", help="the example")
    options.add_argument("--traces", type=Path, default=meter.SHARED / "corpus/traces/amlgym", help="the folder of the domains")
    options.add_argument("--only", nargs="+", help="only these domains")
    options.add_argument("--rules", nargs="+", choices=RULES, default=RULES)
    options.add_argument("--seconds", type=int, default=30, help="CPU time for each problem")
    options = options.parse_args()
    folders = sorted(path for path in options.traces.iterdir() if path.is_dir())
    folders = [path for path in folders if not options.only or path.name in options.only]
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([options.learner, "--out", out, *folders], check=True)
        planners = ["caveat", "downward"] if meter.PEER else ["caveat"]
        for planner in planners:
            print(f"\n{planner:12} rule      solved  false  no plan  late  problems  CPU s")
            for rule in options.rules:
                totals = [0] * 6
                for folder in folders:
                    counts = judge(options, planner, folder, Path(out) / folder.name / f"{rule}.pddl")
                    totals = [total + count for total, count in zip(totals, counts)]
                    show(folder.name, rule, counts)
                show("all", rule, totals)


def show(name, rule, counts):
    solved, false, none, late, problems, cpu = counts
    print(f"{name:12} {rule:9} {solved:6} {false:6} {none:8} {late:5} {problems:9} {cpu:6.1f}", flush=True)


def judge(options, planner, folder, learned):
    """Counts of solved problems, false plans, problems without a plan, those that took too long, and all; and CPU seconds."""
    solved = false = none = late = cpu = 0
    problems = sorted((folder / "problems").iterdir(), key=lambda path: int(path.name.split("_")[0]))
    for problem in problems:
        with meter.Folder() as place:
            plan = place / "plan"
            if planner == "caveat":
                command = [options.caveat, "plan", "--time-limit", f"{options.seconds}s", "--plan-file", plan, learned, problem]
            else:
                command = [meter.PEER, "--plan-file", plan, "--search-time-limit", f"{options.seconds}s", learned, problem, "--search", SEARCH]
            run = meter.run(command, options.seconds + 5, place)
            cpu += run.cpu
            if plan.exists():
                verdict = meter.run([options.caveat, "validate", folder / "domain.pddl", problem, plan], 60, place)
                if verdict.code not in (0, 1):
                    sys.exit(f"{problem}: {verdict.said()}")
                solved += verdict.code == 0
                false += verdict.code == 1
            elif run.code in (10, 11, 12):
                none += 1
            elif run.code in (None, 21, 23):
                late += 1
            else:
                sys.exit(f"{problem}: exit code {run.code}: {run.said()}")
    return [solved, false, none, late, len(problems), cpu]


if __name__ == "__main__":
    main()
