"""The bound for cards on paper by closed forms, and what is read from the code of AMD's compiler."""

import unittest

from bound import FOLDER, Code, Paper, bound_of, milliseconds, work_of
from shader_code import counted, kind_of, programs_in

# 100 operations a nanosecond for lanes, one of all others.
CARD = {"tflops": "0.2", "gigatexels": "1", "gigapixels": "1", "gigatriangles": "1", "gigabytes": "1"}
CODE = Code([{"program": "a.vert b.frag fine.glsl", "shader": "vert", "loop": "", "vector": "50", "slow": "0",
              "texture": "0"},
             {"program": "a.vert b.frag fine.glsl", "shader": "frag", "loop": "", "vector": "60", "slow": "10",
              "texture": "1"},
             {"program": "a.vert b.frag fine.glsl", "shader": "frag", "loop": "1", "vector": "10", "slow": "0",
              "texture": "2"},
             {"program": "a.vert b.frag fine.glsl", "shader": "frag", "loop": "1.1", "vector": "1", "slow": "0",
              "texture": "0"},
             {"program": "a.vert d.frag fine.glsl", "shader": "vert", "loop": "", "vector": "30", "slow": "0",
              "texture": "0"}],
            [{"shader": "b.frag", "loop": "1", "turns": "3"}, {"shader": "b.frag", "loop": "1.1", "turns": "5"}])
DRAW = {"stage": "place", "program": "a.vert b.frag fine.glsl", "vertices": "1000", "primitives": "500",
        "fragments": "16000", "samples": "4000", "target_samples": "4", "pixel_bytes": "8", "computed": "0",
        "bytes": "0"}
COPY = DRAW | {"stage": "resolve", "program": "copy", "vertices": "0", "primitives": "0", "fragments": "0",
               "samples": "0", "bytes": "60000"}

LOOPS = """BB0:
	v_mov_b32_e32 v0, 0 ; 7e000280
BB1:
	v_rcp_f32_e32 v1, v0 ; 7e02
	s_cbranch_scc0 BB9 ; bf84
BB2:
	image_sample v[0:3], v[0:1], s[0:7], s[8:11] dmask:0xf dim:SQ_RSRC_IMG_2D ; f080
	s_cbranch_execnz BB2 ; bf89
	s_branch BB1 ; bf82
BB9:
	v_add_f32_e32 v0, v0, v1 ; 06
	buffer_load_dword v5, v5, s[4:7], 0 offen ; e030
	s_endpgm ; bf81""".splitlines()

LOG = """Shader Stats: SGPRS: 24
Shader Disassembly Begin
BB0:
	exp pos0 v0, v1, v2, v3 done ; f800
Shader Disassembly End
=== program a.vert b.frag
Shader Disassembly Begin
BB0:
	v_mul_f32_e32 v0, v0, v0 ; 10
	exp pos0 v0, v1, v2, v3 done ; f800
Shader Disassembly End
Shader Disassembly Begin
BB0:
	v_sqrt_f32_e32 v0, v0 ; 7e
Shader Disassembly End
Shader Disassembly Begin
BB0:
	exp mrt0 v0, v0, v1, v1 done compr vm ; f800
Shader Disassembly End
=== program a.vert b.frag
""".splitlines(keepends=True)


class Bound(unittest.TestCase):
    def test_loops_and_slow_instructions_cost_their_multiple(self):
        self.assertEqual(CODE.of("a.vert b.frag fine.glsl", ".frag"), (60 + 4 * 10 + 3 * (10 + 5 * 1), 1 + 3 * 2))

    def test_a_shader_that_was_compiled_for_another_program_costs_the_same(self):
        self.assertEqual(CODE.of("a.vert c.frag other.glsl", ".vert"), (50, 0))
        self.assertEqual(CODE.of("copy", ".vert"), (0, 0))
        self.assertRaises(KeyError, CODE.of, "new.vert b.frag", ".vert")

    def test_programs_that_share_a_shader_keep_costs_of_their_own(self):
        self.assertEqual(CODE.of("a.vert b.frag fine.glsl", ".vert"), (50, 0))
        self.assertEqual(CODE.of("a.vert d.frag fine.glsl", ".vert"), (30, 0))

    def test_a_draw_asks_for_lanes_texels_pixels_triangles_and_bytes(self):
        pixels = 4000 / 4
        self.assertEqual(work_of(DRAW, CODE, False), (1000 * 50 + pixels * 145, pixels * 7, pixels, 500, pixels * 8))

    def test_whole_quads_shade_a_quarter_of_the_blocks_pixels_at_least(self):
        self.assertEqual(work_of(DRAW, CODE, True), (1000 * 50 + 4000 * 145, 4000 * 7, 1000, 500, 8000))
        few = DRAW | {"fragments": "16"}
        self.assertEqual(work_of(few, CODE, True), work_of(few, CODE, False))

    def test_a_copy_of_samples_that_are_alike_reads_and_writes_each_pixel_once(self):
        self.assertEqual(work_of(COPY, CODE, False)[-1], 60000 * 2 / 5)
        self.assertEqual(work_of(COPY, CODE, True)[-1], 60000)

    def test_the_slowest_resource_bounds_a_stage(self):
        self.assertEqual(milliseconds((1e8, 1e6, 2e6, 3e6, 4e6), CARD), (1, 1, 2, 3, 4))
        bound = bound_of([DRAW, DRAW, COPY], CODE, CARD)
        self.assertEqual(bound["place"], (2 * 8000 / 1e6, "memory"))
        self.assertEqual(bound["resolve"], (24000 / 1e6, "memory"))

    def test_the_document_has_the_tables_of_what_is_kept(self):
        paper, text = Paper(FOLDER), (FOLDER.parent / "README.md").read_text()
        for table in (paper.aims(), paper.all_cards(), paper.stages()):
            self.assertTrue("\n".join(table) in text, "put what bound.py prints into docs/measurements/README.md")


class ShaderCode(unittest.TestCase):
    def test_instructions_are_told_apart(self):
        for instruction, kind in (("v_fma_f32", "vector"), ("v_exp_f32_e32", "slow"), ("v_mul_lo_u32", "slow"),
                                  ("image_sample_l", "texture"), ("image_store", "memory"), ("ds_read_b32", "memory"),
                                  ("s_add_u32", None), ("exp", None)):
            self.assertEqual(kind_of(instruction), kind, instruction)

    def test_a_loop_within_a_loop_is_counted_apart(self):
        self.assertEqual(counted(LOOPS), {"": {"vector": 2, "memory": 1}, "1": {"slow": 1}, "1.1": {"texture": 1}})

    def test_code_belongs_to_the_program_that_follows_and_the_last_counts(self):
        programs = programs_in(LOG)
        self.assertEqual(set(programs), {("a.vert b.frag", "vert"), ("a.vert b.frag", "frag")})
        vertex, = programs["a.vert b.frag", "vert"]
        self.assertEqual(counted(vertex)[""], {"vector": 1})
        self.assertEqual([counted(code)[""] for code in programs["a.vert b.frag", "frag"]], [{"slow": 1}, {}])


if __name__ == "__main__":
    unittest.main()
