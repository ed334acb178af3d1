aquarama_bench(SOURCES wall_bench.cpp LINK aquarama_theatre)
