set(SPECIES_PROTOS species.proto)
set(SPECIES_SOURCES species.cpp species_habits.cpp species_shape.cpp)
