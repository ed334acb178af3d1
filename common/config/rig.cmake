set(RIG_PROTOS rig.proto)
set(RIG_SOURCES)
