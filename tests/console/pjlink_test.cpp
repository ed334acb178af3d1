// SPDX-License-Identifier: Apache-2.0
// Against pretended projectors, each with a quirk that real ones have.
#include "console/pjlink.h"

#include <array>
#include <atomic>
#include <functional>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

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
        return {"left", "127.0.0.1", password, port_};
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

// A whole projector that keeps its state; a password of its own or none.
class Whole {
  public:
    explicit Whole(std::string password = "") : password_{std::move(password)} {}
    void operator()(int socket) {
        const std::string salt = "498e4a67";
        say(socket, password_.empty() ? "PJLINK 0\r" : "PJLINK 1 " + salt + "\r");
        bool isFirst = !password_.empty();
        for (std::string line = hear(socket); !line.empty(); line = hear(socket)) {
            const std::string proof = pjlinkProof(salt, password_);
            if (isFirst && !line.starts_with(proof)) return say(socket, "PJLINK ERRA\r");
            if (std::exchange(isFirst, false)) line.erase(0, proof.size());
            say(socket, line.substr(0, 6) + "=" + answerTo(line.substr(2)) + "\r");
        }
    }

    std::atomic<char> power = '0';
    std::atomic<bool> shut = false;

  private:
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
};

TEST(Pjlink, theProofIsThatOfTheStandard) {
    // From the specification: salt 498e4a67, password JBMIAProjectorLink.
    EXPECT_EQ(pjlinkProof("498e4a67", "JBMIAProjectorLink"), "5d8409bc1c3fa39749434aa3a5c38682");
}

TEST(Pjlink, aWholeProjectorIsRead) {
    for (const char* const password : {"", "JBMIAProjectorLink"}) {
        Whole whole{password};
        whole.power = '1';
        const PretendedProjector pretended{std::ref(whole)};
        const ProjectorFacts facts = lookAtProjector(pretended.address(password), 1s);
        EXPECT_EQ(facts.power, "on");
        EXPECT_FALSE(facts.isShut);
        EXPECT_EQ(facts.problems, (std::vector<std::string>{"lamp: warning", "other: error"}));
        EXPECT_EQ(facts.lampHours, 1234U);
        EXPECT_EQ(pretended.connections(), 1) << "one connection for all questions";
    }
}

TEST(Pjlink, oneThatIsSilentOddOrGoneIsAStateAndTakesItsTimeOnly) {
    const std::array<std::pair<const char*, PretendedProjector::Serve>, 8> kQuirks{{
        {"silent", [](int) { std::this_thread::sleep_for(400ms); }},
        {"closes at once", [](int) {}},
        {"no line ends",
         [](int s) {
             say(s, std::string(100'000, 'P'));
             std::this_thread::sleep_for(50ms);
         }},
        {"another protocol", [](int s) { say(s, "220 mail.example\r\n"); }},
        {"greets, then silent",
         [](int s) {
             say(s, "PJLINK 0\r");
             std::this_thread::sleep_for(400ms);
         }},
        {"greets, then closes",
         [](int s) {
             say(s, "PJLINK 0\r");
             hear(s);
         }},
        {"noise",
         [](int s) {
             say(s, "PJLINK 0\r");
             hear(s);
             say(s, "\x01\xff%1POWR=\r%1POWR\r");
         }},
        {"an empty salt", [](int s) { say(s, "PJLINK 1 \r"); }},
    }};
    for (const auto& [name, serve] : kQuirks) {
        const PretendedProjector pretended{serve};
        const auto begun = std::chrono::steady_clock::now();
        EXPECT_EQ(lookAtProjector(pretended.address(), 100ms).power, "no answer") << name;
        EXPECT_LT(std::chrono::steady_clock::now() - begun, 1s) << name;
    }
    EXPECT_EQ(lookAtProjector({"left", "127.0.0.1", "", 1}, 100ms).power, "no answer");
    EXPECT_EQ(lookAtProjector({"left", "192.0.2.1", "", 4352}, 100ms).power, "no answer");
}

TEST(Pjlink, oneInStandbyThatRefusesQuestionsIsNotBroken) {
    const PretendedProjector pretended{[](int socket) {
        say(socket, "PJLINK 0\r");
        for (std::string line = hear(socket); !line.empty(); line = hear(socket))
            say(socket, line.substr(0, 6) + (line.starts_with("%1POWR") ? "=0\r" : "=ERR3\r"));
    }};
    const ProjectorFacts facts = lookAtProjector(pretended.address(), 1s);
    EXPECT_EQ(facts, (ProjectorFacts{.power = "off", .problems = {}}));
    const PretendedProjector busy{[](int socket) {
        say(socket, "PJLINK 0\r");
        for (std::string line = hear(socket); !line.empty(); line = hear(socket))
            say(socket, line.substr(0, 6) + "=ERR3\r");
    }};
    EXPECT_EQ(lookAtProjector(busy.address(), 1s).power, "not now");
}

TEST(Pjlink, aWrongPasswordIsSaidAsSuch) {
    Whole whole{"right"};
    const PretendedProjector pretended{std::ref(whole)};
    EXPECT_EQ(lookAtProjector(pretended.address("wrong"), 1s).power, "refuses the password");
    EXPECT_EQ(lookAtProjector(pretended.address("right"), 1s).power, "off");
}

TEST(Pjlink, aWatchedProjectorIsSwitchedToWhatIsWanted) {
    Whole whole;
    whole.power = '1';
    const PretendedProjector pretended{std::ref(whole)};
    ProjectorWatch watch(pretended.address());
    const auto waitFor = [](const std::function<bool()>& condition) {
        for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(10ms);
        return condition();
    };
    EXPECT_TRUE(waitFor([&] { return watch.facts().power == "on"; }));
    watch.want(std::nullopt, true);
    EXPECT_TRUE(waitFor([&] { return whole.shut.load(); }));
    watch.want(false, std::nullopt);
    EXPECT_TRUE(waitFor([&] { return whole.power == '2'; })) << "cooling";
}

}  // namespace
}  // namespace aquarama::console
