// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/session.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <future>
#include <span>
#include <thread>
#include <utility>

#include "common/base/derived_cache.h"
#include "common/base/log.h"
#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "common/net/channels.h"
#include "common/net/metrics.h"
#include "common/place/obstacles.h"
#include "render_node/session/mailbox.h"
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
                        textOf(*admitted.blobs.at(wire::digestIn(member.species()))),
                        *admitted.blobs.at(wire::digestIn(member.repertoire())),
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

// The rig, with the files that it names, which were fetched.
config::Rig rigOf(const Admitted& admitted) {
    config::Rig rig = config::parseRig(admitted.welcome.rig_text(), "the master's rig");
    for (const v1::RigFile& file : admitted.welcome.look().rig_files())
        rig.files[file.name()] = admitted.blobs.at(wire::digestIn(file.digest()));
    return rig;
}

// Throws Error where the master's rig or scene cannot be read.
Admission admissionOf(const Admitted& admitted) {
    const v1::Welcome& welcome = admitted.welcome;
    const v1::Look& look = welcome.look();
    return {.look = look.number(),
            .show = showOf(welcome),
            .rig = rigOf(admitted),
            .guestsKey = welcome.guests_key(),
            .scene = config::parseScene(look.scene_text(), "the master's scene"),
            .seed = look.seed(),
            .world = look.world(),
            .quality = look.has_quality() ? config::tierAt(look.quality()) : std::nullopt,
            .school = schoolOf(look),
            .cast = castOf(admitted)};
}

// A node's figures for Prometheus.
class NodeFigures {
  public:
    // For the node of this channel of the rig.
    NodeFigures(const config::Rig& rig, const std::string& name) : metrics_(portOf(rig, name)) {}

    void begin() { begun_ = net::monotonicNow(); }  // of a frame
    void finish() { picture_(net::secondsIn(net::monotonicNow() - begun_)); }
    // A frame was released or skipped; the node has made it itself, or the master.
    void release(Release release, bool isReckoned, const LinkFigures& link) {
        const net::Moment now = net::monotonicNow();
        if (release == Release::Present) {
            if (presented_ > 0) frame_(net::secondsIn(now - lastPresent_));
            lastPresent_ = now;
            frames_(static_cast<double>(++presented_));
            if (isReckoned) reckoned_(static_cast<double>(++own_));
        }
        if (release == Release::Skip) skips_(static_cast<double>(++skipped_));
        offset_(link.clockOffsetSeconds);
        bytes_(static_cast<double>(link.receivedBytes));
        mismatches_(static_cast<double>(link.mismatches));
        celsius_(static_cast<double>(link.gpuCelsius));
    }

  private:
    // The node's port; 0 where the rig names none.
    static std::uint16_t portOf(const config::Rig& rig, const std::string& name) {
        const auto channel = std::ranges::find(rig.channels, name, &config::Channel::name);
        if (rig.metricsPort == 0 || channel == rig.channels.end()) return 0;
        return static_cast<std::uint16_t>(rig.metricsPort + 1 + (channel - rig.channels.begin()));
    }

    net::Metrics metrics_;
    net::Record picture_ = metrics_.histogram("aquarama_picture_seconds",
                                              "From a frame's state to its finished picture");
    net::Record frame_ =
        metrics_.histogram("aquarama_present_seconds", "Time between two frames that were shown");
    net::Record frames_ = metrics_.counter("aquarama_presented_total", "Frames that were shown");
    net::Record reckoned_ = metrics_.counter(
        "aquarama_reckoned_total", "Frames of those that it made itself, without a master");
    net::Record skips_ =
        metrics_.counter("aquarama_skipped_total", "Frames that the wall showed without this node");
    net::Record offset_ =
        metrics_.gauge("aquarama_clock_offset_seconds", "The master's clock minus this machine's");
    net::Record bytes_ =
        metrics_.counter("aquarama_received_bytes_total", "Bytes of states that have arrived");
    net::Record mismatches_ =
        metrics_.counter("aquarama_hash_mismatches_total",
                         "Steps after which its fish were others than the master's");
    net::Record celsius_ = metrics_.gauge("aquarama_gpu_celsius",
                                          "Temperature of the graphics card; 0 where none is told");
    net::Moment begun_{}, lastPresent_{};
    std::uint64_t presented_ = 0, own_ = 0, skipped_ = 0;
};

