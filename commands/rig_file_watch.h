// SPDX-License-Identifier: Apache-2.0
// Whether the files that a rig names have changed on the disk.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/rig.h"

namespace aquarama {

// Looks when it is called: conductor::LookSources::changedRig.
class RigFileWatch {
  public:
    // The rig was read from this path just now.
    RigFileWatch(config::Rig rig, std::string path);

    // The new rig; empty where no file has changed. Throws Error where the new files are wrong,
    // once for each change.
    std::optional<config::Rig> operator()();

  private:
    // Inode, size and times of change of a file: its replacement may have the same size and time of
    // writing. A file may be missing while it is being replaced.
    using Stamp = std::array<std::int64_t, 7>;
    static Stamp stampOf(const std::string& file);
    [[nodiscard]] std::vector<Stamp> look() const;

    config::Rig rig_;
    std::string path_;
    std::vector<Stamp> seen_;
};

}  // namespace aquarama
