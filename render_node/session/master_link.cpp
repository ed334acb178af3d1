// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/master_link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "common/base/log.h"
#include "common/machine/machine_power.h"

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
    milliseconds(250);  // a release further ahead is a clock gone wrong
constexpr net::Instant kReport = seconds(5);
constexpr net::Instant kBetweenCalls = milliseconds(250);  // while the render thread waits
constexpr net::Instant kLongestTurn = seconds(2);          // of a net thread that is at work
constexpr std::size_t kPings = 200;                        // of ten seconds
constexpr int kSpoiltBlobs = 3;  // deliveries of a blob that fail before we give up

// Takes a moment, and never changes.
std::uint64_t ownMotorHash() {
    static const std::uint64_t hash = motion::motorSelfTest();
    return hash;
}

std::string hostName() {
    std::array<char, 65> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

// The hottest of the graphics cards whose driver tells the kernel, degrees Celsius; 0: none does.
float gpuCelsius() {
    namespace fs = std::filesystem;
    float hottest = 0;
    std::error_code none;
    for (const fs::directory_entry& card : fs::directory_iterator("/sys/class/drm", none)) {
        const fs::path sensors = card.path() / "device" / "hwmon";
        for (const fs::directory_entry& sensor : fs::directory_iterator(sensors, none)) {
            std::ifstream file(sensor.path() / "temp1_input");
            float thousandths = 0;
            if (file >> thousandths) hottest = std::max(hottest, thousandths / 1000);
        }
    }
    return hottest;
}

// All that a node fetches for a look.
std::vector<Digest> blobsIn(const v1::Look& look) {
    std::vector<Digest> digests;
    for (const v1::SpeciesBlobs& species : look.cast())
        for (const std::string* bytes : {&species.species(), &species.repertoire()})
            digests.push_back(wire::digestIn(*bytes));
    for (const v1::RigFile& file : look.rig_files())
        digests.push_back(wire::digestIn(file.digest()));
    return digests;
}

v1::LogSeverity wireSeverity(Severity severity) {
    return static_cast<v1::LogSeverity>(static_cast<int>(severity) + v1::LOG_INFO);
}

// As a packet may carry it: no control characters, and not too long.
std::string printable(std::string text) {
    text.resize(std::min(text.size(), wire::kMostLogBytes));
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    return text;
}

}  // namespace

void Mailbox::admit(Admitted admitted) {
    const std::lock_guard lock(mutex_);
    if (!join_) join_ = std::move(admitted);
    changed_.notify_all();
}

void Mailbox::refuse(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (!join_) join_ = Refused{reason};
    changed_.notify_all();
}

void Mailbox::start(wire::Pace pace, Frame first) {
    const std::lock_guard lock(mutex_);
    pace_ = pace;
    next_ = first;
    changed_.notify_all();
}

void Mailbox::put(ArrivedState arrived) {
    const std::lock_guard lock(mutex_);
    const auto isSame = [&](const ArrivedState& s) { return s.state.frame == arrived.state.frame; };
    if (std::ranges::any_of(states_, isSame)) return;  // sent again for somebody else
    if (states_.size() == kStates) states_.pop_front();
    states_.push_back(std::move(arrived));
    changed_.notify_all();
}

void Mailbox::release(const ReleaseOrder& order) {
    const std::lock_guard lock(mutex_);
    if (!release_ || release_->frame < order.frame) release_ = order;
    changed_.notify_all();
}

void Mailbox::tellMind(ExplainedMind explanation) {
    const std::lock_guard lock(mutex_);
    mind_ = std::move(explanation);
}

void Mailbox::offerNextLook(Admitted next) {
    const std::lock_guard lock(mutex_);
    nextLook_ = std::move(next);
}

std::optional<Admitted> Mailbox::takeNextLook() {
    const std::lock_guard lock(mutex_);
    return std::exchange(nextLook_, {});
}

void Mailbox::interrupt(Release why) {
    const std::lock_guard lock(mutex_);
    if (interruption_ != Release::Quit) interruption_ = why;
    changed_.notify_all();
}

