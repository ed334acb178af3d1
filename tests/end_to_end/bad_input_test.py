"""Bad input gets one line on stderr that says what, where and what to do, and status 2 for usage, 1 for everything
else."""

import re
import socket
import subprocess
import unittest
from pathlib import Path

from show import BIN, ROOT, aquarama, control_address, end, rig_on_free_ports, start, temporary_folder, wait_until

PROGRAMS = ["aquarama", "aquarama-node", "aquarama-compose"]
COMMANDS = ["new-rig", "run", "replay", "master", "node", "capture", "export", "gaits", "forms", "search", "fidelity",
            "controllers", "study", "check",
            "inspect", "status", "pilot", "explain"]
STARTED = r"starting the master and 3 nodes of \S+\n(\[.*\n)*"


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder()
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def said(self, run, status, stdout, stderr):
        """The whole output, each stream a regular expression in which a dot stays within its line."""
        self.assertRegex(run.stderr, rf"\A{stderr}\Z")
        self.assertRegex(run.stdout, rf"\A{stdout}\Z")
        self.assertEqual(run.returncode, status)

    def refuses(self, line, *arguments, stdout="", **options):
        """One line, before any process of a show starts."""
        self.said(aquarama(*arguments, timeout=60, **options), 1, stdout, line + "\n")

    def ends(self, line, *arguments, **options):
        """One line of `aquarama run`, of a process that it has started."""
        self.refuses(line, "run", *arguments, "--headless", "--frames", 1, stdout=STARTED, **options)

    def misused(self, line, *arguments, program="aquarama"):
        run = subprocess.run([BIN / program, *map(str, arguments)], capture_output=True, text=True, timeout=60,
                             cwd=ROOT)
        self.said(run, 2, "", rf"{line}; see (aquarama[ \w-]*) --help\n")

    def edited(self, *replace):
        return rig_on_free_ports(self.folder.name, replace=replace)


