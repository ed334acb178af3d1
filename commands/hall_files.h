// SPDX-License-Identifier: Apache-2.0
// A hall leaves a machine and arrives on one: its folder, and what the user of the show keeps of it
// elsewhere (keys, hours, visitors' drawings).
#pragma once

#include <filesystem>
#include <string>

#include "commands/hall_archive.h"

namespace aquarama {

// A hall as it is on this machine: the rig, all files that it names, its scene and those of its
// hours with their species, the rig's keys and hours, and with `drawings` what visitors have
// painted. Files keep their places about the rig; those from elsewhere get places beside it, which
// the copies then name. Throws Error with file:line:column where one of them is wrong.
[[nodiscard]] TravellingHall readHall(const std::string& rigPath, bool drawings);

// Puts a hall into an empty or new folder, and its secrets where the programs look for those of
// its rig. `source` names the hall's file in errors. Returns the path of the rig. Throws Error
// where the folder has files, where a rig of this name has secrets here already, where the rig is
// wrong, or where something cannot be written: then nothing has changed.
std::filesystem::path placeHall(const TravellingHall& hall,
                                const std::filesystem::path& folder,
                                const std::string& source);

}  // namespace aquarama
