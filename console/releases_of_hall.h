// SPDX-License-Identifier: Apache-2.0
// Which release the machines of the hall run, as the depot of releases says it by `aquarama
// release`, and the crew's word to it.
#pragma once

#include <string>
#include <string_view>

#include "console/console.pb.h"

namespace aquarama::console {

// What all machines run, and what waits; takes some seconds. Where no depot answers, why.
[[nodiscard]] browser::Releases releasesOf(const std::string& rigFile);
// The same of what `aquarama release status --json` says.
[[nodiscard]] browser::Releases releasesIn(const std::string& json);

// Whether it is a word that changes the release: "go" or "back".
[[nodiscard]] bool isReleaseWord(std::string_view word);
// Says it to the depot; takes some seconds. Why not, where it is refused.
[[nodiscard]] std::string changeRelease(const std::string& rigFile, const std::string& word);

}  // namespace aquarama::console
