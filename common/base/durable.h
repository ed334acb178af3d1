// SPDX-License-Identifier: Apache-2.0
// Changes of a folder that are on the disk when the call returns: a power cut leaves it as before
// or as after.
#pragma once

#include <filesystem>
#include <string>

namespace aquarama {

// Returns when the names of a folder are on the disk, and the files that they lead to. False, with
// errno set, where the file system cannot.
[[nodiscard]] bool syncFolder(const std::filesystem::path& folder);
// Gives a file of the folder another name. Throws Error where it cannot be.
void renameDurably(const std::filesystem::path& file, const std::string& name);
// Removes a file, which need not be there. Throws Error where it cannot be.
void removeDurably(const std::filesystem::path& file);

}  // namespace aquarama
