aquarama_bench(SOURCES water_bench.cpp LINK aquarama_scene aquarama_gl)