class Usage(Case):
    def test_unknown_arguments_and_commands(self):
        self.misused("aquarama run: The following argument was not expected: --warp-nine", "run", "--warp-nine")
        self.misused("aquarama: The following argument was not expected: dance", "dance")
        self.misused("aquarama: a command is required")
        for command in COMMANDS:
            with self.subTest(command):
                self.misused(
                    r"aquarama[\w -]*: The following arguments? (was|were) not expected: (\S+ )*--warp-nine( \S+)*|"
                             r"aquarama[\w -]*: .* is required", command, "--warp-nine")
        for program in PROGRAMS:
            with self.subTest(program):
                self.misused(rf"{program}[\w -]*: .*(--warp-nine|required).*", "--warp-nine", program=program)

    def test_a_number_out_of_range_is_refused_with_what_is_allowed(self):
        whole, count = "a whole number from", "1 to 1000000000"
        seed = f"{whole} 0 to 4294967295"
        for command, program, option, allowed in [
            ("run", "aquarama run", "--frames", f"{whole} {count}"),
            ("run", "aquarama run", "--seed", seed),
            ("run", "aquarama run", "--fish", f"{whole} 0 to 1000000"),
            ("run --clip a.mp4", "aquarama run", "--film-every", f"{whole} 1 to 10000"),
            ("replay FILE", "aquarama replay", "--frames", f"{whole} {count}"),
            ("master RIG", "aquarama master", "--frames", f"{whole} {count}"),
            ("master RIG", "aquarama master", "--seed", seed),
            ("master RIG", "aquarama master", "--fish", f"{whole} 0 to 1000000"),
            ("explain", "aquarama explain", "--fish", f"{whole} 0 to 1000000"),
            ("explain --fish 1 --replay FILE", "aquarama explain", "--tick", f"{whole} 0 to 1000000000"),
            ("node NAME --master tcp://127.0.0.1:1 --film PIPE", "aquarama node", "--film-every",
             f"{whole} 1 to 10000"),
            ("study", "aquarama study", "--seeds", f"{whole} 1 to 100"),
            ("study", "aquarama study", "--minutes", "a number from 0.1 to 1440"),
            ("study chronicle SCENE", "aquarama study chronicle", "--hours", "a number from 0.01 to 1000"),
            ("study chronicle SCENE", "aquarama study chronicle", "--seed", seed),
            ("study wall RIG", "aquarama study wall", "--hours", "a number from 0.01 to 1000"),
            ("study wall RIG", "aquarama study wall", "--seed", seed),
            ("export FILE --segment forward_slow --csv a", "aquarama export", "--cycles", f"{whole} 1 to 1000"),
            ("fidelity --out DIR", "aquarama fidelity", "--seed", seed),
            ("fidelity --out DIR", "aquarama fidelity", "--seconds", "a number from 1 to 3600"),
            ("search SPECIES --out FILE", "aquarama search", "--trials", f"{whole} 1 to 1000000"),
        ]:
            for value in ["-1", "99999999999999999999", "many", "3x",
                          "nan"] + (["0"] if "from 0 " not in allowed else []):
                with self.subTest(command, option=option, value=value):
                    self.misused(f'{program}: {option}: "{value}" is not {allowed}', *command.split(),
                                 f"{option}={value}")
        self.misused(f'aquarama run: --frames: "-1" is not {whole} {count}', "run", "--frames", -1)

    def test_numbers_as_people_write_them_are_refused_with_what_to_type(self):
        """The option, the value, what is allowed and, where it is meant as a number that is, what to type."""
        for command, option, value, said in [
            ("fidelity --out DIR", "--seconds", "2,5", "a number from 1 to 3600: type 2.5"),
            ("fidelity --out DIR", "--seconds", "1 000", "a number from 1 to 3600: type 1000"),
            ("fidelity --out DIR", "--seconds", "1.000,5", "a number from 1 to 3600: type 1000.5"),
            ("fidelity --out DIR", "--seconds", "inf", "a number from 1 to 3600"),
            ("run", "--frames", "３", "a whole number from 1 to 1000000000: type 3"),
            ("run", "--frames", "+5", "a whole number from 1 to 1000000000: type 5"),
            ("run", "--frames", "12abc", "a whole number from 1 to 1000000000"),
            ("run", "--frames", "−5", r"a whole number from 1 to 1000000000: it has U\+2212 \(minus sign\): type -"),
            ("run", "--frames", "1e999", "a whole number from 1 to 1000000000"),
            ("new-rig x.txtpb", "--mount", "−5", "a number from -20 to 20: type -5"),
            ("new-rig x.txtpb", "--size", "1920×1080", r".*U\+00D7 \(multiplication sign\): type x"),
        ]:
            for arguments in ([option, value], [f"{option}={value}"]):
                with self.subTest(command, value=value):
                    what = said if said.startswith(".*") else rf'"{re.escape(value)}" is not {said}'
                    self.misused(rf"aquarama {command.split()[0]}: {option}: {what}", *command.split(), *arguments)
        for place, value, said in [(0, "10,5", "X.*type 10.5"), (1, "２０", "Y.*type 20"), (2, "nan", "RIGHT.*"),
                                   (3, "1e9", "DOWN.*")]:
            numbers = ["1", "2", "3", "4"]
            numbers[place] = value
            self.misused(f"aquarama adjust move: {said}", "adjust", "move", self.edited(), "left", *numbers)
        self.refuses(r'aquarama adjust mask: CORNERS "1,5,2,5" is no corner: write X,Y as in 10,20\.5, .*', "adjust",
                     "mask",
                     self.edited((r"scene:", 'adjustments: "a.txtpb" scene:')), "1,5,2,5", "3,4", "5,6")

    def test_dashes_and_quotes_of_office_programs_are_named(self):
        for argument, typed in [("–frames", "--frames"), ("—frames", "--frames"), ("−-headless", "--headless")]:
            self.misused(rf'aquarama run: "{argument}" begins with U\+\w+ \([\w ]+\): type {typed}', "run",
                         "--headless", argument, 1)
        self.misused(r'aquarama run: --quality: .*U\+201C \(left double quotation mark\): type "', "run", "--quality",
                     "“high”")

    def test_bytes_that_are_no_text_are_shown_as_such(self):
        run = subprocess.run([BIN / "aquarama", "set", "config/desk.txtpb", "scene", b"b\xfchne"], capture_output=True,
                             timeout=60, cwd=ROOT)
        self.assertEqual((run.returncode, run.stdout), (2, b""))
        self.assertIn(b"aquarama set: VALUE: \"b\\xFChne\" has byte 0xFC (\xc3\xbc in Latin-1): type it without",
                      run.stderr)
        run = subprocess.run([BIN / "aquarama", "run", b"b\xfchne\x1b[2J.txtpb"], capture_output=True, timeout=60,
                             cwd=ROOT)
        self.assertEqual((run.returncode, run.stdout), (1, b""))
        self.assertRegex(run.stderr, rb"\Aaquarama run: b\\xFChne\\x1B\[2J\.txtpb: cannot be read.*\n\Z")

    def test_options_that_need_or_exclude_each_other(self):
        self.misused("aquarama run: --deep requires --snapshot", "run", "--headless", "--frames", 1, "--deep")
        self.misused("aquarama replay: --deep requires --snapshot", "replay", "FILE", "--deep")
        self.misused("aquarama run: --clip-of requires --clip", "run", "--clip-of", "hall")
        self.misused("aquarama run: --(live|clip) excludes --(live|clip)", "run", "--live", "--clip", "a.mp4")
        self.misused('aquarama run: --clip: "a.avi" is not FILE.mp4 or FILE.webp', "run", "--clip", "a.avi")
        self.misused("aquarama node: --deep requires --snapshot", "node", "left", "--master", "tcp://127.0.0.1:1",
                     "--deep")

    def test_the_scale_of_a_snapshot(self):
        run = ["run", "--headless", "--frames", 1]
        self.misused("aquarama run: --scale requires --snapshot", *run, "--scale", 2)
        self.misused("aquarama replay: --scale requires --snapshot", "replay", "FILE", "--scale", 2)
        self.misused("aquarama run: --(scale|pattern) excludes --(scale|pattern)", *run, "--snapshot", "show",
                     "--scale", 2, "--pattern", "grid")
        for wrong in ("0", "99", "x", "2.5", "-1"):
            with self.subTest(wrong):
                self.misused(rf'aquarama run: --scale: "{wrong}" is not a whole number from 1 to 8', *run,
                             "--snapshot", "show", "--scale", wrong)
        self.refuses(r"aquarama run: --scale 8: the panorama would be 32000 x 8000 pixels; 16384 pixels each way and "
                     r"67 million in all are possible; take a smaller one", "run", "config/theatre.txtpb",
                     "--headless", "--snapshot", Path(self.folder.name) / "show", "--scale", 8)
        self.assertFalse((Path(self.folder.name) / "show").exists())

    def test_a_malformed_address(self):
        self.misused(r'aquarama node: --master: "somewhere" is not an address; write it as tcp://HOST:PORT',
                     "node", "left", "--master", "somewhere", "--headless")

    def test_a_command_that_another_program_carries_out_has_the_name_that_was_typed(self):
        for command in ("check", "view", "calibrate", "drift", "node", "console", "inspect", "sheets"):
            with self.subTest(command):
                self.assertRegex(aquarama(command, "--help").stdout, rf"(?m)^Usage: aquarama {command} ")
                wrong = aquarama(command, "--warp-nine")
                self.assertRegex(wrong.stderr, rf"\Aaquarama {command}: .*; see aquarama {command} --help\n\Z")
        for command in ("check", "console", "node"):
            self.assertTrue(aquarama(command, "--version").stdout.startswith("aquarama"), command)
        self.refuses(r"aquarama console: nowhere\.txtpb: .*", "console", "nowhere.txtpb")
        self.refuses(r"aquarama inspect: nowhere\.txtpb: .*", "inspect", "nowhere.txtpb")
        direct = subprocess.run([BIN / "aquarama-compose", "check", "nowhere.txtpb"], capture_output=True, text=True,
                                timeout=60, cwd=ROOT)
        self.assertRegex(direct.stderr, r"\Aaquarama-compose check: nowhere\.txtpb: .*\n\Z")

    def test_help_is_for_every_command_and_says_what_inspect_takes(self):
        for command in COMMANDS:
            asked = aquarama(command, "--help")
            self.assertEqual((asked.returncode, asked.stderr), (0, ""), command)
            self.assertIn("--help", asked.stdout)
        inspect = aquarama("inspect", "--help").stdout
        for word in ["rig", "scene", "species", "repertoire", "recording", "--report"]:
            self.assertIn(word, inspect)

    def test_version_names_commit_build_and_the_libraries_that_the_program_links(self):
        links = {"aquarama": ["ZeroMQ", "Protobuf", "Eigen", "NLopt"],
                 "aquarama-node": ["GLFW", "OpenSubdiv", "ZeroMQ"],
                 "aquarama-compose": ["FFmpeg-libavcodec"]}
        for program in PROGRAMS:
            run = subprocess.run([BIN / program, "--version"], capture_output=True, text=True, timeout=60)
            self.said(run, 0, rf"{program} \d+\.\d+\.\d+\n"
                              r"commit     ([0-9a-f]{12}( and changes)?|unknown)\n"
                              r"build      (Debug|Release), GNU \d+\.\d+\.\d+\n"
                              r"libraries  ([\w-]+ \d[\w.]*, )*[\w-]+ \d[\w.]*\n", "")
            for library in links[program]:
                self.assertIn(f" {library} ", run.stdout)
        own = aquarama("--version").stdout
        for library in ["GLFW", "FFmpeg-libavcodec"]:
            self.assertNotIn(library, own)
        for command in set(COMMANDS) - {"node", "check"}:
            self.assertEqual(aquarama(command, "--version").stdout, own, command)


