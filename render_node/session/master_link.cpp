// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/master_link.h"

#include <chrono>
#include <utility>
#include <vector>

#include "render_node/session/machine.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr net::Duration kMasterSilence = seconds(2);  // after which the master counts as lost,
constexpr net::Duration kShortSilence = milliseconds(600);  // and where there is a standby
constexpr net::Duration kFarthest = milliseconds(250);      // a later release means a wrong clock
constexpr net::Duration kReport = seconds(5);
constexpr net::Duration kSkins = seconds(5);        // so long a node waits for fish and drawings
constexpr net::Duration kLongestTurn = seconds(2);  // of a net thread that is at work

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

// Where the master may be, of a rig with a standby; empty of another one.
std::vector<std::string> mastersIn(const v1::Welcome& welcome) {
    try {
        const config::Rig rig = config::parseRig(welcome.rig_text(), "the master's rig");
        if (rig.standby) return {rig.controlAddress, rig.standby->controlAddress};
    } catch (const Error&) {  // the render thread says so
    }
    return {};
}

v1::LogSeverity wireSeverity(Severity severity) {
    return static_cast<v1::LogSeverity>(static_cast<int>(severity) + v1::LOG_INFO);
}

}  // namespace

MasterLink::MasterLink(std::string name,
                       std::vector<std::string> addresses,
                       net::ConnectTo connect,
                       net::BlobCache cache,
                       Mailbox& mailbox)
    : mailbox_(mailbox),
      connection_(std::move(name), std::move(addresses), std::move(connect)),
      fetch_(
          std::move(cache),
          [this](v1::Envelope message) { connection_.say(std::move(message)); },
          [this] { connection_.wake(); }),
      skins_([this](v1::Envelope message) { connection_.say(std::move(message)); },
             [this] { connection_.wake(); },
             [this](SkinFetch::Skins skins) { mailbox_.offerSkins(std::move(skins)); }),
      school_([this](v1::Envelope message) { connection_.say(std::move(message)); }) {}

void MasterLink::post(const Request& request) {
    requests_.put(request);
    connection_.wake();
}

void MasterLink::log(Severity severity, const std::string& line) {
    requests_.tryPut(Logged{severity, line});
}

void MasterLink::stop() {
    isStopped_ = true;
    requests_.close();
    mailbox_.interrupt(Release::Quit);
    connection_.wake();
}

void MasterLink::run() {
    isInRealTime_ = net::runInRealTime();
    try {
        while (!isStopped_) {
            turn();
            connection_.wait(Pings::kInterval / 2);
        }
    } catch (const Error& error) {  // no new connection could be made
        mailbox_.refuse(error.what());
    }
    if (connection_.session() != 0) connection_.farewell();
}

bool MasterLink::isAtWork() const {
    return net::monotonicNow() - lastTurn_.load() < kLongestTurn;
}

void MasterLink::turn() {
    lastTurn_ = net::monotonicNow();
    while (const auto request = requests_.tryTake())
        std::visit([&](const auto& what) { handle(what); }, *request);
    while (const auto finished = mailbox_.takeFinished()) {
        if (phase_ != Phase::Member) continue;
        frames_.finish(*finished);
        if (auto ready = frames_.due(pings_, net::monotonicNow(), school_.mismatches()))
            connection_.say(*std::move(ready));
    }
    while (const auto bytes = connection_.receiveControl()) readControl(*bytes);
    while (const auto bytes = connection_.receiveState()) readState(*bytes);
    doWhatIsDue(net::monotonicNow());
}

// --- requests of the render thread

void MasterLink::handle(const Join&) {
    connection_.renew();
    phase_ = Phase::Greeting;
    moments_.statesSince.reset();
    fetch_.stop();
    skins_.restart();
    school_.forget();
    frames_.forget();
}

void MasterLink::handle(const Built& built) {
    built_ = built;
    if (built.motion) school_.use(built.look, built.motion);
    if (phase_ == Phase::Building) phase_ = Phase::Listening;
    if (phase_ == Phase::Member) sayPrepared();
}

void MasterLink::handle(const NodeFacts& facts) {
    facts_ = facts;
    moments_.report = {};
}

