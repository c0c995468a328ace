"""A command goes in; its exit code, output and CPU seconds come out, within limits, and rows of results are kept between runs.

One process runs at a time, in a folder of its own and in a process group of its own, which is killed when the command ends or has used
up its time. The CPU time is that of the process and of the children that it waited for. Rows are kept as TSV with a line of titles.
"""

import hashlib
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("CAVEAT_SHARED") or ROOT.parent / "shared")
BENCH = ROOT / "target/bench"
CAVEAT = Path(os.environ.get("CAVEAT") or ROOT / "target/release/caveat")
# The driver of Fast Downward, or nothing.
PEER = os.environ.get("FAST_DOWNWARD")
# How many times its CPU time a process may take on the clock: more where the machine has much else to do.
PATIENCE = float(os.environ.get("CAVEAT_PATIENCE", "2"))
# What the program under test is told about memory, and the bytes of address space that no process may exceed: far more, for it is
# the program that should keep its limit.
MEMORY, BYTES = "6G", 16 << 30


# Whoever stops the script stops what it runs.
signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))


class Run:
    """What became of a process. The code is nothing when it was stopped for its time."""

    def __init__(self, code, out, error, cpu, wall):
        self.code, self.out, self.error, self.cpu, self.wall = code, out, error, cpu, wall

    def said(self):
        """The first words of the error stream, in one line."""
        return " ".join(self.error.split())[:200]


def run(command, seconds, folder):
    """Runs a command in a folder. Seconds are of CPU time for each of its processes, and PATIENCE times that of wall clock and 10 s for all."""
    seconds = max(1, int(seconds + 0.999))

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))

    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as error:
        start = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=out, stderr=error, cwd=folder,
                                   start_new_session=True, preexec_fn=limit)
        late = threading.Event()

        def stop():
            late.set()
            kill(process.pid)

        timer = threading.Timer(PATIENCE * seconds + 10, stop)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        finally:
            timer.cancel()
            kill(process.pid)
        process.returncode = code = os.waitstatus_to_exitcode(status)
        wall, cpu = time.monotonic() - start, usage.ru_utime + usage.ru_stime
        if late.is_set() or code == -signal.SIGXCPU or code == -signal.SIGKILL and cpu >= seconds:
            code = None
        texts = []
        for stream in (out, error):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    return Run(code, *texts, cpu, wall)


def kill(group):
    try:
        os.killpg(group, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass


class Folder:
    """A fresh folder for the files of one run, gone afterwards."""

    def __enter__(self):
        self.path = Path(tempfile.mkdtemp(prefix="excuses-"))
        return self.path

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)


class Rows:
    """The rows of a table that grows on disk, by the values of their first columns."""

    def __init__(self, path, columns, keys=1):
        self.path, self.columns, self.keys, self.rows = Path(path), columns, keys, {}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        if self.path.exists():
            text = self.path.read_text()
            lines = text.splitlines()
            if lines and lines[0].split("\t") == columns:
                for line in lines[1:]:
                    values = line.split("\t")
                    # A line that was cut off when the run was stopped is measured again.
                    if len(values) == len(columns):
                        self.rows[tuple(values[:keys])] = dict(zip(columns, values))
            elif lines:
                sys.exit(f"{path} has other columns; remove it to measure again")
            if text.endswith("\n") and len(lines) == len(self.rows) + 1:
                return
        self.write()

    def write(self):
        with self.path.open("w") as stream:
            print(*self.columns, sep="\t", file=stream)
            for row in self.rows.values():
                print(*row.values(), sep="\t", file=stream)

    def get(self, *key):
        return self.rows.get(tuple(key))

    def forget(self, keep):
        """Drops the rows that are not to be kept."""
        self.rows = {key: row for key, row in self.rows.items() if keep(row)}
        self.write()

    def add(self, **values):
        row = {column: " ".join(str(values.get(column, "-")).split()) or "-" for column in self.columns}
        self.rows[tuple(row[column] for column in self.columns[:self.keys])] = row
        with self.path.open("a") as stream:
            print(*row.values(), sep="\t", file=stream)
        print(*row.values(), sep="\t", file=sys.stderr, flush=True)
        return row


def digest(*parts):
    """A short name of a content."""
    total = hashlib.sha256()
    for part in parts:
        total.update(part if isinstance(part, bytes) else part.encode())
        total.update(b"\0")
    return total.hexdigest()[:12]


def program(caveat):
    """A short name of this build of the program, or an end with a message where there is none."""
    caveat = Path(caveat)
    if not caveat.is_file():
        sys.exit(f"There is no program at {caveat}; build it, or name it by --caveat or CAVEAT")
    return digest(caveat.read_bytes())


def listed(name, folder):
    """The pairs of a list of the benchmarks: name, domain, problem."""
    path = SHARED / "benchmarks" / name
    if not path.is_file():
        sys.exit(f"There is no shared material at {SHARED}; set CAVEAT_SHARED")
    for line in path.read_text().splitlines():
        domain, problem = line.split("\t")[:2]
        yield problem.removesuffix(".pddl"), SHARED / "benchmarks" / folder / domain, SHARED / "benchmarks" / folder / problem


def median(values):
    values = sorted(values)
    return values[len(values) // 2] if values else None
