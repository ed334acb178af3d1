// SPDX-License-Identifier: Apache-2.0
// Against pretended projectors, each with a quirk that real ones have.
#include "console/projectors/pjlink.h"

#include <array>
#include <atomic>
#include <cctype>
#include <functional>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "console/projectors/projector.h"

namespace aquarama::console {
namespace {

using namespace std::chrono_literals;

// Listens on a free port and answers each connection by `serve`.
class PretendedProjector {
  public:
    using Serve = std::function<void(int socket)>;
    explicit PretendedProjector(Serve serve) : serve_{std::move(serve)} {
        listener_ = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        bind(listener_, reinterpret_cast<const sockaddr*>(&at), sizeof at);
        listen(listener_, 8);
        socklen_t size = sizeof at;
        getsockname(listener_, reinterpret_cast<sockaddr*>(&at), &size);
        port_ = ntohs(at.sin_port);
        thread_ = std::thread([this] { run(); });
    }
    ~PretendedProjector() {
        ended_ = true;
        thread_.join();
        close(listener_);
    }
    PretendedProjector(const PretendedProjector&) = delete;
    PretendedProjector& operator=(const PretendedProjector&) = delete;

    [[nodiscard]] config::ControlledProjector address(const std::string& password = "") const {
        return {"left", "127.0.0.1", password, port_, ""};
    }
    [[nodiscard]] int connections() const { return connections_; }

  private:
    void run() {
        while (!ended_) {
            pollfd waiting{listener_, POLLIN, 0};
            if (poll(&waiting, 1, 20) <= 0) continue;
            const int client = accept(listener_, nullptr, nullptr);
            ++connections_;
            serve_(client);
            close(client);
        }
    }

    Serve serve_;
    int listener_ = -1;
    int port_ = 0;
    std::atomic<bool> ended_ = false;
    std::atomic<int> connections_ = 0;
    std::thread thread_;
};

void say(int socket, const std::string& text) {
    static_cast<void>(send(socket, text.data(), text.size(), MSG_NOSIGNAL));
}

// The next command, without its end; empty when the client has gone.
std::string hear(int socket) {
    std::string line;
    char c = 0;
    while (recv(socket, &c, 1, 0) == 1) {
        if (c == '\r') return line;
        line += c;
    }
    return "";
}

// Until the client goes: who waits for this projector without a bound waits for ever.
void keepSilent(int socket) {
    char c = 0;
    while (recv(socket, &c, 1, 0) == 1) {
    }
}

// How a projector writes and when it closes.
struct Manner {
    std::string name;
    std::string end = "\r";
    bool isLowerCase = false, closesAfterAnswer = false, provesEachCommand = false;
    std::chrono::milliseconds answersAfter{0};
    std::string before = {};  // each answer: lines that are none
};

// A whole projector that keeps its state; a password of its own or none.
class Whole {
  public:
    explicit Whole(std::string password = "", Manner manner = {})
        : password_{std::move(password)}, manner_{std::move(manner)} {}
    void operator()(int socket) {
        const std::string salt = "498E4a" + std::to_string(10 + connections_++ % 90);
        write(socket, password_.empty() ? "PJLINK 0" : "PJLINK 1 ", salt);
        bool mustProve = !password_.empty();
        for (std::string line = hear(socket); !line.empty(); line = hear(socket)) {
            const std::string proof = pjlinkProof(salt, password_);
            if (mustProve && !line.starts_with(proof)) {
                write(socket, "PJLINK ERRA");
                if (!manner_.provesEachCommand) return;
                continue;
            }
            if (mustProve) line.erase(0, proof.size());
            if (!manner_.provesEachCommand) mustProve = false;
            std::this_thread::sleep_for(manner_.answersAfter);
            say(socket, manner_.before);
            write(socket, line.substr(0, 6) + "=" + answerTo(line.substr(2)));
            if (manner_.closesAfterAnswer) return;
        }
    }

    std::atomic<char> power = '0';
    std::atomic<bool> shut = false;