void MasterLink::handle(const Logged& line) {
    constexpr std::size_t kMostUnsaid = 100;
    if (unsaid_.size() == kMostUnsaid) unsaid_.pop_front();
    v1::LogLine& last = unsaid_.emplace_back();
    last.set_severity(wireSeverity(line.severity));
    last.set_frame(frames_.lastFinished().value);
    last.set_text(printable(line.text));
}

void MasterLink::handle(const v1::Envelope& message) {
    if (connection_.session() != 0) connection_.say(message);
}

// --- messages of the master

void MasterLink::readControl(const net::ByteVector& bytes) {
    const auto message = wire::decode(bytes);
    if (!message || !connection_.isOfNewest(*message)) return;
    moments_.heard = net::monotonicNow();
    take(*message);
}

void MasterLink::take(const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kWelcome:
            if (phase_ == Phase::Greeting) takeWelcome(message);
            return;
        case v1::Envelope::kRefusal:
            if (phase_ == Phase::Greeting) mailbox_.refuse(message.refusal().reason());
            return;
        case v1::Envelope::kDismissed:  // may be of another run, which does not know this node
            return takeDismissal(message.dismissed().reason());
        default:
            if (connection_.session() != 0 && message.session() == connection_.session())
                takeOfRun(message);
    }
}

// Messages that mean nothing to a node are ignored.
void MasterLink::takeOfRun(const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kPong:
            return takePong(message.pong());
        case v1::Envelope::kBlobChunk:
            fetch_.take(message.blob_chunk());
            school_.take(message.blob_chunk());
            skins_.take(message.blob_chunk());
            return offerFrames();
        case v1::Envelope::kKeyframe:
            return school_.take(message.keyframe());
        case v1::Envelope::kJoined:
            return mailbox_.start(static_cast<wire::Pace>(welcome_.pace()),
                                  {message.joined().first_frame()});
        case v1::Envelope::kPrepare:
            return prepare(message.prepare().look());
        case v1::Envelope::kPresent:
            return takeRelease(message.present());
        case v1::Envelope::kFarewell:
            return takeFarewell();
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
    if (order.has_power()) return connection_.say(switchMachine(order));
    if (!order.has_restart()) return;
    isToRestart_ = true;
    stop();
}

void MasterLink::readState(const net::ByteVector& bytes) {
    figures_.receivedBytes += bytes.size();
    const auto message = wire::decode(bytes);
    if (!message || connection_.session() == 0 || !connection_.isOfNewest(*message)) return;
    if (message->session() != connection_.session()) return lose("the master was started again");
    moments_.heard = net::monotonicNow();
    if (!moments_.statesSince) moments_.statesSince = moments_.heard;
    if (!message->has_state()) return;
    auto state = wire::readState(message->state());
    if (!state) return;
    const wire::Show& show = state->frame.show;
    skins_.want(show.skins);
    const bool isOurLook = show.look == welcome_.look().number();
    if (isOurLook && show.calibration != calibration_) return lose("the wall is calibrated anew");
    school_.take(*std::move(state), moments_.heard);
    offerFrames();
}

void MasterLink::offerFrames() {
    while (auto frame = school_.next()) mailbox_.put(*std::move(frame));
    if (figures_.mismatches.exchange(school_.mismatches()) != 0 || school_.mismatches() == 0)
        return;
    logError(
        "{}: the fish differ from what the master has; they are fetched anew; check this machine's "
        "memory and version",
        connection_.name());
}

void MasterLink::takeWelcome(const v1::Envelope& message) {
    connection_.enter(message.session());
    phase_ = Phase::Fetching;
    welcome_ = message.welcome();
    calibration_ = wire::calibrationOf(welcome_.rig_text(), welcome_.look());
    for (const std::string& address : mastersIn(welcome_)) connection_.alsoAt(address);
    pings_ = {};
    try {
        connection_.subscribeState(welcome_.state_address());
    } catch (const Error& error) {
        return mailbox_.refuse(error.what());
    }
    fetch_.begin(blobsIn(welcome_.look()));
}

void MasterLink::takePong(const v1::Pong& pong) {
    const net::Moment now = net::monotonicNow();
    pings_.hear(pong, now);
    figures_.clockOffsetSeconds = net::secondsIn(pings_.offset(now).value_or(net::Duration{}));
}

void MasterLink::takeDismissal(const std::string& reason) {
    if (phase_ == Phase::Greeting)
        connection_.notYet(reason);
    else if (phase_ != Phase::Outside)
        lose(reason);
}

