"""What takeovers.sh runs, in namespaces of its own."""

import argparse
import itertools
import json
import os
import statistics
import subprocess
import time

import hosts
from hosts import BIN, CHANNELS, ROOT, Wall, end, report, sh, temporary_folder, wait_until

ADDRESS = hosts.ADDRESS
ADDRESS["spare"] = "10.77.0.2"
MEMBERS = ["master", "spare", "left"]  # machines that run etcd
MACHINES = {"master": "main", "spare": "spare"}  # those that may be the master, as the rig names them
PATIENCE = 30  # seconds: only a hang meets it


class Hall(Wall):
    """With a standby, and etcd."""

    def __init__(self, folder):
        super().__init__(folder)
        spare = ADDRESS["spare"]
        urls = " ".join(f'etcd: "https://{ADDRESS[machine]}:2379"' for machine in MEMBERS)
        with self.rig.open("a") as rig:
            rig.write(f'standby {{ machine: "spare" control: "tcp://{spare}:7400" state: "tcp://{spare}:7401" '
                      f'{urls} }}\n')
        self.aquarama("master", "keys", "new", self.rig, "--keys", self.keys)
        self.make_certificates()

    def make_certificates(self):
        """As docs/hall.md says."""
        new = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
               "-days", "2"]
        authority, key = self.keys / "etcd-ca.pem", self.folder / "ca-key.pem"
        sh(*new, "-subj", "/CN=etcd", "-keyout", key, "-out", authority)
        for machine in MEMBERS:
            own = self.folder / "etcd" / machine
            own.mkdir(parents=True)
            sh(*new, "-subj", f"/CN={machine}", "-CA", authority, "-CAkey", key, "-addext",
               f"subjectAltName=IP:{ADDRESS[machine]}", "-addext", "basicConstraints=critical,CA:false", "-keyout",
               own / "etcd-key.pem", "-out", own / "etcd.pem")
        for name in ("etcd.pem", "etcd-key.pem"):
            (self.keys / name).write_bytes((self.folder / "etcd" / "master" / name).read_bytes())
            (self.keys / name).chmod(0o600)

    def spawn(self, name, machine, command, log, environment):
        with open(log, "a") as output:
            self.processes[name] = subprocess.Popen(["ip", "netns", "exec", machine, *map(str, command)], stdout=output,
                                                       stderr=subprocess.STDOUT, env=os.environ | environment, cwd=ROOT)

    def start_etcd(self, machine):
        own, url = self.folder / "etcd" / machine, f"https://{ADDRESS[machine]}"
        values = {"NAME": machine, "DATA_DIR": own / "data", "LOG_LEVEL": "error",
                  "LISTEN_CLIENT_URLS": f"{url}:2379", "ADVERTISE_CLIENT_URLS": f"{url}:2379",
                  "LISTEN_PEER_URLS": f"{url}:2380", "INITIAL_ADVERTISE_PEER_URLS": f"{url}:2380",
                  "INITIAL_CLUSTER": ",".join(f"{name}=https://{ADDRESS[name]}:2380" for name in MEMBERS),
                  "HEARTBEAT_INTERVAL": 50, "ELECTION_TIMEOUT": 500}
        for prefix in ("", "PEER_"):
            values |= {prefix + "CLIENT_CERT_AUTH": "true", prefix + "TRUSTED_CA_FILE": self.keys / "etcd-ca.pem",
                       prefix + "CERT_FILE": own / "etcd.pem", prefix + "KEY_FILE": own / "etcd-key.pem"}
        self.spawn(f"etcd on {machine}", machine, ["etcd"], own / "log",
                   {f"ETCD_{name}": str(value) for name, value in values.items()})

    def ask_etcd(self, machine, path, **request):
        """Of the member on this machine, as JSON; empty where it does not answer."""
        own = self.folder / "etcd" / machine
        said = self.run(machine, "curl", "-s", "-m", "2", "--cacert", self.keys / "etcd-ca.pem", "--cert",
                        own / "etcd.pem", "--key", own / "etcd-key.pem", "-d", json.dumps(request),
                        f"https://{ADDRESS[machine]}:2379/v3/maintenance/{path}")
        return json.loads(said.stdout) if said.stdout else {}

    def etcd_leader(self):
        """Its machine; nothing while there is none."""
        for machine in MEMBERS:
            status = self.ask_etcd(machine, "status")
            if status.get("leader", "0") not in ("0", 0) and status["leader"] == status["header"]["member_id"]:
                return machine
        return None

    def lead_etcd_on(self, machine):
        def leads():
            leader = self.etcd_leader()
            if leader and leader != machine:
                wanted = self.ask_etcd(machine, "status")["header"]["member_id"]
                self.ask_etcd(leader, "transfer-leadership", targetID=wanted)
            return leader == machine
        wait_until(leads, PATIENCE, f"{machine} to lead etcd")

    def log_of(self, machine):
        return self.folder / f"{machine}.log"

    def said(self, machine, text):
        """How often the program on this machine said it."""
        log = self.log_of(machine)
        return log.read_text().count(text) if log.exists() else 0

    def start_machine(self, machine):
        """Either becomes the master, or stands by where the other one is."""
        command = ["standby", self.rig] if machine == "spare" else ["master", self.rig, "--quality", "low"]
        self.spawn(machine, machine, [BIN / "aquarama", *command, "--keys", self.keys], self.log_of(machine),
                   {"XDG_STATE_HOME": str(self.folder / "state" / machine)})

    def start_node(self, name, key=None):
        self.spawn(name, name, [BIN / "aquarama-node", "--key", key or self.folder / f"{name}.key", "--master",
                                f"tcp://{ADDRESS['spare']}:7400", "--headless", "--trace", self.folder],
                   self.log_of(name), {"LP_NUM_THREADS": "0"})

    def longest_gap_ms(self, names, since_ns):
        """Of all runs of the master: numbers of frames begin again with each."""
        gaps = [0]
        for name in names:
            rows = [line.split(",") for line in (self.folder / f"{name}.csv").read_text().splitlines()]
            shown = [int(row[3]) for row in rows if len(row) == 4 and row[3].isdigit() and int(row[3]) > since_ns]
            gaps += [after - before for before, after in zip(shown, shown[1:])]
        return max(gaps) / 1e6

    def status(self, machine):
        return self.aquarama(machine, "status", "--key", self.folder / "operator.key", "--master",
                             f"tcp://{ADDRESS[machine]}:7400").stdout

    def leads(self, machine):
        return f"{MACHINES[machine]} is the master" in self.status(machine)

    def is_whole(self, leader):
        """This machine leads, the other one stands by, and all nodes are in step."""
        status = self.status(leader)
        return (f"{MACHINES[leader]} is the master" in status and "simulates along" in status
                and sum(" in step" in line for line in status.splitlines() if line.split()[:1] and
                        line.split()[0] in CHANNELS) == len(CHANNELS))

    def await_whole(self, leader):
        try:
            wait_until(lambda: self.is_whole(leader), PATIENCE, f"{leader} to lead a whole hall")
        except AssertionError:
            print(self.status(leader))
            self.print_logs()
            raise

    def print_logs(self):
        for name in [*MACHINES, "order"]:
            if self.log_of(name).exists():
                print(f"---- {name}", self.log_of(name).read_text()[-2500:], sep="\n")


