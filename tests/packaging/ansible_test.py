"""The machines of a rig as an inventory, and the roll-out to them, one after the other while the doctor passes.

The roles themselves need root and packages: packaging/try-fleet.sh carries them out on fresh systems.
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("AQUARAMA_BIN", ROOT / "build/dev/bin"))
PLAYBOOK = ROOT / "packaging/ansible/site.yml"
MACHINES = {"left": "left-pc", "right": "right-pc"}  # the middle is the master's
FAKE_HALL = """#!/bin/sh
echo "$PWD $*" >>"$ASKED"
[ "$(wc -l <"$ASKED")" -ge "$FAULT_AT" ] || { echo '[]'; exit 0; }
echo '[{"verdict": "fail", "subject": "left", "what": "silent for 12 s", "todo": ""}]'
exit 1
"""


# The doctors of three halls, by the rig that is named: one finds a fault, one does not, one cannot read its rig.
FAKE_DOCTORS = """#!/bin/sh
case $2 in
    north*) echo '[{"verdict": "pass", "subject": "rig", "what": "good", "todo": ""},
                   {"verdict": "warn", "subject": "disk", "what": "1 GB free", "todo": "make room"},
                   {"verdict": "fail", "subject": "node left", "what": "absent", "todo": "start it"}]'; exit 1 ;;
    south*) echo '[{"verdict": "pass", "subject": "rig", "what": "good", "todo": ""}]' ;;
    *) echo "aquarama doctor: $2: is not there" >&2; exit 1 ;;
