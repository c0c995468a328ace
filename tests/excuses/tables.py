"""Rows of measurements go in; tables in Markdown for BENCHMARKS.md come out, with the faults listed below them."""

import meter

WAYS = [("facts", "facts removed"), ("operator", "operator removed"), ("object", "object removed"), (None, "all")]


def table(head, lines):
    """A table whose first column is text and whose others are numbers."""
    return "\n".join(["| " + " | ".join(head) + " |", "|---|" + "--:|" * (len(head) - 1),
                      *("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)])


def same(left, right):
    return float(left) == float(right)


def broken(index, rows):
    """The summary of `measure.py`: the index, and the rows of each part by name."""
    index = list(index)
    tasks = [row for row in index if row["proof"] != "none"]
    find, check, task, sets = (rows[part] for part in ("find", "verify", "compile", "exhaustive"))

    def plain(name):
        row = find.get(name)
        return rows["plain"].get(name) if row and row["objects"] not in ("0", "-") else row

    def proven(row):
        return row["proven"].lower() == "true"

    def found(name):
        row = find.get(name)
        return row is not None and row["status"] in ("excuse", "none") and proven(row)

    def status(wanted, sure=None):
        return lambda name: name in find and find[name]["status"] == wanted and (sure is None or proven(find[name]) == sure)

    def verified(name):
        row = check[name]
        good, count = row["own"].split("/") if "/" in row["own"] else (0, 1)
        return (row["applied"] == "yes" and row["goal"] == "free" and row["costs"] == "as said" and good == count
                and row["exit"] == "0" and row["valid"] == "0" and row["steps"] not in ("0", "-"))

    def costs(name, prefix=""):
        """The cost of the excuse and that of the compilation where both are proven, `none` among them."""
        row, other = plain(name), task.get(name)
        if not row or not other or not row["status"] in ("excuse", "none") or not proven(row):
            return None
        ours = row["cost"] if row["status"] == "excuse" else "none"
        if other[f"{prefix}exit"] == "0" and other[f"{prefix}cost"] != "-":
            return ours, other[f"{prefix}cost"]
        if other[f"{prefix}exit"] in ("10", "11"):
            return ours, "none"
        return None

    def agree(pair):
        ours, theirs = pair
        return ours == theirs if "none" in pair else same(ours, theirs)

    def decided(name, prefix=""):
        other = task.get(name)
        return other is not None and other[f"{prefix}exit"] in ("0", "10", "11")

    def tried(name):
        return name in sets and sets[name]["verdict"] in ("confirmed", "refuted", "partly", "stopped")

    lines = []

    def line(title, cell):
        names = [[row["name"] for row in tasks if way in (row["way"], None)] for way, _ in WAYS]
        lines.append([title, *(cell(here) for here in names)])

    def count(of, among=None):
        def cell(names):
            if among is None:
                return sum(bool(of(name)) for name in names)
            known = [name for name in names if among(name)]
            return f"{sum(bool(of(name)) for name in known)}/{len(known)}"

        return cell

    def share(names):
        return f"{100 * sum(found(name) for name in names) / len(names):.1f} %" if names else "·"

    def time(names):
        times = [float(find[name]["cpu"]) for name in names if name in find]
        return f"{meter.median(times):.2f} s" if times else "·"

    line("tasks", len)
    line("measured", count(lambda name: name in find))
    line("least excuse, proven", count(status("excuse", True)))
    line("no excuse in the vocabulary, proven", count(status("none", True)))
    line("answered", share)
    line("an excuse, not proven to be least", count(status("excuse", False)))
    line("unknown within the limits", count(status("unknown")))
    line("said to be solvable", count(status("solvable")))
    line("could not run", count(lambda name: name in find and find[name]["status"] == "-"))
    line("CPU, median", time)
    line("verified by plan and validator", count(verified, lambda name: name in check))
    line("everything smaller tried: confirmed", count(lambda name: sets[name]["verdict"] == "confirmed", tried))
    line("… where that is more than the task itself", count(lambda name: sets[name]["verdict"] == "confirmed",
                                                            lambda name: tried(name) and sets[name]["states"] != "1"))
    line("… too much to try", count(lambda name: name in sets and sets[name]["verdict"] == "too many"))
    for title, prefix in (("compilation, `plan --optimal`", ""), ("compilation, Fast Downward `astar(lmcut())`", "peer-")):
        if any(row[f"{prefix}exit"] != "-" for row in task.values()):
            line(f"{title}: decided in 30 s", count(lambda name, prefix=prefix: decided(name, prefix)))
            both = lambda name, prefix=prefix: costs(name, prefix)
            line("… the same cost as ours", count(lambda name, both=both: agree(both(name)), both))
            line("… decided, ours not", count(lambda name, both=both, prefix=prefix: decided(name, prefix) and plain(name) and not both(name)))
    text = table(["", *(title for _, title in WAYS)], lines)
    never = [sum(row["proof"] == "none" and row["way"] == way for row in index) for way, _ in WAYS[:-1]]
    if any(never):
        text += "\n\nTried without becoming unsolvable, and replaced by other tasks: " + ", ".join(
            f"{count} with {title}" for count, (_, title) in zip(never, WAYS)) + "."
    if len({row["program"] for row in find.values()}) > 1:
        text += "\n\nThe rows of `find` are of several builds of the program."
    faults = [f"{name}: said to be solvable" for name, row in find.items() if row["status"] == "solvable"]
    faults += [f"{name}: exit {row['exit']}, {row['said']}" for name, row in find.items() if row["status"] == "-"]
    faults += [f"{name}: not verified: {row}" for name, row in check.items() if not verified(name)]
    faults += [f"{name}: a smaller excuse: {row['solvable']}" for name, row in sets.items() if row["verdict"] == "refuted"]
    for prefix in ("", "peer-"):
        faults += [f"{name}: cost {costs(name, prefix)[0]}, by the {prefix}compilation {costs(name, prefix)[1]}"
                   for name in task if costs(name, prefix) and not agree(costs(name, prefix))]
    return text + "".join(f"\n- {fault}" for fault in (["Faults:"] if faults else []) + faults).replace("\n- Faults:", "\n\nFaults:\n")
