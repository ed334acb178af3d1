aquarama_bench(SOURCES scene_bench.cpp LINK aquarama_scene aquarama_gl)
