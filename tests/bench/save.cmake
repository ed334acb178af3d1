aquarama_bench(SOURCES save_bench.cpp LINK aquarama_world aquarama_capture)
