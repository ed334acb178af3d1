// SPDX-License-Identifier: Apache-2.0
// What can be wanted of a wall, and the file in which a master keeps what was set.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/keys.pb.h"
#include "common/config/rig.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {

// All that can be wanted of a wall.
struct WantedShow {
    std::string scene;  // a name beside the rig's scene, or from the command line a file
    std::optional<config::QualityTier> quality = {};  // nothing: the finest that every node bears
    Pattern pattern = Pattern::World;
    bool black = false;
    bool freeze = false;
    friend bool operator==(const WantedShow&, const WantedShow&) = default;
};

// Values that somebody sets, or has set; those that are absent stay, or were never set.
struct ShowChange {
    std::optional<std::string> scene = {};
    // Set: a tier, or nothing for the finest that every node bears.
    std::optional<std::optional<config::QualityTier>> quality = {};
    std::optional<Pattern> pattern = {};
    std::optional<bool> black = {};
    std::optional<bool> freeze = {};
    friend bool operator==(const ShowChange&, const ShowChange&) = default;
};
// A tier as the generated message has it; nothing: the finest that every node bears.
[[nodiscard]] v1::WantedShow::Tier tierOf(const std::optional<config::QualityTier>& quality);
// The values of an order or a file.
[[nodiscard]] ShowChange changeIn(const v1::WantedShow& message);
// `wanted` with the values that are set.
[[nodiscard]] WantedShow with(WantedShow wanted, const ShowChange& change);

// For logs: "scene reef, black on".
[[nodiscard]] std::string textOf(const ShowChange& change);

// Where the values that were set for a rig are kept: aquarama/shows/RIG.txtpb in the user's folder
// for state ($XDG_STATE_HOME, or ~/.local/state).
[[nodiscard]] std::filesystem::path keptShowOf(const std::string& rigPath);
// Nothing is set where there is no such file. Throws Error where it is malformed.
[[nodiscard]] ShowChange readKeptShow(const std::filesystem::path& path);
// The same of its text; `source` names it in errors.
[[nodiscard]] ShowChange parseKeptShow(const std::string& text, const std::string& source);
// Throws Error where it cannot be written.
void keepShow(const std::filesystem::path& path, const ShowChange& kept);

}  // namespace aquarama::wire
