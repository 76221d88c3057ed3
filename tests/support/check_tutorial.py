"""Types the commands of a page's `console` blocks one by one and compares what comes with what the page shows.

usage: check_tutorial.py PAGE    in an empty folder, with the program on PATH

A line "$ COMMAND" is typed, with the lines that it goes on to while a quote is open. What follows is its output, numbers exactly;
"..." stands for any lines. Times, the speed of the machine and its number of processes, and blanks, do not count. A block of
YAML after "Write this as `NAME`" becomes that file.
"""

import re
import subprocess
import sys

MASKS = [  # what differs from machine to machine
    (re.compile(r"\b\d+(\.\d+)?(e[+-]?\d+)? (ms|s|min|h)\b"), "TIME"),
    (re.compile(r"\d+(\.\d+)?(e[+-]?\d+)? element-steps"), "N element-steps"),
    (re.compile(r"\b\d+(\.\d+)? [kMG]?B\b"), "SIZE"),  # a slow machine computes fewer realizations for a plan's sizes
    (re.compile(r"\b\d+ (workers?|processe?s?)\b"), "N workers"),
    (re.compile(r"\s+"), " "),
]


def masked(line):
    for mask, word in MASKS:
        line = mask.sub(word, line)
    return line.strip()


def agree(shown, came):
    """Whether the lines that came are those shown, any of them for "..."; else the first line shown that is not there."""
    at = 0
    free = False
    for line in shown:
        if line == "...":
            free = True
            continue
        found = next((i for i in range(at, len(came) if free else min(at + 1, len(came))) if came[i] == line), None)
        if found is None:
            return line
        at, free = found + 1, False
    return None if free or at == len(came) else f"the end, in place of: {came[at]}"


def steps(page):
    """("file", name, text) and ("command", text, lines of output), in the order of the page."""
    name = None
    for fence, text, prose in re.findall(r"^```(\w+)\n(.*?)^```$|^([^\n]*)$", page, re.S | re.M):
        if fence == "yaml":
            if name:
                yield "file", name, text
            name = None
        elif fence == "console":
            for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
                lines = part.splitlines()
                command = lines.pop(0)
                while command.count("'") % 2:
                    command += "\n" + lines.pop(0)
                yield "command", command, lines
        elif not fence:
            said = re.search(r"Write this as `([^`]+)`", prose)
            name = said.group(1) if said else name


def main():
    commands = 0
    for kind, what, text in steps(open(sys.argv[1], encoding="utf-8").read()):
        if kind == "file":
            with open(what, "w", encoding="utf-8") as out:
                out.write(text)
            continue
        commands += 1
        ran = subprocess.run(["bash", "-c", what], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        missing = agree([masked(line) for line in text], [masked(line) for line in ran.stdout.splitlines()])
        if missing is not None:
            sys.exit(f"$ {what}\n{ran.stdout}\nstatus {ran.returncode}; the page shows, and it did not say: {missing}")
    print(f"{commands} commands")
    if commands < 5:
        sys.exit("the page has few commands")


main()