void Mailbox::expectJoin() {
    const std::lock_guard lock(mutex_);
    if (interruption_ == Release::Quit) return;
    join_.reset();
    interruption_.reset();
    pace_.reset();
    next_ = {};  // of another run of the master: its frames may come before start()
    states_.clear();
    release_.reset();
    mind_.reset();
    nextLook_.reset();
}

void Mailbox::await(std::unique_lock<std::mutex>& lock, const std::function<bool()>& isDone) {
    while (!changed_.wait_for(lock, kBetweenCalls, isDone)) {
        lock.unlock();
        if (whileWaiting_) whileWaiting_();
        lock.lock();
    }
}

JoinOutcome Mailbox::awaitJoin() {
    std::unique_lock lock(mutex_);
    const auto isOver = [&] { return interruption_ == Release::Quit; };
    await(lock, [&] { return join_ || isOver(); });
    if (isOver()) return Ended{};
    return *std::exchange(join_, {});
}

// Lockstep: every frame in order. Live: the newest.
std::optional<ArrivedState> Mailbox::takeNext() {
    std::erase_if(states_, [&](const ArrivedState& s) { return s.state.frame < next_; });
    if (!pace_ || states_.empty()) return std::nullopt;
    const auto frameOf = [](const ArrivedState& s) { return s.state.frame; };
    auto chosen = *pace_ == wire::Pace::Live ? std::ranges::max_element(states_, {}, frameOf)
                                             : std::ranges::find(states_, next_, frameOf);
    if (chosen == states_.end()) return std::nullopt;
    ArrivedState taken = std::move(*chosen);
    states_.erase(chosen);
    next_ = {taken.state.frame.value + 1};
    return taken;
}

std::optional<ArrivedState> Mailbox::takeState() {
    std::unique_lock lock(mutex_);
    std::optional<ArrivedState> taken;
    await(lock, [&] { return interruption_ || (taken = takeNext()); });
    return taken;
}

std::optional<ReleaseOrder> Mailbox::awaitRelease(Frame frame) {
    std::unique_lock lock(mutex_);
    const auto isReleased = [&] { return release_ && release_->frame >= frame; };
    await(lock, [&] { return isReleased() || interruption_; });
    return isReleased() ? release_ : std::nullopt;  // the last frame is shown before the end
}

std::optional<ExplainedMind> Mailbox::latestMind() const {
    const std::lock_guard lock(mutex_);
    return mind_;
}

Release Mailbox::interruption() const {
    const std::lock_guard lock(mutex_);
    return interruption_.value_or(Release::Quit);
}

// --- the net thread

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

void MasterLink::log(Severity severity, const std::string& line) {
    requests_.tryPut(Logged{severity, line});
}

void MasterLink::stop() {
    stopped_ = true;
    requests_.close();
    mailbox_.interrupt(Release::Quit);
    const std::lock_guard lock(channelsMutex_);
    channels_->wake();
}

void MasterLink::run() {
    isInRealTime_ = net::runInRealTime();
    try {
        while (!stopped_) {
            turn();
            channels_->wait(kPing / 2);
        }
    } catch (const Error& error) {  // no new connection could be made
        mailbox_.refuse(error.what());
    }
    if (session_ != 0) sayFarewell();
}

bool MasterLink::isAtWork() const {
    return net::monotonicNow() - lastTurn_.load() < kLongestTurn;
}

void MasterLink::turn() {
    lastTurn_ = net::monotonicNow();
    while (const auto request = requests_.tryTake()) {
        std::visit([&](const auto& what) { handle(what); }, *request);
    }
    while (const auto bytes = channels_->receiveControl()) readControl(*bytes);
    while (const auto bytes = channels_->receiveState()) readState(*bytes);
    keepTime(net::monotonicNow());
}

void MasterLink::say(v1::Envelope message) {
    channels_->sendControl(wire::encode(session_, std::move(message)));
}

void MasterLink::sayFarewell() {
    v1::Envelope message;
    message.mutable_farewell();
    say(std::move(message));
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
    fetchesNextLook_ = false;
    finished_.reset();
    lastHello_ = net::Instant{};
    lastComplaint_ = net::monotonicNow();
}

