// SPDX-License-Identifier: Apache-2.0
// The faults of a scan that were found so far, and the names that their texts use.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "calibration/scan/faults.h"

namespace aquarama::scan {

// Refers to the evidence.
class FaultList {
  public:
    explicit FaultList(const Evidence& evidence) : evidence_{evidence} {}

    // Adds a fault, unless one with the same advice is there.
    void add(const char* cause, std::string advice, bool refuses = true) {
        const auto same = [&](const ScanFault& fault) { return fault.advice == advice; };
        if (std::ranges::none_of(faults_, same))
            faults_.push_back({cause, std::move(advice), refuses});
    }
    [[nodiscard]] bool refuses() const { return std::ranges::any_of(faults_, &ScanFault::refuses); }
    [[nodiscard]] const std::vector<ScanFault>& all() const { return faults_; }

    // The name that the rig has for a channel.
    [[nodiscard]] const std::string& channelName(std::size_t channel) const {
        return evidence_.rig.channels[channel].name;
    }
    // "picture 3 (0003.png)": of an index in the scan.
    [[nodiscard]] std::string pictureName(std::size_t index) const {
        const std::string& file = evidence_.scan.pictures[index].file;
        return fmt::format("picture {}{}", index + 1, file.empty() ? "" : " (" + file + ")");
    }

  private:
    const Evidence& evidence_;
    std::vector<ScanFault> faults_;
};

}  // namespace aquarama::scan
