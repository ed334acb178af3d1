aquarama_bench(SOURCES light_bench.cpp LINK aquarama_scene aquarama_gl)
