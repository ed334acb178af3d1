aquarama_test(species SOURCES species_test.cpp habits_test.cpp LINK aquarama_config)
