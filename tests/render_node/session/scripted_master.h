// SPDX-License-Identifier: Apache-2.0
// A session, and the master that says to it whatever a test wants it to say.
#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/net/blob.h"
#include "render_node/session/session.h"
#include "tests/support/stage.h"
#include "tests/support/state_packet.h"

namespace aquarama::session {

inline constexpr std::uint64_t kRun = 42;

inline v1::Welcome deskWelcome() {
    v1::Welcome welcome;
    welcome.set_rig_text(test::StageMaster::deskRig().text);
    welcome.set_pace(v1::PACE_LIVE);
    v1::Look& look = *welcome.mutable_look();
    look = conductor::lookOf(test::StageMaster::assets(), test::StageMaster::school());
    look.set_number(1);
    look.set_world(true);
    return welcome;
}

inline conductor::Blobs deskBlobs() {
    return conductor::blobsOf(test::StageMaster::assets());
}

// The master's side, in the test's own thread.
class ScriptedMaster {
  public:
    explicit ScriptedMaster(test::MemoryNet& net) : channels_(net.master()) {}

    void say(const v1::Envelope& message) {
        channels_->sendControl(peer_, wire::encode(run, message));
    }
    void publish(const v1::Envelope& message) {
        channels_->publishState(wire::encode(run, message));
    }
    void sayNoise(const net::ByteVector& noise) {
        channels_->sendControl(peer_, noise);
        channels_->publishState(noise);
    }

    // The next message of this kind from the node; answers pings on the way. Empty after ten
    // seconds.
    std::optional<v1::Envelope> hear(v1::Envelope::MessageCase kind,
                                     net::Duration within = std::chrono::seconds(10)) {
        const net::Moment end = net::monotonicNow() + within;
        while (net::monotonicNow() < end) {
            while (const auto from = channels_->receiveControl()) {
                auto message = wire::decode(from->bytes);
                if (!message) continue;
                peer_ = from->peer;
                if (message->has_ping()) {
                    say(test::pong(message->ping().sent_ns(),
                                   (net::monotonicNow() + clockAhead).time_since_epoch().count()));
                }
                if (message->message_case() == kind) return message;
            }
            channels_->wait(std::chrono::milliseconds(5));
        }
        return std::nullopt;
    }

    // Everything up to the node's first frame, delivering these bytes for each blob.
    void admit(const conductor::Blobs& blobs, wire::Pace pace = wire::Pace::Live) {
        ASSERT_TRUE(hear(v1::Envelope::kHello));
        v1::Welcome welcome = deskWelcome();
        welcome.set_pace(static_cast<v1::Pace>(pace));
        say(test::welcome(welcome));
        giveBlobs(blobs, 2);
    }
    void giveBlobs(const conductor::Blobs& blobs, int count) {
        while (count > 0) {
            const auto request = hear(v1::Envelope::kBlobRequest);
            ASSERT_TRUE(request);
            const Digest digest = wire::digestIn(request->blob_request().digest());
            const std::uint64_t offset = request->blob_request().offset();
            const auto& blob = *blobs.at(digest);
            const auto chunk = net::chunkAt(blob, offset, wire::kBlobChunkBytes);
            say(test::blobChunk(digest, offset, blob.size(), chunk));
            if (offset + chunk.size() == blob.size()) --count;
            ++chunksGiven;
        }
    }
    void letIn(Frame first) {
        const net::Moment end = net::monotonicNow() + std::chrono::seconds(10);
        std::optional<v1::Envelope> prepared;
        while (!prepared && net::monotonicNow() < end) {
            publish(test::beacon());  // until the node has subscribed
            prepared = hear(v1::Envelope::kPrepared, std::chrono::milliseconds(50));
        }
        ASSERT_TRUE(prepared);
        say(test::joined(first.value));
    }
    void show(std::uint64_t frame,
              const std::optional<Digest>& skins = {},
              std::uint32_t look = 1) {
        wire::StateFrame state;
        state.show.skins = skins;
        state.show.look = look;
        state.after.resize(test::StageMaster::school().size());
        state.frame = {frame};
        state.show.calibration = shortHash(digestOf(test::StageMaster::deskRig().text));
        channels_->publishState(test::packetOf(run, state));
    }

    std::uint64_t run = kRun;
    net::Duration clockAhead{};
    int chunksGiven = 0;

  private:
    std::unique_ptr<net::MasterChannels> channels_;
    net::PeerId peer_;
};

// A node's session with that master.
class SessionTest : public testing::Test {
  protected:
    SessionTest() : master_(net_), blobs_(test::freshDirectory()), session_(connect()) {}
    ~SessionTest() override {
        session_.reset();
        std::filesystem::remove_all(blobs_);
    }

    std::unique_ptr<Session> connect() {
        return makeSession(
            "left", [this] { return net_.node(); }, blobs_);
    }
    // join() in a thread, while the master plays its part here.
    std::future<std::optional<Admission>> joining() {
        return std::async(std::launch::async, [this] { return session_->join(); });
    }
    // What join() threw; empty where it did not.
    static std::string errorOf(std::future<std::optional<Admission>> join) {
        try {
            join.get();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    void prepare(const std::optional<Admission>& admission) {
        ASSERT_TRUE(admission);
        session_->prepared(1, config::QualityTier::Low, test::stillMotion(*admission));
    }
    void becomeMember(wire::Pace pace, Frame first) {
        auto join = joining();
        master_.admit(deskBlobs(), pace);
        prepare(join.get());
        master_.letIn(first);
    }
    std::uint64_t nextFrame() { return session_->nextFrame().value().frame.value; }
    std::future<Release> readying(std::uint64_t frame) {
        return std::async(std::launch::async,
                          [this, frame] { return session_->readyThenWait({frame}); });
    }

    test::MemoryNet net_;
    ScriptedMaster master_;
    std::filesystem::path blobs_;
    std::unique_ptr<Session> session_;
};

}  // namespace aquarama::session
