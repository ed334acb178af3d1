// SPDX-License-Identifier: Apache-2.0
// How a program has its machine powered off: it leaves a word, and a service of the machine carries
// that out (packaging/hall/power).
#pragma once

#include <filesystem>
#include <string>

namespace aquarama::machine {

// Where this machine takes the word: AQUARAMA_POWER_FOLDER of the environment, or else
// /run/aquarama/power.
[[nodiscard]] std::filesystem::path powerFolder();
// Whether the folder is there, and this process may write into it.
[[nodiscard]] bool takesPowerWord(const std::filesystem::path& folder);
// Leaves `poweroff` or `reboot` there. Throws Error for another word, and where the folder takes
// none.
void sayPower(const std::filesystem::path& folder, const std::string& word);

}  // namespace aquarama::machine
