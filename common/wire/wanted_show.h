// SPDX-License-Identifier: Apache-2.0
// What is wanted of a wall (v1::WantedShow, of orders and of the file that a master keeps): its
// values, words for logs, and that file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/keys.pb.h"
#include "common/config/rig.h"

namespace aquarama::wire {

// "dusk", "first light", "clock": the name of a time of day; nothing where none has this name.
[[nodiscard]] std::string dayName(v1::WantedShow::Day day);
[[nodiscard]] std::optional<v1::WantedShow::Day> dayNamed(const std::string& name);
// A tier as the message has it; nothing: the finest that every node bears.
[[nodiscard]] v1::WantedShow::Tier tierOf(const std::optional<config::QualityTier>& quality);
// The tier of the message; nothing where it is AUTO or unset.
[[nodiscard]] std::optional<config::QualityTier> tierIn(const v1::WantedShow& show);
// Takes over the values of `change` that are set. A scene comes with its own colour.
void apply(v1::WantedShow& show, const v1::WantedShow& change);
// Whether two have the same values, and the same values unset.
[[nodiscard]] bool areSame(const v1::WantedShow& one, const v1::WantedShow& other);
// Whether nothing is set but what faders give, ten times a second while they move.
[[nodiscard]] bool isOfFader(const v1::WantedShow& show);
// For logs: "scene reef, black on"; empty where nothing is set.
[[nodiscard]] std::string textOf(const v1::WantedShow& show);

// Where the values that were set for a rig are kept: aquarama/shows/RIG.txtpb in the user's folder
// for state ($XDG_STATE_HOME, or ~/.local/state).
[[nodiscard]] std::filesystem::path keptShowOf(const std::string& rigPath);
// Folder in which a master of this rig keeps visitors' drawings.
[[nodiscard]] std::filesystem::path drawingsOf(const std::string& rigPath);
// The folder of the journal of its worlds.
[[nodiscard]] std::filesystem::path journalOf(const std::string& rigPath);
// Nothing is set where there is no such file. Throws Error where it is malformed.
[[nodiscard]] v1::WantedShow readKeptShow(const std::filesystem::path& path);
// The same of its text; `source` names it in errors.
[[nodiscard]] v1::WantedShow parseKeptShow(const std::string& text, const std::string& source);
// Throws Error where it cannot be written.
void keepShow(const std::filesystem::path& path, const v1::WantedShow& kept);

}  // namespace aquarama::wire
