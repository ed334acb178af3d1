// SPDX-License-Identifier: Apache-2.0
// Where nodes bring pictures of their channels, on a thread of its own: asked for one at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::ask {

// Called from the hub's thread.
struct PictureListener {
    std::function<void(const std::string& channel, const v1::FramePicture&)> picture;
    std::function<void(const v1::FishReply&)> fish;
};

// What is asked of the nodes. From any thread; a node that is not there is asked nothing.
class NodeProxy {
  public:
    virtual ~NodeProxy() = default;
    // A picture of the channel; PictureListener::picture has it, with this number.
    virtual void askPicture(const std::string& channel,
                            std::uint64_t number,
                            std::uint32_t widthPixels) = 0;
    // The fish at a place; PictureListener::fish has the answer.
    virtual void askFish(const std::string& channel, const v1::FishRequest& request) = 0;
};

// Asks the nodes for their pictures and for the fish at a place. The socket belongs to a thread of
// its own.
class PictureHub final : public NodeProxy {
  public:
    // Throws Error where it cannot listen at the address. `keys`: past the loopback.
    PictureHub(const std::string& watchAddress,
               const std::optional<net::MasterKeys>& keys,
               PictureListener listener);
    ~PictureHub() override;
    PictureHub(const PictureHub&) = delete;
    PictureHub& operator=(const PictureHub&) = delete;

    void askPicture(const std::string& channel,
                    std::uint64_t number,
                    std::uint32_t widthPixels) override;
    void askFish(const std::string& channel, const v1::FishRequest& request) override;
    // Where it listens, with the port that was chosen.
    [[nodiscard]] std::string address() const { return channels_->controlAddress(); }

  private:
    void run();
    void hear(const net::FromPeer& from);
    void meet(const net::FromPeer& from, const std::string& channel);
    void ask(const std::string& channel, v1::Envelope question);

    bool knowsNodes_;  // by their keys
    std::unique_ptr<net::MasterChannels> channels_;
    PictureListener listener_;
    std::map<net::PeerId, std::string> channelOf_;
    std::map<std::string, net::PeerId> peerOf_;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;
    std::vector<std::pair<std::string, v1::Envelope>> questions_;
    std::thread thread_;
};

// Its master's keys, and whose nodes may connect; nothing where the rig needs none. `keyFolder`:
// empty for the rig's own. Throws Error where they cannot be read.
[[nodiscard]] std::optional<net::MasterKeys> watchKeysOf(const std::string& rigPath,
                                                         const std::string& keyFolder);

}  // namespace aquarama::ask
