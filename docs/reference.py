#!/usr/bin/env python3
"""Writes docs/reference.md, every field of rigs, scenes and species, from common/config/*.proto; with --check says
whether it is current.

Reads the schemas as we write them: one field a line, its rule in [(rule)...], its comment behind it or in the lines
above. """

import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
KINDS = {"rig": "config/*.txtpb", "adjustments": "Adjustments of a rig", "scene": "config/scenes/*.txtpb",
         "species": "config/species/*.txtpb", "hours": "The hours of a rig (the console's schedule)"}
HEAD = """# Reference: rigs, scenes and species

<!-- Written by docs/reference.py from common/config/*.proto: change those. -->

Every field of these kinds of files, and of the hours that the [console](console.md) keeps. `aquarama check FILE` holds
a file to all of it, and says where it is wrong and what to do. What the fields are for: [scenes](scenes.md),
[species](species.md), [stereo](stereo.md); the rigs in `config` show how one is written. L is the length of the fish.
*Left out*: what then holds, `{}` a message with all of its own defaults; *required*: the file must have it.
"""
TYPES = {"double": "number", "uint32": "whole number", "int32": "whole number", "string": "text",
         "bool": "`true`, `false`"}
UNITS = {"_m_s": "m/s", "_per_s": "1/s", "_deg": "°", "_hz": "Hz", "_px": "pixels", "_bl": "L", "_m": "m", "_s": "s",
         "_c": "°C", "_particles": "particles"}
FIELD = re.compile(r"(?:(optional|repeated) )?([\w.]+) (\w+) = \d+(?: \[(.*)\])?;")
VALUE = re.compile(r"(\w+\.)?(\w+) = \d+;")
RULE = re.compile(r"""(\w+)(?:: | = )("[^"]*"|[^\s}]+)""")


class Message:
    def __init__(self, name, comment):
        self.name, self.comment, self.fields = name, comment, []


def read(path):
    """The comment at the head of a schema, its messages, and the values of its choices by Message.Choice."""
    head, messages, choices, comment, choice = "", [], {}, [], None
    for line in path.read_text(encoding="utf-8").splitlines():
        code, _, behind = (part.strip() for part in line.partition("//"))
        if not code:
            comment = comment + [behind] if behind else []
            continue
        said, comment = " ".join([*comment, behind]).strip(), []
        field = FIELD.fullmatch(code)
        if code.startswith("syntax"):
            head = said.removeprefix("SPDX-License-Identifier: Apache-2.0 ")
        elif code.startswith("message "):
            messages.append(Message(code.split()[1], said))
        elif code.startswith("enum "):
            choice = choices.setdefault(f"{messages[-1].name}.{code.split()[1]}", [])
        elif choice is not None and VALUE.fullmatch(code):
            choice.append((VALUE.fullmatch(code)[2], said))
        elif choice is not None and code == "}":
            choice = None
        elif field:
            rule = {key: value.strip('"') for key, value in RULE.findall((field[4] or "").replace("(rule).", ""))}
            if field[2] in ("double", "int32") and not {"least", "most"} <= rule.keys():
                sys.exit(f"{path}: {field[3]} has no bounds: give it least and most")
            messages[-1].fields.append((field[1] == "repeated", field[2], field[3], rule, said))
        elif messages and not re.match(r"}|reserved |extend ", code):
            sys.exit(f"{path}: {code}: write one field a line")
    return head, messages, choices


def bounds(rule):
    least, most = rule.get("least"), rule.get("most")
    if least is None and most is None:
        return ""
    if most is None:
        return f"{least} or more"
    return most if least == most else f"up to {most}" if least is None else f"{least} to {most}"


def unit(name, rule):
    return rule.get("unit") or next((UNITS[end] for end in UNITS if name.endswith(end)), "")


def left_out(repeated, rule):
    if rule.get("required") or (repeated and rule.get("least")):
        return "required"
    if rule.get("default_value"):
        return "`" + rule["default_value"].replace("'", '"') + "`"
    return "none" if repeated else ""


def row(message, field, choices):
    repeated, type_, name, rule, said = field
    values = choices.get(type_) or choices.get(f"{message.name}.{type_}")
    kind = TYPES.get(type_) or ("choice" if values else f"[{type_}](#{type_.lower()})")
    if values and "." not in type_:
        said = "; ".join([*([said] if said else []),
                          *(f"`{value}`" + (f": {what}" if what else "") for value, what in values[1:])])
    count = " several" if repeated else ""
    return f"| `{name}` | {kind}{count} | {unit(name, rule)} | {bounds(rule)} | {left_out(repeated, rule)} | {said} |"


def reference():
    text = HEAD
    for kind, files in KINDS.items():
        head, messages, choices = read(DOCS.parent / "common/config" / f"{kind}.proto")
        text += f"\n## {files}\n\n{head.replace('*', chr(92) + '*')}\n"
        for message in messages:
            text += f"\n### {message.name}\n\n" + (message.comment + "\n\n" if message.comment else "")
            text += "| field | type | unit | bounds | left out | is |\n|---|---|---|---|---|---|\n"
            text += "\n".join(row(message, field, choices) for field in message.fields) + "\n"
    return text


def main():
    path = DOCS / "reference.md"
    text = reference()
    if "--check" not in sys.argv[1:]:
        path.write_text(text, encoding="utf-8")
    elif not path.exists() or path.read_text(encoding="utf-8") != text:
        sys.exit("docs/reference.md differs from common/config/*.proto: run docs/reference.py")


main()