void MasterLink::handle(const Built& built) {
    built_ = built;
    if (phase_ == Phase::Building) phase_ = Phase::Listening;
    if (phase_ == Phase::Member) sayPrepared();
}

void MasterLink::sayPrepared() {
    v1::Envelope message;
    message.mutable_prepared()->set_quality(static_cast<std::uint32_t>(built_.quality));
    message.mutable_prepared()->set_look(built_.look);
    say(std::move(message));
}

void MasterLink::handle(const Finished& finished) {
    if (phase_ != Phase::Member) return;
    finished_ = finished;
    lastFinished_ = finished.frame;
    pictures_.add(finished.took);
    sayReady();
}

void MasterLink::handle(const NodeFacts& facts) {
    facts_ = facts;
    lastReport_ = {};
}

void MasterLink::handle(const Logged& line) {
    constexpr std::size_t kMostUnsaid = 100;
    if (unsaid_.size() == kMostUnsaid) unsaid_.pop_front();
    v1::LogLine& last = unsaid_.emplace_back();
    last.set_severity(wireSeverity(line.severity));
    last.set_frame(lastFinished_.value);
    last.set_text(printable(line.text));
}

void MasterLink::handle(const v1::Input& input) {
    if (session_ == 0) return;
    v1::Envelope message;
    *message.mutable_input() = input;
    say(std::move(message));
}

void MasterLink::handle(const v1::Order& order) {
    if (session_ == 0) return;
    v1::Envelope message;
    *message.mutable_order() = order;
    say(std::move(message));
}

void MasterLink::handle(const v1::ExplainRequest& request) {
    if (session_ == 0) return;
    v1::Envelope message;
    *message.mutable_explain_request() = request;
    say(std::move(message));
}

void MasterLink::sayReady() {
    assert(finished_);
    v1::Envelope message;
    v1::Ready& ready = *message.mutable_ready();
    ready.set_frame(finished_->frame.value);
    ready.set_hash_mismatches(traffic_.mismatches);
    ready.set_picture_us(
        static_cast<std::uint32_t>(finished_->took / std::chrono::microseconds(1)));
    const auto masters = [&](net::Instant own) {
        return (own + clock_.offset(own).value_or(net::Instant{})).count();
    };
    if (const auto& released = finished_->released) {
        ready.set_released_frame(released->frame.value);
        ready.set_released_ns(masters(released->at));
    }
    if (const auto& blanks = finished_->blanks) {
        ready.set_blank_ns(masters(blanks->last));
        ready.set_blank_period_ns(static_cast<std::uint32_t>(blanks->period.count()));
    }
    say(std::move(message));
    lastReady_ = net::monotonicNow();
}

// --- what the master says

void MasterLink::readControl(const net::ByteVector& bytes) {
    const auto message = wire::decode(bytes);
    if (!message) return;
    lastHeard_ = net::monotonicNow();
    take(*message);
}

void MasterLink::take(const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kWelcome:
            if (phase_ == Phase::Greeting) beWelcomed(message);
            return;
        case v1::Envelope::kRefusal:
            if (phase_ == Phase::Greeting) mailbox_.refuse(message.refusal().reason());
            return;
        case v1::Envelope::kDismissed:  // also of another run of the master: it does not know us
            return beDismissed(message.dismissed().reason());
        default:
            if (session_ != 0 && message.session() == session_) takeOfRun(message);
    }
}

// Messages that mean nothing to a node are ignored.
void MasterLink::takeOfRun(const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kPong:
            return hearPong(message.pong(), net::monotonicNow());
        case v1::Envelope::kBlobChunk:
            return takeChunk(message.blob_chunk());
        case v1::Envelope::kJoined:
            return mailbox_.start(static_cast<wire::Pace>(admitted_.welcome.pace()),
                                  {message.joined().first_frame()});
        case v1::Envelope::kPrepare:
            return prepare(message.prepare().look());
        case v1::Envelope::kPresent:
            return beReleased(message.present());
        case v1::Envelope::kFarewell:
            return end();
        case v1::Envelope::kOrder:
            return carryOut(message.order());
        case v1::Envelope::kExplanation: {
            const v1::Explanation& mind = message.explanation();
            return mailbox_.tellMind({mind.fish(), {mind.lines().begin(), mind.lines().end()}});
        }
        default:
            return;
    }
}

