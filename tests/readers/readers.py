"""Readers of PDDL go in, ours and others'; a table of what each says of the same files, and how long it takes, comes out.

    python3 tests/readers/readers.py --caveat target/release/caveat

Each reader is one process for each pair of a domain and a problem. Rows are appended to target/readers/rows.tsv as they come, so a run
can be stopped and started again; a row is kept until --again. The readers are installed by pip, each into a folder of its own below
target/readers (or --venvs). VAL is run where the environment variable VAL names its `Parser`. A table is printed at the end, and by
--report alone. Times are wall clock and CPU of the whole process, the start of Python included, and the least of --repeat runs: they
count only when nothing else runs. Files are looked for in CAVEAT_SHARED, or else in the folder `shared` beside the repository.
"""

import argparse
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("CAVEAT_SHARED") or ROOT.parent / "shared")

# The readers of PyPI: package and version. Loki is asked both in its default and in its strict mode.
PACKAGES = {
    "pddl": "pddl==0.5.1",
    "up": "unified-planning==1.3.0",
    "loki": "pypddl==1.7.0",
    "loki-strict": "pypddl==1.7.0",
    "fd": "fast-downward-translate==26.6.0",
}
COLUMNS = ["reader", "set", "case", "bytes", "verdict", "place", "wall", "cpu", "message"]
# Seconds and bytes that a process may take.
SECONDS, BYTES = 60, 6 << 30


def read(reader, domain, problem):
    """Reads a pair with the Python package at hand, in the process of a worker."""
    if reader == "pddl":
        from pddl import parse_domain, parse_problem

        parse_domain(domain)
        parse_problem(problem)
    elif reader == "up":
        from unified_planning.io import PDDLReader
        from unified_planning.shortcuts import get_environment

        get_environment().credits_stream = None
        PDDLReader().parse_problem(domain, problem)
    elif reader.startswith("loki"):
        from pypddl import formalism

        options = formalism.ParserOptions()
        options.strict = reader == "loki-strict"
        formalism.Parser(Path(domain), options).parse_task(Path(problem))
    else:
        # Only the reading of the translator: what it grounds afterwards is no part of this.
        from fast_downward.translate import pddl_parser

        pddl_parser.open(domain, problem)


# What a reader raises on purpose about its input; anything else is an accident of its own.
MEANT = re.compile(r"^(UP\w*|ANML\w*|PDDL\w*|Parse\w*|Unexpected\w*|Visit\w*|Lark\w*|\w*(?:Requirement|Definition|Arity|Type|Undefined|"
                   r"Duplicate|Mismatch|Missing|Invalid|Semantic)\w*|SystemExit|SyntaxError|ValueError|NotImplementedError)$")
UNSUPPORTED = re.compile(r"unsupported|not supported|not able to handle|not implemented|unknown requirement|NotImplemented|"
                         # The Python package lists the requirements that it knows, the translator names the one that it does not.
                         r"No support|does not support|NON_DETERMINISTIC|Invalid requirement", re.I)


def worker(reader, domain, problem):
    """Prints the verdict of one reader as the last line, in JSON."""
    try:
        read(reader, domain, problem)
        answer = {"verdict": "accepts"}
    except BaseException as error:  # SystemExit and RecursionError too
        name = type(error).__name__
        text = f"{name}: {error}"
        if UNSUPPORTED.search(text):
            verdict = "unsupported"
        else:
            # A plain TypeError is no message about the input, though its name is like those of the readers.
            builtin = type(error).__module__ == "builtins"
            meant = name in ("SystemExit", "SyntaxError", "ValueError", "NotImplementedError") if builtin else MEANT.match(name)
            verdict = "rejects" if meant else "crash"
        line, column = getattr(error, "lineno", None), getattr(error, "column", None)
        line = line or getattr(error, "line", None)
        found = re.search(r"line:? *(\d+),? *col(?:umn)?\.?:? *(\d+)", text, re.I) or re.search(r":(\d+):(\d+)\b", text)
        if not isinstance(line, int) or not isinstance(column, int):
            line, column = (int(found[1]), int(found[2])) if found else (None, None)
        if line is None and (only := re.search(r"\bline:? *(\d+)", text, re.I)):
            line = int(only[1])
        if column is None and (mark := re.search(r"^[ _]*[\^~]", str(error), re.M)):
            # Loki gives the line as a number and underlines the place in a copy of it.
            column = len(mark[0])
        answer = {"verdict": verdict, "line": line, "column": column, "message": " ".join(text.split())[:300]}
    print("\n" + json.dumps(answer))


