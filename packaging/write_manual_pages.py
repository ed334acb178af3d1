#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a manual page for each program of Aquarama in a folder, from what it says to --help.

A program with commands has them in its page, each with its options. Usage: write_manual_pages.py PROGRAMS OUT
"""
import pathlib
import re
import subprocess
import sys

SUMMARIES = {  # what --help does not say in a line
    "aquarama": "one living undersea world on a wall of projectors",
    "aquarama-calibrate": "find by camera how projectors hang before their screen",
    "aquarama-compose": "check a rig, compose what its projectors show",
    "aquarama-console": "the operator's console of a show, for browsers",
    "aquarama-drawings": "print sheets to colour, read photographs of them",
    "aquarama-guests": "let visitors with phones take part in a show",
    "aquarama-hall": "run a command of aquarama as the services of a hall do",
    "aquarama-outputs": "pin a machine's outputs, so that a projector that is off changes none",
    "aquarama-node": "show one channel of a wall, in step with all others",
}
ELSEWHERE = {"node": "aquarama-node", "console": "aquarama-console", "touch": "aquarama-console",
             "guests": "aquarama-guests", "calibrate": "aquarama-calibrate",
             "sheets": "aquarama-drawings"}  # commands with a page
FORMER = {"aquarama-solve"}  # names of the release before, whose page is that of the new name
COLUMN = 30  # where --help begins to say what an option does
COMMAND_GROUP = re.compile(r"^(A show|While a show|Files|Fish and|Worlds|Offline|Commands|Subcommands)\b.*:$")


def escaped(text):
    """As roff shows it: no request at a line's start, hyphens that can be searched for and copied."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r",(?=\S)", ",\\\\:", text)  # where a long list of values may be broken
    return "\\&" + text if text.startswith((".", "'")) else text


def said(program, command):
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return done.stdout.strip("\n").split("\n")


def commands_in(lines):
    """The names under the headings of commands."""
    inside = False
    for line in lines:
        if line and not line.startswith(" "):
            inside = bool(COMMAND_GROUP.match(line))
        elif inside and (match := re.match(r"  ([a-z]+)  ", line)):
            yield match.group(1)


def entry(line):
    """'  --name VALUE   what it does' in its two halves; None where the line is no entry."""
    match = re.match(r" {2,6}(\S.*?)(?: {2,}(\S.*))?$", line)
    if not match or not re.match(r"-|[A-Z]{2,}|[a-z]+$", match.group(1)):
        return None
    if match.group(2) is None and line[COLUMN - 1:COLUMN] == " ":  # the first half fills its column
        return line[:COLUMN].strip(), line[COLUMN:].strip()
    return match.group(1), match.group(2) or ""


def body(lines):
    """All after the usage, in roff."""
    for line in lines:
        if not line.strip():
            continue
        if line.startswith(" " * 20):
            yield escaped(line.strip())
        elif found := entry(line):
            yield from (".TP", ".B " + escaped(found[0]), escaped(found[1]) or "\\&")
        elif line.endswith(":") and not line.startswith(" "):
            yield from (".PP", ".I " + escaped(line))
        else:
            yield from (".PP", escaped(line.strip()))


def usage_and_rest(lines):
    at = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
    return lines[:at], lines[at].removeprefix("Usage: "), lines[at + 1:]


def sections(program, command):
    """One command with those below it, each as a section; `command` is empty for the program itself."""
    about, usage, rest = usage_and_rest(said(program, command))
    if command:
        yield f'.SS "{escaped(" ".join(command))}"'
        yield from body(about)
        yield from (".PP", ".B " + escaped(usage))
    else:
        yield from (".SH SYNOPSIS", ".B " + escaped(usage), ".SH DESCRIPTION")
        yield from body(about)
    yield from body(rest)
    names = list(commands_in(rest))
    if names and not command:
        yield ".SH COMMANDS"
    for name in names:
        if not command and program.name == "aquarama" and name in ELSEWHERE:
            yield from (f'.SS "{name}"', f"See \\fB{escaped(ELSEWHERE[name])}\\fR(1).")
        else:
            yield from sections(program, [*command, name])


def page(program, version):
    name = program.name
    others = ", ".join(f"\\fB{escaped(other)}\\fR(1)" for other in sorted(SUMMARIES) if other != name)
    yield f'.TH {name.upper()} 1 "" "Aquarama {version}" "Aquarama"'
    yield from (".ad l", ".SH NAME", escaped(f"{name} - {SUMMARIES[name]}"))
    yield from sections(program, [])
    yield from (".SH SEE ALSO", others)


def main():
    programs, out = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    shown = subprocess.run([programs / "aquarama", "--version"], capture_output=True, text=True, check=True)
    version = shown.stdout.split()[1]
    for program in sorted(programs.iterdir()):
        if program.name in FORMER:
            continue
        if program.name not in SUMMARIES:
            sys.exit(f"write_manual_pages.py: {program.name} has no line in SUMMARIES; write one")
        (out / f"{program.name}.1").write_text("\n".join(page(program, version)) + "\n")


if __name__ == "__main__":
    main()
