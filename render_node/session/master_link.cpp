// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/master_link.h"

#include <algorithm>
#include <utility>

#include "common/units/log.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr net::Instant kHello = milliseconds(100);
constexpr net::Instant kPing = milliseconds(50);     // a fifth of the silence that ends membership
constexpr net::Instant kRepeat = seconds(1);         // of what was not answered
constexpr net::Instant kMasterSilence = seconds(2);  // after which the master is taken for gone
constexpr net::Instant kComplaint = seconds(3);  // between two lines that say we are still waiting
constexpr net::Instant kFarthest =
    milliseconds(250);           // a release further ahead is a clock gone wrong
constexpr int kSpoiltBlobs = 3;  // deliveries of a blob that fail before we give up

}  // namespace

MasterLink::MasterLink(std::string name,
                       net::Connect connect,
                       net::BlobCache cache,
                       Mailbox& mailbox)
    : name_(std::move(name)),
      connect_(std::move(connect)),
      cache_(std::move(cache)),
      mailbox_(mailbox),
      channels_(connect_()) {}

void MasterLink::post(const Request& request) {
    requests_.put(request);
    const std::lock_guard lock(channelsMutex_);
    channels_->wake();
}

void MasterLink::stop() {
    stopped_ = true;
    requests_.close();
    mailbox_.interrupt(Release::Quit);
    const std::lock_guard lock(channelsMutex_);
    channels_->wake();
}

void MasterLink::run() {
    try {
        while (!stopped_) {
            turn();
            channels_->wait(kPing / 2);
        }
    } catch (const Error& error) {  // no new connection could be made
        mailbox_.refuse(error.what());
    }
    if (session_ != 0) say(wire::Farewell{});
}

void MasterLink::turn() {
    while (const auto request = requests_.tryTake()) {
        std::visit([&](const auto& what) { handle(what); }, *request);
    }
    while (const auto bytes = channels_->receiveControl()) readControl(*bytes);
    while (const auto bytes = channels_->receiveState()) readState(*bytes);
    keepTime(net::monotonicNow());
}

void MasterLink::say(const wire::Message& message) {
    channels_->sendControl(wire::encode({session_, message}));
}

// --- requests of the render thread

// Every attempt has connections of its own: one that is dead without knowing it is left behind.
void MasterLink::handle(const Join&) {
    if (std::exchange(connectionUsed_, true)) {
        auto fresh = connect_();
        const std::lock_guard lock(channelsMutex_);
        std::swap(channels_, fresh);
    }
    phase_ = Phase::Greeting;
    session_ = 0;
    hearsStates_ = false;
    finished_.reset();
    lastHello_ = net::Instant{};
    lastComplaint_ = net::monotonicNow();
}

void MasterLink::handle(const wire::Prepared& prepared) {
    prepared_ = prepared;
    if (phase_ == Phase::Building) phase_ = Phase::Listening;
}

void MasterLink::handle(const Finished& finished) {
    if (phase_ != Phase::Member) return;
    finished_ = finished;
    sayReady();
}

void MasterLink::handle(const wire::Input& input) {
    say(input);
}

void MasterLink::handle(const wire::ExplainRequest& request) {
    if (session_ != 0) say(request);
}

void MasterLink::sayReady() {
    wire::Ready ready{finished_->frame, finished_->released};
    if (ready.released) ready.released->atNs += clock_.offset().value_or(net::Instant{}).count();
    say(ready);
    lastReady_ = net::monotonicNow();
}

// --- what the master says

void MasterLink::readControl(const net::ByteVector& bytes) {
    const auto envelope = wire::decode(bytes);
    if (!envelope) return;
    lastHeard_ = net::monotonicNow();
    if (const auto* welcome = std::get_if<wire::Welcome>(&envelope->message)) {
        if (phase_ == Phase::Greeting) beWelcomed(envelope->session, *welcome);
    } else if (const auto* refusal = std::get_if<wire::Refusal>(&envelope->message)) {
        if (phase_ == Phase::Greeting) mailbox_.refuse(refusal->reason);
    } else if (const auto* dismissed = std::get_if<wire::Dismissed>(&envelope->message)) {
        take(*dismissed);  // also from another run of the master: it does not know us
    } else if (session_ != 0 && envelope->session == session_) {
        std::visit([&](const auto& message) { take(message); }, envelope->message);
    }
}

void MasterLink::readState(const net::ByteVector& bytes) {
    auto envelope = wire::decode(bytes);
    if (!envelope || session_ == 0) return;
    if (envelope->session != session_) return lose("the master was started again");
    hearsStates_ = true;
    lastHeard_ = net::monotonicNow();
    if (auto* state = std::get_if<wire::StateFrame>(&envelope->message)) {
        mailbox_.put({std::move(*state), lastHeard_});
    }
}

