aquarama_bench(SOURCES water_bench.cpp LINK aquarama_light aquarama_gl)
