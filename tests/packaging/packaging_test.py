"""An installation is whole, and what the packages say of it holds: files, units, versions, manual pages, dependencies.

packaging/try-packages.sh builds and installs the packages themselves.
"""

import os
import re
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ["AQUARAMA_BIN"]).parent
DEBIAN = ROOT / "packaging/debian"
UNITS = "usr/lib/systemd/system"
MOST_EXPOSED = 2.5  # by systemd-analyze security, of 10
VERSION = re.search(r"project\(aquarama VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def called(*command, **more):
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, **more)


def unit_files():
    """Each unit of the packages by the name that debhelper gives it: PACKAGE.NAME.service is NAME.service."""
    for path in sorted(DEBIAN.iterdir()):
        parts = path.name.split(".")
        if parts[-1] in ("service", "target", "path"):
            yield ".".join(parts[-2:]), path


def lines_of(name):
    """(source, folder) of each line of the packages' lists of this kind."""
    for path in sorted(DEBIAN.glob(f"*.{name}")):
        for line in path.read_text().splitlines():
            source, *folder = line.split()
            yield source, folder[0] if folder else None


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        done = called("cmake", "--install", BUILD, "--prefix", "/usr", env={**os.environ, "DESTDIR": str(cls.root)})
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr)
        cls.files = {str(path.relative_to(cls.root)) for path in cls.root.rglob("*") if path.is_file()}
        cls.programs = [path for path in sorted((cls.root / "usr/bin").iterdir())
                        if path.name not in ("aquarama-hall", "aquarama-outputs", "aquarama-solve")]
        cls.alone = {"HOME": str(cls.root / "nobody"), "PATH": "/usr/bin:/bin"}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_each_file_is_in_a_package_and_each_packaged_file_is_there(self):
        named = [source for source, _ in lines_of("install")]
        homeless = {file for file in self.files
                    if not any(file == name or file.startswith(name + "/") for name in named)}
        self.assertEqual(homeless, set())
        for name in named:
            self.assertTrue((self.root / name).exists() or (ROOT / name).exists(), name)

    def test_programs_run_from_where_they_are_installed(self):
        self.assertEqual([program.name for program in self.programs],
                         ["aquarama", "aquarama-calibrate", "aquarama-compose", "aquarama-console", "aquarama-drawings",
                          "aquarama-guests",
                          "aquarama-node"])
        for program in self.programs:
            said = called(program, "--version", cwd="/", env=self.alone)
            self.assertEqual((said.returncode, said.stdout.split("\n")[0].split()[-1]), (0, VERSION),
                             program.name + said.stderr)

    def test_former_names_of_programs_work_and_name_the_new_one(self):
        solver = self.root / "usr/bin/aquarama-solve"
        said = called(solver, "--help", cwd="/", env=self.alone)
        self.assertEqual(said.returncode, 0)
        self.assertIn("--simulate", said.stdout)
        self.assertRegex(said.stderr, r"\Aaquarama-solve: .* called aquarama-calibrate now; .* next release\n\Z")
        desk = self.root / "usr/share/aquarama/config/desk.txtpb"
        said = called(self.root / "usr/bin/aquarama-calibrate", "check", desk, cwd="/", env=self.alone)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("left", said.stdout)
        self.assertIn("check is a command of aquarama-compose now", said.stderr)
        said = called(self.root / "usr/bin/aquarama", "theatre", "--help", cwd="/", env=self.alone)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertRegex(said.stdout, r"(?m)^Usage: aquarama view ")
        self.assertIn('"theatre" is called "view" now', said.stderr)
        self.assertNotIn("theatre", called(self.root / "usr/bin/aquarama", "--help", cwd="/", env=self.alone).stdout)

    def test_installed_rigs_scenes_and_species_are_good(self):
        config = self.root / "usr/share/aquarama/config"
        of_source = {path.relative_to(ROOT / "config") for path in (ROOT / "config").rglob("*") if path.is_file()}
        self.assertEqual({path.relative_to(config) for path in config.rglob("*") if path.is_file()}, of_source)
        rigs = sorted(config.glob("*.txtpb"))
        said = called(self.root / "usr/bin/aquarama", "check", *rigs, *sorted(config.glob("s*/*.txtpb")), cwd="/",
                      env=self.alone)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertGreater(len(rigs), 5)

    def test_scripts_that_draw_figures_are_installed(self):
        sources = [*(ROOT / "master").rglob("*.py"), *(ROOT / "capture").rglob("*.py")]
        self.assertGreater(len(sources), 3)
        for source in sources:
            self.assertTrue((self.root / "usr/share/aquarama" / source.relative_to(ROOT)).is_file(), source)

    def test_each_program_has_a_page_with_all_its_commands_and_options(self):
        programs = self.root / "programs"
        shutil.copytree(self.root / "usr/bin", programs, copy_function=os.symlink)
        written = called(ROOT / "packaging/write_manual_pages.py", programs, self.root / "pages", env=self.alone)
        self.assertEqual(written.returncode, 0, written.stderr)
        listed = {Path(source).name for source, _ in lines_of("manpages")}
        self.assertEqual({path.name for path in (self.root / "pages").iterdir()}, listed)
        page = (self.root / "pages/aquarama.1").read_text()
        for command in re.findall(r"^  ([a-z]+)  ", called(programs / "aquarama", "--help").stdout, re.M):
            self.assertIn(f'.SS "{command}"', page)
            said = called(programs / "aquarama", command, "--help").stdout
            of_page = page if f'.SS "{command}"\nSee' not in page else "".join(
                path.read_text() for path in (self.root / "pages").iterdir())
            for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", said, re.M):
                self.assertIn(option.replace("-", "\\-"), of_page, command)