class Files(Case):
    def test_an_unknown_field_is_named_with_its_place_in_plain_words(self):
        rig = self.edited((r"screen \{", "screen { curvature: 3"))
        self.refuses(
            r'aquarama check: \S+/desk\.txtpb:\d+:\d+: screen has no field named "curvature"; correct its name or '
            r'remove it',
                     "check", rig)

    def test_files_as_editors_save_them(self):
        """With a byte order mark they are read; what is of another alphabet is named with what to type."""
        text = Path(self.edited()).read_bytes()
        marked = self.path / "marked.txtpb"
        good = aquarama("check", self.edited())
        marked.write_bytes(b"\xef\xbb\xbf" + text)
        self.assertEqual(aquarama("check", marked).returncode, good.returncode)
        self.assertEqual(aquarama("inspect", marked).returncode, 0)
        for old, new, said in [
            (rb'name: *"([\w ]+)"', "name: “desk”".encode(), r"U\+201C \(left double quotation mark\): type \""),
            (rb"refresh_hz: *(\d+)", b"refresh_hz: 60,0", r'"60,0" is no number here: type 60\.0'),
            (rb"screen \{", "screen\u00a0{".encode(), r"U\+00A0 \(no-break space\): type a space"),
            (rb"screen \{", b"# k\xfcste\nscreen {", r"byte 0xFC \(ü in Latin-1\) is no UTF-8: save the file as UTF-8"),
        ]:
            edited = re.sub(old, new, text, count=1)
            if edited == text:
                continue
            marked.write_bytes(edited)
            self.refuses(rf"aquarama(?:-calibrate)? check: \S+/marked\.txtpb:\d+:\d+: {said}", "check", marked)
        marked.write_bytes(b"\xff\xfe" + text.decode().encode("utf-16-le"))
        self.refuses(
            r"aquarama(?:-calibrate)? check: \S+/marked\.txtpb:1:1: the file is saved as UTF-16: save it as UTF-8",
            "check", marked)

    def test_what_a_wall_file_asks_for_and_is_not_done_is_said_once(self):
        mesh = self.path / "left.ol"
        mesh.write_text("OPENMESH Version 1.1\nVERTICES 4\nFACES 2\nMAPPING NORMALIZED\nNATIVEXRES 64\nNATIVEYRES 48\n"
                        "APPLY_MASK 1\nDO_NO_WARP 1\nAPPLY_COLOR 0\n0 0 255 0 0\n64 0 255 1 0\n0 48 255 0 1\n64 48 255 "
                        "1 1\n"
                        "[ 0 1 2 ]\n[ 1 3 2 ]\n")
        run = aquarama("convert", mesh, self.path / "left.mpcdi")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(re.findall(r"left\.ol:(\d+): (\w+) 1: ", run.stdout),
                         [("7", "APPLY_MASK"), ("8", "DO_NO_WARP")])

    def test_overlapping_ids(self):
        rig = self.edited((r"\bid: 2\b", "id: 1"))
        self.refuses(r"aquarama check: \S+/desk\.txtpb:\d+:\d+: .*\b1\b.*", "check", rig)

    def test_a_projector_that_misses_the_screen(self):
        rig = Path(self.edited())
        rig.write_text(re.sub(r"yaw_deg: *-?[\d.]+", "yaw_deg: 170", rig.read_text(), count=1))
        self.refuses(r"aquarama check: \S+/desk\.txtpb:\d+:\d+: .*misses the screen.*", "check", rig)
        self.ends(r"aquarama master: \S+/desk\.txtpb:\d+:\d+: .*misses the screen.*", rig)

    def test_a_window_of_no_size(self):
        rig = self.edited((r"width_px: *480", "width_px: 0"))
        self.refuses(r"aquarama check: \S+/desk\.txtpb:\d+:\d+: width_px is 0: .*", "check", rig)

    def test_all_files_are_checked_and_each_bad_one_gets_a_line(self):
        one, other = self.path / "one.txtpb", self.path / "other.txtpb"
        one.write_text("screens {}")
        other.write_text('name: "rig" screen { radius_m: 0 }')
        good = ROOT / "config/scenes/reef.txtpb"
        both = aquarama("check", one, good, other)
        self.said(both, 1, r"(?s:.+)", r'aquarama check: \S+/one\.txtpb:1:\d+: rig has no field named "screens"; .*\n'
                                       r"aquarama check: \S+/other\.txtpb:1:\d+: .*\n")
        self.assertEqual(both.stdout, aquarama("check", good).stdout)
        self.assertEqual(aquarama("check", good, good).stdout, 2 * both.stdout)

    def test_a_rig_that_is_not_there(self):
        self.refuses(r"aquarama check: nowhere\.txtpb: cannot be read.*", "check", "nowhere.txtpb")
        self.refuses(r"aquarama run: nowhere\.txtpb: cannot be read.*", "run", "nowhere.txtpb", "--headless",
                     "--frames", 1)

    def test_a_scene_that_is_not_there(self):
        self.ends(r"aquarama master: nowhere\.txtpb: cannot be read.*", self.edited(), "--scene", "nowhere.txtpb")
        rig = self.edited((r"reef\.txtpb", "atlantis.txtpb"))
        self.ends(r"aquarama master: \S+/desk\.txtpb:\d+:\d+: .*atlantis.*", rig)
        self.refuses(r"aquarama check: \S+/desk\.txtpb:\d+:\d+: .*atlantis.*", "check", rig, stdout="(.* lights .*\n)*")

    def test_a_mistake_in_a_scene_and_in_a_species_of_it(self):
        scene = (ROOT / "config/scenes/reef.txtpb").read_text().replace("../species", str(ROOT / "config/species"))
        species = (ROOT / "config/species/parrotfish.txtpb").read_text()
        hunt = 'hunt { prey: "clownfish" chase_s: 1 give_up_m: 1 rest_s: 1 }'
        (self.path / "odd.txtpb").write_text(species.replace("persistence:", hunt + " persistence:"))
        own = self.path / "own.txtpb"
        for wrong, expected in [
            (scene.replace("plankton: 1200", "plankton: -3"), r"\S+/own\.txtpb:\d+:\d+: .*"),
            (scene.replace("blue_tang", "mermaid"), r"\S+/own\.txtpb:\d+:\d+: .*mermaid.*"),
            (scene.replace(str(ROOT / "config/species/parrotfish"), "odd"), r"\S+/odd\.txtpb:\d+:\d+: .*hunts.*"),
        ]:
            own.write_text(wrong)
            self.refuses("aquarama check: " + expected, "check", own)
            self.ends("aquarama master: " + expected, self.edited(), "--scene", own)

    def test_a_number_of_fish_that_the_scene_cannot_hold(self):
        reef = ROOT / "config/scenes/reef.txtpb"
        for fish, expected in [(0, "only an open sea"), (999_000, "room for")]:
            self.ends(rf"aquarama master: .*{expected}.*", self.edited(), "--scene", reef, "--fish", fish)

    def test_a_damaged_repertoire(self):
        out = aquarama("capture", "--species", "bigeye_scad", "--out", self.folder.name)
        self.assertEqual((out.returncode, out.stderr), (0, ""))
        whole = next(self.path.glob("*.aqrep"))
        content = bytearray(whole.read_bytes())
        self.assertEqual(aquarama("inspect", whole).returncode, 0)
        whole.write_bytes(content[:-100])
        self.refuses(rf"aquarama inspect: \S+/{whole.name}: .*", "inspect", whole)
        content[len(content) // 2] ^= 1
        whole.write_bytes(content)
        self.refuses(rf"aquarama inspect: \S+/{whole.name}: .*", "inspect", whole)

    def test_a_recording_that_is_none(self):
        none = self.path / "none.aqrec"
        for check in [["--check"], ["--headless"], []]:
            self.refuses(rf"aquarama replay: {none}: cannot be read; check the path", "replay", none, *check)
        none.write_text("a letter to somebody")
        self.refuses(rf"aquarama replay: {none}: is no recording of a show; .*", "replay", none, "--headless")

    def test_a_folder_that_cannot_be_written_is_refused_before_the_work(self):
        blocked = self.path / "file"
        blocked.write_text("")
        rig, inside = self.edited(), blocked / "inside"
        wrong = rf"--\w+ {inside}: cannot be written \(Not a directory\); choose another folder"
        for arguments in [("--snapshot", inside), ("--trace", inside)]:
            self.refuses(f"aquarama run: {wrong}", "run", rig, "--headless", "--frames", 1, *arguments)
        inside = blocked / "inside.mp4"
        wrong_file = rf"--\w+ {inside}: cannot be written \(Not a directory\); choose another folder"
        for option in ["--clip", "--record"]:
            self.refuses(f"aquarama run: {wrong_file}", "run", rig, "--headless", "--frames", 1, option, inside)
        self.refuses(f"aquarama master: {wrong_file}", "master", rig, "--record", inside)
        for command in [("fidelity", "--out"), ("forms", "--out"), ("controllers", "--out"), ("capture", "--out"),
                        ("capture", "--out", self.folder.name, "--report"),
                        ("inspect", self.path / "a.aqrep", "--report")]:
            with self.subTest(command):
                self.refuses(f"aquarama {command[0]}: {wrong}", *command, blocked / "inside")
        self.refuses(f"aquarama study: {wrong}", "study", "--out", blocked / "inside")
        self.refuses(f"aquarama search: {wrong_file}", "search", "bigeye_scad", "--out", inside)
        self.refuses(f"aquarama export: {wrong_file}", "export", "a.aqrep", "--segment", "forward_slow", "--c3d",
                     inside)


class Shows(Case):
    def test_binding_past_the_loopback_is_refused(self):
        rig = self.edited((r"tcp://127\.0\.0\.1:", "tcp://0.0.0.0:"))
        self.refuses(r"aquarama run: \S+/desk\.txtpb:\d+:\d+: .*one network card.*", "run", rig, "--headless",
                     "--frames", 1)
        rig = self.edited((r"tcp://127\.0\.0\.1:", "tcp://192.0.2.1:"))
        keys = Path(self.folder.name) / "no keys"
        self.refuses(r"aquarama run: .*/master\.key: is not there.*aquarama keys new.*", "run", rig, "--keys", keys)

    def test_keys(self):
        """Of a rig of several machines: made once, listed, revoked, replaced; every mistake is one line."""
        keys = Path(self.folder.name) / "keys"
        self.refuses(r"aquarama keys new: .*needs no keys.*", "keys", "new", self.edited(), "--keys", keys)
        rig = self.edited((r"tcp://127\.0\.0\.1:", "tcp://192.0.2.1:"))
        self.refuses(r"aquarama keys list: .*is not there.*", "keys", "list", rig, "--keys", keys)
        made = aquarama("keys", "new", rig, "--keys", keys)
        self.assertIn("9 keys made", made.stdout, made.stderr)
        self.assertEqual({path.stat().st_mode & 0o777 for path in keys.iterdir()}, {0o600})
        self.assertEqual(keys.stat().st_mode & 0o777, 0o700)
        before = {path.name: path.read_text() for path in keys.iterdir()}
        self.assertIn("0 keys made", aquarama("keys", "new", rig, "--keys", keys).stdout)
        self.assertEqual({path.name: path.read_text() for path in keys.iterdir()}, before)
        self.refuses(r"aquarama keys revoke: no key is named \"up\".*crew, guests, left, master.*",
                     "keys", "revoke", rig, "up", "--keys", keys)
        self.refuses(r"aquarama keys revoke: the master's key cannot.*", "keys", "revoke", rig, "master", "--keys",
                     keys)
        self.refuses(r"aquarama keys bundle: the master's key stays.*", "keys", "bundle", rig, "master", "--keys", keys)
        self.assertEqual(aquarama("keys", "revoke", rig, "left", "--keys", keys).returncode, 0)
        self.assertRegex(aquarama("keys", "list", rig, "--keys", keys).stdout,
                         r"left +node +\S+ +revoked \d{4}-\d\d-\d\d")
        out = Path(self.folder.name) / "left.key"
        self.refuses(r"aquarama keys bundle: left was revoked.*", "keys", "bundle", rig, "left", "--keys", keys,
                     "--out", out)
        self.assertEqual(aquarama("keys", "rotate", rig, "left", "--keys", keys).returncode, 0)
        self.assertEqual(aquarama("keys", "bundle", rig, "left", "--keys", keys, "--out", out).returncode, 0)
        self.assertEqual(out.stat().st_mode & 0o777, 0o600)
        self.refuses(r"aquarama keys bundle: .*is there already.*",
                     "keys", "bundle", rig, "left", "--keys", keys, "--out", out)
        (keys / "right.key").chmod(0o644)
        self.refuses(r"aquarama keys list: .*right\.key: others than its owner.*", "keys", "list", rig, "--keys", keys)

    def test_an_occupied_port(self):
        rig = self.edited()
        ports = [int(port)
                 for port in re.findall(r"tcp://127\.0\.0\.1:(\d+)", Path(rig).read_text())][:2]  # control, state
        for port in ports:
            with socket.socket() as other:
                other.bind(("127.0.0.1", port))
                other.listen()
                self.refuses(rf"aquarama run: cannot listen at tcp://127\.0\.0\.1:{port}: .*", "run", rig, "--headless",
                             "--frames", 1)
                self.refuses(rf"aquarama master: cannot listen at tcp://127\.0\.0\.1:{port}: .*", "master", rig,
                             "--pattern", "grid")

    def test_a_channel_that_the_rig_does_not_have(self):
        rig = self.edited()
        master = start("master", rig, "--pattern", "grid")
        try:
            wait_until(lambda: aquarama("status", rig).returncode == 0, 30, "the master")
            self.refuses("aquarama node ceiling: .*ceiling.*", "node", "ceiling", "--master", control_address(rig),
                         "--headless")
        finally:
            end([master])

    def test_nobody_answers(self):
        rig = self.edited()
        for command, stdout in [(("status",), ""), (("explain", "--fish", 1), ""), (("pilot",), "w s ahead.*\n")]:
            self.refuses(rf"aquarama {command[0]}: no master answers.*", *command, rig, input="w", stdout=stdout)

    def test_a_window_without_a_display(self):
        environment = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
        line = ("aquarama run: there is no display to open windows on: set DISPLAY, "
                "or draw without windows by --headless")
        self.refuses(line, "run", self.edited(), "--frames", 1, environment=environment)
        self.refuses(line, "run", self.edited(), environment=environment)

    def test_a_display_that_is_not_there(self):
        environment = {"DISPLAY": ":77", "WAYLAND_DISPLAY": ""}
        # A node that lives for five seconds is started again: this sea is made at once.
        self.refuses(r"aquarama-node \w+: no window can be opened .*", "run", self.edited(), "--scene", "empty_sea",
                     stdout=STARTED, environment=environment)

    def test_a_device_that_is_not_there(self):
        rig = self.edited((r'device: *"\w+"', 'device: "device:77"'))
        self.ends(r'aquarama-node \w+: device "device:77": .*', rig)

    def test_no_opengl_4_5(self):
        self.ends(r"aquarama-node \w+: .*4\.5.*", self.edited(), environment={"MESA_GL_VERSION_OVERRIDE": "4.1"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
