aquarama_bench(SOURCES channel_bench.cpp LINK aquarama_gl aquarama_show aquarama_scene)
