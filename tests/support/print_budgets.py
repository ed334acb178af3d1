"""Prints what each suite took beside its budget, from the report that ctest writes."""

import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

budgets = {}
for row in Path("build/dev").rglob("CTestTestfile.cmake"):
    for name, budget in re.findall(r'set_tests_properties\(\[*=*\[?"?([\w./-]+)"?.*?TIMEOUT "?(\d+)', row.read_text()):
        budgets[name.strip('[]="')] = int(budget)

total = 0.0
print(f"{'suite':<28}{'seconds':>9}{'budget':>9}")
for case in sorted(ElementTree.parse(sys.argv[1]).iter("testcase"), key=lambda c: -float(c.get("time"))):
    seconds = float(case.get("time"))
    total += seconds
    print(f"{case.get('name'):<28}{seconds:>9.1f}{budgets.get(case.get('name'), 0):>9}")
print(f"{'all':<28}{total:>9.1f}")
