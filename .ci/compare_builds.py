#!/usr/bin/env python3
"""Compares two builds of fem-run: the same bits in every result, and the same speed.

    compare_builds.py OLD NEW            every shipped case with every model, sweeps, all commands
    compare_builds.py OLD NEW --quick    two cases and no sweep, after each small move
    compare_builds.py OLD NEW --reworded the same without texts, after a change of words
    compare_builds.py OLD NEW --new-bars the same without error bars, after a change of their estimate
    compare_builds.py OLD NEW --times N  instead of results, N interleaved pairs of timed runs a row

Both get the same commands (compare_jobs.py) on the cases and data of this checkout. Compared are exit
status, stdout, stderr and each file that was written, byte for byte. JSON files are compared key by
key: the order of keys, every digit and the sign of a zero count. Left out is what differs between
two runs of one build: the measured numbers of `cost`, the report's line of that name, progress that
the clock prompts, seconds of a sweep's members and of claims, and the order in which threads get
done. So are `version` and `numerics`, and the names of a sweep's members, which move with a build's
numerics: they are told by their places in the sweep.

Prints a line a difference. Exit status: 0 no result differs, 1 some do, 2 wrong usage.
"""

import argparse
import contextlib
import itertools
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from compare_jobs import ELASTIC, ELASTIC_BULK, GLASS, ROOT, all_jobs, on, quick_jobs

LONGEST_RUN_S = 300
# Characters of a line that are shown before and after its first difference.
BEFORE, AFTER = 20, 40

# What differs between two runs of one build: keys of JSON files, ...
# What a page of a result says that its other files do not: what the run took.
NOT_COMPARED = {"report.html"}
MEASURED = re.compile(
    r"(^|\.)cost\.(wall_s|setup_s|solve_s|trials_s|ns_per_element_update|peak_memory_bytes)$"
    r"|^claims\.\d+\.seconds$")
# ... parts of what is printed, and of the page of claims.
COST_LINE = re.compile(r"^(cost  ).*$", re.MULTILINE)
PROGRESS_LINE = re.compile(r"^ *\d+ %  t = .*  step .*  force .*\n", re.MULTILINE)
DONE_SECONDS = re.compile(r"^(\[\d+/\d+\] .*[ ,] )[\d.]+ [mµ]?s$", re.MULTILINE)
DONE_COUNT = re.compile(r"^\[\d+/", re.MULTILINE)
# The name of a sweep's member.
MEMBER = re.compile(r"(?<![0-9a-f])[0-9a-f]{16}(?![0-9a-f])")
CLAIM_SECONDS = re.compile(r"[\d.]+ [mµ]?s of one core")


def run(binary, job, folder):
    """Runs a job's commands in a new folder; their exit status and what they print, by name."""
    folder.mkdir()
    for shared in ("cases", "validation"):
        (folder / shared).symlink_to(ROOT / shared)
    for name, text in job.files.items():
        (folder / name).write_text(text)
    told = {}
    for k, command in enumerate(job.commands, 1):
        try:
            ran = subprocess.run([binary, *command], cwd=folder, stdin=subprocess.DEVNULL,
                                 capture_output=True, timeout=LONGEST_RUN_S)
        except subprocess.TimeoutExpired:
            told[f"exit status of command {k}"] = f"none after {LONGEST_RUN_S} s"
            break
        told[f"exit status of command {k}"] = str(ran.returncode)
        is_threaded = "--threads" in command and command[command.index("--threads") + 1] != "1"
        told[f"stdout of command {k}"] = without_times(text_of(ran.stdout), is_threaded)
        told[f"stderr of command {k}"] = without_times(text_of(ran.stderr), is_threaded)
    return told


def text_of(printed):
    """Bytes that are no UTF-8 stay told apart."""
    return printed.decode(errors="surrogateescape")


def without_times(text, is_threaded):
    text = PROGRESS_LINE.sub("", COST_LINE.sub(r"\1", DONE_SECONDS.sub(r"\1", text)))
    return "\n".join(sorted(DONE_COUNT.sub("[", text).split("\n"))) if is_threaded else text


def members_of(folder):
    """The names of the members of all sweeps in a folder, and what stands for them."""
    names = {}
    for mark in sorted(folder.rglob("sweep.json")):
        for member in json.loads(mark.read_text())["members"]:
            names.setdefault(member["member"], f"member{len(names):010}")
    return names


