set(SCENE_PROTOS scene.proto)
set(SCENE_SOURCES scene_reader.cpp scene_writer.cpp cast.cpp file_kind.cpp)