esac
"""


def called(*command, **more):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, timeout=300, **more)


def has_ansible():
    return shutil.which("ansible-playbook") is not None


@unittest.skipIf(not has_ansible() and not os.environ.get("CI"), "ansible-core is not installed (packaging/packages)")
class Fleet(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="aquarama-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.environment = os.environ | {"HOME": str(self.folder), "ANSIBLE_LOCAL_TEMP": str(self.folder / "ansible"),
                                         "ANSIBLE_NOCOLOR": "1", "LC_ALL": "C.UTF-8"}

    def write_rig(self, name="hall", address="192.168.7.1", standby=False):
        text = (ROOT / "config/theatre.txtpb").read_text().replace("127.0.0.1", address)
        for channel, machine in MACHINES.items():
            text = text.replace(f'name: "{channel}"', f'name: "{channel}" machine: "{name}-{machine}"')
        if standby:
            text += """standby { machine: "spare" control: "tcp://192.168.7.4:7400" state: "tcp://192.168.7.4:7401"
                etcd: ["https://192.168.7.1:2379", "https://192.168.7.2:2379", "https://192.168.7.3:2379"] }\n"""
        rig = self.folder / f"{name}.txtpb"
        rig.write_text(text)
        return rig

    def write_inventory(self, rig):
        done = called(BIN / "aquarama", "rig", "inventory", rig)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        inventory = rig.with_suffix(".json")
        inventory.write_text(done.stdout)
        return inventory

    def listed(self, *inventories):
        """As Ansible understands it: host -> variables, and group -> hosts."""
        options = [word for inventory in inventories for word in ("-i", inventory)]
        done = called("ansible-inventory", *options, "--list", env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("WARNING", done.stderr)
        everything = json.loads(done.stdout)
        return everything.pop("_meta")["hostvars"], {name: group.get("hosts", []) for name, group in everything.items()}

    def test_ansible_reads_the_machines_of_a_rig(self):
        machines, groups = self.listed(self.write_inventory(self.write_rig(standby=True)))
        self.assertEqual(groups["masters"], ["192.168.7.1"])
        self.assertEqual(groups["consoles"], ["192.168.7.1"])
        self.assertEqual(groups["standbys"], ["spare"])
        self.assertEqual(sorted(groups["nodes"]), ["192.168.7.1", "hall-left-pc", "hall-right-pc"])
        of_hall = {"aquarama_hall": "hall", "aquarama_name": "theatre", "aquarama_master": "192.168.7.1"}
        self.assertEqual(machines["192.168.7.1"], of_hall | {"aquarama_channels": ["middle"]})
        self.assertEqual(machines["hall-left-pc"], of_hall | {"aquarama_channels": ["left"]})
        self.assertEqual(machines["spare"], of_hall | {"ansible_host": "192.168.7.4"})

    def test_an_address_of_ipv6_has_no_brackets(self):
        machines, _ = self.listed(self.write_inventory(self.write_rig(address="[fd00::1]")))
        self.assertIn("fd00::1", machines)

    def test_several_halls_are_one_inventory(self):
        machines, groups = self.listed(self.write_inventory(self.write_rig("north")),
                                       self.write_inventory(self.write_rig("south", "192.168.8.1")))
        self.assertEqual(sorted(groups["masters"]), ["192.168.7.1", "192.168.8.1"])
        self.assertEqual(machines["south-left-pc"]["aquarama_master"], "192.168.8.1")
        self.assertEqual(len(groups["nodes"]), 6)

    def test_a_rig_on_one_machine_has_no_inventory(self):
        done = called(BIN / "aquarama", "rig", "inventory", ROOT / "config/desk.txtpb")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"\Aaquarama rig inventory: \S+desk\.txtpb: listens on its own machine.*\n\Z")

    def test_the_playbook_can_be_read(self):
        inventory = self.write_inventory(self.write_rig())
        done = called("ansible-playbook", "-i", inventory, "--syntax-check", PLAYBOOK, env=self.environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def roll_out(self, fault_at):
        """Only the doctor of each machine, all on this one. What the playbook says, and what the doctor was asked."""
        inventory = self.write_inventory(self.write_rig())
        programs = self.folder / "bin"
        programs.mkdir(exist_ok=True)
        (programs / "aquarama-hall").write_text(FAKE_HALL)
        (programs / "aquarama-hall").chmod(0o755)
        asked = self.folder / "asked"
        asked.write_text("")
        environment = self.environment | {"PATH": f"{programs}:{os.environ['PATH']}", "ASKED": str(asked),
                                          "FAULT_AT": str(fault_at)}
        done = called("ansible-playbook", "-i", inventory, "-c", "local", "--tags", "doctor", PLAYBOOK,
                      "-e", f"ansible_become=false aquarama_rigs={self.folder} aquarama_doctor_retries=0 "
                            "ansible_python_interpreter=/usr/bin/python3", env=environment)
        return done, asked.read_text().splitlines()

    def test_the_doctor_is_asked_before_and_after_each_machine(self):
        done, asked = self.roll_out(fault_at=99)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(asked), 6, done.stdout)
        self.assertTrue(all(line.endswith("doctor hall.txtpb --json") for line in asked), asked)
        self.assertEqual(len(re.findall(r"^\S+ +: ok=.*failed=0", done.stdout, re.MULTILINE)), 3)

    def test_a_failing_doctor_stops_the_roll_out(self):
        for fault_at in (2, 3):  # after the first machine, and before the second
            with self.subTest(fault_at=fault_at):
                done, asked = self.roll_out(fault_at)
                self.assertNotEqual(done.returncode, 0, done.stdout)
                self.assertEqual(len(asked), fault_at, "whoever comes next is not asked about")
                self.assertIn("silent for 12 s; no further machine is touched", " ".join(done.stdout.split()))


    def test_what_each_halls_doctor_says_is_one_table(self):
        for name, address in (("north", "192.168.7.1"), ("south", "192.168.8.1"), ("west", "192.168.9.1"),
                              ("east", "192.168.10.1")):
            (self.folder / name).mkdir()
            rig = self.write_rig(name, address)
            rig.write_text(rig.read_text().replace('name: "theatre"', f'name: "{name}"'))
            inventory = json.loads(self.write_inventory(rig).read_text())
            if name == "east":  # nobody answers there
                inventory["all"]["hosts"]["192.168.10.1"] |= {"ansible_connection": "ssh", "ansible_host": "127.0.0.1",
                                                              "ansible_port": 1}
            (self.folder / name / "hall.json").write_text(json.dumps(inventory))
        config = (PLAYBOOK.parent / "halls/ansible.cfg").read_text()
        self.assertIn("inventory = north/hall.json,south/hall.json\n", config)
        (self.folder / "ansible.cfg").write_text(config.replace("south/hall.json",
                                                                "south/hall.json,west/hall.json,east/hall.json"))
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "aquarama-hall").write_text(FAKE_DOCTORS)
        (programs / "aquarama-hall").chmod(0o755)
        done = called("ansible-playbook", PLAYBOOK.parent / "doctors.yml", "-c", "local", "-e",
                      "ansible_become=false ansible_python_interpreter=/usr/bin/python3 "
                      f"aquarama_answers={self.folder}/answers", cwd=self.folder,
                      env=self.environment | {"PATH": f"{programs}:{os.environ['PATH']}"})
        rows = re.findall(r'^ +"(\S+ .*?)",?$', done.stdout, re.MULTILINE)
        self.assertEqual([" ".join(row.split()[:5]) for row in rows],
                         ["hall master verdict fail warn", "east 192.168.10.1 silent 0 0",
                          "west 192.168.9.1 silent 0 0", "north 192.168.7.1 fail 1 1", "south 192.168.8.1 pass 0 0"],
                         done.stdout + done.stderr)
        self.assertIn("Connection refused", rows[1])
        self.assertIn("aquarama doctor: west.txtpb: is not there", rows[2])
        self.assertTrue(rows[3].endswith("node left: absent"), rows[3])
        figures = (self.folder / "answers/aquarama.prom").read_text()
        self.assertIn('aquarama_doctor_findings{hall="north",master="192.168.7.1",verdict="fail"} 1\n', figures)
        self.assertIn('aquarama_doctor_answered{hall="east",master="192.168.10.1"} 0\n', figures)
        self.assertNotIn('findings{hall="west"', figures)


if __name__ == "__main__":
    unittest.main(verbosity=2)