def python(reader, venvs):
    """The Python that has a reader, installed where it is missing."""
    package = PACKAGES[reader]
    folder = venvs / package.split("==")[0]
    if not (folder / "installed").exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        subprocess.run([folder / "bin/python", "-m", "pip", "install", "--quiet", package], check=True)
        (folder / "installed").write_text(package)
    return folder / "bin/python"


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))


def run(command):
    """Runs a process: its exit code, output, wall and CPU seconds."""
    out = ROOT / "target/readers/out"
    with out.open("wb") as stream:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=stream, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, preexec_fn=limit)
        timer_fired = False

        def stop(*_):
            nonlocal timer_fired
            timer_fired = True
            process.kill()

        signal.signal(signal.SIGALRM, stop)
        signal.alarm(SECONDS * 2)
        _, status, usage = os.wait4(process.pid, 0)
        signal.alarm(0)
        wall = time.monotonic() - start
    code = None if timer_fired else os.waitstatus_to_exitcode(status)
    return code, out.read_text(errors="replace"), wall, usage.ru_utime + usage.ru_stime


def judge(reader, options, domain, problem):
    """What a reader says of a pair: a verdict as the worker's, with times."""
    if reader == "caveat":
        command = [options.caveat, "check", "--output-format", "concise", domain, problem]
    elif reader == "val":
        command = [os.environ["VAL"], domain, problem]
    else:
        command = [python(reader, options.venvs), __file__, "--worker", reader, domain, problem]
    times = []
    for _ in range(options.repeat):
        code, out, wall, cpu = run([str(word) for word in command])
        times.append((wall, cpu))
    wall, cpu = min(times)
    if code is None or code == -signal.SIGXCPU:
        answer = {"verdict": "time"}
    elif reader == "caveat":
        said = re.search(r"^(?P<file>.+?):(?P<line>\d+):(?P<column>\d+): (?P<message>(?P<kind>error|warning)\[.*)", out, re.M)
        answer = {"verdict": "accepts" if code == 0 else "rejects" if code == 1 else "crash"}
        if said:
            answer |= {"line": int(said["line"]), "column": int(said["column"]), "message": said["message"]}
            answer["file"] = said["file"]
            # A text with warnings alone is accepted, and something is said of it.
            if not re.search(r": error\[", out):
                answer["verdict"] = "warns"
    elif reader == "val":
        said = re.search(r"line: (\d+): (Error.*)", out)
        crashed = code < 0
        answer = {"verdict": "crash" if crashed else "rejects" if said or "Errors: 0" not in out else "accepts"}
        if said:
            answer |= {"line": int(said[1]), "message": said[2]}
    else:
        last = out.strip().splitlines()[-1:]
        try:
            answer = json.loads(last[0])
        except (IndexError, ValueError):
            answer = {"verdict": "crash", "message": f"exit {code}: " + " ".join(out.split())[-200:]}
    return answer, wall, cpu


