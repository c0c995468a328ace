#!/usr/bin/env python3
"""People demonstrate in the physical worlds, operators are learned from what each shows, and plans made with them are carried out there.

    people.py cubes --people 300 --first 1000
    people.py kitchens --people 100
    people.py joint --people 100

Everything is done by the program itself, command by command, as a user would do it; a plan counts if its goal is reached as judged from poses.
The environment names the program (CAVEAT, by default target/release/caveat). Rows go to target/bench, so that a run that was broken off goes on where it stopped.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CAVEAT = os.environ.get("CAVEAT", str(ROOT / "target/release/caveat"))


def run(*words, cwd):
    """Runs the program; returns its exit code, output and talk."""
    done = subprocess.run([CAVEAT, *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout, done.stderr


def goals():
    """The goals of each world, by name, as `simulate list` prints them."""
    _, out, _ = run("simulate", "list", cwd=ROOT)
    worlds, world = {}, None
    for line in out.splitlines():
        if line.startswith("  "):
            name, condition = line.strip().split(": ", 1)
            worlds[world][name] = condition
        else:
            world = line.split(":")[0]
            worlds[world] = {}
    return worlds


def learn(folder, logs, *options):
    """Learns a domain from logs; returns whether there is one."""
    code, _, talk = run("learn", "-o", "learned.pddl", *options, *logs, cwd=folder)
    return code == 0, talk


def plan_and_run(folder, world, scene, goal, condition, *options):
    """Plans for the scene of a seed with the learned domain, and carries the plan out; returns what came of it and how many steps it has."""
    look = ["simulate", "demo", world, "--task", "nothing", "--person", "0", "--seed", scene, "-o", "scene.jsonl"]
    if run(*look, cwd=folder)[0] != 0:
        return "no scene", 0
    code, out, talk = run("learn", "--extend", "learned.pddl", "-o", "same.pddl", "--problem", "scene.pddl",
                          "--goal", condition, *options, "scene.jsonl", cwd=folder)
    if not (Path(folder) / "scene.pddl").exists():
        return f"no problem: {talk.strip()}", 0
    code, out, talk = run("plan", "--time-limit", "60s", "learned.pddl", "scene.pddl", cwd=folder)
    if code != 0:
        return f"no plan ({code})", 0
    code, out, _ = run("simulate", "run", world, "sas_plan", "--routines", "learned.routines.json", "--seed", scene,
                       "--goal", goal, cwd=folder)
    text = (Path(folder) / "sas_plan").read_text()
    lines = [line for line in text.splitlines() if line.startswith("(") or ":" in line.split("(")[0]]
    steps = len({line.split(":")[0] for line in lines}) if ":" in text.split("(")[0] else len(lines)
    for name in ("scene.pddl", "sas_plan"):
        (Path(folder) / name).unlink(missing_ok=True)
    if code == 0:
        return "reached", steps
    return "failed: " + " ".join(out.split("\n")[:2]), steps


def cubes(person, worlds):
    """One demonstration, then all four goals in another scene. Even persons stack one cube, odd ones two."""
    rows = []
    task = "stack-one" if person % 2 == 0 else "stack-two"
    with tempfile.TemporaryDirectory() as folder:
        code, _, _ = run("simulate", "demo", "cubes", "--task", task, "--person", person, "--seed", person, "-o",
                         "demo.jsonl", cwd=folder)
        good, talk = learn(folder, ["demo.jsonl"])
        for goal, condition in worlds["cubes"].items():
            if not good:
                rows.append(("cubes", person, goal, f"not learned: {talk.strip()[:200]}", 0))
                continue
            rows.append(("cubes", person, goal, *plan_and_run(folder, "cubes", person + 7, goal, condition)))
    return rows


def combined(first, worlds):
    """Twelve demonstrations together, then all four goals."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        logs = []
        for person in range(first, first + 12):
            task = "stack-one" if person % 2 == 0 else "stack-two"
            run("simulate", "demo", "cubes", "--task", task, "--person", person, "--seed", person, "-o",
                f"{person}.jsonl", cwd=folder)
            logs.append(f"{person}.jsonl")
        good, talk = learn(folder, logs)
        for goal, condition in worlds["cubes"].items():
            if not good:
                rows.append(("combined", first, goal, f"not learned: {talk.strip()[:200]}", 0))
                continue
            rows.append(("combined", first, goal, *plan_and_run(folder, "cubes", first + 7, goal, condition)))
    return rows


