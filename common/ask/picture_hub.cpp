// SPDX-License-Identifier: Apache-2.0
#include "common/ask/picture_hub.h"

#include <chrono>
#include <utility>

#include "common/base/log.h"
#include "common/config/keys.h"
#include "common/config/rig.h"

namespace aquarama::ask {

namespace {

// Bounds what strangers can make the hub remember.
constexpr std::size_t kMostPeers = 256;
// Questions beyond this number are lost; they are asked again.
constexpr std::size_t kMostQuestions = 64;

}  // namespace

// Throws Error where the address cannot be had. The thread starts last.
PictureHub::PictureHub(const std::string& watchAddress,
                       const std::optional<net::MasterKeys>& keys,
                       PictureListener listener)
    : knowsNodes_{keys && keys->allowed},
      // Nobody subscribes to anything here; where states would go is any free port.
      channels_{net::bindMaster(watchAddress, "tcp://127.0.0.1:*", {}, keys)},
      listener_{std::move(listener)},
      thread_{[this] { run(); }} {}

// The thread is woken, and ended before its members are.
PictureHub::~PictureHub() {
    ended_ = true;
    channels_->wake();
    thread_.join();
}

// The number comes back with the picture.
void PictureHub::askPicture(const std::string& channel,
                            std::uint64_t number,
                            std::uint32_t widthPixels) {
    v1::Envelope question;
    question.mutable_picture_request()->set_number(number);
    question.mutable_picture_request()->set_width_px(widthPixels);
    ask(channel, std::move(question));
}

// Of a frame that was shown to somebody a moment ago.
void PictureHub::askFish(const std::string& channel, const v1::FishRequest& request) {
    v1::Envelope question;
    *question.mutable_fish_request() = request;
    ask(channel, std::move(question));
}

// From any thread; the socket is the hub's.
void PictureHub::ask(const std::string& channel, v1::Envelope question) {
    {
        const std::lock_guard lock(mutex_);
        if (questions_.size() < kMostQuestions)
            questions_.emplace_back(channel, std::move(question));
    }
    channels_->wake();
}

// Wakes for a packet or a question, else twice a second.
void PictureHub::run() {
    while (!ended_) {
        while (const auto from = channels_->receiveControl()) hear(*from);
        static_cast<void>(channels_->discardNoise());
        std::vector<std::pair<std::string, v1::Envelope>> questions;
        {
            const std::lock_guard lock(mutex_);
            questions.swap(questions_);
        }
        for (auto& [channel, question] : questions)
            if (const auto peer = peerOf_.find(channel); peer != peerOf_.end())
                channels_->sendControl(peer->second, wire::encode(0, std::move(question)));
        channels_->wait(std::chrono::milliseconds(500));
    }
}

// A node says hello every second; whoever said so last has the channel.
void PictureHub::meet(const net::FromPeer& from, const std::string& channel) {
    if (knowsNodes_ && from.user != "node " + channel) return;
    if (channelOf_.size() > kMostPeers) channelOf_.clear();
    channelOf_[from.peer] = channel;
    peerOf_[channel] = from.peer;
}

// Of peers that have not said which channel they show nothing is taken.
void PictureHub::hear(const net::FromPeer& from) {
    const auto message = wire::decode(from.bytes);
    if (!message) return;
    if (message->has_watch_hello()) return meet(from, message->watch_hello().channel());
    const auto known = channelOf_.find(from.peer);
    if (known == channelOf_.end()) return;
    if (message->has_frame_picture()) listener_.picture(known->second, message->frame_picture());
    if (message->has_fish_reply()) listener_.fish(message->fish_reply());
}

// Nodes know the master's public key already; so the same is shown here.
std::optional<net::MasterKeys> watchKeysOf(const std::string& rigPath,
                                           const std::string& keyFolder) {
    if (!config::needsKeys(config::readRig(rigPath))) return std::nullopt;
    const std::filesystem::path folder = config::keyFolderOf(rigPath, keyFolder);
    const config::KeyFile own = config::readKeyFile(config::keyFileIn(folder, "master"));
    const auto allowed = [folder] {
        net::Allowed nodes;
        try {
            for (const config::KeyFile& key : config::readKeyFolder(folder))
                if (key.revoked.empty() && key.role == config::KeyRole::Node)
                    nodes.emplace(key.publicKey, "node " + key.name);
        } catch (const Error& problem) {
            logWarning("{}", problem.what());
        }
        return nodes;
    };
    return net::MasterKeys{{own.publicKey, own.secretKey}, allowed};
}

}  // namespace aquarama::ask
