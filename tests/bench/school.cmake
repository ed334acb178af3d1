aquarama_bench(SOURCES school_bench.cpp LINK aquarama_world aquarama_capture)
