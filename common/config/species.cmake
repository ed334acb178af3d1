set(SPECIES_PROTOS species.proto)
set(SPECIES_SOURCES species.cpp)
