aquarama_bench(SOURCES think_bench.cpp LINK aquarama_behaviour)
