// SPDX-License-Identifier: Apache-2.0
// Mastership by a real etcd on the loopback, and by members that answer wrongly or not at all.
#include "common/lease/mastership.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/log.h"
#include "tests/end_to_end/free_port.h"
#include "tests/support/await.h"

namespace aquarama::lease {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test::comesTrue;

constexpr const char* kEtcd = "/usr/bin/etcd";

std::string urlAt(int port) {
    return "http://127.0.0.1:" + std::to_string(port);
}

std::filesystem::path freshFolder() {
    std::string name = std::filesystem::temp_directory_path() / "aquarama-etcd-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw Error("no temporary folder");
    return name;
}

// One member, as docs/cluster.md starts it.
class Etcd {
  public:
    // With `certificates`, of that folder, it is reached by https alone, and by who shows one.
    explicit Etcd(const std::filesystem::path& certificates = {})
        : folder_{freshFolder()},
          url_{(certificates.empty() ? "http" : "https") + urlAt(freePort()).substr(4)} {
        const std::string peer = urlAt(freePort());
        std::vector<std::string> arguments{kEtcd,
                                           "--name",
                                           "one",
                                           "--data-dir",
                                           folder_ / "data",
                                           "--listen-client-urls",
                                           url_,
                                           "--advertise-client-urls",
                                           url_,
                                           "--listen-peer-urls",
                                           peer,
                                           "--initial-advertise-peer-urls",
                                           peer,
                                           "--initial-cluster",
                                           "one=" + peer,
                                           "--heartbeat-interval",
                                           "50",
                                           "--election-timeout",
                                           "500"};
        if (!certificates.empty())
            for (const auto& [name, file] : {std::pair("--cert-file", "own.pem"),
                                             {"--key-file", "own-key.pem"},
                                             {"--trusted-ca-file", "ca.pem"}}) {
                arguments.emplace_back(name);
                arguments.push_back(certificates / file);
            }
        if (!certificates.empty()) arguments.emplace_back("--client-cert-auth");
        start(arguments);
    }
    ~Etcd() {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
        std::filesystem::remove_all(folder_);
    }
    Etcd(const Etcd&) = delete;
    Etcd& operator=(const Etcd&) = delete;

    [[nodiscard]] const std::string& url() const { return url_; }
    void hold() const { kill(process_, SIGSTOP); }
    void letGo() const { kill(process_, SIGCONT); }

  private:
    void start(std::vector<std::string>& arguments) {
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        process_ = fork();
        if (process_ != 0) return;
        if (freopen((folder_ / "log").c_str(), "w", stderr) != nullptr)
            execv(kEtcd, pointers.data());
        _exit(1);
    }

    std::filesystem::path folder_;
    std::string url_;
    pid_t process_ = 0;
};

// Answers every connection with the same bytes.
class WrongMember {
  public:
    explicit WrongMember(std::string answer) : answer_{std::move(answer)}, port_{freePort()} {
        listener_ = socket(AF_INET, SOCK_STREAM, 0);
        const int yes = 1;
        setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        if (bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
            listen(listener_, 8) != 0)
            throw Error("no listener");
        thread_ = std::thread([this] { serve(); });
    }
    ~WrongMember() {
        shutdown(listener_, SHUT_RDWR);
        thread_.join();
        close(listener_);
    }
    WrongMember(const WrongMember&) = delete;
    WrongMember& operator=(const WrongMember&) = delete;

    [[nodiscard]] std::string url() const { return urlAt(port_); }

  private:
    void serve() {
        for (int client = 0; (client = accept(listener_, nullptr, nullptr)) >= 0; close(client)) {
            std::array<char, 4096> asked{};
            if (recv(client, asked.data(), asked.size(), 0) <= 0) continue;
            for (std::size_t at = 0; at < answer_.size();) {
                const ssize_t sent =
                    send(client, answer_.data() + at, answer_.size() - at, MSG_NOSIGNAL);
                if (sent <= 0) break;
                at += static_cast<std::size_t>(sent);
            }
        }
    }

