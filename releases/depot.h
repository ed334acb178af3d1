// SPDX-License-Identifier: Apache-2.0
// The depot: it has releases in a folder, gives them to machines in pieces, and tells all machines
// together what to run.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/net/channels.h"
#include "releases/messages.h"
#include "releases/rollout.h"

namespace aquarama::releases {

// The machines of a hall: their names, and which of them a channel, or another place, is on.
struct HallMachines {
    std::vector<std::string> names;
    std::map<std::string, std::string> machineOf;
};

// What a depot needs to know.
struct DepotSetup {
    HallMachines machines;
    std::filesystem::path folder;  // VERSION/ for each release, and rollout.txtpb
    ShowKey key;
    RolloutLimits limits;
    // Whether the wall is closed now, by its hours; null: it has none.
    std::function<bool()> isClosed;
    bool hasKeys = false;  // who asks has shown one
};

// One thread uses it, but for stop().
class Depot {
  public:
    // Throws Error where the folder's state cannot be read or written.
    Depot(DepotSetup setup, std::unique_ptr<net::MasterChannels> channels);

    // Serves until stop(). Throws Error where a decision cannot be kept: then nobody is told it.
    void run();
    void stop();

  private:
    // A release that is checked beside the machines' reports, and who waits for the answer.
    struct Check {
        net::PeerId peer;
        std::uint32_t number = 0;  // of the request
        std::future<ReleaseContent> content;
    };

    void hear(const net::FromPeer& from);
    [[nodiscard]] v1::DepotMessage orderFor(const std::string& user,
                                            const v1::MachineReport& report);
    [[nodiscard]] v1::DepotMessage pieceFor(const v1::PieceRequest& request) const;
    // Nothing where the answer comes later.
    [[nodiscard]] v1::DepotMessage replyTo(const net::FromPeer& from,
                                           const v1::DepotRequest& request);
    [[nodiscard]] v1::DepotMessage answerTo(std::uint32_t number, const std::string& refusal);
    void carryOut(const v1::DepotRequest& request);
    void beginCheck(const net::FromPeer& from, const v1::DepotRequest& request);
    void endCheck(double now);
    void describe(v1::DepotReply& reply) const;
    // Returns when the state is on the disk.
    void keepState();
    void goWhenClosed(double now);

    DepotSetup setup_;
    std::unique_ptr<net::MasterChannels> channels_;
    std::filesystem::path file_;
    std::optional<RolloutState> kept_;
    Rollout rollout_;
    std::optional<Check> check_;
    double askedHoursAt_ = 0;
    std::atomic<bool> isOver_ = false;
};

}  // namespace aquarama::releases
