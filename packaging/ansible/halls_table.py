# SPDX-License-Identifier: Apache-2.0
"""halls_table.py ANSWERS TEXTFILE: prints what the doctor of each hall said as a table, the worst first, and writes the
same for Prometheus.

ANSWERS is a folder with a file for each hall, as doctors.yml leaves it: name, master, when it was asked, the doctor's
findings as `aquarama doctor --json` prints them, and what was said instead.
"""
import json
import os
import sys
from pathlib import Path

VERDICTS = ("fail", "warn", "pass")
METRICS = (("aquarama_doctor_answered", "1 where the doctor of the hall has answered."),
           ("aquarama_doctor_asked_timestamp_seconds", "When it was asked, Unix time."),
           ("aquarama_doctor_findings", "What it has found, by verdict."))


class Hall:
    """What one doctor said. `findings` is None where there was no answer, and `problem` says why."""

    def __init__(self, answer):
        self.name, self.master, self.asked_at = answer["hall"], answer["master"], answer["asked_at"]
        self.problem = " ".join(answer["problem"].split())
        try:
            self.findings = json.loads(answer["findings"])
        except ValueError:
            self.findings = None

    def count(self, verdict):
        return sum(finding["verdict"] == verdict for finding in self.findings or [])

    @property
    def verdict(self):
        if self.findings is None:
            return "silent"
        return next((verdict for verdict in VERDICTS if self.count(verdict)), "pass")

    @property
    def first(self):
        """The first of what is wrong."""
        if self.findings is None:
            return self.problem
        worst = [finding for finding in self.findings if finding["verdict"] == self.verdict != "pass"]
        return f"{worst[0]['subject']}: {worst[0]['what']}" if worst else ""


def table(halls):
    rows = [("hall", "master", "verdict", "fail", "warn", "first")]
    rows += [(hall.name, hall.master, hall.verdict, str(hall.count("fail")), str(hall.count("warn")), hall.first)
             for hall in halls]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]


def quoted(text):
    """As a label of Prometheus."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def samples(metric, hall):
    """(further labels, value) of one hall."""
    if metric == "aquarama_doctor_answered":
        return [("", int(hall.findings is not None))]
    if metric == "aquarama_doctor_asked_timestamp_seconds":
        return [("", hall.asked_at)]
    return [(f',verdict="{verdict}"', hall.count(verdict)) for verdict in VERDICTS if hall.findings is not None]


def figures(halls):
    for metric, what in METRICS:
        yield f"# HELP {metric} {what}"
        yield f"# TYPE {metric} gauge"
        for hall in halls:
            for labels, value in samples(metric, hall):
                yield f"{metric}{{hall={quoted(hall.name)},master={quoted(hall.master)}{labels}}} {value}"


def write_whole(path, text):
    """Whoever reads it sees the old file or the new one."""
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)


def main(answers, textfile):
    order = ("silent", *VERDICTS)
    halls = sorted((Hall(json.loads(file.read_text(encoding="utf-8"))) for file in Path(answers).glob("*.json")),
                   key=lambda hall: (order.index(hall.verdict), hall.name, hall.master))
    write_whole(Path(textfile), "\n".join(figures(halls)) + "\n")
    print("\n".join(table(halls)))


if __name__ == "__main__":
    main(*sys.argv[1:])