void MasterLink::takeRelease(const v1::Present& present) {
    const Frame frame{present.frame()};
    const net::Moment now = net::monotonicNow();
    net::Moment at = now;
    const auto ahead = pings_.offset(now);
    if (present.at_ns() != 0 && ahead) at = net::Moment{net::Duration{present.at_ns()}} - *ahead;
    if (at > now + kFarthest) at = now;
    frames_.release(frame);
    mailbox_.release({frame, at});
}

// Answered, so that the master knows that it was heard.
void MasterLink::takeFarewell() {
    connection_.farewell();
    connection_.leave();
    phase_ = Phase::Outside;
    mailbox_.interrupt(Release::Quit);
}

// The master repeats it until it has heard that the look is built.
void MasterLink::prepare(const v1::Look& look) {
    if (phase_ != Phase::Member) return;
    if (look.number() == built_.look) return sayPrepared();
    if (look.number() == welcome_.look().number()) return;
    *welcome_.mutable_look() = look;
    calibration_ = wire::calibrationOf(welcome_.rig_text(), look);
    fetch_.begin(blobsIn(look));
}

void MasterLink::admit() {
    const Admitted admitted{welcome_, fetch_.blobs()};
    if (phase_ != Phase::Fetching) return mailbox_.offerNextLook(admitted);
    phase_ = Phase::Building;
    mailbox_.admit(admitted);
}

// A render thread that is still in join() is not told: it waits on while the node says hello again.
void MasterLink::lose(const std::string& why) {
    logWarning("{}: {}; joining again", connection_.name(), why);
    if (phase_ == Phase::Fetching) return handle(Join{});
    phase_ = Phase::Outside;
    connection_.leave();  // messages that are still on their way mean nothing any more
    mailbox_.interrupt(Release::Rejoin);
}

// --- tasks that are due

void MasterLink::doWhatIsDue(net::Moment now) {
    if (phase_ == Phase::Outside) return;
    if (phase_ == Phase::Greeting) return connection_.greet(now);
    const net::Duration longest = connection_.hasSeveral() ? kShortSilence : kMasterSilence;
    if (now - moments_.heard > longest) return lose("the master has fallen silent");
    if (auto ping = pings_.due(now)) connection_.say(*std::move(ping));
    sayLog();
    if (phase_ == Phase::Member && now - moments_.report >= kReport) sayReport(now);
    try {
        if (fetch_.turn(now)) admit();
    } catch (const Error& problem) {
        mailbox_.refuse(problem.what());
    }
    skins_.turn(now);
    school_.turn(now);
    if (phase_ == Phase::Listening && mayBePrepared(now)) {
        sayPrepared();
        phase_ = Phase::Member;
    }
    if (auto ready = frames_.due(pings_, now, school_.mismatches()))
        connection_.say(*std::move(ready));
}

bool MasterLink::mayBePrepared(net::Moment now) const {
    const bool isWhole = skins_.isComplete() && !school_.isBehind();
    return moments_.statesSince && (isWhole || now - *moments_.statesSince > kSkins);
}

void MasterLink::sayPrepared() {
    v1::Envelope message;
    message.mutable_prepared()->set_quality(static_cast<std::uint32_t>(built_.quality));
    message.mutable_prepared()->set_look(built_.look);
    connection_.say(std::move(message));
}

void MasterLink::sayReport(net::Moment now) {
    v1::Envelope message;
    v1::NodeReport& report = *message.mutable_node_report();
    reportMachine(facts_, report);
    pings_.report(report, now);
    frames_.report(report);
    report.set_free_disk_bytes(fetch_.freeBytes());
    report.set_real_time(isInRealTime_);
    figures_.gpuCelsius = report.gpu_celsius();
    connection_.say(std::move(message));
    moments_.report = now;
}

// A few lines a turn, so that a flood of lines delays nothing else.
void MasterLink::sayLog() {
    constexpr int kLinesATurn = 4;
    for (int line = 0; line < kLinesATurn && !unsaid_.empty(); ++line) {
        v1::Envelope message;
        *message.mutable_log_line() = std::move(unsaid_.front());
        unsaid_.pop_front();
        connection_.say(std::move(message));
    }
}

}  // namespace aquarama::session