// Other orders are the master's own.
void MasterLink::carryOut(const v1::Order& order) {
    if (order.has_power()) return switchMachine(order);
    if (!order.has_restart()) return;
    isToRestart_ = true;
    stop();
}

// The service of the machine ends this node in order.
void MasterLink::switchMachine(const v1::Order& order) {
    const std::string word = order.power().word() == v1::Power::POWEROFF ? "poweroff" : "reboot";
    v1::Envelope message;
    v1::OrderReply& reply = *message.mutable_order_reply();
    reply.set_request(order.request());
    reply.set_outcome(v1::OrderReply::DONE);
    try {
        machine::sayPower(machine::powerFolder(), word);
        logInfo("the master has this machine switched: {}", word);
    } catch (const Error& problem) {
        logWarning("the master asks for {}, and is refused: {}", word, problem.what());
        reply.set_outcome(v1::OrderReply::REFUSED);
        reply.set_reason(printable(problem.what()));
    }
    say(std::move(message));
}

void MasterLink::readState(const net::ByteVector& bytes) {
    traffic_.receivedBytes += bytes.size();
    const auto message = wire::decode(bytes);
    if (!message || session_ == 0) return;
    if (message->session() != session_) return lose("the master was started again");
    hearsStates_ = true;
    lastHeard_ = net::monotonicNow();
    if (!message->has_state()) return;
    auto state = wire::readState(message->state());
    if (!state) return;
    const bool isOurLook = state->show.look == admitted_.welcome.look().number();
    if (isOurLook && state->show.calibration != calibration_)
        return lose("the wall is calibrated anew");
    compareHash(*state);
    mailbox_.put({*std::move(state), lastHeard_});
}

// Once a second, which costs a large school little.
void MasterLink::compareHash(const wire::StateFrame& state) {
    if (lastHeard_ - lastCompared_ < seconds(1)) return;
    lastCompared_ = lastHeard_;
    if (motion::hashOf(state.after) == state.motionHash) return;
    if (traffic_.mismatches++ == 0)
        logError(
            "{}: the fish of frame {} are not those that the master sent; check this "
            "machine's memory and version",
            name_,
            state.frame.value);
}

void MasterLink::beWelcomed(const v1::Envelope& message) {
    session_ = message.session();
    phase_ = Phase::Fetching;
    admitted_ = {message.welcome(), {}};
    calibration_ = wire::calibrationOf(admitted_.welcome.rig_text(), admitted_.welcome.look());
    assembly_.reset();
    clock_ = {};
    pings_.clear();
    try {
        channels_->subscribeState(admitted_.welcome.state_address());
    } catch (const Error& error) {
        return mailbox_.refuse(error.what());
    }
    fetchNext();
}

bool MasterLink::isFetching() const {
    return phase_ == Phase::Fetching || fetchesNextLook_;
}

std::optional<Digest> MasterLink::firstMissing() const {
    for (const Digest& digest : blobsIn(admitted_.welcome.look()))
        if (!admitted_.blobs.contains(digest)) return digest;
    return std::nullopt;
}

// Takes the first that is missing from the cache, if it is there: see Obtained.
void MasterLink::fetchNext() {
    assembly_.reset();
    if (isObtaining_) return;  // what comes of that leads here again
    const auto digest = firstMissing();
    if (!digest) return admit();
    obtain(*digest, false, [cache = cache_, digest = *digest] { return cache.find(digest); });
}

void MasterLink::obtain(const Digest& digest,
                        bool wasSent,
                        std::function<std::optional<net::ByteVector>()> work) {
    isObtaining_ = true;
    obtaining_ = std::async(std::launch::async, [this, digest, wasSent, work = std::move(work)] {
        auto bytes = work();
        net::Blob blob;
        if (bytes) blob = std::make_shared<const net::ByteVector>(std::move(*bytes));
        post(Obtained{digest, std::move(blob), wasSent});
    });
}