def joint(person, worlds):
    """Two hands: a whole demonstration, then the first goal of the world in another scene; with agents, and without them beside it."""
    rows = []
    for world in ("bottle", "bottle-open", "hanoi"):
        with tempfile.TemporaryDirectory() as folder:
            run("simulate", "demo", world, "--person", person, "--seed", person, "-o", "demo.jsonl", cwd=folder)
            goal, condition = next(iter(worlds[world].items()))
            for mode in ("agents", "single"):
                good, talk = learn(folder, ["demo.jsonl"], *(["--agents"] if mode == "agents" else []))
                if not good:
                    rows.append((f"{world} {mode}", person, goal, f"not learned: {talk.strip()[:200]}", 0))
                    continue
                rows.append((f"{world} {mode}", person, goal, *plan_and_run(folder, world, person + 7, goal, condition)))
    return rows


def kitchens(person, worlds):
    """A whole demonstration beside the guided one: how long, how many activities, and whether the robot can do its task afterwards."""
    rows = []
    for world, domain in (("kitchen", "closed-drawer"), ("kitchen-blocked", "blocked-drawer")):
        source = ROOT / "domains" / domain
        with tempfile.TemporaryDirectory() as folder:
            sizes = {}
            for task in ("full", "guided"):
                run("simulate", "demo", world, "--task", task, "--person", person, "--seed", person, "-o",
                    f"{task}.jsonl", cwd=folder)
                _, out, _ = run("learn", "--segments", f"{task}.jsonl", cwd=folder)
                frames = sum(1 for _ in open(Path(folder) / f"{task}.jsonl")) - 1
                _, _, talk = run("learn", f"{task}.jsonl", cwd=folder)
                actions = talk.split(" s, ")[1].split(" ")[0] if " s, " in talk else "0"
                sizes[task] = (frames / 90, {"one": 1, "nothing": 0}.get(actions) if not actions.isdigit() else int(actions))
            code, _, talk = run("learn", "--extend", source / "domain.pddl", "--config", source / "words.json", "-o",
                                "taught.pddl", "guided.jsonl", cwd=folder)
            code, _, _ = run("plan", "taught.pddl", source / "plate.pddl", cwd=folder)
            said = "planned" if code == 0 else f"no plan ({code}): {talk.strip()[:200]}"
            (full, many), (guided, few) = sizes["full"], sizes["guided"]
            rows.append((world, person, f"{full:.1f} {guided:.1f} {many} {few}", said, 0))
    return rows


KINDS = {"cubes": cubes, "combined": combined, "joint": joint, "kitchens": kitchens}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--people", type=int, default=12)
    parser.add_argument("--first", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    worlds = goals()
    file = ROOT / "target/bench" / f"people-{arguments.kind}.jsonl"
    file.parent.mkdir(parents=True, exist_ok=True)
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    step = 12 if arguments.kind == "combined" else 1
    wanted = range(arguments.first, arguments.first + arguments.people, step)
    known = {row[1] for row in rows}
    with ThreadPoolExecutor(arguments.jobs) as pool, file.open("a") as out:
        for found in pool.map(lambda person: KINDS[arguments.kind](person, worlds), [p for p in wanted if p not in known]):
            for row in found:
                rows.append(list(row))
                out.write(json.dumps(row) + "\n")
            out.flush()
    rows = [row for row in rows if row[1] in wanted]
    for world in sorted({(row[0], row[2] if arguments.kind != "kitchens" else "") for row in rows}):
        own = [row for row in rows if (row[0], row[2] if arguments.kind != "kitchens" else "") == world]
        good = sum(row[3] in ("reached", "planned") for row in own)
        steps = [row[4] for row in own if row[3] == "reached"]
        mean = f", {sum(steps) / len(steps):.1f} steps" if steps else ""
        print(f"{' '.join(world):32} {good}/{len(own)} = {100 * good / len(own):.1f} %{mean}")
        if arguments.kind == "kitchens":
            sums = [sum(float(row[2].split()[at]) for row in own) for at in range(4)]
            print(f"  guided instead of whole: time {100 * (sums[1] / sums[0] - 1):+.0f} %, actions {100 * (sums[3] / sums[2] - 1):+.0f} %")
        for row in own:
            if row[3] not in ("reached", "planned"):
                print(f"  person {row[1]}: {row[3]}", file=sys.stderr)


if __name__ == "__main__":
    main()
