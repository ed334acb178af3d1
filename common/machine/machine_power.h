// SPDX-License-Identifier: Apache-2.0
// Powering off this machine: the program leaves a word in a folder, and a service of the machine
// acts on it (packaging/hall/power).
#pragma once

#include <filesystem>
#include <string>

namespace aquarama::machine {

// The folder for the word: AQUARAMA_POWER_FOLDER of the environment, or else /run/aquarama/power.
[[nodiscard]] std::filesystem::path powerFolder();
// The file that is in this folder while the machine runs on battery; packaging/hall/aquarama-ups
// makes it.
[[nodiscard]] std::filesystem::path batteryMark();
// Whether the folder exists and this process may write into it.
[[nodiscard]] bool takesPowerWord(const std::filesystem::path& folder);
// Writes `poweroff` or `reboot` there. Throws Error for another word, and where it cannot be
// written.
void sayPower(const std::filesystem::path& folder, const std::string& word);

}  // namespace aquarama::machine