// Whatever look it was for: a blob is what its digest says.
void MasterLink::handle(const Obtained& obtained) {
    isObtaining_ = false;
    if (!isFetching()) return;
    if (obtained.blob) admitted_.blobs.emplace(obtained.digest, obtained.blob);
    if (firstMissing() != obtained.digest) return fetchNext();
    if (obtained.wasSent && ++spoiltBlobs_ >= kSpoiltBlobs)
        return mailbox_.refuse("the master sends other bytes for blob " + toHex(obtained.digest) +
                               " than its name says; restart the master");
    assembly_.emplace(obtained.digest);
    requestChunk();
}

void MasterLink::requestChunk() {
    assert(assembly_);
    v1::Envelope message;
    message.mutable_blob_request()->set_digest(wire::bytesOf(assembly_->digest()));
    message.mutable_blob_request()->set_offset(assembly_->nextOffset());
    say(std::move(message));
    lastRequest_ = net::monotonicNow();
}

void MasterLink::takeChunk(const v1::BlobChunk& chunk) {
    const Digest digest = wire::digestIn(chunk.digest());
    if (!isFetching() || !assembly_ || digest != assembly_->digest()) return;
    const auto content = std::as_bytes(std::span{chunk.content()});
    if (!assembly_->take(chunk.offset(), chunk.total(), content)) return;
    if (!assembly_->whole()) return requestChunk();
    obtain(digest, true, [cache = cache_, assembly = *std::exchange(assembly_, {})]() mutable {
        auto blob = assembly.checked();
        if (blob) cache.keep(assembly.digest(), *blob);
        return blob;
    });
}

// The master says it again and again until it has heard that it is built.
void MasterLink::prepare(const v1::Look& look) {
    if (phase_ != Phase::Member) return;
    if (look.number() == built_.look) return sayPrepared();
    if (look.number() == admitted_.welcome.look().number()) return;
    *admitted_.welcome.mutable_look() = look;
    calibration_ = wire::calibrationOf(admitted_.welcome.rig_text(), look);
    const std::vector<Digest> needed = blobsIn(look);
    std::erase_if(admitted_.blobs, [&](const auto& blob) {
        return std::ranges::find(needed, blob.first) == needed.end();
    });
    fetchesNextLook_ = true;
    fetchNext();
}

void MasterLink::admit() {
    if (std::exchange(fetchesNextLook_, false)) return mailbox_.offerNextLook(admitted_);
    phase_ = Phase::Building;
    mailbox_.admit(admitted_);
}

void MasterLink::beReleased(const v1::Present& present) {
    const Frame frame{present.frame()};
    const net::Instant now = net::monotonicNow();
    net::Instant at = now;
    const auto ahead = clock_.offset(now);
    if (present.at_ns() != 0 && ahead) at = net::Instant{present.at_ns()} - *ahead;
    if (at > now + kFarthest) at = now;
    if (finished_ && finished_->frame <= frame) finished_.reset();
    mailbox_.release({frame, at});
}

void MasterLink::beDismissed(const std::string& reason) {
    if (phase_ == Phase::Greeting) {
        lastDismissal_ = reason;
    } else if (phase_ != Phase::Outside) {
        lose(reason);
    }
}

