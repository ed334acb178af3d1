set(RIG_PROTOS rig.proto)
set(RIG_SOURCES rig_reader.cpp rig_writer.cpp)