// The render thread's side of a mailbox whose other side is a net thread.
class LinkSession final : public Session {
  public:
    LinkSession(const std::string& name,
                const std::vector<std::string>& addresses,
                net::ConnectTo connect,
                const std::filesystem::path& blobs)
        : name_(name),
          link_(name, addresses, std::move(connect), net::BlobCache(blobs), mailbox_),
          netThread_([this] { link_.run(); }) {
        setLogListener(
            [this](Severity severity, const std::string& line) { link_.log(severity, line); });
    }

    ~LinkSession() override {
        setLogListener({});
        link_.stop();
        netThread_.join();
    }
    LinkSession(const LinkSession&) = delete;
    LinkSession& operator=(const LinkSession&) = delete;

    std::optional<Admission> join() override {
        released_.reset();
        mailbox_.expectJoin();
        link_.post(JoinRequest{});
        JoinOutcome outcome = mailbox_.awaitJoin();
        if (const auto* refused = std::get_if<Refused>(&outcome)) {
            throw Error("the master refuses node \"" + name_ + "\": " + refused->reason);
        }
        auto* admitted = std::get_if<Admitted>(&outcome);
        if (admitted == nullptr) return std::nullopt;
        Admission admission = admissionOf(*admitted);
        if (!figures_ && admitted->welcome.pace() == v1::PACE_LIVE)
            figures_.emplace(admission.rig, name_);
        return admission;
    }

    void prepared(std::uint32_t look,
                  config::QualityTier quality,
                  std::shared_ptr<school::SchoolMotion> motion) override {
        link_.post(PreparedLook{look, quality, std::move(motion)});
    }
    std::optional<Admission> nextLook() override {
        const auto offered = mailbox_.takeNextLook();
        return offered ? std::optional(admissionOf(*offered)) : std::nullopt;
    }

    std::shared_ptr<const body::SkinsByNumber> newSkins() override { return mailbox_.takeSkins(); }
    std::optional<wire::StateFrame> nextFrame() override {
        net::runInRealTime(false);
        auto arrived = mailbox_.takeState();
        if (!arrived) return std::nullopt;
        const bool isAnew = taken_.isReckoned && !arrived->isReckoned;
        if (isAnew) released_.reset();  // of a frame that the master does not know
        taken_ = {{}, arrived->arrival, arrived->isReckoned, arrived->renumbered};
        if (figures_) figures_->begin();
        return std::move(arrived->state);
    }

    Release interruption() const override { return mailbox_.interruption(); }
    bool isReckoned() const override { return taken_.isReckoned; }
    std::optional<std::uint32_t> renumbered() const override { return taken_.renumbered; }
    net::Moment stateArrival() const override { return taken_.arrival; }

    Release readyThenWait(Frame frame) override {
        if (figures_) figures_->finish();
        // From here to the swap every microsecond is skew. While the thread draws it has no such
        // priority: on a software renderer the net threads would have to wait.
        net::runInRealTime();
        const Release release = awaitRelease(frame);
        if (figures_) figures_->release(release, taken_.isReckoned, link_.figures());
        return release;
    }

    Release awaitRelease(Frame frame) {
        mailbox_.finish({frame,
                         std::exchange(released_, {}),
                         blanks_.blanks(),
                         net::monotonicNow() - taken_.arrival});
        link_.wake();
        const auto order = mailbox_.awaitRelease(frame);
        if (!order) return mailbox_.interruption();
        if (order->frame != frame && !std::exchange(skipped_, true)) return Release::Skip;
        // A node that is always late shows late pictures, which is better than none.
        skipped_ = false;
        std::this_thread::sleep_until(order->at);
        released_ = ReleaseReport{frame, net::monotonicNow()};
        return Release::Present;
    }

    void sawBlank(std::uint64_t count, net::Moment at) override { blanks_.add(count, at); }

    void quit() override {
        v1::Envelope message;
        message.mutable_input()->set_kind(v1::INPUT_QUIT);
        link_.post(message);
    }
    // Sent once: a visitor who sees no effect presses the key again.
    void freeze(bool frozen) override {
        v1::Envelope message;
        v1::Order& order = *message.mutable_order();
        order.set_request(
            static_cast<std::uint64_t>(net::monotonicNow().time_since_epoch().count()));
        order.mutable_show()->set_freeze(frozen);
        link_.post(message);
    }
    void dropFood(glm::vec3 positionMetres) override {
        v1::Envelope message;
        message.mutable_input()->set_kind(v1::INPUT_DROP_FOOD);
        for (const int axis : {0, 1, 2})
            message.mutable_input()->add_position(positionMetres[axis]);
        link_.post(message);
    }
    void touch(const WallHands& hands) override {
        v1::Envelope message;
        *message.mutable_input() = wire::handsInput(hands);
        link_.post(message);
    }
    void steer(const Steering& steering) override {
        v1::Envelope message;
        *message.mutable_input() = wire::steeringInput(steering);
        link_.post(message);
    }
    void describe(const NodeFacts& facts) override { link_.post(facts); }
    void askMind(std::uint32_t fish) override {
        v1::Envelope message;
        message.mutable_explain_request()->set_fish(fish);
        link_.post(message);
    }
    std::optional<ExplainedMind> latestMind() const override { return mailbox_.latestMind(); }