def place(answer, wanted):
    """How well the place of the first message fits."""
    # What is refused as unknown in the wanted line, or where a requirement is the mistake, is found.
    if wanted and answer["verdict"] == "unsupported" and (answer.get("line") == wanted["line"] or wanted["code"][1:3] == "03"):
        answer["verdict"] = "rejects"
    if wanted is None or answer["verdict"] not in ("rejects", "warns"):
        return "-"
    if answer.get("line") is None:
        return "none"
    if "file" in answer and Path(answer["file"]).name != Path(wanted["file"]).name:
        return "wrong"
    if answer["line"] != wanted["line"]:
        return "wrong"
    return "exact" if answer.get("column") == wanted["col"] else "line"


def cases():
    """All pairs: (set, name, domain, problem, wanted place)."""
    bad, valid = SHARED / "corpus/bad-pddl", SHARED / "corpus/valid-pddl"
    for folder, base, listing, label in [
        (bad, bad, "expectations.json", "bad"),
        (valid, bad, "valid.json", "valid"),
    ]:
        for case in json.loads((folder / listing).read_text()):
            file, pair = folder / case["file"], base / case["pair"]
            domain, problem = (file, pair) if case["role"] == "domain" else (pair, file)
            yield label, case["file"], domain, problem, case if label == "bad" else None
    pairs = []
    for folder in sorted((SHARED / "benchmarks/ipc").iterdir()):
        found = list(tasks(folder))
        if found:
            pairs += found
            domain, problem = min(found, key=lambda pair: (pair[1].stat().st_size, pair[1].name))
            yield "ipc", f"{folder.name}/{problem.name}", domain, problem, None
    for label, size in [("100kB", 100_000), ("large", None)]:
        weight = lambda pair: pair[0].stat().st_size + pair[1].stat().st_size
        near = (lambda pair: abs(weight(pair) - size)) if size else (lambda pair: -weight(pair))
        domain, problem = min(pairs, key=lambda pair: (near(pair), str(pair[1])))
        yield label, f"{problem.parent.name}/{problem.name}", domain, problem, None
    made = ROOT / "target/readers/made"
    made.mkdir(parents=True, exist_ok=True)
    domain, problem = made / "domain.pddl", made / "problem.pddl"
    if not problem.exists():
        domain.write_text("(define (domain roads) (:requirements :strips :typing) (:types place)\n"
                          " (:predicates (at ?p - place) (road ?from ?to - place))\n"
                          " (:action go :parameters (?from ?to - place)\n  :precondition (and (at ?from) (road ?from ?to))\n"
                          "  :effect (and (at ?to) (not (at ?from)))))\n")
        roads = "\n".join(f"  (road place-{n} place-{n * 48271 % 20000})" for n in range(20000) for n in (n, n + 7))
        places = " ".join(f"place-{n}" for n in range(20007))
        problem.write_text(f"(define (problem far) (:domain roads)\n (:objects {places} - place)\n"
                           f" (:init (at place-0)\n{roads})\n (:goal (at place-9)))\n")
    yield "made", "roads", domain, problem, None


def tasks(folder):
    """The pairs in a folder of the benchmarks, with the usual names of domains."""
    files = sorted(folder.glob("*.pddl"))
    for problem in files:
        stem = problem.stem
        usual = ["domain.pddl", f"{stem}-domain.pddl", f"domain_{stem}.pddl", f"domain-{stem}.pddl", f"{stem.split('-')[0]}-domain.pddl"]
        domain = next((folder / name for name in usual if (folder / name).exists()), None)
        if domain and domain != problem and "domain" not in stem:
            yield domain, problem