def a_moment_ago():
    """So that the last frame before what is done now counts: nanoseconds of the monotonic clock."""
    return time.monotonic_ns() - 300_000_000


def takeover(hall, old, new, way):
    """The seconds until the other machine is the master, and for how long the wall stood still."""
    hall.await_whole(old)
    if way == "killed with etcd's leader":
        hall.lead_etcd_on(old)
    time.sleep(1)
    times, since, begun = hall.said(new, "takes over at"), a_moment_ago(), time.monotonic()
    if way == "changed":
        hall.spawn("order", old, [BIN / "aquarama", "set", hall.rig, "master", MACHINES[new], "--key",
                                  hall.folder / "operator.key"], hall.folder / "order.log", {})
    else:
        hall.kill(old)
    if way == "killed with etcd's leader":
        hall.kill(f"etcd on {old}")
    while hall.said(new, "takes over at") == times:
        if time.monotonic() - begun > PATIENCE:
            hall.print_logs()
            raise AssertionError("nobody takes over")
        time.sleep(0.01)
    seconds = time.monotonic() - begun
    time.sleep(3)  # it is seen to be shown
    still = hall.longest_gap_ms(CHANNELS, since) / 1e3
    if way == "killed with etcd's leader":
        hall.start_etcd(old)
    if way != "changed":
        hall.start_machine(old)
    return seconds, still