    void whileWaiting(std::function<void()> call) override {
        mailbox_.whileWaiting([this, call = std::move(call)] {
            if (link_.isAtWork()) call();
        });
    }
    void stop() override { link_.stop(); }
    bool isToRestart() const override { return link_.isToRestart(); }

  private:
    std::string name_;
    Mailbox mailbox_;
    MasterLink link_;
    std::optional<NodeFigures> figures_;  // live, from the first welcome on
    std::optional<ReleaseReport> released_;
    net::BlankMeter blanks_;
    bool skipped_ = false;
    ArrivedState taken_;     // without its state
    std::thread netThread_;  // last: it uses all of the above
};

}  // namespace

namespace {

// The plans of warps of a repertoire, from the disk where a node has made them before.
motion::WarpPlans keptPlans(std::span<const std::byte> repertoire,
                            const std::function<motion::WarpPlans()>& make) {
    const auto bytes = derivedCache().find(DerivedKey("warps").add(repertoire), [&] {
        const auto plans = std::make_unique<const motion::WarpPlans>(make());
        const auto raw = std::as_bytes(std::span{plans.get(), 1});
        return DerivedCache::Bytes(raw.begin(), raw.end());
    });
    motion::WarpPlans plans{};
    if (bytes.size() != sizeof plans) return make();
    std::memcpy(&plans, bytes.data(), sizeof plans);
    return plans;
}

}  // namespace

Digest showOf(v1::Welcome welcome) {
    welcome.clear_state_address();
    welcome.clear_pace();
    welcome.mutable_look()->clear_number();
    welcome.mutable_look()->clear_quality();
    return digestOf(welcome.SerializeAsString());
}

std::shared_ptr<school::SchoolMotion> motionOf(const Admission& admission) {
    // The first time on a machine each takes a tenth of a second.
    std::vector<std::future<std::shared_ptr<const motion::MotorTables>>> tables;
    for (const wire::SpeciesAssets& species : admission.cast)
        tables.push_back(std::async(std::launch::async, [&bytes = species.repertoire] {
            return motion::makeMotorTables(
                motion::decodeRepertoire(bytes, "the master's repertoire"),
                [&](const auto& make) { return keptPlans(bytes, make); });
        }));
    std::vector<school::Swimmers> swimmers;
    std::size_t next = 0;
    for (std::size_t kind = 0; kind < tables.size(); ++kind) {
        const std::size_t first = std::exchange(next, next + admission.cast[kind].fish);
        swimmers.push_back({tables[kind].get(), first, next});
    }
    if (next > admission.school.size())
        throw Error("the master's look has fewer fish than its species; use one version of both");
    // As the master: its water is for the fish of the first species.
    const float length = admission.cast.empty() ? 0.0F
                                                : config::parseSpecies(admission.cast.front().text,
                                                                       admission.cast.front().file)
                                                      .size.meanMetres;
    return std::make_shared<school::SchoolMotion>(
        std::move(swimmers),
        admission.school,
        place::obstaclesOf(place::placeOf(admission.scene, admission.seed),
                           place::waterFor(admission.scene, admission.school.size(), length)),
        admission.scene.current);
}

std::unique_ptr<Session> makeSession(const std::string& name,
                                     net::Connect connect,
                                     const std::filesystem::path& blobDirectory) {
    return std::make_unique<LinkSession>(
        name,
        std::vector<std::string>(1),
        [connect = std::move(connect)](const std::string&) { return connect(); },
        blobDirectory);
}

std::unique_ptr<Session> connectSession(const std::string& name,
                                        const std::vector<std::string>& controlAddresses,
                                        const std::optional<net::PeerKeys>& keys,
                                        const std::filesystem::path& blobDirectory) {
    return std::make_unique<LinkSession>(
        name,
        controlAddresses,
        [keys](const std::string& address) { return net::connectNode(address, {}, keys); },
        blobDirectory);
}

}  // namespace aquarama::session
