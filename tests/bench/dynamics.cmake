aquarama_bench(SOURCES dynamics_bench.cpp LINK aquarama_capture Eigen3::Eigen)
