aquarama_bench(SOURCES scene_bench.cpp LINK aquarama_light aquarama_gl)