class Units(unittest.TestCase):
    """The units in a root of their own, where what other packages bring is stood in for."""

    @classmethod
    def setUpClass(cls):
        if not shutil.which("systemd-analyze"):
            if os.environ.get("CI"):
                raise RuntimeError("no systemd-analyze; install what packaging/packages/test.txt names")
            raise unittest.SkipTest("no systemd-analyze: the units are not checked")
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        (cls.root / UNITS).mkdir(parents=True)
        for path in Path("/lib/systemd/system").iterdir():
            if path.suffix in (".target", ".slice", ".mount", ".path"):
                shutil.copy(path, cls.root / UNITS)
        cls.units = []
        for name, path in unit_files():
            shutil.copy(path, cls.root / UNITS / name)
            cls.units.append(name)
        for program in re.findall(r"^Exec\w+=(\S+)", cls.text(), re.M):
            target = cls.root / program[1:]
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy("/bin/true", target)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def text(cls):
        return "\n".join(path.read_text() for _, path in unit_files())

    def verified(self, *units):
        return called("systemd-analyze", "verify", "--man=no", f"--root={self.root}", *units).stderr

    def test_systemd_finds_nothing(self):
        units = [name.replace("@", "@left") for name in self.units]
        self.assertEqual(sorted(units),
                         ["aquarama-console.service", "aquarama-guests.service", "aquarama-master.service",
                          "aquarama-node@left.service", "aquarama-power.path", "aquarama-power.service",
                          "aquarama-time.path", "aquarama-time.service", "aquarama-ups.service",
                          "aquarama-x@left.service", "aquarama.target"])
        self.assertEqual(self.verified(*units), "")

    def test_a_key_in_the_wrong_section_is_found(self):
        text = (DEBIAN / "aquarama-master.service").read_text().replace("StartLimitIntervalSec=0\n", "")
        (self.root / UNITS / "aquarama-wrong.service").write_text(
            text.replace("[Service]\n", "[Service]\nStartLimitIntervalSec=0\n"))
        self.assertIn("StartLimitIntervalSec", self.verified("aquarama-wrong.service"))

    def test_services_are_little_exposed(self):
        services = [name for name in self.units if name.endswith(".service")]
        for name in services:
            said = called("systemd-analyze", "security", "--offline=true", "--no-pager",
                          self.root / UNITS / name).stdout
            exposed = float(re.search(r"exposure level for \S+: ([\d.]+)", said).group(1))
            self.assertLessEqual(exposed, MOST_EXPOSED, name)

    def test_strangers_speak_to_a_user_of_its_own(self):
        units = {name: path.read_text() for name, path in unit_files()}
        self.assertEqual([name for name, text in units.items() if "User=aquarama-guests\n" in text],
                         ["aquarama-guests.service"])
        self.assertNotIn("SupplementaryGroups=", units["aquarama-guests.service"])
        with tempfile.TemporaryDirectory() as root:
            (Path(root) / "etc").mkdir()
            called("systemd-sysusers", f"--root={root}", DEBIAN / "aquarama-guests.sysusers")
            made = [line.split(":") for line in (Path(root) / "etc/passwd").read_text().splitlines()]
            groups = (Path(root) / "etc/group").read_text().split()
        self.assertEqual([(user[0], user[5], user[6]) for user in made if user[0] != "root"],
                         [("aquarama-guests", "/", "/usr/sbin/nologin")])
        self.assertEqual([line.split(":")[0] for line in groups if "aquarama" in line], ["aquarama-guests"])
        keys = re.findall(r"/etc/aquarama/keys\S*", units["aquarama-guests.service"])
        self.assertEqual(keys, ["/etc/aquarama/keys/hall/guests.key", "/etc/aquarama/keys:ro"])

    def test_what_shows_the_wall_is_started_again_for_ever(self):
        for name, path in unit_files():
            if name.endswith(".service") and name.split(".")[0] not in ("aquarama-power", "aquarama-time",
                                                                        "aquarama-ups"):
                unit, service = path.read_text().split("[Service]")
                self.assertIn("StartLimitIntervalSec=0", unit, name)
                self.assertIn("Restart=always", service, name)
                self.assertEqual("WatchdogSec=10" in service, name.startswith(("aquarama-master", "aquarama-node")),
                                 name)


