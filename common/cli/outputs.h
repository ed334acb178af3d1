// SPDX-License-Identifier: Apache-2.0
// Whether what a command is going to write could be written, asked before it works for minutes.
#pragma once

#include <string>

namespace aquarama::cli {

// Makes the folder where it is missing. Throws Error, which names the option, where no file could
// be written into it. An empty name asks for nothing.
void requireFolder(const std::string& option, const std::string& folder);
// The same for the folder of a file; nor may the file be a folder.
void requireFile(const std::string& option, const std::string& file);

}  // namespace aquarama::cli
