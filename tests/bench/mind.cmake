aquarama_bench(SOURCES mind_bench.cpp LINK aquarama_world aquarama_capture)
