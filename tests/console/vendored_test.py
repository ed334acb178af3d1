"""The pages are small and whole: files of others are unchanged, texts are complete in each language, nothing is fetched
from elsewhere."""

import gzip
import hashlib
import json
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ROOT / "console/pages"
OWN = [path for path in PAGES.rglob("*") if path.is_file() and path.parent.name != "vendor"]


class Vendored(unittest.TestCase):
    def test_files_of_others_are_as_they_were_released(self):
        for listing in (PAGES / "vendor/licences.txt", ROOT / "tests/console/axe/SHA256"):
            found = re.findall(r"^([0-9a-f]{64})  (\S+)", listing.read_text(), re.M)
            here = {path.name for path in listing.parent.iterdir()} - {listing.name, "LICENSE"}
            self.assertEqual(here, {name for _, name in found})
            for digest, name in found:
                self.assertEqual(hashlib.sha256((listing.parent / name).read_bytes()).hexdigest(), digest, name)

    def test_a_page_is_at_most_150_kilobytes_compressed(self):
        total = sum(len(gzip.compress(path.read_bytes())) for path in PAGES.rglob("*") if path.is_file()
                    and path.suffix != ".txt")
        self.assertLess(total, 150_000)

    def test_nothing_is_asked_of_anywhere_else_and_no_style_is_inline(self):
        for path in OWN:
            text = path.read_text()
            links = [link for link in re.findall(r"https?://[^\s\"'`]+", text) if "www.w3.org" not in link]
            self.assertEqual(links, [], path.name)
            self.assertNotRegex(text, r'\sstyle="|<style|\son\w+="', path.name)

    def test_every_text_is_there_in_every_language(self):
        used = set()
        for path in OWN:
            if path.suffix == ".js":
                used |= set(re.findall(r"\bt\(\s*'([\w.]+)'", path.read_text()))
                for choice in re.findall(r"\bt\(\w+ \? '([\w.]+)' : '([\w.]+)'", path.read_text()):
                    used |= set(choice)
        self.assertGreater(len(used), 60)
        texts = {path.stem: json.loads(path.read_text()) for path in (PAGES / "texts").glob("*.json")}
        self.assertEqual(set(texts), {"en", "de"})
        names = {name for name in texts["en"] if not name.startswith("word.")}
        for language, own in texts.items():
            self.assertEqual(used - set(own), set(), language)
            self.assertEqual(names - set(own), set(), language)
            for name in names:
                self.assertEqual(set(re.findall(r"\{\w+\}", own[name])), set(re.findall(r"\{\w+\}", texts["en"][name])),
                                 name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
