// SPDX-License-Identifier: Apache-2.0
#include "common/ask/picture_hub.h"

#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::ask {
namespace {

using namespace std::chrono_literals;

// A console that listens with keys, as past the loopback, and nodes of two channels.
class KeyedHub : public testing::Test {
  protected:
    // Shows a key, says that it shows a channel, and offers a picture with this number.
    void offer(const std::optional<net::PeerKeys>& shown,
               const std::string& channel,
               std::uint64_t number) {
        const auto node = net::connectNode(hub_->address(), {}, shown);
        v1::Envelope hello, offered;
        hello.mutable_watch_hello()->set_channel(channel);
        v1::FramePicture& picture = *offered.mutable_frame_picture();
        picture.set_number(number);
        picture.set_frame(1);
        picture.set_width_px(64);
        picture.set_height_px(48);
        picture.set_jpeg("\xFF\xD8");
        for (int i = 0; i < 25; ++i) {
            node->sendControl(wire::encode(0, hello));
            node->sendControl(wire::encode(0, offered));
            node->wait(20ms);
        }
    }
    [[nodiscard]] net::PeerKeys with(const net::KeyPair& own) const {
        return {keys_.publicKey, own};
    }
    [[nodiscard]] bool hasHeard(const std::string& channel, std::uint64_t number) {
        const std::lock_guard lock(mutex_);
        return heard_.contains({channel, number});
    }

    const net::KeyPair keys_ = net::makeKeyPair(), left_ = net::makeKeyPair();
    std::mutex mutex_;
    std::set<std::pair<std::string, std::uint64_t>> heard_;
    PictureListener listener_{[this](const std::string& channel, const auto& picture) {
                                  const std::lock_guard lock(mutex_);
                                  heard_.insert({channel, picture.number()});
                              },
                              [](const v1::FishReply&) {}};
    std::optional<PictureHub> hub_{
        std::in_place,
        "tcp://127.0.0.1:*",
        net::MasterKeys{keys_,
                        [this] {
                            return net::Allowed{{left_.publicKey, "node left"}};
                        }},
        listener_};
};

// As of the guests' program, which knows no keys of nodes.
TEST_F(KeyedHub, withoutAListWhoKnowsItsKeyIsHeard) {
    hub_.emplace("tcp://127.0.0.1:*", net::MasterKeys{keys_, {}}, listener_);
    offer({}, "left", 1);
    offer(net::PeerKeys{net::makeKeyPair().publicKey, left_}, "left", 2);
    offer(with(left_), "left", 3);
    EXPECT_FALSE(hasHeard("left", 1)) << "without a key";
    EXPECT_FALSE(hasHeard("left", 2)) << "who takes it for another";
    EXPECT_TRUE(hasHeard("left", 3));
}

TEST_F(KeyedHub, aNodeIsHeardForItsOwnChannelAndStrangersForNone) {
    offer({}, "left", 1);
    offer(with(net::makeKeyPair()), "left", 2);
    offer(with(left_), "right", 3);
    offer(with(left_), "left", 4);
    EXPECT_FALSE(hasHeard("left", 1)) << "without a key";
    EXPECT_FALSE(hasHeard("left", 2)) << "a key that nobody knows";
    EXPECT_FALSE(hasHeard("right", 3)) << "another's channel";
    EXPECT_TRUE(hasHeard("left", 4));
}

}  // namespace
}  // namespace aquarama::ask