  private:
    // The salt keeps its letters.
    void write(int socket, std::string text, const std::string& salt = "") {
        if (manner_.isLowerCase)
            for (char& c : text) c = static_cast<char>(std::tolower(c));
        say(socket, text + (text.back() == ' ' ? salt : "") + manner_.end);
    }
    std::string answerTo(const std::string& command) {
        if (command == "POWR ?") return {power.load()};
        if (command == "AVMT ?") return power == '1' ? (shut ? "31" : "30") : "ERR3";
        if (command == "ERST ?") return "010002";
        if (command == "LAMP ?") return "1234 1";
        if (command == "POWR 1") power = '1';
        if (command == "POWR 0") power = '2';
        if (command == "AVMT 31") shut = true;
        if (command == "AVMT 30") shut = false;
        return "OK";
    }
    std::string password_;
    Manner manner_;
    int connections_ = 0;
};

std::string ask(PjlinkConnection& connection, const std::string& command) {
    const PjlinkReply reply = connection.ask(command);
    constexpr std::array kEnds{"", "unanswered", "unreachable", "refused"};
    return reply.end == PjlinkEnd::Answered ? reply.value
                                            : kEnds.at(static_cast<std::size_t>(reply.end));
}

TEST(Pjlink, theProofIsThatOfTheStandard) {
    // From the specification: salt 498e4a67, password JBMIAProjectorLink.
    EXPECT_EQ(pjlinkProof("498e4a67", "JBMIAProjectorLink"), "5d8409bc1c3fa39749434aa3a5c38682");
}

TEST(Pjlink, projectorsOfAllMannersAreHeard) {
    const std::array<Manner, 11> kManners{{
        {.name = "plain"},
        {.name = "lower case", .isLowerCase = true},
        {.name = "carriage return and line feed", .end = "\r\n"},
        {.name = "line feed", .end = "\n"},
        {.name = "line feed and carriage return", .end = "\n\r"},
        {.name = "a zero after it", .end = std::string("\r\0", 2)},
        {.name = "blanks before it", .end = "  \r"},
        {.name = "closes after each answer", .closesAfterAnswer = true},
        {.name = "wants the password each time", .provesEachCommand = true},
        {.name = "answers late", .answersAfter = 100ms},
        {.name = "an echo and an answer of before", .before = "%1POWR ?\r%1CLSS=1\rnoise\r"},
    }};
    for (const Manner& manner : kManners)
        for (const char* const password : {"", "JBMIAProjectorLink"}) {
            Whole whole{password, manner};
            whole.power = '1';
            const PretendedProjector pretended{std::ref(whole)};
            PjlinkConnection connection(pretended.address(password));
            EXPECT_EQ(ask(connection, "%1POWR ?"), "1") << manner.name;
            EXPECT_EQ(ask(connection, "%1AVMT 31"), "OK") << manner.name;
            EXPECT_EQ(ask(connection, "%1AVMT ?"), "31") << manner.name;
            EXPECT_EQ(ask(connection, "%1ERST ?"), "010002") << manner.name;
            EXPECT_EQ(ask(connection, "%1POWR 0"), "OK") << manner.name;
            EXPECT_EQ(whole.power, '2') << manner.name;
            const bool isReopened = manner.closesAfterAnswer ||
                                    (manner.provesEachCommand && std::string(password) != "");
            EXPECT_EQ(pretended.connections(), isReopened ? 5 : 1) << manner.name;
        }
}

TEST(Pjlink, oneThatIsSilentOddOrGoneIsAStateAndTakesItsTimeOnly) {
    const std::array<std::tuple<const char*, const char*, PretendedProjector::Serve>, 8> kQuirks{{
        {"silent", "unreachable", keepSilent},
        {"closes at once", "unreachable", [](int) {}},
        {"no line ends",
         "unreachable",
         [](int s) {
             say(s, std::string(100'000, 'P'));
             keepSilent(s);
         }},
        {"another protocol", "unreachable", [](int s) { say(s, "220 mail.example\r\n"); }},
        {"greets, then silent",
         "unanswered",
         [](int s) {
             say(s, "PJLINK 0\r");
             keepSilent(s);
         }},
        {"greets, then closes",
         "unanswered",
         [](int s) {
             say(s, "PJLINK 0\r");
             hear(s);
         }},
        {"noise",
         "unanswered",
         [](int s) {
             say(s, "PJLINK 0\r");
             hear(s);
             for (int i = 0; i < 1000; ++i) say(s, "\x01\xff%1POWR=\r%1POWR\r");
         }},
        {"an empty salt", "unreachable", [](int s) { say(s, "PJLINK 1 \r"); }},
    }};
    const PjlinkPatience patience{100ms, 100ms, 400ms, 10ms};
    for (const auto& [name, expected, serve] : kQuirks) {
        const PretendedProjector pretended{serve};
        PjlinkConnection connection(pretended.address(), patience);
        EXPECT_EQ(ask(connection, "%1POWR ?"), expected) << name;
    }
    for (const char* const host : {"127.0.0.1", "192.0.2.1", "::1", "nonsense"}) {
        PjlinkConnection connection({"left", host, "", 1, ""}, patience);
        EXPECT_EQ(ask(connection, "%1POWR ?"), "unreachable") << host;
    }
}

// A byte now and then is no answer: the whole line has its time, and so has the exchange. Without
// that the test would not end.
TEST(Pjlink, bytesThatTrickleDoNotProlongAnExchange) {
    const PretendedProjector pretended{[](int socket) {
        while (send(socket, "P", 1, MSG_NOSIGNAL) == 1) std::this_thread::sleep_for(20ms);
    }};
    PjlinkConnection connection(pretended.address(), {100ms, 200ms, 300ms, 10ms});
    EXPECT_EQ(ask(connection, "%1POWR ?"), "unreachable");
}

TEST(Pjlink, aConnectionThatIsResetBetweenTwoCommandsIsMadeAnew) {
    std::atomic<int> served = 0;
    const PretendedProjector pretended{[&](int socket) {
        say(socket, "PJLINK 0\r");
        hear(socket);
        say(socket, "%1POWR=1\r");
        if (++served > 1) return;
        const linger reset{1, 0};
        setsockopt(socket, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    }};
    PjlinkConnection connection(pretended.address());
    EXPECT_EQ(ask(connection, "%1POWR ?"), "1");
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(ask(connection, "%1POWR ?"), "1");
}

TEST(Pjlink, aWrongPasswordIsSaidAsSuch) {
    for (const bool isLowerCase : {false, true}) {
        Whole whole{"right", {.name = "", .isLowerCase = isLowerCase}};
        const PretendedProjector pretended{std::ref(whole)};
        PjlinkConnection wrong(pretended.address("wrong")), right(pretended.address("right"));
        EXPECT_EQ(ask(wrong, "%1POWR ?"), "refused");
        EXPECT_EQ(ask(right, "%1POWR ?"), "0");
    }
}

TEST(Pjlink, valuesOutsideTheStandardAreNoValues) {
    EXPECT_EQ(problemsIn("010002"), (std::vector<std::string>{"lamp: warning", "other: error"}));
    for (const char* const text : {"", "ERR3", "01000", "0100021", "010009", "OK"})
        EXPECT_FALSE(problemsIn(text)) << text;
    EXPECT_EQ(lampHoursIn("1234 1 77 0"), 1234U);
    EXPECT_EQ(lampHoursIn("0"), 0U);
    for (const char* const text : {"", "ERR1", " 1", "12345678", "-1", "1x 1"})
        EXPECT_FALSE(lampHoursIn(text)) << text;
    EXPECT_EQ(shutIn("11"), true);
    EXPECT_EQ(shutIn("21"), false) << "no sound, and a picture";
    for (const char* const text : {"", "ERR3", "3", "32", "1"}) EXPECT_FALSE(shutIn(text)) << text;
}

bool waitFor(const std::function<bool()>& condition) {
    for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(10ms);
    return condition();
}

TEST(Pjlink, aWatchedProjectorIsSwitchedToWhatIsWanted) {
    Whole whole;
    whole.power = '1';
    const PretendedProjector pretended{std::ref(whole)};
    ProjectorWatch watch(pretended.address());
    EXPECT_TRUE(waitFor([&] { return watch.facts().power == LampPower::On; }));
    watch.want(std::nullopt, true);
    EXPECT_TRUE(waitFor([&] { return whole.shut.load(); }));
    watch.want(false, std::nullopt);
    EXPECT_TRUE(waitFor([&] { return whole.power == '2'; })) << "cooling";
}

// Of projectors that never answer: hours may be changed, and the console ended, at any moment. A
// watch that waited for its projector would end the test after hours.
TEST(Pjlink, watchesEndAtOnceWhateverTheirProjectorsDo) {
    std::atomic<bool> isAsked = false;
    const PretendedProjector silent{[&](int socket) {
        say(socket, "PJLINK 0\r");
        hear(socket);
        isAsked = true;
        keepSilent(socket);
    }};
    const PjlinkPatience endless{.connect = 5h, .line = 5h, .exchange = 5h, .reconnect = 5h};
    const ProjectorWatch first(silent.address(), endless);
    const ProjectorWatch second({"away", "192.0.2.1", "", 4352, ""}, endless);
    EXPECT_TRUE(waitFor([&] { return isAsked.load(); })) << "in the middle of an exchange";
}

}  // namespace
}  // namespace aquarama::console