class Power(unittest.TestCase):
    def tried(self, text):
        """What systemctl is told, exit status, and whether the word is still there."""
        with tempfile.TemporaryDirectory() as folder:
            word, told = Path(folder, "word"), Path(folder, "told")
            word.write_text(text)
            stand_in = Path(folder, "systemctl")
            stand_in.write_text(f'#!/bin/sh\necho "$@" >{told}\n')
            stand_in.chmod(stand_in.stat().st_mode | stat.S_IXUSR)
            done = called(ROOT / "packaging/hall/power", word, env={"PATH": f"{folder}:/usr/bin:/bin"})
            return told.read_text().strip() if told.exists() else None, done.returncode, word.exists()

    def test_each_word_is_done_once(self):
        self.assertEqual(self.tried("poweroff\n"), ("--no-block poweroff", 0, False))
        self.assertEqual(self.tried("reboot"), ("--no-block reboot", 0, False))

    def test_any_other_word_does_nothing(self):
        for text in ("", "halt\n", "poweroff; reboot\n", "isolate rescue.target\n"):
            self.assertEqual(self.tried(text), (None, 1, False), text)


class Time(unittest.TestCase):
    """Whom this machine's clock follows, by the keys of its nodes."""

    KEY = 'version: 1\nrig: "hall"\nmaster_address: "tcp://{}:7400"\nmaster_key: "m"\nname: "left"\n'

    def test_the_clock_follows_the_machine_that_the_keys_name(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, host in (("keys/left", "192.168.7.1"), ("keys/middle", "192.168.7.1"), ("state/node", "fe.local"),
                               ("keys/hall/right", "10.0.0.9")):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / f"{name}.key").write_text(self.KEY.format(host))
            (root / "keys/broken.key").write_text('master_address: "tcp://10.0.0.8:7400; reboot"\n')
            environment = {"PATH": "/usr/bin:/bin", "AQUARAMA_KEYS": f"{root}/keys {root}/state",
                           "AQUARAMA_TIME_SOURCES": str(root / "chrony")}
            for _ in range(2):
                self.assertEqual(called(ROOT / "packaging/hall/time", env=environment).returncode, 0)
                self.assertEqual((root / "chrony/aquarama.sources").read_text(),
                                 "server 192.168.7.1 iburst\nserver fe.local iburst\n")
            for key in root.rglob("*.key"):
                key.unlink()
            self.assertEqual(called(ROOT / "packaging/hall/time", env=environment).returncode, 0)
            self.assertEqual((root / "chrony/aquarama.sources").read_text(), "")


