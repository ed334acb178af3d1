# SPDX-License-Identifier: Apache-2.0
"""The size of classes, and the doc lines of headers. universal-ctags reads the declarations.

Size: a class has at most MOST_METHODS methods and MOST_MEMBERS members. Overloads count one by one. Static members do
not count. Members of types that are nested in a class count as members of the class.

Doc lines: each type and function that a header declares and that is not private has a doc line. A doc line is a comment
  - directly above the declaration, or above its template and attribute lines; or
  - at the end of one of its lines, up to the line that ends in ; { or }; or
  - above the first declaration of its group: within a group there is no blank line and no public:, protected: or
    private:.
Exempt are: constructors, destructors and assignments (the class has the line), functions that are deleted, comparison
operators, overrides (their base has the line), specialisations of templates, what stands in an unnamed namespace, and
calls of macros, which look like functions (names in capitals).
"""
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

MOST_METHODS = 40
MOST_MEMBERS = 25

CLASSES = ("class", "struct", "union")
FUNCTIONS = ("function", "prototype")
TYPES = (*CLASSES, "enum", "typedef")
NEEDS_NO_LINE = {"operator ==", "operator !=", "operator <", "operator <=>", "operator ="}


def has_ctags():
    """Whether universal-ctags with JSON is there. In CI it must be."""
    ctags = shutil.which("ctags")
    if ctags and "json" in subprocess.run([ctags, "--list-features"], capture_output=True, text=True).stdout:
        return True
    print("SKIPPED: no universal-ctags: class sizes and doc lines are not measured", file=sys.stderr)
    return False


def declarations(files):
    """File -> its declarations as dictionaries of ctags, in the order of lines."""
    command = ["ctags", "--output-format=json", "--languages=C++", "--langmap=C++:.h.cpp", "--kinds-C++=+p",
               "--fields=+neaSs", "--fields-C++=+{properties}", "-L", "-", "-f", "-"]
    output = subprocess.run(command, input="\n".join(map(str, files)), capture_output=True, text=True,
                            check=True).stdout
    found = collections.defaultdict(list)
    for line in output.splitlines():
        declaration = json.loads(line)
        if not declaration["name"].startswith("__anon"):
            found[declaration["path"]].append(declaration)
    return {path: sorted(of_file, key=lambda declaration: declaration["line"]) for path, of_file in found.items()}


def scope_of(declaration):
    return declaration.get("scope", "")


def full_name(declaration):
    return "::".join(filter(None, (scope_of(declaration), declaration["name"])))


def properties(declaration):
    return declaration.get("properties", "").split(",")


def size_problems(of_file):
    """Classes of one file that are too large."""
    for one in of_file:
        if one["kind"] not in CLASSES:
            continue
        name = full_name(one)
        methods = sum(other["kind"] in FUNCTIONS and scope_of(other) == name
                      and one["line"] <= other["line"] <= one.get("end", 0) for other in of_file)
        members = sum(other["kind"] == "member" and f"{scope_of(other)}::".startswith(f"{name}::")
                      and "static" not in properties(other) for other in of_file)
        if methods > MOST_METHODS or members > MOST_MEMBERS:
            yield (f"{one['path']}:{one['line']} {one['name']} has {methods} methods and {members} members, "
                   f"more than {MOST_METHODS} or {MOST_MEMBERS}: part it")


def needs_doc_line(declaration, classes):
    if declaration["kind"] not in (*FUNCTIONS, *TYPES) or declaration.get("scopeKind") == "function":
        return False
    if "__anon" in scope_of(declaration) or re.fullmatch("[A-Z]+_[A-Z_]+", declaration["name"]):
        return False
    around = declaration
    while around:
        if around.get("access") == "private":
            return False
        around = classes.get(scope_of(around))
    own = scope_of(declaration).split("::")[-1]
    if declaration["name"].removeprefix("~") == own or "<" in scope_of(declaration):
        return False
    return (declaration["name"] not in NEEDS_NO_LINE
            and not {"default", "delete", "override"} & set(properties(declaration)))


def has_doc_line(lines, line, top):
    """Whether the declaration that begins at lines[line] has a doc line; its scope begins at lines[top]."""
    for text in lines[line:]:
        if "//" in text:
            return True
        if text.rstrip().endswith((";", "{", "}")):
            break
    for text in map(str.strip, reversed(lines[top + 1:line])):
        if text.startswith("//"):
            return True
        if not text or text in ("public:", "protected:", "private:"):
            break
    return False


def doc_problems(path, of_file):
    """Declarations of one header without a doc line."""
    lines = pathlib.Path(path).read_text().splitlines()
    classes = {full_name(one): one for one in of_file if one["kind"] in CLASSES}
    for one in of_file:
        around = classes.get(scope_of(one))
        top = around["line"] - 1 if around else -1
        if needs_doc_line(one, classes) and not has_doc_line(lines, one["line"] - 1, top):
            yield f"{path}:{one['line']} {one['name']} has no doc line: say what it is"


def problems(files):
    if not has_ctags():
        if os.environ.get("CI"):
            yield "no universal-ctags (packaging/packages/test.txt)"
        return
    found = declarations([path for path in files if path.suffix in {".h", ".cpp"}])
    for path, of_file in found.items():
        yield from size_problems(of_file)
        if path.endswith(".h"):
            yield from doc_problems(path, of_file)
