aquarama_test(rig SOURCES rig_test.cpp LINK aquarama_config)
