// SPDX-License-Identifier: Apache-2.0
// The sockets through which the nodes of a show send frames to the program that encodes its clip.
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

// Sockets of these channels, made by the program that encodes, in a private folder of the run that
// is removed with this object. Throws Error where no folder can be made.
class ClipPipes {
  public:
    explicit ClipPipes(std::vector<std::string> channels);
    ~ClipPipes();
    ClipPipes(const ClipPipes&) = delete;
    ClipPipes& operator=(const ClipPipes&) = delete;
    [[nodiscard]] std::string folder() const { return folder_.string(); }
    // The path of the channel's socket; empty where it is not filmed.
    [[nodiscard]] std::string pipeOf(const std::string& channel) const;

  private:
    std::vector<std::string> channels_;
    std::filesystem::path folder_;
};

}  // namespace aquarama::cli
