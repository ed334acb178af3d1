// SPDX-License-Identifier: Apache-2.0
#include "common/machine/machine_power.h"

#include <cstdlib>
#include <span>

#include <unistd.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::machine {

std::filesystem::path powerFolder() {
    const char* chosen = std::getenv("AQUARAMA_POWER_FOLDER");  // NOLINT(concurrency-mt-unsafe)
    return chosen != nullptr ? chosen : "/run/aquarama/power";
}

std::filesystem::path batteryMark() {
    return powerFolder() / "on-battery";
}

// For a service without access to the folder, it is read-only.
bool takesPowerWord(const std::filesystem::path& folder) {
    return std::filesystem::is_directory(folder) && access(folder.c_str(), W_OK | X_OK) == 0;
}

// Written as a whole, since the service reads the file as soon as it exists.
void sayPower(const std::filesystem::path& folder, const std::string& word) {
    if (word != "poweroff" && word != "reboot") throw Error("the word is poweroff or reboot");
    if (!takesPowerWord(folder))
        throw Error("this machine takes no such word: " + folder.string() +
                    " is not there, or not for this user; set up aquarama-power.path, or switch "
                    "the machine by hand");
    const std::string line = word + "\n";
    writeWhole(folder / "word", std::as_bytes(std::span(line)));
}

}  // namespace aquarama::machine
