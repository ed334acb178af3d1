aquarama_bench(SOURCES light_bench.cpp LINK aquarama_light aquarama_gl)
