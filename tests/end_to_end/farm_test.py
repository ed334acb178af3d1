"""A Slurm of one machine, with a configuration of its own, runs the array script, and the parts are merged."""

import os
import shutil
import socket
import subprocess
import time
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, end, free_ports, lacks, temporary_folder

DAEMONS = ["munged", "slurmctld", "slurmd"]
PATH = f"{BIN}:{os.environ['PATH']}:/usr/sbin:/sbin"
CONF = """ClusterName=aquarama
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
MpiDefault=none
PlugStackConfig=/dev/null
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=1 State=UNKNOWN
PartitionName=farm Nodes=ALL Default=YES State=UP
"""


@unittest.skipIf(*lacks(all(shutil.which(name, path=PATH) for name in DAEMONS), "slurm-wlm or munge"))
class Farm(unittest.TestCase):
    def setUp(self):
        self.temporary = temporary_folder()
        self.folder = Path(self.temporary.name)
        self.environment = os.environ | {"PATH": PATH, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.daemons = []
        for name in ("state", "spool", "run"):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)  # munged wants no others to write there
        (self.folder / "key").write_bytes(os.urandom(1024))
        (self.folder / "key").chmod(0o400)
        host = socket.gethostname().split(".")[0]
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        (self.folder / "slurm.conf").write_text(CONF.format(folder=self.folder, host=host, user=user,
                                                            ports=free_ports(2)))
        named = [f"--{what}={self.folder}/{file}" for what, file in (
            ("key-file", "key"), ("socket", "munge.socket"), ("pid-file", "munge.pid"), ("log-file", "munge.log"),
            ("seed-file", "munge.seed"))]
        self.start("munged", "--foreground", "--force", *named)
        self.start("slurmctld", "-D", "-i")
        self.start("slurmd", "-D", "-N", host)
        self.wait_for_node()

    def tearDown(self):
        end(self.daemons)
        self.temporary.cleanup()

    def start(self, *command):
        with open(self.folder / f"{command[0]}.out", "w") as output:
            self.daemons.append(subprocess.Popen(command, stdout=output, stderr=output, env=self.environment))

    def called(self, *command):
        return subprocess.run([*map(str, command)], capture_output=True, text=True, env=self.environment, timeout=120,
                              cwd=self.folder / "run")

    def wait_for_node(self):
        deadline = time.monotonic() + 30
        while "idle" not in self.called("sinfo", "-h", "-o", "%T").stdout:
            if time.monotonic() > deadline or any(daemon.poll() is not None for daemon in self.daemons):
                said = [line for name in DAEMONS for line in (self.folder / f"{name}.out").read_text().splitlines()]
                self.tearDown()
                self.skipTest("Slurm does not start on this machine: " + "; ".join(said[-3:]))
            time.sleep(0.2)

    def test_the_array_script_makes_the_parts_of_a_whole(self):
        whole, made = self.folder / "whole.txtpb", self.folder / "made.txtpb"
        command = ["search", "bigeye_scad", "--trials", "1", "--starts", "3", "--out"]
        self.assertEqual(aquarama(*command, whole).returncode, 0)
        script = ROOT / "packaging/farm/aquarama-array.sbatch"
        ran = self.called("sbatch", "--wait", "--array=1-3", script, 3, *command, made)
        logs = "".join(path.read_text() for path in (self.folder / "run").glob("aquarama-*.log"))
        self.assertEqual(ran.returncode, 0, ran.stderr + logs)
        merged = aquarama("merge", made, *(f"{made}.{number}-of-3.aqpart" for number in (1, 2, 3)))
        self.assertEqual(merged.returncode, 0, merged.stderr + logs)
        self.assertEqual(made.read_bytes(), whole.read_bytes())


if __name__ == "__main__":
    unittest.main(verbosity=2)
