aquarama_bench(SOURCES dynamics_bench.cpp LINK aquarama_control Eigen3::Eigen)
