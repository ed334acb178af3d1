// SPDX-License-Identifier: Apache-2.0
#include "common/config/cast.h"

#include <filesystem>

#include "common/config/text_reader.h"
#include "common/units/log.h"

namespace aquarama::config {

namespace {

namespace fs = std::filesystem;

// A path that a file gives relative to its own folder.
std::string beside(const std::string& file, const std::string& path) {
    return (fs::path(file).parent_path() / path).lexically_normal().string();
}

}  // namespace

std::vector<CastSpecies> readCastSpecies(const Scene& scene, const std::string& scenePath) {
    std::vector<CastSpecies> cast;
    for (const CastMember& member : scene.cast) {
        const std::string path = beside(scenePath, member.species);
        if (!fs::is_regular_file(path))
            throw Error(placed(
                scenePath,
                member.place,
                "there is no species file " + path + ": give its path from the scene's folder"));
        std::string text = readTextFile(path);
        Species species = parseSpecies(text, path);
        cast.push_back({path, std::move(text), std::move(species)});
    }
    return cast;
}

std::string scenePathOf(const Rig& rig, const std::string& rigPath) {
    std::string path = beside(rigPath, rig.scene);
    if (!fs::is_regular_file(path))
        throw Error(
            placed(rigPath,
                   rig.scenePlace,
                   "there is no scene file " + path + ": give its path from the rig's folder"));
    return path;
}

}  // namespace aquarama::config