def report(rows, readers):
    """Counts and times as Markdown."""
    lines = ["| files | " + " | ".join(readers) + " |", "|---|" + "--:|" * len(readers)]

    def line(title, value):
        lines.append(f"| {title} | " + " | ".join(str(value(reader)) for reader in readers) + " |")

    def count(label, **wanted):
        def of(reader):
            here = [row for row in rows if row["reader"] == reader and row["set"] == label]
            return sum(all(row[key] in values for key, values in wanted.items()) for row in here) if here else "·"

        return of

    total = {label: len({row["case"] for row in rows if row["set"] == label}) for label in ("bad", "valid", "ipc")}
    said = ("rejects", "warns")
    line(f"{total['bad']} bad: first message at the exact place", count("bad", verdict=said, place=("exact",)))
    line("… in the right line only", count("bad", verdict=said, place=("line",)))
    line("… in a wrong line", count("bad", verdict=said, place=("wrong",)))
    line("… at no place", count("bad", verdict=said, place=("none",)))
    line("… crash or out of time", count("bad", verdict=("crash", "time")))
    line("… unsupported", count("bad", verdict=("unsupported",)))
    line("… silently accepted", count("bad", verdict=("accepts",)))
    line(f"{total['valid']} valid: accepted", count("valid", verdict=("accepts", "warns")))
    line(f"{total['ipc']} IPC folders, smallest problem: accepted", count("ipc", verdict=("accepts", "warns")))
    line("… crash or out of time", count("ipc", verdict=("crash", "time")))
    for label in ("100kB", "large", "made"):
        names = sorted({(row["case"], int(row["bytes"])) for row in rows if row["set"] == label})
        for name, size in names:

            def cell(reader):
                row = next((row for row in rows if row["reader"] == reader and row["case"] == name and row["set"] == label), None)
                return "·" if row is None else f"{float(row['cpu']):.2f} s" + ("" if row["verdict"] in ("accepts", "warns") else f" ({row['verdict']})")

            line(f"{name}, {size / 1000:.0f} kB: CPU", cell)

    def middle(reader):
        times = sorted(float(row["cpu"]) for row in rows if row["reader"] == reader and row["set"] == "ipc")
        return f"{times[len(times) // 2]:.3f} s" if times else "·"

    line("IPC, median: CPU", middle)
    return "\n".join(lines)


def main():
    if sys.argv[1:2] == ["--worker"]:
        return worker(*sys.argv[2:5])
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--caveat", type=Path, default=ROOT / "target/release/caveat", help="the program to compare")
    options.add_argument("--venvs", type=Path, default=ROOT / "target/readers", help="where the readers are installed")
    options.add_argument("--repeat", type=int, default=1, help="take the least of so many runs")
    options.add_argument("--only", nargs="*", help="these readers only")
    options.add_argument("--again", action="store_true", help="forget earlier rows")
    options.add_argument("--report", action="store_true", help="print the table of what has been measured")
    options = options.parse_args()
    if not (SHARED / "corpus/bad-pddl").is_dir():
        sys.exit(f"There is no shared material at {SHARED}; set CAVEAT_SHARED")
    path = ROOT / "target/readers/rows.tsv"
    path.parent.mkdir(parents=True, exist_ok=True)
    if options.again:
        path.unlink(missing_ok=True)
    rows = []
    if path.exists():
        rows = [dict(zip(COLUMNS, line.split("\t"))) for line in path.read_text().splitlines()]
    readers = ["caveat", *PACKAGES] + (["val"] if os.environ.get("VAL") else [])
    if not options.report:
        done = {(row["reader"], row["set"], row["case"]) for row in rows}
        with path.open("a") as stream:
            for reader in options.only or readers:
                for label, name, domain, problem, wanted in cases():
                    if (reader, label, name) in done:
                        continue
                    answer, wall, cpu = judge(reader, options, domain, problem)
                    fits = place(answer, wanted)
                    size = domain.stat().st_size + problem.stat().st_size
                    message = " ".join(str(answer.get("message") or "").split())
                    values = [reader, label, name, size, answer["verdict"], fits, f"{wall:.4f}", f"{cpu:.4f}", message]
                    rows.append(dict(zip(COLUMNS, map(str, values))))
                    print(*values, sep="\t", file=stream, flush=True)
    print(report(rows, [reader for reader in readers if any(row["reader"] == reader for row in rows)]))


if __name__ == "__main__":
    main()
