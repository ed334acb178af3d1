// SPDX-License-Identifier: Apache-2.0
// What must be there before the first process of a show starts; each throws Error.
#pragma once

#include <string>

namespace aquarama::cli {

// Somewhere to open windows.
void requireDisplay();

// That nobody listens at the address of a rig, "tcp://HOST:PORT": nodes would join a stranger's
// show.
void requireFreePort(const std::string& address);

// That the file can be read and is a recording by its first bytes.
void requireRecording(const std::string& path);

// By its first bytes.
[[nodiscard]] bool looksLikeRecording(const std::string& path);
[[nodiscard]] bool looksLikeRepertoire(const std::string& path);

}  // namespace aquarama::cli
