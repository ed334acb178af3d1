// SPDX-License-Identifier: Apache-2.0
#include "commands/rig_file_watch.h"

#include <utility>

#include <sys/stat.h>

#include "common/wall/wall.h"

namespace aquarama {

RigFileWatch::RigFileWatch(config::Rig rig, std::string path)
    : rig_{std::move(rig)}, path_{std::move(path)}, seen_{look()} {}

std::optional<config::Rig> RigFileWatch::operator()() {
    auto now = look();
    if (now == seen_) return std::nullopt;
    seen_ = std::move(now);
    config::readRigFiles(rig_, path_);
    wall::checkGeometry(rig_, path_);
    return rig_;
}

RigFileWatch::Stamp RigFileWatch::stampOf(const std::string& file) {
    struct stat found {};
    if (stat(file.c_str(), &found) != 0) return {};
    return {static_cast<std::int64_t>(found.st_dev),
            static_cast<std::int64_t>(found.st_ino),
            found.st_size,
            found.st_mtim.tv_sec,
            found.st_mtim.tv_nsec,
            found.st_ctim.tv_sec,
            found.st_ctim.tv_nsec};
}

std::vector<RigFileWatch::Stamp> RigFileWatch::look() const {
    std::vector<Stamp> stamps;
    for (const auto& [name, content] : rig_.files)
        stamps.push_back(stampOf(config::besideFile(path_, name)));
    return stamps;
}

}  // namespace aquarama
