aquarama_bench(SOURCES capture_bench.cpp LINK aquarama_capture)