class Mirror(unittest.TestCase):
    """What a fresh system is told of this machine's apt: how the mirror is reached, and nothing else."""

    SETTINGS = """
        Acquire::http::Proxy "http://cache.hall:3142/";
        Acquire::http::Proxy::mirror.hall "DIRECT";
        Acquire::https::CaInfo "{root}/hall.pem";
        Acquire::Check-Date "false";
        Acquire::IndexTargets { deb::DEP-11 { MetaKey "dep11.yml"; }; };
        Acquire::Languages { "none"; };
        DPkg::Post-Invoke { "echo a program that the system lacks"; };
        APT::Install-Recommends "true";
    """

    def told(self, settings, **environment):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "hall.pem").write_text("certificate")
            (root / "apt.conf").write_text(settings.replace("{root}", folder))
            done = called(ROOT / "packaging/take-over-mirror.sh", root / "system/etc/apt",
                          env={**os.environ, "APT_CONFIG": str(root / "apt.conf"), **environment})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            written = {path.name: path.read_text().replace(folder, "{root}")
                       for path in (root / "system/etc/apt/apt.conf.d").iterdir()}
            self.assertEqual([*written], ["99mirror"])
            return written["99mirror"], Path(f"{root}/system{folder}/hall.pem").exists()

    def test_proxy_certificate_and_dates_are_taken_over_and_nothing_else(self):
        text, certificate = self.told(self.SETTINGS)
        self.assertTrue(certificate)
        for line in ('Acquire::http::Proxy "http://cache.hall:3142/";', 'Acquire::http::Proxy::mirror.hall "DIRECT";',
                     'Acquire::https::CaInfo "{root}/hall.pem";', 'Acquire::Check-Date "false";'):
            self.assertIn(line, text.splitlines())
        for line in text.splitlines():
            self.assertRegex(line, "^Acquire::(https?::|Check-|M..-ValidTime|ForceIPv|Retries)")

    def test_a_proxy_of_the_environment_or_that_a_program_finds_is_written_out(self):
        text, _ = self.told("", http_proxy="http://of.environment:8080")
        self.assertIn('Acquire::http::Proxy "http://of.environment:8080";', text.splitlines())
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o755)  # apt runs it as a user of its own
            finder = Path(folder, "finder")
            finder.write_text("#!/bin/sh\necho http://found.hall:3142/\n")
            finder.chmod(0o755)
            text, _ = self.told(f'Acquire::http::Proxy-Auto-Detect "{finder}";')
        self.assertIn('Acquire::http::Proxy "http://found.hall:3142/";', text.splitlines())
        self.assertNotIn("Detect", text)


class Release(unittest.TestCase):
    def test_all_tell_one_version(self):
        self.assertEqual(re.match(r"aquarama \(([^)]*)\)", (DEBIAN / "changelog").read_text()).group(1), VERSION)
        headings = re.findall(r"^## (.+)", (ROOT / "CHANGELOG.md").read_text(), re.M)
        newest = next(heading for heading in headings if heading != "Unreleased")
        self.assertRegex(newest, rf"^{re.escape(VERSION)} - \d{{4}}-\d\d-\d\d$")

    def test_packages_are_built_from_what_the_lists_name(self):
        control = (DEBIAN / "control").read_text()
        built_from = set(re.search(r"Build-Depends:\n(.*?)\n\n", control, re.S).group(1).replace(",", " ").split())
        for name in ("run", "calibrate", "console", "drawings", "guests"):
            lines = (ROOT / f"packaging/packages/{name}.txt").read_text().splitlines()
            listed = {package for line in lines if not line.startswith("#") for package in line.split()}
            self.assertEqual({package for package in listed if package.endswith("-dev")} - built_from, set(), name)

    def test_each_package_has_what_its_name_says(self):
        packages = set(re.findall(r"^Package: (\S+)", (DEBIAN / "control").read_text(), re.M))
        names = ("master", "node", "calibrate", "console", "drawings", "guests", "kiosk", "doc")
        self.assertEqual(packages, {"aquarama", *(f"aquarama-{name}" for name in names)})
        for path in DEBIAN.glob("aquarama*"):
            self.assertIn(path.name.split(".")[0].rstrip("@"), packages)


if __name__ == "__main__":
    unittest.main(verbosity=2)