def quantiles(seconds):
    ordered = sorted(seconds)
    return f"{statistics.median(ordered):.2f} / {ordered[int(0.99 * (len(ordered) - 1))]:.2f} / {ordered[-1]:.2f}"


def take_over_often(hall, order, options, way):
    measured = []
    for _ in range(options.takeovers):
        measured.append(takeover(hall, *order, way))
        order.reverse()
    taken, still = zip(*measured)
    report(f"master {way}, {options.takeovers} x ", master_s=quantiles(taken), wall_still_s=quantiles(still),
           of="(median / 99 % / most)")


def lead_after(hall):
    """Who leads once all is well again: exactly one."""
    wait_until(lambda: sum(map(hall.leads, MACHINES)) == 1, PATIENCE, "one master")
    leader = next(machine for machine in MACHINES if hall.leads(machine))
    hall.await_whole(leader)
    return leader


def cut(hall, machines, options):
    since = a_moment_ago()
    for machine in machines:
        hall.plug(machine, False)
    time.sleep(options.cut)
    both = sum(map(hall.leads, MACHINES))
    for machine in machines:
        hall.plug(machine, True)
    begun = time.monotonic()
    leader = lead_after(hall)
    seconds, still = time.monotonic() - begun, hall.longest_gap_ms(CHANNELS, since) / 1e3
    report(f"cables of {', '.join(machines)} out", masters_meanwhile=both, whole_after_s=f"{seconds:.1f}",
           wall_still_s=f"{still:.2f}", leads=leader)
    assert both <= 1, "two masters"


def lost_packets(hall, options):
    gaps = hosts.intervals_with_loss_ms(hall, options.cut + 5)
    report("1 % of packets lost", frames_ms=hosts.quantiles(gaps) + " (median / 99 % / most)", leads=lead_after(hall))


def slow_cables(hall, options):
    """To both machines that may be the master; they stay slow."""
    cables = [hosts.SlowCable(hall, machine, 0, 20) for machine in MACHINES]
    leader = lead_after(hall)
    since = time.monotonic_ns()
    time.sleep(options.cut + 5)
    gaps = hall.intervals_ms(CHANNELS, since)
    report("both 0 to 20 ms away, each way", frames_ms=hosts.quantiles(gaps) + " (median / 99 % / most)",
           led=leader, leads=lead_after(hall))
    for cable in cables:
        cable.over = True


def start_all(hall):
    for machine in MEMBERS:
        hall.start_etcd(machine)
    wait_until(hall.etcd_leader, PATIENCE, "etcd")
    hall.start_machine("master")
    for name in CHANNELS:
        hall.start_node(name)
    wait_until(lambda: hall.leads("master"), 120, "the first master")
    hall.start_machine("spare")


def hurt(hall, options):
    order = ["master", "spare"]
    for way in ("killed", "killed with etcd's leader", "changed"):
        take_over_often(hall, order, options, way)
    hall.await_whole(order[0])
    lost_packets(hall, options)
    for machines in [one for count in (1, 2) for one in itertools.combinations(ADDRESS, count)]:
        cut(hall, machines, options)
    slow_cables(hall, options)
    refused = sum(hall.said(name, "nothing that it says counts") for name in CHANNELS)
    differs = sum(hall.said(machine, "differs from the master's") for machine in MACHINES)
    report("all in all", masters_of_an_older_lease_refused=refused, worlds_that_differed=differs)
    assert differs == 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--takeovers", type=int, default=5)
    parser.add_argument("--cut", type=float, default=3)
    options = parser.parse_args()
    with temporary_folder() as folder:
        hall = Hall(folder)
        try:
            start_all(hall)
            hurt(hall, options)
        finally:
            end(hall.processes.values())


if __name__ == "__main__":
    main()
