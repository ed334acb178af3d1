aquarama_test(scene_file SOURCES scene_test.cpp LINK aquarama_config)
