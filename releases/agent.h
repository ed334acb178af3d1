// SPDX-License-Identifier: Apache-2.0
// The agent of a machine: it reports to the depot, copies releases, and starts the machine with the
// one that the depot says.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/net/channels.h"
#include "releases/copy.h"
#include "releases/follower.h"
#include "releases/machine.h"
#include "releases/messages.h"
#include "releases/shelf.h"

namespace aquarama::releases {

// What an agent needs to know.
struct AgentSetup {
    std::string place;              // a channel that its machine shows; with keys the key says it
    std::filesystem::path system;   // the folder of the system partition
    std::filesystem::path program;  // machine.h
    std::filesystem::path memory;   // the file of what it keeps
    ShowKey key;
};

// One thread uses it, but for stop().
class Agent {
  public:
    // Throws Error where the machine does not say what runs.
    Agent(AgentSetup setup, std::unique_ptr<net::NodeChannels> channels);

    // Obeys the depot until stop(), or until the machine starts anew. Throws Error where a change
    // cannot be kept or the machine fails.
    void run();
    void stop();

  private:
    void report();
    void hear(const v1::DepotMessage& message);
    void obey(const v1::MachineOrder& order);
    void start(const ReleaseId& release);
    void remember();
    void fetch(const ReleaseId& release);
    void askPiece();
    void take(const v1::ReleasePiece& piece);
    void fail(const ReleaseId& release, const std::string& problem);
    void switchChannels();
    [[nodiscard]] bool isWhole(const ReleaseId& release);
    [[nodiscard]] std::vector<ReleaseId> held() const;

    AgentSetup setup_;
    std::unique_ptr<net::NodeChannels> channels_;
    Machine machine_;
    Shelf shelf_;
    FollowerMemory kept_;
    ReleaseFollower follower_;
    double reportedAt_ = 0, askedAt_ = 0;  // seconds
    std::vector<ReleaseId> checked_;       // whole, since this start
    std::optional<ReleaseCopy> copy_;
    ReleaseId failed_;  // cannot be copied, in this epoch
    std::string problem_;
    std::optional<bool> isShown_;
    std::atomic<bool> isOver_ = false;
};

}  // namespace aquarama::releases
