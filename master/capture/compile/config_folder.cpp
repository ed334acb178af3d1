// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/config_folder.h"

#include <algorithm>

#include "common/units/error.h"

namespace aquarama::capture {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtension = ".txtpb";

std::vector<fs::path> allSpeciesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == kExtension) files.push_back(entry.path());
    if (files.empty())
        throw Error(folder.string() + ": holds no species; name the right folder with --config");
    std::ranges::sort(files);
    return files;
}

}  // namespace

fs::path findConfigFolder() {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    for (fs::path folder = program.parent_path();; folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / "config", folder / "share/aquarama/config"})
            if (fs::is_directory(candidate / "species")) return candidate;
        if (folder == folder.root_path()) break;
    }
    throw Error(program.string() + ": no folder config/species above it; name one with --config");
}

std::vector<fs::path> speciesFiles(const std::vector<std::string>& namesOrFiles,
                                   const fs::path& configFolder) {
    if (namesOrFiles.empty()) return allSpeciesIn(configFolder / "species");
    std::vector<fs::path> files;
    for (const std::string& asked : namesOrFiles) {
        const fs::path named = configFolder / "species" / (asked + kExtension);
        files.push_back(fs::exists(named) ? named : fs::path(asked));
        if (!fs::is_regular_file(files.back()))
            throw Error("species \"" + asked + "\": neither a file nor a name in " +
                        (configFolder / "species").string() + "; choose one that is there");
    }
    return files;
}

}  // namespace aquarama::capture
