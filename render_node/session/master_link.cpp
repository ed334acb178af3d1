// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/master_link.h"

#include <algorithm>
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
constexpr net::Duration kReckoningTurn = milliseconds(4);  // often enough for each frame
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

// What the net thread needs of a rig: where the master may be, where it has a standby, and how
// often the wall shows a frame.
struct RigFacts {
    std::vector<std::string> masters;
    double refreshHertz = 60;
};
RigFacts factsOf(const v1::Welcome& welcome) {
    RigFacts facts;
    try {
        const config::Rig rig = config::parseRig(welcome.rig_text(), "the master's rig");
        facts.refreshHertz = static_cast<double>(rig.timing.refreshHertz);
        if (rig.standby) facts.masters = {rig.controlAddress, rig.standby->controlAddress};
    } catch (const Error&) {  // the render thread says so
    }
    return facts;
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
    requests_.tryPut(LoggedLine{severity, line});
}

void MasterLink::stop() {
    isStopped_ = true;
    requests_.close();
    mailbox_.interrupt(Release::Quit);
    connection_.wake();
}

void MasterLink::run() {
    own_.isInRealTime = net::runInRealTime();
    try {
        while (!isStopped_) {
            turn();
            connection_.wait(reckoning_.isOn() ? kReckoningTurn : Pings::kInterval / 2);
        }
    } catch (const Error& error) {  // no new connection could be made
        mailbox_.refuse(error.what());
        if (reckoning_.isOn()) {  // nobody waits for that answer
            logError("{}: {}; the node ends", connection_.name(), error.what());
            mailbox_.interrupt(Release::Quit);
        }
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
        if (const auto order = reckoning_.release(finished->frame)) mailbox_.release(*order);
        if (phase_ != Phase::Member || reckoning_.isOn()) continue;
        frames_.finish(*finished);
        if (auto ready = frames_.due(pings_, net::monotonicNow(), school_.mismatches()))
            connection_.say(*std::move(ready));
    }
    while (const auto bytes = connection_.receiveControl()) readControl(*bytes);
    while (const auto bytes = connection_.receiveState()) readState(*bytes);
    doWhatIsDue(net::monotonicNow());
}

// --- requests of the render thread

void MasterLink::handle(const JoinRequest&) {
    reckoning_.forget();
    convergence_.end();
    built_.clear();
    sayHello();
}

void MasterLink::sayHello() {
    connection_.renew();
    phase_ = Phase::Greeting;
    moments_.statesSince.reset();
    moments_.report = {};  // a master that let the node go has forgotten its machine
    joined_.reset();
    renumbered_.reset();
    fetch_.stop();
    skins_.restart();
    school_.forget();
    frames_.forget();
}

// One of another run is ignored.
void MasterLink::handle(const PreparedLook& built) {
    if (phase_ != Phase::Building && phase_ != Phase::Member) return;
    constexpr std::size_t kMostLooks = 2;  // that is shown, and the next
    if (built_.size() == kMostLooks) built_.erase(built_.begin());
    built_.push_back(built);
    if (welcome_.look().number() == built.look) built_.back().show = showOf(welcome_);
    if (built.motion) school_.use(built.look, built.motion);
    if (phase_ == Phase::Building) phase_ = Phase::Listening;
    if (phase_ == Phase::Member) sayPrepared();
}

void MasterLink::handle(const NodeFacts& facts) {
    own_.facts = facts;
    moments_.report = {};
}

void MasterLink::handle(const LoggedLine& line) {
    constexpr std::size_t kMostUnsaid = 100;
    if (own_.unsaid.size() == kMostUnsaid) own_.unsaid.pop_front();
    v1::LogLine& last = own_.unsaid.emplace_back();
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
    take(*message);
    if (message->session() == connection_.session()) moments_.heard = net::monotonicNow();
}