    std::string answer_;
    int port_, listener_ = -1;
    std::thread thread_;
};

std::string httpOf(const std::string& body) {
    return "HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

class MastershipTest : public testing::Test {
  protected:
    void SetUp() override {
        if (std::filesystem::exists(kEtcd)) {
            etcd_ = std::make_unique<Etcd>();
            return;
        }
        if (std::getenv("CI") != nullptr) FAIL() << "no etcd-server (packaging/packages/test.txt)";
        GTEST_SKIP() << "no etcd-server (packaging/packages/test.txt)";
    }

    std::unique_ptr<Mastership> candidate(const std::string& name,
                                          std::optional<milliseconds> patience = milliseconds{0}) {
        auto mastership =
            std::make_unique<Mastership>(Members{{etcd_->url()}}, Candidate{"desk", name});
        mastership->campaign(patience);
        return mastership;
    }

    std::unique_ptr<Etcd> etcd_;
};

TEST_F(MastershipTest, IsOfOneAndPassesOn) {
    const auto first = candidate("first");
    ASSERT_TRUE(comesTrue([&] { return first->isHeld(); }));
    const std::uint64_t revision = first->revision();
    const auto second = candidate("second", std::nullopt);
    ASSERT_TRUE(comesTrue([&] { return second->master() == "first"; }));
    EXPECT_EQ(second->lastRevision(), revision);
    std::this_thread::sleep_for(milliseconds(1500));  // longer than the lease
    EXPECT_TRUE(comesTrue([&] { return first->isHeld(); }));
    EXPECT_EQ(first->revision(), revision) << "it was renewed";
    first->resign();
    EXPECT_FALSE(first->isHeld());
    ASSERT_TRUE(comesTrue([&] { return first->isLost(); }));
    const LeaseKeys keys{"aquarama/desk/master", "aquarama/desk/last-master"};
    EXPECT_FALSE(EtcdClient({{etcd_->url()}}).holder(keys)) << "nobody waits for the lease";
    second->campaign(milliseconds{0});
    ASSERT_TRUE(comesTrue([&] { return second->isHeld(); }));
    EXPECT_GT(second->revision(), revision);
}

TEST_F(MastershipTest, IsNobodysWithoutACandidacy) {
    const auto waits = candidate("waits", std::nullopt);
    const auto patient = candidate("patient", std::chrono::hours(1));
    std::this_thread::sleep_for(milliseconds(500));
    EXPECT_EQ(waits->revision() + patient->revision(), 0U);
    patient->campaign(milliseconds{100});
    EXPECT_TRUE(comesTrue([&] { return patient->isHeld(); }));
    EXPECT_FALSE(waits->isHeld());
}

// A machine that stood still for longer than its lease: never two at once, by its own clock.
TEST_F(MastershipTest, EndsByItsOwnClockWhereEtcdIsSilent) {
    const auto only = candidate("only");
    ASSERT_TRUE(comesTrue([&] { return only->isHeld(); }));
    const std::uint64_t revision = only->revision();
    etcd_->hold();
    static_assert(kAnswerCounts < std::chrono::seconds(kLeaseSeconds));
    ASSERT_TRUE(comesTrue([&] { return !only->isHeld(); }));
    EXPECT_FALSE(only->isLost()) << "nobody else may have it yet";
    etcd_->letGo();
    ASSERT_TRUE(comesTrue([&] { return only->isHeld(); })) << "nobody else was the master";
    EXPECT_GE(only->revision(), revision);
}

// As by SIGSTOP: its lease has expired, and another was the master meanwhile.
TEST_F(MastershipTest, IsLostWhereAnotherWasTheMaster) {
    EtcdClient client({{etcd_->url()}});
    const LeaseKeys keys{"aquarama/desk/master", "aquarama/desk/last-master"};
    const auto first = candidate("first");
    ASSERT_TRUE(comesTrue([&] { return first->isHeld(); }));
    client.revoke(client.holder(keys)->lease);
    const auto stolen = client.take(keys, "thief", client.grant(1).lease, 0);
    ASSERT_TRUE(stolen.revision);
    ASSERT_TRUE(comesTrue([&] { return first->isLost(); }));
    EXPECT_FALSE(first->isHeld());
    EXPECT_LT(first->revision(), *stolen.revision);
}

// Past the loopback both sides show a certificate of one authority.
TEST_F(MastershipTest, IsByCertificates) {
    const std::filesystem::path folder = freshFolder();
    const std::string make =
        "cd " + folder.string() +
        " && n='-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes'"
        " && openssl req -x509 $n -keyout ca-key.pem -out ca.pem -subj /CN=authority"
        " && openssl req $n -keyout own-key.pem -out asked.pem -subj /CN=etcd"
        " -addext subjectAltName=IP:127.0.0.1"
        " && openssl x509 -req -in asked.pem -CA ca.pem -CAkey ca-key.pem -CAcreateserial"
        " -copy_extensions copy -out own.pem";
    ASSERT_EQ(std::system((" ( " + make + " ) >" + (folder / "log").string() + " 2>&1").c_str()),
              0);
    const Etcd secure(folder);
    const Certificates shown{folder / "ca.pem", folder / "own.pem", folder / "own-key.pem"};
    Mastership mastership({.urls = {secure.url()}, .certificates = shown}, {"desk", "one"});
    mastership.campaign(milliseconds(0));
    EXPECT_TRUE(comesTrue([&] { return mastership.isHeld(); }));
    EtcdClient stranger({{secure.url()}});
    EXPECT_THROW(static_cast<void>(stranger.grant(1)), Error) << "of an unknown authority";
    std::filesystem::remove_all(folder);
}

TEST_F(MastershipTest, GoesOnByAnotherMember) {
    Mastership mastership({{urlAt(freePort()), etcd_->url()}}, {"desk", "one"});
    mastership.campaign(milliseconds(0));
    EXPECT_TRUE(comesTrue([&] { return mastership.isHeld(); }));
}

TEST(WrongMembers, AreErrors) {
    const std::string huge(std::size_t{4} << 20U, ' ');
    for (const std::string& answer : {std::string("no HTTP"),
                                      httpOf("{"),
                                      httpOf("{\"header\":" + std::string(5000, '[')),
                                      httpOf(huge),
                                      std::string("HTTP/1.1 500 No\r\nContent-Length: 0\r\n\r\n"),
                                      std::string()}) {
        const WrongMember member(answer);
        EtcdClient client({{member.url()}});
        EXPECT_THROW(static_cast<void>(client.grant(1)), Error) << answer.substr(0, 40);
        EXPECT_THROW(static_cast<void>(client.holder({"a", "b"})), Error);
    }
}

TEST(WrongMembers, MakeNobodyAMaster) {
    const WrongMember member(
        httpOf("{\"header\":{\"revision\":\"1\"},\"ID\":\"1\",\"TTL\":\"1\"}"));
    Mastership mastership({{member.url()}}, {"desk", "one"});
    mastership.campaign(milliseconds(0));
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_FALSE(mastership.isHeld());
    EXPECT_EQ(mastership.revision(), 0U);
}

}  // namespace
}  // namespace aquarama::lease
