aquarama_bench(SOURCES motion_bench.cpp LINK aquarama_motion aquarama_body)