// Answered, so that the master knows that we have heard it.
void MasterLink::end() {
    sayFarewell();
    phase_ = Phase::Outside;
    session_ = 0;
    mailbox_.interrupt(Release::Quit);
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

// --- what is due

void MasterLink::keepTime(net::Instant now) {
    if (phase_ == Phase::Outside) return;
    if (phase_ == Phase::Greeting) return greet(now);
    if (now - lastHeard_ > kMasterSilence) return lose("the master has fallen silent");
    if (now - lastPing_ >= kPing) sayPing(now);
    sayLog();
    if (phase_ == Phase::Member && now - lastReport_ >= kReport) sayReport(now);
    if (isFetching() && assembly_ && now - lastRequest_ > kRepeat) requestChunk();
    if (phase_ == Phase::Listening && hearsStates_) {
        sayPrepared();
        phase_ = Phase::Member;
    }
    if (finished_ && now - lastReady_ > kRepeat) sayReady();
}

void MasterLink::sayPing(net::Instant now) {
    v1::Envelope ping;
    ping.mutable_ping()->set_sent_ns(now.count());
    say(std::move(ping));
    lastPing_ = now;
    pings_.emplace_back(now, std::nullopt);
    if (pings_.size() > kPings) pings_.pop_front();
}

void MasterLink::hearPong(const v1::Pong& pong, net::Instant now) {
    const net::Instant sent{pong.sent_ns()};
    clock_.add(sent, net::Instant{pong.master_ns()}, now);
    traffic_.clockOffsetSeconds = net::secondsIn(clock_.offset(now).value_or(net::Instant{}));
    const auto ping = std::ranges::find(pings_, sent, [](const auto& p) { return p.first; });
    if (ping != pings_.end()) ping->second = now - sent;
}

void MasterLink::reportPings(v1::NodeReport& report, net::Instant now) const {
    net::RecentTimes roundTrips;
    std::size_t unanswered = 0;
    std::optional<net::Instant> before;
    double jitter = 0;
    int answered = 0;
    for (const auto& [sent, roundTrip] : pings_) {
        if (!roundTrip && now - sent > kRepeat) ++unanswered;
        if (!roundTrip) continue;
        roundTrips.add(*roundTrip);
        if (before) jitter += std::abs(net::secondsIn(*roundTrip - *before));
        before = roundTrip;
        ++answered;
    }
    report.set_round_trip_median_ms(roundTrips.quantileMs(0.5));
    report.set_round_trip_p99_ms(roundTrips.quantileMs(0.99));
    report.set_jitter_ms(static_cast<float>(1000 * jitter / std::max(answered - 1, 1)));
    report.set_unanswered_percent(100 * static_cast<float>(unanswered) /
                                  static_cast<float>(std::max<std::size_t>(pings_.size(), 1)));
}

void MasterLink::sayReport(net::Instant now) {
    v1::Envelope message;
    v1::NodeReport& report = *message.mutable_node_report();
    reportPings(report, now);
    report.set_host(hostName());
    report.set_build(facts_.build);
    report.set_renderer(facts_.renderer);
    for (const std::string& monitor : facts_.monitors) report.add_monitors(monitor);
    report.set_free_disk_bytes(cache_.freeBytes());
    report.set_clock_synchronised(net::isClockSynchronised());
    report.set_real_time(isInRealTime_);
    report.set_takes_power_word(machine::takesPowerWord(machine::powerFolder()));
    report.set_picture_median_ms(pictures_.quantileMs(0.5));
    report.set_picture_p99_ms(pictures_.quantileMs(0.99));
    report.set_clock_drift_ppm(static_cast<float>(clock_.driftPpm()));
    traffic_.gpuCelsius = gpuCelsius();
    if (traffic_.gpuCelsius > 0) report.set_gpu_celsius(traffic_.gpuCelsius);
    say(std::move(message));
    lastReport_ = now;
}

// A few at each turn, so that a flood of lines delays nothing else.
void MasterLink::sayLog() {
    constexpr int kLinesATurn = 4;
    for (int line = 0; line < kLinesATurn && !unsaid_.empty(); ++line) {
        v1::Envelope message;
        *message.mutable_log_line() = std::move(unsaid_.front());
        unsaid_.pop_front();
        say(std::move(message));
    }
}

void MasterLink::greet(net::Instant now) {
    if (now - lastHello_ >= kHello) {
        v1::Envelope message;
        v1::Hello& hello = *message.mutable_hello();
        hello.set_channel(name_);
        hello.set_major(wire::kProtocolMajor);
        hello.set_build(AQUARAMA_VERSION);
        hello.set_motor_hash(ownMotorHash());
        say(std::move(message));
        lastHello_ = now;
    }
    if (now - lastComplaint_ < kComplaint) return;
    lastComplaint_ = now;
    logWarning("{}: {}; still trying",
               name_,
               lastDismissal_.empty() ? "no master answers (not started, another address, a "
                                        "firewall, or a key that is revoked)"
                                      : std::exchange(lastDismissal_, {}));
    handle(Join{});  // ZeroMQ gives up a connection for good whose key was refused once
}

}  // namespace aquarama::session
