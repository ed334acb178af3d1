// SPDX-License-Identifier: Apache-2.0
// Checks before the first process of a show starts. Each function throws Error, which says what to
// do, where its condition does not hold.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/base/files.h"
#include "common/config/rig.h"

namespace aquarama::supervisor {

// Requires a display for windows.
void requireDisplay();

// Requires that no program listens at the address of a rig, "tcp://HOST:PORT": nodes would join
// another show.
void requireFreePort(const std::string& address);

// Requires a readable file that is a recording by its first bytes.
void requireRecording(const std::string& path);

// Tell the kind of a file by its first bytes; false where it cannot be read.
[[nodiscard]] bool looksLikeRecording(const std::string& path);
// Whether it is a repertoire, as `aquarama capture` writes it.
[[nodiscard]] bool looksLikeRepertoire(const std::string& path);

// Whether a clip of `of` needs all channels: "panorama" and "hall" do.
[[nodiscard]] bool showsAllChannels(const std::string& of);

// The channels that a clip of `of` needs: all of them for the panorama and the hall, or the one of
// that name. Throws Error where the rig has none.
[[nodiscard]] std::vector<std::string> channelsFor(const config::Rig& rig, const std::string& of);

// The sockets from nodes to the encoder, in a private folder that is removed with this object. The
// encoder creates them. Throws Error where no folder can be made.
class ClipPipes {
  public:
    // Names sockets for these channels, in folder().
    explicit ClipPipes(std::vector<std::string> channels) : channels_(std::move(channels)) {}
    [[nodiscard]] std::string folder() const { return folder_.path().string(); }
    // The path of a channel's socket; empty where the channel is not filmed.
    [[nodiscard]] std::string pipeOf(const std::string& channel) const;

  private:
    std::vector<std::string> channels_;
    TemporaryFolder folder_{"clip"};
};

}  // namespace aquarama::supervisor
