"""What the trial of drivers takes for wrong: logs and shaders that are, beside some that are not."""

import unittest

from drivers import LEAST_PROGRAMS, complaints, shaders_in, uses_of

STATS = "Shader Stats: SGPRS: 16 VGPRS: 8 Code Size: 148 Spilled SGPRs: 112 Spilled VGPRs: {} PrivMem VGPRs: 0 (PS)\n"
BUILDING = "[2026-11-27 23:55:38.112] [node middle] [info] building 640 x 480 pixels on AMD (radeonsi, navi21, ACO)\n"
GOOD = BUILDING + STATS.format(0) * LEAST_PROGRAMS


class Complaints(unittest.TestCase):
    def of(self, log):
        return complaints(log, "radeonsi, navi21, ACO", True)

    def test_a_good_log_has_none(self):
        self.assertEqual(self.of(GOOD), [])

    def test_messages_of_the_driver_and_errors_are_said_again(self):
        for line in ("[2026-11-27 23:55:39.112] [node middle] [error] OpenGL: GL_INVALID_OPERATION in glDrawArrays",
                     "[2026-11-27 23:55:39.112] [node middle] [warning] OpenGL: slow clear",
                     "[2026-11-27 23:55:39.112] [error] the node has died",
                     "zink: VALIDATION: VUID-vkCmdDraw-None-08114"):
            self.assertEqual(self.of(GOOD + line + "\n"), [line])

    def test_spilled_vector_registers_count_and_scalar_ones_do_not(self):
        self.assertEqual(self.of(GOOD + STATS.format(3) + STATS.format(12)),
                         ["2 shaders spill vector registers, 12 at most"])

    def test_another_driver_or_one_that_compiled_nothing_proves_nothing(self):
        self.assertEqual(self.of(GOOD.replace("navi21", "renoir")),
                         ["the node did not draw with radeonsi, navi21, ACO"])
        self.assertEqual(self.of(BUILDING + STATS.format(0)), ["shaders that were compiled: 1; the show was not drawn"])


class Shaders(unittest.TestCase):
    def test_each_stage_of_a_program_is_found(self):
        captured = "[require]\nGLSL >= 0.00\n\n[vertex shader]\nint a[2];\n\n[fragment shader]\nvoid f();\n"
        self.assertEqual(shaders_in(captured),
                         [("vertex", "int a[2];\n\n"), ("fragment", "void f();\n")])

    def test_storage_blocks_and_textures_are_counted(self):
        self.assertEqual(uses_of("""
            layout(std430, binding = 0) readonly buffer Fish { Record fish[]; };
            layout(std430) restrict buffer Drawn { uint drawn[]; } drawn;
            // layout(std430) buffer NotThis { uint a; };
            layout(binding = 1) uniform sampler2DArray skins;
            uniform highp usampler2D ids;
            layout(rgba16f) uniform image2D written;
            uniform sampler2D maps[3];
            uniform float sampler2;
        """), (2, 6))


if __name__ == "__main__":
    unittest.main()
