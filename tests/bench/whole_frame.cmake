aquarama_bench(SOURCES whole_frame_bench.cpp gpu/sea.cpp
  LINK aquarama_gl aquarama_show aquarama_simulation aquarama_flip)