def without_names(text, names):
    return MEMBER.sub(lambda word: names.get(word[0], word[0]), text)


def files_of(folder, members):
    """The files that a job has left, by their paths in the folder."""
    places = [(Path(place), name) for place, _, names in os.walk(folder) for name in names
              if name not in NOT_COMPARED]
    return {without_names(str((place / name).relative_to(folder)), members): place / name
            for place, name in places}


def flatten(value, path=""):
    """Numbers, texts and empty containers of parsed JSON with their dotted paths, in order."""
    if isinstance(value, (dict, list)) and value:
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from flatten(inner, f"{path}.{key}" if path else str(key))
    else:
        yield path, value


# What `--reworded` leaves out: files to read, and texts of JSON that are no names.
PAGES = {".html", ".md", ".svg", ".txt"}
WORDS = re.compile(r"(^|\.)(warnings|reason|stopped_because|message|title)(\.\d+)?$")
# What `--new-bars` leaves out.
BARS = re.compile(r"(^|\.)uncertainty\.|(^|\.)cost\.|error_if_left_out|elastic_null|tolerance")
left_out = {"words": False, "bars": False}


def json_entries(text):
    """Numbers stay as they are written; of a measured one it counts only whether it is there."""
    number = "number {}".format
    entries = flatten(json.loads(text, parse_float=number, parse_int=number))
    return [(key, "measured" if value and MEASURED.search(key) else value)
            for key, value in entries if key not in ("version", "numerics")
            and not (left_out["words"] and WORDS.search(key))
            and not (left_out["bars"] and BARS.search(key))]


def json_difference(old, new):
    pairs = itertools.zip_longest(json_entries(old), json_entries(new))
    different = [pair for pair in pairs if pair[0] != pair[1]]
    if not different:
        spaces = [re.sub(r"\S+", "", text) for text in (old, new)]
        return "white space" if spaces[0] != spaces[1] and not left_out["words"] else None
    before, after = (": ".join(map(str, entry)) if entry else "nothing" for entry in different[0])
    more = f", and {len(different) - 1} more" if len(different) > 1 else ""
    return f"{before} -> {after}{more}"


def text_difference(old, new):
    """The first line that differs, from shortly before the difference on."""
    lines = itertools.zip_longest(old.split("\n"), new.split("\n"), fillvalue="<end>")
    for number, (before, after) in enumerate(lines, 1):
        if before != after:
            common = len(os.path.commonprefix([before, after]))
            shown = slice(max(0, common - BEFORE), common + AFTER)
            return f"line {number}: {before[shown]!r} -> {after[shown]!r}"
    return None


def file_difference(old, new, members):
    if old is None or new is None:
        return "only the old build writes it" if new is None else "only the new build writes it"
    texts = [without_names(text_of(path.read_bytes()), names)
             for path, names in zip((old, new), members)]
    if left_out["words"] and old.suffix in PAGES:
        return None
    if old.suffix == ".json":
        with contextlib.suppress(json.JSONDecodeError):
            return json_difference(*texts)
    if old.suffix == ".html":
        texts = [CLAIM_SECONDS.sub("", text) for text in texts]
    return text_difference(*texts)


def differences(binaries, job):
    """A line a difference between what two builds make of a job."""
    with tempfile.TemporaryDirectory(prefix="compare-builds-") as scratch:
        told, left, members = [], [], []
        for binary, side in zip(binaries, ("old", "new")):
            # The same place for both: messages tell it.
            place, folder = Path(scratch) / "place", Path(scratch) / side
            told.append(run(binary, job, place))
            place.rename(folder)
            members.append(members_of(folder))
            left.append(files_of(folder, members[-1]))
        found = {name: text_difference(*(without_names(side.get(name, ""), names)
                                         for side, names in zip(told, members)))
                 for name in told[0] | told[1]}
        if left_out["words"]:
            found = {name: what for name, what in found.items() if name.startswith("exit status")}
        names = sorted(left[0] | left[1])
        found |= {name: file_difference(left[0].get(name), left[1].get(name), members)
                  for name in names}
    title = "; ".join(shlex.join(command) for command in job.commands)
    return [f"{title}: {name}: {difference}" for name, difference in found.items() if difference]


