aquarama_bench(SOURCES publish_bench.cpp LINK aquarama_net)