void MasterLink::beWelcomed(std::uint64_t session, const wire::Welcome& welcome) {
    session_ = session;
    phase_ = Phase::Fetching;
    admitted_ = {welcome, {}};
    assembly_.reset();
    clock_ = {};
    try {
        channels_->subscribeState(welcome.stateAddress);
    } catch (const Error& error) {
        return mailbox_.refuse(error.what());
    }
    fetchNext();
}

// Takes from the cache what is there, and asks for the first that is not.
void MasterLink::fetchNext() {
    for (const wire::SpeciesBlobs& blobs : admitted_.welcome.cast) {
        for (const Digest& digest : {blobs.species, blobs.repertoire}) {
            if (admitted_.blobs.contains(digest)) continue;
            auto cached = cache_.find(digest);
            if (!cached) {
                assembly_.emplace(digest);
                return requestChunk();
            }
            admitted_.blobs.emplace(digest, std::move(*cached));
        }
    }
    admit();
}

void MasterLink::requestChunk() {
    say(wire::BlobRequest{assembly_->digest(), assembly_->nextOffset()});
    lastRequest_ = net::monotonicNow();
}

void MasterLink::take(const wire::BlobChunk& chunk) {
    if (phase_ != Phase::Fetching || !assembly_ || chunk.digest != assembly_->digest()) return;
    if (!assembly_->take(chunk.offset, chunk.total, chunk.content)) return;
    if (!assembly_->whole()) return requestChunk();
    const auto blob = assembly_->checked();
    if (!blob) {
        if (++spoiltBlobs_ < kSpoiltBlobs) return requestChunk();
        return mailbox_.refuse("the master sends other bytes for blob " + toHex(chunk.digest) +
                               " than its name says; restart the master");
    }
    cache_.keep(chunk.digest, *blob);
    admitted_.blobs.emplace(chunk.digest, *blob);
    fetchNext();
}

void MasterLink::admit() {
    phase_ = Phase::Building;
    mailbox_.admit(admitted_);
}

void MasterLink::take(const wire::Pong& pong) {
    clock_.add(net::Instant{pong.sentNs}, net::Instant{pong.masterNs}, net::monotonicNow());
}

void MasterLink::take(const wire::Joined& joined) {
    mailbox_.start(admitted_.welcome.pace, joined.first);
}

void MasterLink::take(const wire::Present& present) {
    const net::Instant now = net::monotonicNow();
    net::Instant at = now;
    if (present.atNs != 0 && clock_.offset()) at = net::Instant{present.atNs} - *clock_.offset();
    if (at > now + kFarthest) at = now;
    if (finished_ && finished_->frame <= present.frame) finished_.reset();
    mailbox_.release({present.frame, at});
}

void MasterLink::take(const wire::Dismissed& dismissed) {
    if (phase_ == Phase::Greeting) {
        lastDismissal_ = dismissed.reason;
    } else if (phase_ != Phase::Outside) {
        lose(dismissed.reason);
    }
}

// Answered, so that the master knows that we have heard it.
void MasterLink::take(const wire::Farewell&) {
    say(wire::Farewell{});
    phase_ = Phase::Outside;
    session_ = 0;
    mailbox_.interrupt(Release::Quit);
}

void MasterLink::take(const wire::Explanation& explanation) {
    mailbox_.tellMind(explanation);
}

// A render thread that is still in join() is not told: it goes on waiting while we say hello again.
void MasterLink::lose(const std::string& why) {
    logWarning("{}: {}; joining again", name_, why);
    const bool isJoining = phase_ == Phase::Fetching;
    phase_ = Phase::Outside;
    session_ = 0;  // what is still on its way means nothing any more
    if (isJoining) {
        handle(Join{});
    } else {
        mailbox_.interrupt(Release::Rejoin);
    }
}

// --- what the time asks for

void MasterLink::keepTime(net::Instant now) {
    if (phase_ == Phase::Outside) return;
    if (phase_ == Phase::Greeting) return greet(now);
    if (now - lastHeard_ > kMasterSilence) return lose("the master has fallen silent");
    if (now - lastPing_ >= kPing) {
        say(wire::Ping{now.count()});
        lastPing_ = now;
    }
    if (phase_ == Phase::Fetching && now - lastRequest_ > kRepeat) requestChunk();
    if (phase_ == Phase::Listening && hearsStates_) {
        say(prepared_);
        phase_ = Phase::Member;
    }
    if (finished_ && now - lastReady_ > kRepeat) sayReady();
}

void MasterLink::greet(net::Instant now) {
    if (now - lastHello_ >= kHello) {
        say(wire::Hello{name_, wire::kProtocolMajor, AQUARAMA_VERSION});
        lastHello_ = now;
    }
    if (now - lastComplaint_ < kComplaint) return;
    lastComplaint_ = now;
    logWarning("{}: {}; still trying",
               name_,
               lastDismissal_.empty() ? "no master answers" : std::exchange(lastDismissal_, {}));
}

}  // namespace aquarama::session
