// SPDX-License-Identifier: Apache-2.0
// The pipes through which the nodes of a show send frames to the program that encodes its clip.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/rig.h"

namespace aquarama::cli {

// Whether a clip of `of` is composed of all channels: the panorama and the hall.
[[nodiscard]] bool showsAllChannels(const std::string& of);

// The channels that a clip of `of` needs: all of them for the panorama and the hall, or the one of
// that name. Throws Error where the rig has none.
[[nodiscard]] std::vector<std::string> channelsFor(const config::Rig& rig, const std::string& of);

// Named pipes in a folder of their own, which goes with them.
class ClipPipes {
  public:
    explicit ClipPipes(const std::vector<std::string>& channels);
    ~ClipPipes();
    ClipPipes(const ClipPipes&) = delete;
    ClipPipes& operator=(const ClipPipes&) = delete;
    [[nodiscard]] std::string folder() const { return folder_.string(); }
    // Empty where the channel is not filmed.
    [[nodiscard]] std::string pipeOf(const std::string& channel) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace aquarama::cli
