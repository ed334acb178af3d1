aquarama_bench(SOURCES think_bench.cpp flock.cpp flock_simd.cpp LINK aquarama_perceive hwy::hwy)
