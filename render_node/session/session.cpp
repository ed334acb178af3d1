// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/session.h"

#include <thread>
#include <utility>

#include "common/base/log.h"
#include "common/net/channels.h"
#include "render_node/session/master_link.h"

namespace aquarama::session {
namespace {

std::string textOf(const net::ByteVector& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The species with the blobs that were fetched for them.
std::vector<wire::SpeciesAssets> castOf(const Admitted& admitted) {
    std::vector<wire::SpeciesAssets> cast;
    for (const v1::SpeciesBlobs& member : admitted.welcome.look().cast())
        cast.push_back({"the master's species file",
                        textOf(admitted.blobs.at(wire::digestIn(member.species()))),
                        admitted.blobs.at(wire::digestIn(member.repertoire())),
                        member.fish()});
    return cast;
}

std::vector<motion::FishTraits> schoolOf(const v1::Look& look) {
    std::vector<motion::FishTraits> school;
    school.reserve(static_cast<std::size_t>(look.fish_ids_size()));
    for (int i = 0; i < look.fish_ids_size(); ++i)
        school.push_back(
            {look.fish_ids(i), static_cast<std::uint16_t>(look.length_millimetres(i))});
    return school;
}

// Of what stays the same when a show goes on after an interruption.
Digest showOf(v1::Welcome welcome) {
    welcome.clear_state_address();
    welcome.clear_pace();
    welcome.mutable_look()->clear_number();
    welcome.mutable_look()->clear_quality();
    return digestOf(welcome.SerializeAsString());
}

// Throws Error where the master's rig or scene cannot be read.
Admission admissionOf(const Admitted& admitted) {
    const v1::Welcome& welcome = admitted.welcome;
    const v1::Look& look = welcome.look();
    return {.look = look.number(),
            .show = showOf(welcome),
            .rig = config::parseRig(welcome.rig_text(), "the master's rig"),
            .scene = config::parseScene(look.scene_text(), "the master's scene"),
            .seed = look.seed(),
            .world = look.world(),
            .quality = look.has_quality() ? config::tierAt(look.quality()) : std::nullopt,
            .school = schoolOf(look),
            .cast = castOf(admitted)};
}

// The render thread's side of a mailbox whose other side is a net thread.
class LinkSession final : public Session {
  public:
    LinkSession(const std::string& name, net::Connect connect, const std::filesystem::path& blobs)
        : name_(name),
          link_(name, std::move(connect), net::BlobCache(blobs), mailbox_),
          netThread_([this] { link_.run(); }) {}

    ~LinkSession() override {
        link_.stop();
        netThread_.join();
    }
    LinkSession(const LinkSession&) = delete;
    LinkSession& operator=(const LinkSession&) = delete;

    std::optional<Admission> join() override {
        released_.reset();
        mailbox_.expectJoin();
        link_.post(MasterLink::Join{});
        JoinOutcome outcome = mailbox_.awaitJoin();
        if (const auto* refused = std::get_if<Refused>(&outcome)) {
            throw Error("the master refuses node \"" + name_ + "\": " + refused->reason);
        }
        auto* admitted = std::get_if<Admitted>(&outcome);
        if (admitted == nullptr) return std::nullopt;
        return admissionOf(*admitted);
    }

    void prepared(std::uint32_t look, config::QualityTier quality) override {
        link_.post(MasterLink::Built{look, quality});
    }
    std::optional<Admission> nextLook() override {
        const auto offered = mailbox_.takeNextLook();
        return offered ? std::optional(admissionOf(*offered)) : std::nullopt;
    }

    std::optional<wire::StateFrame> nextFrame() override {
        auto arrived = mailbox_.takeState();
        if (!arrived) return std::nullopt;
        stateArrival_ = arrived->arrival;
        return std::move(arrived->state);
    }

    Release interruption() const override { return mailbox_.interruption(); }
    std::chrono::nanoseconds stateArrival() const override { return stateArrival_; }

    Release readyThenWait(Frame frame) override {
        link_.post(MasterLink::Finished{frame, std::exchange(released_, {})});
        const auto order = mailbox_.awaitRelease(frame);
        if (!order) return mailbox_.interruption();
        if (order->frame != frame && !std::exchange(skipped_, true)) return Release::Skip;
        // A node that is always late shows its late pictures: better than none.
        skipped_ = false;
        std::this_thread::sleep_until(std::chrono::steady_clock::time_point(order->at));
        released_ = ReleaseReport{frame, net::monotonicNow()};
        return Release::Present;
    }

    void quit() override {
        v1::Input message;
        message.set_kind(v1::INPUT_QUIT);
        link_.post(message);
    }
    // Said once: a hand that sees no effect presses again.
    void freeze(bool frozen) override {
        v1::Set message;
        message.set_request(static_cast<std::uint64_t>(net::monotonicNow().count()));
        message.set_freeze(frozen);
        link_.post(message);
    }
    void dropFood(glm::vec3 positionMetres) override {
        v1::Input message;
        message.set_kind(v1::INPUT_DROP_FOOD);
        for (const int axis : {0, 1, 2}) message.add_position(positionMetres[axis]);
        link_.post(message);
    }
    void steer(const Steering& steering) override { link_.post(wire::steeringInput(steering)); }
    void describe(const NodeFacts& facts) override { link_.post(facts); }
    void askMind(std::uint32_t fish) override {
        v1::ExplainRequest question;
        question.set_fish(fish);
        link_.post(question);
    }
    std::optional<ExplainedMind> latestMind() const override { return mailbox_.latestMind(); }

    void stop() override { link_.stop(); }

  private:
    std::string name_;
    Mailbox mailbox_;
    MasterLink link_;
    std::optional<ReleaseReport> released_;
    bool skipped_ = false;
    std::chrono::nanoseconds stateArrival_{};
    std::thread netThread_;  // last: it uses all of the above
};

}  // namespace

std::unique_ptr<Session> makeSession(const std::string& name,
                                     net::Connect connect,
                                     const std::filesystem::path& blobDirectory) {
    return std::make_unique<LinkSession>(name, std::move(connect), blobDirectory);
}

std::unique_ptr<Session> connectSession(const std::string& name,
                                        const std::string& controlAddress,
                                        const std::optional<net::PeerKeys>& keys,
                                        const std::filesystem::path& blobDirectory) {
    return makeSession(
        name,
        [controlAddress, keys] { return net::connectNode(controlAddress, {}, keys); },
        blobDirectory);
}

}  // namespace aquarama::session
