// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/session.h"

#include <thread>
#include <utility>

#include "common/net/channels.h"
#include "common/units/log.h"
#include "render_node/session/link_session.h"
#include "render_node/session/mailbox.h"
#include "render_node/session/master_link.h"

namespace aquarama::session {
namespace {

std::string textOf(const net::ByteVector& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<wire::SpeciesAssets> castOf(const Admitted& admitted) {
    std::vector<wire::SpeciesAssets> cast;
    for (const auto& [species, repertoire, fish] : admitted.welcome.cast)
        cast.push_back({"the master's species file",
                        textOf(admitted.blobs.at(species)),
                        admitted.blobs.at(repertoire),
                        fish});
    return cast;
}

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
        return Admission{admitted->welcome,
                         config::parseRig(admitted->welcome.rigText, "the master's rig"),
                         config::parseScene(admitted->welcome.sceneText, "the master's scene"),
                         castOf(*admitted)};
    }

    void prepared(config::QualityTier quality) override { link_.post(wire::Prepared{quality}); }

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
        released_ = wire::ReleaseReport{frame, net::monotonicNow().count()};
        return Release::Present;
    }

    void send(NodeInput input) override {
        link_.post(wire::Input{
            input == NodeInput::Quit ? wire::InputKind::Quit : wire::InputKind::TogglePause,
            {},
            {}});
    }
    void dropFood(glm::vec3 positionMetres) override {
        link_.post(wire::Input{wire::InputKind::DropFood, positionMetres, {}});
    }
    void steer(const Steering& steering) override {
        link_.post(wire::Input{wire::InputKind::Steer, {}, steering});
    }
    void askMind(std::uint32_t fish) override { link_.post(wire::ExplainRequest{fish}); }
    std::optional<wire::Explanation> latestMind() const override { return mailbox_.latestMind(); }

    void stop() override { link_.stop(); }

  private:
    std::string name_;
    Mailbox mailbox_;
    MasterLink link_;
    std::optional<wire::ReleaseReport> released_;
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
                                        const std::string& controlAddress) {
    return connectSession(name, controlAddress, net::defaultBlobDirectory());
}

std::unique_ptr<Session> connectSession(const std::string& name,
                                        const std::string& controlAddress,
                                        const std::filesystem::path& blobDirectory) {
    return makeSession(
        name, [controlAddress] { return net::connectNode(controlAddress); }, blobDirectory);
}

}  // namespace aquarama::session
