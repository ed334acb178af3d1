// SPDX-License-Identifier: Apache-2.0
// What must be there before the first process of a show starts. Each function throws Error, which
// says what to do, where it is not.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/base/files.h"
#include "common/config/rig.h"

namespace aquarama::supervisor {

// A display to open windows on.
void requireDisplay();

// That nobody listens at the address of a rig, "tcp://HOST:PORT": nodes would join the other show.
void requireFreePort(const std::string& address);

// That the file can be read and is a recording by its first bytes.
void requireRecording(const std::string& path);

// What a file is by its first bytes; false where it cannot be read.
[[nodiscard]] bool looksLikeRecording(const std::string& path);
// Of a repertoire, as `aquarama capture` writes them.
[[nodiscard]] bool looksLikeRepertoire(const std::string& path);

// Whether a clip of `of` is composed of all channels: the panorama and the hall.
[[nodiscard]] bool showsAllChannels(const std::string& of);

// The channels that a clip of `of` needs: all of them for the panorama and the hall, or the one of
// that name. Throws Error where the rig has none.
[[nodiscard]] std::vector<std::string> channelsFor(const config::Rig& rig, const std::string& of);

// Sockets of these channels, made by the program that encodes, in a private folder of the run that
// is removed with this object. Throws Error where no folder can be made.
class ClipPipes {
  public:
    // Sockets of these channels, in this folder.
    explicit ClipPipes(std::vector<std::string> channels) : channels_(std::move(channels)) {}
    [[nodiscard]] std::string folder() const { return folder_.path().string(); }
    // The path of the channel's socket; empty where it is not filmed.
    [[nodiscard]] std::string pipeOf(const std::string& channel) const;

  private:
    std::vector<std::string> channels_;
    TemporaryFolder folder_{"clip"};
};

}  // namespace aquarama::supervisor
