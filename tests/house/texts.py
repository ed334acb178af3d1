# SPDX-License-Identifier: Apache-2.0
"""The width of lines of all files that people write, and the length of sentences in documents.

Width: at most MOST_COLUMNS columns. Not counted are rows of tables and links alone on a line in documents, which cannot
be broken, and the files of NOT_WRITTEN.

Sentences: in each document, at most one sentence in SENTENCES_PER_LONG has more than MOST_WORDS words. A sentence ends
at . ! or ? before a space, at the end of a paragraph, of an item, of a heading and of a table's cell. Code, quoted or
in blocks, is one word or none. Decisions before FIRST_DECISION keep their sentences.
"""
import fnmatch
import re
import subprocess

MOST_COLUMNS = 120
MOST_WORDS = 30
SENTENCES_PER_LONG = 20
FIRST_DECISION = 68

WRITTEN = (".h", ".cpp", ".proto", ".py", ".sh", ".md", ".js", ".css", ".html", ".txt", ".cmake", ".txtpb", ".glsl",
           ".vert", ".frag", ".comp")
NOT_WRITTEN = {
    "tests/former/*": "files of earlier versions, kept to the byte",
    "tests/console/axe/*": "written by others",
    "console/pages/vendor/*": "written by others",
}


def is_script(path):
    """Whether a file without a suffix is a program of a shell or of Python."""
    with path.open("rb") as file:
        return not path.suffix and file.read(2) == b"#!"


def written_files(root):
    """The paths, from the root, of the tracked files that people write."""
    tracked = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True, check=True)
    for name in filter(None, tracked.stdout.split("\0")):
        excepted = any(fnmatch.fnmatch(name, pattern) for pattern in NOT_WRITTEN)
        if not excepted and (root / name).is_file() and (name.endswith(WRITTEN) or is_script(root / name)):
            yield name


def may_be_wide(name, line):
    """Rows of tables, and links that stand alone."""
    return name.endswith(".md") and (line.lstrip().startswith("|") or re.fullmatch(r"\W*\[[^]]*\]\(\S*\)\W*", line))


def width_problems(name, text):
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > MOST_COLUMNS and not may_be_wide(name, line):
            yield f"{name}:{number} has {len(line)} columns, more than {MOST_COLUMNS}"


def paragraphs(text):
    """The paragraphs, items, headings and cells of a document in Markdown, without code and formulas."""
    text = re.sub(r"^ *(```|~~~).*?^ *\1", "", text, flags=re.S | re.M)
    text = re.sub(r"\$\$.*?\$\$", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"`[^`]*`|\$[^$\n]+\$", "code", text)
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"^ *\|(.*)$", lambda row: "\n\n" + row[1].replace("|", "\n\n") + "\n\n", text, flags=re.M)
    text = re.sub(r"^ *([-*+]|\d+\.) ", "\n\n", text, flags=re.M)
    text = re.sub(r"^#.*$", r"\n\n\g<0>\n\n", text, flags=re.M)
    return re.split(r"\n\s*\n", text)


def sentences(text):
    """The number of words of each sentence of a document."""
    for paragraph in paragraphs(text):
        for sentence in re.split(r"[.!?][)\"*]*\s", paragraph):
            words = sum(any(map(str.isalnum, word)) for word in sentence.split())
            if words:
                yield words


def keeps_its_sentences(name):
    decision = re.fullmatch(r"docs/decisions/(\d{4})-.*", name)
    return decision and int(decision[1]) < FIRST_DECISION


def sentence_problems(name, text):
    counts = list(sentences(text))
    long = sum(count > MOST_WORDS for count in counts)
    if long * SENTENCES_PER_LONG > len(counts):
        yield (f"{name} has {long} sentences of more than {MOST_WORDS} words in {len(counts)}, "
               f"more than one in {SENTENCES_PER_LONG}")


def problems(root):
    for name in written_files(root):
        text = (root / name).read_text()
        yield from width_problems(name, text)
        if name.endswith(".md") and not keeps_its_sentences(name):
            yield from sentence_problems(name, text)