void MasterLink::take(const v1::Envelope& message) {
    switch (message.message_case()) {
        case v1::Envelope::kWelcome:
            if (phase_ == Phase::Greeting) takeWelcome(message);
            return;
        case v1::Envelope::kRefusal:
            if (phase_ == Phase::Greeting) refuse(message.refusal().reason());
            return;
        case v1::Envelope::kDismissed:  // may be of another run, which does not know this node
            return takeDismissal(message.dismissed());
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
            joined_ = Frame{message.joined().first_frame()};
            // Until that frame is there, those that the node has made are shown.
            if (!reckoning_.isOn())
                mailbox_.start(static_cast<wire::Pace>(welcome_.pace()), *joined_);
            return;
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
    while (auto frame = school_.next()) {
        if (!isLedBy(*frame)) continue;
        reckoning_.saw(frame->state);
        put(*std::move(frame));
    }
    if (figures_.mismatches.exchange(school_.mismatches()) != 0 || school_.mismatches() == 0)
        return;
    logError(
        "{}: the fish differ from what the master has; they are fetched anew; check this machine's "
        "memory and version",
        connection_.name());
}

void MasterLink::put(ArrivedState frame) {
    convergence_.apply(frame.state);
    mailbox_.put(std::move(frame));
}

// --- while the master is silent

void MasterLink::reckon(DeadReckoning::Cause cause) {
    const bool isShown = phase_ == Phase::Member && welcome_.pace() == v1::PACE_LIVE;
    const auto shown = std::ranges::find(built_, reckoning_.look(), &PreparedLook::look);
    if (!isShown || shown == built_.end() || reckoning_.isOn()) return;
    reckoning_.begin(cause, school_, shown->motion);
    if (!reckoning_.isOn()) return;
    shown_ = *shown;
    mailbox_.release(reckoning_.overtaken(net::monotonicNow()));
}

bool MasterLink::isLedBy(const ArrivedState& frame) {
    if (!reckoning_.isOn()) return true;
    const bool isMember = phase_ == Phase::Member && joined_ && frame.state.frame >= *joined_;
    if (!isMember || frame.state.after.empty()) return false;
    endReckoning(frame);
    return true;
}

// Its fish glide from where the picture would have had them in this frame.
void MasterLink::endReckoning(const ArrivedState& first) {
    ArrivedState reckoned = reckoning_.next();
    convergence_.apply(reckoned.state);
    if (reckoned.state.after.size() == first.state.after.size())
        convergence_.begin(reckoned.state, first.state);
    reckoning_.forget();
    mailbox_.startAnew(static_cast<wire::Pace>(welcome_.pace()),
                       first.state.frame,
                       std::exchange(renumbered_, {}));
}

void MasterLink::takeWelcome(const v1::Envelope& message) {
    connection_.enter(message.session());
    phase_ = Phase::Fetching;
    welcome_ = message.welcome();
    calibration_ = wire::calibrationOf(welcome_.rig_text(), welcome_.look());
    const RigFacts rig = factsOf(welcome_);
    for (const std::string& address : rig.masters) connection_.alsoAt(address);
    if (!reckoning_.isOn()) reckoning_.setRefresh(rig.refreshHertz);
    pings_ = {};
    try {
        connection_.subscribeState(welcome_.state_address());
    } catch (const Error& error) {
        return refuse(error.what());
    }
    fetch_.begin(blobsIn(welcome_.look()));
}

void MasterLink::takePong(const v1::Pong& pong) {
    const net::Moment now = net::monotonicNow();
    pings_.hear(pong, now);
    figures_.clockOffsetSeconds = net::secondsIn(pings_.offset(now).value_or(net::Duration{}));
}

void MasterLink::takeDismissal(const v1::Dismissed& dismissed) {
    if (phase_ == Phase::Greeting) return connection_.notYet(dismissed.reason());
    if (phase_ == Phase::Outside) return;
    if (dismissed.hands_over()) reckon(DeadReckoning::Cause::HandOver);
    lose(dismissed.reason());
}

void MasterLink::takeRelease(const v1::Present& present) {
    const Frame frame{present.frame()};
    const net::Moment now = net::monotonicNow();
    net::Moment at = now;
    const auto ahead = pings_.offset(now);
    if (present.at_ns() != 0 && ahead) at = net::Moment{net::Duration{present.at_ns()}} - *ahead;
    if (at > now + kFarthest) at = now;
    frames_.release(frame);
    if (reckoning_.isOn()) return;
    reckoning_.released(frame, at);
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
    if (look.number() == built_.back().look) return sayPrepared();
    if (look.number() == welcome_.look().number()) return;
    *welcome_.mutable_look() = look;
    calibration_ = wire::calibrationOf(welcome_.rig_text(), look);
    fetch_.begin(blobsIn(look));
}

void MasterLink::admit() {
    const Admitted admitted{welcome_, fetch_.blobs()};
    if (phase_ != Phase::Fetching) return mailbox_.offerNextLook(admitted);
    phase_ = Phase::Building;
    if (!reckoning_.isOn()) return mailbox_.admit(admitted);
    if (shown_.show != showOf(welcome_)) return lose("it shows something else");
    PreparedLook same = shown_;
    same.look = welcome_.look().number();
    renumbered_ = same.look;
    built_.clear();
    handle(same);
}

// A node that joins beside its frames joins anew, and is told again.
void MasterLink::refuse(const std::string& reason) {
    if (!reckoning_.isOn()) return mailbox_.refuse(reason);
    phase_ = Phase::Outside;
    connection_.leave();
    mailbox_.interrupt(Release::Rejoin);
}

// While a live show is shown it joins beside the frames. A render thread that is still in join() is
// not told: it waits on while the node says hello again.
void MasterLink::lose(const std::string& why) {
    logWarning("{}: {}; joining again", connection_.name(), why);
    reckon(DeadReckoning::Cause::Silence);
    if (reckoning_.isOn() && phase_ != Phase::Building) return sayHello();
    if (phase_ == Phase::Fetching) return handle(JoinRequest{});
    phase_ = Phase::Outside;
    connection_.leave();  // messages that are still on their way mean nothing any more
    mailbox_.interrupt(Release::Rejoin);
}

// --- tasks that are due

void MasterLink::doWhatIsDue(net::Moment now) {
    if (phase_ == Phase::Outside) return;
    if (reckoning_.isSilent(moments_.heard, now)) reckon(DeadReckoning::Cause::Silence);
    if (auto frame = reckoning_.due(now)) put(*std::move(frame));
    if (phase_ == Phase::Greeting) return connection_.greet(now);
    const net::Duration longest = connection_.hasSeveral() ? kShortSilence : kMasterSilence;
    if (now - moments_.heard > longest) return lose("the master has fallen silent");
    if (auto ping = pings_.due(now)) connection_.say(*std::move(ping));
    sayLog();
    if (phase_ == Phase::Member && now - moments_.report >= kReport) sayReport(now);
    try {
        if (fetch_.turn(now)) admit();
    } catch (const Error& problem) {
        refuse(problem.what());
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
    const PreparedLook& newest = built_.back();
    message.mutable_prepared()->set_quality(static_cast<std::uint32_t>(newest.quality));
    message.mutable_prepared()->set_look(newest.look);
    connection_.say(std::move(message));
}

void MasterLink::sayReport(net::Moment now) {
    v1::Envelope message;
    v1::NodeReport& report = *message.mutable_node_report();
    reportMachine(own_.facts, report);
    pings_.report(report, now);
    frames_.report(report);
    report.set_free_disk_bytes(fetch_.freeBytes());
    report.set_real_time(own_.isInRealTime);
    figures_.gpuCelsius = report.gpu_celsius();
    connection_.say(std::move(message));
    moments_.report = now;
}

// A few lines a turn, so that a flood of lines delays nothing else.
void MasterLink::sayLog() {
    constexpr int kLinesATurn = 4;
    for (int line = 0; line < kLinesATurn && !own_.unsaid.empty(); ++line) {
        v1::Envelope message;
        *message.mutable_log_line() = std::move(own_.unsaid.front());
        own_.unsaid.pop_front();
        connection_.say(std::move(message));
    }
}

}  // namespace aquarama::session