def compare(binaries, jobs):
    """Prints the differences in the order of the jobs; how many jobs differ."""
    n_different = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for lines in pool.map(lambda job: differences(binaries, job), jobs):
            n_different += bool(lines)
            for line in lines:
                print(line, flush=True)
    print(f"{len(jobs)} results compared, {n_different} differ")
    return n_different


NO_SNAPSHOTS = "output.snapshots=[]"
FINE = 'mesh.contact_element_size="7 um"'
# Name, command, how many runs count as one, which numbers of its own `cost` are told too.
TIMED = [
    ("fem", on(GLASS), 1, ["ns_per_element_update"]),
    ("fem, elastic", on(ELASTIC), 1, ["ns_per_element_update"]),
    ("fem, elastic bulk", on(ELASTIC_BULK), 1, ["ns_per_element_update"]),
    ("condensed", on(GLASS, "model.condensed={}"), 5, []),
    ("condensed, no snapshots", on(GLASS, "model.condensed={}", NO_SNAPSHOTS), 5,
     ["setup_s", "solve_s"]),
    ("condensed, 7 µm", on(GLASS, "model.condensed={}", NO_SNAPSHOTS, FINE), 1,
     ["setup_s", "solve_s"]),
    ("ting", on(GLASS, "model.ting={}"), 10, []),
    ("check", ["check", *on(GLASS)], 10, []),
    ("start-up", ["--version"], 10, []),
]


def measure(binary, command, n_runs, costs):
    """Means over some runs of the process' CPU time, user and system, s, and of its own costs."""
    totals = dict.fromkeys(["cpu_s", *costs], 0.0)
    with tempfile.TemporaryDirectory(prefix="compare-builds-") as scratch:
        result = f"{scratch}/result"
        options = ["--out", result, "--quiet"] if command[0].endswith(".toml") else []
        for _ in range(n_runs):
            process = subprocess.Popen([binary, *command, *options], cwd=ROOT,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode:
                sys.exit(f"{binary} {shlex.join(command)}: exit status {process.returncode}")
            totals["cpu_s"] += usage.ru_utime + usage.ru_stime
            for key in costs:
                totals[key] += json.loads(Path(result, "summary.json").read_text())["cost"][key]
    return {key: total / n_runs for key, total in totals.items()}


def print_times(binaries, n_pairs):
    """Medians of both builds, run by turns; ratios are those of the two runs of a pair."""
    print(f"{'':24}{'':22}{'old':>11}{'new':>11}{'new/old':>10}   middle half of the ratios")
    for name, command, n_runs, costs in TIMED:
        pairs = []
        for k in range(n_pairs):
            # Each build is as often the first of a pair: a drift of the machine cancels.
            order = (0, 1) if k % 2 == 0 else (1, 0)
            times = {side: measure(binaries[side], command, n_runs, costs) for side in order}
            pairs.append((times[0], times[1]))
        for key in ["cpu_s", *costs]:
            old, new = (statistics.median(pair[side][key] for pair in pairs) for side in (0, 1))
            ratios = [after[key] / before[key] for before, after in pairs]
            low, middle, high = statistics.quantiles(ratios, n=4, method="inclusive")
            row = f"{name:24}{key:22}{old:11.4g}{new:11.4g}{middle:10.4f}"
            print(f"{row}   {low:.4f} to {high:.4f}", flush=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", metavar="OLD", type=os.path.abspath)
    parser.add_argument("new", metavar="NEW", type=os.path.abspath)
    parser.add_argument("--quick", action="store_true", help="two cases and no sweep")
    parser.add_argument("--reworded", action="store_true", help="leave out texts")
    parser.add_argument("--new-bars", action="store_true", help="leave out error bars too")
    parser.add_argument("--times", metavar="N", type=int, help="pairs of timed runs a row, from 2")
    arguments = parser.parse_args()
    binaries = [arguments.old, arguments.new]
    for binary in binaries:
        if not os.access(binary, os.X_OK):
            parser.error(f"{binary} is no program")
    left_out.update(words=arguments.reworded or arguments.new_bars, bars=arguments.new_bars)
    if arguments.times is None:
        sys.exit(1 if compare(binaries, quick_jobs() if arguments.quick else all_jobs()) else 0)
    if arguments.times < 2:
        parser.error("--times: at least 2 pairs")
    print_times(binaries, arguments.times)


main()
